"""The variables of an FMU of a stand: names, units, start values, ranges, and on what each depends."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.lower import stream, units
from mahovik.core.lower.law import BodyProgram
from mahovik.core.lower.layout import OF_HOLD, Layout
from mahovik.core.lower.limits import limits
from mahovik.core.lower.units import Member, Unit, matrix, members, vector
from mahovik.core.lower.values import Values
from mahovik.core.program.types import Field, Struct, member
from mahovik.core.stand.hold import freedom_names, freedom_words, numbered_freedoms
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Stand

Kind = Literal["cs", "me"]
Inputs = Literal["torque", "acceleration"]

_QUATERNION = "wxyz"

_RANGES = {
    "stream[": "MAX_VELOCITY",
    "stream_profile.top[": "MAX_VELOCITY",
    "stream_profile.depth[": "MAX_POSITION",
    "stream_profile.shear[": "MAX_SPEED",
}
"""Beginnings of names of laws that have a range of their own."""


@dataclass(frozen=True)
class Variable:
    """A scalar variable. Its value reference is its place among all.

    start         None where it is calculated
    least, most   the range that is accepted; None where nothing is set
    derivative    of which state it is the derivative: its name
    depends       names of states and inputs that it depends on; None: on whatever there is
    direct        does it depend on nothing else, of parameters and laws as well?
    shown         is it in the description? What only the other kind of FMU has keeps its place, unseen
    """

    name: str
    unit: Unit
    description: str
    causality: Literal["independent", "input", "output", "parameter", "local"] = "output"
    variability: Literal["continuous", "tunable", "fixed"] = "continuous"
    start: float | None = None
    least: float | None = None
    most: float | None = None
    derivative: str | None = None
    depends: tuple[str, ...] | None = None
    direct: bool = False
    shown: bool = True


@dataclass(frozen=True)
class Group:
    """Variables side by side: the first value reference and how many."""

    name: str
    first: int
    count: int
    comment: str

    @property
    def end(self) -> int:
        """The value reference behind the last."""
        return self.first + self.count


@dataclass(frozen=True)
class Form:
    """All variables of an FMU in the order of their value references, and the groups that they come in."""

    kind: Kind
    inputs: Inputs
    variables: tuple[Variable, ...]
    groups: dict[str, Group] = field(default_factory=dict)

    def group(self, name: str) -> tuple[Variable, ...]:
        """The variables of a group."""
        group = self.groups[name]
        return self.variables[group.first : group.end]


@dataclass(frozen=True)
class Start:
    """An initial state: attitude as a quaternion, w first."""

    position: Sequence[float]
    attitude: Sequence[float]
    V: Sequence[float]
    phi: Sequence[float]
    phi_dot: Sequence[float]


# -- measured numbers, in the order of the structs that hold them -----------------------------------------------------


def parameters(stand: Stand, layout: Layout, values: Values) -> Iterator[Member]:
    """All reals of `parameters`, depth first."""
    named = {
        "instrument": [p.name for p in stand.instruments],
        "flywheel": [s.name for s in stand.flywheels],
        "point": [p.name for p in stand.points],
    }
    numbers = values.parameters
    for f in layout.parameters.fields:
        if f.name == "added_mass":
            yield from matrix("added_mass", f, numbers[f.name], units.added_mass, "added mass Lambda, about O1 in E1")
        elif f.name == "carrier":
            assert isinstance(f.type, Struct)
            yield from members("carrier", f.type, numbers[f.name])
        else:
            assert isinstance(f.type, Struct)
            for name, value in zip(named[f.name], numbers[f.name], strict=True):
                yield from members(name, f.type, value)


def measured_laws(layout: Layout) -> list[Field]:
    """Members of the table that are laws with numbers of their own: not those of a hold."""
    return [f for f in layout.laws if f.name not in OF_HOLD]


def laws(stand: Stand, layout: Layout, values: Values) -> Iterator[Member]:
    """All reals of the table that `prepare` does not touch, depth first."""
    table = values.table
    of_arrays = {law.array: law for law in parts("program", BodyProgram, BODY_LAWS)}
    for k, local_body in enumerate(layout.local_bodies if layout.local_damped else ()):
        assert layout.frame.field("damper") is not None
        name = stand.bodies[local_body.index].name
        yield from _damper_members(name, layout, member(member(table, "frame")[k], "damper"))
    for f in measured_laws(layout):
        value = member(table, f.name)
        if f.name in ("gravity", "stream"):
            what = {"gravity": "gravity in E0", "stream": "velocity of the fluid in E0"}[f.name]
            yield from vector(f.name, f, value, what)
        elif f.name == stream.NAME:
            yield from stream.members(value)
        elif f.name == "damper":
            yield from _damper_members("carrier", layout, value)
        elif f.name in of_arrays:
            yield from of_arrays[f.name].members(stand, f, value)
        else:
            law = next(law for law in layout.law_tables if f in law.fields(layout.structure))
            yield from law.members(stand, f, value)


def _damper_members(body: str, layout: Layout, value: Any) -> Iterator[Member]:
    """All reals of one damper."""
    for law in parts("program", BodyProgram, BODY_LAWS):
        of_law = Struct(layout.damper.name, "", tuple(law.damper_fields(layout.structure)))
        yield from law.damper_members(body, of_law, value)


# -- all variables -----------------------------------------------------------------------------------------------------


def form(stand: Stand, layout: Layout, values: Values, kind: Kind, inputs: Inputs, dt: float, start: Start) -> Form:
    """The variables of a stand's FMU. `dt` is the longest step inside, s, of co-simulation."""
    return _Former(stand, layout, values, kind, inputs, dt, start).form()


def several(name: str, kinds: Sequence[Unit], texts: Sequence[str], **rest: Any) -> list[Variable]:
    """name[1], name[2], ..."""
    rows = zip(kinds, texts, strict=True)
    return [Variable(f"{name}[{i}]", unit, text, **rest) for i, (unit, text) in enumerate(rows, 1)]


def components(text: str, letters: str = "123") -> list[str]:
    """What each component is."""
    return [f"{text}, component {letter}" for letter in letters]


class _Former:
    """Collects the groups one after the other: what is calculated depends on variables of groups before."""

    def __init__(
        self, stand: Stand, layout: Layout, values: Values, kind: Kind, inputs: Inputs, dt: float, start: Start
    ) -> None:
        self._stand, self._layout, self._values = stand, layout, values
        self._kind, self._inputs, self._dt, self._start = kind, inputs, dt, start
        self._most = {name: limit.value for name, limit in limits(layout.precision).items()}
        self._names = [s.name for s in stand.flywheels]
        self._variables: list[Variable] = []
        self._groups: dict[str, Group] = {}

    def form(self) -> Form:
        rows: tuple[tuple[str, str, Callable[[], Iterable[Variable]]], ...] = (
            ("TIME", "simulation time", self._time),
            ("DRIVE", "what drives the flywheels", self._drive),
            ("WRENCH", "run-time wrenches, six numbers a body", self._wrenches),
            ("STATE", "members of the state, as its struct has them", self._states),
            ("STEP", "longest step inside", self._steps),
            ("PARAMETERS", "what prepare makes the table of", self._parameters),
            ("LAWS", "laws of the table", self._laws),
            ("RATES", "rates of the state; the first that is calculated", self._rates),
            ("TORQUE", "drive torques, where accelerations are given", self._torques),
            ("MOMENTA", "energy, momentum in E0, centre of mass", self._momenta),
            ("READINGS", "of instruments and points", self._readings),
            ("LOADS", "wrenches of the mounts", self._loads),
            ("REACTION", "wrench of the hold", self._reaction),
            ("COORDINATES", "of the freedoms of the hold", self._coordinates),
        )
        for name, comment, variables in rows:
            first = len(self._variables)
            self._variables += list(variables())
            self._groups[name] = Group(name, first, len(self._variables) - first, comment)
        return Form(self._kind, self._inputs, tuple(map(self._by_kind, self._variables)), self._groups)

    def _by_kind(self, variable: Variable) -> Variable:
        """Co-simulation shows no derivatives: what depends on a state depends on inputs alone, one after another."""
        if self._kind == "me":
            return variable
        inputs = self._inputs_before()
        depends = None if variable.depends is None else tuple(n for n in variable.depends if n in inputs)
        return replace(
            variable, derivative=None, depends=depends, shown=variable.shown and not variable.name.startswith("der(")
        )

    def _of(self, name: str) -> list[Variable]:
        group = self._groups[name]
        return self._variables[group.first : group.end]

    # -- what is set ---------------------------------------------------------------------------------------------------

    def _time(self) -> Iterator[Variable]:
        yield Variable("time", units.SECOND, "simulation time", "independent")

    def _drive(self) -> Iterator[Variable]:
        symbol, unit, most = "tau", units.TORQUE, "MAX_WRENCH"
        text = "drive torque tau, mount on flywheel, about the spin axis"
        if self._inputs == "acceleration":
            symbol, unit, most = "phi_ddot", units.ANGULAR_ACCELERATION, "MAX_ACCELERATION"
            text = "acceleration phi_ddot relative to the mount"
        for name in self._names:
            yield Variable(f"{name}.{symbol}", unit, f"{name}: {text}", "input", **self._range(most), start=0.0)

    def _wrenches(self) -> Iterator[Variable]:
        for name in self._layout.inputs:
            texts = [f"{name}: run-time wrench {c}, in its own frame about its origin" for c in WRENCH_LETTERS]
            yield from several(
                f"{name}.wrench", units.WRENCH, texts, causality="input", **self._range("MAX_WRENCH"), start=0.0
            )

    def _range(self, limit: str) -> dict[str, Any]:
        most = self._most[limit]
        return {"least": -most, "most": most}

    def _states(self) -> Iterator[Variable]:
        start, names, most = self._start, self._names, self._most
        attitude = [f"attitude of E1 in E0, unit quaternion, {c}: x0 = C x1" for c in _QUATERNION]
        twist = [f"twist V of the carrier relative to E0, {c}, in E1 about O1" for c in TWIST_LETTERS]
        speed = "speed phi_dot relative to the mount"
        states = [
            *several("carrier.position", (units.METRE,) * 3, components("position of O1 in E0")),
            *several("carrier.attitude", (units.NONE,) * 4, attitude),
            *several("carrier.V", units.TWIST, twist),
            *(Variable(f"{name}.phi", units.RADIAN, f"{name}: phase, all turns counted") for name in names),
            *(Variable(f"{name}.phi_dot", units.ANGULAR_VELOCITY, f"{name}: {speed}") for name in names),
        ]
        ranges = [most["MAX_POSITION"]] * 3 + [2.0] * 4 + [most["MAX_VELOCITY"]] * 3 + [most["MAX_SPEED"]] * 3
        ranges += [most["MAX_PHASE"]] * len(names) + [most["MAX_SPEED"]] * len(names)
        values = (*start.position, *start.attitude, *start.V, *start.phi, *start.phi_dot)
        for state, value, limit in zip(states, values, ranges, strict=True):
            yield replace(state, start=float(value), depends=(state.name,), least=-limit, most=limit)

    def _steps(self) -> Iterator[Variable]:
        if self._kind == "cs":
            text = "longest step of the Runge-Kutta method (fourth order) inside; a communication step has equal ones"
            most = self._most["MAX_STEP"]
            yield Variable("dt", units.SECOND, text, "parameter", "tunable", self._dt, least=1e-9, most=most)

    def _parameters(self) -> Iterator[Variable]:
        return map(self._measured, parameters(self._stand, self._layout, self._values))

    def _laws(self) -> Iterator[Variable]:
        return map(self._measured, laws(self._stand, self._layout, self._values))

    def _measured(self, member: Member) -> Variable:
        limit = next((of for name, of in _RANGES.items() if member.name.startswith(name)), "MAX_PARAMETER")
        bounds = self._range(limit) | ({"least": 0.0} if member.positive else {})
        return Variable(member.name, member.unit, member.description, "parameter", "tunable", member.value, **bounds)

    # -- what is calculated --------------------------------------------------------------------------------------------

    def _inputs_before(self) -> tuple[str, ...]:
        return tuple(v.name for name in ("DRIVE", "WRENCH") for v in self._of(name))

    def _state_names(self, *prefixes: str) -> tuple[str, ...]:
        """Names of states of these beginnings."""
        return tuple(v.name for v in self._of("STATE") if v.name.startswith(prefixes))

    def _moving(self, attitude: bool = False) -> tuple[str, ...]:
        """What accelerations depend on: speeds and phases, inputs, and the pose where a law of wrenches takes it."""
        layout = self._layout
        names = self._inputs_before()
        if layout.structure.stream_stations or any(law.placed for law in layout.law_tables):
            names += self._state_names("carrier.position")
        if attitude or layout.attitude_needed:
            names += self._state_names("carrier.attitude")
        return names + self._state_names("carrier.V[") + self._turning()

    def _turning(self) -> tuple[str, ...]:
        return tuple(f"{name}.{symbol}" for symbol in ("phi", "phi_dot") for name in self._names)

    def _rates(self) -> Iterator[Variable]:
        states, attitude, V = self._of("STATE"), self._state_names("carrier.attitude"), self._state_names("carrier.V[")
        texts = components("velocity of O1 in E0")
        texts += components("rate of the quaternion, drawn to unit length", "1234")
        for i, (state, text) in enumerate(zip(states, texts, strict=False)):
            unit, twist = (units.VELOCITY, V[:3]) if i < 3 else (units.RATE, V[3:])
            yield self._rate(state.name, unit, text, attitude + twist)
        for i, state in enumerate(states[7:13]):
            text = f"derivative V_dot of the components of V, {TWIST_LETTERS[i]}*, in E1, by (8)"
            name = f"carrier.V_dot[{i + 1}]"
            yield Variable(name, units.TWIST_RATE[i], text, derivative=state.name, depends=self._moving())
        for name in self._names:
            yield self._rate(f"{name}.phi", units.ANGULAR_VELOCITY, f"{name}: phi_dot", (f"{name}.phi_dot",))
        for name in self._names:
            speed, unit = f"{name}.phi_dot", units.ANGULAR_ACCELERATION
            if self._inputs == "torque":
                text = f"{name}: acceleration phi_ddot relative to the mount, of the coupled equations"
                yield Variable(f"{name}.phi_ddot", unit, text, derivative=speed, depends=self._moving())
            else:
                yield self._rate(speed, unit, f"{name}: acceleration phi_ddot", (f"{name}.phi_ddot",))

    @staticmethod
    def _rate(state: str, unit: Unit, text: str, depends: tuple[str, ...]) -> Variable:
        return Variable(f"der({state})", unit, text, "local", derivative=state, depends=depends, direct=True)

    def _torques(self) -> Iterator[Variable]:
        for name in self._names if self._inputs == "acceleration" else ():
            text = f"{name}: drive torque tau that the motion needs, mount on flywheel, about the spin axis"
            yield Variable(f"{name}.tau", units.TORQUE, text, depends=self._moving())

    def _momenta(self) -> Iterator[Variable]:
        pose, turning = self._state_names("carrier.position", "carrier.attitude"), self._turning()
        moving = self._state_names("carrier.attitude", "carrier.V[") + turning
        yield Variable("energy", units.ENERGY, "kinetic energy of all bodies", depends=moving)
        parts = ["linear"] * 3 + ["angular"] * 3
        texts = [f"momentum screw of all bodies in E0 about its origin, {part} part, (1)" for part in parts]
        depends = pose + self._state_names("carrier.V[") + turning
        yield from several("momentum", units.MOMENTUM_SCREW, texts, depends=depends)
        phases = turning[: len(self._names)]
        texts = components("centre of mass of all bodies in E1")
        yield from several("center_of_mass", (units.METRE,) * 3, texts, depends=phases)

    def _readings(self) -> Iterator[Variable]:
        attitude, V = self._state_names("carrier.attitude"), self._state_names("carrier.V[")
        position, moving = self._state_names("carrier.position"), self._moving(attitude=True)
        for name in self._layout.sensors:
            at = f"{name}.reading"
            texts = components(f"{name}: position in E0")
            yield from several(f"{at}.position", (units.METRE,) * 3, texts, depends=position + attitude)
            for place in (f"{i},{j}" for i in range(1, 4) for j in range(1, 4)):
                text = f"{name}: own axes to E0, element {place}"
                yield Variable(f"{at}.C[{place}]", units.NONE, text, depends=attitude)
            texts = [f"{name}: twist relative to E0, {c}, in own axes; a gyro reads p, q, r" for c in TWIST_LETTERS]
            yield from several(f"{at}.twist", units.TWIST, texts, depends=V)
            texts = components(f"{name}: acceleration minus gravity, in own axes: the accelerometer's reading")
            yield from several(f"{at}.specific_force", (units.ACCELERATION,) * 3, texts, depends=moving)
            texts = components(f"{name}: angular acceleration, in own axes")
            yield from several(f"{at}.angular_acceleration", (units.ANGULAR_ACCELERATION,) * 3, texts, depends=moving)

    def _loads(self) -> Iterator[Variable]:
        for name in self._names:
            about = "about Os in the axes of Es at phi = 0"
            texts = [f"{name}: wrench of the mount on it, {c}, {about}" for c in WRENCH_LETTERS]
            yield from several(f"{name}.mount_wrench", units.WRENCH, texts, depends=self._moving(True))

    def _reaction(self) -> Iterator[Variable]:
        if self._layout.held:
            texts = [f"wrench of the hold on the carrier, {c}, in E1 about O1" for c in WRENCH_LETTERS]
            depends = dict.fromkeys(self._state_names("carrier.position") + self._moving(attitude=True))
            yield from several("hold.reaction", units.WRENCH, texts, depends=tuple(depends))

    def _coordinates(self) -> Iterator[Variable]:
        """q of the freedoms that have a number, the quaternion of three turns, then all u, as `coordinates` gives them.

        A freedom that goes by its place has an index for a name.
        """
        hold = self._stand.hold
        if hold is None or not self._layout.coordinates:
            return
        pose, attitude = self._state_names("carrier.position", "carrier.attitude"), self._state_names("carrier.att")
        names, described, numbered = freedom_names(hold), freedom_words(hold), numbered_freedoms(hold)
        counted = "with all its turns from the start" if self._kind == "cs" else "within half a turn"
        for k in numbered:
            unit, what = units.METRE, "way of the pivot from the home pose"
            if hold.freedoms[k].kind == "turn":
                unit, what = units.RADIAN, f"angle, {counted}"
            text = f"coordinate of the freedom {described[k]}: {what}"
            yield Variable(_member("q", names[k]), unit, text, depends=pose)
        if len(numbered) < len(names):
            texts = [f"attitude from the home pose, unit quaternion, {c}" for c in _QUATERNION]
            yield from several("q.orientation", (units.NONE,) * 4, texts, depends=attitude)
        for name, words, freedom in zip(names, described, hold.freedoms, strict=True):
            unit = units.ANGULAR_VELOCITY if freedom.kind == "turn" else units.VELOCITY
            text = f"speed u of the freedom {words}: V = S u"
            yield Variable(_member("u", name), unit, text, depends=self._state_names("carrier.V["))


def _member(of: str, name: str) -> str:
    """A freedom as part of a structured name: `q.pitch`, or `q[1]` by its place."""
    return f"{of}[{name}]" if name.isdigit() else f"{of}.{name}"
