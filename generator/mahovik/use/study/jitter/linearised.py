"""Linear equations of a step of Newton's method on a torus: GMRES, preconditioned by their mean over all phases."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import LinearOperator, gmres

from mahovik.use.plan.array import Array, Complex
from mahovik.use.study.jitter.torus import Torus, Whole

ACCURATE = 1e-9
"""Accuracy of GMRES in one step of Newton's method."""

RESTART, ROUNDS = 40, 5


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

        def pack(found: Complex) -> Array:
            scaled = found / np.concatenate([self.size, np.ones(f)])
            return np.concatenate([scaled.real.ravel(), scaled.imag.ravel()])

        def unpack(x: Array) -> Complex:
            half = len(x) // 2
            found = (x[:half] + 1j * x[half:]).reshape(n, m + f)
            found[0] = found[0].real
            return np.asarray(found * np.concatenate([self.size, np.ones(f)]))

        def back(right: Complex) -> Array:
            found = (inverse @ right[:, :, None])[:, :, 0]
            found[0] = found[0].real
            return pack(found)

        def forward(x: Array) -> Array:
            found = unpack(x)
            dc, dh = found[:, :m], np.where(slow[:, None], found[:, m:], 0.0)
            dy, at = self.torus.values(dc), self.torus.values(dh)
            moved = (self.J @ dy[:, :, None])[:, :, 0] + (self.push @ at[:, :, None])[:, :, 0]
            left = 1j * self.w[:, None] * dc - self.torus.coefficients(moved)
            last = np.where(slow[:, None], dc @ self.free.T, found[:, m:])
            return back(np.concatenate([left, last], axis=1))

        last = np.where(slow[:, None], -c @ self.free.T, 0.0)
        count = 2 * n * (m + f)
        operator = LinearOperator((count, count), matvec=forward, dtype=np.float64)
        right = back(np.concatenate([r, last], axis=1))
        x, missed = gmres(operator, right, rtol=ACCURATE, atol=enough, restart=RESTART, maxiter=ROUNDS)
        if missed or not np.all(np.isfinite(x)):
            return None
        found = unpack(x)
        return found[:, :m], np.where(slow[:, None], found[:, m:], 0.0)

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
            found = np.asarray(np.linalg.inv(A), dtype=np.complex128)
        except np.linalg.LinAlgError:
            return None
        return found if np.all(np.isfinite(found)) else None
