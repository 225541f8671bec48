"""Pose and twists of a held carrier from the coordinates of its freedoms, literally: products of 4x4 matrices.

H = H_0 exp(S_1^ x_1) exp(S_2^ x_2) .. in the order of `core/stand/coordinates.py`, S^ = [[<omega>, v], [0, 0]], takes
points of E1 to E0. Its derivatives are those of a product, and V^ = H^-1 H', (V*)^ = H^-1 H'' - (H^-1 H')^2.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.model import Stand
from mahovik.proof.reference.array import Array, vector
from mahovik.proof.reference.hold import twists
from mahovik.proof.reference.rotation import attitude, rotation_vector
from mahovik.proof.reference.screw import cross


def pose(stand: Stand, q: Array) -> tuple[Array, Array]:
    """O1 in E0 (3) and C (3x3) at coordinates q (m)."""
    H = _product(stand, q, np.zeros_like(q), np.zeros_like(q))[0]
    return H[:3, 3], H[:3, :3]


def held_twist(stand: Stand, q: Array, q_dot: Array) -> Array:
    """V (6) in E1."""
    H, H_dot, _ = _product(stand, q, q_dot, np.zeros_like(q))
    return _twist_of(left_solve(H, H_dot))


def held_twist_rate(stand: Stand, q: Array, q_dot: Array, q_ddot: Array) -> Array:
    """V* (6) in E1."""
    H, H_dot, H_ddot = _product(stand, q, q_dot, q_ddot)
    rate = left_solve(H, H_dot)
    return _twist_of(left_solve(H, H_ddot) - rate @ rate)


def speeds(stand: Stand, V: Array) -> Array:
    """u (m) of V = S u (6)."""
    assert stand.hold is not None
    return np.asarray(np.linalg.lstsq(twists(stand.hold), V, rcond=None)[0])


def coordinate_rates(stand: Stand, q: Array, u: Array) -> Array:
    """q' (m) at speeds u (m)."""
    assert stand.hold is not None
    columns = np.column_stack([held_twist(stand, q, each) for each in np.eye(len(q))])
    return np.asarray(np.linalg.lstsq(columns, twists(stand.hold) @ u, rcond=None)[0])


def displacement(stand: Stand, q: Array, mean: Array) -> tuple[float, float]:
    """Way of O1 (m) and angle of E1 (rad) from the pose of coordinates `mean` (m) to that of q (m).

    Turns about one axis are counted; about a point the angle is at most half a turn.
    """
    assert stand.hold is not None
    S, (O1, C), (O1_mean, C_mean) = twists(stand.hold), pose(stand, q), pose(stand, mean)
    way = float(np.linalg.norm(O1 - O1_mean))
    if np.linalg.matrix_rank(S[3:]) > 1:
        return way, float(np.linalg.norm(rotation_vector(C_mean.T @ C)))
    return way, float(np.linalg.norm(S[3:] @ (q - mean)))


def _product(stand: Stand, q: Array, q_dot: Array, q_ddot: Array) -> tuple[Array, Array, Array]:
    """H and its two derivatives by time (4x4 each)."""
    home, factors = _factors(stand)
    H, H_dot, H_ddot = home, np.zeros((4, 4)), np.zeros((4, 4))
    for k, S in factors:
        E = _exponential(S, q[k])
        E_dot = S @ E * q_dot[k]
        E_ddot = S @ E_dot * q_dot[k] + S @ E * q_ddot[k]
        H_ddot = H_ddot @ E + 2 * H_dot @ E_dot + H @ E_ddot
        H_dot = H_dot @ E + H @ E_dot
        H = H @ E
    return H, H_dot, H_ddot


def _exponential(S: Array, x: float) -> Array:
    """exp(S x) by Cayley and Hamilton: S^4 = -w^2 S^2 for a turn of w = |omega|, S^2 = 0 without a turn."""
    w = math.sqrt(S[2, 1] ** 2 + S[0, 2] ** 2 + S[1, 0] ** 2)
    if w == 0.0:
        return np.asarray(np.eye(4) + S * x)
    unit, angle = S / w, w * x
    square = unit @ unit
    return np.asarray(
        np.eye(4) + unit * angle + (1 - math.cos(angle)) * square + (angle - math.sin(angle)) * unit @ square
    )


@lru_cache(maxsize=4)
def _factors(stand: Stand) -> tuple[Array, tuple[tuple[int, Array], ...]]:
    """H_0, and S^ of each freedom with its number, in order."""
    hold = stand.hold
    assert hold is not None
    home = np.eye(4)
    home[:3, :3], home[:3, 3] = attitude(stand.angles, *hold.angles), vector(hold.position)
    S = twists(hold)
    factors = []
    for k in coordinates_of(stand).order:
        generator = np.zeros((4, 4))
        generator[:3, :3], generator[:3, 3] = cross(S[3:, k]), S[:3, k]
        factors.append((k, generator))
    return home, tuple(factors)


def left_solve(H: Array, X: Array) -> Array:
    """H^-1 X (4x4)."""
    return np.asarray(np.linalg.solve(H, X), dtype=np.float64)


def _twist_of(rate: Array) -> Array:
    """(v; omega) of [[<omega>, v], [0, 0]]."""
    return np.array([*rate[:3, 3], rate[2, 1], rate[0, 2], rate[1, 0]])
