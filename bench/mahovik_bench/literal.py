"""The literal equations (2)-(9) in CasADi's symbols, as someone would write them who has the paper.

They are a peer's input, not a derivation of this project; their results are checked against the reference.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Flywheel, Stand
from mahovik.proof.reference.algebra import flywheel_mounting
from mahovik.proof.reference.pieces import spatial_inertia

f = ca.sparsify(ca.DM([0.0, 0.0, 0.0, 1.0, 0.0, 0.0]))


def inputs(N: int) -> list[Any]:
    """V, phi, phi_dot, phi_ddot, tau, V_dot: the arguments of every function, in the order of native/peer.h."""
    lengths = {"V": 6, "phi": N, "phi_dot": N, "phi_ddot": N, "tau": N, "V_dot": 6}
    return [ca.SX.sym(name, length) for name, length in lengths.items()]


def cross(a: Any) -> Any:
    """<a>."""
    return ca.skew(a)


def Phi(V: Any) -> Any:
    """Phi(V) = [[<omega>, 0], [<v>, <omega>]]."""
    return ca.vertcat(ca.horzcat(cross(V[3:]), ca.SX(3, 3)), ca.horzcat(cross(V[:3]), cross(V[3:])))


SPIN = ca.sparsify(ca.DM(np.kron(np.eye(2), [[0.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])))


def transfer(s: Flywheel, phi: Any) -> Any:
    """Ls = T [C] at a phase."""
    c, z = ca.cos(phi), ca.sin(phi)
    turned = ca.vertcat(ca.horzcat(1, 0, 0), ca.horzcat(0, c, -z), ca.horzcat(0, z, c))
    C = ca.DM(flywheel_mounting(s)) @ turned
    shift = cross(ca.DM(s.position))
    return ca.vertcat(ca.horzcat(C, ca.SX(3, 3)), ca.horzcat(shift @ C, C))


class Literal:
    """All matrices of (8) at symbolic inputs."""

    def __init__(self, stand: Stand, symbols: Sequence[Any]) -> None:
        self.V, self.phi, self.phi_dot, self.phi_ddot, self.tau, self.V_dot = symbols
        self.Theta = [ca.sparsify(ca.DM(spatial_inertia(s))) for s in stand.flywheels]
        self.L = [transfer(s, self.phi[i]) for i, s in enumerate(stand.flywheels)]
        speeds = list(enumerate(zip(self.L, self.Theta, strict=True)))
        self.K = ca.SX(ca.DM(spatial_inertia(stand.carrier)))
        K_dot = ca.SX(6, 6)
        for i, (L, Theta) in speeds:
            self.K += L @ Theta @ L.T
            K_dot += L @ (SPIN @ Theta - Theta @ SPIN) @ L.T * self.phi_dot[i]
        M = Phi(self.V) @ self.K + K_dot
        self.I = ca.horzcat(*(L @ Theta @ f for _, (L, Theta) in speeds))
        J = ca.horzcat(*((Phi(self.V) @ L + L @ SPIN * self.phi_dot[i]) @ Theta @ f for i, (L, Theta) in speeds))
        self.bias = M @ self.V + J @ self.phi_dot
        self.Theta_ff = ca.vertcat(*(f.T @ Theta @ f for Theta in self.Theta))

    def right(self) -> Any:
        """F - M V - J phi' - I phi'' of (8); no wrench acts."""
        return -self.bias - self.I @ self.phi_ddot

    def of_flywheels(self, V_dot: Any, phi_ddot: Any) -> Any:
        """tau_s = f^T (Theta_s V_s* + Phi(V_s) Z_s) of each flywheel."""
        parts = []
        for i, (L, Theta) in enumerate(zip(self.L, self.Theta, strict=True)):
            V_s = L.T @ self.V + f * self.phi_dot[i]
            V_s_dot = L.T @ V_dot - self.phi_dot[i] * SPIN @ (L.T @ self.V) + f * phi_ddot[i]
            parts.append(f.T @ (Theta @ V_s_dot + Phi(V_s) @ (Theta @ V_s)))
        return ca.vertcat(*parts)

    def full(self) -> tuple[Any, Any]:
        """Matrix and right side of the full system, flywheels first."""
        N = self.phi.shape[0]
        matrix = ca.vertcat(ca.horzcat(ca.diag(ca.SX(self.Theta_ff)), self.I.T), ca.horzcat(self.I, self.K))
        still = self.of_flywheels(ca.SX(6, 1), ca.SX(N, 1))
        return matrix, ca.vertcat(self.tau - still, -self.bias)
