"""Inverse problem, (12): flywheel accelerations for a prescribed acceleration of the carrier, free or held.

A held carrier has the rows S^T of (8), a free one all six: S = E. Without units the demand is W y = r, solved by
singular values; weights and damping are the options of the emitted C; (13) has the flywheels in two parts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.contract.functions import inverse_fault
from mahovik.core.stand.model import Motor, Stand, State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, Values, solve, vector
from mahovik.proof.reference.motion import bias, forward, torque
from mahovik.proof.reference.pieces import Pieces


@dataclass(frozen=True)
class Cuts:
    """Thresholds of rank and status, for double.

    rank           of the first singular value: those below are taken as zero
    near_singular  of the first singular value: a smallest kept one below this is NEAR_SINGULAR
    reached        scaled residual over scaled demand above this is UNREACHABLE
    """

    rank: float = 1e-9
    near_singular: float = 1e-6
    reached: float = 1e-9


CUTS = Cuts()
"""Thresholds for double."""


@dataclass(frozen=True, eq=False)
class Inverse:
    """phi_ddot (N, rad/s2), status (names joined by |), residual (m; N, N m), sigma (min(m, N)), rank."""

    phi_ddot: Array
    status: str
    residual: Array
    sigma: Array
    rank: int


@dataclass(frozen=True, eq=False)
class ScaledDemand:
    """A phi'' = c, A (mxN), c (m), as W y = r without units: W = root A Theta_ff^-1/2, y = Theta_ff^1/2 phi''.

    `root` (mxm) scales what is left over: (S^T K S)^-1/2 of a wrench, G^-1/2 of a task's error. So the singular values
    of W are the same for any units, origin and axes.
    """

    A: Array
    c: Array
    root: Array
    to_phi_ddot: Array

    @property
    def W(self) -> Array:
        """The scaled matrix (mxN)."""
        return self.root @ self.A @ self.to_phi_ddot

    @property
    def r(self) -> Array:
        """The scaled demand (m)."""
        return self.root @ self.c

    def phi_ddot(self, y: Array) -> Array:
        """phi'' (N, rad/s2) of a scaled answer."""
        return self.to_phi_ddot @ y


def inverse_root(S: Array) -> Array:
    """S^-1/2 of a symmetric positive definite S: G^-1 of S = G G^T.

    Any such factor gives the same singular values, norms and answer; this one loses no digits to mixed units.
    """
    if np.count_nonzero(S) == len(S):  # Theta_ff, of as many rows as there are flywheels
        return np.diag(1.0 / np.sqrt(np.diag(S)))
    return np.asarray(np.linalg.inv(np.linalg.cholesky(S)))


def demand(at: Pieces, V_dot: Array) -> Array:
    """I phi'' of (12): F - K V_r* - M V_r - J phi' (6; N, N m), for V_dot (6) relative to E0."""
    return at.F - at.K @ at.V_r_dot(V_dot) - bias(at)


def scaled_demand(at: Pieces, V_dot: Array) -> ScaledDemand:
    """S^T I phi'' = S^T (F - K V_r* - M V_r - J phi') for V_dot (6) relative to E0, in the norm of (S^T K S)^-1."""
    S = at.S
    return ScaledDemand(S.T @ at.I, S.T @ demand(at, V_dot), inverse_root(S.T @ at.K @ S), inverse_root(at.Theta_ff).T)


def least_error(scaled: ScaledDemand, cuts: Cuts = CUTS, rank: int | None = None) -> Inverse:
    """Least |r - W y|, then least |y|. `rank`: how many singular values count, where that is given; else by `cuts`."""
    W, r = scaled.W, scaled.r
    U, sigma, Vt = np.linalg.svd(W, full_matrices=False)
    if rank is None:
        rank = int(np.sum(sigma > cuts.rank * sigma[0])) if sigma.size else 0
    phi_ddot = scaled.phi_ddot(Vt[:rank].T @ ((U[:, :rank].T @ r) / sigma[:rank]))
    residual = scaled.c - scaled.A @ phi_ddot
    bits = {
        "NEAR_SINGULAR": rank and sigma[rank - 1] < cuts.near_singular * sigma[0],
        "UNREACHABLE": np.linalg.norm(scaled.root @ residual) > cuts.reached * np.linalg.norm(r),
        "RANK_DEFICIENT": rank < min(W.shape),
    }
    return Inverse(phi_ddot, status_of(bits), residual, sigma, rank)


def status_of(bits: Mapping[str, Any]) -> str:
    """Names of those of contract/status.py that are set, joined by |, in the order of their bits."""
    return "|".join(name for name, is_set in bits.items() if is_set) or "OK"


def inverse(at: Pieces, V_dot: Array, cuts: Cuts = CUTS) -> Inverse:
    """(12) of a free or held carrier for a demanded V_dot (6)."""
    return least_error(scaled_demand(at, V_dot), cuts)


def answer_inverse(at: Pieces, stand: Stand, state: State, cuts: Cuts = CUTS) -> Values:
    """phi_ddot (N), status, residual (m), sigma (min(m, N)), rank: (12). StateError: no freedoms, or no flywheels."""
    if stand.hold is not None and (fault := inverse_fault(len(stand.hold.freedoms), len(at.phi_dot))):
        raise StateError(f"want: {fault}")
    answer = inverse(at, vector(state.V_dot), cuts)
    return vars(answer) | with_excess(answer, at, stand, forward(at, answer.phi_ddot))


# Weights and damping: what the options of the emitted C mean.


def weighted_solution(
    scaled: ScaledDemand, weight: Array, rank: int, near_singular: float = 0.0, damping: float = 0.0
) -> Array:
    """phi'' (N): least |r - W y| in the first `rank` singular directions, then least sum weight_s y_s^2.

    Damping: where sigma_i < near_singular sigma_1, the demand in that direction is multiplied by
    sigma_i^2/(sigma_i^2 + lambda_i^2), lambda_i = damping sigma_1 (1 - sigma_i/(near_singular sigma_1)).
    """
    U, sigma, Vt = np.linalg.svd(scaled.W, full_matrices=False)
    wanted = (U.T @ scaled.r)[:rank]
    for i in range(rank):
        if sigma[i] < near_singular * sigma[0]:
            share = damping * sigma[0] * (1 - sigma[i] / (near_singular * sigma[0]))
            wanted[i] *= sigma[i] ** 2 / (sigma[i] ** 2 + share**2)
    root = 1 / np.sqrt(weight)
    rows = (sigma[:rank, None] * Vt[:rank]) * root
    return scaled.phi_ddot(np.asarray(root * (np.linalg.pinv(rows, rcond=0.0) @ wanted), dtype=np.float64))


def largest_damping(scaled: ScaledDemand, rank: int, near_singular: float, damping: float) -> float:
    """The largest lambda_i that `weighted` applies; 0 where it applies none."""
    if rank == 0:
        return 0.0
    sigma = np.linalg.svd(scaled.W, compute_uv=False)[:rank]
    ratios = sigma / sigma[0]
    return float(max((damping * sigma[0] * (1 - x / near_singular) for x in ratios if x < near_singular), default=0.0))


def normal_matrix(scaled: ScaledDemand, weight: Array, damping: float) -> Array:
    """Matrix of `inverse_fast`: W Omega^-1 W^T + lambda^2 E of six flywheels and more, W^T W + lambda^2 E of fewer.

    lambda^2 is damping^2 times the trace of the matrix without it; Omega = diag(weight).
    """
    W = scaled.W
    gram = (W / weight) @ W.T if W.shape[1] >= len(scaled.r) else W.T @ W
    return np.asarray(gram + damping**2 * np.trace(gram) * np.eye(len(gram)))


# EXCESSIVE: an answer that needs more than the motors have.


def available(motor: Motor, tau: float, speed: float) -> float:
    """Torque (N m) that the motor has in the sense of tau at a speed (rad/s).

    Driving, it falls linearly from the limit at rest to 0 at the no-load speed and beyond; braking, it is the limit. A
    curve limits both: straight lines between its points, beyond them the last; without negative speeds by |speed|.
    """
    most = np.inf if motor.torque is None else motor.torque
    if motor.torque_speed:
        speeds, torques = np.transpose(motor.torque_speed)
        most = min(most, float(np.interp(speed if speeds[0] < 0 else abs(speed), speeds, torques)))
    if motor.speed is None or tau * speed <= 0:
        return most
    share = max(0.0, 1.0 - abs(speed) / motor.speed)
    return most * share if share else 0.0


def friction(motor: Motor, speed: float) -> float:
    """Torque of friction on the flywheel at a speed (rad/s), N m: viscous, and dry as the servos compensate it.

    Dry friction is y (27 + y^2) / (27 + 9 y^2) of its whole, y the speed over `coulomb_speed` inside -3..3: tanh y to
    0.024.
    """
    y = min(max(speed / motor.coulomb_speed, -3.0), 3.0)
    return -motor.viscous * speed - motor.coulomb * y * (27.0 + y * y) / (27.0 + 9.0 * y * y)


def shares_of(stand: Stand, at: Pieces, tau: Array, phi_ddot: Array) -> Array:
    """Need of each flywheel over what it has (N), for drive torques tau (N, N m); above 1 is too much.

    Torque of the motor, which gives tau_s and bears the friction, over what it has; without a motor, or of one without
    limits, |phi_s''| over `inverse_most`.
    """
    shares = np.zeros(len(stand.flywheels))
    for k, wheel in enumerate(stand.flywheels):
        motor = wheel.motor
        if motor is None or (motor.torque is None and motor.speed is None and not motor.torque_speed):
            shares[k] = abs(phi_ddot[k]) / stand.inverse_most
            continue
        needed = tau[k] - friction(motor, at.phi_dot[k])
        most = available(motor, needed, at.phi_dot[k])
        shares[k] = abs(needed) / most if most else (np.inf if needed else 0.0)
    return shares


def with_excess(answer: Inverse, at: Pieces, stand: Stand, V_dot: Array) -> dict[str, str]:
    """The status of an answer that gives the motion V_dot (6), with EXCESSIVE, the last of the bits."""
    needed = shares_of(stand, at, torque(at, V_dot, answer.phi_ddot), answer.phi_ddot)
    known = {} if answer.status == "OK" else {answer.status: True}
    return {"status": status_of(known | {"EXCESSIVE": np.any(needed > 1.0)})}


# Optimal control, (13): flywheels in two parts, N - 6 independent (minus), 6 dependent (plus).


def dependent_acceleration(at: Pieces, V_dot: Array, plus: Sequence[int], u: Array) -> Array:
    """phi_+'' = I+^-1 (P(t) - I- u - J phi') (6, rad/s2), (13), for the carrier's V_dot (6) relative to E0.

    `plus` (6) are the indices of the dependent flywheels, in the order of the answer; u = phi_-'' (N - 6, rad/s2)
    those of the others, in the file's order. det I+ = 0 raises numpy.linalg.LinAlgError.
    """
    minus = [s for s in range(len(at.phi_dot)) if s not in plus]
    return solve(at.I[:, list(plus)], demand(at, V_dot) - at.I[:, minus] @ u)


def determinant(at: Pieces, plus: Sequence[int]) -> float:
    """det I+ of (13): in units of kg^6 m^9, its sign is what matters."""
    return float(np.linalg.det(at.I[:, list(plus)]))
