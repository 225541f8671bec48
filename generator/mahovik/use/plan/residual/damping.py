"""Damping of one body in its own frame, (7), for M twists at once, with its derivative by the twist."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Damping
from mahovik.use.plan.array import Array


def damping_wrench(damping: Damping, v: Array) -> Array:
    """-(linear v) - (quadratic (v |v|)) + terms (M, 6; N, N m), of twists relative to the fluid v (M, 6)."""
    P = np.zeros_like(v)
    if damping.linear is not None:
        P -= v @ np.array(damping.linear).T
    if damping.quadratic is not None:
        P -= (v * np.abs(v)) @ np.array(damping.quadratic).T
    for term in damping.terms:
        first, second = (np.abs(v[:, a.component]) if a.absolute else v[:, a.component] for a in term.of)
        P[:, term.wrench] += term.value * first * second
    return P


def damping_rate(damping: Damping, v: Array) -> Array:
    """dP/dv (M, 6, 6) of damping_wrench. |v| has the slope 0 at v = 0."""
    D = np.zeros((*v.shape, 6))
    if damping.linear is not None:
        D -= np.array(damping.linear)
    if damping.quadratic is not None:
        D -= np.array(damping.quadratic) * (2.0 * np.abs(v))[:, None, :]
    for term in damping.terms:
        values = [np.abs(v[:, a.component]) if a.absolute else v[:, a.component] for a in term.of]
        slopes = [np.sign(v[:, a.component]) if a.absolute else np.ones(len(v)) for a in term.of]
        for own, other in ((0, 1), (1, 0)):
            D[:, term.wrench, term.of[own].component] += term.value * slopes[own] * values[other]
    return D
