"""A programme as data: whose it is, and phi_s(t) with derivatives at any time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from mahovik.core.motion.course import PlannedCourse
from mahovik.core.motion.programme.course import Angles, Array, Fourier, Samples
from mahovik.core.stand.mean import Unbalance, mean_stand
from mahovik.core.stand.model import Stand


@dataclass(frozen=True, eq=False)
class RunUpTable:
    """A finite table of `duration` s from rest that ends on the programme's t = 0; or back: a run-down."""

    duration: float
    samples: Samples

    def at(self, t: Array) -> Angles:
        """phi, phi', phi'' (M, N each) at the times t (M, s) in 0..duration."""
        return self.samples.at(np.asarray(t, dtype=np.float64))


@dataclass(frozen=True, eq=False)
class Programme:
    """phi_s(t) for the flywheels of a stand that makes its carrier follow a required motion, (12)-(13).

    stand, structure, physics   the stand's name and identities (stand.identity)
    motion      name of the required motion
    flywheels   their names, in the stand's order
    periodic, span   period (or duration of a finite programme), s
    bias        6; m, rad: shift of the motion's mean; of a held carrier in its coordinates
    coordinates names of those of a held carrier; empty: the six of a free one
    winding     turns per period of each flywheel; zeros of a finite programme
    course      Fourier (periodic only) or Samples
    runup, rundown   from rest to t = 0, and back
    report      figures of the search, as JSON holds them
    carrier     course of the carrier that was found, of a slew; else None
    unbalance   resisted: (12) holds for the stand; averaged: for its mean stand
    """

    stand: str
    structure: str
    physics: str
    motion: str
    flywheels: tuple[str, ...]
    periodic: bool
    span: float
    bias: Array
    winding: tuple[int, ...]
    course: Fourier | Samples
    runup: RunUpTable | None = None
    rundown: RunUpTable | None = None
    report: Mapping[str, Any] = field(default_factory=dict)
    carrier: PlannedCourse | None = None
    coordinates: tuple[str, ...] = ()
    unbalance: Unbalance = "resisted"

    def planned_for(self, stand: Stand) -> Stand:
        """The stand whose equations the programme keeps: the given one, or its mean stand."""
        return mean_stand(stand) if self.unbalance == "averaged" else stand

    def at(self, t: Array) -> Angles:
        """phi, phi', phi'' (M, N each; rad, s) at the times t (M, s): any of a periodic programme, else 0..duration.

        phi_s = 2 pi winding_s t/T + mean_s + sum_k cos_k cos(2 pi k t/T) + sin_k sin(2 pi k t/T); or the table.
        """
        t = np.asarray(t, dtype=np.float64)
        if not self.periodic:
            assert isinstance(self.course, Samples)
            return self.course.at(t)
        turn = 2 * np.pi * np.array(self.winding, dtype=np.float64)
        if isinstance(self.course, Fourier):
            found = self.course.at(t, self.span)
            return Angles(found.phi + (t / self.span)[:, None] * turn, found.phi_dot + turn / self.span, found.phi_ddot)
        first = float(self.course.t[0])
        periods = np.floor((t - first) / self.span)
        found = self._whole_period.at(t - periods * self.span)
        return Angles(found.phi + periods[:, None] * turn, found.phi_dot, found.phi_ddot)

    @cached_property
    def _whole_period(self) -> Samples:
        assert isinstance(self.course, Samples)
        return self.course.over_whole_period(self.span, 2 * np.pi * np.array(self.winding, dtype=np.float64))
