"""What a programme wants at any time: angles and speeds of the flywheels, their drive torques, the carrier's motion."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mahovik.errors import UsageError
from mahovik.motion.programme import Programme, Samples
from mahovik.motion.required import RequiredMotion
from mahovik.plan.array import Array
from mahovik.plan.residual import Mechanics, prescribe, torques
from mahovik.stand.model import Stand

TORQUES = 512
"""Samples of a period that the torques' Fourier coefficients come from."""
_TAIL = 1e-9
_CHUNK = 4096


@dataclass(frozen=True, eq=False)
class Wanted:
    """A periodic programme of a stand for a required motion. `exact`: before it was put into a table."""

    stand: Stand
    motion: RequiredMotion
    programme: Programme
    exact: Programme

    @staticmethod
    def of(stand: Stand, motion: RequiredMotion, programme: Programme, rows: int | None) -> Wanted:
        """With `rows` nodes of quintic Hermite a period, as firmware has them; None: exact. Raises UsageError."""
        if not programme.periodic:
            raise UsageError("the programme is finite, expected a periodic one: following is told of a steady motion")
        return Wanted(stand, motion, programme if rows is None else tabulated(programme, rows), programme)

    @cached_property
    def _coefficients(self) -> tuple[Array, Array]:
        """Harmonics of the drive torques, complex (H, N): mean first; and their numbers (H)."""
        t = self.motion.span * np.arange(TORQUES) / TORQUES
        at = prescribe(Mechanics.of(self.stand), self.motion.at(t), self.programme.bias)
        found = np.fft.rfft(torques(at, *self.programme.at(t)), axis=0) / TORQUES
        found[1:] *= 2.0
        size = np.abs(found).max(axis=1)
        last = int(np.flatnonzero(size > _TAIL * size.max(initial=1e-300)).max(initial=0))
        return found[: last + 1], np.arange(last + 1.0)

    def torques(self, t: Array) -> Array:
        """Drive torques (M, N; N m) of the nominal stand at the required motion, at times t (M, s)."""
        coefficients, k = self._coefficients
        turns = np.outer((t / self.motion.span) % 1.0, k)
        return np.asarray(np.real(np.exp(2j * np.pi * turns) @ coefficients))


def tabulated(programme: Programme, rows: int) -> Programme:
    """The programme as a table of `rows` even nodes a period."""
    if rows < 4:
        raise UsageError(f"--table {rows}: expected at least 4 nodes")
    t = programme.span * np.arange(rows) / rows
    return replace(programme, course=Samples(t, *programme.at(t)))
