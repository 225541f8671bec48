"""Basilisk's `spinningBodyOneDOF` as a judge: rotors of any mass, centre of mass and tensor, each on a hinge.

It is exact for every flywheel, so that no stand is cut to what a reaction wheel has; the spacecraft is free.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import spinningBodyOneDOFStateEffector

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.verify.judges.basilisk_judge import BasiliskSpacecraft, column
from mahovik.proof.verify.judges.basilisk_wheel import unsupported_spacecraft_features
from mahovik.proof.verify.judges.rigid import Array, RigidBody, mount_flywheel, tree


class BasiliskRotorJudge(BasiliskSpacecraft):
    """See MovingJudge. Raises UsageError where the stand has what Basilisk's free spacecraft lacks."""

    name = "basilisk rotors"

    def __init__(self, stand: Stand) -> None:
        self._rotors = rotors(stand)
        self._effectors = [_effector(rotor) for rotor in self._rotors]
        self._torques = [messaging.ArrayMotorTorqueMsg() for _ in self._rotors]
        for effector, torque in zip(self._effectors, self._torques, strict=True):
            effector.motorTorqueInMsg.subscribeTo(torque)
        super().__init__(stand, unsupported_spacecraft_features(stand), self._effectors)

    def put_flywheels(self, state: State) -> None:
        """Set phases, speeds and drive torques of a state."""
        for k, effector in enumerate(self._effectors):
            self.put_state(effector.nameOfThetaState, [state.phi[k]])
            self.put_state(effector.nameOfThetaDotState, [state.phi_dot[k]])
            payload = messaging.ArrayMotorTorqueMsgPayload()
            payload.motorTorque = [state.tau[k]]
            self._torques[k].write(payload)
            effector.UpdateState(0)  # it reads the torque

    def flywheel_rates(self) -> Array:
        """phi'' (N)."""
        return np.array([float(self.rate(each.nameOfThetaDotState)[0]) for each in self._effectors])

    def flywheel_motion(self) -> tuple[Array, Array]:
        """phi, phi' (N)."""
        phi = [float(self.value(each.nameOfThetaState)[0]) for each in self._effectors]
        phi_dot = [float(self.value(each.nameOfThetaDotState)[0]) for each in self._effectors]
        return np.array(phi), np.array(phi_dot)


def rotors(stand: Stand) -> tuple[RigidBody, ...]:
    """The flywheels in the carrier's frame."""
    bodies = tree(stand)
    return tuple(mount_flywheel(body, bodies) for body in bodies if body.turns)


def _effector(rotor: RigidBody) -> Any:
    """A rotor without spring, damper and limits."""
    found = spinningBodyOneDOFStateEffector.SpinningBodyOneDOFStateEffector()
    found.ModelTag = rotor.name
    found.nameOfThetaState, found.nameOfThetaDotState = f"phi {rotor.name}", f"phi_dot {rotor.name}"
    found.mass, found.k, found.c = rotor.mass, 0.0, 0.0
    found.IPntSc_S = rotor.inertia.tolist()
    found.r_ScS_S, found.r_SB_B = column(rotor.center), column(rotor.position)
    found.sHat_S = column((1.0, 0.0, 0.0))
    found.dcm_S0B = rotor.axes.T.tolist()
    return found
