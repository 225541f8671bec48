"""Screws, linear part first: Phi(V), transfers L = T [C], a force at a point."""

from __future__ import annotations

from flint import arb_mat

from mahovik.proof.rigorous.ball import block, column, cross, identity, part, zeros

LINEAR, ANGULAR = slice(0, 3), slice(3, 6)


def screw_of_parts(linear: arb_mat, angular: arb_mat) -> arb_mat:
    """A screw (6) of its two parts (3 each)."""
    return block([[linear], [angular]])


def diagonal(C: arb_mat) -> arb_mat:
    """[C] = diag(C, C) (6x6)."""
    return block([[C, zeros(3, 3)], [zeros(3, 3), C]])


def Phi(V: arb_mat) -> arb_mat:
    """Phi(V) = [[<omega>, 0], [<v>, <omega>]] (6x6), in (4), (8), (9)."""
    v, omega = part(V, LINEAR), part(V, ANGULAR)
    return block([[cross(omega), zeros(3, 3)], [cross(v), cross(omega)]])


def transfer(O: arb_mat, C: arb_mat) -> arb_mat:
    """L = T [C] (6x6), T = [[E, 0], [<O>, E]]: wrenches from child to parent; L^T twists from parent to child.

    O (3, m) is the child's origin in the parent, C (3x3) its axes: x_parent = O + C x_child.
    """
    T = block([[identity(3), zeros(3, 3)], [cross(O), identity(3)]])
    return T * diagonal(C)


def force_at(force: arb_mat, point: arb_mat) -> arb_mat:
    """Wrench (6; N, N m) about the origin of a force (3, N) at a point (3, m)."""
    return screw_of_parts(force, cross(point) * force)


def f() -> arb_mat:
    """f = (0, e1) (6): every flywheel spins about its own first axis."""
    return column([0, 0, 0, 1, 0, 0])


def spin() -> arb_mat:
    """[<e>] = diag(<e1>, <e1>) (6x6): Ls* = Ls [<e>] phi_s'."""
    return diagonal(cross(column([1, 0, 0])))
