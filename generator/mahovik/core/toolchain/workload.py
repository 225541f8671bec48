"""The program that measures a stand's public functions on a target: C text from the program as data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mahovik.contract.quantities import TABLES
from mahovik.core.emit.calls import address, argument_text, call, declaration, initialiser_of
from mahovik.core.emit.names import Names
from mahovik.core.emit.recorder import logging
from mahovik.core.emit.templates import template
from mahovik.core.lower.test_inputs import longer
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Precision
from mahovik.core.program.walk import without_missing

LONG_CALL = 100_000
"""Instructions; a call as long is counted once: the coarsest counter is good to 50 instructions."""

SHORT_CALL = 5_000
"""Instructions; a call as short is counted MANY times: the mean is then its exact number."""

SOME, MANY = 50, 400

_OF_THE_STAND = {row.symbol: row.default for row in TABLES.values() if row.default}
"""Arguments that the emitted C has constants for."""


@dataclass(frozen=True)
class Line:
    """A printed line: one function on one state. `calls` of them took `instructions`; `stack` in bytes."""

    function: str
    state: int
    status: int
    calls: int
    instructions: int
    stack: int


def workload(program: Program, states: Sequence[Mapping[str, Any]], recorder: bool = False) -> str:
    """C that calls each public function with the arguments of each state, by argument name.

    `x` and what has no constant in the emitted C comes from `states`; a function with `order` is called with 4 and 2.
    `recorder`: the steps of the recorder as well. No step has a carry.
    """
    names = Names(program.name)
    public = [without_missing(f) for f in program.functions if f.public]
    taken: dict[str, Argument] = {}
    written: dict[str, Argument] = {}
    for f in public:
        for a in f.arguments:
            if a.direction != "in":
                written.setdefault(f"{f.name}_{a.name}", a)
            if a.direction != "out" and a.name not in (*_OF_THE_STAND, "mounting", "order"):
                taken[a.name] = longer(taken.get(a.name, a), a)
    calls = []
    for f in public:
        for order in (4, 2) if any(a.name == "order" for a in f.arguments) else (0,):
            calls.append({"label": _label(f, order), "text": _call(program.function(f.name), names, order)})
    logged = logging(program) if recorder else []
    steps = [(f, order) for f in logged for order in (4, 2)]
    calls += [{"label": _label(f, order), "text": f"{f.name}_{order}(s)"} for f, order in steps]
    return template("workload.c.j2").render(
        name=program.name,
        states=len(states),
        long_call=LONG_CALL,
        short_call=SHORT_CALL,
        some=SOME,
        many=MANY,
        constants=[_constant(a, states, names, program.precision) for a in taken.values()],
        outputs=[declaration(names, a, key) for key, a in written.items()],
        preparation=list(_preparation(public, names)),
        recorder=recorder,
        steps=[{"name": f"{f.name}_{order}", "text": _log_step(f, names, order)} for f, order in steps],
        calls=calls,
    )


def read(printed: str) -> list[Line]:
    """The lines of a measuring program's text."""
    found = []
    for line in printed.splitlines():
        name, state, sign, status, calls, instructions, stack = line.split()
        number = -int(status) if sign == "-" else int(status)
        found.append(Line(name, int(state), number, int(calls), int(instructions), int(stack)))
    return found


def _preparation(public: Sequence[Function], names: Names) -> list[str]:
    """What functions read and write in place, filled; the table of `mounts`, made."""
    lines = []
    for f in public:
        for a in f.arguments:
            if a.direction == "inout":
                source = names.function(_OF_THE_STAND[a.name]) if a.name in _OF_THE_STAND else f"{a.name}[0]"
                lines.append(f"{f.name}_{a.name} = {source};")
        if f.name == "prepare_mounts":
            lines.append(f"(void){_call(f, names, 0)};")
    return lines


def _label(f: Function, order: int) -> str:
    return f"{f.name}(order=2)" if order == 2 else f.name


def _log_step(f: Function, names: Names, order: int) -> str:
    """The call of a step with a log; the state and the log are those of the program."""
    own = {
        "log": "&log",
        "x": "&logged",
        "table": f"&{names.function('default')}",
        "order": str(order),
        "carry": "NULL",
    }
    return call(names, f, lambda a: own.get(a.name) or argument_text(a, f"{a.name}[s]"))


def _call(f: Function, names: Names, order: int) -> str:
    def argument_name(a: Argument) -> str:
        if a.optional == "missing":
            return "NULL"
        if a.direction != "in":
            return address(f"{f.name}_{a.name}", a.shape)
        if a.name in _OF_THE_STAND:
            return f"&{names.function(_OF_THE_STAND[a.name])}"
        if a.name == "mounting":
            return "&prepare_mounts_mounting"
        return str(order) if a.name == "order" else argument_text(a, f"{a.name}[s]")

    return call(names, f, argument_name)


def _constant(a: Argument, states: Sequence[Mapping[str, Any]], names: Names, precision: Precision) -> dict[str, Any]:
    rows = [initialiser_of(a.type, a.shape, state[a.name], precision, exact=False) for state in states]
    declaration = names.declaration(f"{a.name}[STATES]", a.type, a.shape)
    return {"declaration": declaration, "rows": rows}
