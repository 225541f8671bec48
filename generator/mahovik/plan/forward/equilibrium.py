"""Where the carrier rests while flywheels stand still, near a given pose, and how that moves with their angles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.errors import CheckError
from mahovik.plan.array import Array
from mahovik.plan.forward.carrier import Carrier, acceleration, stream_rate
from mahovik.plan.forward.drive import Drive, drive
from mahovik.plan.forward.sensitivity import by_displacement
from mahovik.plan.residual import Mechanics, linear
from mahovik.plan.residual.kinematics import Twists
from mahovik.plan.residual.prescribed import prescribed_at

FREE = 1e-6
"""Part of the largest stiffness (both by the inertia) below which a direction is free: there the pose stays."""

_MOST, _LONGEST, _LAST = 50, 0.3, 1e-11
_LEFT = 1e-6
"""m/s2: an acceleration that no stiffness takes up, and that is still rest."""


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """A pose at rest (one state, V = 0), and its displacements in E1 by the flywheels' angles (6, N; m/rad, 1)."""

    state: Carrier
    by_phi: Array


def equilibrium(mechanics: Mechanics, phi: Array, near: Carrier) -> Equilibrium:
    """The equilibrium for angles phi (N) that Newton's steps find from a pose `near` (one state).

    Steps are the least in the inertia's norm, and none in free directions. Raises CheckError: there is none.
    """
    still = np.zeros((1, mechanics.N))
    at = drive(mechanics, phi[None], still, still)
    root = np.linalg.cholesky(np.linalg.inv(at.inverse[0])).T  # x^T K x = |root x|^2
    state = near._replace(V=np.zeros((1, 6)))
    for _ in range(_MOST):
        pull = acceleration(mechanics, at, state)[0]
        back, kept = _compliance(mechanics, at, state, root)
        step = back @ pull
        state = state.displaced((step * min(1.0, _LONGEST / max(float(np.abs(step).max()), 1e-300)))[None])
        if np.abs(step).max() < _LAST:
            break
    left = root @ acceleration(mechanics, at, state)[0]
    size = float(np.linalg.norm(left)) / float(root[0, 0])
    if not size <= _LEFT * max(1.0, float(np.linalg.norm(mechanics.stand.gravity))):
        raise CheckError(
            f"{mechanics.stand.name}: no rest for a run-up to start from: with the flywheels still the carrier accelerates "
            f"by {size:.3g} m/s2; {'nothing holds it' if kept < 6 else 'no equilibrium is near the mean pose'}"
        )
    V_r, rate = stream_rate(mechanics.stand, state.C, state.V)
    resting = prescribed_at(mechanics, Twists(state.C, state.O1, state.V, V_r, rate))
    by_phi = at.inverse[0] @ linear(resting, phi[None], still, still).by_phi[0]
    return Equilibrium(state, _compliance(mechanics, at, state, root)[0] @ by_phi)


def _compliance(mechanics: Mechanics, at: Drive, state: Carrier, root: Array) -> tuple[Array, int]:
    """Displacement (6, 6) by V* that is to be balanced, none in free directions; how many are not free."""
    stiffness = root @ by_displacement(mechanics, at, state)[0] @ np.linalg.inv(root)
    U, sigma, Vt = np.linalg.svd(-stiffness)
    kept = sigma > FREE * max(float(sigma[0]), 1e-9)
    inverse = (Vt[kept].T / sigma[kept]) @ U[:, kept].T
    return np.linalg.inv(root) @ inverse @ root, int(kept.sum())
