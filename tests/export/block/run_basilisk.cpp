// Runs the module. Arguments: sample time, dt, samples, torques of the wheels, force and torque on the carrier.
#include <cstdio>
#include <cstdlib>
#include MODULE

int main(int count, char **words)
{
    const double sample = std::atof(words[1]);
    const int wheels = count - 10;
    Message<ArrayMotorTorqueMsgPayload> torques;
    Message<CmdForceBodyMsgPayload> force;
    Message<CmdTorqueBodyMsgPayload> torque;
    CLASS module;

    for (int s = 0; s < wheels; ++s) { torques.payload.motorTorque[s] = std::atof(words[4 + s]); }
    for (int i = 0; i < 3; ++i) {
        force.payload.forceRequestBody[i] = std::atof(words[4 + wheels + i]);
        torque.payload.torqueRequestBody[i] = std::atof(words[7 + wheels + i]);
    }
    module.motorTorqueInMsg.subscribeTo(&torques);
    module.forceInMsg.subscribeTo(&force);
    module.torqueInMsg.subscribeTo(&torque);
    module.longestStep = std::atof(words[2]);
    module.Reset(0);
    for (int k = 0; k <= std::atoi(words[3]); ++k) {
        module.UpdateState(static_cast<uint64_t>(k * sample * 1e9 + 0.5));
        const SCStatesMsgPayload &state = module.scStateOutMsg.payload;
        const RWSpeedMsgPayload &speeds = module.rwSpeedOutMsg.payload;
        for (const double *from :
             { state.r_BN_N, state.v_BN_N, state.sigma_BN, state.omega_BN_B, state.r_CN_N, state.v_CN_N }) {
            for (int i = 0; i < 3; ++i) { std::printf("%.17g ", from[i]); }
        }
        for (int s = 0; s < wheels; ++s) { std::printf("%.17g %.17g ", speeds.wheelThetas[s], speeds.wheelSpeeds[s]); }
        std::printf("\n");
    }
    return 0;
}
