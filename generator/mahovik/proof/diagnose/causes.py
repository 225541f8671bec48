"""Causes of a program's error: wrong readings and conventions, and numbers of the stand file.

A reading says what a program does, and what the right equations must be asked to do the same. One number, or two, are
found by derivative, then solved exactly.
"""

from __future__ import annotations

import dataclasses
import math
import warnings
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Literal, TypeVar

import numpy as np

from mahovik.core.stand.model import Flywheel, MountingAxes, Stand, State, rest_state
from mahovik.core.stand.numbers import StandNumber, StandNumbers
from mahovik.core.stand.stand_file import read
from mahovik.errors import MahovikError, StandError, UsageError
from mahovik.proof.diagnose.answers import AnswerVector, Model, Reference
from mahovik.proof.reference.algebra import C1, Array, attitude, carrier_rotation, flywheel_mounting, rotation_vector
from mahovik.proof.reference.evaluate import pieces
from mahovik.proof.reference.pieces import inertia_about_origin, mount_transfer
from mahovik.proof.verify.draw import freedom_rates, quaternion_of, with_angles
from mahovik.proof.verify.states import stand_at

# -- readings ----------------------------------------------------------------------------------------------------------

Data = TypeVar("Data")

E = np.eye(3)
DEGREE, RPM = math.pi / 180.0, math.pi / 30.0


@dataclass(frozen=True)
class At:
    """Where a number is changed: stand and state; the body that it is of; the answer, or point of one, that has it."""

    stand: Stand
    s: State
    body: Any = None
    beside: Mapping[str, Any] = field(default_factory=dict)

    @property
    def C(self) -> Array:
        """Attitude of the carrier (3x3)."""
        return carrier_rotation(self.stand, self.s)


Place = Literal["state", "wrench", "stand", "body", "law", "answer", "all"]
Change = Callable[[Any, At], Any]


@dataclass(frozen=True)
class Reading:
    """One wrong reading.

    name    what the program does
    place   of the numbers that it changes: keys of the state, run-time wrenches, keys of the stand or of bodies,
            matrices of laws and of added mass, a quantity of the answer ("points.NAME": of every point); or stand and
            state together
    keys    there; none of a body: the body itself
    change  of the numbers, and where they are
    bodies  that may have it, all together or `only` one: "", "bodies", "fixed" ones, "instruments", "flywheels", those
            with "inputs"
    """

    name: str
    place: Place
    keys: str
    change: Change
    bodies: str = ""
    only: str = ""

    def of_parts(self, stand: Stand) -> list[Reading]:
        """This reading of all that it may be of, and then of each; none where there is nothing."""
        names = self._names(stand)
        if not self.bodies:
            return [self]
        return [self, *(replace(self, only=name) for name in names if len(names) > 1)] if names else []

    @property
    def words(self) -> str:
        """The name, with the body that it is of alone."""
        return f"{self.name} ({self.only} alone)" if self.only else self.name

    def of_bodies(self, stand: Stand) -> Stand | None:
        """The stand with its bodies as this reading has them; None where it is no reading of bodies alone."""
        state, names = rest_state(stand), self._names(stand)
        turned = replace(state, phi=(1.0,) * len(stand.flywheels))
        still, other = (self._changed(At(stand, s), names)[0] for s in (state, turned))
        return still if self.place == "body" and still == other else None

    def model(self, stand: Stand) -> Model:
        """The right equations with this reading."""
        names = self._names(stand)

        last: list[Any] = [None]  # state; what is asked there in its place, for all wants

        def answered(asked: State, want: str) -> Mapping[str, Any]:
            if last[0] is not asked:
                at = At(stand_at(stand, asked), asked)
                varied, state = self._changed(at, names)
                if stand.hold is not None and state.V != asked.V:
                    state = replace(state, u=tuple(freedom_rates(stand.hold, np.array(state.V)).tolist()))
                last[:] = asked, at, Reference(varied), state
            _, at, right, state = last
            values: Mapping[str, Any] = right(state, want)
            outer, _, inner = self.keys.partition(".")
            if self.place != "answer" or outer not in values:
                return values
            if not inner:
                return {**values, outer: self.change(values[outer], replace(at, beside=values))}
            points = {k: {**p, inner: self.change(p[inner], replace(at, beside=p))} for k, p in values[outer].items()}
            return {**values, outer: points}

        return answered

    def _changed(self, at: At, names: Collection[str]) -> tuple[Stand, State]:
        stand, s = at.stand, at.s
        keys = self.keys.split() if self.place != "answer" else []
        if self.place == "all":
            stand, s = self.change(names, at)
        elif self.place == "wrench":
            bodies = {body.name: body for body in stand.bodies}
            P = {
                k: _tuples(self.change(np.array(x), replace(at, body=bodies[k])))
                for k, x in s.wrench.items()
                if k in names
            }
            s = replace(s, wrench=MappingProxyType({**s.wrench, **P}))
        elif self.place == "body":
            stand = with_bodies(stand, lambda k: self._changed_body(k, at) if k.name in names else k)
        for key in keys:
            if self.place == "state" and (x := getattr(s, key)) is not None:
                new = np.asarray(self.change(np.array(x), at))
                if self.bodies:
                    new = np.where([wheel.name in names for wheel in stand.flywheels], new, x)
                s = replace(s, **{key: _tuples(new)})
            elif self.place == "stand":
                stand = replace(stand, **{key: _tuples(self.change(getattr(stand, key), at))})
            elif self.place == "law":
                stand = with_bodies(self._with_laws(stand, at), lambda k: self._with_laws(k, replace(at, body=k)))
        return stand, s

    def _changed_body(self, body: Any, at: At) -> Any:
        at = replace(at, body=body)
        if not self.keys:
            return self.change(body, at)
        numbers = getattr(body, self.keys, None)
        return body if numbers is None else replace(body, **{self.keys: _tuples(self.change(np.array(numbers), at))})

    def _with_laws(self, bearer: Any, at: At) -> Any:
        if (M := getattr(bearer, self.keys, None)) is not None:
            bearer = replace(bearer, **{self.keys: _tuples(self.change(np.array(M), at))})
        laws = getattr(bearer, "laws", None)
        return bearer if laws is None else replace(bearer, laws=tuple(self._with_laws(law, at) for law in laws))

    def _names(self, stand: Stand) -> list[str]:
        kinds: Mapping[str, Sequence[Any]] = {
            "bodies": stand.bodies, "fixed": (stand.carrier, *stand.instruments), "flywheels": stand.flywheels,
            "instruments": stand.instruments, "inputs": [body for body in stand.bodies if body.wrench_input],
        }  # fmt: skip
        bodies = kinds.get(self.bodies, ())
        return [body.name for body in bodies if self.only in ("", body.name)]


def replace(data: Data, **values: Any) -> Data:
    """A copy with other values, which are not typed: readings name the fields that they change."""
    return dataclasses.replace(data, **values)  # type: ignore[type-var]


def with_bodies(stand: Stand, change: Callable[[Any], Any]) -> Stand:
    """A stand with other bodies."""
    instruments, flywheels = tuple(map(change, stand.instruments)), tuple(map(change, stand.flywheels))
    return replace(stand, carrier=change(stand.carrier), instruments=instruments, flywheels=flywheels)


def _tuples(values: Any) -> Any:
    """An array as nested tuples; words as they are."""
    if isinstance(values, str):
        return values
    return tuple(map(_tuples, values)) if np.ndim(values) else float(values)


def rotate(V: Array, C: Array, parts: Sequence[int] = (0, 1)) -> Array:
    """V (6) with its linear part (0), angular part (1) or both times C."""
    return np.concatenate([C @ row if i in parts else row for i, row in enumerate(V.reshape(2, 3))])


def in_axes(M: Array, C: Array, of_rotation: Array | None = None) -> Array:
    """The matrix (6x6) in the axes of a body that is M in others, in which the body's axes are the columns of C."""
    L = np.kron(np.diag([1.0, 0.0]), C) + np.kron(np.diag([0.0, 1.0]), C if of_rotation is None else of_rotation)
    return np.asarray(L.T @ M @ L)


def moment_of(P: Array, point: Sequence[float] | Array) -> Array:
    """The wrench (6) whose force acts at a point (3)."""
    return np.concatenate([P[:3], P[3:] + np.cross(point, P[:3])])


def transport(at: At, v: Sequence[float]) -> Array:
    """(omega x v, 0) (6)."""
    return np.concatenate([np.cross(at.s.V[3:], v), np.zeros(3)])


def unturned_buoyancy(names: Collection[str], at: At, axes: Callable[[At], Array]) -> tuple[Stand, State]:
    """Buoyancy of some bodies as wrenches with the force of attitude zero, in some axes (3x3, columns) of the body."""
    wrenches = dict[str, Array]()

    def sunk(body: Any) -> Any:
        laws = [law for law in body.laws if hasattr(law, "displaced_mass") and body.name in names]
        for law in laws:
            force = -law.displaced_mass * axes(replace(at, body=body)).T @ np.array(at.stand.gravity)
            wrenches[body.name] = moment_of(np.concatenate([force, np.zeros(3)]), law.center)
        return replace(body, laws=tuple(replace(law, displaced_mass=0.0) if law in laws else law for law in body.laws))

    return with_bodies(at.stand, sunk), with_wrenches(at, wrenches)[1]


def turned_by_phase(at: At) -> Array:
    """Rotation (3x3) of the body in its mount by its phase, where it is a flywheel."""
    phases = (x for k, x in zip(at.stand.flywheels, at.s.phi, strict=True) if k.name == at.body.name)
    return C1(next(phases, 0.0))


def body_axes(at: At) -> Array:
    """Axes (3x3, columns) of the body in E1; those of E1 without a body."""
    if isinstance(at.body, Flywheel):
        mounted = mount_transfer(at.stand, at.body.mount)[:3, :3] @ flywheel_mounting(at.body)
        return np.asarray(mounted @ turned_by_phase(at))
    return E if at.body is None else mount_transfer(at.stand, at.body.name)[:3, :3]


def with_turned_inertia(k: Any, C: Array, of: str) -> Any:
    """A body with its inertia `of` the origin or the centre of mass, or the latter itself, turned by C (3x3)."""
    c, J = np.array(k.center_of_mass), inertia_about_origin(k)
    central = J - k.mass * (c @ c * E - np.outer(c, c))
    if of == "centre of mass":
        return replace(k, center_of_mass=_tuples(C @ c), inertia=_tuples(central), inertia_about="center_of_mass")
    about, J = ("origin", J) if of == "inertia about the origin" else ("center_of_mass", central)
    J = C @ J @ C.T
    return replace(k, inertia=_tuples((J + J.T) / 2.0), inertia_about=about)


def with_wrenches(at: At, more: Mapping[str, Array]) -> tuple[Stand, State]:
    """The same with more run-time wrenches (6), by body."""
    P = {name: _tuples(np.array(at.s.wrench.get(name, np.zeros(6))) + x) for name, x in more.items()}
    return at.stand, replace(at.s, wrench=MappingProxyType({**at.s.wrench, **P}))


def damped_in_still_water(names: Collection[str], at: At) -> tuple[Stand, State]:
    """Wrenches of the laws of some bodies at V in place of V_r."""
    still = pieces(replace(at.stand, stream=None, profile=None), at.s).terms
    there, zero = pieces(at.stand, at.s).terms, np.zeros(6)
    more = {
        k: sum((x - there[k].get(kind, zero) for kind, x in P.items()), zero) for k, P in still.items() if k in names
    }
    return with_wrenches(at, more)


def scaled(x: Array, function: Callable[[float], float]) -> Array:
    """A rotation vector (3) of the length 2 f(angle / 2) in place of its angle."""
    half = math.hypot(*x) / 2.0
    return x * (function(half) / half if half else 1.0)


def with_suspended(at: At, more: Callable[[Any], Array]) -> tuple[Stand, State]:
    """More wrenches (6) on the carrier, of its suspension."""
    laws: list[Any] = [law for law in at.stand.laws if law.key == "suspension"]
    return with_wrenches(at, {at.stand.carrier.name: sum(map(more, laws), np.zeros(6))})


def with_rotation(at: At, change: Callable[[Array, Array], Array]) -> tuple[Stand, State]:
    """A suspension with other numbers (3) in place of the rotation vector of a rotation (3x3) from equilibrium."""

    def more(law: Any) -> Array:
        C_eq = attitude(at.stand.angles, *law.angles)
        C = C_eq.T @ at.C
        return np.asarray(np.array(law.stiffness)[:, 3:] @ (rotation_vector(C) - change(C, C_eq)))

    return with_suspended(at, more)


def without_sense(M: Array, at: At) -> Array:
    """The matrix (6x6) of V |V| that gives the wrench of a matrix of V V, on carrier and instruments."""
    if at.body is None or isinstance(at.body, Flywheel):
        return M
    V_r = np.array(at.s.V) - rotate(np.array([*(at.stand.stream or (0.0, 0.0, 0.0)), 0.0, 0.0, 0.0]), at.C.T)
    return np.asarray(M * np.sign(mount_transfer(at.stand, at.body.name).T @ V_r))


def angles_of(stand: Stand, s: State, C: Array) -> Any:
    """Angles (3) of an attitude in the stand's sequence; at its singularity those with phi = 0."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return with_angles(stand, replace(s, angles=None, quaternion=quaternion_of(C))).angles


def by_reversed_angles(_: None, at: At) -> tuple[Stand, State]:
    """C1 C2 C3 in place of C3 C2 C1, and the like of other sequences."""
    if at.s.angles is None:
        return at.stand, at.s
    backwards = attitude(at.stand.angles, *(-x for x in at.s.angles)).T
    return at.stand, replace(at.s, angles=angles_of(at.stand, at.s, backwards))


def with_suspension(at: At, change: Callable[[Array], Any]) -> tuple[Stand, State]:
    """The stand with other angles of its suspension."""
    laws: list[Any] = list(at.stand.laws)
    turned = [replace(x, angles=_tuples(change(np.array(x.angles)))) if x.key == "suspension" else x for x in laws]
    return replace(at.stand, laws=tuple(turned)), at.s


def in_sequence(at: At, name: Any) -> tuple[Stand, State]:
    """Angles of the state alone in another sequence; those of suspension and hold keep their rotations."""

    def same(angles: Any) -> Any:
        return angles_of(replace(at.stand, angles=name), at.s, attitude(at.stand.angles, *angles))

    stand, _ = with_suspension(at, same)
    hold = at.stand.hold and replace(at.stand.hold, angles=same(at.stand.hold.angles))
    return replace(stand, angles=name, hold=hold), at.s


def unturned_displacement(O1: Array, at: At) -> Array:
    """The place of O1 (3) whose displacement in E1 is that of `O1` in E0."""
    laws: list[Any] = [law for law in at.stand.laws if law.key == "suspension"]
    position = laws[0].position if laws else O1
    return np.asarray(position + at.C @ (O1 - position))


def relative_to_mounts(x: Array, at: At, rate: str) -> Array:
    """Speeds or accelerations (N) without the part of that of each flywheel's mount about the spin axis."""
    axes = [mount_transfer(at.stand, k.mount)[:3, :3] @ flywheel_mounting(k)[:, 0] for k in at.stand.flywheels]
    return np.array(x - np.reshape(axes, (-1, 3)) @ np.array(getattr(at.s, rate)[3:]))


def mounted(wheel: Flywheel, C: Array) -> Flywheel:
    """The flywheel with another rotation (3x3) in its mount, at phase zero."""
    first, second, _ = C.T.tolist()
    return replace(wheel, mounting=MountingAxes(tuple(first), tuple(second)))


def with_products_twice(_: None, at: At) -> tuple[Stand, State]:
    """Damping terms that hold the products of added mass, taken as if they did not."""
    laws = at.stand.carrier.laws
    laws = tuple(replace(law, contains_products=False) if hasattr(law, "contains_products") else law for law in laws)
    return replace(at.stand, carrier=replace(at.stand.carrier, laws=laws)), at.s


# -- kinds, and what they are of ---------------------------------------------------------------------------------------

IGNORED: tuple[str, Change] = ("ignored", lambda x, at: 0.0 * x)
DEGREES: tuple[str, Change] = ("in degrees", lambda x, at: DEGREE * x)
SIGN: tuple[str, Change] = ("of the opposite sign", lambda x, at: -x)
FIRST: tuple[str, Change] = (
    "with the angular part first",
    lambda x, at: np.roll(x, (3,) * np.ndim(x), range(np.ndim(x))),
)

QUATERNION: Mapping[str, Change] = {
    "read with the scalar last": lambda q, at: np.roll(q, 1),
    "given with the scalar last to what reads it scalar first": lambda q, at: np.roll(q, -1),
    "conjugated": lambda q, at: q * [1, -1, -1, -1],
    "read with the scalar last, and conjugated": lambda q, at: np.roll(q, 1) * [1, -1, -1, -1],
    "ignored": lambda q, at: np.eye(4)[0],
}
ANGLES = dict([SIGN, DEGREES, IGNORED, ("in reverse order", lambda a, at: a[::-1])])
SIXES: Mapping[str, Change] = {
    FIRST[0]: FIRST[1],
    "taken in the axes of E0": lambda x, at: rotate(x, at.C.T),
    "turned into the axes of E1 though it is given there": lambda x, at: rotate(x, at.C),
    SIGN[0]: SIGN[1],
}
"""Wrong readings of twists and wrenches, by their words: what each makes of the right one."""
TWIST: Mapping[str, Change] = {
    "v taken in the axes of E0, omega in E1": lambda V, at: rotate(V, at.C.T, [0]),
    "omega taken in the axes of E0, v in E1": lambda V, at: rotate(V, at.C.T, [1]),
    "omega in degrees a second": lambda V, at: rotate(V, DEGREE * E, [1]),
    "omega of the opposite sense": lambda V, at: rotate(V, -E, [1]),
    "v in mm a second": lambda V, at: rotate(V, 1e-3 * E, [0]),
    "v taken at the carrier's centre of mass": lambda V, at: V - transport(at, at.stand.carrier.center_of_mass),
}
WRENCH: Mapping[str, Change] = {
    "run-time wrench ignored": lambda P, at: 0.0 * P,
    "run-time wrench taken in the axes of E1": lambda P, at: rotate(P, body_axes(at).T),
    "force of a run-time wrench acting at the centre of mass": lambda P, at: moment_of(P, at.body.center_of_mass),
    "run-time wrench of a flywheel not turning with it": lambda P, at: rotate(P, turned_by_phase(at).T),
}
WHEELS = {
    "phase": "phi", "speed of a flywheel": "phi_dot", "acceleration of a flywheel": "phi_ddot",
    "torque of a flywheel": "tau", "phase and speed": "phi phi_dot",
    "phase, speed, acceleration and torque": "phi phi_dot phi_ddot tau",
}  # fmt: skip
OF_WHEELS: Mapping[str, Change] = {
    "of the opposite sense": SIGN[1], "in revolutions a minute": lambda x, at: RPM * x, **dict([DEGREES, IGNORED]),
    "turned into revolutions a minute": lambda x, at: x / RPM,
    "in the reverse order of flywheels": lambda x, at: x[::-1],
}  # fmt: skip
VECTORS: Mapping[str, Change] = {
    SIGN[0]: lambda g, at: -np.array(g or (0.0, 0.0, 0.0)),
    "not turned into the axes of E1": lambda g, at: at.C @ (g or (0.0, 0.0, 0.0)),
    "turned by C in place of its transpose": lambda g, at: at.C @ at.C @ (g or (0.0, 0.0, 0.0)),
    "ignored": lambda g, at: np.zeros(3),
}
"""Wrong readings of gravity and stream, vectors in E0, by their words."""
OF_SUSPENSION = dict([DEGREES, IGNORED, ("taken from E1 to E0", lambda a, at: (
    angles_of(at.stand, at.s, attitude(at.stand.angles, *a).T)))])  # fmt: skip
OF_INSTRUMENTS = ANGLES | {"taken from E1 to the instrument": lambda a, at: (
    angles_of(replace(at.stand, angles="ship"), at.s, attitude("ship", *a).T))}  # fmt: skip
OF_ROTATION: Mapping[str, Callable[[Array, Array], Array]] = {
    "the sine of the angle": lambda C, _: scaled(rotation_vector(C), lambda x: math.sin(2.0 * x) / 2.0),
    "twice the vector part of a quaternion": lambda C, _: scaled(rotation_vector(C), math.sin),
    "the vector part of a quaternion": lambda C, _: scaled(rotation_vector(C), lambda x: math.sin(x) / 2.0),
    "twice the tangent of half the angle": lambda C, _: scaled(rotation_vector(C), math.tan),
    "angles of the sequence 3, 2, 1": lambda C, _: np.array(
        [math.atan2(C[2, 1], C[2, 2]), -math.asin(min(1.0, max(-1.0, C[2, 0]))), math.atan2(C[1, 0], C[0, 0])]),
    "components in the axes of E0": lambda C, C_eq: np.array(C_eq @ rotation_vector(C)),
}  # fmt: skip
"""What is taken for a rotation vector, by its words: of a rotation (3x3) from that of equilibrium."""
TURNED: Mapping[str, tuple[str, Callable[[At], Array]]] = {
    "not turned into the axes of E1": ("", lambda at: body_axes(at).T),
    "turned into the axes of E1 the other way, by C^T for C": ("", lambda at: body_axes(at).T @ body_axes(at).T),
    "does not turn with the phase": ("flywheels", lambda at: turned_by_phase(at).T),
    "turns with the phase the other way": ("flywheels", lambda at: turned_by_phase(at).T @ turned_by_phase(at).T),
    "turns with the phase alone, not with the axes at phase zero": ("flywheels", lambda at: (
        body_axes(at).T @ turned_by_phase(at))),
}  # fmt: skip
"""What may be wrong with the axes of an inertia and of a centre of mass: bodies, and how these are turned."""
OF_TURNED = ("inertia about the centre of mass", "inertia about the origin", "centre of mass")
PARTS = {"": "bodies", " of flywheels": "flywheels", " of carrier and instruments": "fixed"}
"""Bodies that share a convention, in words."""
PLACES = {"centre of mass": "center_of_mass", "position of a body": "position"}
OF_PLACES: Mapping[str, Change] = dict([SIGN, IGNORED, ("in mm", lambda c, at: 1e-3 * c)])
OF_INERTIA: Mapping[str, Change] = {"in g cm^2": lambda J, at: 1e-7 * J, "in kg cm^2": lambda J, at: 1e-4 * J}
MOUNTING: Mapping[str, Change] = {
    "mounting of flywheels transposed": lambda k, at: mounted(k, flywheel_mounting(k).T),
    "spin axis of the opposite direction": lambda k, at: mounted(k, flywheel_mounting(k) * [-1.0, 1.0, -1.0]),
    "flywheel of an instrument taken as mounted on the carrier": lambda k, at: replace(k, mount="carrier"),
    "axes of a flywheel not turned by those of its mount": lambda k, at: mounted(
        k, mount_transfer(at.stand, k.mount)[:3, :3].T @ flywheel_mounting(k)
    ),
    "position of a flywheel not turned by the axes of its mount": lambda k, at: replace(
        k, position=_tuples(mount_transfer(at.stand, k.mount)[:3, :3].T @ np.array(k.position))
    ),
}
MATRICES = {"added mass": "added_mass", **{f"{x} matrix": x for x in ("linear", "quadratic", "stiffness", "damping")}}
OF_MATRICES: Mapping[str, Change] = {
    **dict([SIGN, FIRST]), "transposed": lambda M, at: M.T,
    "taken in the axes of E0": lambda M, at: in_axes(M, at.C @ body_axes(at)),
    "taken in the axes of E1": lambda M, at: in_axes(M, body_axes(at)),
    "of translation taken in the axes of E0": lambda M, at: in_axes(M, at.C @ body_axes(at), E),
}  # fmt: skip
ANSWERED: Mapping[str, tuple[str, Change]] = {
    "V_dot answered as the acceleration of O1, with omega x v": ("V_dot", lambda A, at: A + transport(at, at.s.V[:3])),
    "Z0 answered about O1": ("Z0", lambda _, at: rotate(at.beside["Z"], at.C)),
    "reaction answered about the pivot": ("reaction", lambda R, at: (
        moment_of(R, -np.array(at.stand.hold.pivot)) if at.stand.hold else R)),
    "wrench of mounts answered in axes that turn": ("mount_wrench", lambda P, at: np.array(
        [rotate(x, C1(phi).T) for x, phi in zip(np.asarray(P), at.s.phi, strict=True)]).reshape(-1, 6)),
    "specific force answered with the opposite sign of gravity": ("points.specific_force", lambda a, at: (
        a + 2.0 * at.beside["C"].T @ np.array(at.stand.gravity))),
    "specific force answered without gravity": ("points.specific_force", lambda a, at: (
        a + at.beside["C"].T @ np.array(at.stand.gravity))),
    "axes of points answered transposed": ("points.C", lambda C, at: C.T),
}  # fmt: skip
FACTORS: Mapping[float, str] = MappingProxyType({
    -1.0: "of the opposite sign", 1.0 / DEGREE: "in degrees", DEGREE: "times pi/180", 2.0: "twice too large",
    1.0 / RPM: "in revolutions a minute", 1e3: "a thousand times too large", 1e-3: "a thousand times too small",
    0.0: "as zero",
})  # fmt: skip
"""Factors by which a whole quantity may be answered."""


def answered_by_factor(name: str, factor: float) -> Reading:
    """A quantity, "V_dot" or "points.twist", answered with a factor of FACTORS."""
    words = f"{name.removeprefix('points.')} answered {FACTORS[factor]}"
    return Reading(words, "answer", name, lambda x, at: factor * np.asarray(x))


READINGS: tuple[Reading, ...] = (
    *(Reading(f"quaternion {words}", "state", "quaternion", x) for words, x in QUATERNION.items()),
    Reading("attitude transposed: from E0 to E1", "all", "", lambda _, at: (
        at.stand, replace(at.s, angles=None, quaternion=quaternion_of(at.C.T)))),
    *(Reading(f"attitude angles {words}", "state", "angles", x) for words, x in ANGLES.items()),
    *(Reading(f"attitude angles in the {name} sequence", "stand", "angles", lambda _, at, name=name: name)  # type: ignore[misc]
      for name in ("ship", "aircraft", "euler")),
    *(Reading(f"attitude angles of the state alone in the {name} sequence", "all", "",
              lambda _, at, name=name: in_sequence(at, name))  # type: ignore[misc]
      for name in ("ship", "aircraft", "euler")),
    Reading("attitude angles about the axes in reverse order", "all", "", by_reversed_angles),
    Reading("position in mm", "state", "position", lambda x, at: 1e-3 * x),
    *(Reading(f"{keys.replace(' ', ' and ')} {words}", "state", keys, x)
      for words, x in SIXES.items() for keys in ("V", "V_dot", "V V_dot")),
    *(Reading(words, "state", "V", x) for words, x in TWIST.items()),
    Reading("V_dot read as the acceleration of O1", "state", "V_dot", lambda A, at: A - transport(at, at.s.V[:3])),
    *(Reading(f"run-time wrenches {words}", "wrench", "", x, "inputs") for words, x in SIXES.items()),
    *(Reading(words, "wrench", "", x, "inputs") for words, x in WRENCH.items()),
    *(Reading(f"{name} {words}", "state", keys, x, "flywheels")
      for words, x in OF_WHEELS.items() for name, keys in WHEELS.items()),
    Reading("torque of a flywheel in mN m", "state", "tau", lambda x, at: 1e-3 * x, "flywheels"),
    Reading("phase counted from the third axis", "state", "phi", lambda x, at: x - math.pi / 2, "flywheels"),
    *(Reading(f"{name} is taken as absolute, not relative to its mount", "state", key,
              lambda x, at, rate=rate: relative_to_mounts(x, at, rate), "flywheels")  # type: ignore[misc]
      for name, key, rate in (("speed of a flywheel", "phi_dot", "V"),
                              ("acceleration of a flywheel", "phi_ddot", "V_dot"))),
    *(Reading(f"{key} {words}", "stand", key, x) for key in ("gravity", "stream") for words, x in VECTORS.items()),
    *(Reading(f"angles of the suspension {words}", "all", "",
              lambda _, at, change=change: with_suspension(at, lambda a: change(a, at)))  # type: ignore[misc]
      for words, change in OF_SUSPENSION.items()),
    Reading("displacement of the suspension not turned into the axes of E1", "state", "position",
            unturned_displacement),
    *(Reading(f"{words} for the rotation vector of the suspension", "all", "",
              lambda _, at, change=change: with_rotation(at, change))  # type: ignore[misc]
      for words, change in OF_ROTATION.items()),
    Reading("damping and other wrenches of the fluid relative to E0, not to the stream", "all", "",
            damped_in_still_water, "bodies"),
    Reading("damping of the suspension relative to the stream, not to E0", "all", "", lambda _, at: with_suspended(
        at, lambda law: np.array(law.damping)[:, :3] @ pieces(at.stand, at.s).u)),
    *(Reading(f"buoyancy that does not turn into the axes of {name}", "all", "",
              lambda names, at, axes=axes: unturned_buoyancy(names, at, axes), "bodies")  # type: ignore[misc]
      for name, axes in (("the body", lambda at: E), ("E1", body_axes))),
    *(Reading(f"products of inertia{words} of the opposite sign", "body", "inertia",
              lambda J, at: J * (2.0 * E - 1.0), bodies) for words, bodies in PARTS.items()),
    Reading("inertia taken about the origin though it is about the centre of mass", "body", "",
            lambda k, at: replace(k, inertia_about="origin"), "bodies"),
    Reading("inertia taken about the centre of mass though it is about the origin", "body", "",
            lambda k, at: replace(k, inertia_about="center_of_mass"), "bodies"),
    *(Reading(f"inertia {words}", "body", "inertia", x, "bodies") for words, x in OF_INERTIA.items()),
    *(Reading(f"{name} {words}", "body", key, x, "bodies")
      for words, x in OF_PLACES.items() for name, key in PLACES.items()),
    *(Reading(words, "body", "", x, "flywheels") for words, x in MOUNTING.items()),
    *(Reading(f"{of}{part} {words}", "body", "", lambda k, at, of=of, C=C: with_turned_inertia(k, C(at), of), bodies)  # type: ignore[misc]
      for words, (only, C) in TURNED.items() for of in OF_TURNED for part, bodies in PARTS.items()
      if bodies == only or (not only and bodies != "fixed")),
    *(Reading(f"angles of an instrument {words}", "body", "angles", x, "instruments")
      for words, x in OF_INSTRUMENTS.items()),
    Reading("flywheels in reverse order, in states and answers", "all", "", lambda _, at: (
        replace(at.stand, flywheels=at.stand.flywheels[::-1]), at.s)),
    *(Reading(f"{key} answered in the reverse order of flywheels", "answer", key, lambda x, at: np.asarray(x)[::-1])
      for key in ("tau", "phi_ddot", "mount_wrench")),
    *(Reading(f"{name} {words}", "law", key, x) for words, x in OF_MATRICES.items() for name, key in MATRICES.items()),
    Reading("V V in place of V |V| in quadratic damping", "law", "quadratic", without_sense),
    Reading("products of added mass counted twice, in the derivatives and beside them", "all", "", with_products_twice),
    *(Reading(f"{key} answered {words}", "answer", key, x) for key in ("V_dot", "Z", "reaction")
      for words, x in (FIRST, ("in the axes of E0", lambda x, at: rotate(x, at.C)))),
    *(Reading(name, "answer", *answer) for name, answer in ANSWERED.items()),
)  # fmt: skip
"""Readings, in the order in which they are tried."""


def readings_of(stand: Stand) -> Iterator[Reading]:
    """Every reading that a stand may show: of all, then of single bodies."""
    parts = [row.of_parts(stand) for row in READINGS]
    yield from (first for first, *_ in filter(None, parts))
    yield from (part for row in parts for part in row[1:])


# -- numbers -----------------------------------------------------------------------------------------------------------

STEP = 1e-5
"""Part of the size of a number by which it is changed for a derivative."""

SMALL = 1e-2
"""Size of a number that is zero in the file, as all beside it are, SI."""

MOST = {1: 24, 2: 8}
"""Single numbers, and pairs of them, that are solved: those whose derivatives explain most."""

LIKELY = 0.5
"""Part of the error that the derivatives of two numbers must explain, for them to be solved."""

MOST_STEPS = 12

SLOW = 0.7
"""Part of what was left that a step may leave, for another one to follow."""

DEPENDENT = 1e-9
"""Square of the sine of two derivatives below which two numbers do the same."""


@dataclass(frozen=True)
class SolvedNumbers:
    """Values of some numbers with which the right equations are nearest to a program.

    left  of the error in units of scale, root mean square: what they leave, over all of it
    """

    values: Mapping[StandNumber, float]
    left: float


def pairs_explain(unit: Array, error: Array) -> Array:
    """Square (m, m) of what least squares by each two columns of unit length (n, m) explains of an error (n).

    Zero below the diagonal, on it, and where two columns are one.
    """
    b, G = unit.T @ error, unit.T @ unit
    apart = 1.0 - G**2
    with np.errstate(all="ignore"):
        explained = (b[:, None] ** 2 + b**2 - 2.0 * G * np.outer(b, b)) / apart
    return np.where(np.triu(apart > DEPENDENT, 1), np.nan_to_num(explained), 0.0)


class NumberSearch:
    """Numbers of one stand that explain an error, with the derivatives of the answers to some requests by each."""

    def __init__(
        self,
        stand: Stand,
        document: Mapping[str, Any],
        vector: AnswerVector,
        among: Collection[str],
        error: Array,
        noise: Array,
    ) -> None:
        """`document`: the keys of the stand's file; `among`: ids of the requests by which numbers are looked for.

        `error`: NaN where the program did not answer; `noise`: what of it may be rounding.
        """
        self._stand, self._vector, self._among = stand, vector, among
        self._file = StandNumbers(stand, document)
        self._slopes = dict[StandNumber, Array]()
        self._there = np.isfinite(error) & vector.places(among)
        self._noise, self._answered = noise[self._there], error + vector.expected
        self._error = error[self._there] / self._noise

    def model(self, values: Mapping[StandNumber, float]) -> Model:
        """The right equations with other numbers. Raises StandError: a stand cannot have them."""
        try:
            return Reference(read(self._file.with_values(values), self._stand.name, physics=False))
        except UsageError as error:
            raise StandError([str(error)]) from None

    def solutions(self, count: int) -> list[SolvedNumbers]:
        """Single numbers (count 1), or pairs that a stand can have, those that leave least of the error first."""
        slopes = [(number, self._slope(number)) for number in self._file]
        numbers, there = zip(*((number, slope) for number, slope in slopes if slope.any()), strict=True)
        unit = np.column_stack([slope / np.linalg.norm(slope) for slope in there])
        least = 0.0 if count == 1 else LIKELY * float(self._error @ self._error)
        explained = np.diag((unit.T @ self._error) ** 2) if count == 1 else pairs_explain(unit, self._error)
        order = np.argsort(-explained, axis=None, kind="stable")[: MOST[count]]
        places = [sorted({*divmod(int(k), len(numbers))}) for k in order if explained.flat[k] > least]
        solved = (self.solve([numbers[i] for i in pair]) for pair in places)
        possible = (x for x in solved if x is not None and (count == 1 or self._is_physical(x.values)))
        return sorted(possible, key=lambda solution: solution.left)

    def _is_physical(self, values: Mapping[StandNumber, float]) -> bool:
        """Whether there can be bodies with these numbers."""
        try:
            read(self._file.with_values(values), self._stand.name)
        except MahovikError:
            return False
        return True

    def explains(self, values: Mapping[StandNumber, float]) -> bool:
        """Whether numbers leave nothing of the error beyond rounding."""
        left = self._remainder(values)
        return left is not None and bool((np.abs(left) <= 1.0).all())

    def rounded(self, solved: SolvedNumbers) -> SolvedNumbers:
        """The same numbers with the fewest digits that explain the error."""
        values = dict(solved.values)
        for number, value in solved.values.items():
            for short_value in (0.0, *(float(f"{value:.{digits}g}") for digits in range(1, 16))):
                short = {**values, number: short_value}
                if self.explains(short):
                    values = short
                    break
        return SolvedNumbers(values, solved.left)

    def _slope(self, number: StandNumber) -> Array:
        """Derivative (n) of the answers by a number, over rounding; zero where there is none."""
        if number in self._slopes:
            return self._slopes[number]
        self._slopes[number] = np.zeros(self._error.size)
        size = max((abs(x) for x in (number.value, *np.ravel(number.whole or 0.0))), default=0.0) or SMALL
        for step in (STEP * size, -STEP * size):
            with suppress(StandError):
                moved = self._vector.of_model(self.model({number: number.value + step}), self._among)
                change = np.nan_to_num((moved - self._vector.expected) / step, nan=0.0)
                self._slopes[number] = change[self._there] / self._noise
                break
        return self._slopes[number]

    def _remainder(self, values: Mapping[StandNumber, float]) -> Array | None:
        """What numbers leave of the error, over rounding; None: a stand cannot have them."""
        try:
            left = (self._answered - self._vector.of_model(self.model(values), self._among))[self._there] / self._noise
        except StandError:
            return None
        return left if np.isfinite(left).all() else None

    def solve(self, numbers: Sequence[StandNumber]) -> SolvedNumbers | None:
        """Values of some numbers that leave least of the error; None where none leave less than all.

        Gauss-Newton with derivatives that are brought up to date by what each step changed (Broyden).
        """
        jacobian, rest = np.column_stack([self._slope(number) for number in numbers]), self._error
        at = np.array([number.value for number in numbers])
        size, best = 1.0, (1.0, at)
        whole = float(np.linalg.norm(rest)) or 1.0
        for k in range(MOST_STEPS):
            step = np.linalg.lstsq(jacobian, rest, rcond=None)[0]
            for _ in range(4):
                left = self._remainder(dict(zip(numbers, (at + step).tolist(), strict=True)))
                if left is not None:
                    break
                step = step / 4.0
            if left is None or not step.any():
                break
            change = rest - left
            jacobian = jacobian + np.outer(change - jacobian @ step, step) / float(step @ step)
            at, rest, before = at + step, left, size
            size = float(np.linalg.norm(rest)) / whole
            if size < best[0]:
                best = size, at
            if (np.abs(rest) <= 0.1).all() or (k > 1 and size > SLOW * before) or size > 10.0:
                break
        if best[0] >= 1.0:
            return None
        return SolvedNumbers(dict(zip(numbers, best[1].tolist(), strict=True)), best[0])
