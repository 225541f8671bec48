"""One line of states: JSON in, (id, State, want) out, with every check of the evaluation contract."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import cycle
from types import MappingProxyType
from typing import Any, cast

from mahovik.contract.functions import CONFLICTS, WANTS
from mahovik.contract.quantities import QUANTITIES, UNIT_LENGTH, Quantity
from mahovik.core.stand.model import Stand, Vec6
from mahovik.core.stand.state import Quaternion, State
from mahovik.errors import StateError
from mahovik.nearest import meant

ROUNDING = 4 * 2.0**-52
"""Rounding of four squares and a root: a quaternion this near to unit length stays as it is, so that states replay."""

KEYS = ("id", "quaternion", *(row.symbol for row in QUANTITIES.values() if row.input), "want")


@dataclass(frozen=True)
class Request:
    """A line that can be evaluated."""

    id: Any
    state: State
    want: tuple[str, ...]


def read_object(line: str) -> dict[str, Any]:
    """The JSON object of a line. StateError where the line holds anything else: it has no id."""
    try:
        found = json.loads(line, object_pairs_hook=_without_duplicates, parse_int=_integer)
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}" if "\n" in line.strip() else f"column {error.colno}"
        raise StateError(f"not JSON: {error.msg} at {where}") from None
    except RecursionError:
        raise StateError("not readable: nested too deeply") from None
    if not isinstance(found, dict):
        raise StateError(f"expected an object, found {shown(found)}")
    return found


def identifier(found: dict[str, Any]) -> Any:
    """The id of an object. StateError where strict JSON cannot repeat it."""
    given = found.get("id")
    try:
        json.dumps(given, allow_nan=False)
    except (ValueError, RecursionError):
        raise StateError("id: cannot be repeated in strict JSON") from None
    return given


def read_request(stand: Stand, found: dict[str, Any], real: str = "double") -> Request:
    """The request in a line's object. StateError names the key, what was found and what was expected."""
    refuse_duplicates(found)
    for key, value in found.items():
        if key not in KEYS:
            raise StateError(f'unknown key "{key}"{meant(key, KEYS)}')
        duplicated = _duplicate_in(value)
        if duplicated is not None:
            raise StateError(f'{key}: key "{duplicated}" is there twice')
    if "angles" in found and "quaternion" in found:
        raise StateError("angles, quaternion: both given, expected one of them")
    want = _want(found)
    if "generalized" in want and "quaternion" in found:
        raise StateError("quaternion: `generalized` needs `angles`")
    given: dict[str, Any] = {
        row.symbol: _numbers(found, row, len(stand.flywheels) if row.count == "N" else int(row.count), real)
        for row in QUANTITIES.values()
        if row.input and row.symbol != "wrench"
    }
    given["angles"] = given["angles"] if "angles" in found else None
    quaternion = _quaternion(found) if "quaternion" in found else None
    state = State(**given, quaternion=quaternion, wrench=_wrench(stand, found, real))
    return Request(identifier(found), state, want)


def read_line(stand: Stand, line: str, real: str = "double") -> Request:
    """The request in a line of text. Raises StateError."""
    return read_request(stand, read_object(line), real)


def refuse_duplicates(found: dict[str, Any]) -> None:
    """Raises StateError where an object that `read_object` gave has a key twice."""
    if isinstance(found, _Duplicated):
        raise StateError(f'key "{found.key}" is there twice')


def _integer(digits: str) -> int | float:
    """An integer; Python reads no thousands of digits, and they are beyond every range."""
    return int(digits) if len(digits) < 4000 else float("inf")


class _Duplicated(dict[str, Any]):
    """An object with a key given twice; JSON leaves open which of them counts."""

    key = ""


def _without_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) == len(pairs):
        return found
    marked = _Duplicated(found)
    seen: set[str] = set()
    for key, _ in pairs:
        if key in seen:
            marked.key = key
        seen.add(key)
    return marked


def _duplicate_in(value: Any) -> str | None:
    return value.key if isinstance(value, _Duplicated) else None


def shown(value: Any) -> str:
    """A value in a message: short, whatever it is."""
    try:
        text = json.dumps(value)
    except (ValueError, RecursionError):
        return "something nested too deeply"
    return text if len(text) <= 40 else text[:37] + "..."


def _want(found: dict[str, Any]) -> tuple[str, ...]:
    if "want" not in found:
        raise StateError(f"want: missing, expected a list of {', '.join(WANTS)}")
    given = found["want"]
    if not isinstance(given, list):
        raise StateError(f"want: expected a list of names, found {shown(given)}")
    if not given:
        raise StateError(f"want: empty, expected at least one of {', '.join(WANTS)}")
    for name in given:
        if not isinstance(name, str):
            raise StateError(f"want: expected names, found {shown(name)}")
        if name not in WANTS:
            raise StateError(f'want: unknown "{name}"{meant(name, WANTS)}')
    for first, second, value in CONFLICTS:
        if first in given and second in given:
            raise StateError(f'want: "{first}" and "{second}" both give {value}, ask for them in two states')
    return tuple(given)


def _numbers(found: dict[str, Any], row: Quantity, count: int, real: str) -> tuple[float, ...]:
    """The numbers of a quantity, zeros where it is missing."""
    if row.symbol not in found:
        return (0.0,) * count
    return _list_of(found[row.symbol], row.symbol, count, row.limits(real))


def _list_of(given: Any, where: str, count: int, limits: Sequence[float]) -> tuple[float, ...]:
    """`count` finite numbers within their limits in magnitude, which repeat."""
    if not isinstance(given, list):
        raise StateError(f"{where}: expected a list of {count} numbers, found {shown(given)}")
    if len(given) != count:
        raise StateError(f"{where}: expected {count} numbers, found {len(given)}")
    numbers = tuple(_number(value, f"{where}[{i}]") for i, value in enumerate(given))
    for i, (number, limit) in enumerate(zip(numbers, cycle(limits), strict=False)):
        if abs(number) > limit:
            raise StateError(f"{where}[{i}]: {number:.9g} is out of range, at most {limit:g} in magnitude")
    return numbers


def _number(given: Any, where: str) -> float:
    if isinstance(given, bool) or not isinstance(given, int | float):
        raise StateError(f"{where}: expected a number, found {shown(given)}")
    try:
        number = float(given)
    except OverflowError:
        raise StateError(f"{where}: {shown(given)} is not finite as a double") from None
    if not math.isfinite(number):
        raise StateError(f"{where}: {shown(given)} is not finite")
    return number


def _quaternion(found: dict[str, Any]) -> Quaternion:
    q = _list_of(found["quaternion"], "quaternion", 4, (math.inf,))
    length = math.hypot(*q)
    if not abs(length - 1.0) <= UNIT_LENGTH:
        raise StateError(f"quaternion: length {length:.9g}, expected 1 within {UNIT_LENGTH:g}")
    if abs(length - 1.0) <= ROUNDING:
        return cast(Quaternion, q)
    return cast(Quaternion, tuple(x / length for x in q))


def _wrench(stand: Stand, found: dict[str, Any], real: str) -> MappingProxyType[str, Vec6]:
    given = found.get("wrench", {})
    if not isinstance(given, dict):
        raise StateError(f"wrench: expected an object of bodies, found {shown(given)}")
    bodies = [body.name for body in stand.bodies]
    for name in given:
        if name not in bodies:
            raise StateError(f'wrench: unknown body "{name}"{meant(name, bodies)}')
    limits = QUANTITIES["wrench"].limits(real)
    return MappingProxyType(
        {name: cast(Vec6, _list_of(value, f"wrench, {name}", 6, limits)) for name, value in given.items()}
    )
