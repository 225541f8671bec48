"""Wrong readings and conventions: one-line changes of the stand, a state or an answer, and the programs they make.

A row says what a program does, and what the right equations must be asked to do the same.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType
from typing import Any, Literal, TypeVar

import numpy as np

from mahovik.core.stand.model import Body, Flywheel, Instrument, MountingAngles, MountingAxes, Stand
from mahovik.core.stand.state import State
from mahovik.proof.diagnose.answers import Model, Reference
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import inertia_about_origin, mount_transfer
from mahovik.proof.reference.rotation import C1, C2, C3, carrier_rotation, flywheel_mounting
from mahovik.proof.verify.held import freedom_rates, quaternion_of
from mahovik.proof.verify.states import stand_at

Scope = Literal["both", "answer", "bodies", "fixed", "flywheels", "phases"]
"""What is changed: stand and state, the answer, all bodies or one, carrier and instruments, flywheels, their states."""

Data = TypeVar("Data")

E, OFF = np.eye(3), 1.0 - np.eye(3)
LAW_MATRICES = "linear", "quadratic", "stiffness", "damping"
DEGREE, RPM = math.pi / 180.0, math.pi / 30.0


@dataclass(frozen=True)
class Reading:
    """One wrong reading.

    name    what the program does
    scope   what it changes; bodies all together, or `only` one
    change  of a stand and a state: both; of the values of a want, stand and state: the values; of a body: a body; of a
            stand, a state and the index of a flywheel: the state
    """

    name: str
    scope: Scope
    change: Callable[..., Any]
    only: str = ""

    def of_parts(self, stand: Stand) -> list[Reading]:
        """This reading of all that it may be of, and then of each."""
        names = [body.name for body in self._bodies(stand)]
        if self.scope in ("both", "answer"):
            return [self]
        return [self, *(replace(self, only=name) for name in names if len(names) > 1)] if names else []

    @property
    def words(self) -> str:
        """The name, with the body that it is of alone."""
        return f"{self.name} ({self.only} alone)" if self.only else self.name

    def model(self, stand: Stand) -> Model:
        """The right equations with this reading."""
        names = {self.only} if self.only else {body.name for body in self._bodies(stand)}
        if self.scope in ("bodies", "fixed", "flywheels"):
            return Reference(with_bodies(stand, lambda body: self.change(body) if body.name in names else body))
        right = Reference(stand)

        def answer(asked: State, want: str) -> Mapping[str, Any]:
            varied, state = stand_at(stand, asked), asked
            if self.scope == "answer":
                values = right(asked, want)
                return self.change(dict(values), varied, asked) if values else values
            if self.scope == "both":
                varied, state = self.change(varied, asked)
                if stand.hold is not None and state.V != asked.V:
                    state = replace(state, u=tuple(freedom_rates(stand.hold, np.array(state.V)).tolist()))
                return Reference(varied)(state, want)
            for k, wheel in enumerate(stand.flywheels):
                state = self.change(varied, state, k) if wheel.name in names else state
            return right(state, want)

        return answer

    def _bodies(self, stand: Stand) -> Sequence[Body]:
        if self.scope in ("both", "answer"):
            return ()
        parts = {"bodies": stand.bodies, "fixed": (stand.carrier, *stand.instruments)}
        return parts.get(self.scope, stand.flywheels)


def replace(data: Data, **values: Any) -> Data:
    """A copy with other values, which are not typed: rows name the fields that they change."""
    return dataclasses.replace(data, **values)  # type: ignore[type-var]


def with_bodies(stand: Stand, change: Callable[[Any], Any]) -> Stand:
    """A stand with other bodies."""
    instruments, flywheels = tuple(map(change, stand.instruments)), tuple(map(change, stand.flywheels))
    return replace(stand, carrier=change(stand.carrier), instruments=instruments, flywheels=flywheels)


# -- what rows are made of -------------------------------------------------------------------------------------------


def of_stand(name: str, change: Callable[[Stand, State], Stand]) -> Reading:
    """Another stand, which may depend on the state."""
    return Reading(name, "both", lambda stand, s: (change(stand, s), s))


def of_state(name: str, keys: str, change: Callable[[Array, Array, Stand, State], Array]) -> Reading:
    """Other numbers of a state, where it has them, by these, C (3x3), stand and state; `keys`: one, or several."""

    def changed(stand: Stand, s: State) -> tuple[Stand, State]:
        C, values = carrier_rotation(stand, s), {key: getattr(s, key) for key in keys.split()}
        new = {key: tuple(change(np.array(x), C, stand, s).tolist()) for key, x in values.items() if x is not None}
        return stand, replace(s, **new)

    return Reading(name, "both", changed)


def of_attitude(name: str, change: Callable[[Array], Array]) -> Reading:
    """Another attitude C (3x3), however the state gives it."""
    return Reading(name, "both", lambda stand, s: (stand, replace(
        s, angles=None, quaternion=quaternion_of(change(carrier_rotation(stand, s))))))  # fmt: skip


def of_vector(name: str, key: str, change: Callable[[Array, Array], Array]) -> Reading:
    """Another gravity or stream in E0 (3), by itself and C (3x3)."""

    def changed(stand: Stand, s: State) -> Stand:
        vector = np.array(getattr(stand, key) or (0.0, 0.0, 0.0))
        return replace(stand, **{key: tuple(change(vector, carrier_rotation(stand, s)).tolist())})

    return of_stand(name, changed)


def of_phase(name: str, keys: str, change: Callable[[float], float]) -> Reading:
    """Other numbers of a flywheel in the state: phi, phi_dot, phi_ddot, tau."""
    return Reading(name, "phases", lambda _, s, k: _with_items(s, keys, k, change))


def absolute(name: str, key: str, rate: str, sign: float) -> Reading:
    """Speed or acceleration of a flywheel with a part of that of its mount about the spin axis."""

    def changed(stand: Stand, s: State, k: int) -> State:
        wheel = stand.flywheels[k]
        axis = mount_transfer(stand, wheel.mount)[:3, :3] @ flywheel_mounting(wheel)[:, 0]
        return _with_items(s, key, k, lambda x: x + sign * float(axis @ np.array(getattr(s, rate)[3:])))

    return Reading(name, "phases", changed)


def _with_items(s: State, keys: str, k: int, change: Callable[[float], float]) -> State:
    rows = {key: getattr(s, key) for key in keys.split()}
    return replace(s, **{key: (*x[:k], float(change(x[k])), *x[k + 1 :]) for key, x in rows.items()})


def of_wrench(name: str, change: Callable[[Array, str, Stand, State], Array]) -> Reading:
    """Other run-time wrenches (6), by wrench, body, stand and state."""
    return Reading(name, "both", lambda stand, s: (stand, replace(s, wrench=MappingProxyType(
        {k: tuple(change(np.array(P), k, stand, s).tolist()) for k, P in s.wrench.items()}))))  # fmt: skip


def of_body(name: str, scope: Scope, key: str, change: Callable[[Array, Any], Any]) -> Reading:
    """Other numbers of bodies that have them, by these and the body."""

    def changed(body: Any) -> Any:
        numbers = getattr(body, key, None)
        return body if numbers is None else replace(body, **{key: _tuples(change(np.array(numbers), body))})

    return Reading(name, scope, changed)


def centered(name: str, change: Callable[[Array], Array]) -> Reading:
    """Another centre of mass (3, m) of flywheels, with the same inertia about the origin."""
    return Reading(name, "flywheels", lambda k: replace(
        k, inertia=_tuples(inertia_about_origin(k)), inertia_about="origin",
        center_of_mass=_tuples(change(np.array(k.center_of_mass)))))  # fmt: skip


def of_law(name: str, key: str, change: Callable[[Array], Array]) -> Reading:
    """Another 6x6 of added mass, or of any law of a body or between E0 and the carrier, by its name there."""

    def changed(bearer: Any) -> Any:
        own = getattr(bearer, key, None)
        bearer = bearer if own is None else replace(bearer, **{key: _tuples(change(np.array(own)))})
        return replace(bearer, laws=tuple(map(changed, bearer.laws))) if hasattr(bearer, "laws") else bearer

    return of_stand(name, lambda stand, _: with_bodies(changed(stand), changed))


def of_buoyancy(name: str, change: Callable[[Any, Body], Any]) -> Reading:
    """Another buoyancy of a body that has one."""
    return Reading(name, "bodies", lambda k: k if (law := buoyancy_of(k)) is None else k.with_laws(change(law, k)))


def mounted(name: str, change: Callable[[Array], Array]) -> Reading:
    """Another rotation (3x3) of flywheels in their mount, at phase zero."""

    def changed(wheel: Flywheel) -> Flywheel:
        C = change(flywheel_mounting(wheel))
        return replace(wheel, mounting=MountingAxes(tuple(C[:, 0].tolist()), tuple(C[:, 1].tolist())))

    return Reading(name, "flywheels", changed)


def of_answer(name: str, key: str, change: Callable[[Any, dict[str, Any], Stand, State], Any]) -> Reading:
    """Another quantity in an answer, by itself, all values, stand and state; of every point if `key` is points.NAME."""
    outer, _, inner = key.partition(".")

    def changed(values: dict[str, Any], stand: Stand, s: State) -> Mapping[str, Any]:
        if outer not in values:
            return values
        if not inner:
            return {**values, key: change(values[key], values, stand, s)}
        points = {k: {**p, inner: change(p[inner], p, stand, s)} for k, p in values["points"].items()}
        return {**values, "points": points}

    return Reading(name, "answer", changed)


def answered_by_factor(name: str, factor: float) -> Reading:
    """A quantity, "V_dot" or "points.twist", answered with a factor of FACTORS."""
    words = f"{name.removeprefix('points.')} answered {FACTORS[factor]}"
    return of_answer(words, name, lambda x, *_: factor * np.asarray(x))


def _tuples(values: Any) -> Any:
    """An array as nested tuples."""
    return tuple(map(_tuples, values)) if np.ndim(values) else float(values)


def rotate(V: Array, C: Array, parts: Sequence[int] = (0, 1)) -> Array:
    """V (6) with its linear part (0), angular part (1) or both times C."""
    rows = V.reshape(2, 3)
    return np.concatenate([C @ row if i in parts else row for i, row in enumerate(rows)])


def moment_of(P: Array, point: Sequence[float] | Array) -> Array:
    """The wrench (6) whose force acts at a point (3)."""
    return np.concatenate([P[:3], P[3:] + np.cross(point, P[:3])])


def linear(v: Array) -> Array:
    """(v, 0) (6)."""
    return np.concatenate([v, np.zeros(3)])


def buoyancy_of(body: Any) -> Any:
    """The data of the buoyancy of a body; None without."""
    return next((law for law in body.laws if hasattr(law, "displaced_mass")), None)


def buoyancy_of_body(stand: Stand, s: State) -> tuple[Stand, State]:
    """Buoyancy as wrenches that keep the direction that they have where the attitude is zero."""
    wrenches = dict(s.wrench)
    for body in (stand.carrier, *stand.instruments):
        if (law := buoyancy_of(body)) is not None:
            force = moment_of(linear(-law.displaced_mass * np.array(stand.gravity)), law.center)
            wrenches[body.name] = tuple((np.array(wrenches.get(body.name, np.zeros(6))) + force).tolist())
    without = of_buoyancy("", lambda law, k: replace(law, displaced_mass=0.0)).change
    return with_bodies(stand, without), replace(s, wrench=MappingProxyType(wrenches))


def _with_angles(name: str, stand: Stand, _: State) -> Stand:
    return replace(stand, angles=name)


def rotated_inertia(J: Array, k: Body) -> Array:
    """Inertia of an instrument that was given in axes of E1, in its own."""
    C = C3(k.angles[0]) @ C2(k.angles[1]) @ C1(k.angles[2]) if isinstance(k, Instrument) else E
    return C.T @ J @ C


def parallel(J: Array, k: Body, share: float) -> Array:
    """J with a share more of the parallel axis term, where it is about the centre of mass."""
    rc = np.array(k.center_of_mass)
    return J if k.inertia_about == "origin" else J + share * k.mass * (rc @ rc * E - np.outer(rc, rc))


PARTS: Mapping[str, Scope] = {"": "bodies", " of flywheels": "flywheels", " of carrier and instruments": "fixed"}
"""Bodies that share a convention, in words."""

READINGS: tuple[Reading, ...] = (
    # attitude
    of_state("quaternion read with the scalar last", "quaternion", lambda q, *_: np.roll(q, 1)),
    of_state("quaternion given with the scalar last to what reads it scalar first", "quaternion",
             lambda q, *_: np.roll(q, -1)),
    of_state("quaternion conjugated", "quaternion", lambda q, *_: q * [1, -1, -1, -1]),
    of_state("quaternion read with the scalar last, and conjugated", "quaternion",
             lambda q, *_: np.roll(q, 1) * [1, -1, -1, -1]),
    of_attitude("attitude transposed: from E0 to E1", lambda C: C.T),
    of_attitude("attitude ignored", lambda C: E),
    of_state("attitude angles in degrees", "angles", lambda a, *_: DEGREE * a),
    of_state("attitude angles in reverse order", "angles", lambda a, *_: a[::-1]),
    of_state("attitude angles with the opposite sign", "angles", lambda a, *_: -a),
    *(of_stand(f"attitude angles in the {name} sequence", partial(_with_angles, name))
      for name in ("ship", "aircraft", "euler")),
    of_state("position ignored", "position", lambda x, *_: 0.0 * x),
    # twist of the carrier
    of_state("V read with the angular part first", "V", lambda V, *_: np.roll(V, 3)),
    of_state("V and V_dot read with the angular part first", "V V_dot", lambda V, *_: np.roll(V, 3)),
    of_state("V taken in the axes of E0", "V", lambda V, C, *_: rotate(V, C.T)),
    of_state("V turned into E1 though it is given there", "V", lambda V, C, *_: rotate(V, C)),
    of_state("v taken in the axes of E0, omega in E1", "V", lambda V, C, *_: rotate(V, C.T, [0])),
    of_state("omega taken in the axes of E0, v in E1", "V", lambda V, C, *_: rotate(V, C.T, [1])),
    of_state("omega in degrees a second", "V", lambda V, *_: rotate(V, DEGREE * E, [1])),
    of_state("omega of the opposite sense", "V", lambda V, *_: rotate(V, -E, [1])),
    of_state("v taken at the carrier's centre of mass", "V",
             lambda V, _, st, s: V - linear(np.cross(V[3:], st.carrier.center_of_mass))),
    of_state("V taken relative to the fluid", "V", lambda V, C, st, s: V + linear(C.T @ (st.stream or np.zeros(3)))),
    of_state("V_dot read as the acceleration of O1", "V_dot",
             lambda A, _, st, s: A - linear(np.cross(s.V[3:], s.V[:3]))),
    of_state("V_dot taken in the axes of E0", "V_dot", lambda A, C, *_: rotate(A, C.T)),
    # flywheels in the state
    of_phase("phase of the opposite sense", "phi", lambda x: -x),
    of_phase("phase, speed, acceleration and torque of the opposite sense", "phi phi_dot phi_ddot tau", lambda x: -x),
    of_phase("speed of a flywheel of the opposite sense", "phi_dot", lambda x: -x),
    of_phase("acceleration of a flywheel of the opposite sense", "phi_ddot", lambda x: -x),
    of_phase("drive torque taken as that on the mount", "tau", lambda x: -x),
    of_phase("phase in degrees", "phi", lambda x: DEGREE * x),
    of_phase("speed of a flywheel in degrees a second", "phi_dot", lambda x: DEGREE * x),
    of_phase("speed of a flywheel in revolutions a minute", "phi_dot", lambda x: RPM * x),
    of_phase("speed of a flywheel turned into revolutions a minute", "phi_dot", lambda x: x / RPM),
    of_phase("phase counted from the third axis", "phi", lambda x: x - math.pi / 2),
    of_phase("phase half a turn off", "phi", lambda x: x + math.pi),
    of_phase("phase ignored", "phi", lambda x: 0.0),
    absolute("speed of a flywheel is taken as absolute, not relative to its mount", "phi_dot", "V", -1.0),
    absolute("speed of a flywheel counts the turning of its mount twice", "phi_dot", "V", 1.0),
    absolute("acceleration of a flywheel is taken as absolute, not relative to its mount", "phi_ddot", "V_dot", -1.0),
    of_state("flywheels in reverse order", "phi phi_dot phi_ddot tau", lambda x, *_: x[::-1]),
    # run-time wrenches
    of_wrench("run-time wrenches ignored", lambda P, *_: 0.0 * P),
    of_wrench("run-time wrenches of the opposite sign", lambda P, *_: -P),
    of_wrench("run-time wrenches read with the moment first", lambda P, *_: np.roll(P, 3)),
    of_wrench("run-time wrenches taken in the axes of E0", lambda P, k, st, s: rotate(P, carrier_rotation(st, s).T)),
    of_wrench("force of a run-time wrench acting at the centre of mass", lambda P, k, st, s: moment_of(
        P, next(body.center_of_mass for body in st.bodies if body.name == k))),
    of_wrench("run-time wrench of a flywheel not turning with it", lambda P, k, st, s: next(
        (rotate(P, C1(phi).T) for wheel, phi in zip(st.flywheels, s.phi, strict=True) if wheel.name == k), P)),
    # gravity, stream, buoyancy
    *(of_vector(f"{name} {words}", name, change) for name in ("gravity", "stream") for words, change in (
        ("of the opposite sign", lambda g, C: -g), ("ignored", lambda g, C: 0.0 * g),
        ("not turned into the axes of E1", lambda g, C: C @ g),
        ("turned by C in place of its transpose", lambda g, C: C @ C @ g))),
    Reading("buoyancy that does not turn into the axes of the body", "both", buoyancy_of_body),
    of_buoyancy("buoyancy of the opposite sign", lambda law, k: replace(law, displaced_mass=-law.displaced_mass)),
    of_buoyancy("buoyancy ignored", lambda law, k: replace(law, displaced_mass=0.0)),
    of_buoyancy("buoyancy acting at the centre of mass", lambda law, k: replace(law, center=k.center_of_mass)),
    # inertia
    *(of_body(f"products of inertia{words} of the opposite sign", scope, "inertia", lambda J, k: J * (E - OFF))
      for words, scope in PARTS.items()),
    of_body("products of inertia ignored", "bodies", "inertia", lambda J, k: J * E),
    Reading("inertia taken about the origin though it is about the centre of mass", "bodies",
            lambda k: replace(k, inertia_about="origin")),
    Reading("inertia taken about the centre of mass though it is about the origin", "bodies",
            lambda k: replace(k, inertia_about="center_of_mass")),
    of_body("parallel axis term twice", "bodies", "inertia", lambda J, k: parallel(J, k, 1.0)),
    of_body("parallel axis term of the opposite sign", "bodies", "inertia", lambda J, k: parallel(J, k, -2.0)),
    of_body("inertia of an instrument taken in the axes of E1", "fixed", "inertia", rotated_inertia),
    of_body("third axis taken as the spin axis", "flywheels", "inertia", lambda J, k: np.roll(J, (1, 1), (0, 1))),
    of_body("inertia in g cm^2", "bodies", "inertia", lambda J, k: 1e-7 * J),
    of_body("inertia in kg cm^2", "bodies", "inertia", lambda J, k: 1e-4 * J),
    of_body("centre of mass on the other side of the origin", "bodies", "center_of_mass", lambda c, k: -c),
    of_body("centre of mass taken at the origin", "bodies", "center_of_mass", lambda c, k: 0.0 * c),
    of_body("centre of mass in mm", "bodies", "center_of_mass", lambda c, k: 1e-3 * c),
    centered("centre of mass of a flywheel mirrored at its axis", lambda c: c * [1.0, -1.0, -1.0]),
    centered("unbalance of a flywheel counted from its third axis", lambda c: np.array([c[0], -c[2], c[1]])),
    centered("static unbalance ignored", lambda c: c * [1.0, 0.0, 0.0]),
    of_stand("products of added mass counted twice, in the derivatives and beside them", lambda stand, _: replace(
        stand, carrier=replace(stand.carrier, laws=tuple(
            replace(law, contains_products=False) if hasattr(law, "contains_products") else law
            for law in stand.carrier.laws)))),
    # mounting
    mounted("mounting of flywheels transposed", lambda C: C.T),
    mounted("spin axis of the opposite direction", lambda C: C @ np.diag([-1.0, 1.0, -1.0])),
    mounted("third axis of a flywheel taken as its spin axis", lambda C: np.roll(C, 1, 1)),
    *(Reading(f"mounting angles {words}", "flywheels", lambda k, change=change: replace(
        k, mounting=MountingAngles(*change(*dataclasses.astuple(k.mounting))))
        if isinstance(k.mounting, MountingAngles) else k)
      for words, change in (("exchanged", lambda a, b, c: (b, a, c)),
                            ("in degrees", lambda *x: (DEGREE * angle for angle in x)))),
    of_body("position of a body of the opposite sign", "bodies", "position", lambda p, k: -p),
    of_body("position of a body ignored", "bodies", "position", lambda p, k: 0.0 * p),
    of_body("position of a body in mm", "bodies", "position", lambda p, k: 1e-3 * p),
    Reading("flywheel of an instrument taken as mounted on the carrier", "flywheels",
            lambda k: replace(k, mount="carrier")),
    # matrices of added mass and of laws
    *(of_law(f"{name} {words}", key, change)
      for key, name in (("added_mass", "added mass"), *((x, f"{x} matrix") for x in LAW_MATRICES))
      for words, change in (("of the opposite sign", np.negative), ("transposed", np.transpose),
                            ("with the angular part first", lambda M: np.roll(M, (3, 3), (0, 1))))),
    # answers
    of_answer("V_dot answered as the acceleration of O1, with omega x v", "V_dot",
              lambda A, _, st, s: A + linear(np.cross(s.V[3:], s.V[:3]))),
    of_answer("V_dot answered in the axes of E0", "V_dot", lambda A, _, st, s: rotate(A, carrier_rotation(st, s))),
    of_answer("V_dot answered with the angular part first", "V_dot", lambda A, *_: np.roll(A, 3)),
    of_answer("Z answered with the moment first", "Z", lambda Z, *_: np.roll(Z, 3)),
    of_answer("Z0 answered about O1", "Z0", lambda _, v, st, s: rotate(v["Z"], carrier_rotation(st, s))),
    of_answer("Z0 answered in the axes of E1", "Z0", lambda _, v, st, s: moment_of(v["Z"], s.position)),
    of_answer("energy answered without its factor of one half", "energy", lambda x, *_: 2.0 * x),
    of_answer("centre of mass answered in the axes of E0", "center_of_mass",
              lambda c, _, st, s: carrier_rotation(st, s) @ c),
    of_answer("reaction answered about the pivot", "reaction",
              lambda R, _, st, s: moment_of(R, -np.array(st.hold.pivot)) if st.hold else R),
    of_answer("reaction in the axes of E0", "reaction", lambda R, _, st, s: rotate(R, carrier_rotation(st, s))),
    of_answer("wrench of mounts answered in axes that turn", "mount_wrench", lambda P, _, st, s: np.array(
        [rotate(x, C1(phi).T) for x, phi in zip(np.asarray(P), s.phi, strict=True)]).reshape(-1, 6)),
    of_answer("specific force answered with the opposite sign of gravity", "points.specific_force",
              lambda a, p, st, s: a + 2.0 * p["C"].T @ np.array(st.gravity)),
    of_answer("specific force answered without gravity", "points.specific_force",
              lambda a, p, st, s: a + p["C"].T @ np.array(st.gravity)),
    of_answer("specific force answered without omega x v", "points.specific_force",
              lambda a, p, st, s: a - np.cross(p["twist"][3:], p["twist"][:3])),
    of_answer("axes of points answered transposed", "points.C", lambda C, *_: C.T),
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
    yield from (parts[0] for row in READINGS if (parts := row.of_parts(stand)))
    yield from (part for row in READINGS for part in row.of_parts(stand)[1:])
