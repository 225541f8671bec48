"""Structure of an IPOPT problem: its unknowns, and its rows g = A z + B y, y the values of all nodes.

Unknowns z: the states x (2N) at all columns of the mesh, the controls u at its nodes, the change of the bias (6), the
mean of each swing (N). A and B are constant; the bounds of the rows are given at each run.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix, csc_matrix, eye, kron, vstack

from mahovik.use.plan.array import Array
from mahovik.use.plan.ocp.mesh import Mesh

Formulation = Literal["ocp-partition", "ocp"]
Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Unknowns:
    """A point: x (2N, columns), u (controls, M), bias (6), mean (N); time in 1/Omega, flywheels (-, +)."""

    x: Array
    u: Array
    bias: Array
    mean: Array

    @property
    def vector(self) -> Array:
        """Flat vector, column-major, as IPOPT expects."""
        return np.concatenate([self.x.ravel("F"), self.u.ravel("F"), self.bias, self.mean])


@dataclass(frozen=True)
class Structure:
    """Everything that decides how an IPOPT problem is built.

    span   span of the motion, in 1/Omega
    kinds  bounds that are rows: acceleration, torque, angle
    """

    formulation: Formulation
    N: int
    breaks: tuple[float, ...]
    degree: int
    span: float
    periodic: bool
    kinds: frozenset[str]

    @cached_property
    def mesh(self) -> Mesh:
        """Mesh of these intervals."""
        return Mesh(np.array(self.breaks), self.degree)

    @property
    def partition(self) -> bool:
        """Whether six accelerations follow from the others."""
        return self.formulation == "ocp-partition"

    @property
    def controls(self) -> int:
        """Number of controls at a node."""
        return self.N - 6 if self.partition else self.N

    @property
    def M(self) -> int:
        """Number of nodes."""
        return self.mesh.K * self.degree

    @property
    def y_slices(self) -> dict[str, slice]:
        """Slices of y of one node, by name."""
        first = {"dependent": slice(0, 6), "volume": slice(6, 7)} if self.partition else {"residual": slice(0, 6)}
        at = 7 if self.partition else 6
        return {**first, "torque": slice(at, at + self.N)} if "torque" in self.kinds else first

    @property
    def y_size(self) -> int:
        """Length of y of one node."""
        return max(int(each.stop) for each in self.y_slices.values())

    @property
    def shapes(self) -> tuple[tuple[int, int], ...]:
        """Shapes of x, u, bias, mean."""
        return (2 * self.N, self.mesh.columns), (self.controls, self.M), (6, 1), (self.N, 1)

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return sum(n * m for n, m in self.shapes)

    def split(self, vector: Array) -> Unknowns:
        """The point of a vector."""
        pieces, at = [], 0
        for n, m in self.shapes:
            pieces.append(vector[at : at + n * m].reshape((n, m), order="F"))
            at += n * m
        return Unknowns(pieces[0], pieces[1], pieces[2].ravel(), pieces[3].ravel())

    @cached_property
    def places(self) -> Indices:
        """(M, unknowns of a node): positions in z of the x, u, bias of each node."""
        N, m = self.N, self.controls
        first = 2 * N * self.mesh.columns
        x = 2 * N * self.mesh.at_nodes[:, None] + np.arange(2 * N)
        u = first + m * np.arange(self.M)[:, None] + np.arange(m)
        bias = np.tile(first + m * self.M + np.arange(6), (self.M, 1))
        return np.hstack([x, u, bias])

    @cached_property
    def rows(self) -> dict[str, slice]:
        """Slices of g, by kind of rows."""
        found, at = {}, 0
        for name, (A, _) in self._kinds.items():
            found[name] = slice(at, at + A.shape[0])
            at += A.shape[0]
        return found

    @cached_property
    def A(self) -> csc_matrix:
        """Derivative of g by z (rows, size), without the part through y."""
        return csc_matrix(vstack([A for A, _ in self._kinds.values()]))

    @cached_property
    def B(self) -> csc_matrix:
        """Derivative of g by y of all nodes (rows, M times size_of_y)."""
        return csc_matrix(vstack([B for _, B in self._kinds.values()]))

    @cached_property
    def _kinds(self) -> dict[str, tuple[csc_matrix, csc_matrix]]:
        """A and B of each kind of rows."""
        mesh, N, M = self.mesh, self.N, self.M
        states = eye(2 * N)
        none = csc_matrix((M * self.y_size, M * self.y_size))
        found = {
            "collocation": self._collocation(),
            "continuity": (self._by_x(kron(mesh.jumps.T, states)), none[: 2 * N * mesh.K]),
        }
        if self.periodic:
            ends = coo_matrix(([-1.0, 1.0], ([0, 0], [0, mesh.columns - 1])), shape=(1, mesh.columns))
            found["closing"] = (self._by_x(kron(ends, states)), none[: 2 * N])
        for name, y in self.y_slices.items():
            if name != "dependent" or "acceleration" in self.kinds:
                found[name] = (csc_matrix(((y.stop - y.start) * M, self.size)), self._of_nodes(y))
        if "angle" in self.kinds:
            phi = csc_matrix(eye(N, 2 * N))
            nodes = csc_matrix(eye(mesh.columns))[mesh.at_nodes]
            mean = coo_matrix((np.ones(N), (np.arange(N), np.arange(self.size - N, self.size))), shape=(N, self.size))
            found["angle"] = (self._by_x(kron(nodes, phi)) - kron(np.ones((M, 1)), mean), none[: N * M])
            found["mean"] = (self._by_x(kron(csc_matrix(mesh.weights[None, :] @ nodes), phi)) - mean, none[:N])
        return found

    def _collocation(self) -> tuple[csc_matrix, csc_matrix]:
        """(x' - (v, a) span) / M at the nodes; a of the partition's six comes through y."""
        N, M, m = self.N, self.M, self.controls
        rate, share = self.span / M, kron(self.mesh.derive.T / M, eye(2 * N))
        row = 2 * N * np.arange(M)[:, None] + np.arange(2 * N)
        taken = np.hstack([row[:, :N], row[:, N : N + m]]).ravel()
        by = np.hstack([self.places[:, N : 2 * N], self.places[:, 2 * N : 2 * N + m]]).ravel()
        shape = (2 * N * M, self.size)
        A = self._by_x(share) - rate * coo_matrix((np.ones(len(taken)), (taken, by)), shape=shape)
        shape = (2 * N * M, M * self.y_size)
        if not self.partition:
            return csc_matrix(A), csc_matrix(shape)
        y = self.y_size * np.arange(M)[:, None] + np.arange(6)
        B = coo_matrix((np.full(6 * M, -rate), (row[:, N + m :].ravel(), y.ravel())), shape=shape)
        return csc_matrix(A), csc_matrix(B)

    def _of_nodes(self, y: slice) -> csc_matrix:
        """Rows equal to a piece of y at every node."""
        return csc_matrix(kron(eye(self.M), csc_matrix(eye(self.y_size))[y]))

    def _by_x(self, matrix: csc_matrix) -> csc_matrix:
        """Rows that depend on x alone, extended by the columns of all other unknowns."""
        wide = coo_matrix(matrix)
        return csc_matrix(coo_matrix((wide.data, (wide.row, wide.col)), shape=(wide.shape[0], self.size)))
