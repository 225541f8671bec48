"""Constants of a stand in E1 about O1: its base, which is all but the flywheels, and the flywheels as harmonics.

A flywheel is a short Fourier polynomial of its phase: Theta(phi) = T0 + T1 cos phi + T2 sin phi + T3 cos 2 phi +
T4 sin 2 phi, five constant matrices; likewise I_s and the weight's moment. They are linear in every mass property.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mahovik.core.lower.law_arrays import LawArrays, TwistLaws
from mahovik.core.stand.hold import twists as freedom_twists
from mahovik.core.stand.masses import pose, transfer
from mahovik.core.stand.model import Body, Carrier, Instrument, Stand
from mahovik.use.numeric.frame import Frame, Twists, in_E1
from mahovik.use.numeric.se3 import (
    Array,
    block_diagonal,
    motor_cross,
    skew,
    turn,
)

_STILL = block_diagonal(np.diag([1.0, 0.0, 0.0]))  # diag(C1, C1)(phi) = _STILL + _COS cos phi + _SIN sin phi
_COS = block_diagonal(np.diag([0.0, 1.0, 1.0]))
_SIN = block_diagonal(np.array([[0.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]))
f = np.array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0])
"""Every flywheel spins about its own first axis."""


@dataclass(frozen=True, eq=False)
class Base:
    """Carrier and instruments, in E1 about O1.

    K        6x6: Theta_1 + sum Lp Theta_p Lp^T and added mass, of (2)
    heavy    6x3: wrench of the net weight by gravity in E1
    damped   L (6x6) of each damped body, and the laws of its twist
    """

    stand: Stand
    laws: LawArrays
    K: Array
    heavy: Array
    damped: tuple[tuple[Array, TwistLaws], ...]

    @staticmethod
    def of(stand: Stand, laws: LawArrays) -> Base:
        """Carrier and instruments of a stand."""
        placed: list[tuple[Carrier | Instrument, Array]] = [(stand.carrier, np.eye(6))]
        placed += [(p, transfer(*pose(stand, p))) for p in stand.instruments]
        K, heavy, damped = np.zeros((6, 6)), np.zeros((6, 3)), []
        for (body, L), damping in zip(placed, laws.bodies, strict=False):
            K += L @ inertia(body) @ L.T
            if body.added_mass is not None:
                K += np.array(body.added_mass)
            heavy += L @ weight_matrix(*net_weight(body)) @ L[:3, :3].T
            if damping is not None:
                damped.append((L, damping))
        return Base(stand, laws, K, heavy, tuple(damped))

    def balance(self, at: Twists) -> Array:
        """F - K V_r* - Phi(V_r) K V_r (M, 6; N, N m) of these bodies alone. StateError: a law is undefined there."""
        momentum = at.V_r @ self.K
        turning = (motor_cross(at.V_r) @ momentum[:, :, None])[:, :, 0]
        return np.asarray(self.wrench(at) - at.V_r_dot @ self.K - turning)

    def wrench(self, at: Twists) -> Array:
        """F of (7) (M, 6; N, N m) of these bodies alone, in E1 about O1. StateError: a law is undefined there."""
        F = self.laws.tied(at.O1, at.C, at.V) if self.laws.ties else np.zeros((len(at.V), 6))
        if any(self.stand.gravity):
            F += in_E1(at.C, self.stand.gravity) @ self.heavy.T
        for L, damping in self.damped:
            F += damping.wrench(at.V_r @ L) @ L.T
        return F


@dataclass(frozen=True, eq=False)
class Tables:
    """Tables of N flywheels, harmonics h = 1, cos, sin, cos 2, sin 2 first; in E1 about O1.

    Theta    (5, N, 6, 6): Ls Theta_s Ls^T
    weight   (5, N, 6, 3): wrench of the net weight by gravity in E1
    spin     (N, 6): what makes tau of a wrench about O1 in E1: its moment about the spin axis
    Lm       (N, 6, 6): transfer of the frame at phi = 0
    damping  laws of the twist of each flywheel, or None
    unbalance, axis   (N, kg m), (N, 3): mu_s across the axis, and the axis in E1
    Theta_ff (N, kg m2): f^T Theta_s f
    """

    Theta: Array
    weight: Array
    spin: Array
    Lm: Array
    damping: tuple[TwistLaws | None, ...]
    unbalance: Array
    axis: Array
    Theta_ff: Array

    @staticmethod
    def of(stand: Stand, laws: LawArrays) -> Tables:
        """The tables of a stand's flywheels."""
        wheels = stand.flywheels
        Lm = np.array([transfer(*pose(stand, s)) for s in wheels]).reshape(-1, 6, 6)
        Theta = np.array([inertia_harmonics(inertia(s), Lm[k]) for k, s in enumerate(wheels)]).reshape(-1, 5, 6, 6)
        weight = np.array([weight_harmonics(*net_weight(s), Lm[k]) for k, s in enumerate(wheels)]).reshape(-1, 5, 6, 3)
        return Tables(
            Theta=np.swapaxes(Theta, 0, 1),
            weight=np.swapaxes(weight, 0, 1),
            spin=np.array([f @ np.linalg.inv(L) for L in Lm]).reshape(-1, 6),
            Lm=Lm,
            damping=laws.bodies[len(stand.bodies) - len(wheels) :],
            unbalance=np.array([s.mass * np.hypot(*s.center_of_mass[1:]) for s in wheels]),
            axis=Lm[:, :3, 0],
            Theta_ff=np.array([inertia(s)[3, 3] for s in wheels]),
        )

    @property
    def coupling(self) -> Array:
        """I_s = Ls Theta_s f of (9) by harmonics (5, N, 6); the twist of a unit spin is Lm^-T f in E1."""
        return np.asarray((self.Theta @ self.spin[:, :, None])[..., 0])

    def damped(self, s: int, V_r: Array, phi: Array, phi_dot: Array) -> tuple[TwistLaws, Array, Array] | None:
        """Laws of flywheel s, its transfer L (M, 6, 6) to E1 and its twist (M, 6); None: no damping.

        V_r (M, 6): twist of the carrier relative to the fluid; phi, phi' (M) of the flywheel.
        """
        damping = self.damping[s]
        if damping is None:
            return None
        L = self.Lm[s] @ block_diagonal(turn(0, phi))
        return damping, L, (V_r[:, None, :] @ L)[:, 0, :] + phi_dot[:, None] * f


def inertia(body: Body) -> Array:
    """Theta (6, 6; kg, kg m, kg m2) = [[m E, -<mu>], [<mu>, J]] about the origin of the body's frame."""
    mu = skew(body.mass * np.array(body.center_of_mass))
    J = np.array(body.inertia)
    if body.inertia_about != "origin":
        J = J - mu @ skew(np.array(body.center_of_mass))
    return np.block([[body.mass * np.eye(3), -mu], [mu, J]])


def weight_matrix(mass: float, moment: Array) -> Array:
    """Matrix (6, 3) that makes a wrench of gravity: (mass g; moment x g), `moment` (3; kg m)."""
    return np.vstack([mass * np.eye(3), skew(moment)])


def net_weight(body: Body) -> tuple[float, Array]:
    """What gravity acts on: mass (kg) and first moment (3, kg m) in its frame, less those of the displaced fluid."""
    moment = sum((mass * np.array(center) for mass, center in body.displaced), np.zeros(3))
    return body.mass - sum(mass for mass, _ in body.displaced), body.mass * np.array(body.center_of_mass) - moment


def inertia_harmonics(Theta: Array, Lm: Array) -> Array:
    """Harmonics (5, 6, 6) of Lm R(phi) Theta R(phi)^T Lm^T, Theta (6, 6)."""
    parts = [Lm @ R for R in (_STILL, _COS, _SIN)]
    still, cos, sin = ([a @ Theta @ b.T for b in parts] for a in parts)
    return np.array(
        [
            still[0] + (cos[1] + sin[2]) / 2,
            still[1] + cos[0],
            still[2] + sin[0],
            (cos[1] - sin[2]) / 2,
            (cos[2] + sin[1]) / 2,
        ]
    )


def weight_harmonics(mass: float, moment: Array, Lm: Array) -> Array:
    """Harmonics (5, 6, 3) of the wrench by gravity on a mass (kg) with its first moment (3; kg m)."""
    harmonics = np.zeros((5, 6, 3))
    for h, (share, R) in enumerate(((1.0, _STILL), (0.0, _COS), (0.0, _SIN))):
        harmonics[h] = Lm @ weight_matrix(share * mass, R[:3, :3] @ moment) @ Lm[:3, :3].T
    return harmonics


def slope(harmonics: Array) -> Array:
    """Harmonics of the derivative by phi; the harmonic is the first axis (5, ...)."""
    return np.stack([np.zeros_like(harmonics[0]), harmonics[2], -harmonics[1], 2.0 * harmonics[4], -2.0 * harmonics[3]])


def waves(phi: Array) -> tuple[Array, Array]:
    """1, cos, sin, cos 2, sin 2 of phi, and their derivatives by phi: (5, ...) each, phi (...) in rad."""
    c, s = np.cos(phi), np.sin(phi)
    c2, s2 = 1.0 - 2.0 * s * s, 2.0 * s * c
    return np.stack([np.ones_like(c), c, s, c2, s2]), np.stack([np.zeros_like(c), -s, c, -2.0 * s2, 2.0 * c2])


@dataclass(frozen=True, eq=False)
class Mechanics:
    """Constants of a stand: built once, used for every motion.

    coupling, coupling_slope   (5, 7, 1, N): harmonics of I and of its derivative by phi; the seventh row is the part
                               about the axis, for tau
    freedoms   S (6, m) of a held carrier, whose wrenches count along its freedoms alone; E (6, 6) of a free one
    """

    stand: Stand
    base: Base
    tables: Tables
    coupling: Array
    coupling_slope: Array
    freedoms: Array

    @staticmethod
    def of(stand: Stand) -> Mechanics:
        """The mechanics of a stand."""
        laws = LawArrays(stand)
        tables = Tables.of(stand, laws)
        I = with_torque(np.transpose(tables.coupling, (0, 2, 1))[:, :, None, :], tables)
        S = freedom_twists(stand.hold)
        return Mechanics(stand, Base.of(stand, laws), tables, I, slope(I), S)

    @cached_property
    def frame(self) -> Frame:
        """The coordinates of a required motion. StandError: a held carrier has none."""
        return Frame.of(self.stand)

    @property
    def N(self) -> int:
        """Number of flywheels."""
        return len(self.stand.flywheels)

    @property
    def mean_inertia(self) -> Array:
        """K0 (6, 6): K of (2), mean over all angles of the flywheels."""
        return np.asarray(self.base.K + self.tables.Theta[0].sum(axis=0))

    @property
    def root(self) -> Array:
        """G^-1 S^T (m, 6) of S^T K0 S = G G^T: |root R| is the norm of what acts along the freedoms."""
        S = self.freedoms
        return np.asarray(np.linalg.inv(np.linalg.cholesky(S.T @ self.mean_inertia @ S)) @ S.T)

    def mass_and_coupling(self, phi: Array) -> tuple[Array, Array]:
        """K of (2) (M, 6, 6) and I of (9) (M, 6, N) at angles (M, N; rad), in E1 about O1."""
        h, _ = waves(phi)
        K = self.base.K + np.einsum("hmn,hnij->mij", h, self.tables.Theta)
        return K, np.einsum("hmn,hni->min", h, self.tables.coupling)

    def able(self, Omega: float) -> float:
        """Largest wrench of all flywheels together at the speed Omega (rad/s), in the norm of `root`."""
        if self.stand.hold is not None:
            largest = np.linalg.norm(self.tables.coupling @ self.root.T, axis=-1).max(axis=0)
            return float(largest.sum() * Omega**2)
        K0 = self.mean_inertia
        by_force = self.tables.unbalance.sum() / np.sqrt(K0[0, 0])
        by_moment = self.tables.Theta_ff.sum() / np.sqrt(np.trace(K0[3:, 3:]) / 3.0)
        return float(max(by_force, 1e-3 * by_moment) * Omega**2)


def with_torque(harmonics: Array, tables: Tables) -> Array:
    """(5, 7, ...) of (5, 6, ..., N): with the part about each flywheel's axis as a seventh row."""
    about = np.einsum("si,hims->hms", tables.spin, harmonics)
    return np.concatenate([harmonics, about[:, None]], axis=1)
