"""The evaluation contract on lines of JSON: states in, results out, with every check of the contract."""

from __future__ import annotations

import codecs
import json
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import cycle
from types import MappingProxyType
from typing import IO, Any, cast

from mahovik.contract.evaluation import STATE
from mahovik.contract.functions import ALL_WANTS, TASK_CONFLICTS, TASK_WANTS, WANTS, hold_fault, want_fault
from mahovik.contract.quantities import QUANTITIES, UNIT_LENGTH, Quantity
from mahovik.core.stand.hold import has_coordinates, no_coordinates, twist_of
from mahovik.core.stand.model import Stand, Vec6
from mahovik.core.stand.state import Quaternion, State
from mahovik.core.stand.units import show
from mahovik.errors import StateError, count_numbers
from mahovik.nearest import suggestion
from mahovik.proof.verify.actuators import actuators_of
from mahovik.proof.verify.backends import Backend
from mahovik.proof.verify.json_text import members

ROUNDING = 4 * 2.0**-52
"""Rounding of four squares and a root: a quaternion this near to unit length stays as it is, so that states replay."""

HELD_KEYS = {"u": "V", "u_dot": "V_dot"}
"""Keys of a state of a held carrier, and those that they stand for."""


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
        raise StateError(f"expected an object, found {excerpt(found)}")
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
        if key not in STATE:
            raise StateError(f"unknown key {show(key)}{suggestion(key, STATE)}")
        if isinstance(value, _RepeatedKeys):
            raise StateError(f'{key}: key "{value.key}" appears twice')
    if "angles" in found and "quaternion" in found:
        raise StateError("angles, quaternion: both given, expected one of them")
    want = _want(found)
    if "generalized" in want and "quaternion" in found and stand.hold is None:
        raise StateError("quaternion: `generalized` needs `angles`")
    given: dict[str, Any] = {
        row.symbol: _numbers(found, row, len(stand.flywheels) if row.count == "N" else int(row.count), real)
        for row in QUANTITIES.values()
        if row.input and row.symbol != "wrench"
    }
    given["angles"] = given["angles"] if "angles" in found else None
    quaternion = _quaternion(found) if "quaternion" in found else None
    task, demand = _task(stand, found, want, real)
    given |= freedoms_of(stand, found, want, real)
    given["actuators"] = _actuators(stand, found, real)
    state = State(**given, quaternion=quaternion, wrench=_wrench(stand, found, real), task=task, demand=demand)
    return Request(identifier(found), state, want)


def read_line(stand: Stand, line: str, real: str = "double") -> Request:
    """The request in a line of text. Raises StateError."""
    return read_request(stand, read_object(line), real)


def refuse_duplicates(found: dict[str, Any]) -> None:
    """Raises StateError where an object that `read_object` gave has a key twice."""
    if isinstance(found, _RepeatedKeys):
        raise StateError(f'key "{found.key}" appears twice')


def _integer(digits: str) -> int | float:
    """An integer; Python reads no thousands of digits, and they are beyond every range."""
    return int(digits) if len(digits) < 4000 else float("inf")


class _RepeatedKeys(dict[str, Any]):
    """An object with a key given twice; JSON leaves open which of them counts."""

    key = ""


def _without_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) == len(pairs):
        return found
    marked = _RepeatedKeys(found)
    seen: set[str] = set()
    for key, _ in pairs:
        if key in seen:
            marked.key = key
        seen.add(key)
    return marked


def excerpt(value: Any) -> str:
    """A value for a message, at most 40 characters."""
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
        raise StateError(f"want: expected a list of names, found {excerpt(given)}")
    if not given:
        raise StateError(f"want: empty, expected at least one of {', '.join(WANTS)}")
    for name in given:
        if not isinstance(name, str):
            raise StateError(f"want: expected names, found {excerpt(name)}")
        if name not in ALL_WANTS:
            raise StateError(f'want: unknown "{name}"{suggestion(name, ALL_WANTS)}')
        if name in TASK_WANTS and "task" not in found:
            raise StateError(f'want: "{name}" needs a task, {{"task": NAME, "demand": [...]}}')
    if fault := want_fault(given):
        raise StateError(fault)
    return tuple(given)


def _numbers(found: dict[str, Any], row: Quantity, count: int, real: str) -> tuple[float, ...]:
    """The numbers of a quantity, zeros where it is missing."""
    if row.symbol not in found:
        return (0.0,) * count
    return _list_of(found[row.symbol], row.symbol, count, row.limits(real))


def _list_of(given: Any, where: str, count: int, limits: Sequence[float]) -> tuple[float, ...]:
    """`count` finite numbers within their limits in magnitude, which repeat."""
    if not isinstance(given, list):
        raise StateError(f"{where}: expected a list of {count_numbers(count)}, found {excerpt(given)}")
    if len(given) != count:
        raise StateError(f"{where}: expected {count_numbers(count)}, found {len(given)}")
    numbers = tuple(_number(value, f"{where}[{i}]") for i, value in enumerate(given))
    for i, (number, limit) in enumerate(zip(numbers, cycle(limits), strict=False)):
        if abs(number) > limit:
            raise StateError(f"{where}[{i}]: {number:.9g} is out of range, at most {limit:g} in magnitude")
    return numbers


def freedoms_of(stand: Stand, found: dict[str, Any], want: Sequence[str], real: str) -> dict[str, Any]:
    """u, u_dot (m each) of a held carrier, and the V, V_dot they give; nothing of a free one. Raises StateError."""
    if fault := hold_fault(want, stand.hold is not None):
        raise StateError(fault)
    if stand.hold is None:
        for key, other in HELD_KEYS.items():
            if key in found:
                raise StateError(f"{key}: the stand has no [hold], expected {other}")
        return {}
    if "generalized" in want and not has_coordinates(stand.hold):
        raise StateError(f'want: no "generalized": {no_coordinates(stand.hold)}; ask for forward')
    count, given = len(stand.hold.freedoms), {}
    if count and "reaction" in want and not found.keys() & {"u_dot", "V_dot"}:
        raise StateError(
            f'u_dot: missing, but "reaction" is that of a given motion, expected {count} number{"s"[: count > 1]}; '
            "ask for forward to find the free motion and its reaction"
        )
    for key, other in HELD_KEYS.items():
        if other in found:
            raise StateError(f"{other}: the carrier is held, expected {key}, {count_numbers(count)}")
        given[key] = _list_of(found.get(key, [0.0] * count), key, count, (math.inf,))
        given[other] = twist_of(stand.hold, given[key])
        for i, (number, limit) in enumerate(zip(given[other], cycle(QUANTITIES[other].limits(real)), strict=False)):
            if not abs(number) <= limit:
                raise StateError(
                    f"{key}: gives {other}[{i}] = {number:.9g}, which is out of range, at most {limit:g} in magnitude"
                )
    return given


def _number(given: Any, where: str) -> float:
    if isinstance(given, bool) or not isinstance(given, int | float):
        raise StateError(f"{where}: expected a number, found {excerpt(given)}")
    try:
        number = float(given)
    except OverflowError:
        raise StateError(f"{where}: {excerpt(given)} is not finite as a double") from None
    if not math.isfinite(number):
        raise StateError(f"{where}: {excerpt(given)} is not finite")
    return number


def _quaternion(found: dict[str, Any]) -> Quaternion:
    q = _list_of(found["quaternion"], "quaternion", 4, (math.inf,))
    length = math.hypot(*q)
    if not abs(length - 1.0) <= UNIT_LENGTH:
        raise StateError(f"quaternion: length {length:.9g}, expected 1 within {UNIT_LENGTH:g}")
    if abs(length - 1.0) <= ROUNDING:
        return cast(Quaternion, q)
    return cast(Quaternion, tuple(x / length for x in q))


def _task(stand: Stand, found: dict[str, Any], want: Sequence[str], real: str) -> tuple[str, tuple[float, ...]]:
    """The task of a state and what it demands; "" and nothing without one."""
    if "task" not in found:
        if "demand" in found:
            raise StateError('demand: needs a task, {"task": NAME, "demand": [...]}')
        return "", ()
    name, rows = found["task"], {task.name: len(task.rows) for task in stand.tasks}
    if not isinstance(name, str):
        raise StateError(f"task: expected the name of a task, found {excerpt(name)}")
    if name not in rows:
        raise StateError(f'task: unknown "{name}"{suggestion(name, rows, "the stand has none, [task.NAME]")}')
    if "V_dot" in found:
        raise StateError("V_dot, task: both given, expected one of them")
    if "demand" not in found:
        raise StateError(f"demand: missing, expected {count_numbers(rows[name])}")
    for other in TASK_CONFLICTS:
        if other in want:
            raise StateError(f'want: "{other}" and the task both give V_dot, ask for them in two states')
    return name, _list_of(found["demand"], "demand", rows[name], QUANTITIES["V_dot"].limits(real))


def _wrench(stand: Stand, found: dict[str, Any], real: str) -> MappingProxyType[str, Vec6]:
    given = found.get("wrench", {})
    if not isinstance(given, dict):
        raise StateError(f"wrench: expected an object of bodies, found {excerpt(given)}")
    bodies = [body.name for body in stand.bodies]
    for name in given:
        if name not in bodies:
            raise StateError(f'wrench: unknown body "{name}"{suggestion(name, bodies)}')
    limits = QUANTITIES["wrench"].limits(real)
    values = {name: cast(Vec6, _list_of(value, f"wrench, {name}", 6, limits)) for name, value in given.items()}
    return MappingProxyType(values)


def _actuators(stand: Stand, found: dict[str, Any], real: str) -> MappingProxyType[str, float]:
    given, known = found.get("actuators", {}), actuators_of(stand)
    if not isinstance(given, dict):
        raise StateError(f"actuators: expected an object of fins and propellers, found {excerpt(given)}")
    values = {}
    for name, value in given.items():
        if name not in known:
            near = suggestion(name, known, "the stand has neither fins nor propellers")
            raise StateError(f'actuators: unknown "{name}"{near}')
        row, where = known[name], f"actuators, {name}"
        most = row.limit or QUANTITIES["phi_dot"].limits(real)[0]
        values[name] = _number(value, where)
        if abs(values[name]) > most:
            raise StateError(f"{where}: {values[name]:.9g} is out of range for its {row.what}, at most {most:g}")
    return MappingProxyType(values)


LONGEST = 16_000_000
"""Longest line, bytes; longer ones hold no state of any stand and are not kept."""


def split_lines(stream: IO[bytes]) -> Iterator[bytes]:
    """Lines of a stream as they arrive; one that is too long is cut just beyond the limit."""
    while line := stream.readline(LONGEST + 1):
        yield line
        while len(line) > LONGEST and not line.endswith(b"\n"):
            line = stream.readline(LONGEST + 1)


def evaluate_lines(
    stand: Stand, backend: Backend, lines: Iterable[bytes], real: str = "double"
) -> Iterator[tuple[str, bool]]:
    """For every line that is not blank, in order: a line of strict JSON, and whether the state was evaluated."""
    for number, raw in enumerate(lines):
        line = raw.removeprefix(codecs.BOM_UTF8) if number == 0 else raw
        if line.strip():
            yield evaluate_line(stand, backend, line, real)


def evaluate_line(stand: Stand, backend: Backend, line: bytes, real: str = "double") -> tuple[str, bool]:
    """The result of one line, an error line where it cannot be evaluated."""
    given: Any = None
    try:
        if len(line) > LONGEST:
            raise StateError(f"a line of more than {LONGEST} bytes")
        found = read_object(_text(line))
        given = identifier(found)
        request = read_request(stand, found, real)
        values = backend.evaluate(request.state, request.want)
        return _line(given, values), True
    except StateError as error:
        return _line(given, {"error": str(error)}), False


def _line(given: Any, values: dict[str, Any]) -> str:
    """The id as it was given (any JSON value, nested however deep), then the values."""
    return f'{{"id": {json.dumps(given)}, {members(values)}}}'


def _text(line: bytes) -> str:
    try:
        return line.decode("utf-8")
    except UnicodeDecodeError as error:
        raise StateError(f"not UTF-8: byte 0x{line[error.start]:02x}") from None


def state_object(state: State) -> dict[str, Any]:
    """The keys of a state as in a line, without those that are zero."""
    found: dict[str, Any] = {}
    if any(state.position):
        found["position"] = state.position
    if state.angles is not None:
        found["angles"] = state.angles
    if state.quaternion is not None:
        found["quaternion"] = state.quaternion
    held = state.u or state.u_dot
    for key in ("V", "phi", "phi_dot", "phi_ddot", "V_dot", "tau", "u", "u_dot"):
        if any(getattr(state, key)) and not (held and key in HELD_KEYS.values()):
            found[key] = getattr(state, key)
    if state.task:
        found |= {"task": state.task, "demand": state.demand}
    wrench = {name: value for name, value in state.wrench.items() if any(value)}
    if wrench:
        found["wrench"] = wrench
    if state.actuators:
        found["actuators"] = dict(state.actuators)
    return found


def state_line(request: Request) -> str:
    """The line that asks for a request: reading it back gives the same numbers."""
    required = {"u_dot": request.state.u_dot} if request.state.u_dot and "reaction" in request.want else {}
    return _line(request.id, {**state_object(request.state), **required, "want": list(request.want)})
