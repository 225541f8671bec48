"""(13) as an IPOPT problem in CasADi, built once for its structure and solved for any numbers.

(12) and (13) at one node are expressions of angle, speed, control, with the coefficients as parameters. Masses and
mountings do not appear: `plan.residual` gives the coefficients as numbers. The unit of time is 1/Omega, with Omega the
frequency of the motion: v = phi'/Omega, a = phi''/Omega^2; rows of (12) are scaled like the norm of residuals, torques
are tau / (J_s Omega^2).

Derivatives are assembled from blocks, one per node, each a flat CasADi function: building takes a second. A callback at
every iteration reports progress, ends the run by time or Ctrl-C, and keeps the best point so far.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import Any

import casadi as ca
import numpy as np

from mahovik.use.numeric import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.objective import KINDS
from mahovik.use.plan.ocp.structure import Structure
from mahovik.use.plan.outcome import OnProgress

HARMONICS = 5
"""Harmonics 1, cos, sin, cos 2, sin 2 of an angle. Their tables have the rows of (12) and one of the torque."""


def parameter_shapes(N: int, m: int) -> tuple[dict[str, tuple[int, ...]], dict[str, tuple[int, ...]]]:
    """Names and shapes of the parameters: those of a node, and those of all nodes; N flywheels, m rows of (12).

    A node has the coefficients of (12) (see plan.residual.prescribed) and derivatives by the bias. All share tables,
    weights by kind, mean speeds, motors.
    """
    table, each = (HARMONICS, m + 1, N), (N,)
    return (
        {"base": (m,), "fixed": table, "moving": table, "by_bias": (m, m), "tau_by_bias": (N, m)},
        {"still": table, "spun": table, "weights": (len(KINDS), N)}
        | dict.fromkeys(("mean_speed", "loss", "viscous", "coulomb", "coulomb_speed"), each),
    )


def _tables(name: str, shapes: dict[str, tuple[int, ...]]) -> tuple[Any, dict[str, Any]]:
    """A vector of symbols, and its parts by name: arrays of single symbols, stored row by row."""
    vector, found, first = ca.SX.sym(name, sum(map(math.prod, shapes.values()))), {}, 0
    for part, shape in shapes.items():
        found[part] = np.empty(shape, dtype=object)
        for place in np.ndindex(*shape):
            found[part][place] = vector[first]
            first += 1
    return vector, found


def _wrenches(N: int, phi: Any, v: Any, bias: Any, at: dict[str, Any], own: dict[str, Any]) -> tuple[Any, ...]:
    """I (m, N), P - J phi' (m), the part of tau without acceleration, and its factor of acceleration (N each)."""
    m = len(at["base"])
    I = ca.SX(m, N)
    rest = ca.vertcat(*(at["base"][i] + sum(at["by_bias"][i, b] * bias[b] for b in range(m)) for i in range(m)))
    tau, tau_by_a = ca.SX(N, 1), ca.SX(N, 1)
    for s in range(N):
        c, d = ca.cos(phi[s]), ca.sin(phi[s])
        waves = (1.0, c, d, 1.0 - 2.0 * d * d, 2.0 * c * d)
        for row in range(m + 1):
            of_a = sum(h * own["still"][k, row, s] for k, h in enumerate(waves))
            others = sum(
                h * (at["fixed"][k, row, s] + v[s] * (at["moving"][k, row, s] + v[s] * own["spun"][k, row, s]))
                for k, h in enumerate(waves)
            )
            if row < m:
                I[row, s] = of_a
                rest[row] -= others
            else:
                tau_by_a[s] = of_a
                tau[s] = others + sum(at["tau_by_bias"][s, b] * bias[b] for b in range(m))
    return I, rest, tau, tau_by_a


def _cost(N: int, v: Any, a: Any, tau: Any, own: dict[str, Any]) -> Any:
    """J(x, u) of (13) at a node: the rows of `plan.objective`, squared and weighted."""
    total = 0.0
    for s in range(N):
        given = tau[s] + own["viscous"][s] * v[s] + own["coulomb"][s] * ca.tanh(v[s] / own["coulomb_speed"][s])
        rows = {
            "acceleration": a[s],
            "torque": tau[s],
            "speed_variation": v[s] - own["mean_speed"][s],
            "power": own["loss"][s] * given**2 + given * v[s],
        }
        total += sum(own["weights"][k, s] * rows[kind] ** 2 for k, kind in enumerate(KINDS))
    return total


@dataclass(frozen=True, eq=False)
class Node:
    """(12) and (13) at one node, with derivatives by z = (x, u, bias); x = (phi, v) (2N).

    u       controls: a (N); bias (m): its change; m = 6, held the freedoms
    value   (z, node, stand) -> (y, cost); y: R (m) of (12), tau (N)
    slope   (z, node, stand) -> (dy/dz, dcost/dz), dense
    bend    (z, node, stand, by y, by cost) -> second derivatives of by_y . y + by_cost cost, dense
    """

    value: Any
    slope: Any
    bend: Any


def node_functions(N: int, torque: bool, m: int = 6) -> Node:
    """Functions of a node. `torque`: y includes tau; m: rows of (12)."""
    z = ca.SX.sym("z", 3 * N + m)
    (node, at), (stand, own) = map(_tables, ("node", "stand"), parameter_shapes(N, m))
    phi, v, a, bias = z[:N], z[N : 2 * N], z[2 * N : -m], z[-m:]
    I, rest, still, tau_by_a = _wrenches(N, phi, v, bias, at, own)
    tau = still + tau_by_a * a
    y, cost = ca.vertcat(rest - ca.mtimes(I, a), *([tau] if torque else [])), _cost(N, v, a, tau, own)
    by_y, by_cost = ca.SX.sym("by_y", y.numel()), ca.SX.sym("by_cost")
    bend, _ = ca.hessian(ca.dot(by_y, y) + by_cost * cost, z)
    given = [z, node, stand]
    return Node(
        ca.Function("value", given, [y, cost]),
        ca.Function("slope", given, [ca.densify(ca.jacobian(y, z)), ca.densify(ca.jacobian(cost, z))]),
        ca.Function("bend", [*given, by_y, by_cost], [ca.densify(bend)]),
    )


FEASIBLE = 1e-4
"""Largest violation of a row at which the refinement can still make a point exact."""


@dataclass
class RunRecord:
    """Record of one run: iterations, objective and largest violation at the last one, and the best feasible point."""

    iterations: int = 0
    objective: float = np.inf
    violation: float = np.inf
    best: Array | None = None
    best_objective: float = np.inf
    interrupted: bool = False
    cut: bool = False

    @property
    def doing(self) -> str:
        """Name of the activity."""
        return "optimal control"

    @property
    def words(self) -> str:
        """The line of progress."""
        return f"IPOPT: iteration {self.iterations}, objective {self.objective:.4g}, violation {self.violation:.1e}"

    def interrupt(self) -> None:
        """Make IPOPT end at its next iteration."""
        self.interrupted = True


class Watch(ca.Callback):
    """Iteration callback of one IPOPT problem; call `begin` before every run."""

    def __init__(self, name: str, unknowns: int, rows: int, parameters: int) -> None:
        ca.Callback.__init__(self)
        self._sizes = dict(zip(ca.nlpsol_out(), (unknowns, 1, rows, unknowns, rows, parameters), strict=True))
        self.begin(np.zeros(rows), np.zeros(rows), lambda _: None, Budget(0))
        self.construct(name, {})

    def begin(self, low: Array, high: Array, on_progress: OnProgress, time: Budget) -> RunRecord:
        """Begin a run with these bounds of the rows, until the time is over; return the record it fills."""
        self._low, self._high, self._tell, self._time = low, high, on_progress, time
        self._seen = RunRecord()
        return self._seen

    def get_n_in(self) -> int:
        """Number of outputs of the solver."""
        return int(ca.nlpsol_n_out())

    def get_n_out(self) -> int:
        """One output: whether to stop."""
        return 1

    def get_sparsity_in(self, i: int) -> Any:
        """Dense columns."""
        return ca.Sparsity.dense(self._sizes[ca.nlpsol_out(i)], 1)

    def eval(self, arg: Any) -> list[int]:
        """1 stops IPOPT."""
        seen = self._seen
        g = np.asarray(arg[2]).ravel()
        seen.objective = float(arg[1])
        seen.violation = float(np.maximum(np.maximum(self._low - g, g - self._high), 0.0).max(initial=0.0))
        if seen.violation < FEASIBLE and seen.objective < seen.best_objective:
            seen.best, seen.best_objective = np.asarray(arg[0]).ravel().copy(), seen.objective
        self._tell(seen)
        seen.iterations += 1
        seen.cut |= self._time.is_spent()
        return [int(seen.cut or seen.interrupted)]


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
    """The IPOPT problem of one structure. Parameters: those of all nodes in turn, then those of the stand.

    slices   of the rows g, by kind of rows
    """

    structure: Structure
    solver: Any
    slices: dict[str, slice]
    watch: Watch


@cache
def transcription(own: Structure) -> Transcription:
    """The IPOPT problem of a structure, built at its first use: other seeds, starts or stands change only the numbers.

    With P the selection of the nodes' unknowns from z, g = A z + B y: its derivative is A + B Y P, with Y the slopes of
    y of each node on the diagonal; second derivatives are P^T H P, with those of each node on the diagonal of H.
    """
    node, M = node_functions(own.N, "torque" in own.kinds, own.rows), own.M
    z = ca.MX.sym("z", own.size)
    pieces = zip(ca.vertsplit(z, own.ends), own.shapes, strict=True)
    x, u, bias, mean = (ca.reshape(part, *shape) for part, shape in pieces)
    taken = ca.vertcat(x[:, own.mesh.at_nodes.tolist()], u, ca.repmat(bias, 1, M))
    nodes, stand = (ca.MX.sym("given", node.value.size1_in(k), n) for k, n in ((1, M), (2, 1)))
    p = ca.MX.sym("p", nodes.numel() + stand.numel())
    given = (ca.reshape(p[: nodes.numel()], nodes.shape), p[nodes.numel() :])
    values, weights = ca.MX.sym("y", node.value.size1_out(0), M), ca.DM(own.mesh.weights)
    kinds = _row_kinds(own, x, u, mean, values)
    ends = np.cumsum([0, *(rows.numel() for rows in kinds.values())]).tolist()
    slices = {name: slice(*pair) for name, pair in zip(kinds, pairwise(ends), strict=True)}
    A, B = (ca.evalf(ca.jacobian(ca.veccat(*kinds.values()), each)) for each in (z, values))
    P, w = ca.evalf(ca.jacobian(ca.vec(taken), z)), taken.size1()
    y, cost = node.value.map("values", "serial", M, [2], [])(taken, *given)
    f, g = ca.mtimes(cost, weights), ca.densify(ca.mtimes(A, z) + ca.mtimes(B, ca.vec(y)))
    by_y, by_cost = node.slope.map("slopes", "serial", M, [2], [])(taken, *given)
    slopes = ca.mtimes(ca.diagcat(*ca.horzsplit(by_y, w)), P)
    gradient = ca.densify(ca.mtimes(P.T, ca.vec(ca.reshape(by_cost, w, M) * ca.repmat(weights.T, w, 1))))
    lam_f, lam_g = ca.MX.sym("lam_f"), ca.MX.sym("lam_g", ends[-1])
    pull = ca.reshape(ca.mtimes(B.T, lam_g), values.shape)
    bends = node.bend.map("bends", "serial", M, [2], [])(taken, *given, pull, lam_f * weights.T)
    hessian = ca.triu(ca.mtimes(P.T, ca.mtimes(ca.diagcat(*ca.horzsplit(bends, w)), P)))
    parts = {
        "grad_f": ca.Function("nlp_grad_f", [z, p], [f, gradient], ["x", "p"], ["f", "grad_f_x"]),
        "jac_g": ca.Function("nlp_jac_g", [z, p], [g, A + ca.mtimes(B, slopes)], ["x", "p"], ["g", "jac_g_x"]),
        "hess_lag": ca.Function(
            "nlp_hess_l",
            [z, p, lam_f, lam_g],
            [hessian],
            ["x", "p", "lam_f", "lam_g"],
            ["triu_hess_gamma_x_x"],
        ),
    }
    watch = Watch("watch", own.size, ends[-1], p.numel())
    options: Any = {**_OPTIONS, **parts, "iteration_callback": watch}
    problem: Any = {"x": z, "p": p, "f": f, "g": g}
    solver = ca.nlpsol("ocp", "ipopt", problem, options)
    return Transcription(own, solver, slices, watch)


def _row_kinds(own: Structure, x: Any, u: Any, mean: Any, y: Any) -> dict[str, Any]:
    """Rows g by kind, linear in the unknowns and in y (., M)."""
    mesh, N, M = own.mesh, own.N, own.M
    derive, jumps = (ca.sparsify(ca.DM(each)) for each in (mesh.derive, mesh.jumps))
    nodes = x[:, mesh.at_nodes.tolist()]
    found = {
        "collocation": (ca.mtimes(x, derive) - own.span * ca.vertcat(nodes[N:, :], u)) / M,
        "continuity": ca.mtimes(x, jumps),
    }
    if own.periodic:
        found["closing"] = x[:, -1] - x[:, 0]
    for name, rows in own.y_slices.items():
        found[name] = y[rows, :]
    if "angle" in own.kinds:
        found["angle"] = nodes[:N, :] - ca.repmat(mean, 1, M)
        found["mean"] = ca.mtimes(nodes[:N, :], ca.DM(mesh.weights)) - mean
    return found
