"""Splines for the angles of a finite motion: as smooth as the samples' own spline needs, and sorted by frequency.

The motion's q'' has kinks of its third derivative at the samples; phi'' needs the same kinks, so phi is four times
differentiable there and a polynomial between. Modes are those of a free beam in that space: the first is constant,
and each has a frequency; the search damps by it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline
from scipy.linalg import eigh, null_space

from mahovik.use.plan.array import Array
from mahovik.use.plan.fourier import Basis

_SMOOTH = 4
"""Derivatives that are continuous at the breaks."""
PINNED = 1e12
"""Order of a mode that must not move."""


@dataclass(frozen=True, eq=False)
class Modes(Basis):
    """The modes at M times; `order` (n): waves in the span of each."""

    order: Array

    @property
    def orders(self) -> Array:
        """Frequencies, in waves per span."""
        return self.order


@dataclass(frozen=True, eq=False)
class Space:
    """Splines of a degree on [0, span] with breaks (m + 1, s). Slope 0 at time 0; with `pinned` also value 0.

    The first mode is the constant 1 (if pinned, it is fixed); its coefficient is the mean angle of a motion.
    """

    span: float
    breaks: Array
    degree: int
    pinned: bool

    @property
    def multiplicity(self) -> int:
        """Multiplicity of the knots at inner breaks: new functions in each interval."""
        return self.degree - _SMOOTH

    @cached_property
    def _spline(self) -> BSpline:
        p, inner = self.degree, np.repeat(self.breaks[1:-1], self.multiplicity)
        knots = np.concatenate([np.full(p + 1, 0.0), inner, np.full(p + 1, self.span)])
        return BSpline(knots, np.eye(len(knots) - p - 1), p)

    def nodes(self, each: int, at_ends: int = 0) -> tuple[Array, Array]:
        """`each` Gauss points in every interval, `at_ends` more in the first and the last; and their weights (s)."""
        t, weights = [], []
        for k, (a, b) in enumerate(zip(self.breaks[:-1], self.breaks[1:], strict=True)):
            x, w = np.polynomial.legendre.leggauss(each + (at_ends if k in (0, len(self.breaks) - 2) else 0))
            t.append(a + (b - a) / 2.0 * (1.0 + x))
            weights.append((b - a) / 2.0 * w)
        return np.concatenate(t), np.concatenate(weights)

    @cached_property
    def _modes(self) -> tuple[Array, Array]:
        """Coefficients (n splines, modes) and order of each mode."""
        t, weight = self.nodes(self.degree + 1)
        value, second = self._spline(t), self._spline(t, 2)
        ends = [self._spline(0.0, 1)] + ([self._spline(0.0)] if self.pinned else [])
        allowed = null_space(np.array(ends))
        value, second = value @ allowed, second @ allowed
        mass, stiff = (x.T @ (weight[:, None] * x) for x in (value, second))
        squares, vectors = eigh(stiff, mass)
        order = np.maximum(squares, 0.0) ** 0.25 * self.span / (2.0 * np.pi)
        modes = allowed @ vectors * np.sqrt(self.span / 2.0)
        constant = np.ones((len(allowed), 1))
        if self.pinned:
            return np.hstack([constant, modes]), np.concatenate([[PINNED], order])
        return np.hstack([constant, modes[:, 1:]]), np.concatenate([[0.0], order[1:]])

    @property
    def size(self) -> int:
        """Number of modes."""
        return len(self._modes[1])

    def modes(self, t: Array, n: int | None = None) -> Modes:
        """The first n modes (default all) at times t (M, s) in [0, span]."""
        coefficients, order = self._modes
        B = [np.asarray(self._spline(t, m) @ coefficients[:, :n]) for m in range(3)]
        return Modes(self.span, t, B[0], B[1], B[2], order[:n])

    def convert(self, waves: Array, other: Space) -> Array:
        """Coefficients (N, size) here of the function with `waves` (N, n) in a space of lower degree or fewer modes."""
        t, weight = self.nodes(self.degree + 1)
        root = np.sqrt(weight)[:, None]
        theirs = other.modes(t, waves.shape[1]).value @ waves[:, :].T
        first = waves[:, :1]
        left = root * (theirs - first.T)
        rest = np.linalg.lstsq(root * self.modes(t).value[:, 1:], left, rcond=None)[0]
        return np.hstack([first, rest.T])
