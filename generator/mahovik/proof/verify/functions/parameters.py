"""Judges of `prepare` and `prepare_mounts`: stands with other masses, inertias and mountings, given at run time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeVar

import numpy as np

from mahovik.core.lower.values import parameters_of
from mahovik.core.stand.model import Body, Flywheel, Mat3, MountingAngles, MountingAxes, Stand, Vec3
from mahovik.core.stand.state import State
from mahovik.errors import StandError, StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import Judge
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.states import Request

STANDS = 3
"""Perturbed stands that are tried."""

SHARE = 0.05
"""Mass of the lump that is added to a body, as a part of the body's own."""

AnyBody = TypeVar("AnyBody", bound=Body)


def perturb(stand: Stand, rng: np.random.Generator) -> Stand:
    """The stand with a small lump on every body, and its flywheels elsewhere: as physical as the stand itself."""

    def flywheel(s: Flywheel) -> Flywheel:
        return replace(_add_lump(s, rng), position=_shift(s.position, rng), mounting=_rotate_mounting(s.mounting, rng))

    return replace(
        stand,
        carrier=_add_lump(stand.carrier, rng),
        instruments=tuple(
            replace(
                _add_lump(p, rng), position=_shift(p.position, rng), angles=_vector(np.array(p.angles) + _small(rng))
            )
            for p in stand.instruments
        ),
        flywheels=tuple(flywheel(s) for s in stand.flywheels),
        points=tuple(
            replace(p, position=_shift(p.position, rng), angles=_vector(np.array(p.angles) + _small(rng)))
            for p in stand.points
        ),
    )


def _small(rng: np.random.Generator) -> Array:
    return rng.uniform(-0.05, 0.05, 3)


def _vector(a: Array) -> Vec3:
    x, y, z = (float(each) for each in a)
    return x, y, z


def _shift(position: Vec3, rng: np.random.Generator) -> Vec3:
    """A place some per cent of its distance, and a centimetre, away."""
    place = np.array(position)
    return _vector(place + _small(rng) * (float(np.abs(place).max()) + 0.2))


def _rotate_mounting(
    mounting: MountingAngles | MountingAxes, rng: np.random.Generator
) -> MountingAngles | MountingAxes:
    """A mounting turned by some hundredths of a radian."""
    if isinstance(mounting, MountingAngles):
        psi, theta, zero = (float(x) for x in np.array([mounting.psi, mounting.theta, mounting.zero]) + _small(rng))
        return MountingAngles(psi, theta, zero)
    axis, zero_at = np.array(mounting.axis), np.array(mounting.zero)
    turn = _small(rng)
    return MountingAxes(_vector(axis + np.cross(turn, axis)), _vector(zero_at + np.cross(turn, zero_at)))


def _add_lump(body: AnyBody, rng: np.random.Generator) -> AnyBody:
    """The body with a point mass added somewhere in it; of no mass: unchanged."""
    if not body.mass:
        return body
    J, rc = np.array(body.inertia), np.array(body.center_of_mass)
    size = float(np.sqrt(np.trace(J) / body.mass))
    lump, place = SHARE * body.mass, rng.uniform(-size, size, 3)
    if body.inertia_about == "center_of_mass":
        J = J + body.mass * _point_inertia(rc)
    J = J + lump * _point_inertia(place)
    mass = body.mass + lump
    rows = [_vector(row) for row in (J + J.T) / 2]
    inertia: Mat3 = (rows[0], rows[1], rows[2])
    center = _vector((body.mass * rc + lump * place) / mass)
    return replace(body, mass=mass, center_of_mass=center, inertia=inertia, inertia_about="origin")


def _point_inertia(place: Array) -> Array:
    """Inertia of a unit mass at a place, about the origin."""
    return np.asarray(place @ place * np.eye(3) - np.outer(place, place))


def prepare_rows(case: Case) -> Iterator[Check]:
    """The wants of the perturbed stands, by the table that the C makes of their parameters."""
    yield _row(case, "prepare", ("matrices", "momentum", "forward", "torque", "points"))


def prepare_mounts_rows(case: Case) -> Iterator[Check]:
    """Mount wrenches of the perturbed stands."""
    yield _row(case, "prepare_mounts", ("mounts",))


def _row(case: Case, function: str, wants: tuple[str, ...]) -> Check:
    """Answers to some wants on perturbed stands: the worst difference of any quantity over its bound."""
    row = Check(function, "answers, with other parameters", case.bounds.default)
    known = case.backend.wants_of(case.backend.complete.program)
    wants = tuple(want for want in wants if want in known)
    for number in range(STANDS):
        other = perturb(case.stand, case.random(200 + number))
        try:
            given = parameters_of(other, case.backend.layout)
        except StandError:  # the lumps may reach beyond the range of parameters
            continue
        judge = Judge(other, case.bounds)
        for name, state in case.states[number::STANDS]:
            _compare(case, function, judge, Request(f"{name}, stand {number + 1}", state, wants), given)
        for found in judge.rows():
            off = found.share * case.bounds.default
            row.note(off, f"{found.state}, {found.quantity}", found.words)
    return row


def _compare(case: Case, function: str, judge: Judge, request: Request, parameters: object) -> None:
    """Judge the wants of a state with what the C makes of the parameters."""
    state: State = request.state
    given = case.backend.arguments(state)
    try:
        given["table"] = case.call("prepare", {"parameters": parameters, "table": case.backend.table()})["table"]
        if function == "prepare_mounts":
            given["mounting"] = case.call("prepare_mounts", {"parameters": parameters})["mounting"]
    except StateError as error:
        for want in request.want:
            judge.compare(request, want, None, words=str(error))
        return
    for want in request.want:
        judge.compare(request, want, case.backend.answer(want, state, given))
