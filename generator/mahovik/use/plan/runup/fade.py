"""Flywheel motions between rest and a periodic programme: the programme faded in or out, plus free additions.

With x from 0 (rest) to 1 (the programme's t = 0) and w(x) = x^3 (10 - 15 x + 6 x^2): mean speeds grow by w, the
periodic part by w^2; additions are c_s0 (1 - w), a free angle of rest, and c_sj b_j(x), quintic B-splines inside.
Any c keeps rest at one end and the programme, with two derivatives, at the other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import BSpline

from mahovik.core.motion.programme import Angles, Programme
from mahovik.use.plan.array import Array

SPLINES = 6
"""B-splines per flywheel."""


@dataclass(frozen=True, eq=False)
class Fade:
    """The family of motions at times t (M, s) of 0..duration: unknowns c (N, P; rad), P = 1 + splines.

    fixed  phi, phi', phi'' (M, N each) for c = 0
    basis  (3, M, P): derivatives of a flywheel's phi, phi', phi'' by each of its c
    """

    t: Array
    fixed: Angles
    basis: Array

    @property
    def P(self) -> int:
        """Unknowns per flywheel."""
        return int(self.basis.shape[2])

    def angles(self, c: Array) -> Angles:
        """phi, phi', phi'' (M, N each) of unknowns c (N, P)."""
        return Angles(*(fixed + added @ c.T for fixed, added in zip(self.fixed, self.basis, strict=True)))


def fade(programme: Programme, duration: float, t: Array, *, up: bool, splines: int = SPLINES) -> Fade:
    """The family that runs up into a periodic programme in `duration` s, or from it down to rest."""
    sign = 1.0 if up else -1.0
    x = t / duration if up else 1.0 - t / duration
    rate = sign / duration  # dx/dt
    w, w1, w2 = _step(x)
    to_programme = sign * duration * (x - 1.0)
    turn = 2.0 * np.pi * np.array(programme.winding) / programme.span  # rad/s
    mean, p, p1, p2 = _periodic(programme, to_programme)
    far = np.outer(sign * duration * (_step_integral(x) - 0.5), turn)
    s, s1, s2 = (y[:, None] for y in (w * w, 2.0 * w * w1 * rate, 2.0 * (w1 * w1 + w * w2) * rate**2))
    fixed = Angles(
        mean + far + s * p,
        np.outer(w, turn) + s * p1 + s1 * p,
        np.outer(w1 * rate, turn) + s * p2 + 2.0 * s1 * p1 + s2 * p,
    )
    basis = np.stack(
        [
            np.column_stack([start, inside]) * rate**k
            for k, (start, inside) in enumerate(zip((1.0 - w, -w1, -w2), _splines(splines, x), strict=True))
        ]
    )
    return Fade(t, fixed, basis)


def _step(x: Array) -> tuple[Array, Array, Array]:
    """w and its two derivatives by x."""
    return (
        x**3 * (10.0 - 15.0 * x + 6.0 * x**2),
        30.0 * x**2 * (1.0 - x) ** 2,
        60.0 * x * (1.0 - x) * (1.0 - 2.0 * x),
    )


def _step_integral(x: Array) -> Array:
    """Integral of w from 0 to x; 1/2 at x = 1."""
    return np.asarray(x**4 * (2.5 - 3.0 * x + x**2))


def _periodic(programme: Programme, t: Array) -> tuple[Array, Array, Array, Array]:
    """Mean (N), and the periodic part without it with two derivatives (M, N), at times t."""
    turn = 2.0 * np.pi * np.array(programme.winding) / programme.span
    period = programme.span * np.arange(256) / 256
    mean = (programme.at(period).phi - np.outer(period, turn)).mean(axis=0)
    at = programme.at(t)
    return mean, at.phi - np.outer(t, turn) - mean, at.phi_dot - turn, at.phi_ddot


def _splines(count: int, x: Array) -> tuple[Array, Array, Array]:
    """Quintic B-splines with their support inside 0..1, uniform knots, and two derivatives by x: (M, count) each."""
    knots = np.arange(-5.0, count + 11.0) / (count + 5)
    inside = np.eye(count + 10)[:, 5:-5]  # B-splines at the ends reach beyond them
    spline = BSpline(knots, inside, 5)
    return spline(x), spline.derivative(1)(x), spline.derivative(2)(x)
