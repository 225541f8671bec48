"""Simulation by SciPy's DOP853 on the literal reference: adaptive, slow, independent kinematics. A judge of the C."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.integrate import DOP853

from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.motion import rates
from mahovik.proof.reference.rotation import attitude, quaternion_rotation
from mahovik.use.simulate.case import Array, Case, Moment

RTOL, ATOL = 1e-10, 1e-12


class SciPyMotion:
    """y = position, quaternion, V, then phases and speeds where torques drive the flywheels."""

    def __init__(self, case: Case) -> None:
        self.case = case
        self._given = np.array(case.regime.has_speed_law, dtype=bool)

    def moments(self, mounts: bool) -> Iterator[Moment]:
        """One moment for every time of output. Raises StateError if the motion leaves the computable range."""
        case = self.case
        y = np.array([*case.start.position, *_quaternion(case), *case.start.V])
        if case.regime.by_torque:
            y = np.concatenate([y, case.phi0, case.phi_dot0])
        yield self._moment(0.0, y, mounts)
        corners = [*case.regime.breaks(case.until), case.until]
        waiting = list(case.times[1:])
        begin = 0.0
        for corner in corners:
            solver = DOP853(self._rate, begin, y, corner, rtol=RTOL, atol=ATOL, max_step=(corner - begin) / 4)
            while solver.status == "running":
                problem = solver.step()
                if solver.status == "failed":
                    raise StateError(f"at t = {solver.t:.6g} s the integration fails: {problem}")
                dense = solver.dense_output()
                while waiting and waiting[0] <= solver.t:
                    t = float(waiting.pop(0))
                    yield self._moment(t, dense(t), mounts)
            y, begin = solver.y, corner

    def _state(self, t: float, y: Array) -> tuple[State, Array]:
        """The state of y at t, and phases that are not wrapped."""
        N = len(self.case.stand.flywheels)
        (phi,), (phi_dot,), _ = self.case.motion(np.array([t]))
        if self.case.regime.by_torque:
            phi, phi_dot = np.where(self._given, phi, y[13 : 13 + N]), np.where(self._given, phi_dot, y[13 + N :])
        return self.case.state(t, y[:3], y[3:7], y[7:13], phi, phi_dot), phi

    def _accelerations(self, t: float, state: State) -> tuple[Array, Array, Array]:
        """V_dot, phi_ddot, and torques by motors and regime."""
        at = reference.pieces(self.case.stand, state)
        tau = self.case.torques(t, np.array(state.phi_dot))
        phi_ddot = self.case.motion(np.array([t]))[2][0]
        u_dot, phi_ddot = rates(
            at, tau, phi_ddot, ~self._given if self.case.regime.by_torque else np.full(len(tau), False)
        )
        return at.S @ u_dot, phi_ddot, tau

    def _rate(self, t: float, y: Array) -> Array:
        """dy/dt: position rate C v, quaternion rate q (0, omega) / 2, (8)."""
        state, _ = self._state(t, y)
        V_dot, phi_ddot, _ = self._accelerations(t, state)
        turning = quaternion_rate(y[3:7], y[10:13])
        motion = np.concatenate([quaternion_rotation(*(state.quaternion or (1, 0, 0, 0))) @ y[7:10], turning, V_dot])
        return np.concatenate([motion, state.phi_dot, phi_ddot]) if self.case.regime.by_torque else motion

    def _moment(self, t: float, y: Array, mounts: bool) -> Moment:
        state, phi = self._state(t, y)
        V_dot, phi_ddot, given = self._accelerations(t, state)
        state = self.case.moving(state, V_dot, phi_ddot)
        want = ["torque", "points", *(["mounts"] if mounts else [])]
        found = reference.evaluate(self.case.stand, state, want)
        tau = np.where([each.by_torque for each in self.case.regime.flywheels], given, found["tau"])
        reaction = None
        if self.case.stand.hold is not None:
            reaction = reference.evaluate(self.case.stand, state, ["forward"])["reaction"]
        return Moment(t, state, phi.copy(), tau, found["points"], found.get("mount_wrench"), reaction)


def quaternion_rate(quaternion: Array, omega: Array) -> Array:
    """q (0, omega) / 2 (4) of a quaternion (4, w first) and the angular velocity (3) in the turned axes."""
    w, x, y, z = quaternion
    p, q, r = omega
    return 0.5 * np.array([-x * p - y * q - z * r, w * p + y * r - z * q, w * q + z * p - x * r, w * r + x * q - y * p])


def _quaternion(case: Case) -> Array:
    """Quaternion of the start, w first; from angles if these are given."""
    start = case.start
    if start.quaternion is not None:
        return np.array(start.quaternion)
    if start.angles is None:
        return np.array([1.0, 0.0, 0.0, 0.0])
    from scipy.spatial.transform import Rotation

    x, y, z, w = Rotation.from_matrix(attitude(case.stand.angles, *start.angles)).as_quat()
    return np.array([w, x, y, z])
