"""Regime file (TOML or JSON) -> Regime. Every problem of the file is found before any is reported."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.core.motion import ranges, table
from mahovik.core.motion.document import parse as parse_json
from mahovik.core.motion.entry import DRIVEN_KEYS, LAWS, Entry, law_of
from mahovik.core.motion.laws import Constant, WrenchTable
from mahovik.core.motion.regime import Driven, Regime
from mahovik.core.stand.content import content
from mahovik.core.stand.model import Stand
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.toml import parse
from mahovik.core.stand.units import ANGLE, SPEED, Dimension, QuantityError, number, show
from mahovik.errors import RegimeError
from mahovik.nearest import meant

_KEYS = ("schema", "name", "default", "flywheel", "wrench")
_FORCE, _MOMENT = Dimension("a force", "N"), Dimension("a moment", "N m")
_WRENCH = {"X": _FORCE, "Y": _FORCE, "Z": _FORCE, "K": _MOMENT, "M": _MOMENT, "N": _MOMENT}


def steady(stand: Stand, speeds: Sequence[float]) -> Regime:
    """Every flywheel keeps the speed it has (rad/s); no wrench."""
    driven = (Driven(s.name, Constant(speed)) for s, speed in zip(stand.flywheels, speeds, strict=True))
    return Regime("steady", tuple(driven), {})


def load(path: str | Path, stand: Stand, until: float) -> Regime:
    """Read and check the regime file at `path` for a run of `until` s. Raises RegimeError with every problem."""
    path = Path(path)
    try:
        text = content(path).decode("utf-8-sig")
    except OSError as error:
        raise RegimeError([f"{path}: cannot be read: {error.strerror or error}"]) from None
    except ValueError as error:  # not UTF-8, or a NUL in the name
        raise RegimeError([f"{show(str(path))}: not UTF-8 text: {error}"]) from None
    return loads(text, stand, until, path.name, path.parent, is_json=path.suffix.lower() == ".json")


def loads(
    text: str, stand: Stand, until: float, source: str = "regime", folder: Path = Path(), is_json: bool = False
) -> Regime:
    """Read and check a regime given as text; its tables lie in `folder`. Raises RegimeError."""
    try:
        document = parse_json(text) if is_json else parse(text)
    except (RecursionError, ValueError) as error:
        raise RegimeError([f"{source}: not {'JSON' if is_json else 'TOML'}: {error}"]) from None
    problems = Problems(source)
    if not isinstance(document, dict):
        raise RegimeError([f"{source}: expected an object, found {show(document)}"])
    if "schema" not in document:
        raise RegimeError([f"{source}: schema: required, but missing"])
    if document["schema"] != 1:
        raise RegimeError([f"{source}: schema: expected 1, found {show(document['schema'])}"])
    for key in document:
        if key not in _KEYS:
            problems.add(f"unknown key {show(key)}{meant(key, _KEYS)}")
    name = document.get("name", Path(source).stem)
    if not isinstance(name, str):
        problems.add("name", f"expected a string, found {show(name)}")
    flywheels = _flywheels(document, stand, problems, until, folder)
    wrenches = _wrenches(document, stand, problems, until, folder)
    if problems.lines:
        raise RegimeError(problems.lines)
    return Regime(str(name), tuple(flywheels), wrenches)


def _tables(document: dict[str, Any], key: str, names: list[str], what: str, problems: Problems) -> dict[str, Any]:
    """The table `key` of the file, from known names to what stands there."""
    given = document.get(key, {})
    if not isinstance(given, dict):
        problems.add(key, f"expected a table of {what}s, found {show(given)}")
        return {}
    for name in given:
        if name not in names:
            problems.add(key, f"unknown {what} {show(name)}{meant(name, names, 'the stand has none')}")
    return {name: value for name, value in given.items() if name in names}


def _flywheels(document: dict[str, Any], stand: Stand, problems: Problems, until: float, folder: Path) -> list[Driven]:
    names = [s.name for s in stand.flywheels]
    given = _tables(document, "flywheel", names, "flywheel", problems)
    default = document.get("default")
    if default is not None:
        _driven("default", "default", default, problems, until, folder)  # its problems, once
    found = []
    for name in names:
        if name in given:
            found.append(_driven(name, f"flywheel {show(name)}", given[name], problems, until, folder, default))
        elif default is None:
            problems.add(f"flywheel {show(name)}", "has no law: give it one, or a `default` for all that are not named")
        else:
            found.append(_driven(name, "default", default, problems, until, folder))
    return found


def _driven(
    name: str, where: str, given: Any, problems: Problems, until: float, folder: Path, default: Any = None
) -> Driven:
    """One flywheel's entry; where it has no law of its own, the law of `default`."""
    nothing = Driven(name, Constant(0.0))
    if not isinstance(given, dict):
        problems.add(where, f"expected a table with a law, found {show(given)}")
        return nothing
    known = [*LAWS, *DRIVEN_KEYS]
    for key in given:
        if key not in known:
            problems.add(where, f"unknown key {show(key)}{meant(key, known)}")
    own = [key for key in LAWS if key in given]
    if len(own) > 1:
        problems.add(where, f"{', '.join(own)}: exactly one law, not {len(own)}")
        return nothing
    if not own and isinstance(default, dict):
        given = {**default, **given}
        own = [key for key in LAWS if key in given][:1]
    if not own:
        problems.add(where, f"no law: expected one of {', '.join(LAWS)}")
        return nothing
    law = law_of(Entry(where, own[0], given[own[0]], problems, until, folder))
    phase = _optional(where, given, "phase", ANGLE, problems, ranges.MAX_PHASE)
    speed = _optional(where, given, "initial_speed", SPEED, problems, ranges.MAX_SPEED)
    if law is None:
        return nothing
    driven = Driven(name, law, phase, speed)
    if speed is not None and not driven.by_torque:
        problems.add(where, "initial_speed", f"goes with a law of torque; here `{own[0]}` gives the speed")
    return driven


def _optional(
    where: str, given: dict[str, Any], key: str, dimension: Dimension, problems: Problems, most: float
) -> float | None:
    if key not in given:
        return None
    try:
        found = number(given[key], dimension)
        out = ranges.out_of_range(dimension.words, found, most, dimension.si)
        if out is None:
            return found
        problems.add(where, key, out)
        return None
    except QuantityError as error:
        problems.add(where, key, str(error))
        return None


def _wrenches(
    document: dict[str, Any], stand: Stand, problems: Problems, until: float, folder: Path
) -> dict[str, WrenchTable]:
    found = {}
    for body, given in _tables(document, "wrench", [b.name for b in stand.bodies], "body", problems).items():
        where = f"wrench {show(body)}"
        if isinstance(given, list) and len(given) == len(_WRENCH):
            values = []
            for (letter, dimension), raw in zip(_WRENCH.items(), given, strict=True):
                try:
                    values.append(number(raw, dimension))
                    _in_range(where, letter, values[-1], problems)
                except QuantityError as error:
                    problems.add(where, letter, str(error))
                    values.append(0.0)
            found[body] = WrenchTable(np.zeros(1), np.array([values]))
        elif isinstance(given, str):
            try:
                read = table.read(folder / given, _WRENCH, until)
            except table.TableError as error:
                problems.add(where, str(error))
                continue
            columns = [read.columns.get(letter, np.zeros_like(read.times)) for letter in _WRENCH]
            found[body] = WrenchTable(read.times, np.column_stack(columns))
            for letter, column in zip(_WRENCH, columns, strict=True):
                _in_range(where, letter, float(column[np.argmax(np.abs(column))]), problems)
        else:
            problems.add(where, f"expected six numbers or the name of a CSV file, found {show(given)}")
    return found


def _in_range(where: str, letter: str, value: float, problems: Problems) -> None:
    """Note a component of a wrench that is too large."""
    dimension = _WRENCH[letter]
    out = ranges.out_of_range(dimension.words, value, ranges.MAX_WRENCH, dimension.si)
    if out is not None:
        problems.add(where, letter, out)
