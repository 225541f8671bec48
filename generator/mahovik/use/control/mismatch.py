"""A real stand beside the one of the file: every measured number is a little wrong."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TypeVar, cast

import numpy as np

from mahovik.core.stand.declare import Errors
from mahovik.core.stand.fields import Mat3
from mahovik.core.stand.masses import inertia_about_center, placement
from mahovik.core.stand.model import Body, Flywheel, Instrument, Law, MountingAxes, Stand, Vec3
from mahovik.core.stand.physical import check_body, check_stand
from mahovik.core.stand.tables import Problems
from mahovik.errors import UsageError, whole_number

MOST = 0.2
"""Largest share: beyond it a stand is a different one, not a badly measured one."""

B = TypeVar("B", bound=Body)


def with_mismatch(stand: Stand, share: float, seed: int) -> Stand:
    """The stand with errors, the same for the same seed; names, counts, laws, gravity, stream, motors are unchanged.

    e stands for a random number, uniform in -share..share, a new one each time:

    masses                             times 1 + e
    vectors (centres of mass, positions)   each component plus e |vector| / sqrt(3)
    second moments of a body's mass about its centre, in its axes        S M S, S = diag(sqrt(1 + e)): a body that
                                       can exist stays one
    mounting of a flywheel             axis and zero turned by a rotation vector of components e (rad) / sqrt(3)
    attitude of an instrument          likewise, its three angles plus e / sqrt(3)
    added mass                         S A S, S = diag(sqrt(1 + e)): definite stays definite
    laws of `laws/`                    as the fields of each say

    Raises UsageError if share is outside 0..MOST, or the random stand is not valid.
    """
    if not (math.isfinite(share) and 0.0 <= share <= MOST):
        raise UsageError(f"mismatch {100 * share:g}%: expected 0% to {100 * MOST:g}%")
    if share == 0.0:
        return stand
    whole_number("seed", seed, 0)
    draw = _Bodies(np.random.default_rng(seed), share)
    carrier = draw.body(stand.carrier)
    mismatch = replace(
        stand,
        carrier=replace(carrier, added_mass=draw.matrix(carrier.added_mass)),
        laws=tuple(law.with_errors(draw) for law in stand.laws if isinstance(law, Law)),
        instruments=tuple(draw.instrument(p) for p in stand.instruments),
        flywheels=tuple(draw.flywheel(s) for s in stand.flywheels),
    )
    problems = Problems(f"{stand.name} with {100 * share:g} % mismatch, seed {seed}")
    for body in mismatch.bodies:
        check_body(body, body.name, problems)
    if not problems.lines:
        check_stand(mismatch, problems)
    if problems.lines:
        raise UsageError(f"{problems.lines[0]}; use another seed or a smaller mismatch")
    return mismatch


class _Bodies(Errors):
    """Errors of bodies."""

    def body(self, body: B) -> B:
        central = inertia_about_center(body)
        second = 0.5 * np.trace(central) * np.eye(3) - central
        S = np.sqrt(1.0 + self.errors(3))
        second = S[:, None] * second * S
        inertia = np.trace(second) * np.eye(3) - second
        changed = replace(
            body,
            mass=self.times(body.mass),
            center_of_mass=self.vector(body.center_of_mass),
            inertia=cast(Mat3, tuple(map(tuple, ((inertia + inertia.T) / 2.0).tolist()))),
            inertia_about="center_of_mass",
        )
        return replace(changed, laws=tuple(law.with_errors(self) for law in body.laws if isinstance(law, Law)))

    def instrument(self, instrument: Instrument) -> Instrument:
        angles = cast(Vec3, tuple((np.array(instrument.angles) + self.direction()).tolist()))
        placed = replace(self.body(instrument), position=self.vector(instrument.position), angles=angles)
        return replace(placed, added_mass=self.matrix(instrument.added_mass))

    def flywheel(self, flywheel: Flywheel) -> Flywheel:
        from scipy.spatial.transform import Rotation

        axes = Rotation.from_rotvec(self.direction()).as_matrix() @ placement(flywheel)[1]
        mounting = MountingAxes(*(cast(Vec3, tuple(axes[:, i].tolist())) for i in (0, 1)))
        return replace(self.body(flywheel), position=self.vector(flywheel.position), mounting=mounting)
