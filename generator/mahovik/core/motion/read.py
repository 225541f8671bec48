"""Regime file (TOML or JSON) or programme file -> Regime. All problems are found before any is reported."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field
from pydantic_core import PydanticCustomError

from mahovik.core.motion import ranges, table
from mahovik.core.motion.document import document_of, text_of, validate_table
from mahovik.core.motion.law_tables import LAWS, DrivenTable
from mahovik.core.motion.laws import Constant, Law, SpeedTable, TorqueTable, WrenchTable
from mahovik.core.motion.regime import FlywheelRegime, Regime
from mahovik.core.stand.content import TEXT
from mahovik.core.stand.fields import Table, Text, validator
from mahovik.core.stand.model import Stand
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import SPEED, TORQUE, Dimension, QuantityError, number, show
from mahovik.errors import RegimeError
from mahovik.nearest import suggestion

_FORCE, _MOMENT = Dimension("a force", "N"), Dimension("a moment", "N m")
_WRENCH = {"X": _FORCE, "Y": _FORCE, "Z": _FORCE, "K": _MOMENT, "M": _MOMENT, "N": _MOMENT}


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
    flywheel: Annotated[dict[str, Any], _tables("flywheels")] = Field(default_factory=dict)
    wrench: Annotated[dict[str, Any], _tables("bodies")] = Field(default_factory=dict)


def steady_regime(stand: Stand, speeds: Sequence[float]) -> Regime:
    """Every flywheel keeps the speed it has (rad/s); no wrench."""
    driven = (FlywheelRegime(s.name, Constant(speed)) for s, speed in zip(stand.flywheels, speeds, strict=True))
    return Regime("steady", tuple(driven), {})


def load(path: str | Path, stand: Stand, until: float) -> Regime:
    """Read and check the regime file at `path` for a run of `until` s. Raises RegimeError with every problem."""
    path = Path(path)
    text = text_of(path, TEXT, RegimeError)
    return loads_regime(text, stand, until, path.name, path.parent, is_json=path.suffix.lower() == ".json")


def loads_regime(
    text: str, stand: Stand, until: float, source: str = "regime", folder: Path = Path(), is_json: bool = False
) -> Regime:
    """Read and check a regime given as text; its tables are in `folder`. Raises RegimeError."""
    document = document_of(text, source, RegimeError, is_json)
    if is_json and "flywheels" in document and "stand" in document:
        return _of_programme(text, stand, until, source)
    problems = Problems(source)
    tables = {key: document[key] for key in ("default", "flywheel", "wrench") if isinstance(document.get(key), dict)}
    given = validate_table(RegimeTable, document, problems) or RegimeTable.model_construct(**tables)
    reader = _Reader(problems, until, folder)
    flywheels = _flywheels(reader, given, stand)
    bodies = _known_tables(problems, "wrench", given.wrench, [b.name for b in stand.bodies], "body")
    wrenches = {body: reader.wrench(f"wrench {show(body)}", raw) for body, raw in bodies.items()}
    if problems.lines:
        raise RegimeError(problems.lines)
    return Regime(given.name or Path(source).stem, flywheels, {body: w for body, w in wrenches.items() if w})


def _of_programme(text: str, stand: Stand, until: float, source: str) -> Regime:
    """The regime that a programme file gives. Raises ProgrammeError, RegimeError."""
    from mahovik.core.motion.programme import read_programme
    from mahovik.core.motion.programme.regime import programme_regime

    programme = read_programme(text, source)
    names = [wheel.name for wheel in stand.flywheels]
    if list(programme.flywheels) != names:
        own, others = ", ".join(programme.flywheels), ", ".join(names) or "none"
        raise RegimeError([f"{source}: is a programme of the flywheels {own}; the stand has {others}"])
    if not programme.periodic and until > programme.span * (1 + 1e-9):
        raise RegimeError([f"{source}: the programme ends at {programme.span:g} s, expected at least {until:g} s"])
    return programme_regime(programme)


def _known_tables(problems: Problems, key: str, given: dict[str, Any], names: list[str], what: str) -> dict[str, Any]:
    """Return the tables with a name of the stand; note a problem for every other table."""
    for name in given:
        if name not in names:
            problems.add(key, f"unknown {what} {show(name)}{suggestion(name, names, 'the stand has none')}")
    return {name: value for name, value in given.items() if name in names}


def _flywheels(reader: _Reader, top: RegimeTable, stand: Stand) -> tuple[FlywheelRegime, ...]:
    names = [s.name for s in stand.flywheels]
    given = _known_tables(reader.problems, "flywheel", top.flywheel, names, "flywheel")
    if top.default is not None:
        reader.flywheel("default", "default", top.default)  # its problems, once
    found = []
    for name in names:
        if name in given:
            found.append(reader.flywheel(name, f"flywheel {show(name)}", given[name], top.default))
        elif top.default is not None:
            found.append(reader.flywheel(name, "default", top.default))
        else:
            words = "has no law: give it one, or a `default` for all that are not named"
            reader.problems.add(f"flywheel {show(name)}", words)
    return tuple(each for each in found if each is not None)


@dataclass(frozen=True)
class _Reader:
    """Reads what is inside the tables. What cannot be read is noted among `problems`, and the answer is then None.

    until    end of the run, s
    folder   of the tables in files
    """

    problems: Problems
    until: float
    folder: Path

    def flywheel(self, name: str, where: str, raw: Any, default: Any = None) -> FlywheelRegime | None:
        """One flywheel; if it has no law of its own, with the law of `default`."""
        problems = self.problems
        if not isinstance(raw, dict):
            problems.add(where, f"expected a table with a law, found {show(raw)}")
            return None
        own = [key for key in LAWS if key in raw]
        if len(own) > 1:
            problems.add(where, f"{', '.join(own)}: exactly one law, not {len(own)}")
            return None
        if not own and isinstance(default, dict):
            raw = {**default, **raw}
            own = [key for key in LAWS if key in raw][:1]
        if not own:
            problems.add(where, f"no law: expected one of {', '.join(LAWS)}")
        found = validate_table(DrivenTable, raw, problems, where)
        if found is None or not own:
            return None
        law = self._law(where, own[0], found)
        if law is None:
            return None
        driven = FlywheelRegime(name, law, found.phase, found.initial_speed)
        if driven.speed is not None and not driven.by_torque:
            words = f"not allowed with `{own[0]}`, which gives the speed; it needs a law of torque"
            problems.add(where, "initial_speed", words)
        return driven

    def _law(self, where: str, key: str, found: DrivenTable) -> Law | None:
        try:
            law = found.law() or self._table(found.table)
            out = ranges.problem(law)
        except (PydanticCustomError, table.TableError) as error:
            out = str(error)
        if out is None:
            return law
        self.problems.add(where, key, out)
        return None

    def _table(self, name: str) -> Law:
        """A law in a CSV file. Raises TableError."""
        read = table.read(self.folder / name, {"phi_dot": SPEED, "torque": TORQUE}, self.until)
        if len(read.columns) > 1:
            raise table.TableError(f"{name}: has phi_dot and torque, expected one of them")
        if "torque" in read.columns:
            return TorqueTable(read.times, read.columns["torque"])
        return SpeedTable.of(read.times, read.columns["phi_dot"])

    def wrench(self, where: str, raw: Any) -> WrenchTable | None:
        """A wrench on one body: six numbers, or columns of a CSV file."""
        if isinstance(raw, str):
            try:
                read = table.read(self.folder / raw, _WRENCH, self.until)
            except table.TableError as error:
                self.problems.add(where, str(error))
                return None
            times = read.times
            values = np.column_stack([read.columns.get(letter, np.zeros_like(times)) for letter in _WRENCH])
        elif isinstance(raw, list) and len(raw) == len(_WRENCH):
            times, values = np.zeros(1), np.zeros((1, len(_WRENCH)))
            for i, (letter, dimension) in enumerate(_WRENCH.items()):
                try:
                    values[0, i] = number(raw[i], dimension)
                except QuantityError as error:
                    self.problems.add(where, letter, str(error))
        else:
            self.problems.add(where, f"expected six numbers or the name of a CSV file, found {show(raw)}")
            return None
        for (letter, dimension), column in zip(_WRENCH.items(), values.T, strict=True):
            largest = float(column[np.argmax(np.abs(column))])
            out = ranges.out_of_range(dimension.words, largest, ranges.MAX_WRENCH, dimension.si)
            if out is not None:
                self.problems.add(where, letter, out)
        return WrenchTable(times, values)
