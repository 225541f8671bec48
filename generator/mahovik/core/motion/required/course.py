"""Courses of the coordinates q in time, with exact derivatives: harmonics of a period, or a spline of samples."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mahovik.core.motion.course import Array, Course

_PRESENT = 1e-9
"""Smallest harmonic of a spline that counts, as a part of the largest."""


@dataclass(frozen=True, eq=False)
class Harmonics:
    """sum_k cos_k cos(2 pi k t/T) + sin_k sin(2 pi k t/T): `k` (H,) whole numbers; `cos`, `sin` (H, 6), m and rad."""

    period: float
    k: tuple[int, ...]
    cos: Array
    sin: Array

    def at(self, t: Array) -> Course:
        """q, q', q'' (M, 6 each) at the times t (M, s)."""
        k = np.array(self.k, dtype=np.float64)
        omega = 2 * np.pi * k / self.period
        angle = 2 * np.pi * ((t / self.period)[:, None] * k % 1.0)  # small angles: no digits lost at large t
        c, s = np.cos(angle), np.sin(angle)
        return Course(
            c @ self.cos + s @ self.sin,
            (c * omega) @ self.sin - (s * omega) @ self.cos,
            -((c * omega**2) @ self.cos + (s * omega**2) @ self.sin),
        )

    @property
    def harmonics(self) -> tuple[int, ...]:
        """Numbers of the harmonics with an amplitude, rising."""
        there = np.any(self.cos != 0.0, axis=1) | np.any(self.sin != 0.0, axis=1)
        return tuple(sorted(k for k, yes in zip(self.k, there, strict=True) if yes))


@dataclass(frozen=True, eq=False)
class SampledCourse:
    """Quintic spline through samples q (M, 6) at t (M, s) over `span` s: periodic, or from rest to rest.

    Rest: q' = q'' = 0 at both ends of a finite course; outside it nothing moves. groups: columns of one unit each.
    """

    span: float
    periodic: bool
    t: Array
    q: Array
    groups: tuple[tuple[int, ...], ...] = ((0, 1, 2), (3, 4, 5))

    @cached_property
    def _splines(self) -> tuple[Any, Any, Any]:
        spline = quintic(self.t, self.q, self.span if self.periodic else None)
        return spline, spline.derivative(1), spline.derivative(2)

    def at(self, t: Array) -> Course:
        """q, q', q'' (M, 6 each) at the times t (M, s)."""
        if self.periodic:
            inside = self.t[0] + (t - self.t[0]) % self.span
            return Course(*(spline(inside) for spline in self._splines))
        inside = np.clip(t, 0.0, self.span)
        moving = ((t >= 0.0) & (t <= self.span))[:, None]
        q, q_dot, q_ddot = (spline(inside) for spline in self._splines)
        return Course(q, np.where(moving, q_dot, 0.0), np.where(moving, q_ddot, 0.0))

    @cached_property
    def harmonics(self) -> tuple[int, ...]:
        """Numbers of the harmonics above 1e-9 of the largest in metres or in radians; none for a finite course.

        Below half the number of samples: beyond it are images that the spline makes of lower ones.
        """
        if not self.periodic:
            return ()
        M = 16 * len(self.t)
        amplitudes = np.abs(np.fft.rfft(self.at(self.span * np.arange(M) / M).q, axis=0))[1 : (len(self.t) + 1) // 2]
        there = np.zeros(len(amplitudes), dtype=bool)
        for kind in (amplitudes[:, list(group)] for group in self.groups):
            there |= np.any(kind > _PRESENT * kind.max(), axis=1) if kind.any() else False
        return tuple((np.flatnonzero(there) + 1).tolist())


def quintic(t: Array, q: Array, period: float | None) -> Any:
    """SciPy's quintic spline through samples: periodic, of samples without t = T; or at rest at both ends."""
    from scipy.interpolate import make_interp_spline

    if period is None:
        zero = np.zeros(q.shape[1])
        rest = [(1, zero), (2, zero)]
        return make_interp_spline(t, q, k=5, bc_type=(rest, rest))
    return make_interp_spline(np.append(t, t[0] + period), np.vstack([q, q[:1]]), k=5, bc_type="periodic")
