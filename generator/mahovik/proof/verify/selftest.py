"""The same bits everywhere: a stand's self-test, built for targets and run on their emulators, or logged by a board.

What it says on a target is compared with the host; a log is judged by itself, by the stand file and by the sweep run
here. A terminal may put words before a line of a log, end lines with CR, LF or both, lose some, and begin or end in
the middle: other lines are ignored, and missing lines are reported.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from mahovik import __version__
from mahovik.core.emit.delivery import selftest_files
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.lower.golden import CASES, tested_functions
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities, under_name
from mahovik.core.toolchain.process import side_by_side
from mahovik.core.toolchain.targets import TARGETS, Target, build, build_version, run, selftest_main
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
            raise UsageError(f'targets: unknown "{word}"{suggestion(word, [*TARGETS, *groups])}')
    return [(TARGETS[word], real) for word in dict.fromkeys(words) for real in reals or REALS]


def verify_targets(
    stand: Stand,
    pairs: Sequence[tuple[Target, str]],
    sweep: int = SWEEP,
    progress: Callable[[int, int], None] = lambda done, count: None,
    only: tuple[str, ...] | None = None,
) -> Report:
    """Builds and runs the self-test for each target and element type; compares what it says with the host's.

    A check for each; its `states` are functions with the right bits, its `state` is compiler and optimisation. Where
    the processor lacks what the target wants, nothing is compared.

    `only`: of C with these public functions alone, as of `generate`.

    The golden vectors in the self-test are the interpreter's: a line reads PASS only if all bits equal its bits.
    Raises ToolchainError where the host itself has no gcc or cannot run the test.
    """
    sources = {real: selftest_sources(stand, real, sweep, only) for real in dict.fromkeys(real for _, real in pairs)}
    printed = {real: run_selftest(TARGETS["host"], stand.name, files) for real, files in sources.items()}
    expected = {real: read_log(text, "host")[-1] for real, text in printed.items()}
    rows = []
    with side_by_side() as pool:
        tasks = [pool.submit(_check, t, real, stand.name, sources[real], expected[real]) for t, real in pairs]
        for done, task in enumerate(tasks, start=1):
            rows.append(task.result())
            progress(done, len(pairs))
    return report(stand, "self-test", 0, sweep, 0.0, rows)


def selftest_sources(stand: Stand, real: str, sweep: int, only: tuple[str, ...] | None) -> dict[str, str]:
    """A stand's C with its self-test and a `main` for boards, by file name; `only`: with these functions alone."""
    made = generate_all(stand, real, only)
    return {**made.files, **selftest_files(stand, made), "main.c": selftest_main(stand.name, sweep)}


def _check(target: Target, real: str, name: str, files: Mapping[str, str], expected: SelfTestLog) -> Check:
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
        printed = run_selftest(target, name, files)
        log = read_log(printed, target.name)[-1]
    except (ToolchainError, UsageError) as error:
        row.verdict, row.words = "FAILED", str(error)
        return row
    lines = problems(log, [*expected.functions], expected.hashes)
    lines += [] if log == expected else ["the host has other lines"]
    row.words, row.states = next(iter(lines), ""), sum(line.startswith("PASS") for line in log.functions.values())
    row.verdict = "FAILED" if row.words else "ok"
    return row


def run_selftest(target: Target, name: str, files: Mapping[str, str], timeout: float = TIMEOUT) -> str:
    """Output of the self-test of a stand, built for a target. Raises ToolchainError."""
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
        return run(target, build(target, files, Path(scratch)), timeout)


# -- logs of boards ----------------------------------------------------------------------------------------------------

LONGEST_SWEEP = 1_000_000
"""Most states of a sweep that is judged, which take minutes. More come from a damaged line or another test."""

RIGHT = f"PASS cases {len(CASES) + 2} worst 0 ulp"
"""What the line of a function says behind its name, where all bits are those of the interpreter."""

_HEAD = re.compile(r"mahovik selftest (\w+) structure ([0-9a-f]{8}) physics ([0-9a-f]{8}) real (double|float)\s*$")
_FAST_MATH = re.compile(r"\bwrong results: (compiled with [\w, =-]{1,100})\s*$")
_LINES = {
    "functions": re.compile(r"\b(\w+) ((?:PASS|FAIL) cases [0-9]{1,9}(?: wrong [0-9]{1,9})?(?: \([a-z, ]{1,80}\))?"
                            r"(?: worst (?:more than )?[0-9]{1,20} ulp|(?<=\))))\s*$"),
    "generator": re.compile(r"generator mahovik (\S+)\s*$"),
    "sweep": re.compile(r"\bsweep ([0-9]{1,20})\s*$"),
    "failures": re.compile(r"\bfailures ([0-9]{1,9})\s*$"),
    "hashes": re.compile(r"\b(\w+) ([0-9a-f]{8})\s*$"),
}  # fmt: skip
"""Lines of a run by the member of SelfTestLog that they fill; hashes come after the line of the sweep."""

HOSTS = ("host", "host-clang")
"""Targets that are this machine, in the order in which they are tried."""

SWEEP_TIMEOUT = 600.0
"""Longest sweep on this machine, s."""


@dataclass
class SelfTestLog:
    """One run of a self-test. `generator`, `sweep`, `failures` are None where their line is missing.

    fast_math  how it was compiled, where the test itself found that its results are wrong
    functions  what the line of a function says behind its name; `hashes` of the sweep, by function as well
    repeated   functions with two lines that differ
    """

    stand: str
    structure: str
    physics: str
    real: str
    fast_math: str = ""
    generator: str | None = None
    functions: dict[str, str] = field(default_factory=dict)
    sweep: int | None = None
    hashes: dict[str, str] = field(default_factory=dict)
    failures: int | None = None
    repeated: list[str] = field(default_factory=list)

    def read(self, line: str) -> None:
        """Take what one line of the output says."""
        for member, pattern in _LINES.items():
            if (at := pattern.search(line)) and (member != "hashes" or self.sweep is not None):
                *name, value = at.groups()
                if not name:
                    setattr(self, member, value if member == "generator" else int(value))
                elif getattr(self, member).setdefault(name[0], value) != value:
                    self.repeated.append(name[0])
                return


def read_log(text: str, where: str) -> tuple[SelfTestLog, ...]:
    """All runs in a log, in order: a board that is reset begins again. Raises UsageError where there is none."""
    runs: list[SelfTestLog] = []
    fast_math = ""
    for line in re.split(r"\r\n|\r|\n", text):
        if head := _HEAD.search(line):
            runs.append(SelfTestLog(head[1], head[2], head[3], head[4], fast_math))
            fast_math = ""
        elif at := _FAST_MATH.search(line):
            fast_math = at[1]
        elif runs and runs[-1].failures is None:
            runs[-1].read(line)
    if not runs:
        expected = "expected what the self-test of a stand has printed"
        if 4 * text.count("\0") >= len(text) > 0:
            raise UsageError(f"{where}: is not plain text (UTF-16?): save it as UTF-8; {expected}")
        raise UsageError(f'{where}: no line "mahovik selftest ...": {expected}')
    return tuple(runs)


def problems(run: SelfTestLog, functions: Sequence[str] = (), hashes: Mapping[str, str] = {}) -> list[str]:
    """What is wrong with a run, a line for each kind. `functions` of the stand, `hashes` of the sweep, where known."""
    wanted = functions or list(dict.fromkeys((*run.functions, *run.hashes)))
    failed = [name for name, line in run.functions.items() if line.startswith("FAIL")]
    off = [(name, value) for name, value in hashes.items() if run.hashes.get(name, value) != value]
    named = {
        "wrong results": [run.fast_math] if run.fast_math else [],
        f"expected {RIGHT}": [f"{name} {line}" for name, line in run.functions.items() if line != RIGHT],
        "two lines that differ": list(dict.fromkeys(run.repeated)),
        "no line PASS or FAIL of": [name for name in wanted if name not in run.functions],
        "unknown functions": [name for name in run.functions if name not in wanted],
        "no hash of the sweep of": [name for name in wanted if run.sweep is not None and name not in run.hashes],
        f"other bits in the sweep of {run.sweep} states": [f"{n} {run.hashes[n]}, here {value}" for n, value in off],
        "no line, the log is not whole": [name for name in ("sweep", "failures") if getattr(run, name) is None],
    }
    lines = [f"{what}: {', '.join(names)}" for what, names in named.items() if names]
    if run.sweep is not None and run.sweep > LONGEST_SWEEP:
        lines.append(f"sweep of {run.sweep} states: at most {LONGEST_SWEEP} are judged: run fewer on the board")
    if run.failures is not None and run.failures != len(failed):
        lines.append(f"failures {run.failures}, but {len(failed)} lines say FAIL")
    return lines


@dataclass(frozen=True)
class LogVerdict:
    """`problems`: what differs, a line each. `checked`, `unchecked`: what was compared, and what could not be."""

    runs: tuple[SelfTestLog, ...]
    problems: tuple[str, ...]
    checked: tuple[str, ...]
    unchecked: tuple[str, ...]


def judge_log(text: str, where: str, stand: Stand | None = None, only: tuple[str, ...] = ()) -> LogVerdict:
    """Judges every run in a log, of the stand by its own name or that of `generate --prefix`.

    `only`: functions that `generate --only` was given; empty: those that it writes by default.
    Raises UsageError where the text is no log, ToolchainError where C does not run.
    """
    runs, unchecked = read_log(text, where), list[str]()
    checked = ["golden vectors, as the board has judged them"]
    if stand is None:
        unchecked.append("identities, the list of functions, and the sweep: give the stand file")
    else:
        part = f" of {','.join(only)}" if only else ""
        checked = ["identities", f"every function{part} there", *checked]
    faults: list[str] = []
    sweeps: dict[tuple[str, str, int], Mapping[str, str]] = {}  # hashes here, none where nothing can compute them
    for number, log in enumerate(runs, start=1):
        named = stand and (under_name(stand, log.stand, log.physics) or stand)
        lines = identity_problems(log, named) if named else []
        if named is None or lines:
            lines += problems(log)
        else:
            made = generate_all(named, log.real, only=only)
            wanted, key = [f.name for f in tested_functions(made.program)], (log.stand, log.real, log.sweep or 0)
            alike = set(wanted) == {*log.functions}  # inputs of a sweep are drawn for all functions that were generated
            if alike and log.sweep is not None and log.sweep <= LONGEST_SWEEP and key not in sweeps:
                sweeps[key], maker = _hashes(named, made, log.sweep)
                by = f", by {maker}" if maker else ": no C compiler here"
                (checked if maker else unchecked).append(f"sweep of {log.sweep} states, {log.real}{by}")
            lines = problems(log, wanted, sweeps.get(key, {}) if alike else {})
            lines += [] if alike else [f"C of some functions alone? name them: only {','.join(log.functions)}"]
        faults += [f"run {number} of {len(runs)}: {line}" if len(runs) > 1 else line for line in lines]
    return LogVerdict(runs, tuple(faults), tuple(checked), tuple(unchecked))


def identity_problems(run: SelfTestLog, stand: Stand) -> list[str]:
    """Differences of the C on the board from that of a stand file by this version of the generator."""
    file = identities(stand)
    pairs = {"stand": stand.name, "structure": file.structure, "physics": file.physics}
    off = [(kind, has) for kind, has in pairs.items() if getattr(run, kind) != has]
    lines = [f"{kind} {getattr(run, kind)}, the stand file has {has}" for kind, has in off]
    if run.generator not in (None, __version__):
        lines.append(f"made by mahovik {run.generator}, this is {__version__}: generate and run it again")
    return lines


def _hashes(stand: Stand, made: Generated, sweep: int) -> tuple[Mapping[str, str], str]:
    """Hashes of a sweep by function, and the compiler of what computed them: nothing if there is none here."""
    target = next((TARGETS[name] for name in HOSTS if not TARGETS[name].missing_commands()), None)
    if target is None:
        return {}, ""
    sources = selftest_sources(stand, made.program.precision.name, sweep, made.only)
    printed = run_selftest(target, stand.name, sources, SWEEP_TIMEOUT)
    return read_log(printed, target.name)[-1].hashes, f"{target.compiler[0]} on this machine"
