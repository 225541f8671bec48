"""What a stand's public functions cost on a target: instructions, by a program that calls each; code, stack, constants.

On the host itself instructions are counted by Valgrind's callgrind.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from mahovik.contract.quantities import TABLES
from mahovik.core.emit.calls import address, argument_text, call, declaration
from mahovik.core.emit.literal import initialiser_of, real_literal
from mahovik.core.emit.names import Names
from mahovik.core.emit.recorder import logging
from mahovik.core.emit.templates import template
from mahovik.core.lower.test_inputs import longer
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Precision
from mahovik.core.program.walk import without_missing
from mahovik.core.toolchain import process
from mahovik.core.toolchain.targets import TARGETS, Target, build, run
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
    rows = [initialiser_of(a.type, a.shape, state[a.name], lambda x: real_literal(x, precision)) for state in states]
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


# -- size of an object: code and constants by symbol, stack over the call graph ----------------------------------------

STACK_FLAGS = ("-fstack-usage", "-fcallgraph-info=su")
"""What gcc needs to write NAME.ci beside the object: the call graph, with the frame of each function."""

_NODE = re.compile(r'node: \{ title: "([^"]+)" label: "([^"]+)"')
_EDGE = re.compile(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"')
_POINTER = "__indirect_call"
"""What gcc's graph calls a function that is known by its address alone, such as the one that takes a log."""

_FRAME = re.compile(r"\\n(\d+) bytes \(([^)]*)\)")


@dataclass(frozen=True)
class Footprint:
    """Footprint of one object.

    `code`, `constants`: bytes by symbol; `frames`: bytes of stack by function; `calls`: the functions
    that each calls; `routines`: called functions that the object does not have, such as `memcpy`; their code and stack
    are not in the sums below. `text`, `data`: bytes of whole sections, with constants and padding that have no name.
    """

    code: Mapping[str, int]
    constants: Mapping[str, int]
    frames: Mapping[str, int]
    calls: Mapping[str, frozenset[str]]
    text: int
    data: int

    def with_calls(self, function: str) -> frozenset[str]:
        """The function and all it calls, directly or not, with routines of the compiler's library."""
        calls: set[str] = set()
        open_ = [function]
        while open_:
            name = open_.pop()
            if name not in calls:
                calls.add(name)
                open_ += self.calls.get(name, ())
        return frozenset(calls)

    def code_of(self, function: str) -> int:
        """Size of the code of a function and of all that it calls, bytes."""
        return sum(self.code.get(name, 0) for name in self.with_calls(function))

    def routines(self, function: str) -> list[str]:
        """Functions of the compiler's library that it calls."""
        return sorted(name for name in self.with_calls(function) if name not in self.frames and name != _POINTER)

    def joined_with(self, other: Footprint) -> Footprint:
        """Both objects as one, so that calls of one lead into the other."""
        return Footprint(
            {**self.code, **other.code},
            {**self.constants, **other.constants},
            {**self.frames, **other.frames},
            {**self.calls, **other.calls},
            self.text + other.text,
            self.data + other.data,
        )

    def stack_of(self, function: str) -> int:
        """Stack of the deepest chain of calls, bytes. Raises ToolchainError where a chain has no end."""
        return self._depths[function]

    @cached_property
    def _depths(self) -> dict[str, int]:
        depths: dict[str, int] = {}

        def depth(name: str, above: tuple[str, ...]) -> int:
            if name in above:
                raise ToolchainError(f"{name} calls itself: its stack has no bound")
            if name not in depths:
                inner = max((depth(called, (*above, name)) for called in self.calls.get(name, ())), default=0)
                depths[name] = self.frames.get(name, 0) + inner
            return depths[name]

        for name in self.frames:
            depth(name, ())
        return depths


def footprint(compiler: str, compiled: Path) -> Footprint:
    """Measure an object that `compiler`, a gcc, made with STACK_FLAGS. Raises ToolchainError."""
    binutils = compiler.removesuffix("gcc")
    code, constants = {}, {}
    for size, kind, name in _symbols(_output(f"{binutils}nm", "-S", compiled.name, folder=compiled.parent)):
        if kind in "tT":
            code[name] = size
        elif kind in "rR":
            constants[name] = size
    text, data = _sections(_output(f"{binutils}size", "-A", compiled.name, folder=compiled.parent))
    frames, calls = _graph(compiled.with_suffix(".ci").read_text(encoding="utf-8"))
    return Footprint(code, constants, frames, calls, text, data)


def _symbols(listing: str) -> Iterator[tuple[int, str, str]]:
    for line in listing.splitlines():
        words = line.split()
        if len(words) == 4:
            yield int(words[1], 16), words[2], _plain(words[3])


def _sections(listing: str) -> tuple[int, int]:
    """How many bytes the sections of code have together, and those of constants."""
    text = data = 0
    for line in listing.splitlines():
        words = line.split()
        if len(words) == 3 and words[1].isdigit():
            text += int(words[1]) if words[0].startswith(".text") else 0
            data += int(words[1]) if words[0].startswith((".rodata", ".srodata", ".data", ".sdata")) else 0
    return text, data


def _graph(text: str) -> tuple[dict[str, int], dict[str, frozenset[str]]]:
    """Frames by function and calls of each; names without the file's. A frame of unknown size is refused."""
    frames: dict[str, int] = {}
    for title, label in _NODE.findall(text):
        frame = _FRAME.search(label)
        if frame is not None:
            if frame[2] == "dynamic":
                raise ToolchainError(f"{_plain(title)} has a stack frame without bound")
            frames[_plain(title)] = int(frame[1])
    calls: dict[str, set[str]] = {}
    for source, target in _EDGE.findall(text):
        calls.setdefault(_plain(source), set()).add(_plain(target))
    return frames, {name: frozenset(result) for name, result in calls.items()}


def _plain(title: str) -> str:
    """A symbol as C has it: without the file's name, and the end by which the linker tells headers apart."""
    return re.sub(r"_f(32|64)_[0-9a-f]{8}(?=\.|$)", "", title.rpartition(":")[2])


def _output(*command: str, folder: Path) -> str:
    try:
        done = process.run(command, folder)
    except OSError as error:
        raise ToolchainError(f"{command[0]} cannot be run: {error.strerror}; `make targets` installs it") from error
    if done.returncode != 0:
        raise ToolchainError(f"{command[0]}: {done.stderr.strip().splitlines()[0]}")
    return done.stdout
