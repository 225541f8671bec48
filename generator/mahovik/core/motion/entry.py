"""One law as a regime file gives it: its keys, their units, what is required."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mahovik.core.motion import ranges, table
from mahovik.core.motion.laws import (
    Constant,
    Harmonic,
    Law,
    LogSweep,
    Ramp,
    RunUp,
    SpeedTable,
    Torque,
    TorqueTable,
)
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import ANGLE, SPEED, TIME, TORQUE, Dimension, QuantityError, number, show
from mahovik.nearest import meant

FREQUENCY = Dimension("a frequency", "Hz")
DRIVEN_KEYS = ("phase", "initial_speed")
"""Keys of a flywheel beside its law."""


@dataclass(frozen=True)
class Entry:
    """A law's name and what stands there, with where to report."""

    where: str
    law: str
    given: Any
    problems: Problems
    until: float
    folder: Path

    def number(self, key: str, raw: Any, dimension: Dimension) -> float | None:
        """A number in SI, or None with a problem noted."""
        try:
            return number(raw, dimension)
        except QuantityError as error:
            self.problems.add(self.where, self.law, key, str(error))
            return None

    def turning(self, key: str, raw: Any) -> float | None:
        """A speed; of a sweep also turns a second, in Hz."""
        try:
            return number(raw, SPEED)
        except QuantityError as error:
            try:
                return 2 * math.pi * number(raw, FREQUENCY)
            except QuantityError:
                self.problems.add(self.where, self.law, key, str(error).partition(", a frequency")[0])
                return None

    def refuse(self, key: str, reason: str) -> None:
        """Note a problem of one key."""
        self.problems.add(self.where, self.law, key, reason)


Dimensions = dict[str, tuple[Dimension, float | None]]
_RAMP: Dimensions = {"from": (SPEED, 0.0), "to": (SPEED, None), "duration": (TIME, None), "start": (TIME, 0.0)}
_HARMONIC: Dimensions = {
    "mean": (SPEED, 0.0), "amplitude": (SPEED, None), "frequency": (FREQUENCY, None), "phase": (ANGLE, 0.0),
}  # fmt: skip
_RUN_UP: Dimensions = {"torque": (TORQUE, None), "to": (SPEED, None), "band": (SPEED, 0.0)}


def _members(entry: Entry, keys: Dimensions, words: tuple[str, ...] = ()) -> dict[str, float] | None:
    """The numbers of a law that is a table; `words` are further keys. None where something is wrong."""
    if not isinstance(entry.given, dict):
        entry.refuse("", f"expected a table with {', '.join(keys)}, found {show(entry.given)}")
        return None
    known = [*keys, *words]
    good = True
    for key in entry.given:
        if key not in known:
            entry.refuse("", f"unknown key {show(key)}{meant(key, known)}")
            good = False
    found: dict[str, float] = {}
    for key, (dimension, default) in keys.items():
        if key not in entry.given and default is None:
            entry.refuse(key, "required, but missing")
            good = False
            continue
        value: float | None = default
        if key in entry.given:
            raw = entry.given[key]
            value = entry.turning(key, raw) if entry.law == "sweep" and dimension is SPEED else None
            if entry.law != "sweep" or dimension is not SPEED:
                value = entry.number(key, raw, dimension)
        if value is None:
            good = False
        else:
            found[key] = value
    for key in ("duration", "frequency"):
        if key in found and found[key] <= 0.0:
            entry.refuse(key, f"{found[key]:g} is not above 0")
            good = False
    if found.get("start", 0.0) < 0.0:
        entry.refuse("start", f"{found['start']:g} is negative")
        good = False
    return found if good else None


def _speed(entry: Entry) -> Law | None:
    value = entry.number("", entry.given, SPEED)
    return None if value is None else Constant(value)


def _hold(entry: Entry) -> Law | None:
    if entry.given is True:
        return Constant(0.0)
    entry.refuse("", f"expected true, found {show(entry.given)}")
    return None


def _ramp(entry: Entry) -> Law | None:
    found = _members(entry, _RAMP)
    return None if found is None else Ramp(found["from"], found["to"], found["start"], found["duration"])


def _sweep(entry: Entry) -> Law | None:
    found = _members(entry, _RAMP | {"from": (SPEED, None)}, ("scale",))
    scale = entry.given.get("scale", "linear") if isinstance(entry.given, dict) else "linear"
    if scale not in ("linear", "log"):
        entry.refuse("scale", f'expected "linear" or "log", found {show(scale)}')
        return None
    if found is None:
        return None
    if scale == "linear":
        return Ramp(found["from"], found["to"], found["start"], found["duration"])
    if found["from"] * found["to"] <= 0.0:
        entry.refuse("", "a log sweep goes between two speeds of one sign, neither of them zero")
        return None
    return LogSweep(found["from"], found["to"], found["start"], found["duration"])


def _harmonic(entry: Entry) -> Law | None:
    found = _members(entry, _HARMONIC)
    return None if found is None else Harmonic(*(found[key] for key in _HARMONIC))


def _torque(entry: Entry) -> Law | None:
    value = entry.number("", entry.given, TORQUE)
    return None if value is None else Torque(value)


def _run_up(entry: Entry) -> Law | None:
    found = _members(entry, _RUN_UP)
    if found is None:
        return None
    if found["torque"] <= 0.0:
        entry.refuse("torque", f"{found['torque']:g} is not above 0; the sign of `to` gives the direction")
        return None
    if found["band"] < 0.0:
        entry.refuse("band", f"{found['band']:g} is negative")
        return None
    return RunUp(found["torque"], found["to"], found["band"] or max(0.01 * abs(found["to"]), 0.1))


def _table(entry: Entry) -> Law | None:
    if not isinstance(entry.given, str):
        entry.refuse("", f"expected the name of a CSV file, found {show(entry.given)}")
        return None
    try:
        read = table.read(entry.folder / entry.given, {"phi_dot": SPEED, "torque": TORQUE}, entry.until)
    except table.TableError as error:
        entry.refuse("", str(error))
        return None
    if len(read.columns) > 1:
        entry.refuse("", f"{entry.given}: has phi_dot and torque, expected one of them")
        return None
    if "torque" in read.columns:
        return TorqueTable(read.times, read.columns["torque"])
    return SpeedTable.of(read.times, read.columns["phi_dot"])


LAWS: dict[str, Callable[[Entry], Law | None]] = {
    "speed": _speed,
    "hold": _hold,
    "ramp": _ramp,
    "sweep": _sweep,
    "harmonic": _harmonic,
    "torque": _torque,
    "run_up": _run_up,
    "table": _table,
}
"""Readers by the key that names the law."""


def law_of(entry: Entry) -> Law | None:
    """The law of an entry, or None with its problems noted."""
    law = LAWS[entry.law](entry)
    out = None if law is None else ranges.problem(law)
    if out is None:
        return law
    entry.refuse("", out)
    return None
