"""Rest of the carrier near a given pose while the flywheels stand still, and its derivatives by their angles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.errors import CheckError
from mahovik.use.plan.array import Array
from mahovik.use.plan.forward.chart import Chart
from mahovik.use.plan.forward.course import linearise_along
from mahovik.use.plan.forward.drive import Drive, drive

FREE = 1e-6
"""A direction with less than this part of the largest stiffness (relative to inertia) is free: the pose stays there."""

_STEP = 1e-6
"""Step of central differences: m, rad."""
_MOST, _LONGEST, _LAST = 50, 0.3, 1e-11
_LEFT = 1e-6
"""m/s2: an acceleration without stiffness to balance it that still counts as rest."""


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """y (12) at rest, V = 0, and its derivatives by the flywheels' angles (12, N).

    held   (12, 12): projection that removes displacements in directions free at rest from state differences
    """

    y: Array
    by_phi: Array
    held: Array


def equilibrium(chart: Chart, phi: Array, near: Array | None = None) -> Equilibrium:
    """Equilibrium at angles phi (N), by Newton's method from the pose of `near` (12), or from the chart's own.

    Steps are smallest in the inertia's norm, zero in free directions. Raises CheckError: there is no equilibrium.
    """
    still = np.zeros((1, len(phi)))
    given = drive(chart.mechanics, phi[None], still, still)
    root = np.linalg.cholesky(np.linalg.inv(given.inverse[0])).T  # x^T K x = |root x|^2
    y = np.zeros((1, 12))
    if near is not None:
        y[0, :6] = near[:6]
    for _ in range(_MOST):
        back, free = _compliance(chart, given, y, root)
        step = back @ chart.acceleration(given, y)[0]
        y[0, :6] += step * min(1.0, _LONGEST / max(float(np.abs(step).max()), 1e-300))
        if np.abs(step).max() < _LAST:
            break
    stand = chart.mechanics.stand
    left = root @ chart.acceleration(given, y)[0]
    size = float(np.linalg.norm(left)) / float(root[0, 0])
    if not size <= _LEFT * max(1.0, float(np.linalg.norm(stand.gravity))):
        why = "nothing holds it there" if free.size else "there is no equilibrium near the mean pose"
        raise CheckError(
            f"{stand.name}: no rest to run up from: with the flywheels stopped the carrier accelerates by {size:.3g} "
            f"m/s2; {why}"
        )
    by_phi = back @ given.inverse[0] @ linearise_along(chart, given, y, still).by_phi[0]
    held = np.eye(12)
    held[:6, :6] -= free @ free.T @ root.T @ root
    return Equilibrium(y[0], np.vstack([by_phi, np.zeros_like(by_phi)]), held)


def _compliance(chart: Chart, given: Drive, y: Array, root: Array) -> tuple[Array, Array]:
    """Displacement (6, 6) that balances an acceleration, zero in free directions; these (6, n), orthonormal in K."""
    aside = np.zeros((12, 12))
    aside[range(12), [*range(6), *range(6)]] = [_STEP] * 6 + [-_STEP] * 6
    moved = chart.acceleration(given[np.zeros(12, dtype=int)], y + aside)
    slopes = (moved[:6] - moved[6:]).T / (2.0 * _STEP)
    U, sigma, Vt = np.linalg.svd(-root @ slopes @ np.linalg.inv(root))
    kept = sigma > FREE * max(float(sigma[0]), 1e-9)
    inverse = (Vt[kept].T / sigma[kept]) @ U[:, kept].T
    back = np.linalg.inv(root)
    return back @ inverse @ root, np.asarray(back @ Vt[~kept].T)
