"""Scales of the answers to each want, as sums of magnitudes, in the same shapes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from mahovik.proof.reference.generalized import generalized as reference_generalized
from mahovik.proof.reference.inverse import inverse as literal_inverse
from mahovik.proof.reference.inverse import inverse_root
from mahovik.proof.reference.momentum import moving_parts
from mahovik.proof.reference.motion import coupled_with_locks, full_mass_matrix, point_transfers
from mahovik.proof.reference.motion import forward as reference_forward
from mahovik.proof.reference.pieces import bodies_matrix
from mahovik.proof.verify.scales.held import held_coupled, held_forward, held_generalized
from mahovik.proof.verify.scales.magnitudes import Array, Magnitudes, geometric_mean, inverse_magnitude, origin, screw
from mahovik.proof.verify.scales.parts import length
from mahovik.proof.verify.scales.wrenches import own_scale


def flywheel_wrenches(m: Magnitudes, V_dot: Array, phi_ddot: Array) -> Array:
    """Scale of Theta_s V_s* + Phi(V_s) Z_s - P_s (Nx6): force and moment by their lengths."""
    v, omega = length(m.S_V[:3]), length(m.S_V[3:])
    a, alpha = length(V_dot[:3]), length(V_dot[3:])
    found = np.zeros((len(m.speed), 6))
    for row, s in enumerate(m.at.flywheels):
        spin, arm = abs(s.phi_dot), length(origin(s.L))
        mass, first_moment = s.body.mass, s.body.mass * length(np.array(s.body.center_of_mass))
        J = float(np.trace(s.Theta[3:, 3:]))
        v_s, omega_s = v + arm * omega, omega + spin
        a_s = a + arm * alpha + spin * v_s
        alpha_s = alpha + spin * omega + abs(phi_ddot[row])
        p, h = mass * v_s + first_moment * omega_s, first_moment * v_s + J * omega_s
        force = mass * a_s + first_moment * alpha_s + omega_s * p
        moment = first_moment * a_s + J * alpha_s + omega_s * h + v_s * p
        P = own_scale(m.stand, m.state, m.at, s.body.name)
        found[row] = screw(force + length(P[:3]), moment + length(P[3:]))
    return found


def given_motion(m: Magnitudes) -> Array:
    """Scale of the flywheels' wrenches for the V_dot and phi_ddot of the state."""
    return flywheel_wrenches(m, np.array(m.state.V_dot), np.array(m.state.phi_ddot, dtype=np.float64))


def torque(m: Magnitudes) -> dict[str, Any]:
    """Scale of tau."""
    return {"tau": given_motion(m)[:, 3]}


def mounts(m: Magnitudes) -> dict[str, Any]:
    """Scale of mount_wrench."""
    return {"mount_wrench": given_motion(m)}


def points(m: Magnitudes) -> dict[str, Any]:
    """Scales of points, by name and value."""
    V_dot = np.array(m.state.V_dot)
    v, omega = length(m.at.V[:3]), length(m.at.V[3:])
    a, alpha = length(V_dot[:3]), length(V_dot[3:])
    gravity, away = length(m.at.gravity), length(np.array(m.state.position))
    found = {}
    for name, L in point_transfers(m.stand):
        arm = length(origin(L))
        moved = v + arm * omega
        found[name] = {
            "position": np.full(3, away + arm),
            "C": np.ones((3, 3)),
            "twist": screw(moved, omega),
            "specific_force": np.full(3, a + arm * alpha + omega * moved + gravity),
            "angular_acceleration": np.full(3, alpha),
        }
    return {"points": found}


def matrices(m: Magnitudes) -> dict[str, Any]:
    """Scales of K, K_dot, M, I, J, F."""
    return {"K": m.S_K, "K_dot": m.S_K_dot, "M": m.S_M, "I": m.S_I, "J": m.S_J, "F": m.S_F}


def momentum(m: Magnitudes) -> dict[str, Any]:
    """Scales of Z, Z0, energy, center_of_mass (against the radius of gyration about O1)."""
    Z = m.S_K @ m.S_V + m.S_I @ m.speed
    p, h = length(Z[:3]), length(Z[3:])
    Theta_ff = np.diag(m.at.Theta_ff)
    coupling = float(m.S_V @ m.S_I @ m.speed)
    energy = 0.5 * (float(m.S_V @ m.S_K @ m.S_V) + 2 * coupling + float(m.speed @ (Theta_ff * m.speed)))
    mass = sum(body.mass for body in m.stand.bodies)
    J = np.diag(bodies_matrix(m.at.fixed, m.at.flywheels))[3:]
    gyration = float(np.sqrt(np.sum(J) / mass)) if mass else 0.0
    return {
        "Z": Z,
        "Z0": screw(p, h + length(np.array(m.state.position)) * p),
        "energy": np.array(energy),
        "center_of_mass": np.full(3, gyration),
    }


def forward(m: Magnitudes) -> dict[str, Any]:
    """Scale of V_dot; of u_dot and reaction as well where the carrier is held."""
    return {"V_dot": forward_scale(m)} if m.stand.hold is None else held_forward(m)


def reaction(m: Magnitudes) -> dict[str, Any]:
    """Scale of reaction for the V_dot and phi_ddot of the state."""
    moved = np.abs(np.array(m.state.V_dot)) + m.stream_rate
    return {"reaction": m.S_bias + m.S_I @ m.acceleration + m.S_K @ moved}


def forward_scale(m: Magnitudes) -> Array:
    """|K^-1| (S_F + S_M |V| + S_J |phi'| + S_I |phi''| + S_K |V_dot|), and the turning stream."""
    V_dot = reference_forward(m.at, np.array(m.state.phi_ddot, dtype=np.float64))
    right = m.S_bias + m.S_I @ m.acceleration + m.S_K @ np.abs(m.at.V_r_dot(V_dot))
    return np.asarray(m.K_inverse @ right + m.stream_rate)


def generalized(m: Magnitudes) -> dict[str, Any]:
    """Scales of A, D, I0, J0, q_dot, q_ddot: nearness to the singular attitude enters through |A^-1|."""
    if m.stand.hold is not None:
        return held_generalized(m)
    found = reference_generalized(m.at, m.stand.angles, m.state)
    S_A = np.kron(np.eye(2), np.ones((3, 3)))  # elements of rotations
    A_inv = np.abs(np.linalg.inv(found.A))
    S_q_dot = A_inv @ (m.S_V + S_A @ np.abs(found.q_dot))
    rates = float(S_q_dot[3:].sum())
    S_D = rates * S_A  # turning of axes with the angles' rates: larger than omega near the singular attitude
    S_I0 = m.S_K @ S_A
    S_J0 = m.S_K @ S_D + m.S_M @ S_A
    right = m.S_bias + m.S_I @ m.acceleration + S_J0 @ S_q_dot + S_I0 @ np.abs(found.q_ddot)
    solved = A_inv @ (m.K_inverse @ right)
    direct = A_inv @ (forward_scale(m) + S_D @ S_q_dot)
    return {
        "A": S_A,
        "D": S_D,
        "I0": S_I0,
        "J0": S_J0,
        "q_dot": S_q_dot,
        "q_ddot": solved + direct,
    }


def coupled(m: Magnitudes, locked: Array | None = None) -> dict[str, Any]:
    """Scales of V_dot, phi_ddot, through the magnitudes of the full inverse; `locked` (N, bool) flywheels are held."""
    tau = np.array(m.state.tau, dtype=np.float64)
    locked = np.zeros(len(tau), dtype=bool) if locked is None else locked
    still = flywheel_wrenches(m, np.zeros(6), np.zeros(len(tau)))[:, 3]
    if m.stand.hold is not None:
        return held_coupled(m, m.stand.hold, np.abs(tau) + still, locked)
    V_dot, phi_ddot = coupled_with_locks(m.at, tau, locked)
    free = np.concatenate([np.full(6, True), np.logical_not(locked)])
    full = full_mass_matrix(m.at)[np.ix_(free, free)]
    right = np.concatenate([m.S_bias, np.abs(tau) + still])[free]
    solution = np.abs(np.concatenate([m.at.V_r_dot(V_dot), phi_ddot]))[free]
    found = np.zeros(len(free))
    found[free] = inverse_magnitude(full) @ (right + geometric_mean(np.diag(full)) @ solution)
    return {"V_dot": found[:6] + m.stream_rate, "phi_ddot": found[6:]}


def inverse(m: Magnitudes, rank: int | None = None) -> dict[str, Any]:
    """Scales of phi_ddot, residual, sigma; status and rank must be equal. First-order perturbation of least squares.

    `rank`: how many singular values count, where that is given. K, I: along the freedoms where the carrier is held.

    With G the weighted pseudoinverse of I: phi'' moves by G (errors of demand and I phi'' and K), by
    (I^T K^-1 I)^+ (errors of I^T) K^-1 residual, and inside the null space by (errors of I^T) G^T Theta_ff phi''.
    """
    found, free = literal_inverse(m.at, m.stand, np.array(m.state.V_dot), m.cuts, rank), m.free
    demand = free.S.T @ _demand(m)
    if not found.sigma.size:
        return {"phi_ddot": np.zeros(0), "status": None, "residual": demand, "sigma": np.zeros(0), "rank": None}
    K_root, Theta_root = inverse_root(free.K), inverse_root(m.at.Theta_ff)
    U, sigma, Vt = np.linalg.svd(K_root @ free.I @ Theta_root.T, full_matrices=False)
    U, kept, Vt = U[:, : found.rank], sigma[: found.rank], Vt[: found.rank]
    N = len(m.speed)
    G = Theta_root.T @ (Vt.T / kept) @ U.T @ K_root
    normal = Theta_root.T @ (Vt.T / kept**2) @ Vt @ Theta_root
    null = Theta_root.T @ (np.eye(N) - Vt.T @ Vt) @ Theta_root
    pulled = np.abs(free.K @ G.T @ m.at.Theta_ff)  # G^T in the weighted sense
    base = demand + free.S_I @ np.abs(found.phi_ddot)
    rest = free.K_inverse @ np.abs(found.residual)
    back = np.abs(G.T @ m.at.Theta_ff @ found.phi_ddot)
    S_K, S_I = free.S_K, free.S_I
    phi_ddot = np.abs(G) @ (base + S_K @ rest) + np.abs(normal) @ (S_I.T @ rest) + np.abs(null) @ (S_I.T @ back)
    residual = base + np.abs(free.I @ G) @ base + pulled @ np.abs(inverse_magnitude(m.at.Theta_ff)) @ (S_I.T @ rest)
    spread = float(np.linalg.norm(np.abs(K_root) @ S_I @ np.abs(Theta_root.T)))
    return {
        "phi_ddot": phi_ddot,
        "status": None,
        "residual": residual,
        "sigma": np.full(sigma.size, spread + sigma[0] * float(np.linalg.norm(free.K_inverse @ S_K))),
        "rank": None,
    }


def _demand(m: Magnitudes) -> Any:
    """Scale of F - K V_r* - M V_r - J phi' (6)."""
    V_r_dot = np.abs(np.array(m.state.V_dot)) + m.stream_rate
    return m.S_bias + m.S_K @ V_r_dot


def center_of_mass_velocity(m: Magnitudes) -> dict[str, Any]:
    """The sum of the reference, of lengths: v, omega times the distances, and the flywheels' own turning.

    `math.hypot` keeps lengths of 1e-200 that a root of squares would lose.
    """
    v, omega = np.split(m.at.V, 2)
    total = mass = 0.0
    for k, _ in moving_parts(m.at):
        arm = math.hypot(*k.body.center_of_mass)
        place = float(np.linalg.norm(k.L[3:, :3]))
        speed = math.hypot(*v) + math.hypot(*omega) * (place + arm) + abs(getattr(k, "phi_dot", 0.0)) * arm
        mass += k.body.mass
        total += k.body.mass * speed
    return {"center_of_mass_velocity": np.full(3, total / mass if mass else 0.0)}
