"""Twists, wrenches and their transfer between frames. Linear part first, about the origin of the frame."""

from __future__ import annotations

import numpy as np

from mahovik.proof.reference.array import Array

E = np.eye(3)
zero = np.zeros((3, 3))
f = np.array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0])  # every flywheel spins about its own first axis


def cross(a: Array) -> Array:
    """<a> (3x3) of a (3): <a> b = a x b."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def blocks(A: Array, B: Array, C: Array, D: Array) -> Array:
    """[[A, B], [C, D]] (6x6) of four 3x3. As np.block, which takes ten times as long and is most of a state's time."""
    found: Array = np.empty((6, 6), np.result_type(A, B, C, D))
    found[:3, :3], found[:3, 3:], found[3:, :3], found[3:, 3:] = A, B, C, D
    return found


def Phi(V: Array) -> Array:
    """Phi(V) (6x6) of a twist V = (v, omega): [[<omega>, 0], [<v>, <omega>]], in (4), (8), (9)."""
    v, omega = V[:3], V[3:]
    return blocks(cross(omega), zero, cross(v), cross(omega))


def block_diagonal(C: Array) -> Array:
    """[C] = diag(C, C) (6x6) of C (3x3)."""
    return blocks(C, zero, zero, C)


def T(O: Array) -> Array:
    """T = [[E, 0], [<O>, E]] (6x6): carries a wrench from O (3, m, in the parent) to the parent's origin."""
    return blocks(E, zero, cross(O), E)


def wrench_to_parent(O: Array, C: Array) -> Array:
    """L = T [C] (6x6): carries wrenches and momenta from child to parent; L^T twists from parent to child.

    O (3, m) is the child's origin in the parent, C (3x3) the child's axes: x_parent = O + C x_child.
    """
    return T(O) @ block_diagonal(C)


def force_at(force: Array, point: Array) -> Array:
    """Wrench (6; N, N m) about the origin of a force (3, N) that acts at a point (3, m) of the same frame."""
    return np.concatenate([force, cross(point) @ force])


e1 = np.array([1.0, 0.0, 0.0])
spin = block_diagonal(cross(e1))  # [<e>] of (5), (6), (9): Ls* = Ls [<e>] phi_s'
