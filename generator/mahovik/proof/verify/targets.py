"""The same bits everywhere: a stand's self-test, built for targets, run on their emulators, compared line by line."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from mahovik.core.emit.delivery import selftest_files
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.lower.golden import CASES, FAR
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Kind, NamedCount, Struct
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.board import build, build_version, difference_main, run, selftest_main
from mahovik.core.toolchain.process import side_by_side
from mahovik.core.toolchain.targets import TARGETS, Target
from mahovik.errors import ToolchainError, UsageError
from mahovik.nearest import suggestion
from mahovik.proof.verify.check import Check, Report
from mahovik.proof.verify.check import as_junit as checks_as_junit
from mahovik.writing import write_all

REALS = ("double", "float")

QUICK = (("host", "double"), ("host", "float"), ("m4", "float"), ("m7", "double"), ("rv64gc", "double"))
"""Targets and element types of `quick`: the host, and each kind of FPU."""

SWEEP = 20
"""Pseudo-random states, beside the golden vectors, on which every function is called."""

TIMEOUT = 300.0
"""Longest run on an emulator, s; the machine may be busy."""


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


@dataclass(frozen=True)
class TargetsReport:
    """Result of a verification on targets, a row for each target and element type."""

    stand: str
    structure: str
    physics: str
    sweep: int
    rows: tuple[TargetRow, ...]

    @property
    def passed(self) -> bool:
        """Whether every requested target has the bits of the host, apart from those that this processor cannot run."""
        verdicts = {row.verdict for row in self.rows}
        return "ok" in verdicts and verdicts <= {"ok", "not here"}

    @property
    def conclusion(self) -> str:
        """The verdict in one line."""
        if failed := [f"{row.target} {row.real}" for row in self.rows if row.failed]:
            return f"FAILED: {', '.join(failed)}"
        if missing := dict.fromkeys(row.target for row in self.rows if row.verdict == "not installed"):
            return f"not everything was run: {', '.join(missing)}: not installed, `make targets` does it"
        equal = sum(row.verdict == "ok" for row in self.rows)
        return f"passed: the same bits on {equal} pairs of target and element type" if equal else "FAILED: nothing ran"


def parse_targets(names: str, reals: Sequence[str] | None = None) -> list[tuple[Target, str]]:
    """Targets and element types of `all`, `quick`, or a list of names. Raises UsageError.

    Without `reals`, both of them; `quick` has its own.
    """
    if names == "quick" and reals is None:
        return [(TARGETS[name], real) for name, real in QUICK]
    groups = {"quick": [name for name, _ in QUICK], "all": [*TARGETS]}
    words = groups.get(names, [word.strip() for word in names.split(",")])
    for word in words:
        if word not in TARGETS:
            raise UsageError(f'--targets: unknown "{word}"{suggestion(word, [*TARGETS, *groups])}')
    return [(TARGETS[word], real) for word in dict.fromkeys(words) for real in reals or REALS]


def verify_targets(
    stand: Stand,
    pairs: Sequence[tuple[Target, str]],
    sweep: int = SWEEP,
    progress: Callable[[int, int], None] = lambda done, count: None,
    only: tuple[str, ...] = (),
) -> TargetsReport:
    """Builds and runs the self-test for each target and element type; compares the text with the host's.

    `only`: of C with these public functions alone, as of `generate`.

    The golden vectors in the self-test are the interpreter's: a line reads PASS only if all bits equal its bits.
    Raises ToolchainError where the host itself has no gcc or cannot run the test.
    """
    names = identities(stand)
    sources = {real: selftest_sources(stand, real, sweep, only) for real in dict.fromkeys(real for _, real in pairs)}
    programs = {real: generate_all(stand, real, only).program for real in sources}
    expected = {real: run_selftest(TARGETS["host"], stand.name, files).splitlines() for real, files in sources.items()}
    rows = []
    with side_by_side() as pool:
        tasks = [pool.submit(_row, t, real, programs[real], sources[real], expected[real], sweep) for t, real in pairs]
        for done, task in enumerate(tasks, start=1):
            rows.append(task.result())
            progress(done, len(pairs))
    return TargetsReport(stand.name, names.structure, names.physics, sweep, tuple(rows))


def selftest_sources(stand: Stand, real: str, sweep: int, only: tuple[str, ...] = ()) -> dict[str, str]:
    """A stand's C with its self-test and a `main` for boards, by file name; `only`: with these functions alone."""
    made = generate_all(stand, real, only)
    return {**made.files, **selftest_files(stand, made), "main.c": selftest_main(stand.name, sweep)}


def _row(
    target: Target, real: str, program: Program, files: Mapping[str, str], expected: Sequence[str], sweep: int
) -> TargetRow:
    def row(verdict: str, reason: str = "", functions: int = 0) -> TargetRow:
        return TargetRow(target.name, target.title, built_with, real, functions, sweep, verdict, reason)

    built_with = " ".join((*target.compiler[:1], target.optimisation))
    if missing := target.missing_commands():
        return row("not installed", f"no {', '.join(missing)}: make targets")
    built_with = build_version(target)
    if unable := target.obstacle():
        return row("not here", unable)
    try:
        found = run_selftest(target, program.name, files).splitlines()
    except ToolchainError as error:
        return row("FAILED", str(error))
    problem = next(_problems(expected, found), "")
    if " FAIL " in problem:
        first = first_difference(target, program, files)
        problem += f"; first: {first}" if first else ""
    return row("FAILED" if problem else "ok", problem, sum(" PASS " in line for line in found))


def run_selftest(target: Target, name: str, files: Mapping[str, str], timeout: float = TIMEOUT) -> str:
    """Output of the self-test of a stand, built for a target. Raises ToolchainError."""
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
        return run(target, build(target, files, Path(scratch)), timeout)


def _problems(expected: Sequence[str], found: Sequence[str]) -> Iterator[str]:
    """Problems of a printed self-test: fast math and golden vectors first, then differences from the host."""
    for line in found:
        if line.startswith("wrong results"):
            yield line
        if " FAIL " in line:
            yield f"not the interpreter's bits: {line}"
    for ours, theirs in zip(expected, found, strict=False):
        if ours != theirs:
            yield f'the host has "{ours}", the target "{theirs}"'
    if len(expected) != len(found):
        yield f"{len(found)} lines, the host has {len(expected)}"
    if not any(line == "failures 0" for line in found):
        yield "no line says that there were no failures"


def as_json(report: TargetsReport) -> str:
    """The table as JSON."""
    facts = asdict(report)
    rows, states = facts.pop("rows"), facts.pop("sweep")
    verdict = {"states": states, "passed": report.passed, "conclusion": report.conclusion}
    return json.dumps({**facts, **verdict, "rows": rows}, indent=1)


def as_junit(report: TargetsReport) -> str:
    """The table as JUnit XML: one test case for each target and element type; without its tools it has failed."""
    rows = tuple(
        Check(
            f"{row.target} {row.real}",
            row.built_with,
            verdict="not compared" if row.verdict == "not here" else row.verdict,
            words=row.reason,
        )
        for row in report.rows
    )
    of = Report(report.stand, report.structure, report.physics, "self-test", 0, report.sweep, 0.0, rows)
    return checks_as_junit(of)


def first_difference(target: Target, program: Program, files: Mapping[str, str]) -> str:
    """`forward, V_dot[2], case "ordinary", 3 ulp`; "" where no listed output differs or the target does not run.

    `files` are the delivered C and self-test.
    """
    test = f"{VERIFICATION}{program.name}_selftest.c"
    sources = {name: text for name, text in files.items() if name not in ("main.c", test)}
    sources["main.c"] = difference_main(program.name)
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
        write_all(Path(scratch), {test: files[test]})  # main.c includes it
        try:
            printed = run(target, build(target, sources, Path(scratch)), TIMEOUT)
        except ToolchainError:
            return ""
    for line in printed.splitlines():
        name, case, number, ulp = line.split()
        distance = f"more than {FAR}" if int(ulp) > FAR else ulp
        outputs = list(output_names(program.function(name)))
        return f'{name}, {outputs[int(number)]}, case "{CASES[int(case)]}", {distance} ulp'
    return ""


def output_names(function: Function) -> Iterator[str]:
    """Names of the reals that a function gives, in the order in which the self-test takes them."""
    for a in sorted(function.arguments, key=lambda a: a.direction != "inout"):
        if a.direction != "in":
            yield from _names(a.name, a.type, a.shape)
    if function.returns is Kind.REAL:
        yield "value"


def _names(name: str, type_: Kind | Struct, shape: tuple[int | NamedCount, ...]) -> Iterator[str]:
    for index in np.ndindex(*map(int, shape)):
        place = name + "".join(f"[{i}]" for i in index)
        if isinstance(type_, Struct):
            for f in type_.fields:
                yield from _names(f"{place}.{f.name}", f.type, f.shape)
        elif type_ is Kind.REAL:
            yield place
