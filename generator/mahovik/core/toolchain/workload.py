"""The program that measures a stand's public functions on a target: C text from the program as data.

On the host itself instructions are counted by Valgrind's callgrind.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
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
from mahovik.core.toolchain import process
from mahovik.core.toolchain.board import build, run
from mahovik.core.toolchain.targets import TARGETS, Target
from mahovik.errors import ToolchainError

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
    result = []
    for line in printed.splitlines():
        name, state, sign, status, calls, instructions, stack = line.split()
        number = -int(status) if sign == "-" else int(status)
        result.append(Line(name, int(state), number, int(calls), int(instructions), int(stack)))
    return result


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
    texts = {
        "log": "&log",
        "x": "&logged",
        "table": f"&{names.function('default')}",
        "order": str(order),
        "carry": "NULL",
    }
    return call(names, f, lambda a: texts.get(a.name) or argument_text(a, f"{a.name}[s]"))


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


NATIVE = frozenset(name for name, target in TARGETS.items() if target.family == "hosted" and not target.emulator)
"""Targets that run here without an emulator."""


def instructions_of_host(target: Target, files: Mapping[str, str], workload: str, scratch: Path) -> list[Line]:
    """The lines of a measuring program of one state, with the instructions that callgrind counted.

    Raises ToolchainError where valgrind is missing.
    """
    if shutil.which("valgrind") is None:
        raise ToolchainError("valgrind counts instructions on the host: `make targets`, or `apt-get install valgrind`")
    folder = scratch / "callgrind"
    folder.mkdir(exist_ok=True)
    program = build(target, {**files, "workload.c": workload}, folder, extra=("-g",))
    counts = folder / "callgrind.out"
    options = ["--tool=callgrind", "--dump-line=yes", "--compress-pos=no", f"--callgrind-out-file={counts}"]
    command = ["valgrind", *options, str(program)]
    done = process.run(command)
    if done.returncode != 0:
        raise ToolchainError(f"valgrind: {done.stderr.strip().splitlines()[-1]}")
    by_line: dict[int, tuple[int, int]] = {}
    for line, calls, spent in _calls(counts.read_text(encoding="utf-8")):
        before = by_line.get(line, (0, 0))
        by_line[line] = (before[0] + calls, before[1] + spent)
    measured = {
        number: by_line[number]
        for number, text in enumerate(workload.splitlines(), start=1)
        if text.lstrip().startswith("MEASURE(") and number in by_line
    }
    lines = read(run(target, program))
    if len(lines) != len(measured):
        raise ToolchainError(f"callgrind saw {len(measured)} of {len(lines)} measured calls")
    pairs = zip(lines, measured.values(), strict=True)
    return [Line(e.function, e.state, e.status, calls, spent, 0) for e, (calls, spent) in pairs]


_FUNCTION = re.compile(r"(fn|cfn)=\((\d+)\)(?: (.*))?$")


def _calls(text: str) -> Iterator[tuple[int, int, int]]:
    """Line of the call in `main`, number of calls, instructions in them; of what main calls in another file."""
    names: dict[str, str] = {}
    caller = called = ""
    pending = 0
    for row in text.splitlines():
        if match := _FUNCTION.match(row):
            name = names.setdefault(match[2], match[3] or "")
            caller, called = (name, called) if match[1] == "fn" else (caller, name)
        elif row.startswith("calls="):
            pending = int(row.removeprefix("calls=").split()[0])
        elif pending:
            position, spent = row.split()[:2]
            if caller == "main" and not called.startswith(("board_", "print_")):
                yield int(position), pending, int(spent)
            pending = 0
