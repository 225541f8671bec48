"""Bounds of speed and acceleration: the largest wrench that flywheels inside them can give."""

from __future__ import annotations

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.plan.preflight.outcome import Preflight, Refusal, direction
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.residual import Prescribed


def check_bound_reach(problem: Problem, at: Prescribed, found: Preflight) -> None:
    """Refuses where y . (P - mean P) exceeds what flywheels can give along a wrench direction y at their bounds.

    Along y a flywheel gives at most |y . I_s| a_s + |y . I'_s| w_s^2 + |y . C_s| w_s + |y . A_s| of (12), each the
    largest over its angle. The check needs bounds of both speed and acceleration.
    """
    bounds = problem.motion.bounds
    if bounds.speed is None or bounds.acceleration is None or problem.N == 0 or found.refusal is not None:
        return
    w, a = np.array(bounds.speed), np.array(bounds.acceleration)
    P = at.locked()
    varying = P - P.mean(axis=0)
    candidates = [np.eye(6)[k] for k in range(6)]
    candidates += [np.concatenate([u, np.zeros(3)]) for u in np.linalg.svd(varying[:, :3], full_matrices=False)[2]]
    candidates += [np.concatenate([np.zeros(3), u]) for u in np.linalg.svd(varying[:, 3:], full_matrices=False)[2]]
    worst, words = 1.0, ""
    for y in candidates:
        need = float(np.abs(varying @ y).max())
        have = float((_largest(problem.mechanics.still, y) * a + _largest(problem.mechanics.spun, y) * w**2).sum())
        have += float((_largest(at.moving, y) * w + _largest(at.fixed[1:], y)).sum())
        if need > worst * have and need > 1e-9 * problem.norm.demand:
            worst, words = need / max(have, 1e-300), _words(y, need, have)
    if words:
        found.refusal = Refusal("BOUND_REACH", words)


def _largest(harmonics: Array, y: Array) -> Array:
    """Largest |y . sum_h h(phi) x_h| over angles and times (N), of harmonics (5 or 4, 7, M, N): a bound of it."""
    along = np.einsum("himn,i->hmn", harmonics[:, :6], y)
    if len(along) == 4:
        along = np.concatenate([np.zeros_like(along[:1]), along])
    first, second = np.hypot(along[1], along[2]), np.hypot(along[3], along[4])
    return np.asarray((np.abs(along[0]) + first + second).max(axis=0))


def _words(y: Array, need: float, have: float) -> str:
    kind, u, unit = ("force", y[:3], "N") if np.any(y[:3]) else ("moment", y[3:], "N m")
    return (
        f"a {kind} along {direction(u)} of {need:.3g} {unit} is required, flywheels inside the bounds of speed and "
        f"acceleration give at most {have:.3g} {unit}; that is {need / max(have, 1e-300):.2g} times too little: raise "
        "these bounds, the unbalance or the number of flywheels, or make the motion smaller"
    )
