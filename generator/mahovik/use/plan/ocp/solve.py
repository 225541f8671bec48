"""One run of IPOPT from a flywheel motion: numbers in, the collocated motion out.

The numbers are coefficients in the scales of `node`, and bounds: E_x, E_u and x(t0) of (13), and those of its rows.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mahovik.core.motion.functions import Angles
from mahovik.core.motion.required import Bounds
from mahovik.use.numeric import Array, prescribe, residual
from mahovik.use.plan.budget import Budget, defer_interrupt
from mahovik.use.plan.objective import KINDS, Cost
from mahovik.use.plan.ocp.structure import Mesh, Structure
from mahovik.use.plan.ocp.transcription import RunRecord, transcription
from mahovik.use.plan.outcome import OnProgress
from mahovik.use.plan.problem import Problem


@dataclass(frozen=True, eq=False)
class ScaledProblem:
    """A planning problem in the scales of `node`: time in 1/Omega."""

    problem: Problem
    cost: Cost

    @property
    def Omega(self) -> float:
        """Frequency of the motion, rad/s."""
        return self.cost.Omega

    @property
    def span(self) -> float:
        """Span of the motion in 1/Omega."""
        return self.problem.motion.span * self.Omega

    @property
    def torque(self) -> Array:
        """J_s Omega^2 (N), N m: unit of torque."""
        return np.asarray(self.cost.spin_inertia * self.Omega**2)

    def node_parameters(self, t: Array, angles: Angles, bias: Array) -> Array:
        """Parameters (P, M) of the nodes at times t (M, s), around a bias.

        The change by the bias is linear, with the flywheels at the given angles (M, N). The error is of second order,
        and the result is solved exactly afterwards.
        """
        problem, M = self.problem, len(t)
        course = problem.motion.at(t)
        at = prescribe(problem.mechanics, course, bias)
        by_bias, tau_by_bias = problem.bias_perturbations(course, bias).rates(angles)
        base = problem.norm.dimensionless(at.balance)
        fixed, moving = (np.transpose(self._rows(x), (2, 0, 1, 3)) for x in (at.fixed, at.moving * self.Omega))
        parts = (base, fixed, moving, by_bias, tau_by_bias / self.torque[:, None])
        return np.hstack([x.reshape(M, -1) for x in parts]).T

    def _rows(self, table: Array) -> Array:
        """A table (5, 7, M, N) with relative rows, held (5, m + 1, M, N)."""
        root = self.problem.norm.root / self.problem.norm.demand
        wrench = np.einsum("ij,hjmn->himn", root, table[:, :6])
        return np.concatenate([wrench, (table[:, 6] / self.torque)[:, None]], axis=1)

    def stand_parameters(self, mean_speed: Array) -> Array:
        """Parameters of all nodes (P): tables, objective, motors; mean speeds (N, rad/s)."""
        own, cost, drives, Omega = self.problem.mechanics, self.cost, self.cost.drives, self.Omega
        still, spun = (self._rows(x * Omega**2)[:, :, 0] for x in (own.coupling, own.coupling_slope))
        per_flywheel = (
            np.array([cost.weights[kind] for kind in KINDS]),
            mean_speed / Omega,
            drives.resistance * cost.spin_inertia * Omega / drives.constant**2,
            drives.viscous * Omega / self.torque,
            drives.coulomb / self.torque,
            drives.coulomb_speed / Omega,
        )
        return np.concatenate([still.ravel(), spun.ravel(), *(x.ravel() for x in per_flywheel)])

    def limits(self, bounds: Bounds, kind: str, part: float) -> Array:
        """Magnitudes (N) of a bound in these scales, times `part`; infinite without a bound."""
        given = getattr(bounds, kind)
        if given is None:
            return np.full(self.problem.N, np.inf)
        scale = {
            "speed": self.Omega, "speed_min": self.Omega, "acceleration": self.Omega**2,
            "torque": self.torque, "angle": 1.0,
        }[kind]  # fmt: skip
        return np.asarray(np.array(given) / scale * part)


def unknown_bounds(
    scaled: ScaledProblem, own: Structure, winding: Array, bias: Array, part: float
) -> tuple[Array, Array]:
    """Bounds of speeds, accelerations, bias (around `bias`, 6), and x(t0) of a finite motion."""
    problem, N = scaled.problem, own.N
    bounds = problem.motion.bounds
    x_low, x_high = _state_bounds(scaled, own, winding, part)
    u = np.tile(scaled.limits(bounds, "acceleration", part), own.M)
    widest = np.full(own.rows, np.inf) if bounds.bias is None else np.array(bounds.bias, dtype=np.float64)
    shift_low, shift_high = (np.where(problem.free, sign * widest - bias, 0.0) for sign in (-1.0, 1.0))
    mean = np.full(N, np.inf if "angle" in own.kinds else 0.0)
    low = np.concatenate([x_low.ravel("F"), -u, shift_low, -mean])
    high = np.concatenate([x_high.ravel("F"), u, shift_high, mean])
    if problem.motion.periodic:
        return low, high
    if bounds.start_phi is not None:
        low[:N] = high[:N] = np.array(bounds.start_phi)
    low[N : 2 * N] = high[N : 2 * N] = np.array(bounds.start_phi_dot or (0.0,) * N) / scaled.Omega
    return low, high


def _state_bounds(scaled: ScaledProblem, own: Structure, winding: Array, part: float) -> tuple[Array, Array]:
    """Bounds of x (2N, columns): greatest speeds, and least speeds on the side of the winding."""
    N, columns, bounds = own.N, own.mesh.columns, scaled.problem.motion.bounds
    fastest = scaled.limits(bounds, "speed", part)
    slow, fast = -fastest, fastest.copy()
    if bounds.speed_min is not None:
        least = scaled.limits(bounds, "speed_min", 1.0 / part)
        back = winding < 0.0
        slow = np.where((least > 0.0) & ~back, least, slow)
        fast = np.where((least > 0.0) & back, -least, fast)
    free = np.full(N, np.inf)
    low, high = (np.tile(np.concatenate(each)[:, None], columns) for each in ((-free, slow), (free, fast)))
    return low, high


def row_bounds(
    scaled: ScaledProblem, own: Structure, rows: Mapping[str, slice], winding: Array, part: float
) -> tuple[Array, Array]:
    """Bounds of g: zero for (12) and for the collocation, limits for other rows."""
    bounds, turn = scaled.problem.motion.bounds, 2.0 * np.pi * winding
    low, high = np.zeros((2, max(each.stop for each in rows.values())))
    for name in ROWS:
        if name in rows:
            high[rows[name]] = np.tile(scaled.limits(bounds, name, part), own.M)
            low[rows[name]] = -high[rows[name]]
    shifted = {"closing": np.concatenate([turn, 0.0 * turn])}  # phi includes its winding, swing does not
    shifted["angle"] = (own.mesh.nodes[:, None] * turn).ravel()
    shifted["mean"] = own.mesh.weights @ own.mesh.nodes * turn
    for name in shifted.keys() & rows.keys() if own.periodic else ():
        low[rows[name]] += shifted[name]
        high[rows[name]] += shifted[name]
    return low, high


ROWS = ("torque", "angle")
"""Bounds that are rows."""


@dataclass(frozen=True, eq=False)
class Start:
    """Start of a run: angles (., N; rad, s) at given times, turns per period (N; 0 for finite motions), bias (6)."""

    at: Callable[[Array], Angles]
    winding: Array
    bias: Array


@dataclass(frozen=True, eq=False)
class CollocatedMotion:
    """Result of a run.

    phi, phi_dot   (N, columns) of the mesh, rad, rad/s
    objective   J of (13) by the nodes
    residual    largest relative residual of (12) between the nodes, of the unchanged polynomials
    words       IPOPT's status; usable: whether (13) holds at the nodes
    """

    mesh: Mesh
    span: float
    phi: Array
    phi_dot: Array
    bias: Array
    objective: float
    residual: float
    usable: bool
    words: str
    iterations: int
    interrupted: bool
    cut: bool

    def at(self, t: Array) -> Angles:
        """Angles (M, N) at times t (M, s): phi and phi' are separate polynomials, phi'' is the derivative of phi'."""
        x = t / self.span
        E, D = self.mesh.interpolate(x), self.mesh.interpolate(x, 1) / self.span
        return Angles(E @ self.phi.T, E @ self.phi_dot.T, D @ self.phi_dot.T)


def solve(
    scaled: ScaledProblem,
    mesh: Mesh,
    start: Start,
    part: float,
    on_progress: OnProgress,
    time: Budget,
) -> CollocatedMotion:
    """Solve (13) from a start, inside `part` of the bounds. Ctrl-C and the end of `time` give the best so far."""
    problem = scaled.problem
    motion = problem.motion
    kinds = frozenset(kind for kind in ROWS if getattr(motion.bounds, kind) is not None)
    breaks = tuple(mesh.breaks.tolist())
    own = transcription(
        Structure(problem.N, breaks, mesh.degree, scaled.span, motion.periodic, kinds, problem.rows_count)
    )
    angles = start.at(mesh.times * motion.span)
    nodes = Angles(*(x[mesh.at_nodes] for x in angles))
    of_nodes = scaled.node_parameters(mesh.nodes * motion.span, nodes, start.bias)
    given = np.concatenate([of_nodes.ravel("F"), scaled.stand_parameters(2.0 * np.pi * start.winding / motion.span)])
    first = _start_point(scaled, own.structure, angles, start.winding)
    low, high = unknown_bounds(scaled, own.structure, start.winding, start.bias, part)
    rows_low, rows_high = row_bounds(scaled, own.structure, own.slices, start.winding, part)
    seen = own.watch.begin(rows_low, rows_high, on_progress, time)
    with defer_interrupt(seen.interrupt, again=False):
        found = own.solver(x0=first, p=given, lbx=low, ubx=high, lbg=rows_low, ubg=rows_high)
    end = _result(scaled, own.structure, start, found, own.solver.stats(), seen)
    return replace(end, residual=residual_between_nodes(problem, end))


def _result(
    scaled: ScaledProblem,
    own: Structure,
    start: Start,
    found: dict[str, Any],
    status: dict[str, Any],
    seen: RunRecord,
) -> CollocatedMotion:
    """The solution; if there is none, the best point seen."""
    solved, N = bool(status["success"]), own.N
    last = solved or seen.best is None
    vector = np.asarray(found["x"]).ravel() if last else np.asarray(seen.best)
    point, _, bias, _ = np.split(vector, own.ends[1:-1])
    x = point.reshape(own.shapes[0], order="F")
    return CollocatedMotion(
        mesh=own.mesh,
        span=scaled.problem.motion.span,
        phi=x[:N],
        phi_dot=x[N:] * scaled.Omega,
        bias=start.bias + np.where(scaled.problem.free, bias, 0.0),
        objective=float(found["f"]) if last else seen.best_objective,
        residual=np.inf,
        usable=solved or seen.best is not None,
        words=str(status["return_status"]).replace("_", " ").lower(),
        iterations=int(status["iter_count"]),
        interrupted=seen.interrupted,
        cut=seen.cut,
    )


def residual_between_nodes(problem: Problem, found: CollocatedMotion) -> float:
    """Largest relative residual at 20 times in every interval, none of them a node."""
    inside = (np.arange(20) + 0.381966) / 20
    t = (found.mesh.breaks[:-1, None] + found.mesh.widths[:, None] * inside).ravel() * found.span
    at = prescribe(problem.mechanics, problem.motion.at(t), found.bias)
    return problem.norm.relative(residual(at, *found.at(t)))


def _start_point(scaled: ScaledProblem, own: Structure, angles: Angles, winding: Array) -> Array:
    """z that IPOPT starts from."""
    mesh, Omega = own.mesh, scaled.Omega
    phi, v, a = (x.T for x in (angles.phi, angles.phi_dot / Omega, angles.phi_ddot / Omega**2))
    swing = phi[:, mesh.at_nodes] - 2.0 * np.pi * winding[:, None] * mesh.nodes
    mean = swing @ mesh.weights if "angle" in own.kinds else np.zeros(own.N)
    x, u = np.vstack([phi, v]), a[:, mesh.at_nodes]
    return np.concatenate([x.ravel("F"), u.ravel("F"), np.zeros(own.rows), mean])
