"""The same bits everywhere: a stand's self-test, built for targets, run on their emulators, compared line by line."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from mahovik.contract.functions import ALL
from mahovik.core.emit.delivery import selftest_files
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.board import build, build_version, run, selftest_main
from mahovik.core.toolchain.process import side_by_side
from mahovik.core.toolchain.targets import TARGETS, Target
from mahovik.errors import ToolchainError, UsageError
from mahovik.nearest import suggestion
from mahovik.proof.verify.check import Check, Report, report

REALS = ("double", "float")

QUICK = (("host", "double"), ("host", "float"), ("m4", "float"), ("m7", "double"), ("rv64gc", "double"))
"""Targets and element types of `quick`: the host, and each kind of FPU."""

SWEEP = 20
"""Pseudo-random states, beside the golden vectors, on which every function is called."""

NOT_INSTALLED = "not installed"
"""Verdict on a target whose compiler or emulator is not here: nothing is known, which is no pass."""

TIMEOUT = 300.0
"""Longest run on an emulator, s; the machine may be busy."""


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
    only: tuple[str, ...] = ALL,
) -> Report:
    """Builds and runs the self-test for each target and element type; compares the text with the host's.

    A check for each; its `states` are functions with the right bits, its `state` is compiler and optimisation. Where
    the processor lacks what the target wants, nothing is compared.

    `only`: of C with these public functions alone, as of `generate`.

    The golden vectors in the self-test are the interpreter's: a line reads PASS only if all bits equal its bits.
    Raises ToolchainError where the host itself has no gcc or cannot run the test.
    """
    sources = {real: selftest_sources(stand, real, sweep, only) for real in dict.fromkeys(real for _, real in pairs)}
    expected = {real: run_selftest(TARGETS["host"], stand.name, files).splitlines() for real, files in sources.items()}
    rows = []
    with side_by_side() as pool:
        tasks = [pool.submit(_check, t, real, stand.name, sources[real], expected[real]) for t, real in pairs]
        for done, task in enumerate(tasks, start=1):
            rows.append(task.result())
            progress(done, len(pairs))
    return report(stand, "self-test", 0, sweep, 0.0, rows)


def selftest_sources(stand: Stand, real: str, sweep: int, only: tuple[str, ...]) -> dict[str, str]:
    """A stand's C with its self-test and a `main` for boards, by file name; `only`: with these functions alone."""
    made = generate_all(stand, real, only)
    return {**made.files, **selftest_files(stand, made), "main.c": selftest_main(stand.name, sweep)}


def _check(target: Target, real: str, name: str, files: Mapping[str, str], expected: Sequence[str]) -> Check:
    """The self-test of the stand `name` on one target, against what it printed on the host."""
    row = Check(f"{target.name} {real}", target.title, state=" ".join((*target.compiler[:1], target.optimisation)))
    if missing := target.missing_commands():
        row.verdict, row.words = NOT_INSTALLED, f"no {', '.join(missing)}: make targets"
        return row
    row.state = build_version(target)
    if unable := target.obstacle():
        row.words = unable
        return row
    try:
        found = run_selftest(target, name, files).splitlines()
    except ToolchainError as error:
        row.verdict, row.words = "FAILED", str(error)
        return row
    row.words, row.states = next(_problems(expected, found), ""), sum(" PASS " in line for line in found)
    row.verdict = "FAILED" if row.words else "ok"
    return row


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
