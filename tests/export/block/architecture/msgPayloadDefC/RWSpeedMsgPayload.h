#pragma once
#ifndef MAX_EFF_CNT
#define MAX_EFF_CNT 36
#endif
typedef struct { double wheelSpeeds[MAX_EFF_CNT]; double wheelThetas[MAX_EFF_CNT]; } RWSpeedMsgPayload;
