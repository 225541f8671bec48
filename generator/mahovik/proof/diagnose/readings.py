"""Wrong readings and conventions: one-line changes of the stand, a state or an answer, and the programs they make.

A row says what a program does, and what the right equations must be asked to do the same.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Literal, TypeVar

import numpy as np

from mahovik.core.stand.model import Body, Carrier, Flywheel, Instrument, MountingAngles, MountingAxes, Stand
from mahovik.core.stand.state import State
from mahovik.proof import reference
from mahovik.proof.diagnose.answers import Model, Reference
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import inertia_about_origin, mount_transfer
from mahovik.proof.reference.rotation import C1, C2, C3, carrier_rotation, flywheel_mounting
from mahovik.proof.verify.actuators import stand_at
from mahovik.proof.verify.held import freedom_rates, quaternion_of

Scope = Literal["", "bodies", "fixed", "flywheels", "phases"]
"""What a reading is of: the whole, all bodies or each, carrier and instruments, flywheels, states of flywheels."""

Data = TypeVar("Data")

E, OFF = np.eye(3), 1.0 - np.eye(3)
DEGREE, RPM = math.pi / 180.0, math.pi / 30.0


@dataclass(frozen=True)
class Reading:
    """One wrong reading.

    name    what the program does
    scope   which bodies it may be of, all of them or one
    change  of stand and state that it is the right answer to; of a body, of a State and the index of a flywheel
    answer  of the values of a want, given the right ones, stand and state
    """

    name: str
    scope: Scope = ""
    change: Callable[..., Any] | None = None
    answer: Callable[[dict[str, Any], Stand, State], Mapping[str, Any]] | None = None
    only: str = ""

    def of_parts(self, stand: Stand) -> list[Reading]:
        """This reading of all that it may be of, and then of each."""
        names = [each.name for each in _in_scope(self.scope, stand)]
        if not self.scope or not names:
            return [self] if not self.scope else []
        return [self, *(replace(self, only=name) for name in names if len(names) > 1)]

    @property
    def words(self) -> str:
        """The name, with the body that it is of alone."""
        return f"{self.name} ({self.only} alone)" if self.only else self.name

    def model(self, stand: Stand) -> Model:
        """The right equations with this reading."""
        names = {self.only} if self.only else {each.name for each in _in_scope(self.scope, stand)}
        if self.scope in ("bodies", "fixed", "flywheels") and self.change is not None:
            return Reference(_with_bodies(stand, self.change, names))
        right = Reference(stand)

        def answer(given: State, want: str) -> Mapping[str, Any]:
            own, state = stand_at(stand, given), given
            if self.scope == "phases":
                for k, wheel in enumerate(stand.flywheels):
                    if wheel.name in names and self.change is not None:
                        state = self.change(own, state, k)
                return right(state, want)
            if self.change is not None:
                own, state = self.change(own, given)
            values = right(given, want) if self.change is None else Reference(own)(_on_hold(stand, given, state), want)
            return values if self.answer is None or not values else self.answer(dict(values), own, state)

        return answer


def replace(data: Data, **values: Any) -> Data:
    """A copy with other values, which are not typed: rows name the fields that they change."""
    return dataclasses.replace(data, **values)  # type: ignore[type-var]


def _in_scope(scope: Scope, stand: Stand) -> Sequence[Body]:
    fixed = (stand.carrier, *stand.instruments)
    return {"": (), "bodies": stand.bodies, "fixed": fixed, "flywheels": stand.flywheels, "phases": stand.flywheels}[
        scope
    ]


def _with_bodies(stand: Stand, change: Callable[[Any], Any], names: set[str]) -> Stand:
    def changed(body: Any) -> Any:
        return change(body) if body.name in names else body

    instruments, flywheels = map(changed, stand.instruments), map(changed, stand.flywheels)
    return replace(stand, carrier=changed(stand.carrier), instruments=tuple(instruments), flywheels=tuple(flywheels))


def _on_hold(stand: Stand, given: State, state: State) -> State:
    """The state with speeds of the freedoms of a held carrier by its changed V."""
    if stand.hold is None or state.V == given.V:
        return state
    return replace(state, u=tuple(freedom_rates(stand.hold, np.array(state.V)).tolist()))


# -- what rows are made of -------------------------------------------------------------------------------------------


def of_stand(name: str, change: Callable[[Stand, State], Stand]) -> Reading:
    """Another stand, which may depend on the state."""
    return Reading(name, change=lambda stand, state: (change(stand, state), state))


def of_state(name: str, change: Callable[[Stand, State], State]) -> Reading:
    """Another state."""
    return Reading(name, change=lambda stand, state: (stand, change(stand, state)))


def of_quaternion(name: str, change: Callable[..., tuple[float, ...]]) -> Reading:
    """Another quaternion, where the state has one."""
    return of_state(name, lambda _, s: s if s.quaternion is None else replace(s, quaternion=change(*s.quaternion)))


def of_attitude(name: str, change: Callable[[Array], Array]) -> Reading:
    """Another attitude C (3x3), however the state gives it."""
    return of_state(
        name,
        lambda stand, s: replace(s, angles=None, quaternion=quaternion_of(change(carrier_rotation(stand, s)))),
    )


def of_angles(name: str, change: Callable[..., tuple[float, ...]]) -> Reading:
    """Other attitude angles, where the state has them."""
    return of_state(name, lambda _, s: s if s.angles is None else replace(s, angles=change(*s.angles)))


def of_twist(
    name: str, change: Callable[[Array, Array, Stand, State], Array], keys: tuple[str, ...] = ("V",)
) -> Reading:
    """Another V (6), by V, C (3x3), stand and state; `keys`: also another V_dot."""

    def changed(stand: Stand, s: State) -> State:
        C = carrier_rotation(stand, s)
        found = {key: tuple(change(np.array(getattr(s, key)), C, stand, s).tolist()) for key in keys}
        return replace(s, **found)

    return of_state(name, changed)


def of_vector(name: str, key: str, change: Callable[[Array, Array], Array]) -> Reading:
    """Another gravity or stream in E0 (3), by itself and C (3x3)."""

    def changed(stand: Stand, s: State) -> Stand:
        given = getattr(stand, key)
        C = carrier_rotation(stand, s)
        return stand if given is None else replace(stand, **{key: tuple(change(np.array(given), C).tolist())})

    return of_stand(name, changed)


def of_phase(name: str, **changes: Callable[[float], float]) -> Reading:
    """Other numbers of a flywheel in the state: phi, phi_dot, phi_ddot, tau."""

    def changed(_: Stand, s: State, k: int) -> State:
        return replace(s, **{key: _with_item(getattr(s, key), k, change) for key, change in changes.items()})

    return Reading(name, "phases", changed)


def of_tensor(name: str, scope: Scope, change: Callable[[Array, Body], Array]) -> Reading:
    """Another inertia (3x3) in the stand."""
    return Reading(
        name, scope, lambda k: replace(k, inertia=tuple(map(tuple, change(np.array(k.inertia), k).tolist())))
    )


def of_law(name: str, key: str, change: Callable[[Array], Array]) -> Reading:
    """Another 6x6 of added mass, or of any law of a body or between E0 and the carrier, by its name there."""

    def changed(bearer: Any) -> Any:
        laws = tuple(_with_matrix(law, key, change) for law in bearer.laws)
        return _with_matrix(replace(bearer, laws=laws), key, change)

    def everywhere(stand: Stand, _: State) -> Stand:
        return _with_bodies(changed(stand), changed, {each.name for each in stand.bodies})

    return of_stand(name, everywhere)


def of_wrench(name: str, change: Callable[[Array, str, Stand, State], Array]) -> Reading:
    """Other run-time wrenches (6), by wrench, body, stand and state."""

    def changed(stand: Stand, s: State) -> State:
        found = {k: tuple(change(np.array(P), k, stand, s).tolist()) for k, P in s.wrench.items()}
        return replace(s, wrench=MappingProxyType(found))

    return of_state(name, changed)


def of_answer(name: str, key: str, change: Callable[[Any, dict[str, Any], Stand, State], Any]) -> Reading:
    """Another quantity in an answer, by itself, all values, stand and state."""
    return Reading(
        name,
        answer=lambda values, stand, s: (
            {**values, key: change(values[key], values, stand, s)} if key in values else values
        ),
    )


def of_points(name: str, change: Callable[[dict[str, Any], Stand, State], Mapping[str, Any]]) -> Reading:
    """Other numbers of every point."""
    return of_answer(
        name, "points", lambda points, _, stand, s: {k: {**p, **change(p, stand, s)} for k, p in points.items()}
    )


def _with_item(values: tuple[float, ...], k: int, change: Callable[[float], float]) -> tuple[float, ...]:
    return (*values[:k], float(change(values[k])), *values[k + 1 :])


def _with_matrix(bearer: Any, key: str, change: Callable[[Array], Array]) -> Any:
    given = getattr(bearer, key, None)
    return bearer if given is None else replace(bearer, **{key: tuple(map(tuple, change(np.array(given)).tolist()))})


def rotate(V: Array, C: Array) -> Array:
    """diag(C, C) V (6)."""
    return np.concatenate([C @ V[:3], C @ V[3:]])


def linear(V: Array, C: Array) -> Array:
    """diag(C, E) V (6)."""
    return np.concatenate([C @ V[:3], V[3:]])


def angular(V: Array, factor: Any) -> Array:
    """V (6) with another angular part: a factor or a matrix (3x3) of it."""
    return np.concatenate([V[:3], factor @ V[3:] if isinstance(factor, np.ndarray) else factor * V[3:]])


def at_point(V: Array, point: Sequence[float] | Array) -> Array:
    """The twist (6) of O1 of a V whose linear part is of a point of E1 (3)."""
    return np.concatenate([V[:3] - np.cross(V[3:], point), V[3:]])


def moment_of(P: Array, point: Sequence[float] | Array) -> Array:
    """The wrench (6) whose force acts at a point (3)."""
    return np.concatenate([P[:3], P[3:] + np.cross(point, P[:3])])


def exchanged(M: Array) -> Array:
    """A 6x6 with angular parts first."""
    return np.roll(M, (3, 3), (0, 1))


def center_of_all(stand: Stand, state: State) -> Array:
    """Centre of mass of all bodies in E1 (3, m)."""
    K = reference.pieces(stand, state).K_bodies
    return np.asarray(np.array([K[5, 1], -K[5, 0], K[4, 0]]) / K[0, 0])


def body_at(stand: Stand, name: str) -> Body:
    """A body by its name."""
    found: Body = next(each for each in stand.bodies if each.name == name)
    return found


def axis_of(stand: Stand, k: int) -> Array:
    """Spin axis of a flywheel in E1 (3)."""
    wheel = stand.flywheels[k]
    return np.asarray(mount_transfer(stand, wheel.mount)[:3, :3] @ flywheel_mounting(wheel)[:, 0])


def with_absolute(key: str, rate: str, sign: float) -> Reading:
    """Speed or acceleration of a flywheel that counts the turning of its mount too, or misses it."""

    def changed(stand: Stand, s: State, k: int) -> State:
        own = float(axis_of(stand, k) @ np.array(getattr(s, rate)[3:]))
        return replace(s, **{key: _with_item(getattr(s, key), k, lambda x: x + sign * own)})

    what = "speed" if key == "phi_dot" else "acceleration"
    words = "is taken as absolute, not relative to its mount" if sign < 0 else "counts the turning of its mount twice"
    return Reading(f"{what} of a flywheel {words}", "phases", changed)


def mounted(name: str, change: Callable[[Array, Flywheel], Array]) -> Reading:
    """Another rotation (3x3) of flywheels in their mount, at phase zero."""

    def changed(wheel: Flywheel) -> Flywheel:
        C = change(flywheel_mounting(wheel), wheel)
        return replace(wheel, mounting=MountingAxes(tuple(C[:, 0].tolist()), tuple(C[:, 1].tolist())))

    return Reading(name, "flywheels", changed)


def mounting_angles(name: str, change: Callable[[MountingAngles], MountingAngles]) -> Reading:
    """Other mounting angles of flywheels, where the file gives these."""
    return Reading(
        name, "flywheels",
        lambda k: replace(k, mounting=change(k.mounting)) if isinstance(k.mounting, MountingAngles) else k,
    )  # fmt: skip


def placed(name: str, change: Callable[[Array, Any], Array]) -> Reading:
    """Another place of instruments and flywheels in their mount (3, m)."""
    return Reading(
        name, "bodies",
        lambda k: k if isinstance(k, Carrier) else replace(k, position=tuple(change(np.array(k.position), k).tolist())),
    )  # fmt: skip


def centered(name: str, scope: Scope, change: Callable[[Array, Any], Array], keep: bool = False) -> Reading:
    """Another centre of mass (3, m); `keep`: with the same inertia about the origin."""

    def changed(k: Any) -> Any:
        kept = (
            {"inertia": tuple(map(tuple, inertia_about_origin(k).tolist())), "inertia_about": "origin"} if keep else {}
        )
        return replace(k, center_of_mass=tuple(change(np.array(k.center_of_mass), k).tolist()), **kept)

    return Reading(name, scope, changed)


def buoyancy_of(body: Any) -> Any:
    """The data of the buoyancy of a body; None without."""
    return next((law for law in body.laws if hasattr(law, "displaced_mass")), None)


def buoyancy_of_body(stand: Stand, s: State) -> tuple[Stand, State]:
    """Buoyancy as wrenches that keep the direction that they have where the attitude is zero."""
    wrenches = dict(s.wrench)
    for body in (stand.carrier, *stand.instruments):
        if (law := buoyancy_of(body)) is not None:
            force = moment_of(np.concatenate([-law.displaced_mass * np.array(stand.gravity), np.zeros(3)]), law.center)
            wrenches[body.name] = tuple((np.array(wrenches.get(body.name, np.zeros(6))) + force).tolist())
    without = of_buoyancy("", lambda law, k: replace(law, displaced_mass=0.0)).change
    assert without is not None
    names = {each.name for each in (stand.carrier, *stand.instruments)}
    return _with_bodies(stand, without, names), replace(s, wrench=MappingProxyType(wrenches))


def of_buoyancy(name: str, change: Callable[[Any, Body], Any]) -> Reading:
    """Another buoyancy of a body that has one."""

    def changed(k: Any) -> Any:
        law = buoyancy_of(k)
        return k if law is None else k.with_laws(change(law, k))

    return Reading(name, "bodies", changed)


def rotated_inertia(J: Array, k: Body) -> Array:
    """Inertia of an instrument that was given in axes of E1, in its own."""
    C = C3(k.angles[0]) @ C2(k.angles[1]) @ C1(k.angles[2]) if isinstance(k, Instrument) else E
    return C.T @ J @ C


def parallel(J: Array, k: Body, share: float) -> Array:
    """J with a share more of the parallel axis term, where it is about the centre of mass."""
    rc = np.array(k.center_of_mass)
    term = k.mass * (rc @ rc * E - np.outer(rc, rc))
    return J if k.inertia_about == "origin" else J + share * term


def reaction_at(R: Array, _: dict[str, Any], stand: Stand, s: State) -> Array:
    """A reaction (6) about the pivot."""
    pivot = np.zeros(3) if stand.hold is None else np.array(stand.hold.pivot)
    return moment_of(R, -pivot)


def acceleration(V_dot: Array, _: dict[str, Any], stand: Stand, s: State) -> Array:
    """V* (6) with omega x v added: the acceleration of O1."""
    return np.asarray(V_dot + np.concatenate([np.cross(s.V[3:], s.V[:3]), np.zeros(3)]))


def turning_wrenches(P: Array, _: dict[str, Any], stand: Stand, s: State) -> Array:
    """Wrenches of mounts (N, 6) in the axes of Es, which turn."""
    return np.array([rotate(each, C1(phi).T) for each, phi in zip(np.asarray(P), s.phi, strict=True)]).reshape(-1, 6)


READINGS: tuple[Reading, ...] = (
    # attitude
    of_quaternion("quaternion read with the scalar last", lambda w, x, y, z: (z, w, x, y)),
    of_quaternion("quaternion read with the vector part first and moved by one", lambda w, x, y, z: (x, y, z, w)),
    of_quaternion("quaternion conjugated", lambda w, x, y, z: (w, -x, -y, -z)),
    of_quaternion("quaternion read with the scalar last, and conjugated", lambda w, x, y, z: (z, -w, -x, -y)),
    of_attitude("attitude transposed: from E0 to E1", lambda C: C.T),
    of_attitude("attitude ignored", lambda C: E),
    of_angles("attitude angles in degrees", lambda a, b, c: (a * DEGREE, b * DEGREE, c * DEGREE)),
    of_angles("attitude angles in reverse order", lambda a, b, c: (c, b, a)),
    of_angles("attitude angles with the opposite sign", lambda a, b, c: (-a, -b, -c)),
    of_stand("attitude angles in the ship sequence", lambda stand, _: replace(stand, angles="ship")),
    of_stand("attitude angles in the aircraft sequence", lambda stand, _: replace(stand, angles="aircraft")),
    of_stand("attitude angles in Euler's sequence", lambda stand, _: replace(stand, angles="euler")),
    of_state("position ignored", lambda _, s: replace(s, position=(0.0, 0.0, 0.0))),
    # twist of the carrier
    of_twist("V read with the angular part first", lambda V, *_: np.roll(V, 3)),
    of_twist("V and V_dot read with the angular part first", lambda V, *_: np.roll(V, 3), ("V", "V_dot")),
    of_twist("V taken in the axes of E0", lambda V, C, *_: rotate(V, C.T)),
    of_twist("V turned into E1 though it is given there", lambda V, C, *_: rotate(V, C)),
    of_twist("v taken in the axes of E0, omega in E1", lambda V, C, *_: linear(V, C.T)),
    of_twist("omega taken in the axes of E0, v in E1", lambda V, C, *_: angular(V, C.T)),
    of_twist("omega in degrees a second", lambda V, *_: angular(V, DEGREE)),
    of_twist("omega of the opposite sense", lambda V, *_: angular(V, -1.0)),
    of_twist("v taken at the carrier's centre of mass", lambda V, C, st, s: at_point(V, st.carrier.center_of_mass)),
    of_twist("v taken at the centre of mass of all bodies", lambda V, C, st, s: at_point(V, center_of_all(st, s))),
    of_twist("V taken relative to the fluid",
             lambda V, C, st, s: V + np.concatenate([C.T @ np.array(st.stream or (0.0,) * 3), np.zeros(3)])),
    of_twist("V_dot read as the acceleration of O1",
             lambda A, C, st, s: A - np.concatenate([np.cross(s.V[3:], s.V[:3]), np.zeros(3)]), ("V_dot",)),
    of_twist("V_dot taken in the axes of E0", lambda A, C, *_: rotate(A, C.T), ("V_dot",)),
    # flywheels in the state
    of_phase("phase of the opposite sense", phi=lambda x: -x),
    of_phase("phase, speed, acceleration and torque of the opposite sense", phi=lambda x: -x, phi_dot=lambda x: -x,
             phi_ddot=lambda x: -x, tau=lambda x: -x),
    of_phase("speed of a flywheel of the opposite sense", phi_dot=lambda x: -x),
    of_phase("acceleration of a flywheel of the opposite sense", phi_ddot=lambda x: -x),
    of_phase("drive torque taken as that on the mount", tau=lambda x: -x),
    of_phase("phase in degrees", phi=lambda x: DEGREE * x),
    of_phase("speed of a flywheel in degrees a second", phi_dot=lambda x: DEGREE * x),
    of_phase("speed of a flywheel in revolutions a minute", phi_dot=lambda x: RPM * x),
    of_phase("speed of a flywheel turned into revolutions a minute", phi_dot=lambda x: x / RPM),
    of_phase("phase counted from the third axis", phi=lambda x: x - math.pi / 2),
    of_phase("phase a quarter turn ahead", phi=lambda x: x + math.pi / 2),
    of_phase("phase half a turn off", phi=lambda x: x + math.pi),
    of_phase("phase ignored", phi=lambda x: 0.0),
    of_phase("speed of a flywheel ignored", phi_dot=lambda x: 0.0),
    of_phase("acceleration of a flywheel ignored", phi_ddot=lambda x: 0.0),
    with_absolute("phi_dot", "V", -1.0),
    with_absolute("phi_dot", "V", 1.0),
    with_absolute("phi_ddot", "V_dot", -1.0),
    of_state("flywheels in reverse order", lambda _, s: replace(
        s, phi=s.phi[::-1], phi_dot=s.phi_dot[::-1], phi_ddot=s.phi_ddot[::-1], tau=s.tau[::-1])),
    # run-time wrenches
    of_wrench("run-time wrenches ignored", lambda P, *_: 0.0 * P),
    of_wrench("run-time wrenches of the opposite sign", lambda P, *_: -P),
    of_wrench("run-time wrenches read with the moment first", lambda P, *_: np.roll(P, 3)),
    of_wrench("run-time wrenches taken in the axes of E0", lambda P, k, st, s: rotate(P, carrier_rotation(st, s).T)),
    of_wrench("force of a run-time wrench acting at the centre of mass",
              lambda P, k, st, s: moment_of(P, body_at(st, k).center_of_mass)),
    of_wrench("run-time wrench of a flywheel not turning with it", lambda P, k, st, s: next(
        (rotate(P, C1(phi).T) for wheel, phi in zip(st.flywheels, s.phi, strict=True) if wheel.name == k), P)),
    # gravity, stream, buoyancy
    of_vector("gravity of the opposite sign", "gravity", lambda g, C: -g),
    of_vector("gravity ignored", "gravity", lambda g, C: 0.0 * g),
    of_vector("gravity not turned into the axes of E1", "gravity", lambda g, C: C @ g),
    of_vector("gravity turned by C in place of its transpose", "gravity", lambda g, C: C @ C @ g),
    of_vector("stream of the opposite sign", "stream", lambda u, C: -u),
    of_vector("stream ignored", "stream", lambda u, C: 0.0 * u),
    of_vector("stream not turned into the axes of E1", "stream", lambda u, C: C @ u),
    Reading("buoyancy that does not turn into the axes of the body", change=buoyancy_of_body),
    of_buoyancy("buoyancy of the opposite sign", lambda law, k: replace(law, displaced_mass=-law.displaced_mass)),
    of_buoyancy("buoyancy ignored", lambda law, k: replace(law, displaced_mass=0.0)),
    of_buoyancy("buoyancy acting at the centre of mass", lambda law, k: replace(law, center=k.center_of_mass)),
    of_buoyancy("buoyancy acting at the origin of the body", lambda law, k: replace(law, center=(0.0, 0.0, 0.0))),
    # inertia
    of_tensor("products of inertia of the opposite sign", "bodies", lambda J, k: J * (E - OFF)),
    of_tensor("products of inertia of flywheels of the opposite sign", "flywheels", lambda J, k: J * (E - OFF)),
    of_tensor("products of inertia of carrier and instruments of the opposite sign", "fixed",
              lambda J, k: J * (E - OFF)),
    of_tensor("products of inertia ignored", "bodies", lambda J, k: J * E),
    Reading("inertia taken about the origin though it is about the centre of mass", "bodies",
            lambda k: replace(k, inertia_about="origin")),
    Reading("inertia taken about the centre of mass though it is about the origin", "bodies",
            lambda k: replace(k, inertia_about="center_of_mass")),
    of_tensor("parallel axis term twice", "bodies", lambda J, k: parallel(J, k, 1.0)),
    of_tensor("parallel axis term of the opposite sign", "bodies", lambda J, k: parallel(J, k, -2.0)),
    of_tensor("inertia of an instrument taken in the axes of E1", "fixed", rotated_inertia),
    of_tensor("transverse moments of inertia exchanged", "flywheels",
              lambda J, k: J - (J[1, 1] - J[2, 2]) * np.diag([0.0, 1.0, -1.0])),
    of_tensor("third axis taken as the spin axis", "flywheels", lambda J, k: np.roll(J, (1, 1), (0, 1))),
    of_tensor("inertia in g cm^2", "bodies", lambda J, k: 1e-7 * J),
    of_tensor("inertia in kg cm^2", "bodies", lambda J, k: 1e-4 * J),
    centered("centre of mass on the other side of the origin", "bodies", lambda c, k: -c),
    centered("centre of mass taken at the origin", "bodies", lambda c, k: 0.0 * c),
    centered("centre of mass of a flywheel mirrored at its axis", "flywheels", lambda c, k: c * [1.0, -1.0, -1.0],
             keep=True),
    centered("unbalance of a flywheel counted from its third axis", "flywheels",
             lambda c, k: np.array([c[0], -c[2], c[1]]), True),
    centered("static unbalance ignored", "flywheels", lambda c, k: c * [1.0, 0.0, 0.0], True),
    centered("centre of mass in mm", "bodies", lambda c, k: 1e-3 * c),
    of_law("added mass of the opposite sign", "added_mass", lambda M: -M),
    of_stand("products of added mass counted twice, in the derivatives and beside them", lambda stand, _: replace(
        stand, carrier=replace(stand.carrier, laws=tuple(
            replace(law, contains_products=False) if hasattr(law, "contains_products") else law
            for law in stand.carrier.laws)))),
    of_law("added mass ignored", "added_mass", lambda M: 0.0 * M),
    of_law("added mass with the angular part first", "added_mass", exchanged),
    # mounting
    mounted("mounting of flywheels transposed", lambda C, k: C.T),
    mounted("spin axis of the opposite direction", lambda C, k: C @ np.diag([-1.0, 1.0, -1.0])),
    mounted("phase zero at the opposite direction", lambda C, k: C @ np.diag([1.0, -1.0, -1.0])),
    mounted("third axis of a flywheel taken as its spin axis", lambda C, k: np.roll(C, 1, 1)),
    mounting_angles("mounting angles exchanged", lambda m: replace(m, psi=m.theta, theta=m.psi)),
    mounting_angles("mounting angles in degrees",
                    lambda m: MountingAngles(DEGREE * m.psi, DEGREE * m.theta, DEGREE * m.zero)),
    mounting_angles("third mounting angle ignored", lambda m: replace(m, zero=0.0)),
    placed("position of a body of the opposite sign", lambda p, k: -p),
    placed("position of a body ignored", lambda p, k: 0.0 * p),
    placed("position of a body in mm", lambda p, k: 1e-3 * p),
    Reading("flywheel of an instrument taken as mounted on the carrier", "flywheels",
            lambda k: replace(k, mount="carrier")),
    # matrices of laws
    *(of_law(f"{key} matrix {words}", key, change)
      for key in ("linear", "quadratic", "stiffness", "damping")
      for words, change in (("of the opposite sign", np.negative), ("transposed", np.transpose),
                            ("with the angular part first", exchanged))),
    # answers
    of_answer("V_dot answered as the acceleration of O1, with omega x v", "V_dot", acceleration),
    of_answer("V_dot answered in the axes of E0", "V_dot", lambda A, _, st, s: rotate(A, carrier_rotation(st, s))),
    of_answer("V_dot answered with the angular part first", "V_dot", lambda A, *_: np.roll(A, 3)),
    of_answer("Z answered with the moment first", "Z", lambda Z, *_: np.roll(Z, 3)),
    of_answer("Z0 answered about O1", "Z0", lambda _, v, st, s: rotate(v["Z"], carrier_rotation(st, s))),
    of_answer("Z0 answered in the axes of E1", "Z0", lambda _, v, st, s: moment_of(v["Z"], s.position)),
    of_answer("energy answered without its factor of one half", "energy", lambda x, *_: 2.0 * x),
    of_answer("centre of mass answered in the axes of E0", "center_of_mass",
              lambda c, _, st, s: carrier_rotation(st, s) @ c),
    of_answer("reaction answered about the pivot", "reaction", reaction_at),
    of_answer("reaction in the axes of E0", "reaction", lambda R, _, st, s: rotate(R, carrier_rotation(st, s))),
    of_answer("wrench of mounts answered in axes that turn", "mount_wrench", turning_wrenches),
    of_points("specific force answered with the opposite sign of gravity", lambda p, st, s: {
        "specific_force": p["specific_force"] + 2.0 * p["C"].T @ np.array(st.gravity)}),
    of_points("specific force answered without gravity", lambda p, st, s: {
        "specific_force": p["specific_force"] + p["C"].T @ np.array(st.gravity)}),
    of_points("specific force answered without omega x v", lambda p, st, s: {
        "specific_force": p["specific_force"] - np.cross(p["twist"][3:], p["twist"][:3])}),
    of_points("axes of points answered transposed", lambda p, st, s: {"C": p["C"].T}),
)  # fmt: skip
"""Readings, in the order in which they are tried."""

FACTORS: Mapping[float, str] = MappingProxyType({
    -1.0: "of the opposite sign", 1.0 / DEGREE: "in degrees", DEGREE: "times pi/180",
    1.0 / RPM: "in revolutions a minute", 1e3: "a thousand times too large", 1e-3: "a thousand times too small",
    0.0: "as zero",
})  # fmt: skip
"""Factors by which a whole quantity may be answered."""


def readings_of(stand: Stand) -> Iterator[Reading]:
    """Every reading that a stand may show: of all, then of single bodies."""
    yield from (own[0] for row in READINGS if (own := row.of_parts(stand)))
    yield from (each for row in READINGS for each in row.of_parts(stand)[1:])


def answered_by_factor(name: str, factor: float) -> Reading:
    """A quantity, "V_dot" or "points.twist", answered with a factor of FACTORS."""
    key, _, inner = name.partition(".")
    words = f"{inner or key} answered {FACTORS[factor]}"
    if inner:
        return of_points(words, lambda p, st, s: {inner: factor * np.asarray(p[inner])})
    return of_answer(words, key, lambda x, *_: factor * np.asarray(x))
