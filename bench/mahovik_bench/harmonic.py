"""The equations as a table of harmonics, in CasADi's symbols: what a user who knows the structure can give to CasADi.

A flywheel's part of K is a sum of harmonics of its phase up to the second; its numbers are found by sampling K, the
constant ones join the carrier. Like the literal equations they are a peer's input, and are checked by the reference.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Flywheel, Stand
from mahovik.proof.reference.algebra import flywheel_mounting
from mahovik.proof.reference.pieces import spatial_inertia
from mahovik_bench.cases import Array

PHASES = 2.0 * np.pi * np.arange(5) / 5
"""Phases at which K is sampled: as many as there are harmonics."""

WAVES = np.stack([np.ones(5), np.cos(PHASES), np.sin(PHASES), np.cos(2 * PHASES), np.sin(2 * PHASES)], axis=1)


def _numeric_transfer(s: Flywheel, phi: float) -> Array:
    """Ls of the model at a phase."""
    c, z = np.cos(phi), np.sin(phi)
    C = flywheel_mounting(s) @ np.array([[1.0, 0.0, 0.0], [0.0, c, -z], [0.0, z, c]])
    x, y, w = s.position
    shift = np.array([[0.0, -w, y], [w, 0.0, -x], [-y, x, 0.0]])
    return np.block([[C, np.zeros((3, 3))], [shift @ C, C]])


def _harmonics(values: Array) -> Array:
    """Coefficients (5, ...) of 1, cos, sin, cos 2, sin 2 of samples (5, ...); those that are rounding are zero."""
    coefficients = np.linalg.solve(WAVES, values.reshape(5, -1))
    coefficients[np.abs(coefficients) < 1e-14 * np.abs(coefficients).max()] = 0.0
    return np.asarray(coefficients.reshape(values.shape))


class Harmonic:
    """Quantities of (8) at symbolic inputs, by first moments, inertias and their derivatives by the phases."""

    def __init__(self, stand: Stand, symbols: Sequence[Any]) -> None:
        self.V, self.phi, self.phi_dot, self.phi_ddot, self.tau, self.V_dot = symbols
        constant = np.array(spatial_inertia(stand.carrier))
        self.waves: list[tuple[Any, Any, Any, Any]] = []
        self.parts: list[tuple[Array, Array]] = []
        self.spin: list[float] = []
        for s, wheel in enumerate(stand.flywheels):
            Theta = spatial_inertia(wheel)
            L = np.stack([_numeric_transfer(wheel, phi) for phi in PHASES])
            K = _harmonics(L @ Theta @ np.swapaxes(L, 1, 2))
            column = _harmonics(L @ Theta[:, 3])
            constant += K[0]
            c, z = ca.cos(self.phi[s]), ca.sin(self.phi[s])
            self.waves.append((c, z, 1 - 2 * z * z, 2 * z * c))
            self.parts.append((K, column))
            self.spin.append(float(Theta[3, 3]))
        self.mass = constant[0, 0]
        self.mu, self.J = _moments(constant)
        self.mu_dot, self.J_dot = ca.SX(3, 1), ca.SX(3, 3)
        for s in range(len(self.parts)):
            mu, J, mu_phi, J_phi = self._phase_parts(s)
            self.mu += mu
            self.J += J
            self.mu_dot += mu_phi * self.phi_dot[s]
            self.J_dot += J_phi * self.phi_dot[s]

    def _phase_parts(self, s: int) -> tuple[Any, Any, Any, Any]:
        """First moment and inertia of a flywheel without their means, and their derivatives by its phase."""
        c, z, c2, z2 = self.waves[s]
        pairs = [_moments(moments) for moments in self.parts[s][0]]
        (mu_c, J_c), (mu_s, J_s), (_, J_2c), (_, J_2s) = pairs[1:]
        mu, mu_phi = mu_c * c + mu_s * z, mu_s * c - mu_c * z
        J = J_c * c + J_s * z + J_2c * c2 + J_2s * z2
        return mu, J, mu_phi, J_s * c - J_c * z + 2 * (J_2s * c2 - J_2c * z2)

    def column(self, s: int) -> tuple[Any, Any]:
        """I_s (6) and its derivative by the phase."""
        c, z, _, _ = self.waves[s]
        I_0, I_c, I_s = (ca.sparsify(ca.DM(x)) for x in self.parts[s][1][:3])
        return I_0 + I_c * c + I_s * z, I_s * c - I_c * z

    def bias(self) -> Any:
        """Phi Z + K* V + sum dI/dphi phi'^2: the terms of (8) without accelerations."""
        v, omega = self.V[:3], self.V[3:]
        Z = ca.vertcat(self.mass * v - ca.cross(self.mu, omega), ca.cross(self.mu, v) + self.J @ omega)
        rates = ca.vertcat(-ca.cross(self.mu_dot, omega), ca.cross(self.mu_dot, v) + self.J_dot @ omega)
        for s in range(len(self.parts)):
            column, own_phi = self.column(s)
            Z += column * self.phi_dot[s]
            rates += own_phi * self.phi_dot[s] ** 2
        return rates + ca.vertcat(ca.cross(omega, Z[:3]), ca.cross(v, Z[:3]) + ca.cross(omega, Z[3:]))

    def torque_bias(self, s: int) -> Any:
        """Drive torque of a flywheel without accelerations: less the derivative of the energy by its phase."""
        v, omega = self.V[:3], self.V[3:]
        _, _, mu_phi, J_phi = self._phase_parts(s)
        return -ca.dot(mu_phi, ca.cross(v, omega)) - 0.5 * ca.dot(omega, J_phi @ omega)

    def torque(self) -> Any:
        """Drive torques for a given motion."""
        torques = []
        for s, spin in enumerate(self.spin):
            column, _ = self.column(s)
            torques.append(ca.dot(column, self.V_dot) + spin * self.phi_ddot[s] + self.torque_bias(s))
        return ca.vertcat(*torques)

    def forward(self) -> Any:
        """V* for given phi'': the block of the mass is constant, a system of three remains."""
        F = -self.bias()
        for s in range(len(self.parts)):
            F -= self.column(s)[0] * self.phi_ddot[s]
        rho = self.mu / self.mass
        S = self.J + ca.skew(self.mu) @ ca.skew(rho)
        omega_dot = solved(S, F[3:] - ca.cross(rho, F[:3]))
        return ca.vertcat(F[:3] / self.mass + ca.cross(rho, omega_dot), omega_dot)

    def coupled(self) -> Any:
        """V* and phi'' for given torques: the flywheels are eliminated, a system of six remains."""
        mass = ca.SX(ca.DM(self.mass * np.eye(3)))
        K = ca.vertcat(ca.horzcat(mass, -ca.skew(self.mu)), ca.horzcat(ca.skew(self.mu), self.J))
        F, columns, left = -self.bias(), [], []
        for s, spin in enumerate(self.spin):
            column, _ = self.column(s)
            columns.append(column)
            left.append(self.tau[s] - self.torque_bias(s))
            K -= column @ column.T / spin
            F -= column * (left[s] / spin)
        V_dot = solved(K, F)
        phi_ddot = [(left[s] - ca.dot(columns[s], V_dot)) / spin for s, spin in enumerate(self.spin)]
        return ca.vertcat(V_dot, *phi_ddot)


def _moments(K: Array) -> tuple[Any, Any]:
    """First moment and inertia that a 6 x 6 block of inertia holds."""
    mu = np.array([K[5, 1], K[3, 2], K[4, 0]])
    return ca.sparsify(ca.DM(mu)), ca.sparsify(ca.DM(K[3:, 3:]))


def solved(matrix: Any, right: Any) -> Any:
    """Solve by LDL^T without permutation."""
    D, LT, order = ca.ldl(matrix, False)
    return ca.ldl_solve(right, D, LT, order)
