"""A required motion of the carrier: its course, bounds and objective."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from mahovik.core.motion.course import Array, Course, PlannedCourse
from mahovik.core.motion.required.bounds import Bounds, Each
from mahovik.core.motion.required.course import Harmonics, SampledCourse
from mahovik.core.motion.required.slew import Slew

__all__ = ["Bounds", "Each", "Objective", "RequiredMotion", "Winding"]

Winding = Literal["any", "spin", "rock"] | tuple[int, ...]


@dataclass(frozen=True)
class Objective:
    """Weights of J(x, u) of (13), not negative, N numbers each."""

    acceleration: tuple[float, ...]
    torque: tuple[float, ...]
    speed_variation: tuple[float, ...]
    power: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class RequiredMotion:
    """q(t) = mean + bias + course(t), q = (O1 in E0, psi, theta, phi), m and rad, in the stand's sequence.

    periodic, span   period (or of a finite motion the duration), s
    free_mean        which of the six a planner may shift by `bias`
    winding          turns per period: one number per flywheel, or which numbers a planner may choose
    runup            duration of a run-up that is wanted, s; None: none
    slew             what is demanded, where the course is one that `plan` found for a slew; else None
    """

    name: str
    periodic: bool
    span: float
    mean: Array
    course: Harmonics | SampledCourse | PlannedCourse
    free_mean: tuple[bool, ...]
    winding: Winding
    bounds: Bounds
    objective: Objective
    runup: float | None
    slew: Slew | None = None

    def at(self, t: Array, bias: Array | float = 0.0) -> Course:
        """q, q', q'' (M, 6 each) at the times t (M, s), any of a periodic motion; `bias` (6) shifts the mean."""
        q, q_dot, q_ddot = self.course.at(np.asarray(t, dtype=np.float64))
        return Course(q + self.mean + bias, q_dot, q_ddot)

    @property
    def harmonics(self) -> tuple[int, ...]:
        """Numbers k of the harmonics, rising; none for a finite motion."""
        return self.course.harmonics
