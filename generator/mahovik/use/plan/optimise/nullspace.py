"""Steps to c(x) = 0 and along it: the shortest solution of the linear model of c, and a basis of its null space."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import qr, solve_triangular

from mahovik.use.plan.array import Array

SINGULAR = 1e-9
"""Part of the largest singular value below which one counts as zero."""
_DOUBTFUL = 1e-6
"""Part of the largest diagonal entry of R below which the singular values are computed."""


@dataclass(frozen=True, eq=False)
class Range:
    """Range of A (r, n): `least(c)` is the shortest x with A x = c, or nearly so; `null` (n, n - rank)."""

    _left: Array
    _right: Array
    _triangle: Array | None
    _values: Array
    null: Array

    @staticmethod
    def of(A: Array, null: bool = True) -> Range:
        """Range by QR of A^T; by singular values if rows depend on each other or outnumber the unknowns.

        null: whether its basis is needed; otherwise it may be missing.
        """
        r, n = A.shape
        if r <= n:
            Q, R = qr(A.T, mode="full" if null else "economic", check_finite=False)
            diagonal = np.abs(np.diag(R))
            if diagonal.size == 0 or diagonal.min() > _DOUBTFUL * diagonal.max():
                return Range(Q[:, :0], Q[:, :r], R[:r], diagonal, Q[:, r:])
        U, values, V = np.linalg.svd(A, full_matrices=True)
        rank = int(np.sum(values > SINGULAR * values[0])) if values.size else 0
        return Range(U[:, :rank], V[:rank].T, None, values[:rank], V[rank:].T)

    def least(self, c: Array) -> Array:
        """Shortest x (n) with A x = c (r)."""
        if self._triangle is not None:
            return np.asarray(self._right @ solve_triangular(self._triangle, c, trans="T", check_finite=False))
        return np.asarray(self._right @ ((self._left.T @ c) / self._values))

    def multipliers(self, g: Array) -> Array:
        """y (r) of the least-squares problem A^T y = g."""
        along = self._right.T @ g
        if self._triangle is not None:
            return np.asarray(solve_triangular(self._triangle, along, check_finite=False))
        return np.asarray(self._left @ (along / self._values))
