"""Functions of several phases at once: trigonometric polynomials on a torus, sampled at the nodes of a lattice rule.

Equations y' = rate(y) of such functions are solved by Newton's method; its linear equations by GMRES, preconditioned by
their mean over all phases.

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
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, gmres

from mahovik.errors import CheckError
from mahovik.use.numeric.se3 import Array, Complex

Whole = NDArray[np.int64]
Flags = NDArray[np.bool_]

MOST_NODES = 40_000
"""Most nodes of a lattice: time and memory grow in proportion."""

BEYOND = 2
"""Orders above the kept ones that stay apart from them at the nodes: products of kept terms would else pass for slow
beats, whose displacement is their acceleration by the square of a low frequency."""

ACCURATE = 1e-9
"""Accuracy of GMRES in one step of Newton's method."""

RESTART, ROUNDS = 40, 5

TRIES = 200
"""Generators tried per number of nodes."""

STEPS = 20
"""Most steps of Newton's method."""

SETTLED = 1e-11
"""Relative size of a last step."""

SMALL = 0.01
"""Part of a settled step that its linear equations may be off: more accuracy changes nothing."""

SAME = 0.1
"""The linear equations serve for further steps as long as each step is at most this part of the one before."""


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


@dataclass(frozen=True, eq=False)
class Linearised:
    """i w_k dc_k - [J dy + push dh]_k = r_k, with free . dc_k = - free . c_k for constant k; unknown dc, dh.

    J (M, m, m), push (M, m, f) at the nodes; free (f, m); w (n, rad/s); slow: the constant k; size (m).
    """

    torus: Torus
    J: Array
    push: Array
    free: Array
    w: Array
    slow: Whole
    size: Array

    def solve(self, r: Complex, c: Complex, enough: float = 0.0) -> tuple[Complex, Complex] | None:
        """dc (n, m), dh (n, f); None if the equations are singular, at an undamped resonance.

        `enough`: error of dc, in units of `size`, below which no more accuracy is wanted.
        """
        n, (f, m) = len(self.w), self.free.shape
        inverse = self.inverse(self.w, self.slow)
        if inverse is None:
            return None
        slow = np.zeros(n, dtype=bool)
        slow[self.slow] = True

        def pack(result: Complex) -> Array:
            scaled = result / np.concatenate([self.size, np.ones(f)])
            return np.concatenate([scaled.real.ravel(), scaled.imag.ravel()])

        def unpack(x: Array) -> Complex:
            half = len(x) // 2
            result = (x[:half] + 1j * x[half:]).reshape(n, m + f)
            result[0] = result[0].real
            return np.asarray(result * np.concatenate([self.size, np.ones(f)]))

        def back(right: Complex) -> Array:
            result = (inverse @ right[:, :, None])[:, :, 0]
            result[0] = result[0].real
            return pack(result)

        def forward(x: Array) -> Array:
            result = unpack(x)
            dc, dh = result[:, :m], np.where(slow[:, None], result[:, m:], 0.0)
            dy, at = self.torus.values(dc), self.torus.values(dh)
            moved = (self.J @ dy[:, :, None])[:, :, 0] + (self.push @ at[:, :, None])[:, :, 0]
            left = 1j * self.w[:, None] * dc - self.torus.coefficients(moved)
            last = np.where(slow[:, None], dc @ self.free.T, result[:, m:])
            return back(np.concatenate([left, last], axis=1))

        last = np.where(slow[:, None], -c @ self.free.T, 0.0)
        count = 2 * n * (m + f)
        operator = LinearOperator((count, count), matvec=forward, dtype=np.float64)
        right = back(np.concatenate([r, last], axis=1))
        x, missed = gmres(operator, right, rtol=ACCURATE, atol=enough, restart=RESTART, maxiter=ROUNDS)
        if missed or not np.all(np.isfinite(x)):
            return None
        result = unpack(x)
        return result[:, :m], np.where(slow[:, None], result[:, m:], 0.0)

    def inverse(self, w: Array, slow: Whole) -> Complex | None:
        """Inverses (n, m + f, m + f) of the mean equations at any w (n; rad/s), h unknown at `slow`; None: singular."""
        n, (f, m) = len(w), self.free.shape
        A = np.zeros((n, m + f, m + f), dtype=np.complex128)
        A[:, :m, :m] = -self.J.mean(axis=0)
        A[:, range(m), range(m)] += 1j * w[:, None]
        A[:, range(m, m + f), range(m, m + f)] = 1.0
        A[slow, m:, m:] = 0.0
        A[slow, :m, m:], A[slow, m:, :m] = -self.push.mean(axis=0), self.free
        try:
            result = np.asarray(np.linalg.inv(A), dtype=np.complex128)
        except np.linalg.LinAlgError:
            return None
        return result if np.all(np.isfinite(result)) else None


class Equations(Protocol):
    """y' = rate(y, h): y a state (m), h numbers (f) that are constant on the torus, where a direction is free.

    free   (f, m): displacement along these directions from a state
    size   (m): natural sizes of the numbers of a state
    """

    @property
    def free(self) -> Array:
        """See above."""

    @property
    def size(self) -> Array:
        """See above."""

    def rate(self, y: Array, h: Array) -> Array:
        """(M, m) at the nodes."""

    def slopes(self, y: Array, h: Array) -> tuple[Array, Array]:
        """Derivatives (M, m, m) by y and (M, m, f) by h."""

    def is_lost(self, y: Array) -> bool:
        """Whether states are beyond what the coordinates reach."""


class Solved(NamedTuple):
    """States c (n, m), constant numbers h (n, f) on a torus, and the last linear equations."""

    c: Complex
    h: Complex
    linear: Linearised


def newton(
    equations: Equations, torus: Torus, w: Array, slow: Whole, start: tuple[Complex, Complex],
    least: Array, rounding: Array,
) -> Solved | None:  # fmt: skip
    """The solution at frequencies w (n; rad/s), constant at `slow`, from a guess of c and h. None: there is none near.

    least      (n): size of a step, in units of `size`, that is rounding; rounding (m): likewise of a rate
    """
    (c, h), size, linear, before = start, equations.size, None, np.inf
    for _ in range(STEPS):
        y, at = torus.values(c), torus.values(h)
        if not np.all(np.isfinite(y)) or equations.is_lost(y):
            return None
        left = torus.coefficients(equations.rate(y, at)) - 1j * w[:, None] * c
        if linear is not None and np.all(np.abs(left) <= rounding):
            return Solved(c, h, linear)
        if linear is None:
            linear = Linearised(torus, *equations.slopes(y, at), equations.free, w, slow, size)
        enough = SMALL * float((SETTLED * np.abs(c / size).max(initial=0.0) + least).min())
        step = linear.solve(left, c, enough)
        if step is None:
            return None
        c, h = c + step[0], h + step[1]
        change = np.abs(step[0] / size).max(axis=1, initial=0.0)
        if np.all(change <= SETTLED * np.abs(c / size).max(initial=0.0) + least):
            return Solved(c, h, linear)
        if change.max() > SAME * before:  # the linear equations of an earlier step help little here
            linear = None
        before = change.max()
    return None
