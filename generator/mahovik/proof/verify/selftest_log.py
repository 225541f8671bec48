"""The log of a self-test from a real board: read, then judged by itself, by the stand file and by the sweep run here.

The text is that which the head of `<stand>_selftest.c` describes. A terminal may put words before a line, end lines
with CR, LF or both, lose some, and begin or end in the middle: other lines are ignored, and missing lines are reported.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from mahovik import __version__
from mahovik.contract.functions import is_public
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.lower.golden import CASES, FAR, sweep_hashes, tested_functions
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.targets import TARGETS
from mahovik.errors import UsageError
from mahovik.proof.verify.delivery import under_name
from mahovik.proof.verify.targets import run_selftest, selftest_sources

LONGEST_SWEEP = 1_000_000
"""Most states of a sweep that is judged, which take minutes. More come from a damaged line or another test."""

_HEAD = re.compile(r"mahovik selftest (\w+) structure ([0-9a-f]{8}) physics ([0-9a-f]{8}) real (double|float)\s*$")
_GENERATOR = re.compile(r"generator mahovik (\S+)\s*$")
_FAST_MATH = re.compile(r"\bwrong results: (compiled with [\w, =-]{1,100})\s*$")
_FUNCTION = re.compile(
    r"\b(\w+) (PASS|FAIL) cases ([0-9]{1,9})(?: wrong ([0-9]{1,9}))?(?: \(([a-z, ]{1,80})\))?"
    r"(?: worst (more than )?([0-9]{1,20}) ulp|(?<=\)))\s*$"
)
_SWEEP = re.compile(r"\bsweep ([0-9]{1,20})\s*$")
_HASH = re.compile(r"\b(\w+) ([0-9a-f]{8})\s*$")
_FAILURES = re.compile(r"\bfailures ([0-9]{1,9})\s*$")

HOSTS = ("host", "host-clang")
"""Targets that are this machine, in the order in which they are tried."""

INTERPRETED_STATES = 200
"""States of a sweep up to which the interpreter takes the place of a missing compiler."""

TIMEOUT = 600.0
"""Longest sweep on this machine, s."""


@dataclass(frozen=True)
class FunctionLine:
    """Line of the test on one function: golden cases, wrong cases, worst distance in ulp.

    `worst` is FAR + 1 if the test prints that it is more than FAR. `faults`: what is wrong, as the test prints it.
    """

    passed: bool
    cases: int
    wrong: int
    worst: int
    faults: str = ""

    @property
    def words(self) -> str:
        """Faults and the worst distance, as the test prints them."""
        distance = f"worst more than {FAR} ulp" if self.worst > FAR else f"worst {self.worst} ulp"
        return ", ".join(filter(None, (self.faults, distance if self.worst or not self.faults else "")))


@dataclass
class SelfTestLog:
    """One run of a self-test. `sweep`, `failures` are None where their line is missing.

    repeated   functions with two lines that differ
    fast_math  how it was compiled, where the test itself found that its results are wrong
    """

    stand: str
    structure: str
    physics: str
    real: str
    fast_math: str = ""
    generator: str | None = None
    functions: dict[str, FunctionLine] = field(default_factory=dict)
    sweep: int | None = None
    hashes: dict[str, str] = field(default_factory=dict)
    failures: int | None = None
    repeated: list[str] = field(default_factory=list)

    def read(self, line: str) -> None:
        """Take what one line of the output says."""
        if found := _FUNCTION.search(line):
            name, verdict, cases, wrong, faults, far, worst = found.groups()
            distance = FAR + 1 if far else int(worst or 0)
            seen = FunctionLine(verdict == "PASS", int(cases), int(wrong or 0), distance, faults or "")
            if self.functions.setdefault(name, seen) != seen:
                self.repeated.append(name)
        elif found := _GENERATOR.search(line):
            self.generator = found[1]
        elif found := _SWEEP.search(line):
            self.sweep = int(found[1])
        elif found := _FAILURES.search(line):
            self.failures = int(found[1])
        elif (
            self.sweep is not None
            and (found := _HASH.search(line))
            and self.hashes.setdefault(found[1], found[2]) != found[2]
        ):
            self.repeated.append(found[1])


def read_log(text: str, where: str) -> tuple[SelfTestLog, ...]:
    """All runs in a log, in order: a board that is reset begins again. Raises UsageError where there is none."""
    runs: list[SelfTestLog] = []
    fast_math = ""
    for line in re.split(r"\r\n|\r|\n", text):
        if head := _HEAD.search(line):
            runs.append(SelfTestLog(head[1], head[2], head[3], head[4], fast_math))
            fast_math = ""
        elif found := _FAST_MATH.search(line):
            fast_math = found[1]
        elif runs and runs[-1].failures is None:
            runs[-1].read(line)
    if not runs:
        expected = "expected what the self-test of a stand has printed"
        if 4 * text.count("\0") >= len(text) > 0:
            raise UsageError(f"{where}: is not plain text (UTF-16?): save it as UTF-8; {expected}")
        raise UsageError(f'{where}: no line "mahovik selftest ...": {expected}')
    return tuple(runs)


def problems(run: SelfTestLog, functions: Iterable[str] | None = None) -> list[str]:
    """Problems within a run, a line for each kind; `functions`: those of the stand, if it is known."""
    lines, cases = run.functions, len(CASES) + 2
    wanted = list(functions) if functions is not None else list(dict.fromkeys((*lines, *run.hashes)))
    failed = [f"{name} ({line.words})" for name, line in lines.items() if not line.passed]
    odd = [name for name, line in lines.items() if line.passed and (line.wrong or line.worst)]
    named = {
        "wrong results": [run.fast_math] if run.fast_math else [],
        "FAIL": failed,
        "PASS with wrong bits, which the self-test does not print": odd,
        "two lines that differ": list(dict.fromkeys(run.repeated)),
        "no line PASS or FAIL of": [name for name in wanted if name not in lines],
        "unknown functions": [name for name in lines if name not in wanted],
        f"not {cases} cases, as this version has": [name for name, line in lines.items() if line.cases != cases],
    }
    if run.sweep is not None and run.sweep <= LONGEST_SWEEP:
        named["no hash of the sweep of"] = [name for name in wanted if name not in run.hashes]
    found = [f"{what}: {', '.join(names)}" for what, names in named.items() if names]
    if run.sweep is None:
        found.append('no line "sweep": the log ends before it')
    elif run.sweep > LONGEST_SWEEP:
        found.append(f"sweep of {run.sweep} states: at most {LONGEST_SWEEP} are judged: run fewer on the board")
    if run.failures is None:
        found.append('no line "failures": the log is not whole')
    elif run.failures and not failed:
        found.append(f"failures {run.failures}, but no line says FAIL")
    return found


@dataclass(frozen=True)
class LogVerdict:
    """`problems`: what differs, a line each. `checked`, `unchecked`: what was compared, and what could not be."""

    runs: tuple[SelfTestLog, ...]
    problems: tuple[str, ...]
    checked: tuple[str, ...]
    unchecked: tuple[str, ...]


def judge_log(text: str, where: str, stand: Stand | None = None, only: tuple[str, ...] = ()) -> LogVerdict:
    """Judges every run in a log, of the stand by its own name or that of `generate --prefix`.

    `only`: public functions that the C was generated with; empty: all.
    Raises UsageError where the text is no log, ToolchainError where C does not run.
    """
    runs = read_log(text, where)
    found: list[str] = []
    checked = [] if stand is None else ["identities", "every function there"]
    if stand is not None and only:
        checked[1] = f"every function of --only {','.join(only)} there"
    checked.append("golden vectors, as the board has judged them")
    unchecked: list[str] = []
    if stand is None:
        unchecked.append("identities, the list of functions, and the sweep: give the stand file")
    sweeps: dict[tuple[str, str, int], Mapping[str, str]] = {}  # hashes here, none where nothing can compute them
    for number, run in enumerate(runs, start=1):
        lines = problems(run)
        if stand is not None:
            named = under_name(stand, run.stand, run.physics) or stand
            made = None if (lines := identity_problems(run, named)) else generate_all(named, run.real, only=only)
            if made is not None:
                wanted = [f.name for f in tested_functions(made.program)]
                if parts := part_problems(run, wanted, only):
                    lines = [*problems(run), *parts]
                else:
                    lines = problems(run, wanted)
                    key = (run.stand, run.real, run.sweep or 0)
                    if run.sweep is not None and run.sweep <= LONGEST_SWEEP and key not in sweeps:
                        sweeps[key], maker = _hashes(named, made, run.sweep)
                        what = f"sweep of {run.sweep} states, {run.real}"
                        if maker:
                            checked.append(f"{what}, by {maker}")
                        else:
                            unchecked.append(f"{what}: no C compiler here, and too long for the interpreter")
                    lines += hash_problems(run, sweeps.get(key, {}))
        found += [f"run {number} of {len(runs)}: {line}" if len(runs) > 1 else line for line in lines]
    return LogVerdict(runs, tuple(found), tuple(checked), tuple(unchecked))


def identity_problems(run: SelfTestLog, stand: Stand) -> list[str]:
    """Differences of the C on the board from that of a stand file by this version of the generator."""
    file = identities(stand)
    pairs = (
        ("stand", run.stand, stand.name),
        ("structure", run.structure, file.structure),
        ("physics", run.physics, file.physics),
    )
    found = [f"{kind} {has}, the stand file has {wants}" for kind, has, wants in pairs if has != wants]
    if run.generator is not None and run.generator != __version__:
        found.append(f"made by mahovik {run.generator}, this is {__version__}: generate and run it again")
    return found


def part_problems(run: SelfTestLog, wanted: Collection[str], only: Sequence[str]) -> list[str]:
    """A line if a log lacks some `wanted` functions or has more, but could be of another `only`; none if it is damaged.

    Such a log cannot be compared: inputs of a sweep are drawn for all functions that were generated.
    """
    there = dict.fromkeys((*run.functions, *run.hashes))
    absent = [name for name in wanted if name not in there]
    extra = [name for name in there if name not in wanted]
    whole = run.sweep is not None and run.failures is not None and set(run.functions) == set(run.hashes)
    if not whole or not (absent or extra) or not all(map(is_public, there)):
        return []
    if not only:
        names, lost = ",".join(there), f"else lines were lost of {', '.join(absent)}"
        return [f"holds a part of the functions: of C of `generate --only`, give --only {names}; {lost}"]
    off = [f"nothing of: {', '.join(absent)}"] if absent else []
    off += [f"functions that --only does not name: {', '.join(extra)}"] if extra else []
    return [f"{'; '.join(off)}: give --only as `generate` had it"]


def hash_problems(run: SelfTestLog, expected: Mapping[str, str]) -> list[str]:
    """Functions whose sweep on the board has other bits than here, in one line."""
    off = [name for name, value in expected.items() if run.hashes.get(name, value) != value]
    if not off:
        return []
    first = f"{off[0]}: {run.hashes[off[0]]} on the board, {expected[off[0]]} here"
    return [f"other bits in the sweep of {run.sweep} states: {', '.join(off)} ({first})"]


def _hashes(stand: Stand, made: Generated, sweep: int) -> tuple[Mapping[str, str], str]:
    """Hashes of a sweep by function, and what computed them: nothing if no tool on this machine can."""
    real = made.program.precision.name
    target = next((TARGETS[name] for name in HOSTS if not TARGETS[name].missing_commands()), None)
    if target is not None:
        sources = selftest_sources(stand, real, sweep, made.only)
        printed = run_selftest(target, stand.name, sources, TIMEOUT)
        return read_log(printed, target.name)[-1].hashes, f"{target.compiler[0]} on this machine"
    if sweep <= INTERPRETED_STATES:
        found = sweep_hashes(made.program, made.values, sweep)
        return {name: f"{value:08x}" for name, value in found.items()}, "the interpreter"
    return {}, ""
