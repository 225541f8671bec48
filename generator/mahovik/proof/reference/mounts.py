"""Mount wrenches: what each flywheel's bearings and drive carry."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array, Values, columns, vector
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.rotation import C1
from mahovik.proof.reference.screw import block_diagonal
from mahovik.proof.reference.torque import mount_on_flywheel


def mounts(at: Pieces, V_dot: Array, phi_ddot: Array) -> Array:
    """diag(C1, C1)(phi_s) (Theta_s V_s* + Phi(V_s) Z_s - P_s) (Nx6; N, N m): of the mount on each flywheel.

    About Os, in the flywheel's axes at phi_s = 0, which do not turn. Element 4 is the drive torque.
    """
    wrenches = [
        block_diagonal(C1(s.phi)) @ mount_on_flywheel(s, at.P[s.body.name], at.V, V_dot, acceleration)
        for s, acceleration in zip(at.flywheels, phi_ddot, strict=True)
    ]
    return columns(wrenches, 6).T


def answer(at: Pieces, stand: Stand, state: State) -> Values:
    """mount_wrench (Nx6)."""
    return {"mount_wrench": mounts(at, vector(state.V_dot), vector(state.phi_ddot))}
