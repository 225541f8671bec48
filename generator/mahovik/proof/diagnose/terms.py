"""The terms of (1)-(9) at one state, a method a term, so that a fault can replace exactly one of them.

Formulas are those of the literal reference; what is added here is only where each may be replaced.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from mahovik.core.stand.model import Body, Carrier, Flywheel, Instrument, Stand
from mahovik.core.stand.state import State
from mahovik.laws import LAWS, part
from mahovik.proof.reference import wrenches
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Fixed, Placed, Spinning, flywheel_transfer, instrument_transfer
from mahovik.proof.reference.inertia import added_mass, spatial_inertia
from mahovik.proof.reference.pose import Pose
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.proof.reference.screw import Phi, f, spin

AnyBody = TypeVar("AnyBody", bound=Body)

ZERO6 = np.zeros(6)


class Terms:
    """The terms at `state` of `stand`; an override of a method is a fault in that term, and in all that follow from it.

    `wheels`: of a fault that concerns flywheels, by its class, the name of the only one that has it; all where a class
    is not in it. Arrays are in SI, in E1 about O1 unless said otherwise; names are those of `reference.Pieces`.
    """

    def __init__(self, stand: Stand, state: State, wheels: dict[type[Any], str] | None = None) -> None:
        self.wheels = wheels or {}
        self.stand = stand = self.read_stand(self._bodies_read(stand))
        self.state = state = self.read_state(state)
        self.V = self.twist(np.array(state.V))
        self.C = self.rotation()
        self.u = self.stream()
        self.gravity = self.gravity_in_E1()
        self.V_r = self.V - np.concatenate([self.u, np.zeros(3)])
        fixed: tuple[Carrier | Instrument, ...] = (stand.carrier, *stand.instruments)
        self.fixed = tuple(Fixed(k, self.fixed_transfer(k), self.theta(k), self.fluid(k)) for k in fixed)
        self.flywheels = tuple(
            self._spinning(s, *motion) for s, *motion in zip(stand.flywheels, state.phi, state.phi_dot, strict=True)
        )
        self.phi_dot = np.array([k.phi_dot for k in self.flywheels], dtype=np.float64)
        self.phi_ddot = np.array(
            [self.acceleration(s, each) for s, each in zip(stand.flywheels, state.phi_ddot, strict=True)],
            dtype=np.float64,
        )
        self.Lambda = self.added_mass()
        self.K_bodies = self._sum([self.fixed_mass(k) for k in self.fixed])
        self.K_bodies = self.K_bodies + self._sum([self.wheel_mass(k) for k in self.flywheels])
        self.K = self.mass_matrix()
        self.K_dot = self._sum([self.wheel_rate(k) for k in self.flywheels])
        self.M = self.velocity_matrix(self.V_r)
        self.I = self._columns([self.coupling(k) for k in self.flywheels])
        self.J = self._columns([self.turning(k) + self.spinning(k) for k in self.flywheels])
        self.Theta_ff = np.diag([self.spin_inertia(k) for k in self.flywheels])
        placed: tuple[Placed, ...] = (*self.fixed, *self.flywheels)
        self.P = {k.body.name: self.wrench(k) for k in placed}
        self.F = np.asarray(sum((self.carried(k, self.P[k.body.name]) for k in placed), ZERO6)) + self.ties()

    def _bodies_read(self, stand: Stand) -> Stand:
        return replace(
            stand,
            carrier=self.read_body(stand.carrier),
            instruments=tuple(self.read_body(p) for p in stand.instruments),
            flywheels=tuple(self.read_body(s) for s in stand.flywheels),
        )

    def _spinning(self, s: Flywheel, phi: float, phi_dot: float) -> Spinning:
        phase = self.phase(s, phi)
        return Spinning(s, self.wheel_transfer(s, phase), self.theta(s), phase, self.speed(s, phi_dot))

    @staticmethod
    def _sum(matrices: list[Array]) -> Array:
        return np.asarray(sum(matrices, np.zeros((6, 6))))

    @staticmethod
    def _columns(columns: list[Array]) -> Array:
        return np.column_stack(columns) if columns else np.zeros((6, 0))

    # what is read

    def read_stand(self, stand: Stand) -> Stand:
        """The stand as the program understands its file."""
        return stand

    def read_body(self, body: AnyBody) -> AnyBody:
        """One body of it."""
        return body

    def read_state(self, state: State) -> State:
        """The state as the program understands its line."""
        return state

    def twist(self, V: Array) -> Array:
        """V (6) of the state."""
        return V

    def phase(self, s: Flywheel, phi: float) -> float:
        """phi_s (rad)."""
        return phi

    def speed(self, s: Flywheel, phi_dot: float) -> float:
        """phi_s' (rad/s)."""
        return phi_dot

    def acceleration(self, s: Flywheel, phi_ddot: float) -> float:
        """phi_s'' (rad/s2), where it is given."""
        return phi_ddot

    # frames

    def rotation(self) -> Array:
        """C (3x3) of the carrier."""
        return carrier_rotation(self.stand, self.state)

    def stream(self) -> Array:
        """C^T u (3; m/s)."""
        return np.asarray(self.C.T @ np.array(self.stand.stream or (0.0, 0.0, 0.0)))

    def gravity_in_E1(self) -> Array:
        """C^T g (3; m/s2)."""
        return np.asarray(self.C.T @ np.array(self.stand.gravity))

    def stream_rate(self) -> Array:
        """(omega x C^T u, 0) (6)."""
        return np.concatenate([np.cross(self.V[3:], self.u), np.zeros(3)])

    def fixed_transfer(self, body: Carrier | Instrument) -> Array:
        """L (6x6) of the carrier or an instrument."""
        return instrument_transfer(body) if isinstance(body, Instrument) else np.eye(6)

    def wheel_transfer(self, s: Flywheel, phi: float) -> Array:
        """Ls (6x6)."""
        return flywheel_transfer(self.stand, s, phi)

    # inertia, (2)

    def theta(self, body: Body) -> Array:
        """Theta (6x6) about the body's origin, in its axes."""
        return spatial_inertia(body)

    def fluid(self, body: Carrier | Instrument) -> Array:
        """Lambda (6x6) of one body."""
        return added_mass(body.added_mass)

    def added_mass(self) -> Array:
        """Lambda_1 + sum_p Lambda_p (6x6)."""
        return self._sum([k.Lambda for k in self.fixed])

    def fixed_mass(self, k: Fixed) -> Array:
        """Theta_1 or Lp Theta_p Lp^T (6x6)."""
        return k.L @ k.Theta @ k.L.T

    def wheel_mass(self, k: Spinning) -> Array:
        """Ls Theta_s Ls^T (6x6)."""
        return k.L @ k.Theta @ k.L.T

    def mass_matrix(self) -> Array:
        """K (6x6)."""
        return self.K_bodies + self.Lambda

    def spin_inertia(self, k: Spinning) -> float:
        """f^T Theta_s f (kg m2)."""
        return float(f @ k.Theta @ f)

    # velocity terms, (5), (6), (9)

    def Phi(self, V: Array) -> Array:
        """Phi (6x6) of any twist."""
        return Phi(V)

    def convected(self, V: Array) -> Array:
        """Phi K (6x6)."""
        return self.Phi(V) @ self.K

    def velocity_matrix(self, V: Array) -> Array:
        """M = Phi K + K* (6x6)."""
        return self.convected(V) + self.K_dot

    def wheel_rate(self, k: Spinning) -> Array:
        """Ls ([<e>] Theta_s - Theta_s [<e>]) Ls^T phi_s' (6x6)."""
        return np.asarray(k.L @ (spin @ k.Theta - k.Theta @ spin) @ k.L.T * k.phi_dot)

    def coupling(self, k: Spinning) -> Array:
        """I_s = Ls Theta_s f (6)."""
        return np.asarray(k.L @ k.Theta @ f)

    def turning(self, k: Spinning) -> Array:
        """Phi Ls Theta_s f (6), of J_s."""
        return np.asarray(self.Phi(self.V_r) @ k.L @ k.Theta @ f)

    def spinning(self, k: Spinning) -> Array:
        """Ls [<e>] phi_s' Theta_s f (6), of J_s."""
        return np.asarray(k.L @ spin @ k.Theta @ f * k.phi_dot)

    # wrenches, (7), in the body's frame about its origin

    def weight(self, body: Body, gravity: Array) -> Array:
        """Weight (6); `gravity` (3) in the body's frame."""
        return wrenches.weight(body, gravity)

    def buoyancy(self, body: Body, gravity: Array) -> Array:
        """Archimedes force (6)."""
        return wrenches.buoyancy(body, gravity)

    def damping(self, k: Placed, V_r: Array) -> Array:
        """All damping (6) at the body's twist relative to the fluid, in its frame."""
        if k.body.damping is None:
            return ZERO6
        kinds = (wrenches.linear_damping, wrenches.quadratic_damping, wrenches.damping_terms)
        return np.asarray(sum((kind(k.body.damping, V_r) for kind in kinds), ZERO6))

    def twist_in_fluid(self, k: Placed) -> Array:
        """The twist (6) that damping takes."""
        return k.twist(self.V_r)

    def run_time(self, k: Placed) -> Array:
        """The caller's wrench (6)."""
        return wrenches.run_time_wrench(self.state, k.body)

    def wrench(self, k: Placed) -> Array:
        """P_k (6) but for the carrier's ties."""
        gravity = k.L[:3, :3].T @ self.gravity
        P = self.weight(k.body, gravity) + self.buoyancy(k.body, gravity)
        return P + self.damping(k, self.twist_in_fluid(k)) + self.run_time(k)

    def carried(self, k: Placed, P: Array) -> Array:
        """L P (6)."""
        return k.L @ P

    def ties(self) -> Array:
        """The laws between E0 and the carrier (6), added up."""
        return np.asarray(sum((self.law_wrench(law) for law in LAWS), ZERO6))

    @property
    def pose(self) -> Pose:
        """What those laws depend on."""
        return Pose(np.array(self.state.position), self.C, self.V)

    def law_wrench(self, law: str) -> Array:
        """Wrench (6) of one law of `laws/`, by its folder."""
        return np.asarray(sum(part(law, "reference").wrenches(self.stand, self.state, self.pose).values(), ZERO6))
