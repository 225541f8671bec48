#pragma once
typedef struct { double wheelSpeeds[36]; double wheelThetas[36]; } RWSpeedMsgPayload;
