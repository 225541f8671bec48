"""The variables of an FMU of a stand: names, units, start values, ranges, and on what each depends."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal

from mahovik.core.lower import units
from mahovik.core.lower.fmu_parameters import laws, parameters
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.limits import limits
from mahovik.core.lower.member import Member
from mahovik.core.lower.units import Unit
from mahovik.core.lower.values import Values
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
    causality: Literal["independent", "input", "output", "parameter", "local"]
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
        found = self.groups[name]
        return self.variables[found.first : found.end]


@dataclass(frozen=True)
class Start:
    """An initial state: attitude as a quaternion, w first."""

    position: Sequence[float]
    attitude: Sequence[float]
    V: Sequence[float]
    phi: Sequence[float]
    phi_dot: Sequence[float]


def form(stand: Stand, layout: Layout, values: Values, kind: Kind, inputs: Inputs, dt: float, start: Start) -> Form:
    """The variables of a stand's FMU. `dt` is the longest step inside, s, of co-simulation."""
    return _Former(stand, layout, values, kind, inputs, dt, start).form()


class _Former:
    """Collects the groups one after the other."""

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
        time = Variable("time", units.SECOND, "simulation time", "independent")
        self._add("TIME", "simulation time", [time])
        self._add("DRIVE", "what drives the flywheels", self._drive())
        self._add("WRENCH", "run-time wrenches, six numbers a body", self._wrenches())
        states = list(self._states())
        self._add("STATE", "members of the state, as its struct has them", states)
        self._add("STEP", "longest step inside", self._steps())
        self._add("PARAMETERS", "what prepare makes the table of", self._parameters())
        self._add("LAWS", "laws of the table", self._laws())
        self._add("RATES", "rates of the state; the first that is calculated", self._rates(states))
        self._add("TORQUE", "drive torques, where accelerations are given", self._torques())
        self._add("MOMENTA", "energy, momentum in E0, centre of mass", self._momenta())
        self._add("READINGS", "of instruments and points", self._readings())
        self._add("LOADS", "wrenches of the mounts", self._loads())
        self._add("REACTION", "wrench of the hold", self._reaction())
        self._add("COORDINATES", "of the freedoms of the hold", self._coordinates())
        return Form(self._kind, self._inputs, tuple(map(self._by_kind, self._variables)), self._groups)

    def _add(self, name: str, comment: str, variables: Sequence[Variable] | Iterator[Variable]) -> None:
        first = len(self._variables)
        self._variables += variables
        self._groups[name] = Group(name, first, len(self._variables) - first, comment)

    def _by_kind(self, variable: Variable) -> Variable:
        """Co-simulation shows no derivatives: what depends on a state depends on inputs alone, one after another."""
        if self._kind == "me":
            return variable
        inputs = {v.name for name in ("DRIVE", "WRENCH") for v in self._of(name)}
        depends = None if variable.depends is None else tuple(n for n in variable.depends if n in inputs)
        return replace(
            variable, derivative=None, depends=depends, shown=variable.shown and not variable.name.startswith("der(")
        )

    def _of(self, name: str) -> list[Variable]:
        found = self._groups[name]
        return self._variables[found.first : found.end]

    # -- what is set ---------------------------------------------------------------------------------------------------

    def _drive(self) -> Iterator[Variable]:
        for name in self._names:
            if self._inputs == "torque":
                text, unit, most = "drive torque tau, mount on flywheel, about the spin axis", units.TORQUE, "WRENCH"
                symbol = "tau"
            else:
                text, unit, most = (
                    "acceleration phi_ddot relative to the mount",
                    units.ANGULAR_ACCELERATION,
                    "ACCELERATION",
                )
                symbol = "phi_ddot"
            yield self._input(f"{name}.{symbol}", unit, f"{name}: {text}", self._most[f"MAX_{most}"])

    def _wrenches(self) -> Iterator[Variable]:
        for name in self._layout.inputs:
            for i in range(6):
                what = f"{name}: run-time wrench {WRENCH_LETTERS[i]}, in its own frame about its origin"
                yield self._input(f"{name}.wrench[{i + 1}]", units.WRENCH[i], what, self._most["MAX_WRENCH"])

    @staticmethod
    def _input(name: str, unit: Unit, description: str, most: float) -> Variable:
        return Variable(name, unit, description, "input", start=0.0, least=-most, most=most)

    def _states(self) -> Iterator[Variable]:
        start = self._start

        def state(name: str, unit: Unit, description: str, value: float, most: float) -> Variable:
            text = f"{description}"
            return Variable(name, unit, text, "output", start=float(value), least=-most, most=most, depends=(name,))

        for i in range(3):
            text = f"position of O1 in E0, component {i + 1}"
            yield state(f"carrier.position[{i + 1}]", units.METRE, text, start.position[i], self._most["MAX_POSITION"])
        for i in range(4):
            text = f"attitude of E1 in E0, unit quaternion, {_QUATERNION[i]}: x0 = C x1"
            yield state(f"carrier.attitude[{i + 1}]", units.NONE, text, start.attitude[i], 2.0)
        for i in range(6):
            text = f"twist V of the carrier relative to E0, {TWIST_LETTERS[i]}, in E1 about O1"
            most = self._most["MAX_VELOCITY" if i < 3 else "MAX_SPEED"]
            yield state(f"carrier.V[{i + 1}]", units.TWIST[i], text, start.V[i], most)
        for name, phi in zip(self._names, start.phi, strict=True):
            yield state(f"{name}.phi", units.RADIAN, f"{name}: phase, all turns counted", phi, self._most["MAX_PHASE"])
        for name, phi_dot in zip(self._names, start.phi_dot, strict=True):
            text = f"{name}: speed phi_dot relative to the mount"
            yield state(f"{name}.phi_dot", units.ANGULAR_VELOCITY, text, phi_dot, self._most["MAX_SPEED"])

    def _steps(self) -> Iterator[Variable]:
        if self._kind == "cs":
            text = "longest step of the Runge-Kutta method (fourth order) inside; a communication step has equal ones"
            most = self._most["MAX_STEP"]
            yield Variable("dt", units.SECOND, text, "parameter", "tunable", self._dt, least=1e-9, most=most)

    def _parameters(self) -> Iterator[Variable]:
        return self._measurement_variables(parameters(self._stand, self._layout, self._values))

    def _laws(self) -> Iterator[Variable]:
        return self._measurement_variables(laws(self._stand, self._layout, self._values))

    def _measurement_variables(self, members: Iterator[Member]) -> Iterator[Variable]:
        for member in members:
            most = self._most[
                next((of for name, of in _RANGES.items() if member.name.startswith(name)), "MAX_PARAMETER")
            ]
            yield Variable(
                member.name, member.unit, member.description, "parameter", "tunable", member.value,
                least=0.0 if member.positive else -most, most=most,
            )  # fmt: skip

    # -- what is calculated --------------------------------------------------------------------------------------------

    def _state_names(self, *prefixes: str) -> tuple[str, ...]:
        """Names of states of these beginnings."""
        return tuple(v.name for v in self._of("STATE") if v.name.startswith(prefixes))

    def _moving(self, attitude: bool = False) -> tuple[str, ...]:
        """What accelerations depend on: speeds and phases, inputs, and the pose where a law of wrenches takes it."""
        layout = self._layout
        found = tuple(v.name for name in ("DRIVE", "WRENCH") for v in self._of(name))
        if layout.structure.stream_stations or any(law.placed for law in layout.law_tables):
            found += self._state_names("carrier.position")
        if attitude or layout.attitude_needed:
            found += self._state_names("carrier.attitude")
        return found + self._state_names("carrier.V[") + self._turning()

    def _turning(self) -> tuple[str, ...]:
        return tuple(f"{name}.phi" for name in self._names) + tuple(f"{name}.phi_dot" for name in self._names)

    def _rates(self, states: Sequence[Variable]) -> Iterator[Variable]:
        attitude, V = self._state_names("carrier.attitude"), self._state_names("carrier.V[")
        for i, state in enumerate(states[:7]):
            what = "velocity of O1 in E0" if i < 3 else "rate of the quaternion, drawn to unit length"
            depends = attitude + V[:3] if i < 3 else attitude + V[3:]
            unit = units.VELOCITY if i < 3 else units.RATE
            text = f"{what}, component {i + 1 if i < 3 else i - 2}"
            yield self._local(f"der({state.name})", unit, text, state.name, depends, direct=True)
        for i, state in enumerate(states[7:13]):
            text = f"derivative V_dot of the components of V, {TWIST_LETTERS[i]}*, in E1, by (8)"
            yield Variable(
                f"carrier.V_dot[{i + 1}]", units.TWIST_RATE[i], text, "output",
                derivative=state.name, depends=self._moving(),
            )  # fmt: skip
        for name in self._names:
            speed = f"{name}.phi_dot"
            yield self._local(
                f"der({name}.phi)", units.ANGULAR_VELOCITY, f"{name}: phi_dot", f"{name}.phi", (speed,), direct=True
            )
        for name in self._names:
            speed, unit = f"{name}.phi_dot", units.ANGULAR_ACCELERATION
            if self._inputs == "torque":
                text = f"{name}: acceleration phi_ddot relative to the mount, of the coupled equations"
                yield Variable(f"{name}.phi_ddot", unit, text, "output", derivative=speed, depends=self._moving())
            else:
                yield self._local(
                    f"der({speed})", unit, f"{name}: acceleration phi_ddot", speed, (f"{name}.phi_ddot",), direct=True
                )

    @staticmethod
    def _local(
        name: str, unit: Unit, description: str, derivative: str, depends: tuple[str, ...], direct: bool
    ) -> Variable:
        return Variable(name, unit, description, "local", derivative=derivative, depends=depends, direct=direct)

    def _torques(self) -> Iterator[Variable]:
        for name in self._names if self._inputs == "acceleration" else ():
            text = f"{name}: drive torque tau that the motion needs, mount on flywheel, about the spin axis"
            yield Variable(f"{name}.tau", units.TORQUE, text, "output", depends=self._moving())

    def _momenta(self) -> Iterator[Variable]:
        pose = self._state_names("carrier.position", "carrier.attitude")
        moving = self._state_names("carrier.attitude", "carrier.V[") + self._turning()
        yield Variable("energy", units.ENERGY, "kinetic energy of all bodies", "output", depends=moving)
        for i in range(6):
            text = f"momentum screw of all bodies in E0 about its origin, {'linear' if i < 3 else 'angular'} part, (1)"
            depends = pose + self._state_names("carrier.V[") + self._turning()
            yield Variable(f"momentum[{i + 1}]", units.MOMENTUM_SCREW[i], text, "output", depends=depends)
        for i in range(3):
            text = f"centre of mass of all bodies in E1, component {i + 1}"
            depends = tuple(f"{name}.phi" for name in self._names)
            yield Variable(f"center_of_mass[{i + 1}]", units.METRE, text, "output", depends=depends)

    def _readings(self) -> Iterator[Variable]:
        attitude, V = self._state_names("carrier.attitude"), self._state_names("carrier.V[")
        position = self._state_names("carrier.position")
        for name in self._layout.sensors:
            for i in range(3):
                text = f"{name}: position in E0, component {i + 1}"
                depends = position + attitude
                yield Variable(f"{name}.reading.position[{i + 1}]", units.METRE, text, "output", depends=depends)
            for k in range(9):
                place = f"{k // 3 + 1},{k % 3 + 1}"
                text = f"{name}: own axes to E0, element {place}"
                yield Variable(f"{name}.reading.C[{place}]", units.NONE, text, "output", depends=attitude)
            for i in range(6):
                text = f"{name}: twist relative to E0, {TWIST_LETTERS[i]}, in own axes; a gyro reads p, q, r"
                yield Variable(f"{name}.reading.twist[{i + 1}]", units.TWIST[i], text, "output", depends=V)
            for what, unit, said in (
                (
                    "specific_force",
                    units.ACCELERATION,
                    "acceleration minus gravity, in own axes: the accelerometer's reading",
                ),
                ("angular_acceleration", units.ANGULAR_ACCELERATION, "angular acceleration, in own axes"),
            ):
                for i in range(3):
                    text = f"{name}: {said}, component {i + 1}"
                    depends = self._moving(attitude=True)
                    yield Variable(f"{name}.reading.{what}[{i + 1}]", unit, text, "output", depends=depends)

    def _loads(self) -> Iterator[Variable]:
        for name in self._names:
            for i in range(6):
                text = f"{name}: wrench of the mount on it, {WRENCH_LETTERS[i]}, about Os in the axes of Es at phi = 0"
                yield Variable(
                    f"{name}.mount_wrench[{i + 1}]", units.WRENCH[i], text, "output", depends=self._moving(True)
                )

    def _reaction(self) -> Iterator[Variable]:
        for i in range(6) if self._layout.held else ():
            text = f"wrench of the hold on the carrier, {WRENCH_LETTERS[i]}, in E1 about O1"
            depends = self._state_names("carrier.position") + self._moving(attitude=True)
            yield Variable(
                f"hold.reaction[{i + 1}]", units.WRENCH[i], text, "output", depends=tuple(dict.fromkeys(depends))
            )

    def _coordinates(self) -> Iterator[Variable]:
        """q of the freedoms that have a number, the quaternion of three turns, then all u, as `coordinates` gives them.

        A freedom that goes by its place has an index for a name.
        """
        hold, layout = self._stand.hold, self._layout
        if hold is None or not layout.coordinates:
            return
        pose = self._state_names("carrier.position", "carrier.attitude")
        names, described, numbered = freedom_names(hold), freedom_words(hold), numbered_freedoms(hold)
        for k in numbered:
            turns = hold.freedoms[k].kind == "turn"
            counted = "with all its turns from the start" if self._kind == "cs" else "within half a turn"
            what = f"angle, {counted}" if turns else "way of the pivot from the home pose"
            text = f"coordinate of the freedom {described[k]}: {what}"
            name, unit = _member("q", names[k]), units.RADIAN if turns else units.METRE
            yield Variable(name, unit, text, "output", depends=pose)
        for i in range(4 if len(numbered) < len(names) else 0):
            text = f"attitude from the home pose, unit quaternion, {_QUATERNION[i]}"
            depends = self._state_names("carrier.attitude")
            yield Variable(f"q.orientation[{i + 1}]", units.NONE, text, "output", depends=depends)
        for name, words, freedom in zip(names, described, hold.freedoms, strict=True):
            unit = units.ANGULAR_VELOCITY if freedom.kind == "turn" else units.VELOCITY
            text = f"speed u of the freedom {words}: V = S u"
            yield Variable(_member("u", name), unit, text, "output", depends=self._state_names("carrier.V["))


def _member(of: str, name: str) -> str:
    """A freedom as part of a structured name: `q.pitch`, or `q[1]` by its place."""
    return f"{of}[{name}]" if name.isdigit() else f"{of}.{name}"


def unique(variables: Sequence[Variable]) -> dict[str, int]:
    """Value references by name. Raises ValueError where two variables have one name."""
    found: dict[str, Any] = {}
    for reference, variable in enumerate(variables):
        if variable.name in found:
            raise ValueError(f"two variables are called {variable.name}")
        found[variable.name] = reference
    return found
