"""What depends on the carrier's prescribed motion alone: the coefficients of (12) at M times.

Flywheel s takes from the carrier the wrench (in E1 about O1; V, V* relative to the fluid)

    W_s = Theta_s V* + I_s phi'' + phi' Theta_s,phi (V + e_s phi') + Phi(V) Theta_s (V + e_s phi') - weight,

with e_s the twist of a unit spin. Sorted by harmonics h of phi and by powers of speed:

    W_s = sum_h h(phi) (A_h + C_h phi' + I_h phi'' + I'_h phi'^2),

A_h, C_h of the motion, I_h, I'_h constant. (8) is then R = balance - sum_s W_s, and tau_s its part about the axis. The
norm of residuals is the same for any units, origin and axes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.lower.law_arrays import law_arrays
from mahovik.core.motion.functions import Course
from mahovik.core.stand.hold import twists as freedom_twists
from mahovik.core.stand.model import Stand
from mahovik.use.numeric.array import Array
from mahovik.use.numeric.carrier import Base
from mahovik.use.numeric.flywheels import Tables, slope, tables_of
from mahovik.use.numeric.kinematics import Twists, in_E1, twists
from mahovik.use.numeric.se3 import motor_cross


@dataclass(frozen=True, eq=False)
class Mechanics:
    """Constants of a stand: built once, used for every motion.

    coupling, coupling_slope   (5, 7, 1, N): I_h, I'_h; the seventh row is the part about the axis, for tau
    """

    stand: Stand
    base: Base
    tables: Tables
    coupling: Array
    coupling_slope: Array

    @staticmethod
    def of(stand: Stand) -> Mechanics:
        """The mechanics of a stand."""
        laws = law_arrays(stand)
        tables = tables_of(stand, laws)
        I = _with_torque(np.transpose(tables.coupling, (0, 2, 1))[:, :, None, :], tables)
        return Mechanics(stand, Base.of(stand, laws), tables, I, slope(I))

    @property
    def N(self) -> int:
        """Number of flywheels."""
        return len(self.stand.flywheels)

    @property
    def mean_inertia(self) -> Array:
        """K0 (6, 6): K of (2), mean over all angles of the flywheels."""
        return np.asarray(self.base.K + self.tables.Theta[0].sum(axis=0))

    @property
    def freedoms(self) -> Array:
        """S (6, m) of a held carrier, whose wrenches count along its freedoms alone; E (6, 6) of a free one."""
        return np.eye(6) if self.stand.hold is None else freedom_twists(self.stand.hold)


@dataclass(frozen=True, eq=False)
class PrescribedMotion:
    """Coefficients of (12) at M times: linear in the harmonics of each angle, quadratic in its speed.

    balance (M, 6; N, N m): of the base, everything but the flywheels
    fixed   (5, 7, M, N): A_h
    moving  (5, 7, M, N): C_h; seventh row: see Mechanics
    V_r     (M, 6): twist relative to the fluid, for flywheels with damping
    """

    mechanics: Mechanics
    balance: Array
    fixed: Array
    moving: Array
    V_r: Array

    def locked_wrench(self) -> Array:
        """P of (12) (M, 6): wrench needed, flywheels locked in their mounts and axisymmetric, of mean inertia."""
        return np.asarray(self.balance - self.fixed[0, :6].sum(axis=2).T)


def prescribe(mechanics: Mechanics, course: Course, bias: Array | float = 0.0) -> PrescribedMotion:
    """Prescribed at the times of `course`, shifted by `bias` (6, or M x 6; m, rad). StateError: a law is undefined."""
    return prescribed_at(mechanics, twists(mechanics.stand, course._replace(q=course.q + bias)))


def prescribed_at(mechanics: Mechanics, at: Twists) -> PrescribedMotion:
    """Prescribed at M twists of the carrier. StateError: a law is undefined."""
    tables = mechanics.tables
    found = harmonics_at(mechanics.stand, at, tables.Theta, tables.weight, tables.coupling)
    A, C = (_with_torque(x, tables) for x in found)
    return PrescribedMotion(mechanics, mechanics.base.balance(at), A, C, at.V_r)


def harmonics_at(stand: Stand, at: Twists, Theta: Array, weight: Array, coupling: Array) -> tuple[Array, Array]:
    """A_h, C_h (5, 6, M, N each) of Theta (5, N, 6, 6), weight (5, N, 6, 3), I_h (5, N, 6), linear in these."""
    M, N = len(at.V), Theta.shape[1]
    Phi = motor_cross(at.V_r)
    flat = Theta.reshape(-1, 6)  # rows h, s, i
    momentum = (at.V_r @ flat.T).reshape(M, 5 * N, 6)
    fixed = (at.V_r_dot @ flat.T).reshape(M, 5 * N, 6) + momentum @ np.swapaxes(Phi, 1, 2)
    if any(stand.gravity):
        gravity = in_E1(at.C, np.broadcast_to(stand.gravity, at.O1.shape))
        fixed -= (gravity @ weight.reshape(-1, 3).T).reshape(M, 5 * N, 6)
    moving = (coupling.reshape(5 * N, 6) @ np.swapaxes(Phi, 1, 2)).reshape(M, 5, N, 6)
    moving = np.moveaxis(moving, 0, 2) + slope(np.moveaxis(momentum.reshape(M, 5, N, 6), 0, 2))  # (5, N, M, 6)
    fixed = np.moveaxis(fixed.reshape(M, 5, N, 6), 0, 2)
    A, C = (np.ascontiguousarray(np.transpose(x, (0, 3, 2, 1))) for x in (fixed, moving))  # (5, 6, M, N)
    return A, C


def _with_torque(harmonics: Array, tables: Tables) -> Array:
    """(5, 7, ...) of (5, 6, ..., N): with the part about each flywheel's axis as a seventh row."""
    about = np.einsum("si,hims->hms", tables.spin, harmonics)
    return np.concatenate([harmonics, about[:, None]], axis=1)


_STILL = 1e-9
"""Part of what the unbalance can do at the motion's frequency, below which a carrier counts as held still."""


@dataclass(frozen=True, eq=False)
class Norm:
    """max_t |root R(t)| / demand.

    root    6x6: G^-1 of K0 = G G^T, K0 the mean K over all angles: its norm is that of K0^-1/2;
            of a held carrier m x 6: G^-1 S^T of S^T K0 S = G G^T, so that what the hold takes does not count
    demand  max_t |root (P(t) - mean P)|, P the wrench needed at locked flywheels
    """

    root: Array
    demand: float

    @staticmethod
    def of(at: PrescribedMotion, span: float) -> Norm:
        """The norm of a motion prescribed at uniform times, for its period or duration (s).

        For a carrier to be held still: sum mu_s Omega^2 / sqrt(m) in place of the demand; without unbalance
        as well, what spinning inertias do at that frequency.
        """
        own = at.mechanics
        S = own.freedoms
        root = np.linalg.inv(np.linalg.cholesky(S.T @ own.mean_inertia @ S)) @ S.T
        P = at.locked_wrench() @ root.T
        demand = float(np.linalg.norm(P - P.mean(axis=0), axis=1).max())
        able = able_at(own, 2.0 * np.pi / span)
        return Norm(root, demand if demand > _STILL * able else able)

    def dimensionless(self, R: Array) -> Array:
        """root R / demand (M, 6; of a held carrier M, m), dimensionless."""
        return np.asarray(R @ (self.root.T / self.demand))

    def relative(self, R: Array) -> float:
        """Relative residual of R (M, 6)."""
        return float(np.linalg.norm(self.dimensionless(R), axis=1).max())


def able_at(own: Mechanics, Omega: float) -> float:
    """Largest wrench of all flywheels together at the speed Omega (rad/s), in the norm's units."""
    if own.stand.hold is not None:
        S = own.freedoms
        root = np.linalg.inv(np.linalg.cholesky(S.T @ own.mean_inertia @ S)) @ S.T
        return float(np.linalg.norm(own.tables.coupling @ root.T, axis=-1).max(axis=0).sum() * Omega**2)
    K0 = own.mean_inertia
    by_force = own.tables.unbalance.sum() / np.sqrt(K0[0, 0])
    by_moment = own.tables.Theta_ff.sum() / np.sqrt(np.trace(K0[3:, 3:]) / 3.0)
    return float(max(by_force, 1e-3 * by_moment) * Omega**2)
