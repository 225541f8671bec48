"""Direct collocation on [0, span]: intervals, Gauss nodes, and the matrices for derivatives and continuity.

On every interval the states are polynomials of degree d through its start and d nodes. A state is a row with a
column for the start and for each node of every interval, and a last one for the end of the span.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_diag, coo_matrix, csc_matrix, hstack

from mahovik.use.plan.array import Array


@dataclass(frozen=True, eq=False)
class Mesh:
    """Breaks (K + 1, from 0 to 1, in parts of the span) and degree d: M = K d nodes, K (d + 1) + 1 columns."""

    breaks: Array
    degree: int

    @staticmethod
    def uniform(K: int, degree: int) -> Mesh:
        """K intervals of equal length."""
        return Mesh(np.linspace(0.0, 1.0, K + 1), degree)

    @property
    def K(self) -> int:
        """Number of intervals."""
        return len(self.breaks) - 1

    @property
    def columns(self) -> int:
        """Number of columns of a state."""
        return self.K * (self.degree + 1) + 1

    @cached_property
    def _local(self) -> tuple[Array, Array]:
        """Gauss points in (0, 1) (d), and their weights, whose sum is 1."""
        x, w = np.polynomial.legendre.leggauss(self.degree)
        return (1.0 + x) / 2.0, w / 2.0

    @property
    def widths(self) -> Array:
        """Widths (K,) of the intervals."""
        return np.diff(self.breaks)

    @property
    def nodes(self) -> Array:
        """Times (M,) of the nodes."""
        return np.asarray((self.breaks[:-1, None] + self.widths[:, None] * self._local[0]).ravel())

    @property
    def weights(self) -> Array:
        """Weights (M,) of the nodes in a mean over the span; their sum is 1."""
        return np.asarray((self.widths[:, None] * self._local[1]).ravel())

    @property
    def times(self) -> Array:
        """Times (columns,) of all columns."""
        local = np.concatenate([[0.0], self._local[0]])
        return np.append((self.breaks[:-1, None] + self.widths[:, None] * local).ravel(), 1.0)

    @property
    def at_nodes(self) -> NDArray[np.intp]:
        """Columns (M,) of the nodes."""
        return np.asarray([k * (self.degree + 1) + j for k in range(self.K) for j in range(1, self.degree + 1)])

    def _basis(self, x: Array, order: int = 0) -> Array:
        """(len(x), d + 1): derivatives at local times x of the Lagrange polynomials of start and nodes."""
        knots = np.concatenate([[0.0], self._local[0]])
        found = np.empty((len(x), len(knots)))
        for j, knot in enumerate(knots):
            others = np.delete(knots, j)
            polynomial = np.poly1d(np.poly(others) / np.prod(knot - others))
            found[:, j] = np.polyval(np.polyder(polynomial, order) if order else polynomial, x)
        return found

    @cached_property
    def derive(self) -> csc_matrix:
        """(columns, M): a state times this is its derivative at the nodes, for a span of 1."""
        local = self._basis(self._local[0], 1).T
        return _with_end(csc_matrix(block_diag([local / h for h in self.widths])))

    @cached_property
    def jumps(self) -> csc_matrix:
        """(columns, K): a state times this is the jump between each interval's start and the end of the one before.

        The last entry is the column of the end.
        """
        ends = _with_end(csc_matrix(block_diag([self._basis(np.ones(1)).T] * self.K)))
        start = (np.arange(self.K) + 1) * (self.degree + 1)
        one = coo_matrix((np.ones(self.K), (start, np.arange(self.K))), shape=(self.columns, self.K))
        return csc_matrix(ends - one)

    def interpolate(self, x: Array, order: int = 0) -> Array:
        """(len(x), columns): values, or derivatives by parts of the span, at times x in [0, 1]."""
        k = np.clip(np.searchsorted(self.breaks, x, side="right") - 1, 0, self.K - 1)
        local = self._basis((x - self.breaks[k]) / self.widths[k], order) / self.widths[k][:, None] ** order
        found = np.zeros((len(x), self.columns))
        columns = k[:, None] * (self.degree + 1) + np.arange(self.degree + 1)
        np.put_along_axis(found, columns, local, axis=1)
        return found


def _with_end(matrix: csc_matrix) -> csc_matrix:
    """The matrix with one more row of zeros, for the end of the last interval."""
    return csc_matrix(hstack([matrix.T, csc_matrix((matrix.shape[1], 1))]).T)
