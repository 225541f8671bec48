"""A programme as a regime: the flywheels turn as it says, whatever the carrier does."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, cast

import numpy as np

from mahovik.core.motion.laws import Motion
from mahovik.core.motion.programme.course import Array, Fourier, Samples
from mahovik.core.motion.programme.model import Programme
from mahovik.core.motion.regime import FlywheelRegime, Regime


@dataclass(frozen=True, eq=False)
class Programmed:
    """Law of one flywheel: the angle that a programme of this flywheel alone gives it, counted from that at t = 0."""

    programme: Programme

    breaks: tuple[float, ...] = ()

    @cached_property
    def begin(self) -> float:
        """Angle at t = 0, rad."""
        return float(self.programme.at(np.zeros(1)).phi[0, 0])

    def motion(self, t: Array) -> Motion:
        """Motion at the times t (s)."""
        phi, phi_dot, phi_ddot = self.programme.at(t)
        return phi[:, 0] - self.begin, phi_dot[:, 0], phi_ddot[:, 0]


def programme_regime(programme: Programme) -> Regime:
    """The regime in which all flywheels follow the programme from its t = 0 on."""
    laws = [Programmed(_alone(programme, s)) for s in range(len(programme.flywheels))]
    driven = (
        FlywheelRegime(name, cast(Any, law), law.begin) for name, law in zip(programme.flywheels, laws, strict=True)
    )
    return Regime(programme.motion, tuple(driven), {})


def _alone(programme: Programme, s: int) -> Programme:
    """The programme of one flywheel."""
    own, course = slice(s, s + 1), programme.course
    alone = (
        Fourier(course.mean[own], course.cos[:, own], course.sin[:, own])
        if isinstance(course, Fourier)
        else Samples(course.t, course.phi[:, own], course.phi_dot[:, own], course.phi_ddot[:, own])
    )
    return replace(programme, flywheels=programme.flywheels[own], winding=programme.winding[own], course=alone)
