"""A generic body: its coordinates, its energy, and Lagrange's equations of it by automatic differentiation; rotations.

Local coordinates q = (delta, xi, phi) go through the present pose of the system:

    x = delta + E(xi) rho(phi),     R = E(xi) G(phi)

are place and axes of anything that moves with the carrier, on the inertial axes that coincide with E1 at this
instant: delta (3; m) moves O1, xi (3; rad) turns the carrier, phi (rad) turns a flywheel. The present pose is
delta = 0, xi = 0, so q' = (V, phi') there. E(xi) is exact to the second order in xi: no equation of motion, and no
acceleration, differentiates it more than twice, so all that is found at xi = 0 is exact. In these coordinates
Lagrange's equations hold as they stand, without any rule for quasi-velocities.

Every function is of one body and built once; a stand calls it with one column of numbers per body.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.core.stand.model import Body, MountingAngles, MountingAxes, Quaternion, Sequence, Stand, State, Vec3

# -- rotations ---------------------------------------------------------------------------------------------------------

Array = NDArray[np.float64]

Expr = Any
"""A CasADi expression (SX, MX) or matrix of numbers (DM): CasADi has no common type for them."""

AXES: dict[Sequence, tuple[int, int, int]] = {"ship": (3, 2, 1), "aircraft": (2, 3, 1), "euler": (3, 1, 3)}
"""Axes about which psi, theta, phi turn, one after the other, each about the axis where the last turn left it."""


def elementary(axis: int, angle: Expr) -> Expr:
    """C1, C2 or C3 of an angle (rad): the active rotation about axis 1, 2 or 3 (3x3)."""
    c, s = ca.cos(angle), ca.sin(angle)
    rows = {
        1: ((1, 0, 0), (0, c, -s), (0, s, c)),
        2: ((c, 0, s), (0, 1, 0), (-s, 0, c)),
        3: ((c, -s, 0), (s, c, 0), (0, 0, 1)),
    }[axis]
    return ca.vertcat(*(ca.horzcat(*row) for row in rows))


def by_angles(sequence: Sequence, angles: Expr) -> Expr:
    """C (3x3) of the angles psi, theta, phi (rad) of a sequence."""
    return _of_angles(sequence)(angles)


@cache
def _of_angles(sequence: Sequence) -> Expr:
    """(angles) -> C: made once, as sines and matrices of single numbers take long."""
    angles, (first, second, third) = ca.SX.sym("angles", 3), AXES[sequence]
    C = elementary(first, angles[0]) @ elementary(second, angles[1]) @ elementary(third, angles[2])
    return ca.Function("of_angles", [angles], [C])


def by_axis(axis: Expr, angle: Expr) -> Expr:
    """Rotation (3x3) about an axis of length 1 by an angle (rad)."""
    outer = axis @ axis.T
    return outer + ca.cos(angle) * (ca.DM.eye(3) - outer) + ca.sin(angle) * ca.skew(axis)


def turn(xi: Expr) -> Expr:
    """E(xi) = 1 + <xi> + <xi>^2 / 2 (3x3): the rotation by the vector xi, to the second order."""
    return ca.DM.eye(3) + ca.skew(xi) + ca.skew(xi) @ ca.skew(xi) / 2


def directional_derivative(expression: Expr, variables: Expr, rates: Expr) -> Expr:
    """Directional derivative of a matrix expression along `rates` of `variables`; of the same shape."""
    return ca.reshape(ca.jtimes(ca.vec(expression), variables, rates), *expression.shape)


def angular_velocity(R: Expr, R_dot: Expr) -> Expr:
    """omega (3; rad/s) of axes R with rates R_dot, in these axes: <omega> = R^T R', its antisymmetric part."""
    S = R.T @ R_dot
    return ca.vertcat(S[2, 1] - S[1, 2], S[0, 2] - S[2, 0], S[1, 0] - S[0, 1]) / 2


def fixed_rotation(angles: Vec3) -> Array:
    """C3(psi) C2(theta) C1(phi) (3x3) of an instrument or a point."""
    return np.asarray(by_angles("ship", ca.DM(angles)).full())


def mounting(directions: MountingAngles | MountingAxes) -> Array:
    """Axes of a flywheel in its mount's frame at phi_s = 0 (3x3)."""
    if isinstance(directions, MountingAngles):
        return fixed_rotation((directions.psi, directions.theta, directions.zero))
    first, zero = unit(directions.axis), unit(directions.zero)
    second = unit(zero - first * float(first @ zero))
    return np.column_stack([first, second, np.cross(first, second)])


def unit(a: ArrayLike) -> Array:
    """The direction of a vector (3) that is not zero, as a vector of length 1."""
    scaled = np.asarray(a) / np.abs(a).max()  # first, so that squares neither overflow nor vanish
    return np.asarray(scaled / math.hypot(*scaled))


def attitude(sequence: Sequence, state: State) -> Array:
    """C (3x3), x0 = C x1, of a state in angles, in a quaternion, or in neither (aligned with E0)."""
    if state.quaternion is not None:
        return by_quaternion(state.quaternion)
    return np.asarray(by_angles(sequence, ca.DM(state.angles or (0.0, 0.0, 0.0))).full())


def by_quaternion(quaternion: Quaternion) -> Array:
    """C (3x3) of a unit quaternion, w first: the vector part of q (0, x) q^-1 for x along each axis."""
    w, *vector = quaternion
    a = np.array(vector)
    return np.asarray((w * w - a @ a) * np.eye(3) + 2 * np.outer(a, a) + 2 * w * np.cross(a, np.eye(3)).T)


def rotation_vector(C: Array) -> Array:
    """Vector (3; rad, of length <= pi) of a rotation C (3x3): C = exp<x>."""
    w, *vector = quaternion_of(C)
    sine = math.hypot(*vector)
    return np.array(vector) * (2 * math.atan2(sine, w) / sine) if sine else np.zeros(3)


def quaternion_of(C: Array) -> Array:
    """Quaternion (4), w first and not negative, of a rotation C (3x3).

    Its outer product with itself is linear in C; the column with the largest diagonal is taken, so that no digits are
    lost at any angle.
    """
    trace = float(np.trace(C))
    odd = np.array([C[2, 1] - C[1, 2], C[0, 2] - C[2, 0], C[1, 0] - C[0, 1]])
    outer = np.zeros((4, 4))  # 4 q q^T, w first
    outer[0, 0] = 1 + trace
    outer[0, 1:] = outer[1:, 0] = odd
    outer[1:, 1:] = C + C.T + (1 - trace) * np.eye(3)
    q = outer[int(np.argmax(np.diag(outer)))]
    return np.asarray(q / math.hypot(*q) * (-1.0 if q[0] < 0 else 1.0))


# -- the body ----------------------------------------------------------------------------------------------------------

SIZE = 25
"""Numbers of a body: origin 3, axes 9, mass 1, mass centre 3, inertia about it 9."""


class Chart:
    """Symbols of the coordinates of one body and their rates: q, q_dot, q_ddot (7)."""

    def __init__(self) -> None:
        self.q = ca.SX.sym("q", 7)
        self.q_dot = ca.SX.sym("q_dot", 7)
        self.q_ddot = ca.SX.sym("q_ddot", 7)
        self.delta, self.xi, self.phi = self.q[:3], self.q[3:6], self.q[6]

    def rate(self, expression: Expr) -> Expr:
        """d/dt of an expression in q, along q'; of the same shape."""
        return directional_derivative(expression, self.q, self.q_dot)

    def second_rate(self, expression: Expr) -> Expr:
        """d/dt of an expression in q and q', along (q', q''); of the same shape.

        The parts by q' and by q'' are formed apart: where the first cancels in itself, it leaves the second intact.
        """
        return self.rate(expression) + directional_derivative(expression, self.q_dot, self.q_ddot)

    def at_present(self, expression: Expr) -> Expr:
        """The expression at the present pose, delta = 0 and xi = 0."""
        return ca.substitute(expression, self.q[:6], ca.SX.zeros(6))


def inertial_acceleration(V: Expr, V_dot: Expr) -> Expr:
    """(delta'', xi'') (6; m/s2, rad/s2) of a carrier with twist V whose components change at V_dot.

    delta' = E(xi) v at any pose, so delta'' is its rate; and xi'' = omega' at xi = 0.
    """
    xi = ca.SX.sym("xi", 3)
    v, omega = ca.SX.sym("v", 3), ca.SX.sym("omega", 3)
    turning = ca.substitute(directional_derivative(turn(xi) @ v, xi, omega), xi, ca.SX.zeros(3))
    rate = ca.Function("turning", [v, omega], [turning])
    return ca.vertcat(V_dot[:3] + rate(V[:3], V[3:]), V_dot[3:])


class MovingBody:
    """One generic body as expressions in the coordinates of a chart; `numbers` is its column.

    A body fixed on the carrier is one whose phi stays 0.
    """

    def __init__(self) -> None:
        self.chart = Chart()
        self.numbers = ca.SX.sym("body", SIZE)
        split = ca.vertsplit(self.numbers, [0, 3, 12, 13, 16, 25])
        self._origin, axes, self.mass, self.center_of_mass, J = split
        self.central_inertia = ca.reshape(J, 3, 3)
        self._turned = turn(self.chart.xi)
        self._axes = ca.reshape(axes, 3, 3) @ elementary(1, self.chart.phi)

    def place(self, point: Expr) -> Expr:
        """x = delta + E(xi) rho (3; m): where a `point` of the body's frame is."""
        return self.chart.delta + self._turned @ (self._origin + self._axes @ point)

    def axes(self) -> Expr:
        """R = E(xi) G(phi) (3x3): the body's axes."""
        return self._turned @ self._axes

    def angular_velocity(self) -> Expr:
        """omega (3; rad/s), on the body's axes: that of the carrier, and phi' about the first axis.

        In R^T R' of the body's own axes R, phi' would come with sine^2 + cosine^2, whose rounding, differentiated, is
        above all else at the highest speeds.
        """
        carrier = angular_velocity(self._turned, self.chart.rate(self._turned))
        return self._axes.T @ carrier + ca.vertcat(self.chart.q_dot[6], 0, 0)

    def twist(self, stream: Expr) -> Expr:
        """Velocity of the body's origin relative to a fluid, and angular velocity, on the body's axes (6)."""
        velocity = self.chart.rate(self.place(ca.SX.zeros(3))) - stream
        return ca.vertcat(self.axes().T @ velocity, self.angular_velocity())

    def energy(self) -> Expr:
        """T = m |x_c'|^2 / 2 + omega^T J_c omega / 2 (J), x_c the place of the mass centre, J_c about it."""
        velocity, omega = self.chart.rate(self.place(self.center_of_mass)), self.angular_velocity()
        return self.mass * ca.sumsqr(velocity) / 2 + ca.dot(omega, self.central_inertia @ omega) / 2


@dataclass(frozen=True)
class Potential:
    """Potential energy of any body under one law of `laws/`.

    count    how many numbers of its own the law has for a body
    numbers  those of a body
    energy   potential energy (J) of a moving body with such numbers in `gravity` (3; m/s2) on the chart's axes
    """

    count: int
    numbers: Callable[[Body], tuple[float, ...]]
    energy: Callable[[MovingBody, Expr, Expr], Expr]


@dataclass(frozen=True)
class BodyEnergy:
    """A law of bodies: by a potential, or without one by the wrench (6; N, N m) of a body in its frame at its V_r (6).

    The wrench is None of a body without the law.
    """

    potential: Potential | None = None
    wrench: Callable[[Body, Expr], Expr | None] = lambda body, V_r: None


def nothing(*arguments: object) -> dict[str, Any]:
    """No inputs of its own."""
    return {}


@dataclass(frozen=True)
class CarrierEnergy:
    """A law between E0 and the carrier.

    force           of a stand and the inputs by name: generalized force (6) on the carrier
    inputs          shapes of inputs of its own; `arguments`: their values at a state, where C is the attitude
    arguments_near  their expressions of a place of O1 and an attitude near C0
    """

    force: Callable[[Stand, dict[str, Expr]], Expr]
    inputs: Callable[[Stand], dict[str, tuple[int, int]]] = nothing
    arguments: Callable[[Stand, State, Array], dict[str, Any]] = nothing
    arguments_near: Callable[[Stand, Array, Expr, Expr], dict[str, Expr]] = nothing


def inertial_force(chart: Chart, T: Expr) -> Expr:
    """d/dt (dT/dq') - dT/dq (7; N, N m, N m) along q', q''."""
    return chart.second_rate(ca.gradient(T, chart.q_dot)) - ca.gradient(T, chart.q)


@cache
def body_kinetics() -> Expr:
    """(body, q', phi) -> T (J), dT/dq' (7), d2T/dq'2 (7x7), m x_c (3; kg m): energy, momenta, mass matrix of a body,
    and its first moment about O1, in E1."""
    body = MovingBody()
    chart, T, moment = body.chart, body.energy(), body.mass * body.place(body.center_of_mass)
    momenta = ca.gradient(T, chart.q_dot)
    results = [chart.at_present(value) for value in (T, momenta, ca.jacobian(momenta, chart.q_dot), moment)]
    return ca.Function("body_kinetics", [body.numbers, chart.q_dot, chart.phi], results)


@cache
def body_inertial_force() -> Expr:
    """(body, q', q'', phi) -> d/dt (dT/dq') - dT/dq (7) of a body."""
    body = MovingBody()
    chart = body.chart
    force = chart.at_present(inertial_force(chart, body.energy()))
    return ca.Function("body_inertial_force", [body.numbers, chart.q_dot, chart.q_ddot, chart.phi], [force])


@cache
def body_twist() -> Expr:
    """(body, q', phi, stream) -> twist (6) of a body relative to the fluid, in its own frame."""
    body, stream = MovingBody(), ca.SX.sym("stream", 3)
    chart = body.chart
    return ca.Function(
        "body_twist", [body.numbers, chart.q_dot, chart.phi, stream], [chart.at_present(body.twist(stream))]
    )


@cache
def body_force(potentials: tuple[Potential, ...]) -> Expr:
    """(body, numbers, phi, gravity, P) -> generalized force (7) of the potentials and of a wrench P of a body.

    -dU/dq of the sum U of the potentials, with the laws' `numbers` of the body, and d/dq' of the power P . V_k that P
    has in the twist V_k of the body (own frame). `gravity` (3; m/s2) is on the chart's axes.
    """
    body = MovingBody()
    chart = body.chart
    gravity, P = ca.SX.sym("gravity", 3), ca.SX.sym("P", 6)
    numbers = ca.SX.sym("numbers", sum(law.count for law in potentials))
    potential, first = ca.SX(0), 0
    for law in potentials:
        potential += law.energy(body, numbers[first : first + law.count], gravity)
        first += law.count
    power = ca.dot(body.twist(ca.SX.zeros(3)), P)
    force = chart.at_present(ca.gradient(power, chart.q_dot) - ca.gradient(potential, chart.q))
    return ca.Function("body_force", [body.numbers, numbers, chart.phi, gravity, P], [force])


@cache
def fluid_motion() -> Expr:
    """(Lambda, stream, V, (delta'', xi'')) -> T (J), dT/dV (6) and d/dt (dT/dq') - dT/dq (6) of the fluid.

    T = V_r^T Lambda V_r / 2, V_r the carrier's twist relative to a fluid of velocity `stream`, in E1. Lambda (6x6) is
    the added mass about O1 in E1; `stream` (3; m/s) is on the chart's axes, which do not turn.
    """
    chart, Lambda, stream = Chart(), ca.SX.sym("Lambda", 6, 6), ca.SX.sym("stream", 3)
    turned = turn(chart.xi)
    relative = turned.T @ (chart.q_dot[:3] - stream)
    V_r = ca.vertcat(relative, angular_velocity(turned, chart.rate(turned)))
    T = ca.dot(V_r, Lambda @ V_r) / 2
    results = [T, ca.gradient(T, chart.q_dot)[:6], inertial_force(chart, T)[:6]]
    arguments = [Lambda, stream, chart.q_dot[:6], chart.q_ddot[:6]]
    return ca.Function("fluid_motion", arguments, [chart.at_present(value) for value in results])
