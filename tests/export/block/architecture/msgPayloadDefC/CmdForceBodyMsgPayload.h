#pragma once
typedef struct { double forceRequestBody[3]; } CmdForceBodyMsgPayload;
