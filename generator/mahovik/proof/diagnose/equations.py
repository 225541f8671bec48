"""What the wants of the contract ask, from the terms: (1)-(12), a method an answer, to be replaced by a fault."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from mahovik.proof.diagnose.terms import Terms
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Placed, Spinning
from mahovik.proof.reference.inverse import CUTS, inverse_root
from mahovik.proof.reference.linear import solve
from mahovik.proof.reference.points import point_transfers
from mahovik.proof.reference.rotation import C1, kinematic_matrix, kinematic_matrix_rate
from mahovik.proof.reference.screw import block_diagonal, f, spin, wrench_to_parent

Values = dict[str, Any]


class Equations(Terms):
    """Answers at one state. Without an override they are the reference's, but for the order of summation."""

    def evaluate(self, want: str) -> Values:
        """What a want gives, under the names of the contract, as arrays; status and rank are left out."""
        return self.told(want, getattr(self, want)())

    def told(self, want: str, values: Values) -> Values:
        """Values as the program writes them."""
        return values

    # carrier

    def bias(self) -> Array:
        """M V + J phi' (6)."""
        return np.asarray(self.M @ self.V_r + self.J @ self.phi_dot)

    def V_dot(self, V_r_dot: Array) -> Array:
        """V* (6) of V_r*."""
        return V_r_dot - self.stream_rate()

    def given_V_dot(self) -> Array:
        """V* (6) of the state."""
        return np.array(self.state.V_dot)

    def reaction(self) -> Array:
        """I phi'' (6) of given accelerations."""
        return self.I @ self.phi_ddot

    def forward(self) -> Values:
        """(8)."""
        return {"V_dot": self.V_dot(solve(self.K, self.F - self.bias() - self.reaction()))}

    def matrices(self) -> Values:
        """(2), (6), (7), (9)."""
        return {"K": self.K, "K_dot": self.K_dot, "M": self.M, "I": self.I, "J": self.J, "F": self.F}

    def momentum(self) -> Values:
        """(1), (2)."""
        Z = self.K_bodies @ self.V + self.Lambda @ self.V_r + self.I @ self.phi_dot
        m, first = self.K_bodies[0, 0], self.K_bodies[3:, :3]
        return {
            "Z": Z,
            "Z0": self.in_E0(Z),
            "energy": np.array(self.energy()),
            "center_of_mass": np.array([first[2, 1], first[0, 2], first[1, 0]]) / m,
        }

    def in_E0(self, Z: Array) -> Array:
        """L1 Z (6)."""
        return wrench_to_parent(np.array(self.state.position), self.C) @ Z

    def energy(self) -> float:
        """Kinetic energy (J)."""
        placed: tuple[Placed, ...] = (*self.fixed, *self.flywheels)
        twists = [(k.twist(self.V), k.Theta) for k in placed]
        return float(0.5 * (sum(V @ Theta @ V for V, Theta in twists) + self.V_r @ self.Lambda @ self.V_r))

    def generalized(self) -> Values:
        """(10), (11)."""
        angles = np.array(self.state.angles or (0.0, 0.0, 0.0))
        A = kinematic_matrix(self.stand.angles, angles)
        q_dot = solve(A, self.V)
        D = self.kinematic_rate(angles, q_dot[3:])
        I0, KD = self.K @ A, self.K @ D
        right = self.F - (KD + self.M @ A) @ solve(A, self.V_r) - self.reaction() - self.J @ self.phi_dot
        J0 = KD + self.velocity_matrix(self.V) @ A
        return {"A": A, "D": D, "I0": I0, "J0": J0, "q_dot": q_dot, "q_ddot": solve(I0, right)}

    def kinematic_rate(self, angles: Array, rates: Array) -> Array:
        """D = A' (6x6)."""
        return kinematic_matrix_rate(self.stand.angles, angles, rates)

    # flywheels

    def base_acceleration(self, k: Spinning, V_dot: Array) -> Array:
        """Ls^T V* (6), of V_s*."""
        return k.L.T @ V_dot

    def transport(self, k: Spinning, V: Array) -> Array:
        """-phi_s' [<e>] Ls^T V (6), of V_s*."""
        return -k.phi_dot * spin @ k.L.T @ V

    def own_acceleration(self, k: Spinning, phi_ddot: float) -> Array:
        """f phi_s'' (6), of V_s*."""
        return f * phi_ddot

    def gyroscopic(self, k: Spinning, V_s: Array) -> Array:
        """Phi(V_s) Z_s (6)."""
        return self.Phi(V_s) @ k.Theta @ V_s

    def own_wrench(self, k: Spinning) -> Array:
        """P_s (6), as the drive's equation takes it."""
        return self.P[k.body.name]

    def on_flywheel(self, k: Spinning, V: Array, V_dot: Array, phi_ddot: float) -> Array:
        """Theta_s V_s* + Phi(V_s) Z_s - P_s (6), in Es about Os."""
        rate = self.base_acceleration(k, V_dot) + self.transport(k, V) + self.own_acceleration(k, phi_ddot)
        return np.asarray(k.Theta @ rate + self.gyroscopic(k, k.twist(V)) - self.own_wrench(k))

    def load(self, k: Spinning, phi_ddot: float) -> Array:
        """The same (6) at the motion that the state gives."""
        return self.on_flywheel(k, self.V, self.given_V_dot(), phi_ddot)

    def _loads(self) -> list[Array]:
        return [self.load(k, each) for k, each in zip(self.flywheels, self.phi_ddot, strict=True)]

    def torque(self) -> Values:
        """tau."""
        return {"tau": np.array([f @ load for load in self._loads()], dtype=np.float64)}

    def in_mount(self, k: Spinning, load: Array) -> Array:
        """A load of Es (6) in axes that do not turn."""
        return block_diagonal(C1(k.phi)) @ load

    def mounts(self) -> Values:
        """mount_wrench."""
        loads = [self.in_mount(k, load) for k, load in zip(self.flywheels, self._loads(), strict=True)]
        return {"mount_wrench": np.array(loads).reshape(-1, 6)}

    def given_tau(self) -> Array:
        """tau (N) of the state."""
        return np.array(self.state.tau, dtype=np.float64)

    def of_carrier(self) -> Array:
        """I^T (Nx6): what the carrier's acceleration asks of the drives."""
        return self.I.T

    def coupled(self) -> Values:
        """The full system of 6 + N."""
        still = [f @ self.on_flywheel(k, self.V_r, np.zeros(6), 0.0) for k in self.flywheels]
        right = np.concatenate([self.F - self.bias(), self.given_tau() - np.array(still, dtype=np.float64)])
        found = solve(np.block([[self.K, self.I], [self.of_carrier(), self.Theta_ff]]), right)
        return {"V_dot": self.V_dot(found[:6]), "phi_ddot": found[6:]}

    def inverse(self) -> Values:
        """(12): least squares in the norms of the contract."""
        K_root, Theta_root = inverse_root(self.K), inverse_root(self.Theta_ff)
        wanted = self.F - self.K @ (self.given_V_dot() + self.stream_rate()) - self.bias()
        U, sigma, Vt = np.linalg.svd(K_root @ self.I @ Theta_root.T, full_matrices=False)
        rank = int(np.sum(sigma > CUTS.rank * sigma[0])) if sigma.size else 0
        phi_ddot = Theta_root.T @ Vt[:rank].T @ ((U[:, :rank].T @ K_root @ wanted) / sigma[:rank])
        return {"phi_ddot": phi_ddot, "residual": wanted - self.I @ phi_ddot, "sigma": sigma}

    # points

    def point_transfers(self) -> Sequence[tuple[str, Array]]:
        """Name and L (6x6) of every instrument and point."""
        return list(point_transfers(self.stand))

    def point_acceleration(self, V_p: Array, V_p_dot: Array) -> Array:
        """v* + omega x v (3) of a point, in its axes."""
        return V_p_dot[:3] + np.cross(V_p[3:], V_p[:3])

    def felt_gravity(self) -> Array:
        """Gravity (3) in E1 as an accelerometer feels it."""
        return self.gravity

    def points(self) -> Values:
        """Values of every instrument and point by name."""
        return {"points": {name: self._point(L) for name, L in self.point_transfers()}}

    def _point(self, L: Array) -> Values:
        to_E0 = wrench_to_parent(np.array(self.state.position), self.C) @ L
        C = to_E0[:3, :3]
        O_cross = to_E0[3:, :3] @ C.T
        V_p, V_p_dot = L.T @ self.V, L.T @ self.given_V_dot()
        return {
            "position": np.array([O_cross[2, 1], O_cross[0, 2], O_cross[1, 0]]),
            "C": C,
            "twist": V_p,
            "specific_force": self.point_acceleration(V_p, V_p_dot) - L[:3, :3].T @ self.felt_gravity(),
            "angular_acceleration": V_p_dot[3:],
        }
