"""The motion: forward (8), drive torques, all unknowns together, mount wrenches, reaction, and what points measure.

A carrier moves as V = S u, S (6 x m) constant in E1; a free one as S = E. Its hold exerts a wrench R that does no work,
S^T R = 0, so (8) holds along the freedoms: S^T (K S u* + M V + I phi'' + J phi') = S^T F.
"""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand, State
from mahovik.errors import StateError
from mahovik.proof.reference.algebra import (
    C1,
    Array,
    Phi,
    Values,
    block_diagonal,
    cross,
    f,
    fixed_rotation,
    solve_symmetric,
    spin,
    times,
    transpose,
    vector,
    wrench_to_parent,
)
from mahovik.proof.reference.pieces import (
    Bodies,
    Pieces,
    instrument_transfer,
    mount_transfer,
)


def forward(at: Pieces, phi_ddot: Array) -> Array:
    """V* (6; m/s2, rad/s2) in E1 by (8), phi_ddot (N, rad/s2): K V* + M V + sum_s (I_s phi_s'' + J_s phi_s') = F."""
    return np.asarray(at.S @ rates(at, np.zeros(len(phi_ddot)), phi_ddot, np.full(len(phi_ddot), False))[0])


def reaction(at: Pieces, V_dot: Array, phi_ddot: Array) -> Array:
    """R = K V* + M V + I phi'' + J phi' - F (6; N, N m): of a hold that makes the carrier move so, about O1.

    What a force table under the carrier reads.
    """
    return np.asarray(at.K @ V_dot + at.bias + at.I @ phi_ddot - at.F)


# Drive torque: what the mount's drive exerts on each flywheel about its spin axis e1.


def flywheel_accelerations(s: Bodies, V: Array, V_dot: Array, phi_ddot: Array) -> Array:
    """V_s* = Ls^T V* - phi_s' [<e>] Ls^T V + f phi_s'' (Nx6; m/s2, rad/s2): of the components in Es."""
    Lt = transpose(s.L)
    return np.asarray(Lt @ V_dot - s.phi_dot[:, None] * (spin @ Lt @ V) + np.outer(phi_ddot, f))


def mounts_on_flywheels(s: Bodies, P_s: Array, V: Array, V_dot: Array, phi_ddot: Array) -> Array:
    """Theta_s V_s* + Phi(V_s) Z_s - P_s (Nx6; N, N m): (4) for each flywheel; of the mount on it, in Es about Os."""
    V_s, V_s_dot = s.twists(V), flywheel_accelerations(s, V, V_dot, phi_ddot)
    Z_s = times(s.Theta, V_s)
    return times(s.Theta, V_s_dot) + times(Phi(V_s), Z_s) - P_s


def torque(at: Pieces, V_dot: Array, phi_ddot: Array) -> Array:
    """tau_s = f^T (Theta_s V_s* + Phi(V_s) Z_s) - f^T P_s (N, N m); V_dot (6), phi_ddot (N)."""
    return np.asarray(mounts_on_flywheels(at.bodies.flywheels, at.P_s, at.V, V_dot, phi_ddot) @ f)


def mounts(at: Pieces, V_dot: Array, phi_ddot: Array) -> Array:
    """diag(C1, C1)(phi_s) (Theta_s V_s* + Phi(V_s) Z_s - P_s) (Nx6; N, N m): what bearings and drives carry.

    Of the mount on each flywheel about Os, in the flywheel's axes at phi_s = 0, which do not turn. Element 4 is the
    drive torque.
    """
    s = at.bodies.flywheels
    return times(block_diagonal(C1(s.phi)), mounts_on_flywheels(s, at.P_s, at.V, V_dot, phi_ddot))


# Coupled: motion of carrier and flywheels for given drive torques, m + N unknowns.


def full_mass_matrix(at: Pieces) -> Array:
    """[[S^T K S, S^T I], [I^T S, Theta_ff]] ((m+N)x(m+N)), symmetric positive definite."""
    return np.block([[at.S.T @ at.K @ at.S, at.S.T @ at.I], [at.I.T @ at.S, at.Theta_ff]])


def spin_up_torque(at: Pieces, tau: Array) -> Array:
    """tau - velocity terms + f^T P_s (N, N m): what is left of the drive torques tau (N) for the accelerations.

    The velocity terms are f^T (-phi_s' Theta_s [<e>] Ls^T V + Phi(V_s) Theta_s V_s).
    """
    s = at.bodies.flywheels
    return np.asarray(tau - mounts_on_flywheels(s, at.P_s, at.V, np.zeros(6), np.zeros(len(tau))) @ f)


def rates(at: Pieces, tau: Array, phi_ddot: Array, free: Array) -> tuple[Array, Array]:
    """u* (m) and phi'' (N): of flywheels that are `free` (N, bool) by their torques tau, of the others as given.

    S^T K S u* + S^T I phi'' = S^T (F - M V - J phi');
    I^T S u* + Theta_ff phi'' = tau - velocity terms + f^T P_s.
    """
    m = at.S.shape[1]
    right = at.S.T @ (at.F - at.bias - at.I @ np.where(free, 0.0, phi_ddot))
    if not np.any(free):
        return solve_symmetric(at.S.T @ at.K @ at.S, right), phi_ddot
    mass, right = full_mass_matrix(at), np.concatenate([right, spin_up_torque(at, tau)])
    result = np.concatenate([np.zeros(m), phi_ddot]).astype(right.dtype)
    unknown = np.flatnonzero(np.concatenate([np.full(m, True), free]))
    result[unknown] = solve_symmetric(mass[np.ix_(unknown, unknown)], right[unknown])
    return result[:m], result[m:]


def coupled(at: Pieces, tau: Array, locked: Array | None = None) -> tuple[Array, Array]:
    """V* (6; m/s2, rad/s2) in E1 and phi'' (N, rad/s2) for the whole drive torques tau (N, N m).

    `locked` (N, bool): flywheels held at phi'' = 0, whatever their tau, without their rows and columns, since their
    torques are reactions.
    """
    free = np.full(len(tau), True) if locked is None else np.logical_not(locked)
    u_dot, phi_ddot = rates(at, tau, np.zeros(len(tau)), free)
    return at.S @ u_dot, phi_ddot


# Points: pose, twist and what an accelerometer reads, at every instrument and named point.


def point_transfers(stand: Stand) -> dict[str, Array]:
    """L (6x6) to E1 about O1 of every instrument, then of every point, by name in the file's order."""
    transfers = {instrument.name: instrument_transfer(instrument) for instrument in stand.instruments}
    for point in stand.points:
        in_mount = wrench_to_parent(vector(point.position), fixed_rotation(*point.angles))
        transfers[point.name] = mount_transfer(stand, point.mount) @ in_mount
    return transfers


def point_values(at: Pieces, L: Array, V_dot: Array) -> dict[str, Array]:
    """Values of one frame fixed on the carrier, L (6x6) its transfer to E1; V_dot (6) of the carrier.

    position (3, m, E0); C (3x3, own axes to E0); in own axes: twist (6, relative to E0), specific_force (3, m/s2,
    acceleration less gravity), angular_acceleration (3, rad/s2).
    """
    to_E0 = at.L1 @ L
    C = to_E0[:3, :3]
    O_cross = to_E0[3:, :3] @ C.T  # <O> of L = T [C]
    V_p, V_p_dot = L.T @ at.V, L.T @ V_dot
    v, omega = V_p[:3], V_p[3:]
    return {
        "position": np.array([O_cross[2, 1], O_cross[0, 2], O_cross[1, 0]]),
        "C": C,
        "twist": V_p,
        "specific_force": V_p_dot[:3] + cross(omega) @ v - L[:3, :3].T @ at.gravity,
        "angular_acceleration": V_p_dot[3:],
    }


def points(at: Pieces, stand: Stand, V_dot: Array) -> dict[str, dict[str, Array]]:
    """Values of every instrument and point by name."""
    return {name: point_values(at, L, V_dot) for name, L in point_transfers(stand).items()}


# Answers to wants.


def answer_forward(at: Pieces, stand: Stand, state: State) -> Values:
    """V_dot (6) for the phi_ddot of the state; of a held carrier u_dot (m) and the reaction (6) as well."""
    phi_ddot = vector(state.phi_ddot)
    none = np.zeros(len(phi_ddot))
    return _motion(at, stand, *rates(at, none, phi_ddot, none.astype(bool)))


def answer_coupled(at: Pieces, stand: Stand, state: State) -> Values:
    """What `forward` answers and phi_ddot (N), for the drive torques of the state."""
    tau = vector(state.tau)
    u_dot, phi_ddot = rates(at, tau, np.zeros(len(tau)), np.full(len(tau), True))
    return _motion(at, stand, u_dot, phi_ddot) | {"phi_ddot": phi_ddot}


def _motion(at: Pieces, stand: Stand, u_dot: Array, phi_ddot: Array) -> Values:
    V_dot = at.S @ u_dot
    if stand.hold is None:
        return {"V_dot": V_dot}
    return {"u_dot": u_dot, "V_dot": V_dot, "reaction": reaction(at, V_dot, phi_ddot)}


def answer_reaction(at: Pieces, stand: Stand, state: State) -> Values:
    """reaction (6) for the V_dot and phi_ddot of the state. StateError: the carrier is free."""
    if stand.hold is None:
        raise StateError('want: "reaction" is of held carriers, and the stand has no [hold]: ask for forward')
    return {"reaction": reaction(at, vector(state.V_dot), vector(state.phi_ddot))}
