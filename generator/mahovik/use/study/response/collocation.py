"""Periodic solutions of ordinary differential equations by Fourier collocation: Newton's method, GMRES inside.

y at 2 H + 1 uniform nodes is a trigonometric polynomial of H harmonics. The linear equations are preconditioned by
their mean over the period, harmonic by harmonic; what varies in it is small where unbalance is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, gmres

Array = NDArray[np.float64]

ACCURATE = 1e-7
"""Accuracy of GMRES in one step of Newton's method."""

RESTART, ROUNDS = 60, 5


def derivative(y: Array, base: float) -> Array:
    """dy/dt at the nodes (M odd, ...), base: 2 pi / period (rad/s)."""
    M = len(y)
    spectrum = np.fft.rfft(y, axis=0)
    k = np.arange(len(spectrum)).reshape(-1, *(1,) * (y.ndim - 1))
    return np.asarray(np.fft.irfft(1j * base * k * spectrum, M, axis=0))


@dataclass(frozen=True, eq=False)
class Linearised:
    """dy' = J dy + push dh + r with conditions: seen . mean(dy) = c. The unknowns are dy (M, n) and dh (f).

    J (M, n, n); push (M, n, f): effect of the constant numbers h on y'; seen (f, n); base: rad/s;
    size (n): scales of the unknowns.
    """

    J: Array
    push: Array
    seen: Array
    base: float
    size: Array

    def solve(self, r: Array, c: Array) -> tuple[Array, Array] | None:
        """dy, dh; None if the equations are singular, at an undamped resonance."""
        M, n = r.shape
        f = len(c)
        inverse = self._inverse(M)
        if inverse is None:
            return None

        def pack(dy: Array, dh: Array) -> Array:
            return np.concatenate([(dy / self.size).ravel(), dh])

        def back(r: Array, c: Array) -> Array:
            spectrum = np.fft.rfft(r, axis=0).astype(np.complex128)
            right = np.concatenate([spectrum, np.zeros((len(spectrum), f))], axis=1)
            right[0, n:] = M * c
            found = (inverse @ right[:, :, None])[:, :, 0]
            return pack(np.fft.irfft(found[:, :n], M, axis=0), found[0, n:].real / M)

        def forward(x: Array) -> Array:
            dy, dh = x[: M * n].reshape(M, n) * self.size, x[M * n :]
            left = derivative(dy, self.base) - (self.J @ dy[:, :, None])[:, :, 0] - self.push @ dh
            return back(left, self.seen @ dy.mean(axis=0))

        count = M * n + f
        operator = LinearOperator((count, count), matvec=forward, dtype=np.float64)
        x, missed = gmres(operator, back(r, c), rtol=ACCURATE, atol=0.0, restart=RESTART, maxiter=ROUNDS)
        if missed or not np.all(np.isfinite(x)):
            return None
        return x[: M * n].reshape(M, n) * self.size, x[M * n :]

    def _inverse(self, M: int) -> NDArray[np.complex128] | None:
        """Inverses (H + 1, n + f, n + f) of the mean equations, one per harmonic; constants h belong to the zeroth."""
        n, f = self.J.shape[1], len(self.seen)
        k = np.arange(M // 2 + 1)
        A = np.zeros((len(k), n + f, n + f), dtype=np.complex128)
        A[:, :n, :n] = -self.J.mean(axis=0)
        A[:, range(n), range(n)] += 1j * self.base * k[:, None]
        A[0, :n, n:], A[0, n:, :n] = -self.push.mean(axis=0), self.seen
        A[1:, range(n, n + f), range(n, n + f)] = 1.0
        try:
            found = np.asarray(np.linalg.inv(A), dtype=np.complex128)
        except np.linalg.LinAlgError:
            return None
        return found if np.all(np.isfinite(found)) else None


def resample(y: Array, M: int) -> Array:
    """The same trigonometric polynomial at M nodes (odd), without its highest harmonics if M is smaller."""
    spectrum = np.fft.rfft(y, axis=0)
    H = min(len(spectrum), M // 2 + 1)
    return np.asarray(np.fft.irfft(spectrum[:H], M, axis=0) * (M / len(y)))


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
