"""States of the carrier as 12 numbers about one pose, and their rate by (8), for M states at once.

y = (x, r, V): O1 = O1_0 + C_0 x (m), C = C_0 exp<r> (rad), V = (v, omega) in E1. No attitude within half a turn of C_0
is singular.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.use.plan.array import Array
from mahovik.use.plan.forward.drive import Drive
from mahovik.use.plan.residual import Mechanics
from mahovik.use.plan.residual.evaluate import flywheel_damping
from mahovik.use.plan.residual.kinematics import Coordinates, Twists, in_E1, twists
from mahovik.use.plan.residual.spatial import motor_cross

_SMALL = 1e-2
"""rad: below it the series is more accurate."""


@dataclass(frozen=True, eq=False)
class Chart:
    """The equations of a stand about the pose O1_0 (3; m), C_0 (3, 3)."""

    mechanics: Mechanics
    O1: Array
    C: Array

    @staticmethod
    def about(mechanics: Mechanics, course: Coordinates) -> Chart:
        """Chart about the single pose of `course` (M = 1)."""
        at = twists(mechanics.stand, course)
        return Chart(mechanics, at.O1[0], at.C[0])

    def of(self, course: Coordinates) -> Array:
        """y (M, 12) of prescribed coordinates q, q' (M, 6 each)."""
        at = twists(self.mechanics.stand, course)
        r = Rotation.from_matrix(self.C.T @ at.C).as_rotvec()
        return np.hstack([(at.O1 - self.O1) @ self.C, r, at.V])

    def twists(self, y: Array) -> Twists:
        """Attitude, position and twists (M) of states y (M, 12); V_r* is for V* = 0."""
        stand = self.mechanics.stand
        C = self.C @ Rotation.from_rotvec(y[:, 3:6]).as_matrix()
        V = y[:, 6:]
        V_r, rate = V, np.zeros_like(V)
        if stand.stream is not None and any(stand.stream):
            u = in_E1(C, np.broadcast_to(stand.stream, (len(y), 3)))
            none = np.zeros_like(u)
            V_r, rate = V - np.hstack([u, none]), np.hstack([np.cross(V[:, 3:], u), none])
        return Twists(C, self.O1 + y[:, :3] @ self.C.T, V, V_r, rate)

    def acceleration(self, given: Drive, y: Array) -> Array:
        """V* (M, 6; m/s2, rad/s2) by (8) at states y (M, 12), with the flywheels' motion at the same M times."""
        own, at = self.mechanics, self.twists(y)
        column = at.V_r[:, :, None]
        wrench = own.housing.balance(at._replace(V_r_dot=np.zeros_like(at.V)))[:, :, None]
        momentum = given.Theta @ column
        momentum[:, :, 0] += given.h
        wrench -= motor_cross(at.V_r) @ momentum
        wrench -= given.Theta_dot @ column
        wrench[:, :, 0] -= given.push
        if any(own.stand.gravity):
            g = in_E1(at.C, np.broadcast_to(own.stand.gravity, at.O1.shape))
            wrench += given.weight @ g[:, :, None]
        for s, damping in enumerate(own.tables.damping):
            if damping is not None:
                damped = flywheel_damping(own.tables, s, at.V_r, given.phi[:, s], given.phi_dot[:, s])[0]
                wrench[:, :, 0] += damped[:6].T
        return np.asarray((given.inverse @ wrench)[:, :, 0] - at.V_r_dot)

    def rate(self, given: Drive, y: Array) -> Array:
        """y' (M, 12)."""
        r, v, omega = y[:, 3:6], y[:, 6:9], y[:, 9:]
        x_dot = Rotation.from_rotvec(r).apply(v)
        angle = np.linalg.norm(r, axis=1)[:, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            k = (1.0 - angle / 2.0 / np.tan(angle / 2.0)) / angle**2
        k = np.where(angle < _SMALL, 1.0 / 12.0 + angle**2 / 720.0, k)
        turned = np.cross(r, omega)
        r_dot = omega + 0.5 * turned + k * np.cross(r, turned)
        return np.hstack([x_dot, r_dot, self.acceleration(given, y)])
