"""Functions of time that motions of flywheels are sums of: harmonics of a period, modes of splines over a duration.

The q'' of a finite motion has kinks of its third derivative at the samples; phi'' needs the same kinks, so phi is four
times differentiable there and a polynomial between. Modes are those of a free beam in that space: the first is
constant, and each has a frequency; the search damps by it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline
from scipy.linalg import eigh, null_space

from mahovik.core.motion.functions import Samples
from mahovik.use.numeric.se3 import Array

_SMOOTH = 4
"""Derivatives that are continuous at the breaks."""
PINNED_ORDER = 1e12
"""Order of a mode that must not move."""


@dataclass(frozen=True, eq=False)
class Basis:
    """n functions at M times t (s), with two derivatives: (M, n) each; the first function is 1.

    orders  (n): waves of each function in the period or duration
    """

    t: Array
    value: Array
    first: Array
    second: Array
    orders: Array

    @property
    def matrices(self) -> tuple[Array, Array, Array]:
        """Matrices from the waves of one flywheel to its phi, phi', phi''."""
        return self.value, self.first, self.second

    def chain(self, by_phi: Array, by_phi_dot: Array, by_phi_ddot: Array) -> Array:
        """Derivatives by the waves (R M, N n) of R rows per time, from derivatives (M, R, N) by the angles."""
        M, R, N = by_phi.shape
        local = np.stack([by_phi, by_phi_dot, by_phi_ddot], axis=-1).reshape(M, R * N, 3)
        result = local @ np.stack(self.matrices, axis=1)
        return result.reshape(M * R, N * len(self.orders))


def harmonics(period: float, n: int, t: Array) -> Basis:
    """The first n of 1, cos, sin, cos 2, sin 2, ... of a period (s), at times t (M, s)."""
    k = np.arange(1, n // 2 + 1)
    Omega = 2.0 * np.pi / period * k
    c, s = np.cos(np.outer(t, Omega)), np.sin(np.outer(t, Omega))

    def columns(mean: float, cos: Array, sin: Array) -> Array:
        return np.hstack([np.full((len(t), 1), mean), np.stack([cos, sin], axis=2).reshape(len(t), -1)])

    value, first = columns(1.0, c, s), columns(0.0, -s * Omega, c * Omega)
    second = columns(0.0, -c * Omega**2, -s * Omega**2)
    return Basis(t, value, first, second, np.concatenate([[0.0], np.repeat(k.astype(np.float64), 2)]))


@dataclass(frozen=True, eq=False)
class SplineSpace:
    """Splines of a degree on [0, span] with breaks (m + 1, s). Slope 0 at time 0; with `pinned` also value 0.

    The first mode is the constant 1 (if pinned, it is fixed); its coefficient is the mean angle of a motion.
    """

    span: float
    breaks: Array
    degree: int
    pinned: bool

    @cached_property
    def _spline(self) -> BSpline:
        p, inner = self.degree, np.repeat(self.breaks[1:-1], self.degree - _SMOOTH)
        knots = np.concatenate([np.full(p + 1, 0.0), inner, np.full(p + 1, self.span)])
        return BSpline(knots, np.eye(len(knots) - p - 1), p)

    def nodes(self, count: int, at_ends: int = 0) -> tuple[Array, Array]:
        """`count` Gauss points in every interval, `at_ends` more in the first and the last; and their weights (s)."""
        t, weights = [], []
        for k, (a, b) in enumerate(zip(self.breaks[:-1], self.breaks[1:], strict=True)):
            x, w = np.polynomial.legendre.leggauss(count + (at_ends if k in (0, len(self.breaks) - 2) else 0))
            t.append(a + (b - a) / 2.0 * (1.0 + x))
            weights.append((b - a) / 2.0 * w)
        return np.concatenate(t), np.concatenate(weights)

    def even_times(self, count: int, first: float = 0.0) -> Array:
        """`count` times in every interval, the first at this part of a step."""
        inside = (np.arange(count) + first) / count
        return np.asarray((self.breaks[:-1, None] + np.diff(self.breaks)[:, None] * inside).ravel())

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
            return np.hstack([constant, modes]), np.concatenate([[PINNED_ORDER], order])
        return np.hstack([constant, modes[:, 1:]]), np.concatenate([[0.0], order[1:]])

    @property
    def size(self) -> int:
        """Number of modes."""
        return len(self._modes[1])

    def modes(self, t: Array, n: int | None = None) -> Basis:
        """The first n modes (default all) at times t (M, s) in [0, span]."""
        coefficients, orders = self._modes
        B = [np.asarray(self._spline(t, m) @ coefficients[:, :n]) for m in range(3)]
        return Basis(t, B[0], B[1], B[2], orders[:n])

    def convert(self, waves: Array, other: SplineSpace) -> Array:
        """Coefficients (N, size) here of the function with `waves` (N, n) in a space of lower degree or fewer modes."""
        t, _ = self.nodes(self.degree + 1)
        return self._fit(other.modes(t, waves.shape[1]).value @ waves.T, waves[:, :1])

    def fit(self, table: Samples) -> Array:
        """Coefficients (N, size) nearest to the angles of a table, less its start speed."""
        t, _ = self.nodes(self.degree + 1)
        angles = table.at(t).phi - t[:, None] * table.phi_dot[0]
        return self._fit(angles, table.phi[0][:, None] if self.pinned else None)

    def _fit(self, angles: Array, first: Array | None) -> Array:
        """Coefficients of angles at the nodes; `first` (N, 1): that of the first mode, where it is known."""
        t, weight = self.nodes(self.degree + 1)
        root, value, known = np.sqrt(weight)[:, None], self.modes(t).value, 0
        if first is not None:
            angles, known = angles - first.T, 1
        rest = np.linalg.lstsq(root * value[:, known:], root * angles, rcond=None)[0].T
        return np.asarray(rest if first is None else np.hstack([first, rest]))
