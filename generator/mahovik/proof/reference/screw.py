"""Twists, wrenches and their transfer between frames. Linear part first, about the origin of the frame.

<a>, Phi(V) and T(O) - E are linear: each is written down once, for unit vectors, and combined from these.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mahovik.core.stand.model import Freedom, Hold
from mahovik.proof.reference.array import Array, stack, vector

E, E6 = np.eye(3), np.eye(6)
zero = np.zeros((3, 3))
e1 = E[0]
f = np.concatenate([zero[0], e1])  # every flywheel spins about its own first axis


def blocks(A: Array, B: Array, C: Array, D: Array) -> Array:
    """[[A, B], [C, D]] (6x6) of four 3x3. As np.block, which takes ten times as long."""
    statements: Array = np.empty((6, 6), np.result_type(A, B, C, D))
    statements[:3, :3], statements[:3, 3:], statements[3:, :3], statements[3:, 3:] = A, B, C, D
    return statements


def block_diagonal(C: Array) -> Array:
    """[C] = diag(C, C) (6x6) of C (3x3), or of each of many."""
    result: Array = np.zeros((*C.shape[:-2], 6, 6), C.dtype)
    result[..., :3, :3] = result[..., 3:, 3:] = C
    return result


def _linear(matrix: Callable[[Array], Array], n: int) -> Array:
    """Rows by which the numbers of a vector (n) count in its matrix, which is read row by row."""
    return np.array([matrix(unit).ravel() for unit in np.eye(n)])


_CROSS = _linear(lambda a: np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]]), 3)


def cross(a: Array) -> Array:
    """<a> (3x3) of a (3), or of each of many: <a> b = a x b."""
    return (a @ _CROSS).reshape(*a.shape, 3)


_PHI = _linear(lambda V: blocks(cross(V[3:]), zero, cross(V[:3]), cross(V[3:])), 6)
_T = _linear(lambda O: blocks(zero, zero, cross(O), zero), 3)


def Phi(V: Array) -> Array:
    """Phi(V) (6x6) of a twist V = (v, omega), or of each of many: [[<omega>, 0], [<v>, <omega>]], in (4), (8), (9)."""
    return (V @ _PHI).reshape(*V.shape, 6)


def T(O: Array) -> Array:
    """T = [[E, 0], [<O>, E]] (6x6): carries a wrench from O (3, m, in the parent) to the parent's origin."""
    return E6 + (O @ _T).reshape(6, 6)


def wrench_to_parent(O: Array, C: Array) -> Array:
    """L = T [C] (6x6): carries wrenches and momenta from child to parent; L^T twists from parent to child.

    O (3, m) is the child's origin in the parent, C (3x3) the child's axes: x_parent = O + C x_child.
    """
    return T(O) @ block_diagonal(C)


def force_at(force: Array, point: Array) -> Array:
    """Wrench (6; N, N m) about the origin of a force (3, N) that acts at a point (3, m) of the same frame."""
    return np.concatenate([force, cross(point) @ force])


spin = block_diagonal(cross(e1))  # [<e>] of (5), (6), (9): Ls* = Ls [<e>] phi_s'


def unit(freedom: Freedom) -> Array:
    """Direction of a freedom (3), of length 1."""
    d = vector(freedom.direction)
    d = d / np.max(np.abs(d))
    return np.asarray(d / np.sqrt(d @ d))


def twists(hold: Hold | None) -> Array:
    """S (6 x m) of V = S u, constant in E1: a frame at the pivot r has the twist L^T V of the carrier, L = T(r).

    A turn is (0; axis) of that frame, so V = T(-r)^T (0; axis); a slide is (direction; 0) of any frame. A free carrier
    has S = E.
    """
    if hold is None:
        return E6
    to_O1, still = T(-vector(hold.pivot)).T, zero[0]
    columns = []
    for freedom in hold.freedoms:
        if freedom.kind == "twist":
            columns.append(vector(freedom.twist))
        else:
            parts = (unit(freedom), still) if freedom.kind == "slide" else (still, unit(freedom))
            columns.append(to_O1 @ np.concatenate(parts))
    return stack(columns, 6).T
