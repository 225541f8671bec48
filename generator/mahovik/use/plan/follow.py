"""Flywheel motions of held carriers by following (12) in time, as starts of the search of finite motions.

Where there are as many flywheels as freedoms, (12) gives phi'' at every angle and speed, so the phases at rest decide
everything; with more flywheels the smallest phi'' is taken. Such a motion may turn many times, which no search from
constant angles would find. Of a free carrier following (12) diverges, as nothing but the flywheels moves it.
"""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.functions import Samples
from mahovik.use.numeric.residual import PrescribedMotion, linear, prescribe
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.problem import Problem

STEPS = 512
"""Least steps of Runge-Kutta in the duration."""
_PER_TURN = 40
"""Steps per turn of the fastest flywheel."""
MOST_TURNS = 200.0
"""Turns in the duration beyond which a motion is given up."""
_MOST_STEPS = 8192
_COUNTED = 32
"""Steps of Runge-Kutta that count as one step of the budget."""


def follow(problem: Problem, bias: Array, phi: Array, phi_dot: Array, budget: Budget) -> tuple[Samples, ...]:
    """Tables of the motions from phi (K, N; rad) at the speeds phi' (N; rad/s), the least mean square of phi'' first.

    Left out are those that turn too often, as they do where the flywheels give nothing along a freedom. Empty if the
    budget ends.
    """
    tables = _tables(problem, bias, phi, phi_dot, STEPS, budget)
    tables.sort(key=lambda each: float(np.mean(each.phi_ddot**2)))
    return tuple(tables)


def resolve(problem: Problem, bias: Array, table: Samples, budget: Budget) -> Samples | None:
    """The same motion with enough steps for its turns; None if the budget ends."""
    turns = float(np.abs(table.phi_dot).max()) * problem.motion.span / (2.0 * np.pi)
    steps = min(int(_PER_TURN * turns), _MOST_STEPS)
    if steps <= len(table.t) - 1:
        return table
    return next(iter(_tables(problem, bias, table.phi[:1], table.phi_dot[0], steps, budget)), None)


def _tables(problem: Problem, bias: Array, phi: Array, phi_dot: Array, steps: int, budget: Budget) -> list[Samples]:
    """One table for each start that stays finite, in the order of the starts."""
    span = problem.motion.span
    h, t = span / steps, np.linspace(0.0, span, 2 * steps + 1)
    along = prescribe(problem.mechanics, problem.motion.at(t), bias)
    fastest = 2.0 * np.pi * MOST_TURNS / span
    y = np.stack([phi, np.broadcast_to(phi_dot, phi.shape)])
    rows = [np.stack([*y, _rate(problem, along, 0, y)[1]])]
    left = np.arange(len(phi))
    for k in range(steps):
        if k % _COUNTED == 0 and not budget.step():
            return []
        a = np.stack([y[1], rows[-1][2]])
        b = _rate(problem, along, 2 * k + 1, y + h / 2.0 * a)
        c = _rate(problem, along, 2 * k + 1, y + h / 2.0 * b)
        d = _rate(problem, along, 2 * k + 2, y + h * c)
        y = y + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        kept = np.all(np.abs(y[1]) < fastest, axis=1)  # false where it is not finite
        if not kept.all():
            y, left, rows = y[:, kept], left[kept], [each[:, kept] for each in rows]
        if not left.size:
            return []
        rows.append(np.stack([*y, _rate(problem, along, 2 * k + 2, y)[1]]))
    found = np.array(rows)
    return [Samples(t[::2], *(found[:, m, k] for m in range(3))) for k in range(len(left))]


def _rate(problem: Problem, along: PrescribedMotion, k: int, y: Array) -> Array:
    """(phi', phi'') (2, K, N) at time k of the prescribed motion: the smallest phi'' that solves (12)."""
    found = linear(along[k : k + 1], y[0], y[1], np.zeros_like(y[0]))
    root = problem.norm.root
    coupling = np.nan_to_num(
        root @ found.by_phi_ddot, posinf=0.0, neginf=0.0
    )  # a motion that is lost is left out above
    phi_ddot = -(np.linalg.pinv(coupling) @ (found.R @ root.T)[:, :, None])[:, :, 0]
    return np.stack([y[1], phi_ddot])


def angles_at(table: Samples, t: Array) -> Array:
    """phi (M, N; rad) of a table less its start speed: the part that the modes of a finite motion have."""
    return np.asarray(table.at(t).phi - t[:, None] * table.phi_dot[0])
