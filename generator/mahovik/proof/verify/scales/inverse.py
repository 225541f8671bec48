"""Scales of what is solved for flywheels: coupled, inverse."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.proof.reference.coupled import coupled as reference_coupled
from mahovik.proof.reference.coupled import full_mass_matrix
from mahovik.proof.reference.inverse import inverse as reference_inverse
from mahovik.proof.reference.inverse import inverse_root
from mahovik.proof.verify.scales.magnitudes import Magnitudes, geometric_mean, inverse_magnitude
from mahovik.proof.verify.scales.mounts import flywheel_wrenches


def coupled(m: Magnitudes) -> dict[str, Any]:
    """V_dot, phi_ddot through the magnitudes of the full inverse."""
    tau = np.array(m.state.tau, dtype=np.float64)
    V_dot, phi_ddot = reference_coupled(m.at, tau)
    full = full_mass_matrix(m.at)
    still = flywheel_wrenches(m, np.zeros(6), np.zeros(len(tau)))[:, 3]
    right = np.concatenate([m.S_bias, np.abs(tau) + still])
    solution = np.abs(np.concatenate([m.at.V_r_dot(V_dot), phi_ddot]))
    found = inverse_magnitude(full) @ (right + geometric_mean(np.diag(full)) @ solution)
    return {"V_dot": found[:6] + m.stream_rate, "phi_ddot": found[6:]}


def inverse(m: Magnitudes) -> dict[str, Any]:
    """phi_ddot, residual, sigma; status and rank must be equal. First-order perturbation of least squares.

    With G the weighted pseudoinverse of I: phi'' moves by G (errors of demand and I phi'' and K), by
    (I^T K^-1 I)^+ (errors of I^T) K^-1 residual, and inside the null space by (errors of I^T) G^T Theta_ff phi''.
    """
    found = reference_inverse(m.at, np.array(m.state.V_dot), m.cuts)
    if not found.sigma.size:
        return {"phi_ddot": np.zeros(0), "status": None, "residual": _demand(m), "sigma": np.zeros(0), "rank": None}
    K_root, Theta_root = inverse_root(m.at.K), inverse_root(m.at.Theta_ff)
    U, sigma, Vt = np.linalg.svd(K_root @ m.at.I @ Theta_root.T, full_matrices=False)
    U, kept, Vt = U[:, : found.rank], sigma[: found.rank], Vt[: found.rank]
    N = len(m.speed)
    G = Theta_root.T @ (Vt.T / kept) @ U.T @ K_root
    normal = Theta_root.T @ (Vt.T / kept**2) @ Vt @ Theta_root
    null = Theta_root.T @ (np.eye(N) - Vt.T @ Vt) @ Theta_root
    pulled = np.abs(m.at.K @ G.T @ m.at.Theta_ff)  # G^T in the weighted sense
    base = _demand(m) + m.S_I @ np.abs(found.phi_ddot)
    rest = m.K_inverse @ np.abs(found.residual)
    back = np.abs(G.T @ m.at.Theta_ff @ found.phi_ddot)
    phi_ddot = np.abs(G) @ (base + m.S_K @ rest) + np.abs(normal) @ (m.S_I.T @ rest) + np.abs(null) @ (m.S_I.T @ back)
    residual = base + np.abs(m.at.I @ G) @ base + pulled @ np.abs(inverse_magnitude(m.at.Theta_ff)) @ (m.S_I.T @ rest)
    spread = float(np.linalg.norm(np.abs(K_root) @ m.S_I @ np.abs(Theta_root.T)))
    return {
        "phi_ddot": phi_ddot,
        "status": None,
        "residual": residual,
        "sigma": np.full(sigma.size, spread + sigma[0] * float(np.linalg.norm(m.K_inverse @ m.S_K))),
        "rank": None,
    }


def _demand(m: Magnitudes) -> Any:
    """Scale of F - K V_r* - M V_r - J phi' (6)."""
    V_r_dot = np.abs(np.array(m.state.V_dot)) + m.stream_rate
    return m.S_bias + m.S_K @ V_r_dot
