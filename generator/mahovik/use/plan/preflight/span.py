"""Span: directions of wrench that no motion of these flywheels can give."""

from __future__ import annotations

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.plan.preflight.outcome import Preflight, Refusal, direction
from mahovik.use.plan.problem import Problem

_RANK = 1e-7
"""Part of the largest singular value: a smaller column of I or dI/dphi counts as zero."""
_OUTSIDE = 1e-3
"""Largest accepted part of the required wrench outside the span."""


def check_span(problem: Problem, P: Array, found: Preflight) -> None:
    """Refuses where more than 1e-3 of the required P (M, 6) is outside the span of I_s(phi), dI_s/dphi at all phi.

    All of these are sums of the harmonics of I_s; scaled by K0^-1/2 and to one length each.
    """
    if problem.N < 6 and problem.N > 0:
        found.warnings.append(f"{problem.N} flywheels: only special motions have a programme; 6 or more give any")
    root = problem.norm.root
    columns = problem.mechanics.tables.coupling.reshape(-1, 6) @ root.T
    varying = (P - P.mean(axis=0)) @ root.T
    size = float(np.linalg.norm(varying, axis=1).max())
    if size <= 1e-9 * problem.norm.demand:
        return
    outside = varying
    if columns.size:
        _, sigma, Vt = np.linalg.svd(columns, full_matrices=False)
        kept = Vt[sigma > _RANK * sigma[0]]
        outside = varying - (varying @ kept.T) @ kept
    share = float(np.linalg.norm(outside, axis=1).max()) / size
    if share <= _OUTSIDE or found.refusal is not None:
        return
    found.refusal = Refusal(
        "SPAN", _words(np.linalg.solve(root, outside.T).T, np.linalg.solve(root, varying.T).T, share)
    )


def _words(outside: Array, needed: Array, share: float) -> str:
    """Message: which direction, how much of it, what would help."""
    parts = []
    for kind, rows, unit in (("force", slice(0, 3), "N"), ("moment", slice(3, 6), "N m")):
        part, whole = outside[:, rows], needed[:, rows]
        peak = float(np.linalg.norm(part, axis=1).max())
        if peak > _OUTSIDE * float(np.linalg.norm(whole, axis=1).max()) and peak > 0.0:
            u = np.linalg.svd(part, full_matrices=False)[2][0]
            parts.append(
                (peak / max(float(np.linalg.norm(whole, axis=1).max()), 1e-300), kind, direction(u), peak, unit)
            )
    parts.sort(reverse=True)
    _, kind, way, peak, unit = parts[0]
    helps = {
        "force": f"unbalanced flywheels whose axes are across {way} would help",
        "moment": f"flywheels with axes along {way}, or unbalanced ones off the axis, would help",
    }
    return (
        f"a {kind} along {way} of {peak:.3g} {unit} is required, which these flywheels cannot give at any angles or "
        f"speeds ({100 * share:.2g} % of the required wrench is out of their span); {helps[kind]}"
    )
