"""Changes of bodies and of the matrices of (2), (6), (9)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.proof.diagnose.fault import Case, Edit
from mahovik.proof.reference.array import Array, Values
from mahovik.proof.reference.bodies import Bodies, Fixed, Mounted, Placed, Spinning
from mahovik.proof.reference.mass import coupling, coupling_bias, mass_matrix_rate
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.screw import Phi

FORCE, MOMENT = np.array([1.0] * 3 + [0.0] * 3), np.array([0.0] * 3 + [1.0] * 3)
"""Factors that keep the force, or the moment, of a wrench."""


def zero(right: Array, *_: object) -> Array:
    """Nothing, where a term should be."""
    return np.zeros_like(right)


def minus(right: Array, *_: object) -> Array:
    """A term with the wrong sign."""
    return -right


# ---- bodies ----


def place(change: Callable[[Any], Any]) -> Edit:
    """The inertia and the place of a body: `Mounted` of a flywheel, else `Fixed`."""

    def edit(bodies: Bodies, case: Case) -> Bodies:
        def found(k: Any) -> Any:
            return change(k) if case.wrong(k.body) else k

        return Bodies(tuple(map(found, bodies.fixed)), tuple(map(found, bodies.mounted)))

    return Edit("bodies", edit)


def theta(change: Callable[[Array, Body], Array]) -> Edit:
    """Theta (6x6) about the body's origin, in its axes."""
    return place(lambda k: replace(k, Theta=change(k.Theta, k.body)))


def tensor(change: Callable[[Array, Body], Array]) -> Edit:
    """The tensor of inertia J (3x3) in Theta."""

    def edit(Theta: Array, body: Body) -> Array:
        found = Theta.copy()
        found[3:, 3:] = change(Theta[3:, 3:], body)
        return found

    return theta(edit)


def mounting(change: Callable[[Mounted], Array]) -> Edit:
    """C (3x3), the flywheel's axes in its mount at phase zero."""
    return place(lambda s: replace(s, C=change(s)))


def added_mass(change: Callable[[Array, Fixed], Array]) -> Edit:
    """Lambda (6x6) of the carrier or an instrument."""
    return place(lambda k: replace(k, Lambda=change(k.Lambda, k)))


# ---- pieces ----


def pieces(change: Callable[[Pieces], Pieces]) -> Edit:
    """Any of the pieces."""
    return Edit("pieces", lambda at, case: change(at))


def inertia(change: Callable[[Array, Placed], Array]) -> Edit:
    """L Theta L^T (6x6), which a body adds to K, (2)."""

    def edit(at: Pieces, case: Case) -> Pieces:
        bodies: tuple[Placed, ...] = (*at.fixed, *at.flywheels)
        for k in bodies:
            if case.wrong(k.body):
                right = k.L @ k.Theta @ k.L.T
                error = change(right, k) - right
                at = replace(at, K_bodies=at.K_bodies + error, K=at.K + error, M=at.M + Phi(at.V_r) @ error)
        return at

    return Edit("pieces", edit)


def each_wheel(change: Callable[[Pieces, int, Spinning], Pieces]) -> Edit:
    """The pieces, once for each flywheel, of which `change` takes the index too."""

    def edit(at: Pieces, case: Case) -> Pieces:
        for number, s in enumerate(at.flywheels):
            if case.wrong(s.body):
                at = change(at, number, s)
        return at

    return Edit("pieces", edit)


def rate(change: Callable[[Array, Spinning], Array]) -> Edit:
    """Ls ([<e>] Theta_s - Theta_s [<e>]) Ls^T phi_s' (6x6), which a flywheel adds to K*, (6)."""

    def edit(at: Pieces, number: int, s: Spinning) -> Pieces:
        right = mass_matrix_rate([s])
        error = change(right, s) - right
        return replace(at, K_dot=at.K_dot + error, M=at.M + error)

    return each_wheel(edit)


def column_of_I(change: Callable[[Array, Spinning], Array]) -> Edit:
    """I_s (6), (9)."""

    def edit(at: Pieces, number: int, s: Spinning) -> Pieces:
        found = at.I.copy()
        found[:, number] = change(at.I[:, number], s)
        return replace(at, I=found)

    return each_wheel(edit)


def column_of_J(change: Callable[[Array, Array, Spinning], Array]) -> Edit:
    """J_s (6), (9); `change` takes its two parts, Phi Ls Theta_s f and Ls [<e>] phi_s' Theta_s f."""

    def edit(at: Pieces, number: int, s: Spinning) -> Pieces:
        found = at.J.copy()
        found[:, number] = change(Phi(at.V_r) @ coupling([s])[:, 0], coupling_bias([s], np.zeros(6))[:, 0], s)
        return replace(at, J=found)

    return each_wheel(edit)


def convection(change: Callable[[Array, Array, Pieces], Array]) -> Sequence[Edit]:
    """Phi K (6x6) of M, (9), and of J0, (11); `change` takes it, the twist (6) in it and the pieces."""

    def error(at: Pieces, V: Array) -> Array:
        right = Phi(V) @ at.K
        return change(right, V, at) - right

    def edit_J0(values: Values, at: Pieces, case: Case) -> Values:
        return {**values, "J0": values["J0"] + error(at, at.V) @ values["A"]} if "J0" in values else values

    return (pieces(lambda at: replace(at, M=at.M + error(at, at.V_r))), Edit("values", edit_J0))


def reaction(change: Callable[[Array], Array]) -> Edit:
    """I (6xN) before phi'' of the carrier's equation, (8) and (11)."""
    wants = ("forward", "generalized")
    return Edit("pieces", lambda at, case: replace(at, I=change(at.I)) if case.want in wants else at)
