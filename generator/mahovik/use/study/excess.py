"""Is (12) singular in practice? A small demand on the carrier may need more of the flywheels than any motor has."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.stand.model import COMPONENTS, Stand
from mahovik.core.stand.state import rest_state
from mahovik.proof.reference import pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import bodies_of
from mahovik.proof.reference.inverse import CUTS, inverse_root, shares_of
from mahovik.proof.reference.motion import forward, torque
from mahovik.proof.reference.pieces import Pieces

SMALL = 1e-3
"""m/s2, rad/s2: what is demanded of one component, of the others zero."""

POSITIONS = 5
"""Positions of the flywheels, at rest, over which the median is taken."""

_SEED = 12


@dataclass(frozen=True)
class Excess:
    """The component whose small demand needs most: median over positions of the flywheels.

    component  of V*: vx vy vz wx wy wz
    flywheel   that needs most
    share      of what it has: 8.1e4 is eighty-one thousand times
    phi_ddot   its acceleration, rad/s2
    """

    component: str
    flywheel: str
    share: float
    phi_ddot: float

    def __str__(self) -> str:
        unit = "m/s2" if self.component.startswith("v") else "rad/s2"
        return (
            f"(12) is singular in practice: {SMALL:g} {unit} of {self.component} alone, all else at rest, needs "
            f"{self.phi_ddot:.3g} rad/s2 of {self.flywheel}, {self.share:.3g} times what it has (EXCESSIVE); name the "
            'rows that you need, [task.pointing] rows = ["wx", "wy", "wz"], and ask the task'
        )


def excess(stand: Stand) -> Excess | None:
    """What (12) needs at most for a small demand, if this is more than there is in most positions; else None.

    None of a held carrier, which (12) does not ask for all six components, nor of a stand whose tasks name what is
    asked.
    """
    if not stand.flywheels or stand.hold is not None or stand.tasks:
        return None
    bodies = bodies_of(stand)
    rng = np.random.default_rng(_SEED)
    still = rest_state(stand)
    found = np.zeros((POSITIONS, 6, len(stand.flywheels), 2))
    for k in range(POSITIONS):
        at = pieces(stand, replace(still, phi=tuple(rng.uniform(-np.pi, np.pi, len(stand.flywheels)))), bodies)
        shares, by_demand = shares_by(stand, at), _inverse_matrix(at)
        for i in range(6):
            # what gravity alone asks is no part of the demand
            phi_ddot = -SMALL * by_demand @ at.K[:, i]
            found[k, i, :, 0] = shares(phi_ddot)
            found[k, i, :, 1] = np.abs(phi_ddot)
    needed = np.sort(found, axis=0)[POSITIONS // 2]  # np.median would import numpy.ma
    i, s = divmod(int(np.argmax(needed[:, :, 0])), len(stand.flywheels))
    share, phi_ddot = needed[i, s]
    if not share > 1.0:
        return None
    return Excess(COMPONENTS[i], stand.flywheels[s].name, float(share), float(phi_ddot))


def _inverse_matrix(at: Pieces) -> Array:
    """phi'' of (12) by its right-hand side (N, 6): least residual, then least phi'', as `inverse` has them."""
    K_root, root = inverse_root(at.K), 1.0 / np.sqrt(np.diag(at.Theta_ff))
    return np.asarray(root[:, None] * np.linalg.pinv(K_root @ at.I * root, rcond=CUTS.rank) @ K_root)


def shares_by(stand: Stand, at: Pieces) -> Callable[[Array], Array]:
    """Need of each flywheel over what it has (N), as `shares_of`, by phi'' (N) with the motion that it makes.

    The drive torques are linear in both: tau = tau_0 + I^T V* + Theta_ff phi''.
    """
    still = torque(at, np.zeros(6), np.zeros(len(stand.flywheels)))

    def shares(phi_ddot: Array) -> Array:
        tau = still + at.I.T @ forward(at, phi_ddot) + np.diag(at.Theta_ff) * phi_ddot
        return shares_of(stand, at, tau, phi_ddot)

    return shares
