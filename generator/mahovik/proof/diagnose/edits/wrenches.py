"""Changes of the wrenches of (7), and of what a flywheel's drive and bearings carry."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mahovik.proof.diagnose.fault import Case, Edit
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Placed, Spinning
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.wrenches import body_wrench, body_wrenches

DAMPING = ("linear damping", "quadratic damping", "damping terms")
"""Kinds of wrench that depend on the twist relative to the fluid."""

Change = Callable[[Array, Placed, Pieces], Array]
"""A wrong wrench (6) of the right one, the body and the pieces."""


def each_body(error: Callable[[Placed, Pieces], tuple[Array, Array]]) -> Edit:
    """P_k (6) of a body and, in E1 about O1, F (6): what is added to both."""

    def edit(at: Pieces, case: Case) -> Pieces:
        bodies: tuple[Placed, ...] = (*at.fixed, *at.flywheels)
        for k in bodies:
            if case.wrong(k.body):
                P, F = error(k, at)
                at = replace(at, P={**at.P, k.body.name: at.P[k.body.name] + P}, F=at.F + F)
        return at

    return Edit("pieces", edit)


def wrench(change: Change, *kinds: str) -> Edit:
    """The wrench on a body, in its frame about its origin, of the kinds whose names begin so."""

    def error(k: Placed, at: Pieces) -> tuple[Array, Array]:
        right = body_wrench({kind: P for kind, P in at.terms[k.body.name].items() if kind.startswith(kinds)})
        P = change(right, k, at) - right
        return P, k.L @ P

    return each_body(error)


def damping(change: Change) -> Edit:
    """All damping of a body."""
    return wrench(change, *DAMPING)


def damping_at(twist: Callable[[Placed, Pieces], Array]) -> Edit:
    """All damping of a body, taken at another twist (6) in its frame."""

    def change(right: Array, k: Placed, at: Pieces) -> Array:
        kinds = body_wrenches(k.body, np.zeros(3), twist(k, at), np.zeros(6))
        return body_wrench({kind: P for kind, P in kinds.items() if kind in DAMPING})

    return damping(change)


def carried(change: Callable[[Array, Placed], Array]) -> Edit:
    """L P (6): how a body's wrench acts on the carrier; `change` takes P."""

    def error(k: Placed, at: Pieces) -> tuple[Array, Array]:
        P = at.P[k.body.name]
        return np.zeros(6), change(P, k) - k.L @ P

    return each_body(error)


# ---- drives and bearings ----


@dataclass(frozen=True)
class Motion:
    """Motion of the carrier and of one flywheel in the equation of its drive: V, V_dot (6), phi_ddot.

    In the coupled form, where accelerations are unknown, they are zero and V is that relative to the fluid.
    """

    V: Array
    V_dot: Array
    phi_ddot: float


def drive(missing: Callable[[Array, Spinning, Motion], Array]) -> Edit:
    """A part (6) that the equation of a flywheel's drive and bearings lacks, in Es about Os; `missing` takes P_s too.

    It has the effect of a wrench on the flywheel that nothing else feels.
    """

    def edit(at: Pieces, case: Case) -> Pieces:
        P = dict(at.P)
        for s, phi_ddot in zip(at.flywheels, case.state.phi_ddot, strict=True):
            if case.wrong(s.body):
                given = Motion(at.V, np.array(case.state.V_dot), phi_ddot)
                motion = Motion(at.V_r, np.zeros(6), 0.0) if case.want == "coupled" else given
                P[s.body.name] = P[s.body.name] + missing(P[s.body.name], s, motion)
        return replace(at, P=P)

    return Edit("pieces", edit)
