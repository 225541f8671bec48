"""Inputs at the bounds of every function: refused just outside, with its outputs untouched, and taken just inside.

What is wrong with which argument is data of the contract: bounds, and values that are refused or taken
(`contract/quantities`). One value at a time is changed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.contract.functions import TURNS, row_of
from mahovik.contract.quantities import BOUNDS, EXPORTED, QUANTITIES, TABLES, UNIT_LENGTH, Draw
from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Struct
from mahovik.core.stand.model import State
from mahovik.proof.verify.backends import turns
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check

Call = Callable[[str, Mapping[str, Any]], tuple[int, bool]]
"""Function name, inputs by argument name; status, and whether its outputs are untouched."""

NULL = object()
"""An address that is null, where a call takes one."""

Path = tuple[str | int, ...]
"""Where a value stands among the inputs: name of the argument, names of members, indices."""

READ_TABLES = ("parameters", "inverse_options")
"""Structs of numbers of the stand that functions check; the prepared tables are trusted, but for their stream."""

Numbers = Mapping[str, tuple[float, ...]]
"""Values by argument or member."""

NOTHING: Numbers = {}

BY_OTHERS = ("axis", "zero", "position")
"""Parameters that others bound as well: a direction must not be along the other, nor a body too far for its mass."""

BY_RESULTS = ("step", "state_from_coordinates")
"""Begins of names of functions that refuse results out of range as well: just inside, their inputs say nothing."""

UNWRITTEN = 165.65625
"""What results hold before a call that must not write them, of integers its whole part: no number that a stand has."""

BEYOND = 1 + 1e-6
"""Times its bound: a value out of range; and its inverse: one in it."""

LENGTHS = {1 + sign * part * UNIT_LENGTH: part > 1 for part in (1.01, 0.99) for sign in (1, -1)}
"""Lengths in the place of 1 just out of range, and just in it: whether they are wrong."""


@dataclass(frozen=True)
class WrongValue:
    """One value at a bound: where it stands, and the status that is due, or that is not of one just inside."""

    path: Path
    value: Any
    status: str
    is_wrong: bool = True

    @property
    def words(self) -> str:
        """The place and the value, `V[3] = nan`."""
        names = [part for part in self.path if isinstance(part, str)]
        index = "".join(f"[{part}]" for part in self.path if isinstance(part, int))
        value = "null" if self.value is NULL else f"{self.value:.9g}"
        return f"{'.'.join(names)}{index} = {value}"


def check_refusals(program: Program, inputs: Mapping[str, Any], call: Call) -> Check:
    """Check that every public function refuses one wrong value at a time, and none within its bounds.

    `inputs`: good ones, by argument name.

    A function that is not tried at all fails.
    """
    check = Check("", "bad inputs refused")
    for function in program.functions:
        if not function.public:
            continue
        good = {a.name: inputs[a.name] for a in function.arguments if a.direction != "out" and a.name in inputs}
        before = check.states
        demand_refusals(check, function.name, good, wrong_values(function, good, program.precision.name), call)
        if check.states == before:
            check.demand(False, function.name, "no wrong input is known for it")
    return check


def demand_refusals(check: Check, name: str, good: Mapping[str, Any], wrong: Iterable[WrongValue], call: Call) -> None:
    """Count calls of a function with good inputs but one value at a bound.

    Outside a status is due, and no output is written; inside any other is right.
    """
    for bad in wrong:
        status, untouched = call(name, with_value(good, bad))
        right = (status == STATUS_VALUES[bad.status]) == bad.is_wrong
        off = f"status {status_words(status)}, {'' if bad.is_wrong else 'not '}expected {bad.status}"
        words = "refused, but outputs were written" if right else off
        check.demand(right and (untouched or not bad.is_wrong), f"{name}: {bad.words}", words)


def wrong_values(function: Function, good: Mapping[str, Any], real: str) -> Iterator[WrongValue]:
    """All wrong values of the arguments of a function, one at a time, and those just inside."""
    ignored, may_leave = row_of(function.name).ignores, function.name.startswith(BY_RESULTS)
    for a in function.arguments:
        pointer = bool(a.shape) or isinstance(a.type, Struct) or a.direction != "in"
        if pointer and (not a.optional or a.name in TURNS):  # sines without cosines are none
            yield WrongValue((a.name,), NULL, "BAD_ARGUMENT")
        trusted = isinstance(a.type, Struct) and a.type.name in TABLES and a.type.name not in READ_TABLES
        if a.direction != "out" and a.name in good and not trusted:
            at_bounds = wrong_within(good[a.name], (a.name,), real, ignored)
            yield from (bad for bad in at_bounds if bad.is_wrong or not may_leave)


def wrong_within(
    value: Any, path: Path, real: str, unchecked: Collection[str] = (), beyond: Numbers = NOTHING
) -> Iterator[WrongValue]:
    """Values at the bounds of the numbers of nested data, each by its row in the contract; of whole numbers ints.

    `unchecked`: arguments and members that no function checks; `beyond`: values just out of range besides, by name.
    NaN is what is only written.
    """
    symbol = [step for step in path if isinstance(step, str)][-1]
    if symbol in unchecked:
        return
    if isinstance(value, Mapping) or np.ndim(value) > 0:
        for key, item in value.items() if isinstance(value, Mapping) else enumerate(value):
            yield from wrong_within(item, (*path, key), real, unchecked, beyond)
    elif (is_whole := isinstance(value, int)) or not math.isnan(value):
        limit, of_parameters = limit_at(symbol, path, real), path[0] == "parameters"
        wrong = wrong_numbers(symbol, value, not is_whole, limit, of_parameters)
        yield from (WrongValue(path, *number) for number in wrong)
        status = "BAD_ARGUMENT" if is_whole else "RANGE"
        yield from (WrongValue(path, number, status) for number in beyond.get(symbol, ()))


def limit_at(symbol: str, path: Path, real: str) -> float | None:
    """The bound on the magnitude of a number of a quantity, where it has one."""
    row = QUANTITIES.get(symbol) or EXPORTED.get(symbol)
    limits: tuple[float, ...] = () if row is None else row.limits(real)
    if path[0] == "parameters":
        limits = (BOUNDS["MAX_PARAMETER"].at(real),)
    number = path[-1] if isinstance(path[-1], int) else 0
    return limits[number % len(limits)] if limits else None


def wrong_numbers(
    symbol: str, value: float, is_real: bool, limit: float | None, of_parameters: bool = False
) -> Iterator[tuple[float, str, bool]]:
    """Values at the bounds of one number of a quantity, the statuses of what is outside, whether they are outside."""
    row = QUANTITIES.get(symbol) or EXPORTED.get(symbol)
    if is_real:
        infinite = () if row is not None and row.infinite else (math.inf, -math.inf)
        yield from ((number, "NOT_FINITE", True) for number in (math.nan, *infinite))
    if is_real and limit is not None:
        one_sided = row is not None and any(number < 0 for number, _ in row.invalid)
        for number in (limit,) if one_sided else (limit, -limit):
            yield number * BEYOND, "RANGE", True
            if not (of_parameters and symbol in BY_OTHERS):
                yield number / BEYOND, "RANGE", False
    if row is None or (of_parameters and row.axes != "a body"):
        return
    if row.draw in (Draw.ATTITUDE, Draw.TURNS):  # the other numbers stay
        squares = ((value**2 + length**2 - 1.0, is_wrong) for length, is_wrong in LENGTHS.items())
        yield from ((math.sqrt(square), "RANGE", is_wrong) for square, is_wrong in squares if square >= 0.0)
    yield from ((number, status, True) for number, status in row.invalid)
    yield from ((number, row.invalid[0][1], is_wrong) for number, is_wrong in row.edges)


def with_value(good: Mapping[str, Any], wrong: WrongValue) -> dict[str, Any]:
    """A copy of the inputs with one value replaced."""
    changed: dict[str, Any] = _replace_at(good, wrong.path, wrong.value)
    return changed


def _replace_at(value: Any, path: Path, new: Any) -> Any:
    """A copy of nested data with the element at a path replaced; an address of results is added."""
    copy: Any = dict(value) if isinstance(value, Mapping) else list(value)
    copy[path[0]] = _replace_at(value[path[0]], path[1:], new) if path[1:] else new
    return copy


def good_inputs(backend: CBackend, states: Sequence[tuple[str, State]]) -> dict[str, Any]:
    """Good arguments of every public function: an ordinary state, and what does not belong to one."""
    state = next((s for name, s in states if name.startswith("random")), states[0][1])
    arguments = {
        "angles": (0.1, 0.7, -0.2),
        "position": state.position,
        "phi": 1.0,
        "dt": 1e-4,
        "order": 4,
        "parameters": backend.generated.values.parameters,
        **turns(state),
        "carry": {"rounding": [0.0] * (13 + 2 * len(state.phi))},
    }
    return {**backend.arguments(state), **arguments, **_coordinates(backend.program)}


def _coordinates(program: Program) -> dict[str, Any]:
    """Good coordinates and rates: as many as the program takes."""
    values = {"q": 0.3, "q_dot": 0.1, "q_ddot": 0.2}
    taken = (a for f in program.functions if f.name == "state_from_coordinates" for a in f.arguments)
    coordinates: dict[str, Any] = {"orientation": (0.6, 0.0, 0.0, 0.8)}
    return coordinates | {a.name: (values[a.name],) * int(a.shape[0]) for a in taken if a.name in values}


def raw_call(backend: CBackend) -> Call:
    """Calls a function of the C with inputs that may be wrong: its status, and whether its results are untouched."""
    library, program, table = backend.library, backend.program, backend.table()
    held: dict[str, Any] = {}
    last: tuple[str, Mapping[str, Any]] = "", {}

    def call(name: str, inputs: Mapping[str, Any]) -> tuple[int, bool]:
        """Data of C of an argument is kept while calls of a function, one after another, have the same value."""
        nonlocal held, last
        arguments = {key: library.ffi.NULL if value is NULL else value for key, value in inputs.items()}
        if name == "prepare" and inputs["table"] is not NULL:
            arguments["table"] = table  # of which the calls have a copy to write to
        same = held if last[0] == name else {}
        kept = {key: data for key, data in same.items() if arguments.get(key) is last[1].get(key)}
        last, held = (name, arguments), library.hold_all(program.function(name), arguments | kept, UNWRITTEN)
        return library.probe(name, held)

    return call
