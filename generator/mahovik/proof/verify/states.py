"""The evaluation contract on lines of JSON: states in, results out, with every check of the contract."""

from __future__ import annotations

import codecs
import json
import math
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import cycle
from types import MappingProxyType
from typing import IO, Any, Protocol, cast

from mahovik.contract.evaluation import STATE
from mahovik.contract.functions import ALL_WANTS, TASK_CONFLICTS, TASK_WANTS, WANTS, hold_fault, want_fault
from mahovik.contract.quantities import QUANTITIES, UNIT_LENGTH
from mahovik.core.stand.hold import has_coordinates, no_coordinates, twist_of
from mahovik.core.stand.law import Actuator, BodyLaw
from mahovik.core.stand.laws import body_laws
from mahovik.core.stand.model import Quaternion, Stand, State, Vec6
from mahovik.core.stand.units import show
from mahovik.errors import StateError, count_numbers
from mahovik.nearest import suggestion

ROUNDING = 4 * 2.0**-52
"""Rounding of four squares and a root: a quaternion this near to unit length stays as it is, so that states replay."""

INPUTS = {row.symbol: row.count for row in QUANTITIES.values() if row.input and row.symbol != "wrench"}
"""Keys of a state that are lists of numbers of a quantity, and how many: N, one for each flywheel."""

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
        document = json.loads(line, object_pairs_hook=_without_duplicates, parse_int=_integer)
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}" if "\n" in line.strip() else f"column {error.colno}"
        raise StateError(f"not JSON: {error.msg} at {where}") from None
    except RecursionError:
        raise StateError("not readable: nested too deeply") from None
    if not isinstance(document, dict):
        raise StateError(f"expected an object, found {excerpt(document)}")
    return document


def identifier(document: dict[str, Any]) -> Any:
    """The id of an object. StateError where strict JSON cannot repeat it."""
    identity = document.get("id")
    try:
        json.dumps(identity, allow_nan=False)
    except (ValueError, RecursionError):
        raise StateError("id: cannot be repeated in strict JSON") from None
    return identity


def read_request(stand: Stand, request: dict[str, Any], real: str = "double") -> Request:
    """The request in a line's object. StateError names each wrong key, what was found and what was expected."""
    refuse_duplicates(request)
    faults = [f"unknown key {show(key)}{suggestion(key, STATE)}" for key in request if key not in STATE]
    faults += [f'{k}: key "{x.key}" appears twice' for k, x in request.items() if isinstance(x, _RepeatedKeys)]
    if "angles" in request and "quaternion" in request:
        faults.append("angles, quaternion: both given, expected one of them")
    want, values = tuple[str, ...](), dict[str, Any]()
    try:
        want = _want(request)
    except StateError as error:
        faults.append(str(error))
    if "generalized" in want and "quaternion" in request and stand.hold is None:
        faults.append("quaternion: `generalized` needs `angles`")
    for key, n in INPUTS.items():
        count = len(stand.flywheels) if n == "N" else int(n)
        try:
            values[key] = _list_of(request.get(key, [0.0] * count), key, count, QUANTITIES[key].limits(real))
        except StateError as error:
            faults.append(str(error))
    if faults:
        raise StateError("; ".join(faults))
    values["angles"] = values["angles"] if "angles" in request else None
    quaternion = _quaternion(request) if "quaternion" in request else None
    task, demand = _task(stand, request, want, real)
    values |= freedoms_of(stand, request, want, real)
    values["actuators"] = _actuators(stand, request, real)
    state = State(**values, quaternion=quaternion, wrench=_wrench(stand, request, real), task=task, demand=demand)
    return Request(identifier(request), state, want)


def read_line(stand: Stand, line: str, real: str = "double") -> Request:
    """The request in a line of text. Raises StateError."""
    return read_request(stand, read_object(line), real)


def refuse_duplicates(document: dict[str, Any]) -> None:
    """Raises StateError where an object that `read_object` gave has a key twice."""
    if isinstance(document, _RepeatedKeys):
        raise StateError(f'key "{document.key}" appears twice')


def _integer(digits: str) -> int | float:
    """An integer; Python reads no thousands of digits, and they are beyond every range."""
    return int(digits) if len(digits) < 4000 else float("inf")


class _RepeatedKeys(dict[str, Any]):
    """An object with a key given twice; JSON leaves open which of them counts."""

    key = ""


def _without_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    result = dict(pairs)
    if len(result) == len(pairs):
        return result
    marked = _RepeatedKeys(result)
    marked.key = Counter(key for key, _ in pairs).most_common(1)[0][0]
    return marked


def excerpt(value: Any) -> str:
    """A value for a message, at most 40 characters."""
    try:
        text = json.dumps(value)
    except (ValueError, RecursionError):
        return "something nested too deeply"
    return text if len(text) <= 40 else text[:37] + "..."


def _want(document: dict[str, Any]) -> tuple[str, ...]:
    if "want" not in document:
        raise StateError(f"want: missing, expected a list of {', '.join(WANTS)}")
    names = document["want"]
    if not isinstance(names, list):
        raise StateError(f"want: expected a list of names, found {excerpt(names)}")
    if not names:
        raise StateError(f"want: empty, expected at least one of {', '.join(WANTS)}")
    for name in names:
        if not isinstance(name, str):
            raise StateError(f"want: expected names, found {excerpt(name)}")
        if name not in ALL_WANTS:
            raise StateError(f'want: unknown "{name}"{suggestion(name, ALL_WANTS)}')
        if name in TASK_WANTS and "task" not in document:
            raise StateError(f'want: "{name}" needs a task, {{"task": NAME, "demand": [...]}}')
    if fault := want_fault(names):
        raise StateError(fault)
    return tuple(names)


def _list_of(listed: Any, where: str, count: int, limits: Sequence[float]) -> tuple[float, ...]:
    """`count` finite numbers within their limits in magnitude, which repeat."""
    if not isinstance(listed, list):
        raise StateError(f"{where}: expected a list of {count_numbers(count)}, found {excerpt(listed)}")
    if len(listed) != count:
        raise StateError(f"{where}: expected {count_numbers(count)}, found {len(listed)}")
    numbers = tuple(_number(value, f"{where}[{i}]") for i, value in enumerate(listed))
    _refuse_beyond(numbers, where, limits)
    return numbers


def _refuse_beyond(numbers: Sequence[float], where: str, limits: Sequence[float]) -> None:
    """Raises StateError where one of the numbers is above its limit in magnitude."""
    for i, (number, limit) in enumerate(zip(numbers, cycle(limits), strict=False)):
        if not abs(number) <= limit:
            raise StateError(f"{where}[{i}]: {number:.9g} is out of range, at most {limit:g} in magnitude")


def freedoms_of(stand: Stand, document: dict[str, Any], want: Sequence[str], real: str) -> dict[str, Any]:
    """u, u_dot (m each) of a held carrier, and the V, V_dot they give; nothing of a free one. Raises StateError."""
    if fault := hold_fault(want, stand.hold is not None):
        raise StateError(fault)
    if stand.hold is None:
        for key, other in HELD_KEYS.items():
            if key in document:
                raise StateError(f"{key}: the stand has no [hold], expected {other}")
        return {}
    if "generalized" in want and not has_coordinates(stand.hold):
        raise StateError(f'want: no "generalized": {no_coordinates(stand.hold)}; ask for forward')
    count, values = len(stand.hold.freedoms), {}
    if count and "reaction" in want and not document.keys() & {"u_dot", "V_dot"}:
        raise StateError(
            f'u_dot: missing, but "reaction" is that of a given motion, expected {count} number{"s"[: count > 1]}; '
            "ask for forward to find the free motion and its reaction"
        )
    for key, other in HELD_KEYS.items():
        if other in document:
            raise StateError(f"{other}: the carrier is held, expected {key}, {count_numbers(count)}")
        values[key] = _list_of(document.get(key, [0.0] * count), key, count, (math.inf,))
        values[other] = twist_of(stand.hold, values[key])
        _refuse_beyond(values[other], f"{key}: gives {other}", QUANTITIES[other].limits(real))
    return values


def _number(value: Any, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        plain = ": states are in SI, without units" if isinstance(value, str) else ""
        raise StateError(f"{where}: expected a number, found {excerpt(value)}{plain}")
    try:
        number = float(value)
    except OverflowError:
        raise StateError(f"{where}: {excerpt(value)} is not finite as a double") from None
    if not math.isfinite(number):
        raise StateError(f"{where}: {excerpt(value)} is not finite")
    return number


def _quaternion(document: dict[str, Any]) -> Quaternion:
    q = _list_of(document["quaternion"], "quaternion", 4, (math.inf,))
    length = math.hypot(*q)
    if not abs(length - 1.0) <= UNIT_LENGTH:
        raise StateError(f"quaternion: length {length:.9g}, expected 1 within {UNIT_LENGTH:g}")
    if abs(length - 1.0) <= ROUNDING:
        return cast(Quaternion, q)
    return cast(Quaternion, tuple(x / length for x in q))


def _task(stand: Stand, result: dict[str, Any], want: Sequence[str], real: str) -> tuple[str, tuple[float, ...]]:
    """The task of a state and what it demands; "" and nothing without one."""
    if "task" not in result:
        if "demand" in result:
            raise StateError('demand: needs a task, {"task": NAME, "demand": [...]}')
        return "", ()
    name, rows = result["task"], {task.name: len(task.rows) for task in stand.tasks}
    if not isinstance(name, str):
        raise StateError(f"task: expected the name of a task, found {excerpt(name)}")
    if name not in rows:
        raise StateError(f'task: unknown "{name}"{suggestion(name, rows, "the stand has none, [task.NAME]")}')
    if "V_dot" in result:
        raise StateError("V_dot, task: both given, expected one of them")
    if "demand" not in result:
        raise StateError(f"demand: missing, expected {count_numbers(rows[name])}")
    for other in TASK_CONFLICTS:
        if other in want:
            raise StateError(f'want: "{other}" and the task both give V_dot, ask for them in two states')
    return name, _list_of(result["demand"], "demand", rows[name], QUANTITIES["V_dot"].limits(real))


def _by_name(document: dict[str, Any], key: str, known: Collection[str], what: str) -> dict[str, Any]:
    """The values of a key that is an object, by names that the stand has."""
    values = document.get(key, {})
    if not isinstance(values, dict):
        raise StateError(f"{key}: expected an object of {what}, found {excerpt(values)}")
    for name in values:
        if name not in known:
            raise StateError(f'{key}: unknown "{name}"{suggestion(name, known, f"the stand has no {what}")}')
    return values


def _wrench(stand: Stand, document: dict[str, Any], real: str) -> MappingProxyType[str, Vec6]:
    wrenches, limits = (
        _by_name(document, "wrench", [b.name for b in stand.bodies], "bodies"),
        QUANTITIES["wrench"].limits(real),
    )
    values = {name: cast(Vec6, _list_of(value, f"wrench, {name}", 6, limits)) for name, value in wrenches.items()}
    return MappingProxyType(values)


def _actuators(stand: Stand, document: dict[str, Any], real: str) -> MappingProxyType[str, float]:
    known, values = actuators_of(stand), {}
    for name, value in _by_name(document, "actuators", known, "fins and propellers").items():
        row, where = known[name], f"actuators, {name}"
        most = row.limit or QUANTITIES["phi_dot"].limits(real)[0]
        values[name] = _number(value, where)
        if abs(values[name]) > most:
            raise StateError(f"{where}: {values[name]:.9g} is out of range for its {row.what}, at most {most:g}")
    return MappingProxyType(values)


def actuators_of(stand: Stand) -> dict[str, Actuator]:
    """Fins and propellers of a stand by name."""
    actuators: dict[str, Actuator] = {}
    for kind in body_laws():
        for _, _, law in kind.of(stand):
            actuators |= law.actuators
    return actuators


def stand_at(stand: Stand, state: State) -> Stand:
    """The stand with the deflections (rad) and speeds (rad/s) of a state; itself, where the state has none."""
    if not state.actuators:
        return stand

    def change(body: Any) -> Any:
        return body.with_laws(*(law.actuated(state.actuators) for law in body.laws if isinstance(law, BodyLaw)))

    return replace(stand, carrier=change(stand.carrier), instruments=tuple(map(change, stand.instruments)))


class Backend(Protocol):
    """An evaluator of states of one stand."""

    @property
    def name(self) -> str:
        """Name in tables and messages."""

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """Quantities of `want`, by the names of the contract. Raises StateError."""


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
    identity: Any = None
    try:
        if len(line) > LONGEST:
            raise StateError(f"a line of more than {LONGEST} bytes")
        document = read_object(_text(line))
        identity = identifier(document)
        request = read_request(stand, document, real)
        values = backend.evaluate(request.state, request.want)
        return _line(identity, values), True
    except StateError as error:
        return _line(identity, {"error": str(error)}), False


def _line(identity: Any, values: dict[str, Any]) -> str:
    """The id as it was given (any JSON value, nested however deep), then the values."""
    return f'{{"id": {json.dumps(identity)}, {members(values)}}}'


def _text(line: bytes) -> str:
    try:
        return line.decode("utf-8")
    except UnicodeDecodeError as error:
        raise StateError(f"not UTF-8: byte 0x{line[error.start]:02x}") from None


def state_object(state: State) -> dict[str, Any]:
    """The keys of a state as in a line, without those that are zero."""
    stands_for = HELD_KEYS.values() if state.u or state.u_dot else ()
    values = {key: getattr(state, key) for key in STATE if key not in ("id", "want", *stands_for)}
    values["wrench"] = {name: value for name, value in state.wrench.items() if any(value)}
    values["actuators"] = dict(state.actuators)
    kept = {"angles", "demand"} if state.task else {"angles"}
    return {key: value for key, value in values.items() if value is not None and (key in kept or any(value))}


def state_line(request: Request) -> str:
    """The line that asks for a request: reading it back gives the same numbers."""
    required = {"u_dot": request.state.u_dot} if request.state.u_dot and "reaction" in request.want else {}
    return _line(request.id, {**state_object(request.state), **required, "want": list(request.want)})


def encode(value: Any, name: str = "") -> str:
    """Strict JSON, floats with 17 significant digits, so that they read back as the same bits.

    StateError where a number is not finite, with the `name` of the member. Arrays are lists; a float is never written
    like an integer.
    """
    value = value.tolist() if hasattr(value, "tolist") else value  # of NumPy
    match value:
        case dict():
            return "{" + members(value) + "}"
        case list() | tuple():
            return "[" + ", ".join(encode(item, name) for item in value) + "]"
        case float() if not math.isfinite(value):
            raise StateError(f"{name}: not finite at this state" if name else "not finite at this state")
        case float():
            text = f"{value:.17g}"
            return text + ".0" if text.lstrip("-").isdigit() else text
    return json.dumps(value)


def members(value: dict[str, Any]) -> str:
    """Names and values of an object, without its braces. StateError as encode."""
    return ", ".join(f"{json.dumps(name)}: {encode(item, name)}" for name, item in value.items())
