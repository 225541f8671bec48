"""Scales of the direct problem: matrices, momentum, forward, generalized."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.proof.reference.forward import forward as reference_forward
from mahovik.proof.reference.generalized import generalized as reference_generalized
from mahovik.proof.reference.mass import bodies_matrix
from mahovik.proof.verify.scales.magnitudes import Array, Magnitudes, screw
from mahovik.proof.verify.scales.parts import length


def matrices(m: Magnitudes) -> dict[str, Any]:
    """K, K_dot, M, I, J, F."""
    return {"K": m.S_K, "K_dot": m.S_K_dot, "M": m.S_M, "I": m.S_I, "J": m.S_J, "F": m.S_F}


def momentum(m: Magnitudes) -> dict[str, Any]:
    """Z, Z0, energy, center_of_mass (against the radius of gyration about O1)."""
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
    """V_dot."""
    return {"V_dot": forward_scale(m)}


def forward_scale(m: Magnitudes) -> Array:
    """|K^-1| (S_F + S_M |V| + S_J |phi'| + S_I |phi''| + S_K |V_dot|), and the turning stream."""
    V_dot = reference_forward(m.at, np.array(m.state.phi_ddot, dtype=np.float64))
    right = m.S_bias + m.S_I @ m.acceleration + m.S_K @ np.abs(m.at.V_r_dot(V_dot))
    return np.asarray(m.K_inverse @ right + m.stream_rate)


def generalized(m: Magnitudes) -> dict[str, Any]:
    """A, D, I0, J0, q_dot, q_ddot: nearness to the singular attitude enters through |A^-1|."""
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
