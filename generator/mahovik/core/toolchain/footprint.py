"""Size of an object of emitted C: code and constants by symbol, stack over the call graph."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from mahovik.core.toolchain import process
from mahovik.errors import ToolchainError

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
