"""Mount wrenches: what each flywheel's bearings and drive carry."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array, Values, vector
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.rotation import C1
from mahovik.proof.reference.screw import block_diagonal
from mahovik.proof.reference.torque import mount_on_flywheel


def mounts(at: Pieces, V_dot: Array, phi_ddot: Array) -> Array:
    """diag(C1, C1)(phi_s) (Theta_s V_s* + Phi(V_s) Z_s - P_s) (Nx6; N, N m): of the mount on each flywheel.

    About Os, in the flywheel's axes at phi_s = 0, which do not turn. Element 4 is the drive torque.
    """
    wrenches = np.zeros((len(at.flywheels), 6))
    for row, s in enumerate(at.flywheels):
        in_Es = mount_on_flywheel(s, at.P[s.body.name], at.V, V_dot, phi_ddot[row])
        wrenches[row] = block_diagonal(C1(s.phi)) @ in_Es
    return wrenches


def answer(at: Pieces, stand: Stand, state: State) -> Values:
    """mount_wrench (Nx6)."""
    return {"mount_wrench": mounts(at, vector(state.V_dot), vector(state.phi_ddot))}
