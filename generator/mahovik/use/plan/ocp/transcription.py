"""(13) as an IPOPT problem, built once for its structure and solved for any numbers.

Derivatives are assembled from blocks, one per node, each a flat CasADi function: building takes a second.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from scipy.sparse import csc_matrix

from mahovik.use.plan.array import Array
from mahovik.use.plan.ocp.node import Node, node_functions
from mahovik.use.plan.ocp.structure import Indices, Structure
from mahovik.use.plan.ocp.watch import Watch

MOST_STEPS = 300
_OPTIONS = {
    "print_time": False,
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.linear_solver": "mumps",
    "ipopt.max_iter": MOST_STEPS,
    "ipopt.tol": 1e-6,
    "ipopt.acceptable_tol": 1e-4,
    "ipopt.acceptable_iter": 8,
    "ipopt.constr_viol_tol": 1e-7,
    "ipopt.mu_init": 1e-4,
    "ipopt.bound_push": 1e-4,
    "ipopt.bound_frac": 1e-4,
    "ipopt.fixed_variable_treatment": "make_constraint",
    "error_on_fail": False,
}


@dataclass(frozen=True, eq=False)
class Transcription:
    """The IPOPT problem of one structure. Parameters: those of all nodes in turn, then those of the stand."""

    structure: Structure
    solver: Any
    rows_of: Any
    watch: Watch

    def rows(self, unknowns: Array, given: Array) -> Array:
        """g at a point."""
        return np.asarray(self.rows_of(unknowns, given)).ravel()


_built: dict[Structure, Transcription] = {}
"""Problems built in this process: other seeds, starts, rounds or stands change only the numbers."""


def transcription(structure: Structure) -> Transcription:
    """The IPOPT problem of a structure, built at its first use."""
    if structure not in _built:
        node = node_functions(structure.N, structure.partition, "torque" in structure.kinds)
        _built[structure] = _Builder(structure, node).build()
    return _built[structure]


@dataclass(frozen=True, eq=False)
class _Builder:
    """Builds the functions for IPOPT from those of a node."""

    structure: Structure
    node: Node

    def build(self) -> Transcription:
        """Build f, g, and their derivatives."""
        own, M = self.structure, self.structure.M
        z = ca.MX.sym("z", own.size)
        nodes, stand = (ca.MX.sym("given", self.node.value.size1_in(k), n) for k, n in ((1, M), (2, 1)))
        of_nodes = nodes.numel()
        p = ca.MX.sym("p", of_nodes + stand.numel())
        given = (ca.reshape(p[:of_nodes], nodes.shape), p[of_nodes:])
        taken = ca.reshape(z[own.places.ravel().tolist()], own.places.shape[1], M)
        A, B, weights = _matrix(own.A), _matrix(own.B), ca.DM(own.mesh.weights)
        y, cost = self.node.value.map("values", "serial", M, [2], [])(taken, *given)
        f, g = ca.mtimes(cost, weights), ca.densify(ca.mtimes(A, z) + ca.mtimes(B, ca.vec(y)))
        by_y, by_cost = self.node.slope.map("slopes", "serial", M, [2], [])(taken, *given)
        Jy, gradient = self._slopes(by_y), self._gradient(ca.reshape(by_cost, own.places.shape[1], M), weights)
        lam_f, lam_g = ca.MX.sym("lam_f"), ca.MX.sym("lam_g", own.A.shape[0])
        pull = ca.reshape(ca.mtimes(B.T, lam_g), own.y_size, M)
        bends = self.node.bend.map("bends", "serial", M, [2], [])(taken, *given, pull, lam_f * weights.T)
        rows_of = ca.Function("rows", [z, p], [g])
        names = ["x", "p"], ["f", "grad_f_x"]
        options: dict[str, Any] = {
            "grad_f": ca.Function("nlp_grad_f", [z, p], [f, gradient], *names),
            "jac_g": ca.Function("nlp_jac_g", [z, p], [g, A + ca.mtimes(B, Jy)], ["x", "p"], ["g", "jac_g_x"]),
            "hess_lag": ca.Function(
                "nlp_hess_l",
                [z, p, lam_f, lam_g],
                [self._hessian(bends)],
                ["x", "p", "lam_f", "lam_g"],
                ["triu_hess_gamma_x_x"],
            ),
        }
        watch = Watch("watch", own.size, own.A.shape[0], p.numel())
        options = {**_OPTIONS, **options, "iteration_callback": watch}
        solver = ca.nlpsol("ocp", "ipopt", {"x": z, "p": p, "f": f, "g": g}, options)
        return Transcription(own, solver, rows_of, watch)

    def _slopes(self, blocks: Any) -> Any:
        """dy/dz of all nodes (M size_of_y, size) from blocks side by side."""
        own, n = self.structure, self.structure.y_size
        w = own.places.shape[1]
        k = np.arange(own.M)[:, None, None]
        row = (n * k + np.arange(n)[None, None, :]) + np.zeros((1, w, 1), dtype=int)  # by columns, as blocks are stored
        column = np.broadcast_to(own.places[:, :, None], row.shape)
        return _assembled(row.ravel(), column.ravel(), (own.M * n, own.size), ca.vec(blocks))

    def _gradient(self, blocks: Any, weights: Any) -> Any:
        """df/dz (size) from slopes (unknowns of a node, M) of the cost."""
        own = self.structure
        M, w = own.places.shape
        data = np.ones(M * w)
        spread = csc_matrix((data, (own.places.ravel(), np.arange(M * w))), shape=(own.size, M * w))
        return ca.densify(ca.mtimes(_matrix(spread), ca.vec(blocks * ca.repmat(weights.T, w, 1))))

    def _hessian(self, blocks: Any) -> Any:
        """Upper triangle of the second derivatives by z, from those of the nodes; all nodes share the bias."""
        own = self.structure
        M, w = own.places.shape
        row = np.broadcast_to(own.places[:, None, :], (M, w, w)).ravel()
        column = np.broadcast_to(own.places[:, :, None], (M, w, w)).ravel()
        upper = np.flatnonzero(row <= column)
        keys, entry = np.unique(column[upper] * own.size + row[upper], return_inverse=True)
        gather = csc_matrix((np.ones(len(upper)), (entry, upper)), shape=(len(keys), M * w * w))
        values = ca.mtimes(_matrix(gather), ca.vec(blocks))
        return _assembled(keys % own.size, keys // own.size, (own.size, own.size), values)


def _assembled(row: Indices, column: Indices, shape: tuple[int, int], values: Any) -> Any:
    """A sparse matrix with values (n) at distinct places."""
    order = np.lexsort((row, column))
    counts = np.concatenate([[0], np.cumsum(np.bincount(column, minlength=shape[1]))])
    sparsity = ca.Sparsity(*shape, counts.tolist(), row[order].tolist())
    return ca.MX(sparsity, values[order.tolist()])


def _matrix(matrix: Any) -> Any:
    """CasADi matrix of a SciPy one."""
    columns = csc_matrix(matrix)
    columns.sort_indices()
    rows, width = columns.shape
    sparsity = ca.Sparsity(rows, width, columns.indptr.tolist(), columns.indices.tolist())
    return ca.DM(sparsity, columns.data)
