"""Changes that faults are made of, by stage of the reference: what is read, matrices, wrenches and drives, answers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mahovik.core.stand.model import Body, Flywheel, Stand
from mahovik.core.stand.state import State
from mahovik.proof.diagnose.fault import Case, Edit
from mahovik.proof.reference.array import Array, Values
from mahovik.proof.reference.bodies import Bodies, FixedBody, MountedFlywheel, PlacedBody, SpinningFlywheel
from mahovik.proof.reference.mass import coupling, coupling_bias, mass_matrix_rate
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.proof.reference.screw import Phi
from mahovik.proof.reference.wrench_kinds import body_wrench


def body(change: Callable[[Any], Any]) -> Edit:
    """Edit of a body of the stand."""

    def edit(stand: Stand, case: Case) -> Stand:
        def read(each: Any) -> Any:
            return change(each) if case.wrong(each) else each

        carrier, instruments, flywheels = read(stand.carrier), map(read, stand.instruments), map(read, stand.flywheels)
        return replace(stand, carrier=carrier, instruments=tuple(instruments), flywheels=tuple(flywheels))

    return Edit("stand", edit)


def stand(**values: Any) -> Edit:
    """Edit of some values of the stand."""
    return Edit("stand", lambda right, case: replace(right, **values))


def vector(key: str, change: Callable[[Array, Array], Array]) -> Edit:
    """Edit of `gravity` or `stream` (3) of the stand, in E0; `change` takes the right one and C (3x3)."""

    def edit(stand: Stand, case: Case) -> Stand:
        right = getattr(stand, key)
        if right is None:
            return stand
        values: dict[str, Any] = {key: tuple(change(np.array(right), carrier_rotation(stand, case.state)))}
        return replace(stand, **values)

    return Edit("stand", edit)


def state(change: Callable[[State], State]) -> Edit:
    """Edit of the state."""
    return Edit("state", lambda right, case: change(right))


def twist(change: Callable[[Array, Case], Array]) -> Edit:
    """Edit of V (6) of the state."""
    return Edit("state", lambda right, case: replace(right, V=tuple(change(np.array(right.V), case))))


def wheel(key: str, change: Callable[[float], float]) -> Edit:
    """Edit of `phi`, `phi_dot` or `phi_ddot` of a flywheel."""
    return wheel_at(key, lambda right, s, case: change(right))


def wheel_at(key: str, change: Callable[[float, Flywheel, Case], float]) -> Edit:
    """Edit of `phi`, `phi_dot` or `phi_ddot` by a change that depends on the flywheel and the state."""

    def edit(state: State, case: Case) -> State:
        pairs = zip(getattr(state, key), case.stand.flywheels, strict=True)
        values: dict[str, Any] = {key: tuple(change(x, s, case) if case.wrong(s) else x for x, s in pairs)}
        return replace(state, **values)

    return Edit("state", edit)


def attitude(change: Callable[[Array, State], Array]) -> Edit:
    """Edit of C (3x3) of the carrier."""
    return Edit("attitude", lambda C, case: change(C, case.state))


FORCE, MOMENT = np.array([1.0] * 3 + [0.0] * 3), np.array([0.0] * 3 + [1.0] * 3)
"""Factors that keep the force, or the moment, of a wrench."""


def zero(right: Array, *_: object) -> Array:
    """Zero in the place of a term."""
    return np.zeros_like(right)


def minus(right: Array, *_: object) -> Array:
    """A term with the wrong sign."""
    return -right


# ---- bodies ----


def place(change: Callable[[Any], Any]) -> Edit:
    """Edit of the inertia and the place of a body: `MountedFlywheel`, else `FixedBody`."""

    def edit(bodies: Bodies, case: Case) -> Bodies:
        def find(k: Any) -> Any:
            return change(k) if case.wrong(k.body) else k

        return Bodies(tuple(map(find, bodies.fixed)), tuple(map(find, bodies.mounted)))

    return Edit("bodies", edit)


def theta(change: Callable[[Array, Body], Array]) -> Edit:
    """Edit of Theta (6x6) about the body's origin, in its axes."""
    return place(lambda k: replace(k, Theta=change(k.Theta, k.body)))


def tensor(change: Callable[[Array, Body], Array]) -> Edit:
    """Edit of the tensor of inertia J (3x3) in Theta."""

    def edit(Theta: Array, body: Body) -> Array:
        found = Theta.copy()
        found[3:, 3:] = change(Theta[3:, 3:], body)
        return found

    return theta(edit)


def mounting(change: Callable[[MountedFlywheel], Array]) -> Edit:
    """Edit of C (3x3), the flywheel's axes in its mount at phase zero."""
    return place(lambda s: replace(s, C=change(s)))


def added_mass(change: Callable[[Array, FixedBody], Array]) -> Edit:
    """Edit of Lambda (6x6) of the carrier or an instrument."""
    return place(lambda k: replace(k, Lambda=change(k.Lambda, k)))


# ---- pieces ----


def pieces(change: Callable[[Pieces], Pieces]) -> Edit:
    """Edit of any of the pieces."""
    return Edit("pieces", lambda at, case: change(at))


def inertia(change: Callable[[Array, PlacedBody], Array]) -> Edit:
    """Edit of L Theta L^T (6x6), which a body adds to K, (2)."""

    def edit(at: Pieces, case: Case) -> Pieces:
        bodies: tuple[PlacedBody, ...] = (*at.fixed, *at.flywheels)
        for k in bodies:
            if case.wrong(k.body):
                right = k.L @ k.Theta @ k.L.T
                error = change(right, k) - right
                at = replace(at, K_bodies=at.K_bodies + error, K=at.K + error, M=at.M + Phi(at.V_r) @ error)
        return at

    return Edit("pieces", edit)


def each_wheel(change: Callable[[Pieces, int, SpinningFlywheel], Pieces]) -> Edit:
    """Edit of the pieces, once for each flywheel, of which `change` takes the index too."""

    def edit(at: Pieces, case: Case) -> Pieces:
        for number, s in enumerate(at.flywheels):
            if case.wrong(s.body):
                at = change(at, number, s)
        return at

    return Edit("pieces", edit)


def rate(change: Callable[[Array, SpinningFlywheel], Array]) -> Edit:
    """Edit of Ls ([<e>] Theta_s - Theta_s [<e>]) Ls^T phi_s' (6x6), which a flywheel adds to K*, (6)."""

    def edit(at: Pieces, number: int, s: SpinningFlywheel) -> Pieces:
        right = mass_matrix_rate([s])
        error = change(right, s) - right
        return replace(at, K_dot=at.K_dot + error, M=at.M + error)

    return each_wheel(edit)


def column_of_I(change: Callable[[Array, SpinningFlywheel], Array]) -> Edit:
    """Edit of I_s (6), (9)."""

    def edit(at: Pieces, number: int, s: SpinningFlywheel) -> Pieces:
        found = at.I.copy()
        found[:, number] = change(at.I[:, number], s)
        return replace(at, I=found)

    return each_wheel(edit)


def column_of_J(change: Callable[[Array, Array, SpinningFlywheel], Array]) -> Edit:
    """Edit of J_s (6), (9); `change` takes its two parts, Phi Ls Theta_s f and Ls [<e>] phi_s' Theta_s f."""

    def edit(at: Pieces, number: int, s: SpinningFlywheel) -> Pieces:
        found = at.J.copy()
        found[:, number] = change(Phi(at.V_r) @ coupling([s])[:, 0], coupling_bias([s], np.zeros(6))[:, 0], s)
        return replace(at, J=found)

    return each_wheel(edit)


def convection(change: Callable[[Array, Array, Pieces], Array]) -> Sequence[Edit]:
    """Edits of Phi K (6x6) of M, (9), and of J0, (11); `change` takes it, the twist (6) in it and the pieces."""

    def error(at: Pieces, V: Array) -> Array:
        right = Phi(V) @ at.K
        return change(right, V, at) - right

    def edit_J0(values: Values, at: Pieces, case: Case) -> Values:
        return {**values, "J0": values["J0"] + error(at, at.V) @ values["A"]} if "J0" in values else values

    return (pieces(lambda at: replace(at, M=at.M + error(at, at.V_r))), Edit("values", edit_J0))


def reaction(change: Callable[[Array], Array]) -> Edit:
    """Edit of I (6xN) before phi'' of the carrier's equation, (8) and (11)."""
    wants = ("forward", "generalized")
    return Edit("pieces", lambda at, case: replace(at, I=change(at.I)) if case.want in wants else at)


Change = Callable[[Array, PlacedBody, Pieces], Array]
"""A wrong wrench (6) of the right one, the body and the pieces."""


def each_body(error: Callable[[PlacedBody, Pieces], tuple[Array, Array]]) -> Edit:
    """P_k (6) of a body and, in E1 about O1, F (6): what is added to both."""

    def edit(at: Pieces, case: Case) -> Pieces:
        bodies: tuple[PlacedBody, ...] = (*at.fixed, *at.flywheels)
        for k in bodies:
            if case.wrong(k.body):
                P, F = error(k, at)
                at = replace(at, P={**at.P, k.body.name: at.P[k.body.name] + P}, F=at.F + F)
        return at

    return Edit("pieces", edit)


def wrench(change: Change, *kinds: str) -> Edit:
    """The wrench on a body, in its frame about its origin, of the kinds whose names begin so."""

    def error(k: PlacedBody, at: Pieces) -> tuple[Array, Array]:
        right = body_wrench({kind: P for kind, P in at.terms[k.body.name].items() if kind.startswith(kinds)})
        P = change(right, k, at) - right
        return P, k.L @ P

    return each_body(error)


def without_moment(P: Array, *_: object) -> Array:
    """A wrench (6) without its moment."""
    return np.asarray(P * FORCE)


def wrench_on_carrier(change: Callable[[Array, PlacedBody], Array]) -> Edit:
    """L P (6): how a body's wrench acts on the carrier; `change` takes P."""

    def error(k: PlacedBody, at: Pieces) -> tuple[Array, Array]:
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


def drive(missing: Callable[[Array, SpinningFlywheel, Motion], Array]) -> Edit:
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


def value(name: str, change: Callable[[Any, Values, Pieces, Case], Any]) -> Edit:
    """Edit of one value; `change` takes the right one, all values of the want, the pieces and the case."""

    def edit(values: Values, at: Pieces, case: Case) -> Values:
        return {**values, name: change(values[name], values, at, case)} if name in values else values

    return Edit("values", edit)


def values(want: str, change: Callable[[Values, Pieces, Case], Values]) -> Edit:
    """Edit of all values of a want."""
    return Edit("values", lambda right, at, case: change(right, at, case) if case.want == want else right)


def mount_wrench(change: Callable[[Array, SpinningFlywheel], Array]) -> Edit:
    """Edit of the mount wrench (6) of a flywheel."""

    def edit(right: Array, values: Values, at: Pieces, case: Case) -> Array:
        rows = [change(row, s) if case.wrong(s.body) else row for row, s in zip(right, at.flywheels, strict=True)]
        return np.array(rows).reshape(-1, 6)

    return value("mount_wrench", edit)
