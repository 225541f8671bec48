"""The whole system of a stand as one set of Lagrange's equations: the sums over its bodies."""

from __future__ import annotations

import casadi as ca
import numpy as np

from mahovik.contract import laws
from mahovik.core.stand.model import Stand
from mahovik.proof.second import force, lagrange
from mahovik.proof.second.bodies import columns
from mahovik.proof.second.chart import Expr, inertial_acceleration
from mahovik.proof.second.rotation import Array
from mahovik.proof.second.stream import stream_at


class System:
    """Expressions of a stand at a state and its inputs, which are symbols.

    `inputs` (name -> MX): position (3), C (3x3), V, V_dot (6), phi, phi_dot, phi_ddot, tau (N), wrench (6 x
    bodies, each in the body's frame), and those of the laws of `laws/`.
    """

    def __init__(self, stand: Stand) -> None:
        self.stand = stand
        self.N = len(stand.flywheels)
        self.count = len(stand.bodies)
        self.fixed = self.count - self.N
        shapes = {"position": (3, 1), "C": (3, 3), "V": (6, 1), "V_dot": (6, 1)}
        shapes |= dict.fromkeys(("phi", "phi_dot", "phi_ddot", "tau"), (self.N, 1))
        shapes |= {"wrench": (6, self.count)}
        for law in laws.parts("second"):
            shapes |= law.inputs(stand)
        self.inputs = {name: ca.MX.sym(name, *shape) for name, shape in shapes.items()}
        self.V = self.inputs["V"]
        self.gravity = self.inputs["C"].T @ ca.DM(stand.gravity)
        self.stream = self.inputs["C"].T @ stream_at(stand, self.inputs["position"])
        self.bodies = ca.DM(columns(stand))
        self.law_numbers = ca.DM(force.law_columns(stand))
        self.phi = self._flywheel_row(self.inputs["phi"])
        self.q_dot = self._rates(self.V, self.inputs["phi_dot"])
        self.Lambda = added_mass(stand)

    def kinetics(self) -> tuple[Expr, Expr, Expr, Expr]:
        """T (J), Z (6; kg m/s, kg m2/s, in E1 about O1), and of the bodies: K (6x6), flywheel columns (7xN)."""
        T, momenta, mass = self._map_over_bodies(lagrange.body_kinetics())(self.bodies, self.q_dot, self.phi)
        T, Z = ca.sum2(T), ca.sum2(momenta[:6, :])
        K = mass[:6, :] @ ca.DM(np.tile(np.eye(7)[:, :6], (self.count, 1)))
        if self.Lambda is not None:
            fluid_T, fluid_Z = lagrange.fluid_kinetics()(self.Lambda, self.stream, self.V)
            T, Z, K = T + fluid_T, Z + fluid_Z, K + self.Lambda
        return T, Z, K, mass[:, [7 * body + 6 for body in range(self.fixed, self.count)]]

    def center_of_mass(self) -> Expr:
        """Centre of mass of all bodies (3; m), in E1. Not a number where there is no mass."""
        moments = self._map_over_bodies(lagrange.body_moment())(self.bodies, self.phi)
        return ca.sum2(moments) / sum(body.mass for body in self.stand.bodies)

    def inertial_force(self, V_dot: Expr, phi_ddot: Expr) -> tuple[Expr, Expr]:
        """d/dt (dT/dq') - dT/dq for the accelerations V_dot (6), phi_ddot (N): of the carrier (6), flywheels (N)."""
        acceleration = inertial_acceleration(self.V, V_dot)
        q_ddot = self._rates(acceleration, phi_ddot)
        found = self._map_over_bodies(lagrange.body_inertial_force())(self.bodies, self.q_dot, q_ddot, self.phi)
        carrier = ca.sum2(found[:6, :])
        if self.Lambda is not None:
            carrier += lagrange.fluid_inertial_force()(self.Lambda, self.stream, self.V, acceleration)
        return carrier, self._of_flywheels(found[6, :])

    def applied_force(self) -> tuple[Expr, Expr]:
        """Generalized forces of all wrenches but the drive torques: on the carrier (6), on the flywheels (N)."""
        gravity = ca.repmat(self.gravity, 1, self.count)
        found = self._map_over_bodies(force.body_force())(
            self.bodies, self.law_numbers, self.phi, gravity, self._wrenches()
        )
        carrier = ca.sum2(found[:6, :])
        for law in laws.parts("second"):
            carrier += law.force(self.stand, self.inputs)
        return carrier, self._of_flywheels(found[6, :])

    def _wrenches(self) -> Expr:
        """P (6 x bodies): the run-time wrench and those of laws without a potential, each in its body's frame."""
        stream = ca.repmat(self.stream, 1, self.count)
        twists = self._map_over_bodies(force.body_twist())(self.bodies, self.q_dot, self.phi, stream)
        wrenches = ca.horzsplit(self.inputs["wrench"])
        for wrench in laws.of_bodies("second", "wrench"):
            for k, body in enumerate(self.stand.bodies):
                if (found := wrench(body, twists[:, k])) is not None:
                    wrenches[k] = wrenches[k] + found
        return ca.horzcat(*wrenches)

    def _map_over_bodies(self, function: Expr) -> Expr:
        """The function of one body as one of all: arguments and results side by side."""
        return function.map(self.count)

    def _rates(self, carrier: Expr, flywheels: Expr) -> Expr:
        """q' or q'' of all bodies (7 x bodies)."""
        return ca.vertcat(ca.repmat(carrier, 1, self.count), self._flywheel_row(flywheels))

    def _flywheel_row(self, values: Expr) -> Expr:
        """One number per body (1 x bodies): those of the flywheels, zero for the bodies that have no phi."""
        return ca.horzcat(ca.MX.zeros(1, self.fixed), values.T)

    def _of_flywheels(self, row: Expr) -> Expr:
        return row[self.fixed :].T


def added_mass(stand: Stand) -> Array | None:
    """Added mass of carrier and instruments together (6x6), about O1 in E1; None where there is none."""
    given = [stand.carrier.added_mass, *(p.added_mass for p in stand.instruments)]
    found = [np.array(Lambda) for Lambda in given if Lambda is not None]
    return np.asarray(sum(found)) if found else None
