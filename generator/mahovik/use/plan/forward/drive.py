"""Effect of given flywheel motions on the carrier in (8): sums over the flywheels, computed for all times first.

With these sums the carrier's acceleration needs 6-vectors only, for any number of flywheels:

    K V* = F - Theta' V - push - Phi(V) (Theta V + h) + weight,    K = Theta + K of carrier and instruments.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.plan.residual import Mechanics
from mahovik.use.plan.residual.flywheels import waves


@dataclass(frozen=True, eq=False)
class Drive:
    """Sums over the flywheels at times of any shape (...), in E1 about O1.

    inverse     (..., 6, 6): K^-1 of (2)
    Theta, Theta_dot   (..., 6, 6): sum Ls Theta_s Ls^T and its derivative
    h           (..., 6): sum I_s phi_s'
    push        (..., 6): sum I_s phi_s'' + I_s,phi (phi_s')^2
    weight      (..., 6, 3): wrench of weight and buoyancy by gravity in E1
    phi, phi_dot   (..., N): for flywheels with damping
    """

    inverse: Array
    Theta: Array
    Theta_dot: Array
    h: Array
    push: Array
    weight: Array
    phi: Array
    phi_dot: Array

    def __getitem__(self, index: object) -> Drive:
        return Drive(*(x[index] for x in vars(self).values()))


def drive(mechanics: Mechanics, phi: Array, phi_dot: Array, phi_ddot: Array) -> Drive:
    """Sums of the motions phi, phi', phi'' (..., N each; rad, s)."""
    tables, shape = mechanics.tables, phi.shape[:-1]
    N = mechanics.N
    h, slopes = (np.moveaxis(x, 0, -2).reshape(-1, 5 * N) for x in waves(phi))  # (moments, 5 N)
    speed, acceleration = (np.tile(x.reshape(-1, N), (1, 5)) for x in (phi_dot, phi_ddot))
    Theta_of, weight_of, coupling = (
        x.reshape(5 * N, -1) for x in (tables.Theta, tables.weight, tables.coupling)
    )  # fmt: skip
    Theta = (h @ Theta_of).reshape(*shape, 6, 6)
    return Drive(
        inverse=np.asarray(np.linalg.inv(Theta + mechanics.housing.K)),
        Theta=Theta,
        Theta_dot=((slopes * speed) @ Theta_of).reshape(*shape, 6, 6),
        h=((h * speed) @ coupling).reshape(*shape, 6),
        push=((h * acceleration + slopes * speed**2) @ coupling).reshape(*shape, 6),
        weight=(h @ weight_of).reshape(*shape, 6, 3),
        phi=phi,
        phi_dot=phi_dot,
    )
