"""One run of IPOPT from a flywheel motion: numbers in, the collocated motion out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.plan.budget import defer_interrupt
from mahovik.use.plan.fourier import Angles
from mahovik.use.plan.ocp.coefficients import Scaled
from mahovik.use.plan.ocp.limits import row_bounds, unknown_bounds
from mahovik.use.plan.ocp.mesh import Mesh
from mahovik.use.plan.ocp.structure import Formulation, Structure, Unknowns
from mahovik.use.plan.ocp.transcription import transcription
from mahovik.use.plan.ocp.watch import Seen
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.residual import prescribe, residual

ROWS = ("acceleration", "torque", "angle")
"""Bounds that are rows, at least in part."""


@dataclass(frozen=True, eq=False)
class Start:
    """Start of a run: angles (., N; rad, s) at given times, turns per period (N; 0 for finite motions), bias (6)."""

    at: Callable[[Array], Angles]
    winding: Array
    bias: Array


@dataclass(frozen=True, eq=False)
class Collocated:
    """Result of a run.

    phi, phi_dot   (N, columns) of the mesh, rad, rad/s, flywheels in the stand's order
    objective   J of (13) by the nodes
    residual    largest relative residual of (12) between the nodes, of the unchanged polynomials
    solved      whether IPOPT reports success; words: IPOPT's status. usable: whether (13) holds at the nodes
    """

    mesh: Mesh
    span: float
    phi: Array
    phi_dot: Array
    bias: Array
    objective: float
    residual: float
    solved: bool
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
    scaled: Scaled,
    formulation: Formulation,
    mesh: Mesh,
    start: Start,
    part: float,
    on_progress: Callable[[Any], None] | None = None,
    until: float | None = None,
) -> Collocated:
    """Solve (13) from a start, inside `part` of the bounds. Ctrl-C and the time `until` end it with the best so far."""
    problem = scaled.problem
    motion = problem.motion
    kinds = frozenset(kind for kind in ROWS if getattr(motion.bounds, kind) is not None)
    breaks = tuple(mesh.breaks.tolist())
    own = transcription(Structure(formulation, problem.N, breaks, mesh.degree, scaled.span, motion.periodic, kinds))
    angles = start.at(mesh.times * motion.span)
    nodes = Angles(*(x[mesh.at_nodes] for x in angles))
    of_nodes = scaled.node_parameters(mesh.nodes * motion.span, nodes, start.bias)
    given = np.concatenate([of_nodes.ravel("F"), scaled.stand_parameters(2.0 * np.pi * start.winding / motion.span)])
    first = _start_point(scaled, own.structure, angles, start.winding).vector
    low, high = unknown_bounds(scaled, own.structure, start.winding, start.bias, part)
    rows_low, rows_high = row_bounds(scaled, own.structure, start.winding, part, own.rows(first, given))
    seen = own.watch.begin(rows_low, rows_high, on_progress, until)
    with defer_interrupt(seen.interrupt, again=False):
        found = own.solver(x0=first, p=given, lbx=low, ubx=high, lbg=rows_low, ubg=rows_high)
    end = _result(scaled, own.structure, start, found, own.solver.stats(), seen)
    return replace(end, residual=residual_between_nodes(problem, end))


def _result(
    scaled: Scaled,
    own: Structure,
    start: Start,
    found: dict[str, Any],
    status: dict[str, Any],
    seen: Seen,
) -> Collocated:
    """The solution; if there is none, the best point seen."""
    solved, back, N = bool(status["success"]), np.argsort(scaled.order), own.N
    last = solved or seen.best is None
    point = own.split(np.asarray(found["x"]).ravel() if last else np.asarray(seen.best))
    return Collocated(
        mesh=own.mesh,
        span=scaled.problem.motion.span,
        phi=point.x[:N][back],
        phi_dot=point.x[N:][back] * scaled.Omega,
        bias=start.bias + np.where(scaled.problem.free, point.bias, 0.0),
        objective=float(found["f"]) if last else seen.best_objective,
        residual=np.inf,
        solved=solved,
        usable=solved or seen.best is not None,
        words=str(status["return_status"]).replace("_", " ").lower(),
        iterations=int(status["iter_count"]),
        interrupted=seen.interrupted,
        cut=seen.cut,
    )


def residual_between_nodes(problem: Problem, found: Collocated) -> float:
    """Largest relative residual at 20 times in every interval, none of them a node."""
    inside = (np.arange(20) + 0.381966) / 20
    t = (found.mesh.breaks[:-1, None] + found.mesh.widths[:, None] * inside).ravel() * found.span
    at = prescribe(problem.mechanics, problem.motion.at(t), found.bias)
    return problem.norm.relative(residual(at, *found.at(t)))


def _start_point(scaled: Scaled, own: Structure, angles: Angles, winding: Array) -> Unknowns:
    """The point that IPOPT starts from."""
    order, mesh, Omega = scaled.order, own.mesh, scaled.Omega
    phi, v, a = (x[:, order].T for x in (angles.phi, angles.phi_dot / Omega, angles.phi_ddot / Omega**2))
    swing = phi[:, mesh.at_nodes] - 2.0 * np.pi * winding[order][:, None] * mesh.nodes
    mean = swing @ mesh.weights if "angle" in own.kinds else np.zeros(own.N)
    return Unknowns(np.vstack([phi, v]), a[: own.controls, mesh.at_nodes], np.zeros(6), mean)
