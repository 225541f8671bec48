"""First moment: force is the second derivative of sum m_s rho_s(phi_s), so total unbalance bounds the amplitude."""

from __future__ import annotations

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.plan.preflight.outcome import Preflight, Refusal, direction
from mahovik.use.plan.problem import Problem

_DIRECTIONS = 400
_SLACK = 1.01
"""Margin: the carrier turns a little under the flywheels, and the mean pose may move."""
_NEAR, _NEAR_OF_SIX = 0.5, 0.15
"""Shares of the limit beyond which a search often fails, for more flywheels than six and for six."""


def check_first_moment(problem: Problem, force: Array, C: Array, found: Preflight) -> None:
    """Refuses where half the range of u . G exceeds sum mu_s sqrt(1 - (u . e_s)^2) in some direction u.

    force (M, 3; N) in E0 at uniform times: required from the flywheels with centres of mass on their axes; its second
    integral is G, kg m. C (M, 3, 3): attitude. The condition is necessary, not sufficient.
    """
    tables = problem.mechanics.tables
    varying = np.hstack([force - force.mean(axis=0), np.zeros_like(force)])
    if problem.norm.relative(varying) <= problem.tolerance:
        return
    G = second_integral(force, problem.motion.span)
    need, have, way = reach(G, C @ tables.axis.T, tables.unbalance)
    found.reach = need / have if have > 0.0 else np.inf
    near = _NEAR if problem.N > 6 else _NEAR_OF_SIX
    if found.reach > _SLACK:
        where = direction(way)
        found.refusal = found.refusal or Refusal(
            "FIRST_MOMENT",
            f"along {where} the motion needs a first moment of +-{need:.3g} kg m from the flywheels; all "
            f"their unbalance across it is {have:.3g} kg m, at any speed; possible with {100 / found.reach:.2g} % "
            f"of this amplitude, or with {found.reach:.3g} times the unbalance",
        )
    elif found.reach > near:
        found.warnings.append(
            f"near the limit of the unbalance: {100 * found.reach:.2g} % of it is needed along {direction(way)}"
        )


def second_integral(force: Array, period: float) -> Array:
    """Twice integrated by Fourier series (M, ...), its mean and that of `force` removed."""
    spectrum = np.fft.rfft(force, axis=0)
    k = np.arange(len(spectrum), dtype=np.float64)
    k[0] = np.inf
    spectrum /= -((2.0 * np.pi / period * k) ** 2)[:, None]
    return np.fft.irfft(spectrum, len(force), axis=0)


def reach(G: Array, axes: Array, unbalance: Array) -> tuple[float, float, Array]:
    """Need and available amount (kg m) in the direction with the largest ratio; axes (M, 3, N) in E0."""
    rng = np.random.default_rng(0)
    principal = np.linalg.svd(G, full_matrices=False)[2]
    candidates = np.vstack([np.eye(3), rng.normal(size=(_DIRECTIONS, 3)), principal, _widest(G)])
    candidates /= np.linalg.norm(candidates, axis=1, keepdims=True)
    along = G @ candidates.T
    need = (along.max(axis=0) - along.min(axis=0)) / 2.0
    some = axes[:: max(1, len(axes) // 16)]
    across = np.sqrt(np.maximum(1.0 - (candidates @ some) ** 2, 0.0))  # (m, ways, N)
    have = (across.max(axis=0) * unbalance).sum(axis=1)
    worst = int(np.argmax(need / np.maximum(have, 1e-300)))
    return float(need[worst]), float(have[worst]), np.asarray(candidates[worst])


def _widest(G: Array) -> Array:
    """Directions (n, 3) of the largest differences of G."""
    some = G[:: max(1, len(G) // 64)]
    apart = (some[:, None] - some[None, :]).reshape(-1, 3)
    sizes = np.linalg.norm(apart, axis=1)
    return np.asarray(apart[np.argsort(sizes)[-20:]] + 1e-300)
