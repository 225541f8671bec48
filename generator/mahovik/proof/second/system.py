"""The whole system of a stand as one set of Lagrange's equations: its numbers, the sums over its bodies, its answers.

Each answer gives named expressions. A held carrier moves as V = S u, V* = S u*, and its hold does no work in any u, by
the principle of d'Alembert and Lagrange: inertial forces less applied ones are what the hold exerts. A free carrier is
the one with S = E. Evaluated they are a backend of the evaluation contract; their derivatives judge Jacobians.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache, cached_property
from typing import Any, cast

import casadi as ca
import numpy as np

from mahovik.contract.functions import hold_fault, want_fault, wants_of
from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.stand.model import Body, Hold, Stand, State, Vec6
from mahovik.errors import StateError, count_numbers
from mahovik.proof.second import body as one
from mahovik.proof.second.body import (
    Array,
    BodyEnergy,
    CarrierEnergy,
    Chart,
    Expr,
    angular_velocity,
    attitude,
    fixed_rotation,
    inertial_acceleration,
    mounting,
    turn,
)
from mahovik.proof.second.coordinates import free_coordinates, held_coordinates, motion_of_coordinates

Place = tuple[Array, Array]
"""Origin (3; m, from O1) and axes (3x3) in E1; a flywheel's at phi_s = 0."""


def places(stand: Stand) -> dict[str, Place]:
    """Place of the carrier, every instrument, flywheel and point, by name."""
    result: dict[str, Place] = {stand.carrier.name: (np.zeros(3), np.eye(3))}
    for p in stand.instruments:
        result[p.name] = (np.array(p.position), fixed_rotation(p.angles))
    for s in stand.flywheels:
        result[s.name] = place_in_E1(result[s.mount], (np.array(s.position), mounting(s.mounting)))
    for point in stand.points:
        result[point.name] = place_in_E1(result[point.mount], (np.array(point.position), fixed_rotation(point.angles)))
    return result


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
        T, momenta, mass, moments = one.body_kinetics().map(self.count)(self.bodies, self.q_dot, self.phi)
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
        acceleration = inertial_acceleration(self.V, V_dot)
        q_ddot = self._rates(acceleration, phi_ddot)
        forces = one.body_inertial_force().map(self.count)(self.bodies, self.q_dot, q_ddot, self.phi)
        carrier = ca.sum2(forces[:6, :])
        if self.Lambda is not None:
            carrier += one.fluid_motion()(self.Lambda, self.stream, self.V, acceleration)[2]
        return carrier, forces[6, self.fixed :].T

    def applied_force(self) -> tuple[Expr, Expr]:
        """Generalized forces of all wrenches but the drive torques: on the carrier (6), on the flywheels (N)."""
        energies = parts("energy", BodyEnergy, BODY_LAWS)
        potentials = tuple(law.potential for law in energies if law.potential is not None)
        numbers = np.array([[x for law in potentials for x in law.numbers(body)] for body in self.stand.bodies]).T
        gravity = ca.repmat(self.gravity, 1, self.count)
        forces = one.body_force(potentials).map(self.count)(
            self.bodies, ca.DM(numbers), self.phi, gravity, self._wrenches()
        )
        carrier = ca.sum2(forces[:6, :])
        for law in parts("energy", CarrierEnergy):
            carrier += law.force(self.stand, self.inputs)
        return carrier, forces[6, self.fixed :].T

    def _wrenches(self) -> Expr:
        """P (6 x bodies): the run-time wrench and those of laws without a potential, each in its body's frame."""
        stream = ca.repmat(self.stream, 1, self.count)
        twists = one.body_twist().map(self.count)(self.bodies, self.q_dot, self.phi, stream)
        wrenches = ca.horzsplit(self.inputs["wrench"])
        for law in parts("energy", BodyEnergy, BODY_LAWS):
            for k, body in enumerate(self.stand.bodies):
                if (applied := law.wrench(body, twists[:, k])) is not None:
                    wrenches[k] = wrenches[k] + applied
        return ca.horzcat(*wrenches)

    def _rates(self, carrier: Expr, flywheels: Expr) -> Expr:
        """q' or q'' of all bodies (7 x bodies)."""
        return ca.vertcat(ca.repmat(carrier, 1, self.count), self._flywheel_row(flywheels))

    def _flywheel_row(self, values: Expr) -> Expr:
        """One number per body (1 x bodies): those of the flywheels, zero for the bodies that have no phi."""
        return ca.horzcat(ca.MX.zeros(1, self.fixed), values.T)


# -- answers -----------------------------------------------------------------------------------------------------------

Results = dict[str, Expr]

POINT_QUANTITIES = ("position", "C", "twist", "specific_force", "angular_acceleration")


def twists(hold: Hold | None) -> Array:
    """S (6 x m), by motion: the twist of E1 as a freedom leaves the home pose at a rate of one. E without a hold."""
    if hold is None:
        return np.eye(6)
    vectors = [np.zeros((6, 0))]
    for freedom in hold.freedoms:
        if freedom.kind == "twist":
            vectors.append(np.array(freedom.twist)[:, None])
        else:
            vectors.append(
                motion_of_coordinates(replace(hold, freedoms=(freedom,)), ca.DM.eye(3), [0])(0.0, 0.0)[0].full()
            )
    return np.hstack(vectors)


def held_state(S: Array, state: State) -> State:
    """The state with V = S u, V* = S u*. StateError: u or u_dot of another length."""
    for name, rates in (("u", state.u), ("u_dot", state.u_dot)):
        if len(rates) != S.shape[1]:
            raise StateError(f"{name}: expected {count_numbers(S.shape[1])}, found {len(rates)}")
    V, V_dot = (cast(Vec6, tuple((S @ np.array(rates)).tolist())) for rates in (state.u, state.u_dot))
    return replace(state, V=V, V_dot=V_dot)


def momentum(system: System) -> Results:
    """Z (6), Z0 (6, in E0 about its origin), energy (J), center_of_mass (3; m, of all bodies, in E1) and its velocity
    (3; m/s, in E0)."""
    T, Z, _, _, center, velocity = system.kinetics()
    return {
        "Z": Z,
        "Z0": momentum_in_E0(system.inputs["position"], system.inputs["C"], Z),
        "energy": T,
        "center_of_mass": center,
        "center_of_mass_velocity": system.inputs["C"] @ velocity,
    }


def momentum_in_E0(position: Expr, C: Expr, Z: Expr) -> Expr:
    """Z0 (6): what Z is worth in the motions of the carrier with E0 as one rigid body, turning about its origin."""
    motion, shapes = ca.SX.sym("motion", 6), ((3, 1), (3, 3), (6, 1))
    r, axes, screw = (ca.SX.sym(name, *shape) for name, shape in zip(("r", "C", "Z"), shapes, strict=True))
    V = ca.vertcat(axes.T @ (motion[:3] + ca.cross(motion[3:], r)), axes.T @ motion[3:])
    worth = ca.gradient(ca.dot(screw, V), motion)
    return ca.Function("momentum_in_E0", [r, axes, screw], [worth])(position, C, Z)


def forward(system: System) -> Results:
    """V_dot (6) for given phi_ddot: Lagrange's equations of the carrier; u_dot (m) and reaction of a held one."""
    phi_ddot = system.inputs["phi_ddot"]
    S, (_, _, K, *_) = system.S, system.kinetics()
    applied, _ = system.applied_force()
    inertial, _ = system.inertial_force(ca.MX.zeros(6), phi_ddot)
    return _motion(system, _solve(S.T @ K @ S, S.T @ (applied - inertial)), phi_ddot)


def coupled(system: System, locked: Sequence[bool] = ()) -> Results:
    """What `forward` gives, and phi_ddot (N), for given tau: all equations together.

    `locked` (N, none by default): flywheels for whose equation stands phi_ddot = 0, as their torques are reactions.
    """
    S, (_, _, K, columns, *_) = system.S, system.kinetics()
    m = S.shape[1]
    applied, on_flywheels = system.applied_force()
    still, still_flywheels = system.inertial_force(ca.MX.zeros(6), ca.MX.zeros(system.N))
    drive = on_flywheels + system.inputs["tau"] - still_flywheels
    coupling = S.T @ columns[:6, :]
    full = ca.vertcat(ca.horzcat(S.T @ K @ S, coupling), ca.horzcat(coupling.T, ca.diag(columns[6, :])))
    stopped = ca.DM([0] * m + [int(x) for x in locked or [False] * system.N])
    free = ca.diag(1 - stopped)
    unknown = _solve(free @ full @ free + ca.diag(stopped), free @ ca.vertcat(S.T @ (applied - still), drive))
    phi_ddot = unknown[m:, 0]
    return {**_motion(system, unknown[:m, 0], phi_ddot), "phi_ddot": phi_ddot}


def torque(system: System) -> Results:
    """tau (N) for given V_dot, phi_ddot: Lagrange's equations of the flywheels."""
    _, applied = system.applied_force()
    _, inertial = system.inertial_force(system.inputs["V_dot"], system.inputs["phi_ddot"])
    return {"tau": inertial - applied}


def reaction(system: System) -> Results:
    """reaction (6; N, N m, in E1 about O1) for given V_dot, phi_ddot."""
    return {"reaction": _reaction(system, system.inputs["V_dot"], system.inputs["phi_ddot"])}


def _reaction(system: System, V_dot: Expr, phi_ddot: Expr) -> Expr:
    return system.inertial_force(V_dot, phi_ddot)[0] - system.applied_force()[0]


def _motion(system: System, u_dot: Expr, phi_ddot: Expr) -> Results:
    """What a carrier answers that moves at u_dot (m) in its freedoms."""
    if system.stand.hold is None:
        return {"V_dot": u_dot}
    V_dot = system.S @ u_dot
    return {"u_dot": u_dot, "V_dot": V_dot, "reaction": _reaction(system, V_dot, phi_ddot)}


def _solve(matrix: Expr, right: Expr) -> Expr:
    """The solution of equations with a symmetric definite matrix, scaled to a unit diagonal.

    By L D L^T: Gram-Schmidt, of "symbolicqr", loses the square of the condition, which a basis of nearly the same rows
    has, and Householder reflections, of "qr", divide by squares that underflow.
    """
    if not matrix.shape[0]:
        return right
    scale = 1 / ca.sqrt(ca.diag(matrix))
    scaled = ca.diag(scale) @ matrix @ ca.diag(scale)
    return scale * ca.solve(ca.densify(scaled), scale * right, "ldl")


def point_names(stand: Stand) -> tuple[str, ...]:
    """Instruments, then points."""
    return (*(p.name for p in stand.instruments), *(p.name for p in stand.points))


@cache
def _point_quantities() -> Expr:
    """(origin, axes, place, C, gravity, V, (delta'', xi'')) -> POINT_QUANTITIES of a point fixed on the carrier.

    `origin` (3; m) and `axes` (3x3) in E1; `place` (3; m) of O1 and C are the pose; `gravity` (3; m/s2) in E0. On the
    point's own axes: twist (6) relative to E0, specific force (3; m/s2) and angular acceleration (3; rad/s2).
    """
    chart = Chart()
    origin, fixed, place, gravity = (ca.SX.sym(name, 3, n) for name, n in zip("ofpg", (1, 3, 1, 1), strict=True))
    C = ca.SX.sym("C", 3, 3)
    turned = turn(chart.xi)
    position, axes = place + C @ (chart.delta + turned @ origin), C @ turned @ fixed
    velocity = chart.rate(position)
    # of the carrier, then turned: the terms quadratic in omega cancel to the last bit on axes that coincide with E1
    omega = fixed.T @ angular_velocity(turned, chart.rate(turned))
    specific_force = axes.T @ (chart.second_rate(velocity) - gravity)
    results = [position, axes, ca.vertcat(axes.T @ velocity, omega), specific_force, chart.second_rate(omega)]
    arguments = [origin, fixed, place, C, gravity, chart.q_dot[:6], chart.q_ddot[:6]]
    return ca.Function("measured", arguments, [chart.at_present(value) for value in results])


def points(system: System) -> Results:
    """POINT_QUANTITIES of every instrument and point, side by side in the order of `point_names`; needs V_dot."""
    stand, inputs = system.stand, system.inputs
    at = [places(stand)[name] for name in point_names(stand)]
    acceleration = inertial_acceleration(system.V, inputs["V_dot"])
    common = (inputs["position"], inputs["C"], ca.DM(stand.gravity), system.V, acceleration)
    values = _point_quantities().map(len(at))(
        np.column_stack([origin for origin, _ in at]),
        np.hstack([axes for _, axes in at]),
        *(ca.repmat(value, 1, len(at)) for value in common),
    )
    return dict(zip(POINT_QUANTITIES, values, strict=True))


# -- evaluation --------------------------------------------------------------------------------------------------------

PROBLEMS: dict[str, Callable[[System], dict[str, Expr]]] = {
    "momentum": momentum,
    "forward": forward,
    "torque": torque,
    "coupled": coupled,
    "points": points,
    "reaction": reaction,
}
"""Wants that are CasADi functions of the state."""

WANTS = wants_of("second")
"""Wants of the second derivation: those of PROBLEMS, and `generalized`."""

Values = dict[str, Any]


class Second:
    """The second derivation of one stand. CasADi functions are built where they are first asked for, and kept."""

    name = "casadi"

    def __init__(self, stand: Stand) -> None:
        self.stand = stand
        self._functions: dict[str, Expr] = {}
        self._last: tuple[State, dict[str, Any]] | None = None

    @cached_property
    def system(self) -> System:
        """The stand's equations as expressions."""
        return System(self.stand, twists(self.stand.hold))

    def function(self, want: str) -> Expr:
        """The CasADi function of a want of PROBLEMS.

        Inputs by the names of `System.inputs`; results by theirs after the want's: `forward_V_dot`, `points_C`.
        """
        if want not in self._functions:
            results = {f"{want}_{name}": value for name, value in PROBLEMS[want](self.system).items()}
            self._functions[want] = self.as_function(want, results)
        return self._functions[want]

    def as_function(self, name: str, results: dict[str, Expr]) -> Expr:
        """Expressions in the system's inputs as a CasADi function of all of them."""
        inputs = self.system.inputs
        return ca.Function(name, list(inputs.values()), list(results.values()), list(inputs), list(results))

    def evaluate(self, state: State, want: Sequence[str]) -> Values:
        """What `want` names, under the names of the contract: arrays in SI, V and V_dot relative to E0, in E1.

        Raises StateError for wants that are unknown, not there or contradict each other, a state that does not fit the
        want, one where a law is undefined, what CasADi refuses, and results that are not finite.
        """
        for name in want:
            if name not in WANTS:
                raise StateError(f"want: the second derivation (casadi) has no {name!r}; it has " + ", ".join(WANTS))
        if fault := want_fault(want) or hold_fault(want, self.stand.hold is not None):
            raise StateError(fault)
        if state.task:
            raise StateError("task: the second derivation has no tasks, ask the backends c or numpy")
        asked = state
        if self.stand.hold is not None:
            state = held_state(self.system.S, state)
        check_depth(self.stand, state)
        with np.errstate(all="ignore"):  # what is not finite is found below
            if self._last is None or self._last[0] is not asked:
                self._last = asked, self.arguments(state)
            inputs, values = self._last[1], Values()
            for name in want:
                try:
                    values |= self._generalized(state, inputs) if name == "generalized" else self._solve(name, inputs)
                except RuntimeError as error:  # as CasADi raises them
                    raise StateError(f"{name}: {' '.join(str(error).split())[:200]}") from None
        return _finite_only(values)

    def arguments(self, state: State) -> dict[str, Any]:
        """Arguments of the functions at a state, by name: those of `System.inputs`. Raises StateError."""
        stand = self.stand
        C = attitude(stand.angles, state)
        of_laws: dict[str, Any] = {}
        for law in parts("energy", CarrierEnergy):
            of_laws |= law.arguments(stand, state, C)
        names = ("position", "V", "V_dot", "phi", "phi_dot", "phi_ddot", "tau")
        return {
            **{name: np.array(getattr(state, name), dtype=np.float64) for name in names},
            "C": C,
            "wrench": np.column_stack([state.wrench.get(body.name, np.zeros(6)) for body in stand.bodies]),
            **of_laws,
        }

    def _solve(self, want: str, inputs: dict[str, Any]) -> Values:
        if want == "points" and not point_names(self.stand):
            return {"points": {}}
        if want == "momentum" and not any(body.mass for body in self.stand.bodies):
            raise StateError("momentum: no body of the stand has a mass, so there is no center_of_mass")
        answer = self.function(want)(**inputs)
        values = {name.removeprefix(f"{want}_"): value.full() for name, value in answer.items()}
        if want == "points":
            names = point_names(self.stand)
            split = {name: np.split(value, len(names), axis=1) for name, value in values.items()}
            numbers = {name: [x if name == "C" else x[:, 0] for x in split[name]] for name in POINT_QUANTITIES}
            return {"points": {point: {name: numbers[name][k] for name in numbers} for k, point in enumerate(names)}}
        return {name: float(value[0, 0]) if name == "energy" else value[:, 0] for name, value in values.items()}

    def _generalized(self, state: State, inputs: dict[str, Any]) -> Values:
        hold, sequence = self.stand.hold, self.stand.angles
        if hold is None and state.quaternion is not None:
            raise StateError("quaternion: `generalized` needs `angles`")
        V_dot = self._solve("forward", inputs)["V_dot"]
        if hold is not None:
            return held_coordinates(hold, sequence, state.position, inputs["C"], state.V, V_dot)
        try:
            return free_coordinates(sequence, state.angles or (0.0, 0.0, 0.0), inputs["V"], V_dot)
        except np.linalg.LinAlgError as error:
            raise StateError(f"generalized: {error}") from None


class Derivatives:
    """Jacobians of what a want gives by inputs of a state, at fixed position and attitude.

    `locked` (N): flywheels held at phi_ddot = 0, of `coupled` only.
    """

    def __init__(self, second: Second, want: str, by: Sequence[str], locked: Sequence[bool] = ()) -> None:
        self._second, system = second, second.system
        answer = coupled(system, locked) if want == "coupled" else PROBLEMS[want](system)
        rate = "V_dot" if system.stand.hold is None else "u_dot"
        slopes = {f"{v}_{name}": self._slope(answer[v], name) for v in (rate, "phi_ddot") if v in answer for name in by}
        self._function = second.as_function("derivatives", slopes)

    def _slope(self, value: Expr, name: str) -> Expr:
        """Derivative of a value by an input, or by `u` of a held carrier, V = S u."""
        system = self._second.system
        return ca.jacobian(value, system.V) @ system.S if name == "u" else ca.jacobian(value, system.inputs[name])

    def evaluate(self, state: State) -> dict[str, Array]:
        """Matrices by name: `V_dot_phi` is that of V_dot by phi. Raises StateError."""
        slopes = self._function(**self._second.arguments(state))
        return _finite_only({name: matrix.full() for name, matrix in slopes.items()})


def _finite_only(values: Values) -> Values:
    for name, value in values.items():
        numbers = [x for of_point in value.values() for x in of_point.values()] if isinstance(value, dict) else [value]
        if not all(np.isfinite(x).all() for x in numbers):
            raise StateError(f"{name}: not finite at this state")
    return values
