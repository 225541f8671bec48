"""Functions of several phases at once: trigonometric polynomials on a torus, sampled at the nodes of a lattice rule.

A motion with speeds in no whole ratio is y(t) = sum_k y_k exp(i k . theta(t)), theta_s = phi_s' t + phi_s(0), k whole
numbers, one per flywheel that turns. A rank-1 lattice samples it at theta_j = 2 pi j z / M, j = 0 .. M - 1: there
k . theta_j is the harmonic k . z mod M of one periodic function, so that one FFT finds all coefficients. Source: L.
Kaemmerer, Multiple rank-1 lattices as sampling schemes for multivariate trigonometric polynomials (2018), section 2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from math import comb

import numpy as np
from numpy.typing import NDArray

from mahovik.errors import CheckError
from mahovik.use.numeric.se3 import Array, Complex

Whole = NDArray[np.int64]
Flags = NDArray[np.bool_]

MOST_NODES = 40_000
"""Most nodes of a lattice: time and memory grow in proportion."""

BEYOND = 2
"""Orders above the kept ones that stay apart from them at the nodes: products of kept terms would else pass for slow
beats, whose displacement is their acceleration by the square of a low frequency."""

TRIES = 200
"""Generators tried per number of nodes."""


def odd_length(least: int) -> int:
    """The next number of nodes with only the factors 3, 5, 7: odd, and fast to transform."""
    M = least | 1
    while _rest(M) > 1:
        M += 2
    return M


def _rest(M: int) -> int:
    for factor in (3, 5, 7):
        while M % factor == 0:
            M //= factor
    return M


@dataclass(frozen=True, eq=False)
class Torus:
    """Index set and lattice of `count` phases.

    k      (n, count) whole numbers: one of k and -k, the zero first; by size, then in order
    z, M   generator (count) and number of nodes, odd; k . z differ mod M for all k and -k,
           and from those of BEYOND higher orders
    """

    k: Whole
    z: Whole
    M: int

    @staticmethod
    def of(count: int, order: int) -> Torus:
        """All k with |k_1| + |k_2| + ... <= order. Raises CheckError: too many nodes."""
        torus = _torus(count, order)
        if torus is None:
            raise CheckError(
                f"{count} flywheels turn: order {order} needs more than {MOST_NODES} phases; lower the order"
            )
        return torus

    @property
    def count(self) -> int:
        """Number of phases."""
        return int(self.k.shape[1])

    def angles(self, turns: Whole) -> Array:
        """Angles (M, N; rad) at the nodes that turn by whole numbers of times (N, count) with the phases."""
        return np.asarray(2.0 * np.pi * (np.outer(np.arange(self.M), turns @ self.z) % self.M) / self.M)

    def _places(self) -> tuple[Whole, Flags]:
        """Harmonic in 0 .. M // 2 of every k, and whether it is that of -k."""
        b = self.k @ self.z % self.M
        mirrored = b > self.M // 2
        return np.where(mirrored, self.M - b, b), mirrored

    def values(self, c: Complex) -> Array:
        """Values (M, ...) at the nodes of coefficients c (n, ...): the real part of sum c_k exp(i k . theta)."""
        bins, mirrored = self._places()
        spectrum = np.zeros((self.M // 2 + 1, *c.shape[1:]), dtype=np.complex128)
        spectrum[bins] = np.where(mirrored.reshape(-1, *(1,) * (c.ndim - 1)), c.conj(), c) / 2.0
        spectrum[0] = c[0].real
        return np.asarray(np.fft.irfft(spectrum * self.M, self.M, axis=0))

    def coefficients(self, values: Array) -> Complex:
        """Coefficients (n, ...) of values (M, ...) at the nodes; the first is the mean."""
        bins, mirrored = self._places()
        result = np.fft.rfft(values, axis=0)[bins] * (2.0 / self.M)
        result = np.where(mirrored.reshape(-1, *(1,) * (values.ndim - 1)), result.conj(), result)
        result[0] = result[0].real / 2.0
        return np.asarray(result)

    def pad(self, c: Complex) -> Complex:
        """Coefficients (n, ...) from those of a smaller order: indices are sorted by size."""
        return np.concatenate([c, np.zeros((len(self.k) - len(c), *c.shape[1:]), dtype=np.complex128)])

    def at(self, c: Complex, theta: Array) -> Array:
        """Values (m, ...) at phases theta (m, count; rad)."""
        wave = np.exp(1j * (theta @ self.k.T))
        return np.asarray(np.tensordot(wave, c, axes=1).real)


def indices(count: int, order: int) -> Whole:
    """One of k and -k (n, count) with the sum of |k_s| at most `order`, the zero first, then by size."""
    result = [(0,) * count]
    for size in range(1, order + 1 if count else 1):
        result += sorted(_of_size(count, size), reverse=True)
    return np.array(result, dtype=np.int64).reshape(len(result), count)


def index_count(count: int, order: int) -> int:
    """Number of `indices`, without making them: over the phases that take part, their sizes and signs."""
    both = sum(comb(count, j) * comb(order, j) * 2**j for j in range(min(count, order) + 1))
    return int(both + 1) // 2


def _of_size(count: int, size: int) -> list[tuple[int, ...]]:
    """All k of this size whose first number that is not zero is positive."""

    def shares(places: int, left: int) -> list[tuple[int, ...]]:
        if places == 1:
            return [(left,)]
        return [(first, *rest) for first in range(left + 1) for rest in shares(places - 1, left - first)]

    result = []
    for share in shares(count, size):
        at = [i for i, x in enumerate(share) if x]
        for signs in product((1, -1), repeat=len(at) - 1):
            one = list(share)
            for i, sign in zip(at[1:], signs, strict=True):
                one[i] *= sign
            result.append(tuple(one))
    return result


@lru_cache(maxsize=32)
def _torus(count: int, order: int) -> Torus | None:
    """None: too many nodes. Numbers of nodes that are fast to transform come first, then any odd ones."""
    least = 2 * index_count(count, order + BEYOND // 2) - 1  # fewer cannot be enough: all these differ too
    if least > MOST_NODES:
        return None
    k = indices(count, order)
    beyond = indices(count, order + BEYOND)[len(k) :].astype(np.float64)  # a product of floats is the fast one
    for next_odd in (odd_length, lambda least: least | 1):
        rng = np.random.default_rng(count * 1000 + order)
        M = next_odd(least)
        while M <= MOST_NODES:
            for z in _generators(count, M, rng):
                if _differ(k, z, M) and _differ_from(beyond, k, z, M):
                    return Torus(k, z, M)
            M = next_odd(int(M * 1.15))
    return None


def _differ(k: Whole, z: Whole, M: int) -> bool:
    """Whether the harmonics of all k and -k differ."""
    b = k @ z % M
    taken = np.zeros(M, dtype=bool)
    taken[b] = taken[-b] = True
    return int(np.count_nonzero(taken)) == 2 * len(b) - 1


def _differ_from(beyond: Array, k: Whole, z: Whole, M: int) -> bool:
    """Whether the harmonics of k and -k differ from those of `beyond`."""
    taken = np.zeros(M, dtype=bool)
    b = k @ z % M
    taken[b] = taken[-b] = True
    return not taken[(beyond @ z.astype(np.float64) % M).astype(np.int64)].any()


def _generators(count: int, M: int, rng: np.random.Generator) -> Whole:
    """Generators (TRIES, count): powers of one number, which are often good, then random ones."""
    powers = np.ones((TRIES // 2, count), dtype=np.int64)
    first = rng.integers(2, max(M - 1, 3), TRIES // 2)
    for i in range(1, count):
        powers[:, i] = powers[:, i - 1] * first % M
    return np.asarray(np.concatenate([powers, rng.integers(1, M, (TRIES // 2, count))]))
