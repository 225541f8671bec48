"""Where the carrier rests while flywheels stand still, near a given pose, and how that moves with their angles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.errors import CheckError
from mahovik.use.plan.array import Array
from mahovik.use.plan.forward.chart import Chart
from mahovik.use.plan.forward.course import along
from mahovik.use.plan.forward.drive import Drive, drive

FREE = 1e-6
"""Part of the largest stiffness (both by the inertia) below which a direction is free: there the pose stays."""

_STEP = 1e-6
"""m, rad: of central differences."""
_MOST, _LONGEST, _LAST = 50, 0.3, 1e-11
_LEFT = 1e-6
"""m/s2: an acceleration that no stiffness takes up, and that is still rest."""


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """y (12) at rest, V = 0, and its derivatives by the flywheels' angles (12, N).

    held   (12, 12): takes out of differences of states the displacements in directions that are free at rest
    """

    y: Array
    by_phi: Array
    held: Array


def equilibrium(chart: Chart, phi: Array, near: Array | None = None) -> Equilibrium:
    """The equilibrium for angles phi (N) that Newton's steps find from the pose of `near` (12), or the chart's own.

    Steps are the least in the inertia's norm, and none in free directions. Raises CheckError: there is none.
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
        why = "nothing holds it" if free.size else "no equilibrium is near the mean pose"
        raise CheckError(
            f"{stand.name}: no rest to run up from: with the flywheels still the carrier accelerates by {size:.3g} "
            f"m/s2; {why}"
        )
    by_phi = back @ given.inverse[0] @ along(chart, given, y, still).by_phi[0]
    held = np.eye(12)
    held[:6, :6] -= free @ free.T @ root.T @ root
    return Equilibrium(y[0], np.vstack([by_phi, np.zeros_like(by_phi)]), held)


def _compliance(chart: Chart, given: Drive, y: Array, root: Array) -> tuple[Array, Array]:
    """Displacement (6, 6) that balances an acceleration, none in free directions; these (6, n), orthonormal in K."""
    aside = np.zeros((12, 12))
    aside[range(12), [*range(6), *range(6)]] = [_STEP] * 6 + [-_STEP] * 6
    moved = chart.acceleration(given[np.zeros(12, dtype=int)], y + aside)
    slopes = (moved[:6] - moved[6:]).T / (2.0 * _STEP)
    U, sigma, Vt = np.linalg.svd(-root @ slopes @ np.linalg.inv(root))
    kept = sigma > FREE * max(float(sigma[0]), 1e-9)
    inverse = (Vt[kept].T / sigma[kept]) @ U[:, kept].T
    back = np.linalg.inv(root)
    return back @ inverse @ root, np.asarray(back @ Vt[~kept].T)
