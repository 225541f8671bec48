"""Drive torques for a task within bounds: the motion of `coupled` is affine in the torques, so least squares decide.

a = S V* + s = a_0 + B tau with the columns of B by unit torques; the error counts in the norm of G^-1 with
G = S X S^T, X the block of carrier and carrier in the inverse of the full mass matrix (locked flywheels left out).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.proof.reference.array import Array
from mahovik.proof.reference.coupled import coupled_with_locks, full_mass_matrix, spin_up_torque
from mahovik.proof.reference.inverse import inverse_root
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.task import TaskRows


@dataclass(frozen=True, eq=False)
class TorqueDemand:
    """W y = r without units, y = Theta_ff^-1/2 (tau - preferred) (N); W (mxN), r (m).

    preferred  tau (N, N m) that gives the preferred accelerations to flywheels on a carrier with V* = 0
    B, a_0     a = a_0 + B tau (m; m/s2, rad/s2)
    root       G^-1/2 (mxm)
    """

    W: Array
    r: Array
    preferred: Array
    to_torque: Array
    B: Array
    a_0: Array
    root: Array

    def torque(self, y: Array) -> Array:
        """tau (N, N m) of a scaled answer."""
        return self.preferred + self.to_torque * y

    def from_torque(self, tau: Array) -> Array:
        """y (N) of torques."""
        return (tau - self.preferred) / self.to_torque


def torque_demand(at: Pieces, rows: TaskRows, demand: Array, preferred: Array, locked: Array) -> TorqueDemand:
    """The equation for the demand a (m), preferred accelerations (N, rad/s2) and `locked` (N, bool) flywheels."""
    N = len(at.flywheels)
    free = np.concatenate([np.full(6, True), np.logical_not(locked)])
    X = np.zeros((6 + N, 6 + N))
    X[np.ix_(free, free)] = np.linalg.inv(full_mass_matrix(at)[np.ix_(free, free)])
    a_0 = rows.acceleration(coupled_with_locks(at, np.zeros(N), locked)[0])
    B = rows.S @ X[:6, 6:]
    root = inverse_root(rows.S @ ((X + X.T) / 2)[:6, :6] @ rows.S.T)
    Theta = np.diag(at.Theta_ff)
    tau = Theta * preferred - spin_up_torque(at, np.zeros(N))
    to_torque = np.sqrt(Theta)
    return TorqueDemand(root @ B * to_torque, root @ (demand - a_0 - B @ tau), tau, to_torque, B, a_0, root)
