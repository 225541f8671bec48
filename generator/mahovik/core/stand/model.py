"""The stand as validated raw data in SI: what the stand file says, nothing derived from it.

A class is a table of the file: its fields say how they are read, and which defaults they have (`declare`). No spatial
inertia, no transfer matrix and no rotation is built here: each derivation builds its own from these numbers, so that an
error in one cannot hide in all. All classes are frozen and hashable; vectors are tuples of floats, matrices tuples of
rows. Lengths m, masses kg, angles rad, forces N.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from decimal import Decimal
from types import MappingProxyType
from typing import Annotated, Any, ClassVar, Literal, Self, TypeVar

from mahovik.core.stand import units
from mahovik.core.stand.datasheet import FlywheelForm, Moments, MountingAngles, MountingAxes
from mahovik.core.stand.declare import Declared, Inside, Note, Warns
from mahovik.core.stand.fields import (
    ZERO3,
    ZERO6,
    AddedMass,
    Angle3,
    Direction,
    Flag,
    Inertia3,
    Length3,
    Mass,
    Mat6,
    Name,
    StandName,
    Text,
    Vec3,
    Vec6,
    Weight,
    integer,
    one_word,
    scalar,
    validator,
    vec3,
    vector,
    vector3,
)
from mahovik.core.stand.hold import TWIST_LETTERS, Freedom, FreedomKind, Hold
from mahovik.core.stand.motor import Motor
from mahovik.core.stand.profile import StreamProfile
from mahovik.core.stand.tables import Alias, Default, Table, TableError
from mahovik.core.stand.units import QuantityError, show
from mahovik.nearest import suggestion

Sequence = Literal["ship", "aircraft", "euler"]
About = Literal["origin", "center_of_mass"]
PhaseInput = Literal["angle", "sincos"]

Component = Literal["vx", "vy", "vz", "wx", "wy", "wz"]
COMPONENTS: tuple[Component, ...] = ("vx", "vy", "vz", "wx", "wy", "wz")
"""Components that a task may demand: of the acceleration (v.) and of the angular acceleration (w.)."""

INVERSE_MOST = 1e4
"""rad/s2: default of `inverse_most`."""

WRENCH_LETTERS = ("X", "Y", "Z", "K", "M", "N")


@dataclass(frozen=True)
class Law(Declared):
    """Raw data of one law of wrenches, LAW of the module `law` of its folder.

    key             its table in the file
    name, plural    in words; by default the key, and that with an s
    item            class of its tables, where the law is a list of tables [[key]]: its last field has them
    mounted         have they a name and a mount, the carrier or an instrument?
    carries_weight  can it carry a stand at rest?
    """

    key: ClassVar[str]
    name: ClassVar[str]
    plural: ClassVar[str]
    item: ClassVar[type[Declared] | None] = None
    mounted: ClassVar[bool] = False
    carries_weight: ClassVar[bool] = False

    def __init_subclass__(cls) -> None:
        if "key" in cls.__dict__:
            cls.name = cls.__dict__.get("name", cls.key)
            cls.plural = cls.__dict__.get("plural", f"{cls.name}s")

    @property
    def items(self) -> tuple[Any, ...]:
        """Its tables [[key]]."""
        result: tuple[Any, ...] = getattr(self, fields(self)[-1].name)
        return result

    @property
    def acts(self) -> bool:
        """False where it does nothing, so that a stand has no such law."""
        return self.item is None or bool(self.items)

    @classmethod
    def warnings(cls, stand: Stand) -> list[str]:
        """Lines of `check` on what is suspicious."""
        raise NotImplementedError

    @classmethod
    def short(cls, stand: Stand) -> str:
        """The law in a few words; empty where the stand does not have it."""
        raise NotImplementedError

    def negative_diagonals(self, where: str) -> Iterator[str]:
        """A warning of each matrix with what is negative on its diagonal; `where`: path of the law."""
        for name, warns in self.marked(Warns).items():
            rows = getattr(self, name) or ZERO6
            diagonal = [(letter, rows[i][i]) for i, letter in enumerate(TWIST_LETTERS)]
            negative = ", ".join(f"{value:.5g} for {letter}" for letter, value in diagonal if value < 0.0)
            if negative:
                yield f"{where}.{name} has {negative}: {warns.does}"

    @property
    def nonlinear(self) -> bool:
        """Whether a law of bodies is not linear in the body's twist."""
        return False

    @property
    def has_kinks(self) -> bool:
        """Whether its derivatives jump, as those of a law of bodies that depends on magnitudes of the twist."""
        return False

    @property
    def is_round(self) -> bool:
        """Whether the wrench of a law of bodies is the same at every phase of a flywheel about its first axis."""
        return False

    @property
    def inputs(self) -> dict[str, float]:
        """Numbers of a law of bodies that may be set at run time, "rudder.deflection", in the order of the table."""
        return {}

    @property
    def displaced(self) -> tuple[float, Vec3] | None:
        """Mass (kg) of the fluid that a body displaces by a law of bodies, and its centre in the body's frame."""
        return None

    @property
    def matrices(self) -> dict[str, Mat6]:
        """Matrices of a law of bodies in which the equations are linear, by name."""
        return {}

    @property
    def rows(self) -> tuple[int, ...] | None:
        """Components that its wrench on the carrier can have, in E1 about O1; None where any."""
        return None


AnyLaw = TypeVar("AnyLaw", bound=Law)


@dataclass(frozen=True)
class WithLaws:
    """What laws of wrenches act on: the stand by those between E0 and the carrier, a body by its own. See `law`."""

    laws: tuple[Law, ...] = field(default=(), kw_only=True)

    def law(self, kind: type[AnyLaw]) -> AnyLaw | None:
        """The data of one law; None where it does not act."""
        return next((law for law in self.laws if isinstance(law, kind)), None)

    def with_laws(self, *laws: Law) -> Self:
        """A copy with these laws instead of its own of the same kinds."""
        kinds = {type(law): law for law in (*self.laws, *laws)}
        return replace(self, laws=tuple(kinds.values()))

    def without_laws(self, *kinds: type[Law]) -> Self:
        """A copy without some kinds of law; with no kind named, without any."""
        return replace(self, laws=tuple(law for law in self.laws if kinds and not isinstance(law, kinds)))


def _about(table: Any, note: Note) -> About:
    """Point that the inertia is about; if the centre of mass is the origin, the key may be left out."""
    if table.inertia_about is None and any(table.center_of_mass):
        note("inertia_about", 'required where center_of_mass is not zero, expected "origin" or "center_of_mass"')
    about: About = table.inertia_about or "origin"
    return about


@dataclass(frozen=True)
class Body(WithLaws, Declared):
    """What carrier, instruments and flywheels have in common, in the body's own frame.

    name            a C identifier, different from the names of other bodies and points
    mass            of the body
    center_of_mass  from the origin of the body's frame
    inertia         tensor in the body's axes, `J12 = -int(x y)`: symmetric 3x3, or its diagonal
    inertia_about   point that `inertia` is about; required where `center_of_mass` is not zero
    wrench_input    `true`: the C takes a wrench on this body at run time
    laws            data of the laws that act on it in its own frame, weight aside
    """

    name: Name
    mass: Mass
    center_of_mass: Annotated[Length3, Default(ZERO3)]
    inertia: Inertia3
    inertia_about: Annotated[
        About, one_word({"origin": "origin", "center_of_mass": "center_of_mass"}), Default(None)
    ]  # fmt: skip
    wrench_input: Annotated[Flag, Default(False, written=False)]

    @property
    def inputs(self) -> dict[str, float]:
        """Numbers of its laws that may be set at run time, by name: "rudder.deflection", rad; "screw.speed", rad/s."""
        return {name: value for law in self.laws for name, value in law.inputs.items()}

    @property
    def displaced(self) -> list[tuple[float, Vec3]]:
        """Mass (kg) and centre, in its frame, of the fluid that it displaces, by each law of its own that says so."""
        return [displaced for law in self.laws if (displaced := law.displaced) is not None]

    @classmethod
    def read(cls, table: Any, note: Note, moments: Moments, **more: Any) -> Self | None:
        """The data of a valid table, and notes on it; None where something is not known. `moments`: as in the file."""
        return cls.of_table(table, inertia_about=_about(table, note), **more)

    def as_keys(self) -> dict[str, Any]:
        """Its keys in a stand file, in SI, those of its laws among them."""
        return super().as_keys() | {law.key: law.as_keys() for law in self.laws if not law.mounted}


@dataclass(frozen=True)
class Carrier(Body):
    """The carrier E1; its `name` is "carrier".

    added_mass  of the fluid, symmetric 6x6 about `O1` in `E1` axes
    """

    name: str
    added_mass: Annotated[AddedMass, Default(None)]


@dataclass(frozen=True)
class Instrument(Body):
    """A body Ep fixed on the carrier.

    position    of its origin `Op`, in `E1`
    angles      psi, theta, phi of its axes `C3 C2 C1`
    added_mass  about `O1` in `E1` axes, as for the carrier
    """

    mass: Annotated[Mass, Default(0.0)]
    inertia: Annotated[Inertia3, Default((ZERO3, ZERO3, ZERO3))]
    position: Annotated[Length3, Default(ZERO3)]
    angles: Annotated[Angle3, Default(ZERO3)]
    added_mass: Annotated[AddedMass, Default(None)]


def _counts(raw: Any) -> int:
    if integer(raw) == 0:
        raise QuantityError("expected at least 1 count per turn, found 0")
    return int(raw)


@dataclass(frozen=True)
class Encoder(Declared):
    """Encoder of a flywheel.

    counts   counts per turn, not 0; negative: the count falls as `phi_s` rises
    zero     count at `phi_s = 0`
    latency  age of a reading
    """

    counts: Annotated[int, validator(_counts)]
    zero: Annotated[float, scalar(units.PLAIN), Default(0.0)]
    latency: Annotated[float, scalar(units.TIME, least=0.0), Default(0.0)]


@dataclass(frozen=True)
class Flywheel(Body):
    """A flywheel Es, spinning about its own first axis.

    mount           the carrier, or the name of an instrument
    position        of its origin `Os`, which lies on the axis, in the frame of its mount
    motor           limits, losses and friction of its drive
    encoder         how its phase is measured
    inverse_weight  its weight in the norm of accelerations that `inverse` makes least
    """

    inertia: Annotated[Inertia3, Default(None)]
    mount: Annotated[Text, Default("carrier")]
    position: Annotated[Length3, Default(ZERO3)]
    mounting: MountingAngles | MountingAxes
    motor: Annotated[Motor | None, Inside(Motor), Default(None)]
    encoder: Annotated[Encoder | None, Inside(Encoder), Default(None)]
    inverse_weight: Annotated[Weight, Default(1.0, written=False)] = 1.0

    keys: ClassVar[type[Table]] = FlywheelForm

    @classmethod
    def read(cls, table: Any, note: Note, moments: Moments, **more: Any) -> Self | None:
        """The data of a valid table, and notes on it; None where its mounting or its inertia is not known."""
        masses = table.masses(note, moments)
        if masses is None:
            table.mounting(note, lambda: "its unbalance")
            return None
        about = {} if masses else {"inertia_about": _about(table, note)}
        wheel = cls.of_table(table, mounting=MountingAngles(0.0, 0.0, 0.0), **masses, **about, **more)
        mounting = table.mounting(note, wheel.first_phase_dependence)
        return None if mounting is None else replace(wheel, mounting=mounting)

    def first_phase_dependence(self) -> str:
        """What of its mass, inertia and wrenches is not the same at every phase; empty where all is."""
        (_, y, z), J = self.center_of_mass, self.inertia
        if self.mass and (y or z):
            return "its centre of mass off the axis"
        if J[0][1] or J[0][2] or J[1][2] or J[1][1] != J[2][2]:
            return "its inertia"
        if self.wrench_input:
            return "its run-time wrench"
        return next((f"its {law.key}" for law in self.laws if not law.is_round), "")

    def as_keys(self) -> dict[str, Any]:
        """Its keys in a stand file, in SI."""
        at = self.mounting
        if isinstance(at, MountingAngles):
            return super().as_keys() | {"angles": [at.psi, at.theta, at.zero]}
        return super().as_keys() | {"axis": list(at.axis), "zero": list(at.zero)}


@dataclass(frozen=True)
class Point(Declared):
    """A sensor or place of interest.

    name      a C identifier, different from the names of bodies
    mount     the carrier, or the name of an instrument
    position  in the frame of its mount
    angles    psi, theta, phi of its axes `C3 C2 C1`
    """

    name: Name
    mount: Annotated[Text, Default("carrier")]
    position: Annotated[Length3, Default(ZERO3)]
    angles: Annotated[Angle3, Default(ZERO3)]


@dataclass(frozen=True)
class TaskRow:
    """One demanded component: of O1 where `of` is "" (derivative of a component of V, in E1).

    Else of the point or instrument `of`: its acceleration or angular acceleration relative to E0, in its own axes.
    """

    of: str
    component: Component


def _component(raw: Any) -> Component:
    for known in COMPONENTS:
        if raw == known:
            return known
    if not isinstance(raw, str):
        raise QuantityError(f"expected one of {', '.join(COMPONENTS)}, found {show(raw)}")
    raise QuantityError(f"unknown component {show(raw)}{suggestion(raw, COMPONENTS)}")


def _items(raw: Any, read: Callable[[Any], Any]) -> Iterator[Any]:
    """The items of a list that is not empty, each read; QuantityError names the place."""
    if not isinstance(raw, list) or not raw:
        shown = "an empty list" if isinstance(raw, list) else show(raw)
        raise QuantityError(f'expected a list of rows such as ["wx", "wy", "wz"], found {shown}')
    for i, item in enumerate(raw):
        try:
            yield read(item)
        except QuantityError as error:
            raise QuantityError(f"[{i}]: {error}") from None


def _rows(raw: Any) -> tuple[TaskRow, ...]:
    return tuple(row for rows in _items(raw, _rows_of_item) for row in rows)


def _rows_of_item(raw: Any) -> tuple[TaskRow, ...]:
    """One component of O1, or some of a point: { point = "camera", rows = ["wx", "wy"] }."""
    if not isinstance(raw, dict):
        return (TaskRow("", _component(raw)),)
    keys = ("point", "rows")
    unknown = [key for key in raw if key not in keys]
    if unknown:
        raise QuantityError(f"unknown key {show(unknown[0])}{suggestion(unknown[0], keys)}")
    for key in keys:
        if key not in raw:
            raise QuantityError(f'{key} is missing, expected {{ point = "NAME", rows = [...] }}')
    if not isinstance(raw["point"], str):
        raise QuantityError(f"point: expected the name of a point or an instrument, found {show(raw['point'])}")
    try:
        return tuple(TaskRow(raw["point"], component) for component in _items(raw["rows"], _component))
    except QuantityError as error:
        where = "rows" if str(error).startswith("[") else "rows: "
        raise QuantityError(f"{where}{error}") from None


def _rows_in_file(rows: tuple[TaskRow, ...]) -> list[Any]:
    return [{"point": row.of, "rows": [row.component]} if row.of else row.component for row in rows]


@dataclass(frozen=True)
class Task(Declared):
    """Components of the carrier's motion that are demanded together; what no row names is free.

    rows  one to six components, in any mixture of the rows below
    """

    name: str
    rows: Annotated[tuple[TaskRow, ...], validator(_rows, write=_rows_in_file, shape="list")]


def _gravity(raw: Any) -> Vec3:
    """Three numbers, or 0 for none at all."""
    is_zero = isinstance(raw, int | Decimal) and not isinstance(raw, bool) and raw == 0
    return ZERO3 if is_zero else vec3(raw, units.ACCELERATION)


_SEQUENCES: Mapping[str, Sequence] = {
    "ship": "ship", "zyx": "ship", "aircraft": "aircraft", "yzx": "aircraft", "euler": "euler", "zxz": "euler",
}  # fmt: skip


def _schema(raw: Any) -> int:
    if integer(raw) != 1:
        raise QuantityError(f"unknown version {raw}, this program reads schema 1")
    return 1


class _WithSchema(Table):
    """The version of the format.

    schema  version of the format, 1
    """

    schema_: Annotated[int, validator(_schema), Alias("schema")]


@dataclass(frozen=True)
class Header(Declared):
    """The keys of a stand outside any table.

    name          a C identifier that begins with a letter: every generated name begins with it
    angles        sequence of the attitude angles: `"ship"` is `"zyx"`, `"aircraft"` is `"yzx"`, `"euler"` is `"zxz"`
    gravity       in `E0`; 0 is short for `[0, 0, 0]`
    stream        uniform steady velocity of the fluid, in `E0`; where the key is present, even zero, the C has a stream
    phase_input   `"sincos"`: functions of the C take sines and cosines of the phases as well
    inverse_most  acceleration of a flywheel without motor above which an answer of `inverse` is `EXCESSIVE`
    """

    name: StandName
    angles: Annotated[
        Sequence,
        one_word(_SEQUENCES, '"ship" (or "zyx"), "aircraft" ("yzx") or "euler" ("zxz")'), Default("ship"),
    ]  # fmt: skip
    gravity: Annotated[Vec3, validator(_gravity, units.ACCELERATION), Default(ZERO3)]
    stream: Annotated[Vec3 | None, vector3(units.VELOCITY), Default(None)]
    phase_input: Annotated[
        PhaseInput, one_word({"angle": "angle", "sincos": "sincos"}), Default("angle", written=False)
    ]  # fmt: skip
    inverse_most: Annotated[
        float, scalar(units.ANGULAR_ACCELERATION, above=0.0), Default(INVERSE_MOST, written=False)
    ]  # fmt: skip

    keys: ClassVar[type[Table]] = _WithSchema


@dataclass(frozen=True)
class Stand(WithLaws):
    """A whole stand. `stream` is None where the file has no such key; bodies are in the file's order.

    `laws`: data of the laws between E0 and the carrier that the stand has.
    `phase_input`: "sincos" where functions of the C take sines and cosines of the phases as well.
    `inverse_most`: rad/s2, phi'' of a flywheel without motor above which an answer of `inverse` is EXCESSIVE.
    `hold`: what holds the carrier; None where it is free.
    `profile`: what the depth of O1 adds to `stream`, which is then not None; None where nothing.
    """

    name: str
    angles: Sequence
    gravity: Vec3
    stream: Vec3 | None
    carrier: Carrier
    instruments: tuple[Instrument, ...]
    flywheels: tuple[Flywheel, ...]
    points: tuple[Point, ...]
    phase_input: PhaseInput = "angle"
    tasks: tuple[Task, ...] = ()
    inverse_most: float = INVERSE_MOST
    hold: Hold | None = None
    profile: StreamProfile | None = None

    @property
    def bodies(self) -> tuple[Body, ...]:
        """Carrier, instruments, flywheels, in this order."""
        return (self.carrier, *self.instruments, *self.flywheels)

    @property
    def has_kinks(self) -> bool:
        """Whether a law of any body, or one between E0 and the carrier, has derivatives that jump."""
        return any(law.has_kinks for bearer in (self, *self.bodies) for law in bearer.laws)

    def __repr__(self) -> str:
        parts = {"instrument": self.instruments, "flywheel": self.flywheels, "point": self.points}
        counts = ", ".join(f"{len(all_)} {noun}{'' if len(all_) == 1 else 's'}" for noun, all_ in parts.items() if all_)
        return f"<Stand {self.name}: {counts or 'a rigid body'}>"


# -- a state, and the facts that decide the C -------------------------------------------------------------------------

Quaternion = tuple[float, float, float, float]


@dataclass(frozen=True)
class State:
    """State and inputs. At most one of `angles`, `quaternion` is set; neither: the carrier is aligned with E0.

    position    of O1 in E0, m
    angles      psi, theta, phi of the stand's sequence, rad
    quaternion  w first, of x0 = C x1; unit length to rounding (it was normalised where it was read)
    V, V_dot    twist of the carrier relative to E0 in E1, linear part first; V_dot: derivative of its components
    phi, phi_dot, phi_ddot   flywheel phases, speeds, accelerations, one each, rad
    tau         drive torques, one per flywheel, N m
    wrench      run-time wrench by body name, in the body's own frame about its origin (a flywheel's turns with phi_s)
    task        name of a task of the stand whose rows are demanded in place of V_dot; "" for none
    demand      what it demands, one a row, m/s2 or rad/s2
    actuators   deflections of fins (rad) and speeds of propellers (rad/s) by name, in place of those of the file
    u, u_dot    speeds of the freedoms of a held carrier and their rates, m each, in place of V, V_dot
    """

    position: Vec3
    angles: Vec3 | None
    quaternion: Quaternion | None
    V: Vec6
    phi: tuple[float, ...]
    phi_dot: tuple[float, ...]
    phi_ddot: tuple[float, ...]
    V_dot: Vec6
    tau: tuple[float, ...]
    wrench: Mapping[str, Vec6] = field(default_factory=lambda: MappingProxyType({}))
    task: str = ""
    demand: tuple[float, ...] = ()
    u: tuple[float, ...] = ()
    u_dot: tuple[float, ...] = ()
    actuators: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))


def rest_state(stand: Stand) -> State:
    """The state in which every input of `stand` is zero and the carrier is aligned with E0."""
    zeros = (0.0,) * len(stand.flywheels)
    zero6: Vec6 = (0.0,) * 6
    free = (0.0,) * (len(stand.hold.freedoms) if stand.hold is not None else 0)
    return State((0.0, 0.0, 0.0), None, None, zero6, zeros, zeros, zeros, zero6, zeros, u=free, u_dot=free)


@dataclass(frozen=True)
class Structure:
    """Two stands of equal structure have the same C but for numbers.

    A body's index is its place in `Stand.bodies`: 0 the carrier, then instruments, then flywheels.
    Fixed bodies (carrier, instruments) add up to constants, so for weight and added mass only whether
    there is any counts.
    """

    name: str
    angles: Sequence
    instruments: tuple[str, ...]
    flywheels: tuple[str, ...]
    flywheel_mounts: tuple[int, ...]
    """Body index of each flywheel's mount."""
    points: tuple[str, ...]
    point_mounts: tuple[int, ...]
    weight: bool
    """Gravity is not zero."""
    stream: bool
    """The file has the key `stream` (its value may be zero: it is an input of the C)."""
    added_mass: bool
    wrench_inputs: tuple[int, ...]
    phase_input: PhaseInput
    """"sincos": functions that take sines and cosines of the phases are there as well."""
    tasks: tuple[Task, ...] = ()
    hold: tuple[str, ...] | None = None
    """Freedoms of a held carrier, by their names in FREEDOMS or as turn, slide, twist; None where it is free."""
    motor_points: int = 0
    """Most points of a motor's curve of torque by speed, mirrored; 0 where no motor has one."""
    stream_stations: int = 0
    """Depths of the profile of the stream; 0 where it is uniform."""
    laws: tuple[tuple[str, Any], ...] = ()
    """Facts of the laws of `laws/`, by key."""

    def law(self, key: str) -> Any:
        """Fact of a law under one of its keys; None if no law has the key."""
        return dict(self.laws).get(key)

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names by body index."""
        return ("carrier", *self.instruments, *self.flywheels)
