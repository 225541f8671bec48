"""Logs of states and accelerations, with the columns of `mahovik simulate`, as states and answers of their rows.

Accelerations that are missing beside speeds are derivatives of an interpolating spline of degree 5. Of a held carrier
speeds and coordinates of its freedoms may stand in place of twist and pose.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from scipy.interpolate import make_interp_spline

from mahovik.contract.evaluation import needs_of
from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import Hold, Stand, State
from mahovik.core.stand.units import (
    QuantityError,
    factor,
)
from mahovik.errors import DataError, StateError
from mahovik.nearest import nearest_name
from mahovik.proof.verify.draw import ALLOWED, at_coordinates, blocked_twist, depends_on, freedom_rates, with_pose
from mahovik.proof.verify.states import read_request
from mahovik.use.measured.clocks import Array
from mahovik.use.measured.headers import Columns, HeaderError, is_time, split_header, state_columns, time_scale
from mahovik.use.measured.read import read_table

MOST_ROWS = 2000
"""Rows of a log that are compared; of more, these are spread evenly."""

ANSWERS = {"forward": "V_dot", "torque": "tau", "mounts": "mount_wrench", "reaction": "reaction"}
"""Wants that a log may answer, and the quantity that answers each."""

SPEEDS = {"V_dot": "V", "phi_ddot": "phi_dot"}
"""Accelerations, and the speeds that they may be derived from."""

ACCELERATIONS = ("V_dot", "u_dot", "phi_ddot")
"""Inputs that not every want needs."""

COORDINATES = ("q", "orientation")
"""Keys of the coordinates of freedoms."""

DEGREE, ENDS = 5, 6
"""Degree of the spline of speeds, and rows at either end whose derivative is not used: a spline is worst there."""


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
    frame, notes = read_table(path)
    log = _Log(stand, path, state_columns(stand), notes)
    log.gather(frame)
    if stand.hold is not None:
        log.add_twists(stand.hold)
    log.derive(frame)
    if stand.hold is not None and stand.hold.freedoms:
        for key, rate in (("V", "u"), ("V_dot", "u_dot")):
            if key in log.values:
                log.values.setdefault(rate, freedom_rates(stand.hold, log.values[key]))
    return log.read()


@dataclass(eq=False)
class _Log:
    """Groups of columns of a table by the keys of `eval`: names, and values (rows, ...) of those that are there."""

    stand: Stand
    path: Path
    groups: Mapping[str, Columns]
    notes: list[str]
    values: dict[str, Array] = field(default_factory=dict)
    ignored: list[str] = field(default_factory=list)
    rows: int = 0
    error: float = 0.0

    def gather(self, frame: pd.DataFrame) -> None:
        """Take the groups of which all columns are there, in SI. Raises DataError: of some only a part is."""
        dimensions = {name: dimension for group in self.groups.values() for name, dimension in group}
        columns = dict[str, Array]()
        for header in frame:
            try:
                name, unit = split_header(header)
                if name in dimensions:
                    columns[name] = frame[header].to_numpy() * (float(factor(unit, dimensions[name])) if unit else 1.0)
                elif not is_time(header):
                    self.ignored.append(name)
            except HeaderError:
                self.ignored.append(header)
            except QuantityError as error:
                raise DataError([f'{self.path}: "{header}": {error}']) from None
        if self.ignored:
            self.notes.append(f"{len(self.ignored)} other columns are not compared")
        problems = []
        for key, group in self.groups.items():
            lacking = [name for name, _ in group if name not in columns]
            if not lacking:
                self.values[key] = np.column_stack([columns[name] for name, _ in group])
            elif len(lacking) < len(group):
                near = self._suggest(lacking[0])
                problems.append(f'{self.path}: no column "{lacking[0]}", expected with {group[0][0]}{near}')
        if problems:
            raise DataError(problems)
        if "mount_wrench" in self.values:
            self.values["mount_wrench"] = self.values["mount_wrench"].reshape(-1, len(self.stand.flywheels), 6)
        self.rows = max((len(values) for values in self.values.values()), default=0)

    def _suggest(self, name: str) -> str:
        near = nearest_name(name, self.ignored)
        return "" if near is None else f'; is it "{near}"?'

    @property
    def has_coordinates(self) -> bool:
        """Whether the pose is that of columns of coordinates of freedoms."""
        keys = {key for key in COORDINATES if key in self.groups}
        return bool(keys) and keys <= self.values.keys()

    def add_twists(self, hold: Hold) -> None:
        """V and V_dot (rows, 6) by u and u_dot where they are not there; zeros of a clamped carrier.

        Coordinates are left out where position and attitude are there, as far as the freedoms change them. Raises
        DataError: V is none that the hold allows, or not that of the u beside it.
        """
        S, values, kinds = twists(hold), self.values, {freedom.kind for freedom in hold.freedoms}
        attitude = "turn" not in kinds or bool({"quaternion", "angles"} & values.keys())
        if attitude and ("slide" not in kinds or "position" in values):
            for key in COORDINATES:
                values.pop(key, None)
        for key, rate in (("V", "u"), ("V_dot", "u_dot")):
            if not hold.freedoms:
                values.setdefault(key, np.zeros((self.rows, 6)))
            elif rate in values:
                values.setdefault(key, values[rate] @ S.T)
        for k, V in enumerate(values.get("V", ())):
            if np.isfinite(V).all() and (reason := blocked_twist(hold, V)):
                raise DataError([f"{self.path}: row {k + 1}: {reason}"])
            off = np.abs(V - S @ values["u"][k]).max() if "u" in values else 0.0
            if off > ALLOWED * max(1.0, np.abs(V).max()):
                raise DataError([f"{self.path}: row {k + 1}: V is not S u of the u beside it, off by {off:.3g}"])

    def derive(self, frame: pd.DataFrame) -> None:
        """Accelerations that are missing beside speeds, from these. Raises DataError."""
        time = next((header for header in frame if is_time(header)), None)
        for key, speeds in SPEEDS.items():
            if time is None or key not in self.groups or key in self.values or speeds not in self.values:
                continue
            t = frame[time].to_numpy() * time_scale(time)
            parts = np.split(self.values[speeds], [3], axis=1) if speeds == "V" else [self.values[speeds]]
            rates, errors = zip(*(self._rates(t, part) for part in parts), strict=True)  # of m/s and rad/s apart
            self.values[key] = np.hstack(rates)
            self.error = max(self.error, *errors)
            self.notes.append(
                f"{key} is derived from {speeds} by a spline, right to about {max(errors):.0e} of its size"
            )

    def _rates(self, t: Array, values: Array) -> tuple[Array, float]:
        """Derivatives (T, n), NaN at the ends, and their error over their size: the difference of a coarser spline."""
        finite = np.isfinite(t).all() and np.isfinite(values).all()
        if len(t) < 4 * ENDS or not finite or not (np.diff(t) > 0).all():
            words = f"expected {4 * ENDS} rows or more, at rising times, without missing numbers"
            raise DataError([f"{self.path}: accelerations are missing, and cannot be derived: {words}"])
        fine, coarse = (
            np.asarray(make_interp_spline(t[::k], values[::k], k=DEGREE).derivative()(t[::k])) for k in (1, 2)
        )
        inner = slice(ENDS // 2, -ENDS // 2)
        off = float(np.abs(coarse - fine[::2])[inner].max()) / (float(np.abs(fine).max()) or 1.0)
        fine[:ENDS] = fine[-ENDS:] = np.nan
        return fine, off

    def read(self) -> StateLog:
        """All rows with the numbers of a state. Raises DataError."""
        wants = [want for want in ANSWERS if self._answers(want)]
        self._require(wants)
        inputs = [key for key in self.values if key not in (*ANSWERS.values(), *ACCELERATIONS)]
        states: list[tuple[str, State]] = []
        answers: dict[str, dict[str, dict[str, Any]]] = {want: {} for want in wants}
        missing = dict.fromkeys(("a state", *wants), 0)
        taken = np.arange(self.rows)
        if self.rows > MOST_ROWS:
            taken = np.linspace(0, self.rows - 1, MOST_ROWS).astype(int)
            self.notes.append(f"{MOST_ROWS} of {self.rows} rows are compared, spread evenly")
        for k in taken.tolist():
            name = f"row {k + 1}"
            row = {key: self.values[key][k] for key in (*inputs, *ACCELERATIONS) if key in self.values}
            whole = {key: value.tolist() for key, value in row.items() if np.isfinite(value).all()}
            if not set(inputs) <= whole.keys():
                missing["a state"] += 1
                continue
            states.append((name, self._state(name, whole)))
            for want in wants:
                value = self.values[ANSWERS[want]][k]
                if np.isfinite(value).all() and {key for key in needs_of(want) if key in self.groups} <= whole.keys():
                    answers[want][name] = {ANSWERS[want]: value.tolist()}
                    if want == "forward" and self.stand.hold is not None:
                        answers[want][name]["u_dot"] = self.values["u_dot"][k].tolist()
                else:
                    missing[want] += 1
        self.notes += [
            f"{number} rows without all numbers of {what}: left out" for what, number in missing.items() if number
        ]
        lines = tuple(f"{self.path}: {note}" for note in self.notes)
        if not any(answers.values()):
            raise DataError([*lines, f"{self.path}: no row holds all numbers of a state and of an answer"])
        return StateLog(str(self.path), tuple(states), answers, lines, self.error)

    def _answers(self, want: str) -> bool:
        """Whether there are columns of a want and of what it needs."""
        if want == "forward" and self.stand.hold is not None and not self.stand.hold.freedoms:
            return False  # there is no motion to find
        return all(key in self.values for key in (ANSWERS[want], *(k for k in needs_of(want) if k in self.groups)))

    def _require(self, wants: Sequence[str]) -> None:
        """Raises DataError where an input of every answer is missing, or there are no answers."""
        instead = f", or {' '.join(name for name, _ in self.groups['u'])}" if "u" in self.groups else ""
        problems = [
            self._missing(key, f"every state has them{instead if key == 'V' else ''}")
            for key in ("V", "phi", "phi_dot")
            if key in self.groups and key not in self.values
        ]
        if not problems and not wants:
            need = next((key for key in ("V_dot", "phi_ddot") if key in self.groups and key not in self.values), "tau")
            problems.append(self._missing(need, "there is nothing to compare"))
        attitude = {"quaternion", "angles"} & self.values.keys()
        if not problems and not self.has_coordinates:
            for key, there in (("quaternion", attitude), ("position", self.values.keys() & {"position"})):
                if not there and depends_on(self.stand, wants, key):
                    what = "attitude" if key == "quaternion" else key
                    problems.append(self._missing(key, f"this stand depends on its {what}"))
        if len(attitude) > 1:
            problems.append(f"{self.path}: columns of a quaternion and of angles, expected one of them")
        if problems:
            raise DataError(problems)

    def _missing(self, key: str, reason: str) -> str:
        names = [name for name, _ in self.groups[key]] if key in self.groups else [key]
        return f'{self.path}: no columns "{names[0]}" to "{names[-1]}": {reason}{self._suggest(names[0])}'

    def _state(self, name: str, row: dict[str, Any]) -> State:
        """The state of a row; of a held carrier in the pose of its coordinates, or of position and attitude."""
        try:
            if self.stand.hold is None:
                return read_request(self.stand, {**row, "want": ["forward"]}).state
            keys = {key: row[key] for key in row if key not in (*COORDINATES, "V", "V_dot")}
            state = read_request(self.stand, {**keys, "want": ["forward"]}).state
            if self.has_coordinates:
                turned = np.array(row["orientation"]) if "orientation" in row else None
                return at_coordinates(self.stand, state, np.array(row.get("q", ())), turned)
            return with_pose(self.stand, state, keys)
        except StateError as error:
            raise DataError([f"{self.path}: {name}: {error}"]) from None
