"""The whole system of a stand as one set of Lagrange's equations: its numbers, and the sums over its bodies."""

from __future__ import annotations

import casadi as ca
import numpy as np

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.stand.model import Body, Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.second import body as one
from mahovik.proof.second.body import BodyEnergy, CarrierEnergy
from mahovik.proof.second.rotation import Array, Expr, fixed_rotation, mounting

Place = tuple[Array, Array]
"""Origin (3; m, from O1) and axes (3x3) in E1; a flywheel's at phi_s = 0."""


def places(stand: Stand) -> dict[str, Place]:
    """Place of the carrier, every instrument, flywheel and point, by name."""
    found: dict[str, Place] = {stand.carrier.name: (np.zeros(3), np.eye(3))}
    for p in stand.instruments:
        found[p.name] = (np.array(p.position), fixed_rotation(p.angles))
    for s in stand.flywheels:
        found[s.name] = place_in_E1(found[s.mount], (np.array(s.position), mounting(s.mounting)))
    for point in stand.points:
        found[point.name] = place_in_E1(found[point.mount], (np.array(point.position), fixed_rotation(point.angles)))
    return found


def place_in_E1(mount: Place, place: Place) -> Place:
    """A place in the mount's frame as a place in E1."""
    (at, axes), (position, rotation) = mount, place
    return at + axes @ position, axes @ rotation


def central_inertia(body: Body) -> Array:
    """Tensor of inertia about the mass centre (3x3; kg m2), on the body's axes."""
    J, c = np.array(body.inertia), np.array(body.center_of_mass)
    if body.inertia_about == "center_of_mass":
        return J
    return np.asarray(J - body.mass * (float(c @ c) * np.eye(3) - np.outer(c, c)))


def columns(stand: Stand) -> Array:
    """The numbers of all bodies (SIZE x bodies): carrier, instruments, flywheels."""
    at = places(stand)
    return np.column_stack([_column(body, at[body.name]) for body in stand.bodies])


def _column(body: Body, place: Place) -> Array:
    (origin, axes), J = place, central_inertia(body)
    return np.concatenate([origin, axes.ravel("F"), [body.mass], body.center_of_mass, J.ravel("F")])


def added_mass(stand: Stand) -> Array | None:
    """Added mass of carrier and instruments together (6x6), about O1 in E1; None where there is none."""
    fluids = [stand.carrier.added_mass, *(p.added_mass for p in stand.instruments)]
    parts = [np.array(Lambda) for Lambda in fluids if Lambda is not None]
    return np.asarray(sum(parts)) if parts else None


def stream_at(stand: Stand, position: Expr) -> Expr:
    """u (3; m/s) in E0 where O1 is, by CasADi's own function of lines between stations.

    It is a number to the energies, so that all of the fluid moves as it does there.
    """
    u = ca.DM(stand.stream or (0.0, 0.0, 0.0))
    if stand.profile is None:
        return u
    depth = ca.SX.sym("depth")
    lines = [ca.pw_lin(depth, ca.DM(stand.profile.depth), ca.DM(v)) for v in zip(*stand.profile.velocity, strict=True)]
    by_depth = ca.Function("stream_by_depth", [depth], [ca.vertcat(*lines)])
    return u + by_depth(_depth(stand, position))


def _depth(stand: Stand, position: Expr) -> Expr:
    assert stand.profile is not None
    down = ca.DM(stand.profile.down)
    return ca.dot(down, position) / ca.norm_2(down)


def check_depth(stand: Stand, state: State) -> None:
    """StateError where the profile does not reach to the depth of O1."""
    if stand.profile is None:
        return
    depth, stations = float(_depth(stand, ca.DM(state.position))), stand.profile.depth
    if not stations[0] <= depth <= stations[-1]:
        raise StateError(f"position: depth {depth:.6g} m is outside of stream_profile")


class System:
    """Expressions of a stand at a state and its inputs, which are symbols.

    `inputs` (name -> MX): position (3), C (3x3), V, V_dot (6), phi, phi_dot, phi_ddot, tau (N), wrench (6 x
    bodies, each in the body's frame), and those of the laws of `laws/`. `S` (6 x m): V = S u.
    """

    def __init__(self, stand: Stand, S: Array) -> None:
        self.stand, self.S = stand, S
        self.N = len(stand.flywheels)
        self.count = len(stand.bodies)
        self.fixed = self.count - self.N
        shapes = {"position": (3, 1), "C": (3, 3), "V": (6, 1), "V_dot": (6, 1)}
        shapes |= dict.fromkeys(("phi", "phi_dot", "phi_ddot", "tau"), (self.N, 1))
        shapes |= {"wrench": (6, self.count)}
        for law in parts("energy", CarrierEnergy):
            shapes |= law.inputs(stand)
        self.inputs = {name: ca.MX.sym(name, *shape) for name, shape in shapes.items()}
        self.V = self.inputs["V"]
        self.gravity = self.inputs["C"].T @ ca.DM(stand.gravity)
        self.stream = self.inputs["C"].T @ stream_at(stand, self.inputs["position"])
        self.bodies = ca.DM(columns(stand))
        self.phi = self._flywheel_row(self.inputs["phi"])
        self.q_dot = self._rates(self.V, self.inputs["phi_dot"])
        self.Lambda = added_mass(stand)

    def kinetics(self) -> tuple[Expr, ...]:
        """T (J), Z (6; kg m/s, kg m2/s, in E1 about O1), and of the bodies: K (6x6), flywheel columns (7xN), and their
        centre of mass (3; m) and its velocity (3; m/s) in E1, which are not numbers where there is no mass."""
        T, momenta, mass, moments = self._map_over_bodies(one.body_kinetics())(self.bodies, self.q_dot, self.phi)
        T, Z = ca.sum2(T), ca.sum2(momenta[:6, :])
        m = sum(body.mass for body in self.stand.bodies)
        center, velocity = ca.sum2(moments) / m, Z[:3] / m
        K = mass[:6, :] @ ca.DM(np.tile(np.eye(7)[:, :6], (self.count, 1)))
        if self.Lambda is not None:
            fluid_T, fluid_Z, _ = one.fluid_motion()(self.Lambda, self.stream, self.V, ca.DM.zeros(6))
            T, Z, K = T + fluid_T, Z + fluid_Z, K + self.Lambda
        return T, Z, K, mass[:, [7 * body + 6 for body in range(self.fixed, self.count)]], center, velocity

    def inertial_force(self, V_dot: Expr, phi_ddot: Expr) -> tuple[Expr, Expr]:
        """d/dt (dT/dq') - dT/dq for the accelerations V_dot (6), phi_ddot (N): of the carrier (6), flywheels (N)."""
        acceleration = one.inertial_acceleration(self.V, V_dot)
        q_ddot = self._rates(acceleration, phi_ddot)
        forces = self._map_over_bodies(one.body_inertial_force())(self.bodies, self.q_dot, q_ddot, self.phi)
        carrier = ca.sum2(forces[:6, :])
        if self.Lambda is not None:
            carrier += one.fluid_motion()(self.Lambda, self.stream, self.V, acceleration)[2]
        return carrier, self._of_flywheels(forces[6, :])

    def applied_force(self) -> tuple[Expr, Expr]:
        """Generalized forces of all wrenches but the drive torques: on the carrier (6), on the flywheels (N)."""
        energies = parts("energy", BodyEnergy, BODY_LAWS)
        potentials = tuple(law.potential for law in energies if law.potential is not None)
        numbers = np.array([[x for law in potentials for x in law.numbers(body)] for body in self.stand.bodies]).T
        gravity = ca.repmat(self.gravity, 1, self.count)
        forces = self._map_over_bodies(one.body_force(potentials))(
            self.bodies, ca.DM(numbers), self.phi, gravity, self._wrenches()
        )
        carrier = ca.sum2(forces[:6, :])
        for law in parts("energy", CarrierEnergy):
            carrier += law.force(self.stand, self.inputs)
        return carrier, self._of_flywheels(forces[6, :])

    def _wrenches(self) -> Expr:
        """P (6 x bodies): the run-time wrench and those of laws without a potential, each in its body's frame."""
        stream = ca.repmat(self.stream, 1, self.count)
        twists = self._map_over_bodies(one.body_twist())(self.bodies, self.q_dot, self.phi, stream)
        wrenches = ca.horzsplit(self.inputs["wrench"])
        for law in parts("energy", BodyEnergy, BODY_LAWS):
            for k, body in enumerate(self.stand.bodies):
                if (applied := law.wrench(body, twists[:, k])) is not None:
                    wrenches[k] = wrenches[k] + applied
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
