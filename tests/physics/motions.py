"""Smooth motions through a given state, and derivatives along them, without any formula of the model.

A motion is closed: C(t) = C0 exp<theta(t)>, theta = omega t + omega' t^2 / 2, and O1(t) a parabola in E0, so that
V and V* at t = 0 are those of the state; flywheel angles are parabolas.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Sequence, Stand, State

SEQUENCES: dict[Sequence, str] = {"ship": "ZYX", "aircraft": "YZX", "euler": "ZXZ"}
"""SciPy's names of the attitude sequences; capitals turn about moving axes."""

# central difference of order 8: offsets, weights of the first and of the second derivative
OFFSETS = np.array([1, 2, 3, 4])
FIRST = np.array([4 / 5, -1 / 5, 4 / 105, -1 / 280])
SECOND = np.array([8 / 5, -1 / 5, 8 / 315, -1 / 560])
SECOND_MIDDLE = -205 / 72


def cross(a: np.ndarray) -> np.ndarray:
    """Matrix of the vector product, <a>."""
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]], dtype=float)


def vec(values: Iterable[float]) -> tuple[Any, ...]:
    """Numbers as the plain data of a stand or a state."""
    return tuple(float(x) for x in values)


def rotation(stand: Stand, state: State) -> np.ndarray:
    """C of the state, by SciPy."""
    if state.quaternion is not None:
        return np.asarray(Rotation.from_quat(state.quaternion, scalar_first=True).as_matrix())
    if state.angles is not None:
        return np.asarray(Rotation.from_euler(SEQUENCES[stand.angles], state.angles).as_matrix())
    return np.eye(3)


def with_rotation(state: State, C: np.ndarray) -> State:
    """The state at the attitude C, as a quaternion."""
    quaternion = Rotation.from_matrix(C).as_quat(scalar_first=True)
    return replace(state, angles=None, quaternion=vec(quaternion))


def right_jacobian(theta: np.ndarray) -> np.ndarray:
    """omega = J_r(theta) theta' for C = C0 exp<theta>: its series, exact to rounding for |theta| < 0.5."""
    total, term = np.eye(3), np.eye(3)
    for k in range(1, 15):
        term = term @ -cross(theta) / (k + 1)
        total = total + term
    return total


def motion(stand: Stand, state: State) -> Callable[[float], State]:
    """t -> state: a smooth motion whose V, V*, phi, phi', phi'' at t = 0 are those of `state`, in any attitude."""
    C0, O1 = rotation(stand, state), np.array(state.position)
    V, V_dot = np.array(state.V), np.array(state.V_dot)
    v0, a0 = C0 @ V[:3], C0 @ (V_dot[:3] + np.cross(V[3:], V[:3]))  # of O1 in E0
    phi, phi_dot, phi_ddot = map(np.array, (state.phi, state.phi_dot, state.phi_ddot))

    def state_at(t: float) -> State:
        theta, rate = V[3:] * t + V_dot[3:] * t * t / 2, V[3:] + V_dot[3:] * t
        C = C0 @ Rotation.from_rotvec(theta).as_matrix()
        moved = replace(
            state,
            position=vec(O1 + v0 * t + a0 * t * t / 2),
            V=vec([*(C.T @ (v0 + a0 * t)), *(right_jacobian(theta) @ rate)]),
            phi=vec(phi + phi_dot * t + phi_ddot * t * t / 2),
            phi_dot=vec(phi_dot + phi_ddot * t),
        )
        return with_rotation(moved, C)

    return state_at


def rate(function: Callable[[float], Any], h: float) -> Any:
    """Derivative of function(t) at 0, error of order h^8: near 1e-12 where h times the frequency is 0.03."""
    return sum(w * (function(k * h) - function(-k * h)) for k, w in zip(OFFSETS, FIRST, strict=True)) / h


def second_rate(function: Callable[[float], Any], h: float) -> Any:
    """Second derivative of function(t) at 0, error of order h^8, rounding of order 1e-15 / h^2 of the value."""
    sides = sum(w * (function(k * h) + function(-k * h)) for k, w in zip(OFFSETS, SECOND, strict=True))
    return (sides + SECOND_MIDDLE * function(0.0)) / h**2
