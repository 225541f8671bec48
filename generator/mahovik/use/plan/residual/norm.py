"""The norm of residuals: the same for any units, origin and axes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.prescribed import Mechanics, Prescribed

_STILL = 1e-9
"""Part of what the unbalance can do at the motion's frequency, below which a carrier counts as held still."""


@dataclass(frozen=True, eq=False)
class Norm:
    """max_t |root R(t)| / demand.

    root    6x6: G^-1 of K0 = G G^T, K0 the mean K over all angles: its norm is that of K0^-1/2
    demand  max_t |root (P(t) - mean P)|, P the wrench needed at locked flywheels
    """

    root: Array
    demand: float

    @staticmethod
    def of(at: Prescribed, span: float) -> Norm:
        """The norm of a motion prescribed at uniform times, for its period or duration (s).

        For a carrier to be held still: sum mu_s Omega^2 / sqrt(m) in place of the demand; without unbalance
        as well, what spinning inertias do at that frequency.
        """
        own = at.mechanics
        root = np.linalg.inv(np.linalg.cholesky(own.mean_inertia))
        P = at.locked() @ root.T
        demand = float(np.linalg.norm(P - P.mean(axis=0), axis=1).max())
        able = able_at(own, 2.0 * np.pi / span)
        return Norm(root, demand if demand > _STILL * able else able)

    def scaled(self, R: Array) -> Array:
        """root R / demand (M, 6), dimensionless."""
        return np.asarray(R @ (self.root.T / self.demand))

    def relative(self, R: Array) -> float:
        """Relative residual of R (M, 6)."""
        return float(np.linalg.norm(self.scaled(R), axis=1).max())


def able_at(own: Mechanics, Omega: float) -> float:
    """What all flywheels at the speed Omega (rad/s) can do together, in the norm's units."""
    K0 = own.mean_inertia
    by_force = own.tables.unbalance.sum() / np.sqrt(K0[0, 0])
    by_moment = own.tables.Theta_ff.sum() / np.sqrt(np.trace(K0[3:, 3:]) / 3.0)
    return float(max(by_force, 1e-3 * by_moment) * Omega**2)
