"""The same bits everywhere: a stand's self-test, built for targets, run on their emulators, compared line by line."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from mahovik.core.emit.delivery import firmware
from mahovik.core.emit.generate import generate_all
from mahovik.core.program.function import Program
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.board import build, build_version, run, selftest_flags, selftest_main
from mahovik.core.toolchain.process import side_by_side
from mahovik.core.toolchain.targets import TARGETS, Target
from mahovik.errors import ToolchainError, UsageError
from mahovik.nearest import meant
from mahovik.proof.verify.difference import first_difference

REALS = ("double", "float")

QUICK = (("host", "double"), ("host", "float"), ("m4", "float"), ("m7", "double"), ("rv64gc", "double"))
"""Targets and element types of `quick`: the host, and each kind of FPU."""

SWEEP = 20
"""Pseudo-random states, beside the golden vectors, on which every function is called."""

TIMEOUT = 300.0
"""s; for one run on an emulator, on a machine that does something else as well."""

_UNSTARTED = "not installed"
_ELSEWHERE = "not here"


@dataclass(frozen=True)
class TargetRow:
    """One target and element type. `verdict`: ok, FAILED, "not installed", or "not here" where the host's processor
    lacks what the target wants; `reason` says more. `built_with`: compiler with version and optimisation.
    """

    target: str
    title: str
    built_with: str
    real: str
    functions: int
    states: int
    verdict: str
    reason: str = ""

    @property
    def failed(self) -> bool:
        """Whether bits differ, or the program could not be built or run."""
        return self.verdict == "FAILED"

    @property
    def missing(self) -> bool:
        """Whether nothing could be said, since a tool is not installed."""
        return self.verdict == _UNSTARTED


@dataclass(frozen=True)
class TargetsReport:
    """What came out, target by target. `expected`: the lines that every target has to print, by element type."""

    stand: str
    structure: str
    physics: str
    sweep: int
    rows: tuple[TargetRow, ...]

    @cached_property
    def passed(self) -> bool:
        """Every target that was asked for has the bits of the host, but those that this processor cannot run."""
        return any(r.verdict == "ok" for r in self.rows) and not any(r.failed or r.missing for r in self.rows)

    @cached_property
    def conclusion(self) -> str:
        """The verdict in one line."""
        if failed := [f"{r.target} {r.real}" for r in self.rows if r.failed]:
            return f"FAILED: {', '.join(failed)}"
        if missing := dict.fromkeys(r.target for r in self.rows if r.missing):
            return f"not everything was run: {', '.join(missing)}: not installed, `make targets` does it"
        equal = sum(r.verdict == "ok" for r in self.rows)
        return f"passed: the same bits on {equal} pairs of target and element type" if equal else "FAILED: nothing ran"


def asked(names: str, reals: Sequence[str] | None = None) -> list[tuple[Target, str]]:
    """Targets and element types of `all`, `quick`, or a list of names. Raises UsageError.

    Without `reals`, both of them; `quick` has its own.
    """
    words = [word.strip() for word in names.split(",")]
    if words == ["quick"] and reals is None:
        return [(TARGETS[name], real) for name, real in QUICK]
    if words == ["quick"]:
        words = list(dict.fromkeys(name for name, _ in QUICK))
    elif words == ["all"]:
        words = list(TARGETS)
    for word in words:
        if word not in TARGETS:
            known = [*TARGETS, "all", "quick"]
            raise UsageError(f'--targets: unknown "{word}"{meant(word, known)}')
    return [(TARGETS[word], real) for word in dict.fromkeys(words) for real in reals or REALS]


def verify_targets(
    stand: Stand,
    pairs: Sequence[tuple[Target, str]],
    sweep: int = SWEEP,
    progress: Callable[[int, int], None] | None = None,
    lanes: int = 1,
) -> TargetsReport:
    """Builds and runs the self-test for each target and element type; compares the text with the host's.

    The golden vectors in the self-test are the interpreter's: a line says PASS only where all bits are its bits.
    Raises ToolchainError where the host itself has no gcc or cannot run the test.
    """
    names = identities(stand)
    sources = {real: selftest_sources(stand, real, sweep, lanes) for real in dict.fromkeys(real for _, real in pairs)}
    programs = {real: generate_all(stand, real, lanes).program for real in sources}
    expected = {real: _printed(TARGETS["host"], stand.name, files).splitlines() for real, files in sources.items()}
    rows = []
    with side_by_side() as pool:
        tasks = [pool.submit(_row, t, real, programs[real], sources[real], expected[real], sweep) for t, real in pairs]
        for done, task in enumerate(tasks):
            rows.append(task.result())
            if progress is not None:
                progress(done + 1, len(pairs))
    return TargetsReport(stand.name, names.structure, names.physics, sweep, tuple(rows))


def selftest_sources(stand: Stand, real: str, sweep: int, lanes: int = 1) -> dict[str, str]:
    """A stand's C with its self-test and a `main` for boards, by file name."""
    files = firmware(stand, real, lanes)
    files.pop("README.md")
    return {**files, "main.c": selftest_main(stand.name, sweep)}


def _row(
    target: Target, real: str, program: Program, files: Mapping[str, str], expected: Sequence[str], sweep: int
) -> TargetRow:
    def row(verdict: str, reason: str = "", functions: int = 0) -> TargetRow:
        return TargetRow(target.name, target.title, built_with, real, functions, sweep, verdict, reason)

    built_with = " ".join((*target.compiler[:1], target.optimisation))
    if missing := target.missing():
        return row(_UNSTARTED, f"no {', '.join(missing)}: make targets")
    built_with = build_version(target)
    if unable := target.unable():
        return row(_ELSEWHERE, unable)
    try:
        found = _printed(target, program.name, files).splitlines()
    except ToolchainError as error:
        return row("FAILED", str(error))
    problem = next(_problems(expected, found), "")
    if " FAIL " in problem:
        first = first_difference(target, program, files, TIMEOUT)
        problem += f"; first: {first}" if first else ""
    return row("FAILED" if problem else "ok", problem, sum(" PASS " in line for line in found))


def _printed(target: Target, name: str, files: Mapping[str, str]) -> str:
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
        return run(target, build(target, files, Path(scratch), extra=selftest_flags(name)), TIMEOUT)


def _problems(expected: Sequence[str], found: Sequence[str]) -> Iterator[str]:
    """What is wrong with a printed self-test: golden vectors first, then what differs from the host."""
    for line in found:
        if " FAIL " in line:
            yield f"not the interpreter's bits: {line}"
    for ours, theirs in zip(expected, found, strict=False):
        if ours != theirs:
            yield f'the host has "{ours}", the target "{theirs}"'
    if len(expected) != len(found):
        yield f"{len(found)} lines, the host has {len(expected)}"
    if not any(line == "failures 0" for line in found):
        yield "no line says that there were no failures"
