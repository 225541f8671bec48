"""Instructions on the host itself, counted by Valgrind's callgrind."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path

from mahovik.core.toolchain import process
from mahovik.core.toolchain.board import build, run
from mahovik.core.toolchain.targets import TARGETS, Target
from mahovik.core.toolchain.workload import Line, read
from mahovik.errors import ToolchainError

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
        if found := _FUNCTION.match(row):
            name = names.setdefault(found[2], found[3] or "")
            caller, called = (name, called) if found[1] == "fn" else (caller, name)
        elif row.startswith("calls="):
            pending = int(row.removeprefix("calls=").split()[0])
        elif pending:
            position, spent = row.split()[:2]
            if caller == "main" and not called.startswith(("board_", "print_")):
                yield int(position), pending, int(spent)
            pending = 0
