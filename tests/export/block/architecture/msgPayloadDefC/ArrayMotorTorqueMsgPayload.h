#pragma once
typedef struct { double motorTorque[36]; } ArrayMotorTorqueMsgPayload;
