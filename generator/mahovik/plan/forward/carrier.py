"""States of the carrier and its acceleration by (8), for M states at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.plan.array import Array
from mahovik.plan.forward.drive import Drive
from mahovik.plan.residual import Mechanics
from mahovik.plan.residual.evaluate import flywheel_damping
from mahovik.plan.residual.kinematics import Coordinates, Twists, in_E1, twists
from mahovik.plan.residual.spatial import motor_cross, skew
from mahovik.stand.model import Stand


class Carrier(NamedTuple):
    """O1 in E0 (M, 3; m), attitude C (M, 3, 3), twist V in E1 (M, 6; m/s, rad/s)."""

    O1: Array
    C: Array
    V: Array

    def displaced(self, x: Array) -> Carrier:
        """Moved by small displacements in E1 (M, 6; m, rad): x = (C^T dO1, rotation vector)."""
        return Carrier(
            self.O1 + np.einsum("mij,mj->mi", self.C, x[:, :3]),
            self.C @ Rotation.from_rotvec(x[:, 3:]).as_matrix(),
            self.V,
        )

    def __getitem__(self, index: object) -> Carrier:  # type: ignore[override]
        return Carrier(*(x[index] for x in tuple(self)))  # type: ignore[index]


def carrier_at(stand: Stand, course: Coordinates) -> Carrier:
    """The states of a prescribed motion q, q' (M, 6 each)."""
    at = twists(stand, course)
    return Carrier(at.O1, at.C, at.V)


def apart(a: Carrier, b: Carrier) -> Array:
    """How far a is from b (M, 12): displacement in b's axes (m, rad), then difference of V."""
    x = in_E1(b.C, a.O1 - b.O1)
    turned = Rotation.from_matrix(np.swapaxes(b.C, 1, 2) @ a.C).as_rotvec()
    return np.hstack([x, turned, a.V - b.V])


def stream_rate(stand: Stand, C: Array, V: Array) -> tuple[Array, Array]:
    """V_r = V - (C^T u, 0) and V_r* - V* = (omega x C^T u, 0) (M, 6 each), u the stream."""
    if stand.stream is None or not any(stand.stream):
        return V, np.zeros_like(V)
    u = in_E1(C, np.broadcast_to(stand.stream, (len(V), 3)))
    none = np.zeros_like(u)
    return V - np.hstack([u, none]), np.hstack([np.cross(V[:, 3:], u), none])


def acceleration(mechanics: Mechanics, at: Drive, state: Carrier) -> Array:
    """V* (M, 6; m/s2, rad/s2) by (8) of states under the flywheels' motion at as many moments."""
    V_r, rate = stream_rate(mechanics.stand, state.C, state.V)
    column = V_r[:, :, None]
    wrench = mechanics.housing.balance(Twists(state.C, state.O1, state.V, V_r, np.zeros_like(V_r)))[:, :, None]
    momentum = at.Theta @ column
    momentum[:, :, 0] += at.h
    wrench -= motor_cross(V_r) @ momentum
    wrench -= at.Theta_dot @ column
    wrench[:, :, 0] -= at.push
    if any(mechanics.stand.gravity):
        g = in_E1(state.C, np.broadcast_to(mechanics.stand.gravity, state.O1.shape))
        wrench += at.weight @ g[:, :, None]
    for s, damping in enumerate(mechanics.tables.damping):
        if damping is not None:
            wrench[:, :, 0] += flywheel_damping(mechanics.tables, s, V_r, at.phi[:, s], at.phi_dot[:, s])[0][:6].T
    return np.asarray((at.inverse @ wrench)[:, :, 0] - rate)


def kinematic_rates(state: Carrier) -> tuple[Array, Array]:
    """O1' = C v (M, 3), C' = C <omega> (M, 3, 3)."""
    return (state.C @ state.V[:, :3, None])[:, :, 0], state.C @ skew(state.V[:, 3:])
