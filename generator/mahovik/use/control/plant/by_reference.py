"""The plant by SciPy's DOP853 on the literal reference, a judge of the C."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

import numpy as np
from scipy.integrate import solve_ivp

from mahovik.core.motion.motor import drive
from mahovik.core.stand.model import Stand, Vec3, Vec6
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.coupled import coupled
from mahovik.proof.reference.rotation import quaternion_rotation
from mahovik.use.plan.array import Array


class PlantByReference:
    """DOP853 on the literal reference, with independent kinematics."""

    def __init__(self, stand: Stand, state: State) -> None:
        assert state.quaternion is not None
        self.stand, self._state = stand, state
        self.position, self.attitude, self.V = (np.array(x) for x in (state.position, state.quaternion, state.V))
        self.phi, self.phi_dot = np.array(state.phi), np.array(state.phi_dot)
        self.tau = np.zeros(len(state.phi))

    def advance(self, command: Array, begin: float, end: float) -> None:
        """See Plant."""
        y = np.concatenate([self.position, self.attitude, self.V, self.phi, self.phi_dot])
        found = solve_ivp(lambda _, y: self._rates(y, command), (begin, end), y, "DOP853", rtol=1e-9, atol=1e-12)
        if not found.success:
            raise StateError(f"at t = {begin:.6g} s the integration fails: {found.message}")
        y, N = found.y[:, -1], len(self.phi)
        self.position, self.attitude, self.V = y[:3], y[3:7] / np.linalg.norm(y[3:7]), y[7:13]
        self.phi, self.phi_dot = y[13 : 13 + N], y[13 + N :]
        self.tau = self._torques(command, self.phi_dot)

    def _torques(self, command: Array, speeds: Array) -> Array:
        motors = [s.motor for s in self.stand.flywheels]
        return np.array([drive(m, float(u), float(w)) for m, u, w in zip(motors, command, speeds, strict=True)])

    def _rates(self, y: Array, command: Array) -> Array:
        N = len(self.phi)
        w, a, b, c = (y[3:7] / np.linalg.norm(y[3:7])).tolist()
        state = replace(
            self._state,
            position=cast(Vec3, tuple(y[:3].tolist())),
            angles=None,
            quaternion=(w, a, b, c),
            V=cast(Vec6, tuple(y[7:13].tolist())),
            phi=tuple(y[13 : 13 + N].tolist()),
            phi_dot=tuple(y[13 + N :].tolist()),
        )
        V_dot, phi_ddot = coupled(reference.pieces(self.stand, state), self._torques(command, y[13 + N :]))
        p, q, r = y[10:13]
        turning = 0.5 * np.array(
            [-a * p - b * q - c * r, w * p + b * r - c * q, w * q + c * p - a * r, w * r + a * q - b * p]
        )
        return np.concatenate([quaternion_rotation(w, a, b, c) @ y[7:10], turning, V_dot, y[13 + N :], phi_ddot])
