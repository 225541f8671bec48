"""Unknowns of a periodic programme: Fourier coefficients of the angles, and the free part of the bias.

phi_s(t) = 2 pi n_s t/T + mean_s + sum_k cos_sk cos(2 pi k t/T) + sin_sk sin(2 pi k t/T), k = 1..H.

As a vector: for each flywheel mean, cos_1 .. cos_H, sin_1 .. sin_H; then the free components of the bias.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from mahovik.use.plan.array import Array


class Angles(NamedTuple):
    """Angles, speeds, accelerations of the flywheels (M, N each; rad, s)."""

    phi: Array
    phi_dot: Array
    phi_ddot: Array


@dataclass(frozen=True, eq=False)
class Periodic:
    """A periodic flywheel motion with its bias: the unknowns of the search.

    period   T, s
    winding  (N,) turns per period
    waves    (N, 2H + 1): mean, cosines, sines of each flywheel, rad
    bias     (6; m, rad)
    """

    period: float
    winding: Array
    waves: Array
    bias: Array

    @property
    def N(self) -> int:
        """Number of flywheels."""
        return len(self.waves)

    @property
    def H(self) -> int:
        """Highest harmonic."""
        return int(self.waves.shape[1]) // 2

    def with_harmonics(self, H: int) -> Periodic:
        """The same motion with H harmonics: new ones are zero, those above H are dropped."""
        wide = np.zeros((self.N, 2 * H + 1))
        kept = min(H, self.H)
        wide[:, : kept + 1] = self.waves[:, : kept + 1]
        wide[:, H + 1 : H + 1 + kept] = self.waves[:, self.H + 1 : self.H + 1 + kept]
        return replace(self, waves=wide)

    def moved(self, step: Array, free: Array) -> Periodic:
        """The motion after a step of the unknowns; `free` (6, bool): which components of the bias are unknowns."""
        n = self.waves.size
        bias = self.bias.copy()
        bias[free] += step[n:]
        return replace(self, waves=self.waves + step[:n].reshape(self.waves.shape), bias=bias)

    def at(self, basis: Basis) -> Angles:
        """Angles at the times of the basis."""
        rate = 2.0 * np.pi / self.period * self.winding
        phi, phi_dot, phi_ddot = ((B @ self.waves.T) for B in basis.of_each)
        return Angles(phi + basis.t[:, None] * rate, phi_dot + rate, phi_ddot)

    @property
    def mean(self) -> Array:
        """Mean angles (N,), rad."""
        return self.waves[:, 0]

    @property
    def cos(self) -> Array:
        """Cosine amplitudes (H, N), rad, in the layout of the programme file."""
        return self.waves[:, 1 : self.H + 1].T

    @property
    def sin(self) -> Array:
        """Sine amplitudes (H, N), rad."""
        return self.waves[:, self.H + 1 :].T


@dataclass(frozen=True, eq=False)
class Basis:
    """1, cosines, sines of harmonics 1..H at M times, with two derivatives: (M, 2H + 1) each."""

    period: float
    t: Array
    value: Array
    first: Array
    second: Array

    @property
    def of_each(self) -> tuple[Array, Array, Array]:
        """Matrices from the waves of one flywheel to its phi, phi', phi''."""
        return self.value, self.first, self.second

    @property
    def orders(self) -> Array:
        """Harmonic of each unknown of a flywheel (2H + 1)."""
        H = self.value.shape[1] // 2
        return np.concatenate([[0.0], np.arange(1.0, H + 1), np.arange(1.0, H + 1)])

    @staticmethod
    def of(period: float, H: int, t: Array) -> Basis:
        """The basis of harmonics up to H at times t (M, s)."""
        k = np.arange(1, H + 1)
        Omega = 2.0 * np.pi / period * k
        c, s = np.cos(np.outer(t, Omega)), np.sin(np.outer(t, Omega))
        one, none = np.ones((len(t), 1)), np.zeros((len(t), 1))
        return Basis(
            period,
            t,
            np.hstack([one, c, s]),
            np.hstack([none, -s * Omega, c * Omega]),
            np.hstack([none, -c * Omega**2, -s * Omega**2]),
        )

    def chain(self, by_phi: Array, by_phi_dot: Array, by_phi_ddot: Array) -> Array:
        """Derivatives by the waves (R M, N (2H + 1)) of R rows per time, from derivatives (M, R, N) by the angles."""
        M, R, N = by_phi.shape
        local = np.stack([by_phi, by_phi_dot, by_phi_ddot], axis=-1).reshape(M, R * N, 3)
        found = local @ np.stack([self.value, self.first, self.second], axis=1)
        return found.reshape(M * R, N * self.value.shape[1])


def uniform(period: float, M: int, shift: float = 0.0) -> Array:
    """M times of one period; `shift` (in intervals) is the first one."""
    return np.asarray((np.arange(M) + shift) * (period / M))
