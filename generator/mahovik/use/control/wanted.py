"""The wanted motion at any time: angles and speeds of the flywheels, their drive torques, the carrier's motion."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from mahovik.core.motion.programme import Angles, Programme, Samples
from mahovik.core.motion.required import Course, RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.use.plan.array import Array
from mahovik.use.plan.forward import Chart, course, drive, equilibrium, linearise_along
from mahovik.use.plan.forward.collocation import INTERVALS
from mahovik.use.plan.residual import Mechanics, prescribe, torques

TORQUES = 512
"""Samples per period for the torques' Fourier coefficients."""
NODES = 64
"""Nodes per turn of the flywheels, for the run-up's torques."""
_TAIL = 1e-9


@dataclass(frozen=True, eq=False)
class Wanted:
    """A periodic programme of a stand for a required motion. `exact`: the programme before tabulation."""

    stand: Stand
    motion: RequiredMotion
    programme: Programme
    exact: Programme

    @staticmethod
    def of(stand: Stand, motion: RequiredMotion, programme: Programme, rows: int | None) -> Wanted:
        """Programme with `rows` nodes of quintic Hermite per period, as in firmware; None: exact. Raises UsageError."""
        if not programme.periodic:
            raise UsageError("the programme is finite, expected a periodic one: following is measured in steady motion")
        return Wanted(stand, motion, programme if rows is None else tabulate(programme, rows), programme)

    def angles(self, t: Array) -> Angles:
        """phi, phi', phi'' (M, N each; rad, s) at times t (M, s): of the programme, and of its run-up before t = 0."""
        found = self.programme.at(t)
        table, up = self.programme.runup, t < 0.0
        if table is None or not up.any():
            return found
        early = table.at(t[up] + table.duration)
        for all_, own in zip(found, early, strict=True):
            all_[up] = own
        for derivative in found[1:]:
            derivative[t < -table.duration] = 0.0
        return found

    def required(self, t: Array) -> Array:
        """Required q (M, 6; m, rad) of the carrier at times t (M, s); before t = 0 its mean pose."""
        q = self.motion.at(t, self.programme.bias).q
        q[t < 0.0] = self.motion.mean + self.programme.bias
        return q

    def torques(self, t: Array) -> Array:
        """Drive torques (M, N; N m) of the nominal stand at times t (M, s), at the required motion or on the run-up."""
        coefficients, k = self._coefficients
        turns = np.outer((t / self.motion.span) % 1.0, k)
        found = np.real(np.exp(2j * np.pi * turns) @ coefficients)
        if np.any(t < 0.0):
            found[t < 0.0] = self._on_runup(t[t < 0.0])
        return np.asarray(found)

    @cached_property
    def _on_runup(self) -> Any:
        """Torques of the run-up at times before 0 (s): the carrier is free on the way, (8) from rest."""
        table, mechanics = self.programme.runup, Mechanics.of(self.stand)
        assert table is not None
        turns = max([1, *self.motion.harmonics, *(abs(n) for n in self.programme.winding)])
        count = INTERVALS * max(1, round(NODES * turns * table.duration / self.motion.span / INTERVALS))
        t = np.linspace(0.0, table.duration, count + 1)
        still = np.zeros((1, 6))
        chart = Chart.about(mechanics, Course((self.motion.mean + self.programme.bias)[None], still, still))
        angles = table.at(t)
        given = drive(mechanics, *angles)
        start = equilibrium(chart, angles.phi[0]).y
        y = course(chart, given, t[1], start, np.tile(start, (len(t), 1)), None).y
        spline = CubicSpline(t - table.duration, linearise_along(chart, given, y, angles.phi_ddot).tau)
        return lambda times: spline(np.maximum(times, -table.duration))

    @cached_property
    def _coefficients(self) -> tuple[NDArray[np.complex128], Array]:
        """Harmonics of the drive torques, complex (H, N): mean first; and their numbers (H)."""
        t = self.motion.span * np.arange(TORQUES) / TORQUES
        at = prescribe(Mechanics.of(self.stand), self.motion.at(t), self.programme.bias)
        found = np.fft.rfft(torques(at, *self.programme.at(t)), axis=0) / TORQUES
        found[1:] *= 2.0
        size = np.abs(found).max(axis=1)
        last = int(np.flatnonzero(size > _TAIL * size.max(initial=1e-300)).max(initial=0))
        return found[: last + 1], np.arange(0.0, last + 1.0)


def tabulate(programme: Programme, rows: int) -> Programme:
    """The programme as a table of `rows` uniform nodes per period."""
    if rows < 4:
        raise UsageError(f"--table {rows}: expected at least 4 nodes")
    t = programme.span * np.arange(rows) / rows
    return replace(programme, course=Samples(t, *programme.at(t)))
