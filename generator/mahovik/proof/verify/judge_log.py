"""Judges the log of a self-test from a real board: by itself, by the stand file, and by the same sweep run here."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.lower.golden import sweep_hashes, tested
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.board import build, run, selftest_flags
from mahovik.core.toolchain.targets import TARGETS
from mahovik.proof.verify.selftest_log import MOST, SelfTestLog, hash_problems, identity_problems, problems, read_log
from mahovik.proof.verify.targets import selftest_sources

HOSTS = ("host", "host-clang")
"""Targets that are this machine, in the order in which they are tried."""

INTERPRETED = 200
"""States of a sweep up to which the interpreter takes the place of a missing compiler."""

TIMEOUT = 600.0
"""s; for the sweep on this machine."""


@dataclass(frozen=True)
class LogVerdict:
    """`problems`: what differs, a line each. `checked`, `unchecked`: what was compared, and what could not be."""

    runs: tuple[SelfTestLog, ...]
    problems: tuple[str, ...]
    checked: tuple[str, ...]
    unchecked: tuple[str, ...]


def judge_log(text: str, where: str, stand: Stand | None = None) -> LogVerdict:
    """Judges every run in a log. Raises UsageError where the text is no log, ToolchainError where C does not run."""
    runs = read_log(text, where)
    found: list[str] = []
    checked = ["golden vectors, as the board has judged them"]
    unchecked: list[str] = []
    if stand is None:
        for number, one in enumerate(runs):
            found += _numbered(problems(one), number, runs)
        unchecked.append("identities, the list of functions, and the sweep: give the stand file")
        return LogVerdict(runs, tuple(found), tuple(checked), tuple(unchecked))
    expected = identities(stand)
    here: dict[tuple[str, int, int], tuple[Mapping[str, str], str] | None] = {}
    for number, one in enumerate(runs):
        lines = identity_problems(one, stand.name, expected.structure, expected.physics)
        if not lines:
            made = generate_all(stand, one.real, one.lanes)
            lines = problems(one, [f.name for f in tested(made.program)])
            if one.sweep is not None and one.sweep <= MOST:
                key = (one.real, one.lanes, one.sweep)
                if key not in here:
                    here[key] = _hashes(stand, made, one.sweep)
                    what = f"sweep of {one.sweep} states, {one.real}"
                    known = here[key]
                    if known is None:
                        unchecked.append(f"{what}: no C compiler here, and too long for the interpreter")
                    else:
                        checked.append(f"{what}, by {known[1]}")
                known = here[key]
                lines += hash_problems(one, known[0]) if known is not None else []
        found += _numbered(lines, number, runs)
    checked[:0] = ["identities", "every function there"]
    return LogVerdict(runs, tuple(found), tuple(checked), tuple(unchecked))


def _numbered(lines: list[str], number: int, runs: tuple[SelfTestLog, ...]) -> list[str]:
    return [f"run {number + 1} of {len(runs)}: {line}" if len(runs) > 1 else line for line in lines]


def _hashes(stand: Stand, made: Generated, sweep: int) -> tuple[Mapping[str, str], str] | None:
    """Hashes of a sweep by function, and who made them; None where nobody here can."""
    real = made.program.precision.name
    target = next((TARGETS[name] for name in HOSTS if not TARGETS[name].missing()), None)
    if target is not None:
        with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
            sources = selftest_sources(stand, real, sweep, made.layout.lanes)
            program = build(target, sources, Path(scratch), extra=selftest_flags(stand.name))
            printed = run(target, program, TIMEOUT)
        return read_log(printed, target.name)[-1].hashes, f"{target.compiler[0]} on this machine"
    if sweep <= INTERPRETED:
        found = sweep_hashes(made.program, made.values, sweep)
        return {name: f"{value:08x}" for name, value in found.items()}, "the interpreter"
    return None
