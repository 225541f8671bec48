"""R of (12) and drive torques at given flywheel motions, with derivatives by angle, speed and acceleration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.use.numeric.array import Array
from mahovik.use.numeric.flywheels import Tables, f, waves
from mahovik.use.numeric.prescribed_motion import PrescribedMotion
from mahovik.use.numeric.se3 import block_diagonal, skew, turn

_SPIN = block_diagonal(skew(np.array([1.0, 0.0, 0.0])))  # [<e>] of (5)


@dataclass(frozen=True, eq=False)
class Linear:
    """R (M, 6; N, N m) = F - K V* - M V - J phi' - I phi'' and tau (M, N; N m), with derivatives.

    by_phi, by_phi_dot, by_phi_ddot   (M, 6, N): of R by the angle, speed, acceleration of each flywheel
    tau_by_...                        (M, N): of tau_s by those of flywheel s itself; others do not enter
    """

    R: Array
    tau: Array
    by_phi: Array
    by_phi_dot: Array
    by_phi_ddot: Array
    tau_by_phi: Array
    tau_by_phi_dot: Array
    tau_by_phi_ddot: Array


def residual(at: PrescribedMotion, phi: Array, phi_dot: Array, phi_ddot: Array) -> Array:
    """R (M, 6; N, N m) of (12), zero where the programme is exact; angles (M, N each; rad, s)."""
    return np.asarray(at.balance - flywheel_wrenches(at, phi, phi_dot, phi_ddot)[:6].sum(axis=2).T)


def torques(at: PrescribedMotion, phi: Array, phi_dot: Array, phi_ddot: Array) -> Array:
    """tau (M, N; N m): drive torques at the prescribed motion."""
    return np.asarray(flywheel_wrenches(at, phi, phi_dot, phi_ddot)[6])


def flywheel_wrenches(at: PrescribedMotion, phi: Array, phi_dot: Array, phi_ddot: Array) -> Array:
    """W_s in E1 about O1 and, seventh, tau_s: (7, M, N)."""
    h, _ = waves(phi)
    W: Array = np.einsum("himn,hmn->imn", _coefficients(at, phi_dot, phi_ddot), h)
    for s, damping in enumerate(at.mechanics.tables.damping):
        if damping is not None:
            W[:, :, s] -= flywheel_damping(at.mechanics.tables, s, at.V_r, phi[:, s], phi_dot[:, s])[0]
    return W


def linear(at: PrescribedMotion, phi: Array, phi_dot: Array, phi_ddot: Array) -> Linear:
    """R and tau with all their derivatives, exact; angles (M, N each; rad, s)."""
    h, slopes = waves(phi)
    own = at.mechanics
    coefficients = _coefficients(at, phi_dot, phi_ddot)
    W = np.einsum("himn,hmn->imn", coefficients, h)
    by_phi = np.einsum("himn,hmn->imn", coefficients, slopes)
    by_phi_dot = np.einsum("himn,hmn->imn", at.moving + (2.0 * phi_dot) * own.coupling_slope, h)
    by_phi_ddot = np.einsum("hin,hmn->imn", own.coupling[:, :, 0], h)
    for s, damping in enumerate(own.tables.damping):
        if damping is not None:
            damped = flywheel_damping(own.tables, s, at.V_r, phi[:, s], phi_dot[:, s])
            for target, value in zip((W, by_phi, by_phi_dot), damped, strict=True):
                target[:, :, s] -= value
    R = at.balance - W[:6].sum(axis=2).T
    a, b, c = (-np.swapaxes(x[:6], 0, 1) for x in (by_phi, by_phi_dot, by_phi_ddot))
    return Linear(R, W[6], a, b, c, by_phi[6], by_phi_dot[6], by_phi_ddot[6])


def _coefficients(at: PrescribedMotion, phi_dot: Array, phi_ddot: Array) -> Array:
    """(5, 7, M, N): what multiplies each harmonic of the angle."""
    own = at.mechanics
    return np.asarray(
        at.fixed + at.moving * phi_dot + own.coupling * phi_ddot + own.coupling_slope * (phi_dot * phi_dot)
    )


def flywheel_damping(tables: Tables, s: int, V_r: Array, phi: Array, phi_dot: Array) -> tuple[Array, Array, Array]:
    """Damping wrench on flywheel s in E1 with its part about the axis (7, M), and its derivatives by phi, phi'.

    V_r (M, 6): twist of the carrier relative to the fluid; phi, phi' (M) of the flywheel.
    """
    damping, Lm = tables.damping[s], tables.Lm[s]
    assert damping is not None
    turned = block_diagonal(turn(0, phi))  # E_s in the frame at phi = 0
    v = ((V_r @ Lm)[:, None, :] @ turned)[:, 0, :] + phi_dot[:, None] * f
    P, rate = damping.wrench(v), damping.rate(v)
    by_phi = P @ _SPIN.T - (rate @ (v @ _SPIN.T)[:, :, None])[:, :, 0]  # turned' = turned [<e>]
    by_phi_dot = rate @ f
    found = []
    for x in (P, by_phi, by_phi_dot):
        wrench = Lm @ (turned @ x[:, :, None])[:, :, 0].T
        found.append(np.vstack([wrench, tables.spin[s] @ wrench]))
    return found[0], found[1], found[2]
