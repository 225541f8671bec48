"""All the pieces of (1)-(11) at one state, each under its name in the paper."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import FixedBody, SpinningFlywheel
from mahovik.proof.reference.screw import cross
from mahovik.proof.reference.wrench_kinds import Kinds


@dataclass(frozen=True, eq=False)
class Pieces:
    """Terms of the equations at one state. SI, in E1 about O1 unless said otherwise.

    C, L1        3x3, 6x6: attitude and transfer from E1 to E0
    V, V_r       6: twist of E1 relative to E0, and to the fluid, V_r = V - (C^T u, 0)
    fixed        carrier and instruments, with L, Theta, Lambda
    flywheels    flywheels, with L = Ls, Theta = Theta_s, phi, phi_dot
    K_bodies     6x6, (2) without added mass
    Lambda       6x6, added mass of all bodies
    K, K_dot, M  6x6, (2), (6), (9); K = K_bodies + Lambda; M at V_r
    I, J         6xN, (9); J at V_r
    Theta_ff     NxN, diag(f^T Theta_s f)
    terms        every wrench of (7) by body and kind, 6 each, in the body's frame about its origin
    P            their sum by body
    F            6, (7)
    phi_dot      N
    gravity, u   3, both in E1
    """

    C: Array
    L1: Array
    V: Array
    V_r: Array
    fixed: tuple[FixedBody, ...]
    flywheels: tuple[SpinningFlywheel, ...]
    K_bodies: Array
    Lambda: Array
    K: Array
    K_dot: Array
    M: Array
    I: Array
    J: Array
    Theta_ff: Array
    terms: Mapping[str, Kinds]
    P: Mapping[str, Array]
    F: Array
    phi_dot: Array
    gravity: Array
    u: Array

    def V_r_dot(self, V_dot: Array) -> Array:
        """V_r* = V* + (omega x C^T u, 0) (6)."""
        return V_dot + self.stream_rate()

    def V_dot(self, V_r_dot: Array) -> Array:
        """V* = V_r* - (omega x C^T u, 0) (6): the stream, steady in E0, turns in E1."""
        return V_r_dot - self.stream_rate()

    def stream_rate(self) -> Array:
        """(omega x C^T u, 0) (6, m/s2)."""
        return np.concatenate([cross(self.V[3:]) @ self.u, np.zeros(3)])
