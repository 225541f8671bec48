"""Structure of an IPOPT problem: its mesh, its unknowns, and its rows g = A z + B y, y the values of all nodes.

Direct collocation: on every interval the states are polynomials of degree d through its start and d Gauss nodes. A
state is a row with a column for the start and for each node of every interval, and a last one for the end of the span.

Unknowns z: the states x (2N) at all columns of the mesh, the controls u at its nodes, the change of the bias (6;
of a held carrier a number for each freedom), the mean of each swing (N). A and B are constant; the bounds of the rows
are given at each run.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mahovik.use.numeric import Array


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
    def derive(self) -> Array:
        """(columns, M): a state times this is its derivative at the nodes, for a span of 1."""
        return self.interpolate(self.nodes, 1).T

    @cached_property
    def jumps(self) -> Array:
        """(columns, K): a state times this is the jump between each interval's start and the end of the one before.

        The last entry is the column of the end.
        """
        found, ends = np.zeros((self.columns, self.K)), self._basis(np.ones(1))[0]
        for k in range(self.K):
            first, end = k * (self.degree + 1), (k + 1) * (self.degree + 1)
            found[first:end, k], found[end, k] = ends, -1.0
        return found

    def interpolate(self, x: Array, order: int = 0) -> Array:
        """(len(x), columns): values, or derivatives by parts of the span, at times x in [0, 1]."""
        k = np.clip(np.searchsorted(self.breaks, x, side="right") - 1, 0, self.K - 1)
        local = self._basis((x - self.breaks[k]) / self.widths[k], order) / self.widths[k][:, None] ** order
        found = np.zeros((len(x), self.columns))
        columns = k[:, None] * (self.degree + 1) + np.arange(self.degree + 1)
        np.put_along_axis(found, columns, local, axis=1)
        return found


@dataclass(frozen=True)
class Structure:
    """Everything that decides how an IPOPT problem is built.

    span   span of the motion, in 1/Omega
    kinds  bounds that are rows: torque, angle
    rows   of (12): six, of a held carrier one a freedom; the bias has as many numbers
    """

    N: int
    breaks: tuple[float, ...]
    degree: int
    span: float
    periodic: bool
    kinds: frozenset[str]
    rows: int = 6

    @cached_property
    def mesh(self) -> Mesh:
        """Mesh of these intervals."""
        return Mesh(np.array(self.breaks), self.degree)

    @property
    def M(self) -> int:
        """Number of nodes."""
        return self.mesh.K * self.degree

    @property
    def y_slices(self) -> dict[str, slice]:
        """Slices of y of one node, by name."""
        m = self.rows
        first = {"residual": slice(0, m)}
        return {**first, "torque": slice(m, m + self.N)} if "torque" in self.kinds else first

    @property
    def shapes(self) -> tuple[tuple[int, int], ...]:
        """Shapes of x (2N, columns), u (N, M), bias (rows), mean (N); time in 1/Omega."""
        return (2 * self.N, self.mesh.columns), (self.N, self.M), (self.rows, 1), (self.N, 1)

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return self.ends[-1]

    @property
    def ends(self) -> list[int]:
        """Where x, u, bias, mean end in z, column-major each; 0 first."""
        return [int(end) for end in np.cumsum([0, *(n * m for n, m in self.shapes)])]
