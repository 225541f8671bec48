"""A required motion of the carrier: its course, bounds and objective."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from mahovik.core.motion.required.course import Array, Course, Harmonics, Sampled

Winding = Literal["any", "spin", "rock"] | tuple[int, ...]

Each = tuple[float, ...] | None
"""A number for every flywheel; None: no bound."""


@dataclass(frozen=True)
class Bounds:
    """Magnitudes that a programme keeps to, N numbers each in SI; None is no bound. E_x, E_u of (13).

    speed, speed_min   of phi', rad/s; no flywheel faster, none slower
    acceleration       of phi'', rad/s2
    torque             of tau, N m
    angle              of phi less its winding and its mean, rad
    bias               of each of the six of `bias`: m, rad
    deviation          of the carrier from its mean pose during run-up and run-down: O1 (m), angle of its turn (rad);
                       infinite where there is no bound
    start_phi, start_phi_dot   x(t0) of (13) of a finite motion, with sign: rad, rad/s
    """

    speed: Each = None
    speed_min: Each = None
    acceleration: Each = None
    torque: Each = None
    angle: Each = None
    bias: Each = None
    deviation: tuple[float, float] | None = None
    start_phi: Each = None
    start_phi_dot: Each = None


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
    """

    name: str
    periodic: bool
    span: float
    mean: Array
    course: Harmonics | Sampled
    free_mean: tuple[bool, ...]
    winding: Winding
    bounds: Bounds
    objective: Objective
    runup: float | None

    def at(self, t: Array, bias: Array | float = 0.0) -> Course:
        """q, q', q'' (M, 6 each) at the times t (M, s), any of a periodic motion; `bias` (6) shifts the mean."""
        q, q_dot, q_ddot = self.course.at(np.asarray(t, dtype=np.float64))
        return Course(q + self.mean + bias, q_dot, q_ddot)

    @property
    def harmonics(self) -> tuple[int, ...]:
        """Numbers k of the harmonics, rising; none for a finite motion."""
        return self.course.harmonics
