"""The log of a self-test, as a serial terminal has kept it: read, and judged.

The text is that which the head of `<stand>_selftest.c` describes. A terminal may put words before a line, end lines
with CR, LF or both, lose some, and begin or end in the middle: what is no line of the test is passed over, and what is
missing is said.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from mahovik import __version__
from mahovik.core.lower.golden import CASES, FAR
from mahovik.errors import UsageError

_Value = TypeVar("_Value")

MOST = 1_000_000
"""States of a sweep that are judged at most: minutes on a desk. More is a damaged line, or a test of another kind."""

_HEAD = re.compile(
    r"mahovik selftest (\w+) structure ([0-9a-f]{8}) physics ([0-9a-f]{8}) real (double|float)"
    r"(?: lanes ([1-9]))?( fast)?\s*$",
)
_GENERATOR = re.compile(r"generator mahovik (\S+)\s*$")
_FUNCTION = re.compile(
    r"\b(\w+) (PASS|FAIL) cases ([0-9]{1,9})(?: wrong ([0-9]{1,9}))? worst (more than )?([0-9]{1,20}) ulp\s*$"
)
_SWEEP = re.compile(r"\bsweep ([0-9]{1,20})\s*$")
_HASH = re.compile(r"\b(\w+) ([0-9a-f]{8})\s*$")
_FAILURES = re.compile(r"\bfailures ([0-9]{1,9})\s*$")


@dataclass(frozen=True)
class FunctionLine:
    """What the test says of one function: golden cases, how many of them are wrong, worst distance in ulp.

    `worst` is FAR + 1 where the test says that it is more than FAR.
    """

    passed: bool
    cases: int
    wrong: int
    worst: int

    @property
    def distance(self) -> str:
        """The worst distance as the test prints it."""
        return f"more than {FAR} ulp" if self.worst > FAR else f"{self.worst} ulp"


@dataclass
class SelfTestLog:
    """One run of a self-test. `sweep`, `failures` are None where their line is missing."""

    stand: str
    structure: str
    physics: str
    real: str
    generator: str | None = None
    lanes: int = 1
    functions: dict[str, FunctionLine] = field(default_factory=dict)
    sweep: int | None = None
    hashes: dict[str, str] = field(default_factory=dict)
    failures: int | None = None
    repeated: list[str] = field(default_factory=list)
    """Functions of which two lines say different things."""


def read_log(text: str, where: str) -> tuple[SelfTestLog, ...]:
    """All runs in a log, in order: a board that is reset begins again. Raises UsageError where there is none."""
    runs: list[SelfTestLog] = []
    for line in re.split(r"\r\n|\r|\n", text):
        if head := _HEAD.search(line):
            if head[6]:
                raise UsageError(
                    f"{where}: of C for speed (--fast): its bits are not reproducible, its own verdict counts"
                )
            runs.append(SelfTestLog(head[1], head[2], head[3], head[4], lanes=int(head[5] or 1)))
        elif runs and runs[-1].failures is None:
            _read_line(runs[-1], line)
    if not runs:
        expected = "expected what the self-test of a stand has printed"
        if 4 * text.count("\0") >= len(text) > 0:
            raise UsageError(f"{where}: is not plain text (UTF-16?): save it as UTF-8; {expected}")
        raise UsageError(f'{where}: no line "mahovik selftest ...": {expected}')
    return tuple(runs)


def _read_line(run: SelfTestLog, line: str) -> None:
    if found := _FUNCTION.search(line):
        name, verdict, cases, wrong, far, worst = found.groups()
        distance = FAR + 1 if far else int(worst)
        _once(run, run.functions, name, FunctionLine(verdict == "PASS", int(cases), int(wrong or 0), distance))
    elif found := _GENERATOR.search(line):
        run.generator = found[1]
    elif found := _SWEEP.search(line):
        run.sweep = int(found[1])
    elif found := _FAILURES.search(line):
        run.failures = int(found[1])
    elif run.sweep is not None and (found := _HASH.search(line)):
        _once(run, run.hashes, found[1], found[2])


def _once(run: SelfTestLog, known: dict[str, _Value], name: str, value: _Value) -> None:
    if known.setdefault(name, value) != value:
        run.repeated.append(name)


def problems(run: SelfTestLog, functions: Iterable[str] | None = None) -> list[str]:
    """What is wrong with a run by itself, one line a kind; `functions`: those that a stand has, where it is known."""
    found = []
    wanted = list(functions) if functions is not None else list(dict.fromkeys((*run.functions, *run.hashes)))
    if failed := [f"{name} (worst {line.distance})" for name, line in run.functions.items() if not line.passed]:
        found.append(f"FAIL: {', '.join(failed)}")
    if odd := [name for name, line in run.functions.items() if line.passed and (line.wrong or line.worst)]:
        found.append(f"PASS with wrong bits, which the self-test does not print: {', '.join(odd)}")
    if run.repeated:
        found.append(f"two lines that differ: {', '.join(dict.fromkeys(run.repeated))}")
    if absent := [name for name in wanted if name not in run.functions]:
        found.append(f"no line PASS or FAIL of: {', '.join(absent)}")
    if other := [name for name in run.functions if name not in wanted]:
        found.append(f"unknown functions: {', '.join(other)}")
    if few := [name for name, line in run.functions.items() if line.cases != len(CASES) + 1]:
        found.append(f"not {len(CASES) + 1} cases, as this version has: {', '.join(few)}")
    if run.sweep is None:
        found.append('no line "sweep": the log ends before it')
    elif run.sweep > MOST:
        found.append(f"sweep of {run.sweep} states: at most {MOST} are judged: run fewer on the board")
    elif absent := [name for name in wanted if name not in run.hashes]:
        found.append(f"no hash of the sweep of: {', '.join(absent)}")
    if run.failures is None:
        found.append('no line "failures": the log is not whole')
    elif run.failures and not failed:
        found.append(f"failures {run.failures}, but no line says FAIL")
    return found


def identity_problems(run: SelfTestLog, stand: str, structure: str, physics: str) -> list[str]:
    """Whether the C on the board is that of a stand file, by this version of the generator."""
    pairs = (("stand", run.stand, stand), ("structure", run.structure, structure), ("physics", run.physics, physics))
    found = [f"{kind} {has}, the stand file has {wants}" for kind, has, wants in pairs if has != wants]
    if run.generator is not None and run.generator != __version__:
        found.append(f"made by mahovik {run.generator}, this is {__version__}: generate and run it again")
    return found


def hash_problems(run: SelfTestLog, expected: Mapping[str, str]) -> list[str]:
    """Where the sweep on the board has other bits than here."""
    off = [name for name, value in expected.items() if run.hashes.get(name, value) != value]
    if not off:
        return []
    first = off[0]
    return [
        f"other bits in the sweep of {run.sweep} states: {', '.join(off)} "
        f"({first}: {run.hashes[first]} on the board, {expected[first]} here)"
    ]
