"""Flywheels as short Fourier polynomials of their phases, in E1: the one place that knows their masses and mountings.

Theta(phi) = T0 + T1 cos phi + T2 sin phi + T3 cos 2 phi + T4 sin 2 phi, five constant matrices; likewise I_s and the
weight's moment.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.lower.law_arrays import LawArrays, TwistLaws
from mahovik.core.stand.model import Stand
from mahovik.use.numeric.array import Array
from mahovik.use.numeric.se3 import (
    block_diagonal,
    flywheel_transfer,
    gravity_wrench_matrix,
    inertia,
    net_weight,
)

_STILL = block_diagonal(np.diag([1.0, 0.0, 0.0]))  # diag(C1, C1)(phi) = _STILL + _COS cos phi + _SIN sin phi
_COS = block_diagonal(np.diag([0.0, 1.0, 1.0]))
_SIN = block_diagonal(np.array([[0.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]))
f = np.array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0])
"""Every flywheel spins about its own first axis."""


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

    @property
    def coupling(self) -> Array:
        """I_s = Ls Theta_s f of (9) by harmonics (5, N, 6); the twist of a unit spin is Lm^-T f in E1."""
        return np.asarray((self.Theta @ self.spin[:, :, None])[..., 0])


def tables_of(stand: Stand, laws: LawArrays) -> Tables:
    """The tables of a stand's flywheels."""
    wheels = stand.flywheels
    Lm = np.array([flywheel_transfer(stand, s) for s in wheels]).reshape(-1, 6, 6)
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


def inertia_harmonics(Theta: Array, Lm: Array) -> Array:
    """Harmonics (5, ..., 6, 6) of Lm R(phi) Theta R(phi)^T Lm^T, Theta (..., 6, 6)."""
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


def weight_harmonics(mass: Array | float, moment: Array, Lm: Array) -> Array:
    """Harmonics (5, ..., 6, 3) of the wrench by gravity on masses (..., kg) with first moments (..., 3; kg m)."""
    C = Lm[:3, :3]
    harmonics = np.zeros((5, *np.shape(mass), 6, 3))
    for h, (share, R) in enumerate(((1.0, _STILL), (0.0, _COS), (0.0, _SIN))):
        harmonics[h] = Lm @ gravity_wrench_matrix(share * np.asarray(mass), moment @ R[:3, :3].T) @ C.T
    return harmonics


def slope(harmonics: Array) -> Array:
    """Harmonics of the derivative by phi; the harmonic is the first axis (5, ...)."""
    return np.stack([np.zeros_like(harmonics[0]), harmonics[2], -harmonics[1], 2.0 * harmonics[4], -2.0 * harmonics[3]])


def waves(phi: Array) -> tuple[Array, Array]:
    """1, cos, sin, cos 2, sin 2 of phi, and their derivatives by phi: (5, ...) each, phi (...) in rad."""
    c, s = np.cos(phi), np.sin(phi)
    c2, s2 = 1.0 - 2.0 * s * s, 2.0 * s * c
    return np.stack([np.ones_like(c), c, s, c2, s2]), np.stack([np.zeros_like(c), -s, c, -2.0 * s2, 2.0 * c2])
