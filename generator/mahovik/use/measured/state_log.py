"""Logs of states and accelerations, with the columns of `mahovik simulate`, as states and answers of their rows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.contract.evaluation import needs_of
from mahovik.core.stand.model import WRENCH_LETTERS, Stand
from mahovik.core.stand.state import State
from mahovik.core.stand.units import (
    ACCELERATION,
    ANGLE,
    ANGULAR_ACCELERATION,
    FORCE,
    LENGTH,
    PLAIN,
    SPEED,
    TORQUE,
    VELOCITY,
    Dimension,
    QuantityError,
    factor,
)
from mahovik.errors import DataError, StateError
from mahovik.nearest import suggestion
from mahovik.proof.verify.held import depends_on
from mahovik.proof.verify.states import read_request
from mahovik.use.measured.files.table import Table
from mahovik.use.measured.held_log import HeldColumns, groups_of
from mahovik.use.measured.quantities import HeaderError, is_time, split_header, time_scale
from mahovik.use.measured.rates import rates_of
from mahovik.use.measured.read import read_tables
from mahovik.use.measured.recording import Array

SUFFIXES = (".csv", ".parquet")

MOST_ROWS = 2000
"""Rows of a log that are compared; of more, these are spread evenly."""

AXES = "xyz"

ANSWERS = {"forward": "V_dot", "torque": "tau", "mounts": "mount_wrench", "reaction": "reaction"}
"""Wants that a log may answer, and the quantity that answers each."""

SPEEDS = {"V_dot": "V", "phi_ddot": "phi_dot"}
"""Accelerations, and the speeds that they may be derived from."""

ACCELERATIONS = ("V_dot", "u_dot", "phi_ddot")
"""Inputs that not every want needs."""


@dataclass(frozen=True, eq=False)
class StateLog:
    """Rows of a log.

    states   each with its name, "row 1" for the first
    answers  by want, then by the name of a state: the quantities of the log; a row without all numbers has none
    notes    columns and rows that were left out, accelerations that were derived
    error    relative error of derived accelerations, estimated; 0 where the log has its own
    """

    source: str
    states: tuple[tuple[str, State], ...]
    answers: Mapping[str, Mapping[str, Mapping[str, Any]]]
    notes: tuple[str, ...] = ()
    error: float = 0.0


def read_state_log(path: Path, stand: Stand) -> StateLog:
    """The rows of a log of a stand. Raises DataError."""
    if path.suffix.lower() not in SUFFIXES:
        raise DataError([f'{path}: unknown format "{path.suffix}", expected {" or ".join(SUFFIXES)}'])
    (table,) = read_tables(path)
    return _Reader(stand, path, table).log()


class _Reader:
    """Groups of columns of a table, by the keys of `eval`."""

    def __init__(self, stand: Stand, path: Path, table: Table) -> None:
        self._stand, self._path = stand, path
        self._groups = dict(_groups(stand))
        self._notes = list(table.notes)
        self._values = self._gather(self._scale_columns(table))
        self._held = None if stand.hold is None else HeldColumns(stand, stand.hold, path, self._values)
        if self._held is not None:
            self._held.add_twists(self._rows)
        self._error = self._derive(table)
        if self._held is not None:
            self._held.add_rates()

    def log(self) -> StateLog:
        """All rows with the numbers of a state. Raises DataError."""
        wants = [want for want in ANSWERS if self._answers(want)]
        self._require(wants)
        inputs = [key for key in self._values if key not in (*ANSWERS.values(), *ACCELERATIONS)]
        found: list[tuple[str, State]] = []
        answers: dict[str, dict[str, dict[str, Any]]] = {want: {} for want in wants}
        missing = dict.fromkeys(("a state", *wants), 0)
        taken = np.arange(self._rows)
        if self._rows > MOST_ROWS:
            taken = np.linspace(0, self._rows - 1, MOST_ROWS).astype(int)
            self._notes.append(f"{MOST_ROWS} of {self._rows} rows are compared, spread evenly")
        for k in taken.tolist():
            name = f"row {k + 1}"
            given = {key: self._values[key][k] for key in (*inputs, *ACCELERATIONS) if key in self._values}
            whole = {key for key, value in given.items() if np.isfinite(value).all()}
            if not set(inputs) <= whole:
                missing["a state"] += 1
                continue
            found.append((name, self._state(name, {key: given[key].tolist() for key in whole})))
            for want in wants:
                value = self._values[ANSWERS[want]][k]
                if np.isfinite(value).all() and {key for key in needs_of(want) if key in self._groups} <= whole:
                    answers[want][name] = {ANSWERS[want]: value.tolist()}
                    if want == "forward" and self._held is not None:
                        answers[want][name]["u_dot"] = self._values["u_dot"][k].tolist()
                else:
                    missing[want] += 1
        self._notes += [
            f"{number} rows without all numbers of {what}: left out" for what, number in missing.items() if number
        ]
        if not any(answers.values()):
            raise DataError([*self._lines(), f"{self._path}: no row holds all numbers of a state and of an answer"])
        return StateLog(str(self._path), tuple(found), answers, tuple(self._lines()), self._error)

    def _derive(self, table: Table) -> float:
        """Accelerations that are missing beside speeds, from these; return their relative error. Raises DataError."""
        time = next((header for header in table.columns if is_time(header)), None)
        worst = 0.0
        for key, speeds in SPEEDS.items():
            if time is None or key not in self._groups or key in self._values or speeds not in self._values:
                continue
            t = table.columns[time] * time_scale(time)
            parts = np.split(self._values[speeds], [3], axis=1) if speeds == "V" else [self._values[speeds]]
            derived = [rates_of(str(self._path), t, part) for part in parts]  # m/s and rad/s have sizes of their own
            self._values[key] = np.hstack([rates for rates, _ in derived])
            off = max(off for _, off in derived)
            worst = max(worst, off)
            self._notes.append(f"{key} is derived from {speeds} by a spline, right to about {off:.0e} of its size")
        return worst

    def _scale_columns(self, table: Table) -> dict[str, Array]:
        """Columns in SI by name without unit. Raises DataError."""
        dimensions = {name: dimension for group in self._groups.values() for name, dimension in group}
        found: dict[str, Array] = {}
        self._others: list[str] = []
        for header, values in table.columns.items():
            try:
                name, unit = split_header(header)
            except HeaderError:
                name, unit = header, ""
            if name not in dimensions:
                if not is_time(header):
                    self._others.append(name)
                continue
            try:
                scale = float(factor(unit, dimensions[name])) if unit else 1.0
            except QuantityError as error:
                raise DataError([f'{self._path}: "{header}": {error}']) from None
            found[name] = values if scale == 1.0 else scale * values
        if self._others:
            self._notes.append(f"{len(self._others)} other columns are not compared")
        return found

    def _gather(self, columns: Mapping[str, Array]) -> dict[str, Array]:
        """Groups (rows, ...) of which all columns are there. Raises DataError: of some only a part is."""
        found, problems = {}, []
        for key, group in self._groups.items():
            names = [name for name, _ in group]
            lacking = [name for name in names if name not in columns]
            if not lacking:
                found[key] = np.column_stack([columns[name] for name in names])
            elif len(lacking) < len(names):
                problems.append(f"{self._path}: no column {self._quote(lacking[0])}, expected with {names[0]}")
        if problems:
            raise DataError(problems)
        if "mount_wrench" in found:
            found["mount_wrench"] = found["mount_wrench"].reshape(-1, len(self._stand.flywheels), 6)
        self._rows = max((len(values) for values in found.values()), default=0)
        return found

    def _quote(self, name: str) -> str:
        return f'"{name}"{suggestion(name, self._others) if self._others else ""}'

    def _answers(self, want: str) -> bool:
        """Whether there are columns of a want and of what it needs."""
        if want == "forward" and self._held is not None and self._held.clamped:
            return False  # there is no motion to find
        keys = (ANSWERS[want], *(key for key in needs_of(want) if key in self._groups))
        return all(key in self._values for key in keys)

    def _require(self, wants: Sequence[str]) -> None:
        """Raises DataError where an input of every answer is missing, or there are no answers."""
        needed = [key for key in ("V", "phi", "phi_dot") if key in self._groups]
        instead = ", or " + " ".join(name for name, _ in self._groups["u"]) if "u" in self._groups else ""
        problems = [
            self._missing(key, f"every state has them{instead if key == 'V' else ''}")
            for key in needed
            if key not in self._values
        ]
        if not problems and not wants:
            need = " and ".join(key for key in ("V_dot", "phi_ddot") if key in self._groups and key not in self._values)
            problems.append(self._missing(need.split(" ")[0], "there is nothing to compare") if need else "")
        if not problems:
            attitude = any(key in self._values for key in ("quaternion", "angles"))
            known = self._held is not None and self._held.has_coordinates
            if not known and not attitude and depends_on(self._stand, wants, "quaternion"):
                problems.append(self._missing("quaternion", "this stand depends on its attitude"))
            if not known and "position" not in self._values and depends_on(self._stand, wants, "position"):
                problems.append(self._missing("position", "this stand depends on its position"))
        if "quaternion" in self._values and "angles" in self._values:
            problems.append(f"{self._path}: columns of a quaternion and of angles, expected one of them")
        if problems:
            raise DataError(problems)

    def _missing(self, key: str, reason: str) -> str:
        names = [name for name, _ in self._groups[key]]
        return f'{self._path}: no columns {self._quote(names[0])} to "{names[-1]}": {reason}'

    def _state(self, name: str, given: dict[str, Any]) -> State:
        try:
            if self._held is not None:
                return self._held.state(given)
            return read_request(self._stand, {**given, "want": ["forward"]}).state
        except StateError as error:
            raise DataError([f"{self._path}: {name}: {error}"]) from None

    def _lines(self) -> Iterator[str]:
        return (f"{self._path}: {note}" for note in self._notes)


def _groups(stand: Stand) -> Iterator[tuple[str, list[tuple[str, Dimension]]]]:
    """Columns, with their dimensions, of each key of `eval` that a stand has."""

    def twist(linear: str, angular: str, of: tuple[Dimension, Dimension]) -> list[tuple[str, Dimension]]:
        return [(f"{name}_{a}", each) for name, each in zip((linear, angular), of, strict=True) for a in AXES]

    yield "position", [(a, LENGTH) for a in AXES]
    yield "quaternion", [(f"q{a}", PLAIN) for a in "wxyz"]
    yield "angles", [(name, ANGLE) for name in ("psi", "theta", "phi")]
    yield "V", twist("v", "omega", (VELOCITY, SPEED))
    yield "V_dot", twist("v_dot", "omega_dot", (ACCELERATION, ANGULAR_ACCELERATION))
    if stand.hold is not None:
        yield from groups_of(stand.hold)
    if not stand.flywheels:
        return
    for key, dimension in (
        ("phi", ANGLE),
        ("phi_dot", SPEED),
        ("phi_ddot", ANGULAR_ACCELERATION),
        ("tau", TORQUE),
    ):
        yield key, [(f"{key} {s.name}", dimension) for s in stand.flywheels]
    units = (FORCE,) * 3 + (TORQUE,) * 3
    yield (
        "mount_wrench",
        [(f"mount_{a} {s.name}", u) for s in stand.flywheels for a, u in zip(WRENCH_LETTERS, units, strict=True)],
    )
