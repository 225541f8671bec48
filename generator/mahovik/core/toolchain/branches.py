"""Branches of emitted C that its self-test takes, counted by gcov."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mahovik.core.toolchain.board import run, version
from mahovik.core.toolchain.compiler import BITS, run_compiler
from mahovik.core.toolchain.process import run as run_program
from mahovik.core.toolchain.targets import TARGETS
from mahovik.errors import ToolchainError

FLAGS = ("-std=c99", "-O0", "--coverage", *BITS)
"""Without optimisation each condition is a branch of its own."""


@dataclass(frozen=True)
class Line:
    """A line of the source with branches: its number, function, text, how many ways out it has, how many were taken."""

    number: int
    function: str
    text: str
    ways: int
    taken: int


def measure_branches(source: Path, selftest: Path, scratch: Path) -> list[Line]:
    """Lines of a source that have branches, after its self-test. Raises ToolchainError, also where the test fails."""
    name = source.stem
    program = scratch / "branches"
    # gcc writes its notes beside the program, gcov reads them there
    run_compiler(
        [*FLAGS, f"-D{name.upper()}_SELFTEST_MAIN", str(source), str(selftest), "-o", str(program)], name, ["gcc"]
    )
    run(TARGETS["host"], program, 300.0)
    data = next(scratch.glob(f"*-{name}.gcda"))
    done = run_program(["gcov", "-b", "-c", "--json-format", "--stdout", data.name], scratch)
    if done.returncode != 0:
        raise ToolchainError(f"gcov ended with status {done.returncode}: {done.stderr.strip()}")
    text = source.read_text(encoding="ascii").splitlines()
    files = [each for each in json.loads(done.stdout)["files"] if Path(each["file"]).name == source.name]
    return [_line(row, text, name) for each in files for row in each["lines"] if row["branches"]]


def tools() -> Sequence[str]:
    """Names and versions of what counts."""
    return (version("gcc"), version("gcov"))


def _line(row: dict[str, Any], text: Sequence[str], name: str) -> Line:
    number, branches = row["line_number"], row["branches"]
    function = row.get("function_name", "").removeprefix(f"{name}_")
    return Line(number, function, text[number - 1].strip(), len(branches), sum(b["count"] > 0 for b in branches))
