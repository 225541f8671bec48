"""All pieces of evidence, in the order in which they are run and shown: most are a command of the product."""

from __future__ import annotations

import json
import shlex
import shutil
import subprocess
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from enum import Enum
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path

from mahovik.contract.functions import ROWS
from mahovik.core.emit.eva import drivers
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.compiler import BITS
from mahovik.core.toolchain.static_checks import (
    ANALYSER,
    CPPCHECK,
    DEVIATIONS,
    STANDING_FINDINGS,
    WARNINGS,
    count_by_rule,
    findings,
    version,
)
from mahovik.proof.verify.targets import parse_targets


class Verdict(Enum):
    """How a piece came out, in the words of the page."""

    PASSED = "passed"
    FAILED = "FAILED"
    MISSING = "not run: tool missing"
    LEFT_OUT = "left out by option"
    NOTHING = "nothing to judge"


@dataclass(frozen=True)
class Subject:
    """The stand whose evidence is collected, and the folders for it.

    folder   of the evidence: the delivered C lies in `c/`, the stand file beside it
    scratch  for what is not kept
    full     everything, for as long as it takes; else a selection, minutes
    seconds  of fuzzing
    only     public functions of the delivered C, as `generate` takes them; empty: the default
    """

    stand: Stand
    real: str
    folder: Path
    scratch: Path
    full: bool = False
    seconds: int = 20
    only: tuple[str, ...] = ()

    @property
    def c(self) -> Path:
        """The delivered C."""
        return self.folder / "c"

    @property
    def file(self) -> str:
        """Name of the copy of the stand file."""
        return f"{self.stand.name}.toml"

    @property
    def sources(self) -> list[str]:
        """C for firmware in the delivered folder."""
        return [
            name
            for name in (f"{self.stand.name}.c", f"{VERIFICATION}{self.stand.name}_recorder.c")
            if (self.c / name).is_file()
        ]

    @property
    def selftest(self) -> str:
        """The self-test in the delivered folder."""
        return f"{VERIFICATION}{self.stand.name}_selftest.c"


@dataclass(frozen=True)
class Need:
    """A tool without which a piece cannot run, the command that installs it, whether it is here, and its version."""

    name: str
    install: str
    is_present: Callable[[], bool]
    version: Callable[[], str] = lambda: ""


def program(name: str, packages: str = "") -> Need:
    """A program on the path; `packages` of Debian: by default the one of its name."""
    install = f"apt-get install {packages or name}"
    return Need(name, install, lambda: shutil.which(name) is not None, lambda: version(name))


def module(name: str, package: str = "", extra: str = "") -> Need:
    """A Python module of a package, of an extra of this one."""
    package = package or name
    said = lambda: f"{package} {metadata.version(package)}"  # noqa: E731
    return Need(name, f"pip install 'mahovik[{extra}]'", lambda: find_spec(name) is not None, said)


@dataclass(frozen=True)
class Outcome:
    """How a piece came out.

    figure   result for the summary, one line
    notes    sentences for its section: what is missing, what was found
    files    what is kept, content by name
    command  that repeats it
    tools    what did it, with versions
    """

    verdict: Verdict
    figure: str
    notes: tuple[str, ...] = ()
    files: Mapping[str, str | bytes] = field(default_factory=dict)
    command: str = ""
    tools: tuple[str, ...] = ()


@dataclass(frozen=True)
class Piece:
    """One piece.

    shows    what a reader may conclude where it has passed
    limits   what it does not show
    command  runs it again, in a copy of the folder; run here as it stands, unless there is `run`
    needs    tools it cannot do without
    figure   what of the printed words is the result for the summary: a pattern with a group; else the last line
    words    around that figure
    kept     files that the command writes, patterns
    idle     why there is nothing to judge of a subject; "" where there is
    run      in place of the command; raises MahovikError, which is a failure
    """

    name: str
    title: str
    shows: str
    limits: str
    command: Callable[[Subject], str]
    needs: Callable[[Subject], Sequence[Need]] = lambda _: ()
    figure: str = r"^ *(?:passed: |FAILED: |error: |(?=nothing|FAILED))(.*)"
    words: str = "{}"
    kept: tuple[str, ...] = ()
    idle: Callable[[Subject], str] = lambda _: ""
    run: Callable[[Subject], Outcome] | None = None


def _run_selftest(subject: Subject) -> str:
    name = subject.stand.name
    build = (
        f"cc -std=c99 -O2 -ffp-contract=off -D{name.upper()}_SELFTEST_MAIN c/{name}.c c/{subject.selftest} -o selftest"
    )
    some = f" --only {','.join(subject.only)}" if subject.only else ""
    return f"{build} && ./selftest > selftest.log; mahovik judge-log {subject.file} --log selftest.log{some}"


LEAST_BRANCHES = 82
"""Least percentage taken: no caller takes all, such as a pivot of a definite matrix that is zero."""


def _branches_command(subject: Subject) -> str:
    name = subject.stand.name
    files = f"-D{name.upper()}_SELFTEST_MAIN c/{name}.c c/{subject.selftest}"
    judge = f"awk -F'[:%]' '{{ print }} /^Taken/ {{ enough += $2 >= {LEAST_BRANCHES} }} END {{ exit !enough }}'"
    build = f"gcc -std=c99 -O0 --coverage {shlex.join(BITS)} {files} -o branches"
    return f"{build} && ./branches >log && gcov -b -c branches-{name}.gcda | {judge}"


def _without_judges(subject: Subject) -> str:
    if subject.real != "double":
        return "the judges calculate in double: collect the evidence of the C in double"
    return "" if any(body.mass > 0.0 for body in subject.stand.bodies) else "no body of the stand has a mass"


def _compile_strictly(subject: Subject) -> str:
    files = " ".join([*subject.sources, subject.selftest])
    both = " && ".join(f"{compiler} {shlex.join(WARNINGS)} -O2 -fsyntax-only {files}" for compiler in ("gcc", "clang"))
    return f"cd c && {both} && {shlex.join(ANALYSER)} {files} && echo {len(files.split())} files, no complaint"


def _check_misra(subject: Subject) -> Outcome:
    found = findings(subject.c, subject.sources)
    reasons, counts = {**DEVIATIONS, **STANDING_FINDINGS}, count_by_rule(found)
    unlisted = sorted(rule for rule in counts if rule not in reasons)
    figure = f"{sum(counts.values())} findings under {len(counts)} rules, each listed with its reason"
    return Outcome(
        Verdict.FAILED if unlisted else Verdict.PASSED,
        f"findings that are not listed: {', '.join(unlisted)}" if unlisted else figure,
        tuple(f"{rule}, {counts[rule]} times: {why}" for rule, why in reasons.items() if rule in counts),
        {"findings.json": json.dumps([asdict(finding) for finding in found], indent=1) + "\n"},
    )


_QUICK_DRIVERS = ("any_wrap", "any_forward", "any_torque", "normal_prepare", "routine_sincos", "routine_sqrt")
_UNCLAIMED = ", ".join(f"`{row.name}`" for row in ROWS.values() if not row.claimed)


def _eva_command(subject: Subject) -> str:
    every = drivers(generate_all(subject.stand, subject.real, subject.only).program)
    claimed = [f"{driver.set}_{driver.function}" for driver in every if driver.claimed]
    chosen = "" if subject.full else "".join(f" {name}" for name in claimed if name in _QUICK_DRIVERS)
    limit = 1800 if subject.full else 300  # s a driver may take
    script = f"c/{VERIFICATION}{subject.stand.name}_eva.sh{chosen}"
    return f'EVA_LIMIT={limit} EVA_LOGS=$PWD sh {script} && echo "no alarm in $(ls *.log | wc -l) drivers"'


def _fuzzer_links() -> bool:
    """Whether clang has its runtime: without it the harness does not link."""
    done = subprocess.run(["clang", "-print-runtime-dir"], capture_output=True, text=True, check=False)
    return any(Path(done.stdout.strip()).glob("libclang_rt.fuzzer*.a"))


def _target_tools(names: str, real: str) -> tuple[Need, ...]:
    """Compilers and emulators of targets."""
    needs: dict[str, Need] = {}
    for target, _ in parse_targets(names, (real,)):
        for command in (target.compiler[0], target.link[0], *target.emulator[:1]):
            needs.setdefault(command, program(command, " ".join(target.packages)))
    return tuple(needs.values())


_COST_TARGETS = {"double": "m7,rv64gc", "float": "m4,rv32imafc"}
"""Processors whose FPU calculates with that type."""


def _targets(subject: Subject) -> str:
    quick = "host,m7,rv64gc" if subject.real == "double" else "host,m4,rv64gc"
    return "all" if subject.full else quick


PIECES: tuple[Piece, ...] = (
    Piece(
        name="delivery",
        title="The C is what the stand file gives",
        shows="Another process generated it again: `c/` is, byte for byte, of the stand file beside it.",
        limits="That masses, mountings and unbalances of the stand file are those of the real machine.",
        command=lambda s: f"mahovik generate {s.file} -o c --check",
        figure=r"^c +(as the stand file gives it)$",
    ),
    Piece(
        name="selftest",
        title="Self-test that travels with the C",
        shows="Every public function has the bits of the interpreter: compiler and processor changed nothing.",
        limits="That equations are right: it compares the C with its own program. `mahovik judge-log` judges boards.",
        command=_run_selftest,
        figure=r"\A(?:PASS)?\s*(.*)",
        kept=("selftest.log",),
        needs=lambda _: (program("gcc"),),
    ),
    Piece(
        name="branches",
        title="Branches that the self-test takes",
        shows=f"The self-test takes {LEAST_BRANCHES} % or more of the ways out of conditions; a file counts each line.",
        limits="That the answers are right: the self-test compares them with the interpreter; other pieces judge them.",
        command=_branches_command,
        figure=r"^Taken at least once:(.*)",
        kept=("*.c.gcov",),
        needs=lambda _: (program("gcc"), program("gcov", "gcc")),
    ),
    Piece(
        name="comparison",
        title="Three derivations",
        shows=(
            "At random and extreme states the C agrees with the literal equations (1)-(12) of the paper in NumPy, and "
            "where a figure stands as second, with a derivation that knows only energies, by CasADi. Bad inputs are "
            "refused, outputs untouched; the interpreter has the same bits; the stand file is read a second time."
        ),
        limits=(
            "States between the sampled ones; (13); an error of the paper's in a quantity that energies do not give; "
            "a machine that bends, leaks or slips. Errors are relative to how much an answer moves with its inputs."
        ),
        command=lambda s: (
            f"mahovik verify {s.file} --against c --states {2000 if s.full else 200} --junit junit.xml --all"
        ),
        kept=("junit.xml", "*-worst.jsonl"),
        needs=lambda _: (program("gcc"), *map(module, ("numpy", "casadi", "sympy"))),
    ),
    Piece(
        name="rounding",
        title="Rounding, bounded",
        shows="Ball arithmetic encloses the exact answer at each state: the error of the C is known, not estimated.",
        limits="States that were not sampled: it is a measurement with a rigorous ruler, not a bound for all inputs.",
        command=lambda s: f"mahovik verify {s.file} --rigorous --states {300 if s.full else 60} --against c",
        needs=lambda _: (program("gcc"), module("flint", "python-flint", "rigorous")),
    ),
    Piece(
        name="judges",
        title="Programs of others",
        shows="Pinocchio and MuJoCo, strangers to this project, have the same motion, torques and joint forces.",
        limits="Suspension, legs, fluid and stream, which they do not have: the stand is judged without.",
        command=lambda s: f"mahovik verify {s.file} --judges --states {200 if s.full else 50}",
        idle=_without_judges,
        needs=lambda _: (program("gcc"), module("pinocchio", "pin", "judges"), module("mujoco", "mujoco", "judges")),
    ),
    Piece(
        name="warnings",
        title="Compilers and an analyser are silent",
        shows="gcc and clang with strict warnings as errors, and clang's static analyser, have no complaint.",
        limits="What no warning is made for. Other compilers warn of other things.",
        command=_compile_strictly,
        needs=lambda _: (program("gcc"), program("clang")),
    ),
    Piece(
        name="misra",
        title="cppcheck and its MISRA C:2012 addon",
        shows="Everything that they find is listed, with the reason why it stays; one that is not listed is a failure.",
        limits="MISRA compliance, which is not claimed: the addon checks a part of the rules, some not to the letter.",
        command=lambda s: f"cd c && {shlex.join(CPPCHECK)} {' '.join(s.sources)}",
        run=_check_misra,
        needs=lambda _: (program("cppcheck"),),
    ),
    Piece(
        name="eva",
        title="No undefined behaviour, by Frama-C Eva",
        shows=(
            "For whole sets of inputs, no index out of an array, no read before a write, no overflow of integers. In "
            "`normal` and `any` also: results are finite, written where the status is not negative, else untouched."
        ),
        limits=(
            f"{_UNCLAIMED}, of which nothing is claimed; tables of other parameters; without `--full` all but a few "
            "drivers; sine, cosine, square root and arc tangent, which stand as contracts."
        ),
        command=_eva_command,
        kept=("*.log",),
        needs=lambda _: (program("frama-c", "frama-c-base"),),
    ),
    Piece(
        name="fuzz",
        title="Arbitrary arguments",
        shows=(
            "Called with arbitrary bytes, NaN and null pointers under sanitizers, every public function gives a status "
            "that the header names, writes nothing on a refusal, else finite results, and the same bits twice."
        ),
        limits="Inputs that were not tried: it looks for counter-examples for some time, and proves nothing.",
        command=lambda s: (
            f"mahovik export fuzz {s.file} -o fuzz --real {s.real} && make -C fuzz run SECONDS={s.seconds}"
        ),
        figure=r"^Done (\d+ runs in \d+ second\S*)",
        kept=("fuzz/crash-*", "fuzz/leak-*", "fuzz/timeout-*", "fuzz/oom-*"),
        needs=lambda _: (
            program("clang"),
            Need("clang's runtime", "apt-get install libclang-rt-14-dev", _fuzzer_links),
        ),
    ),
    Piece(
        name="targets",
        title="The same bits on processors",
        shows="The self-test and a sweep give on each of these, on emulators, the bits that they give on the host.",
        limits="Real silicon: run the self-test on the board, and judge its log by `mahovik judge-log`.",
        command=lambda s: f"mahovik verify {s.file} --targets {_targets(s)} --against c",
        needs=lambda s: _target_tools(_targets(s), s.real),
    ),
    Piece(
        name="cost",
        title="Instructions, stack, code",
        shows="What a call costs at ordinary states, counted on emulators; the stack over the graph of calls.",
        limits="Time: instructions are not cycles. The worst case of all inputs, which branches may exceed.",
        command=lambda s: f"mahovik cost {s.file} -o c --targets {_COST_TARGETS[s.real]} --real {s.real}",
        figure=r"\A[\s\S]*?^\| `forward` \| ([\d,]+) \|",
        words="forward {} instructions",
        needs=lambda s: _target_tools(_COST_TARGETS[s.real], s.real),
    ),
)
"""Each can be named by `--only` and `--without`."""
