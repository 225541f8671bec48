"""Regimes: for each flywheel one law, for some bodies a wrench, in time; the file (TOML or JSON), and tables in CSV.

A programme file is a regime as well. All problems of a file are found before any is reported.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, ClassVar, cast

import numpy as np

from mahovik.core.motion.functions import Array, Fourier, Motion
from mahovik.core.motion.laws import (
    MAX_PHASE,
    MAX_SPEED,
    MAX_WRENCH,
    Constant,
    Harmonic,
    Law,
    Ramp,
    RunUp,
    SpeedLaw,
    SpeedTable,
    Sweep,
    Torque,
    TorqueLaw,
    TorqueSpeed,
    TorqueTable,
    out_of_range,
)  # fmt: skip
from mahovik.core.motion.programme import Programme, read_programme
from mahovik.core.stand.fields import Text, scalar, validator
from mahovik.core.stand.files import KINDS, TEXT, Columns, TableError, document_of, kind_of, read_columns, text_of
from mahovik.core.stand.model import WRENCH_LETTERS, Stand, Vec6
from mahovik.core.stand.motor import Curve, Motor, mirrored, read_curve
from mahovik.core.stand.tables import NOTHING, Problems, Table, keys_of
from mahovik.core.stand.units import ANGLE, FORCE, SPEED, TIME, TORQUE, Dimension, QuantityError, number, show
from mahovik.errors import RegimeError
from mahovik.nearest import suggestion

_MOMENT = Dimension("a moment", "N m")
_WRENCH = dict(zip(WRENCH_LETTERS, (FORCE,) * 3 + (_MOMENT,) * 3, strict=True))

_ROUNDING = 4 * 2.0**-52
"""Rounding of the last time, as a part of it, when a unit such as ms is converted."""


# -- the regime ------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class WrenchTable:
    """A wrench (6; N, N m) on one body in its own frame, in time, joined by straight lines; one row: constant."""

    times: Array
    values: Array

    @property
    def breaks(self) -> tuple[float, ...]:
        """The corners."""
        return tuple(map(float, self.times)) if len(self.times) > 1 else ()

    def at(self, t: Array) -> Array:
        """Six components (times x 6) at the times t (s)."""
        return np.column_stack([np.interp(t, self.times, column) for column in self.values.T])


@dataclass(frozen=True)
class FlywheelRegime:
    """One flywheel of a regime. `phase`, `speed`: at t = 0; None where the start decides."""

    name: str
    law: Law
    phase: float | None = None
    speed: float | None = None

    @property
    def by_torque(self) -> bool:
        """Is its torque given, and not its speed?"""
        return isinstance(self.law, TorqueLaw)


@dataclass(frozen=True)
class Regime:
    """Laws of all flywheels in the stand's order, and wrenches by body."""

    name: str
    flywheels: tuple[FlywheelRegime, ...]
    wrenches: Mapping[str, WrenchTable]

    @cached_property
    def by_torque(self) -> bool:
        """Is any flywheel driven by torque?"""
        return not all(self.has_speed_law)

    @cached_property
    def has_speed_law(self) -> tuple[bool, ...]:
        """Flywheels whose speed is given."""
        return tuple(not wheel.by_torque for wheel in self.flywheels)

    @cached_property
    def mixes_speed_and_torque(self) -> bool:
        """Does a given speed vary beside flywheels that are driven by torque?"""
        return self.by_torque and any(not isinstance(wheel.law, TorqueLaw | Constant) for wheel in self.flywheels)

    def motion(self, t: Array) -> Motion:
        """phi from t = 0, phi', phi'' of all flywheels (times x N); of one driven by torque: zero."""
        motion = np.zeros((3, len(t), len(self.flywheels)))
        for s, wheel in enumerate(self.flywheels):
            if isinstance(wheel.law, SpeedLaw):
                motion[:, :, s] = wheel.law.motion(t)
        return motion[0], motion[1], motion[2]

    def torques(self, t: float, speeds: Array, motors: tuple[Motor | None, ...]) -> Array:
        """Drive torques (N, N m) that the motors give at a time and speeds; zero where the speed is given."""
        torques = np.zeros(speeds.shape)
        for s, wheel in enumerate(self.flywheels):
            if isinstance(wheel.law, TorqueLaw):
                torques[s] = wheel.law.torque(t, float(speeds[s]), motors[s])
        return torques

    def commands(self, t: Array) -> Array:
        """Torques commanded (times x N, N m), as far as they do not depend on speed; zero where the speed is given."""
        columns = [w.law.at(t) if isinstance(w.law, TorqueLaw) else np.zeros_like(t) for w in self.flywheels]
        return np.array(columns).reshape(len(columns), len(t)).T

    def steepness(self, motors: Sequence[Motor | None]) -> Array:
        """Largest change of each drive torque by its speed, N m s; zero of given speeds."""
        wheels = zip(self.flywheels, motors, strict=True)
        return np.array([w.law.steepness(m) if isinstance(w.law, TorqueLaw) else 0.0 for w, m in wheels])

    def wrench(self, t: float) -> dict[str, Vec6]:
        """Run-time wrenches by body at a time."""
        return {body: cast(Vec6, tuple(table.at(np.array([t]))[0].tolist())) for body, table in self.wrenches.items()}

    def breaks(self, until: float) -> list[float]:
        """Times inside (0, until) at which some law is not smooth, ascending."""
        breaks = [wheel.law.breaks for wheel in self.flywheels] + [w.breaks for w in self.wrenches.values()]
        return sorted({t for times in breaks for t in times if 0.0 < t < until})


def steady_regime(stand: Stand, speeds: Sequence[float]) -> Regime:
    """Every flywheel keeps the speed it has (rad/s); no wrench."""
    driven = (FlywheelRegime(s.name, Constant(speed)) for s, speed in zip(stand.flywheels, speeds, strict=True))
    return Regime("steady", tuple(driven), {})


@dataclass(frozen=True, eq=False)
class Programmed(SpeedLaw):
    """The angle that a programme of this flywheel alone gives it, counted from that at t = 0."""

    programme: Programme

    @cached_property
    def begin(self) -> float:
        """Angle at t = 0, rad."""
        return float(self.programme.at(np.zeros(1)).phi[0, 0])

    def motion(self, t: Array) -> Motion:
        """See SpeedLaw."""
        phi, phi_dot, phi_ddot = self.programme.at(t)
        return phi[:, 0] - self.begin, phi_dot[:, 0], phi_ddot[:, 0]


def programme_regime(programme: Programme) -> Regime:
    """The regime in which all flywheels follow the programme from its t = 0 on."""
    course: Any = programme.course
    driven, columns = [], vars(course) if isinstance(course, Fourier) else course.columns
    for s, name in enumerate(programme.flywheels):
        alone = replace(course, **{key: column[..., s : s + 1] for key, column in columns.items()})
        one = replace(programme, flywheels=(name,), winding=programme.winding[s : s + 1])
        law = Programmed(one.with_course(alone))
        driven.append(FlywheelRegime(name, law, law.begin))
    return Regime(programme.motion, tuple(driven), {})


# -- its file --------------------------------------------------------------------------------------------------------


def _tables(what: str) -> Any:
    def read(raw: Any) -> dict[str, Any]:
        if not isinstance(raw, dict):
            raise QuantityError(f"expected a table of {what}, found {show(raw)}")
        return raw

    return validator(read)


class RegimeTable(Table):
    """A regime file; what is inside the tables is read by the names of the stand."""

    name: Text = ""
    default: Any = None
    flywheel: Annotated[Mapping[str, Any], _tables("flywheels")] = NOTHING
    wrench: Annotated[Mapping[str, Any], _tables("bodies")] = NOTHING


def _true(raw: Any) -> bool:
    if raw is not True:
        raise QuantityError(f"expected true, found {show(raw)}")
    return True


def _file(raw: Any) -> str:
    if not isinstance(raw, str):
        raise QuantityError(f"expected the name of a CSV file, found {show(raw)}")
    return raw


def _bounded(dimension: Dimension, most: float) -> Any:
    def read(raw: Any) -> float:
        value = number(raw, dimension)
        if (problem := out_of_range(dimension.words, value, most, dimension.si)) is not None:
            raise QuantityError(problem)
        return value

    return validator(read, dimension)


class DrivenTable(Table):
    """One flywheel of a regime, with one law, or the default of all.

    speed          constant speed
    hold           `true`: speed zero
    ramp           `from` (0), `to`, `duration`, `start` (0): speed, linear from one to the other, then constant
    sweep          the same keys and `scale`, `"linear"` or `"log"`; `from` and `to` also in Hz
    harmonic       `mean` (0), `amplitude`, `frequency`, `phase` (0): speed
                   `mean + amplitude sin(2 pi frequency t + phase)`
    torque         constant torque
    run_up         `torque`, `to`, `band` (1 % of `to`): torque `torque tanh((to - phi')/band)`
    torque_speed   the torque that the motor *delivers* at a speed: straight lines between points, constant beyond the
                   ends; points for speeds from 0 on alone are mirrored
    table          speed (column `phi_dot`) by a cubic spline, or torque (column `torque`) by linear interpolation, by
                   time (column `t`) over the whole run
    phase          angle at `t = 0`, beside any law
    initial_speed  speed at `t = 0`, beside a law of the torque
    """

    speed: Annotated[float | None, scalar(SPEED)] = None
    hold: Annotated[bool, validator(_true)] = False
    ramp: Ramp | None = None
    sweep: Sweep | None = None
    harmonic: Harmonic | None = None
    torque: Annotated[float | None, scalar(TORQUE)] = None
    run_up: RunUp | None = None
    torque_speed: Annotated[Curve, validator(read_curve, shape="`[[speed, torque], ...]`")] = ()
    table: Annotated[str, validator(_file, shape="name of a CSV file")] = ""
    phase: Annotated[float | None, _bounded(ANGLE, MAX_PHASE)] = None
    initial_speed: Annotated[float | None, _bounded(SPEED, MAX_SPEED)] = None

    instead: ClassVar[Mapping[str, str]] = {
        "frequency": 'a turn at 50 Hz is speed = "3000 rpm"; a speed that varies is harmonic = { frequency = ... }'
    }

    def law(self, folder: Path, until: float) -> Law:
        """The law; that of a table in a file of `folder`, over 0..until. Raises TableError."""
        if self.table:
            table = read_table(folder / self.table, {"phi_dot": SPEED, "torque": TORQUE}, until)
            if len(table.numbers) > 2:
                raise TableError([f"{self.table}: has phi_dot and torque, expected one of them"])
            if "torque" in table.numbers:
                return TorqueTable(table.numbers["t"], table.numbers["torque"])
            return SpeedTable.of(table.numbers["t"], table.numbers["phi_dot"])
        if self.torque is not None:
            return Torque(self.torque)
        if self.torque_speed:
            return TorqueSpeed(mirrored(self.torque_speed))
        return self.ramp or self.sweep or self.harmonic or self.run_up or Constant(self.speed or 0.0)


LAWS = tuple(key for key in keys_of(DrivenTable) if key not in ("phase", "initial_speed"))
"""Keys that name a law."""


def load(path: str | Path, stand: Stand, until: float) -> Regime:
    """Read and check the regime file at `path` for a run of `until` s. Raises RegimeError with every problem."""
    path = Path(path)
    text = text_of(path, KINDS["regime"], TEXT, RegimeError)
    return loads_regime(text, stand, until, path.name, path.parent, is_json=path.suffix.lower() == ".json")


def loads_regime(
    text: str, stand: Stand, until: float, source: str = "regime", folder: Path = Path(), is_json: bool = False
) -> Regime:
    """Read and check a regime given as text; its tables are in `folder`. Raises RegimeError, ProgrammeError."""
    document = document_of(text, source, RegimeError, "regime", "programme", is_json=is_json)
    if kind_of(document) == "programme":
        return _of_programme(text, stand, until, source)
    problems = Problems(source)
    tables = {key: document[key] for key in ("default", "flywheel", "wrench") if isinstance(document.get(key), dict)}
    regime = problems.valid(RegimeTable, document) or RegimeTable(**tables)
    flywheels = _flywheels(regime, stand, problems, folder, until)
    wrenches = {}
    for body in _names_known(problems, "wrench", regime.wrench, [body.name for body in stand.bodies], "body"):
        wrench = _wrench(problems, f"wrench {show(body)}", regime.wrench[body], folder, until)
        if wrench is not None:
            wrenches[body] = wrench
    if problems.lines:
        raise RegimeError(problems.lines)
    return Regime(regime.name or Path(source).stem, flywheels, wrenches)


def _of_programme(text: str, stand: Stand, until: float, source: str) -> Regime:
    """The regime that a programme file gives. Raises ProgrammeError, RegimeError."""
    programme = read_programme(text, source)
    names = [wheel.name for wheel in stand.flywheels]
    if list(programme.flywheels) != names:
        there, expected = ", ".join(programme.flywheels), ", ".join(names) or "none"
        raise RegimeError([f"{source}: is a programme of the flywheels {there}; the stand has {expected}"])
    if not programme.periodic and until > programme.span * (1 + 1e-9):
        raise RegimeError([f"{source}: the programme ends at {programme.span:g} s, expected at least {until:g} s"])
    return programme_regime(programme)


def _names_known(problems: Problems, key: str, tables: Mapping[str, Any], names: list[str], what: str) -> list[str]:
    """Names of the tables that the stand knows; a problem is noted for every other table."""
    for name in tables:
        if name not in names:
            problems.add(key, f"unknown {what} {show(name)}{suggestion(name, names, 'the stand has none')}")
    return [name for name in tables if name in names]


def _flywheels(
    regime: RegimeTable, stand: Stand, problems: Problems, folder: Path, until: float
) -> tuple[FlywheelRegime, ...]:
    """Every flywheel with its table, with the law of `default` if it has none of its own; problems are noted."""
    names = [wheel.name for wheel in stand.flywheels]
    named = _names_known(problems, "flywheel", regime.flywheel, names, "flywheel")
    if regime.default is not None:
        _flywheel(problems, "default", "default", regime.default, None, folder, until)  # its problems, once
    flywheels = []
    for name in names:
        if name in named:
            where, raw, default = f"flywheel {show(name)}", regime.flywheel[name], regime.default
        elif regime.default is not None:
            where, raw, default = "default", regime.default, None
        else:
            words = "has no law: give it one, or a `default` for all that are not named"
            problems.add(f"flywheel {show(name)}", words)
            continue
        wheel = _flywheel(problems, name, where, raw, default, folder, until)
        if wheel is not None:
            flywheels.append(wheel)
    return tuple(flywheels)


def _flywheel(
    problems: Problems, name: str, where: str, raw: Any, default: Any, folder: Path, until: float
) -> FlywheelRegime | None:
    """One flywheel; if it has no law of its own, with the law of `default`. None: with problems, which are noted."""
    if not isinstance(raw, dict):
        problems.add(where, f"expected a table with a law, found {show(raw)}")
        return None
    laws = [key for key in LAWS if key in raw]
    if len(laws) > 1:
        problems.add(where, f"{', '.join(laws)}: exactly one law, not {len(laws)}")
        return None
    if not laws and isinstance(default, dict):
        raw = {**default, **raw}
        laws = [key for key in LAWS if key in raw][:1]
    if not laws:
        problems.add(where, f"no law: expected one of {', '.join(LAWS)}")
    table = problems.valid(DrivenTable, raw, where)
    if table is None or not laws:
        return None
    try:
        law = table.law(folder, until)
    except TableError as error:
        problems.add(where, laws[0], str(error))
        return None
    if law.problem is not None:
        problems.add(where, laws[0], law.problem)
        return None
    driven = FlywheelRegime(name, law, table.phase, table.initial_speed)
    if driven.speed is not None and not driven.by_torque:
        words = f"not allowed with `{laws[0]}`, which gives the speed; it needs a law of torque"
        problems.add(where, "initial_speed", words)
    return driven


def _wrench(problems: Problems, where: str, raw: Any, folder: Path, until: float) -> WrenchTable | None:
    """A wrench on one body: six numbers, or columns of a CSV file. None: with problems, which are noted."""
    if isinstance(raw, str):
        try:
            table = read_table(folder / raw, _WRENCH, until)
        except TableError as error:
            problems.add(where, str(error))
            return None
        times = table.numbers["t"]
        values = np.column_stack([table.get(letter) for letter in _WRENCH])
    elif isinstance(raw, list) and len(raw) == len(_WRENCH):
        times, values = np.zeros(1), np.zeros((1, len(_WRENCH)))
        for i, (letter, dimension) in enumerate(_WRENCH.items()):
            try:
                values[0, i] = number(raw[i], dimension)
            except QuantityError as error:
                problems.add(where, letter, str(error))
    else:
        problems.add(where, f"expected six numbers or the name of a CSV file, found {show(raw)}")
        return None
    for (letter, dimension), column in zip(_WRENCH.items(), values.T, strict=True):
        largest = float(column[np.argmax(np.abs(column))])
        if (problem := out_of_range(dimension.words, largest, MAX_WRENCH, dimension.si)) is not None:
            problems.add(where, letter, problem)
    return WrenchTable(times, values)


# -- tables in CSV files ---------------------------------------------------------------------------------------------


def read_table(path: Path, known: Mapping[str, Dimension], until: float) -> Columns:
    """A table with a column `t` and some of the columns `known`, over 0..until, in SI where no unit is. TableError."""
    table = read_columns(path, {"t": TIME, **known}, ["t"], units=False, empty=math.nan)
    times = table.numbers["t"]
    if len(table.numbers) == 1:
        raise TableError([f"{path}: no column besides t; expected one of {', '.join(known)}"])
    if table.rows < 2:
        raise TableError([f"{path}: expected a header and at least two rows"])
    back = np.flatnonzero(np.diff(times) <= 0.0)
    if len(back):
        i = int(back[0])
        raise table.refuse(i + 1, f"t = {times[i + 1]:g} s is not after {times[i]:g} s")
    if times[0] > 0.0 or times[-1] < until * (1.0 - _ROUNDING):
        covers = f"covers t = {times[0]:g} s to {times[-1]:g} s"
        raise TableError([f"{path}: {covers}, but the simulation runs from 0 to {until:g} s"])
    return table
