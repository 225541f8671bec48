"""Rotations and 6-vectors (linear; angular) of many times at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Sequence

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

AXES: dict[Sequence, tuple[int, int, int]] = {"ship": (2, 1, 0), "aircraft": (1, 2, 0), "euler": (2, 0, 2)}
"""Axes (0..2) that psi, theta, phi turn about, first to last."""

EULER: dict[Sequence, str] = {"ship": "ZYX", "aircraft": "YZX", "euler": "ZXZ"}
"""SciPy's names of the stand's sequences: about axes that turn along."""

SMALL = 1e-2
"""rad: below it a series is more exact."""


def turn(axis: int, angle: Array | float) -> Array:
    """Active elementary rotations (..., 3, 3) about an axis, by angles (...) in rad."""
    c, s = np.cos(angle), np.sin(angle)
    C = np.zeros((*np.shape(angle), 3, 3))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    C[..., axis, axis] = 1.0
    C[..., i, i] = C[..., j, j] = c
    C[..., i, j], C[..., j, i] = -s, s
    return C


def attitude(sequence: Sequence, angles: Array) -> Array:
    """C (..., 3, 3) of psi, theta, phi (..., 3; rad) in the stand's sequence."""
    a, b, c = AXES[sequence]
    return np.asarray(turn(a, angles[..., 0]) @ turn(b, angles[..., 1]) @ turn(c, angles[..., 2]))


def skew(a: Array) -> Array:
    """<a> (..., 3, 3) of a (..., 3): <a> b = a x b."""
    S = np.zeros((*a.shape, 3))
    S[..., 0, 1], S[..., 0, 2], S[..., 1, 2] = -a[..., 2], a[..., 1], -a[..., 0]
    S[..., 1, 0], S[..., 2, 0], S[..., 2, 1] = a[..., 2], -a[..., 1], a[..., 0]
    return S


def motor_cross(V: Array) -> Array:
    """Phi(V) (..., 6, 6) of V = (v, omega) (..., 6): [[<omega>, 0], [<v>, <omega>]], (4)."""
    P = np.zeros((*V.shape, 6))
    P[..., :3, :3] = P[..., 3:, 3:] = skew(V[..., 3:])
    P[..., 3:, :3] = skew(V[..., :3])
    return P


def block_diagonal(C: Array) -> Array:
    """diag(C, C) (..., 6, 6) of C (..., 3, 3)."""
    D = np.zeros((*C.shape[:-2], 6, 6))
    D[..., :3, :3] = D[..., 3:, 3:] = C
    return D


def place(L: Array) -> Array:
    """O (3, m) of a transfer [[C, 0], [<O> C, C]]."""
    S = L[3:, :3] @ L[:3, :3].T
    return np.array([S[2, 1], S[0, 2], S[1, 0]])


def left_jacobian(r: Array) -> Array:
    """J (M, 3, 3) of rotation vectors r (M, 3): exp of the twist (v, r) shifts by J v."""
    angle = np.linalg.norm(r, axis=1)[:, None, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = (1.0 - np.cos(angle)) / angle**2, (angle - np.sin(angle)) / angle**3
    first = np.where(angle < SMALL, 0.5 - angle**2 / 24.0 + angle**4 / 720.0, first)
    second = np.where(angle < SMALL, 1.0 / 6.0 - angle**2 / 120.0 + angle**4 / 5040.0, second)
    turned = skew(r)
    return np.asarray(np.eye(3) + first * turned + second * (turned @ turned))
