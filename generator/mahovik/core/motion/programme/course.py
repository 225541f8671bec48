"""Angles of the flywheels in time, with exact derivatives: Fourier coefficients, or a table with quintic Hermite."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Angles(NamedTuple):
    """phi, phi', phi'' (M, N each; rad, s)."""

    phi: Array
    phi_dot: Array
    phi_ddot: Array


@dataclass(frozen=True, eq=False)
class Fourier:
    """Periodic part of phi, rad: `mean` (N), `cos`, `sin` (H, N), row k - 1 of harmonic k."""

    mean: Array
    cos: Array
    sin: Array

    def at(self, t: Array, period: float) -> Angles:
        """mean + sum_k cos_k cos(2 pi k t/T) + sin_k sin(2 pi k t/T) at the times t (M, s), without the winding."""
        k = np.arange(1.0, len(self.cos) + 1.0)
        omega = 2 * np.pi * k / period
        angle = 2 * np.pi * (((t / period) % 1.0)[:, None] * k)
        c, s = np.cos(angle), np.sin(angle)
        return Angles(
            self.mean + c @ self.cos + s @ self.sin,
            (c * omega) @ self.sin - (s * omega) @ self.cos,
            -((c * omega**2) @ self.cos + (s * omega**2) @ self.sin),
        )


@dataclass(frozen=True, eq=False)
class Samples:
    """phi, phi', phi'' (M, N each) at t (M, s), which rise; quintic Hermite between. A periodic table omits t = T."""

    t: Array
    phi: Array
    phi_dot: Array
    phi_ddot: Array

    def over_whole_period(self, period: float, turn: Array) -> Samples:
        """The table with its first row repeated one period later, `turn` (N, rad) further on."""
        return Samples(
            np.append(self.t, self.t[0] + period),
            np.vstack([self.phi, self.phi[:1] + turn]),
            np.vstack([self.phi_dot, self.phi_dot[:1]]),
            np.vstack([self.phi_ddot, self.phi_ddot[:1]]),
        )

    @cached_property
    def _pieces(self) -> tuple[Any, Any, Any]:
        """Each interval beside its first row at constant speed: angles of many turns would cost digits of phi''."""
        from scipy.interpolate import BPoly

        h, speed = np.diff(self.t)[:, None], self.phi_dot[:-1]
        end, gained = np.diff(self.phi, axis=0) - speed * h, np.diff(self.phi_dot, axis=0)
        first, last = (h**2 / 20.0 * each for each in (self.phi_ddot[:-1], self.phi_ddot[1:]))
        none = np.zeros_like(end)
        bernstein = [none, none, first, end - 0.4 * h * gained + last, end - 0.2 * h * gained, end]
        piece = BPoly(np.array(bernstein), self.t)
        return piece, piece.derivative(1), piece.derivative(2)

    def at(self, t: Array) -> Angles:
        """phi, phi', phi'' at the times t (M, s); the first and the last row hold beyond the table."""
        inside = np.clip(t, self.t[0], self.t[-1])
        k = np.clip(np.searchsorted(self.t, inside, side="right") - 1, 0, len(self.t) - 2)
        aside, faster, acceleration = (piece(inside) for piece in self._pieces)
        speed = self.phi_dot[k]
        return Angles(self.phi[k] + speed * (inside - self.t[k])[:, None] + aside, speed + faster, acceleration)
