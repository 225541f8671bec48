"""The evidence for the C of one stand in one folder: every check run, its output kept, and a page, sealed by sums.

A piece of evidence is a command, run in a copy of the folder as a reader repeats it.
"""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from html import escape
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from markupsafe import Markup

import mahovik
from mahovik import __version__
from mahovik.contract.functions import ROWS
from mahovik.core.emit.delivered import deliver, provenance
from mahovik.core.emit.delivery import delivery
from mahovik.core.emit.eva import drivers
from mahovik.core.emit.generate import describe_bodies, generate_all
from mahovik.core.emit.manifest import digest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.templates import template
from mahovik.core.stand.files import content
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.core.toolchain.checks import ANALYSER, CPPCHECK, DEVIATIONS, STANDING_FINDINGS, WARNINGS
from mahovik.core.toolchain.compiler import BITS
from mahovik.core.toolchain.targets import version
from mahovik.errors import UsageError
from mahovik.nearest import names_in, suggestion
from mahovik.proof.verify.selftest import parse_targets
from mahovik.writing import write, write_folder

RECORD, SUMS = "evidence.json", "SHA256SUMS"
"""The summary as JSON; hashes of all other files, in the form that `sha256sum -c` reads."""

FORMAT = 1
"""Version of `RECORD`, raised when the meaning of a key changes."""

LARGEST = 256 << 20
"""Largest file that is checked, bytes."""


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
    """

    stand: Stand
    real: str
    folder: Path
    scratch: Path
    full: bool = False

    @property
    def file(self) -> str:
        """Name of the copy of the stand file."""
        return f"{self.stand.name}.toml"

    @property
    def selftest(self) -> str:
        """The self-test in `c/`."""
        return f"{VERIFICATION}{self.stand.name}_selftest.c"


DISTRIBUTIONS = {"numpy": "numpy", "casadi": "casadi", "sympy": "sympy", "flint": "python-flint", "pinocchio": "pin",
                 "mujoco": "mujoco"}  # fmt: skip
"""Python modules among the tools, and the distributions that have them; other tools are programs on the path."""

RUNTIME = "clang's runtime"
"""The tool without which what clang instruments does not link."""

INSTALL = {
    "gcov": "apt-get install gcc",
    "frama-c": "apt-get install frama-c-base",
    RUNTIME: "apt-get install libclang-rt-14-dev",
    **dict.fromkeys(("numpy", "casadi", "sympy"), "pip install mahovik"),
    "flint": "pip install 'mahovik[rigorous]'",
    **dict.fromkeys(("pinocchio", "mujoco"), "pip install 'mahovik[judges]'"),
}
"""Commands that install tools; a program that is not here has the package of its name."""


def is_there(tool: str) -> bool:
    """Whether a tool is here."""
    if tool == RUNTIME:
        done = subprocess.run(["clang", "-print-runtime-dir"], capture_output=True, text=True, check=False)
        return any(Path(done.stdout.strip()).glob("libclang_rt.fuzzer*.a"))
    return shutil.which(tool) is not None if tool not in DISTRIBUTIONS else find_spec(tool) is not None


def version_of(tool: str) -> str:
    """A tool that is here, with its version; "" of one that is a part of another."""
    package = DISTRIBUTIONS.get(tool, "")
    return "" if tool == RUNTIME else f"{package} {metadata.version(package)}" if package else version(tool)


def tools_of(piece: Piece, subject: Subject) -> dict[str, str]:
    """Tools that a piece needs, those of the targets of its command included, and what installs each."""
    tools = {tool: INSTALL.get(tool, f"apt-get install {tool}") for tool in piece.needs}
    for names in re.findall(r"--targets (\S+)", piece.command(subject)):
        for target, _ in parse_targets(names, (subject.real,)):
            for tool in (target.compiler[0], target.link[0], *target.emulator[:1]):
                tools.setdefault(tool, f"apt-get install {' '.join(target.packages) or tool}")
    return tools


@dataclass(frozen=True)
class Piece:
    """One piece.

    shows    what a reader may conclude where it has passed
    limits   what it does not show
    command  for the shell, in a copy of the folder; its exit status is the verdict
    needs    tools it cannot do without, besides those of targets
    figure   what of the printed words is the result for the summary: a pattern with a group; else the last line
    words    around that figure
    kept     files that the command writes, patterns
    idle     why there is nothing to judge of a subject; "" where there is
    notes    sentences for its section
    """

    name: str
    title: str
    shows: str
    limits: str
    command: Callable[[Subject], str]
    needs: tuple[str, ...] = ()
    figure: str = r"^ *(?:passed: |FAILED: |error: |(?=nothing|FAILED))(.*)"
    words: str = "{}"
    kept: tuple[str, ...] = ()
    idle: Callable[[Subject], str] = lambda _: ""
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Outcome:
    """How a piece came out.

    figure   result for the summary, one line
    command  that repeats it
    notes    sentences for its section: what is missing, what was found
    files    what is kept, content by name
    tools    what did it, with versions
    """

    piece: Piece
    verdict: Verdict
    figure: str
    command: str = ""
    notes: tuple[str, ...] = ()
    files: Mapping[str, bytes] = field(default_factory=dict)
    tools: tuple[str, ...] = ()


# -- the pieces --------------------------------------------------------------------------------------------------------


def _run_selftest(subject: Subject) -> str:
    name = subject.stand.name
    build = (
        f"cc -std=c99 -O2 -ffp-contract=off -D{name.upper()}_SELFTEST_MAIN c/{name}.c c/{subject.selftest} -o selftest"
    )
    return f"{build} && ./selftest > selftest.log; mahovik verify {subject.file} selftest.log"


FUZZ_SECONDS = (20, 600)
"""s of fuzzing: quick, full."""

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
    files = f"{subject.stand.name}.c {subject.selftest}"
    both = " && ".join(f"{compiler} {shlex.join(WARNINGS)} -O2 -fsyntax-only {files}" for compiler in ("gcc", "clang"))
    return f"cd c && {both} && {shlex.join(ANALYSER)} {files} && echo {len(files.split())} files, no complaint"


def _check_misra(subject: Subject) -> str:
    """Fails by a finding under a rule that has no reason; these are printed."""
    rules = "|".join(re.escape(rule) for rule in (*DEVIATIONS, *STANDING_FINDINGS))
    unlisted = f"grep -Ev '^(misra-c2012-)?({rules}):' ../findings.txt"
    figure = 'echo "$(wc -l <../findings.txt) findings, each under a rule with a reason"'
    return f"cd c && {shlex.join(CPPCHECK)} {subject.stand.name}.c 2>../findings.txt && ! {unlisted} && {figure}"


_QUICK_DRIVERS = ("any_forward", "any_torque", "normal_prepare", "routine_sqrt")
_UNCLAIMED = ", ".join(f"`{row.name}`" for row in ROWS.values() if not row.claimed)


def _eva_command(subject: Subject) -> str:
    every = drivers(generate_all(subject.stand, subject.real, ()).program)
    claimed = [f"{driver.set}_{driver.function}" for driver in every if driver.claimed]
    chosen = "" if subject.full else "".join(f" {name}" for name in claimed if name in _QUICK_DRIVERS)
    limit = 1800 if subject.full else 300  # s a driver may take
    script = f"c/{VERIFICATION}{subject.stand.name}_eva.sh{chosen}"
    return f'EVA_LIMIT={limit} EVA_LOGS=$PWD sh {script} && echo "no alarm in $(ls *.log | wc -l) drivers"'


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
        limits="That equations are right: it compares the C with its own program. `mahovik verify` judges boards.",
        command=_run_selftest,
        figure=r"\A(?:PASS)?\s*(.*)",
        kept=("selftest.log",),
        needs=("gcc",),
    ),
    Piece(
        name="branches",
        title="Branches that the self-test takes",
        shows=f"The self-test takes {LEAST_BRANCHES} % or more of the ways out of conditions; a file counts each line.",
        limits="That the answers are right: the self-test compares them with the interpreter; other pieces judge them.",
        command=_branches_command,
        figure=r"^Taken at least once:(.*)",
        kept=("*.c.gcov",),
        needs=("gcc", "gcov"),
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
            f"mahovik verify {s.file} c --states {2000 if s.full else 200} --junit junit.xml --worst worst.jsonl --all"
        ),
        kept=("junit.xml", "worst.jsonl"),
        needs=("gcc", "numpy", "casadi", "sympy"),
    ),
    Piece(
        name="rounding",
        title="Rounding, bounded",
        shows="Ball arithmetic encloses the exact answer at each state: the error of the C is known, not estimated.",
        limits="States that were not sampled: it is a measurement with a rigorous ruler, not a bound for all inputs.",
        command=lambda s: f"mahovik verify {s.file} c --rigorous --states {300 if s.full else 60}",
        needs=("gcc", "flint"),
    ),
    Piece(
        name="judges",
        title="Programs of others",
        shows="Pinocchio and MuJoCo, strangers to this project, have the same motion, torques and joint forces.",
        limits="Suspension, legs, fluid and stream, which they do not have: the stand is judged without.",
        command=lambda s: f"mahovik verify {s.file} --judges --states {200 if s.full else 50}",
        idle=_without_judges,
        needs=("gcc", "pinocchio", "mujoco"),
    ),
    Piece(
        name="warnings",
        title="Compilers and an analyser are silent",
        shows="gcc and clang with strict warnings as errors, and clang's static analyser, have no complaint.",
        limits="What no warning is made for. Other compilers warn of other things.",
        command=_compile_strictly,
        needs=("gcc", "clang"),
    ),
    Piece(
        name="misra",
        title="cppcheck and its MISRA C:2012 addon",
        shows="Everything that they find is listed, with the reason why it stays; one that is not listed is a failure.",
        limits="MISRA compliance, which is not claimed: the addon checks a part of the rules, some not to the letter.",
        command=_check_misra,
        kept=("findings.txt",),
        notes=tuple(f"{rule}: {why}" for rule, why in {**DEVIATIONS, **STANDING_FINDINGS}.items()),
        needs=("cppcheck",),
    ),
    Piece(
        name="eva",
        title="No undefined behaviour, by Frama-C Eva",
        shows=(
            "For whole sets of inputs, no index out of an array, no read before a write, no overflow of integers. In "
            "`normal` and `any` also: results are finite, written where the status is not negative, else untouched."
        ),
        limits=(
            f"{_UNCLAIMED}, of which nothing is claimed; tables of other parameters; of a quick collection all but a "
            "few drivers; sine, cosine, square root and arc tangent, which stand as contracts."
        ),
        command=_eva_command,
        kept=("*.log",),
        needs=("frama-c",),
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
            f"mahovik generate {s.file} --project fuzz -o fuzz --real {s.real} && "
            f"make -C fuzz run SECONDS={FUZZ_SECONDS[s.full]}"
        ),
        figure=r"^Done (\d+ runs in \d+ second\S*)",
        kept=("fuzz/crash-*", "fuzz/leak-*", "fuzz/timeout-*", "fuzz/oom-*"),
        needs=("clang", RUNTIME),
    ),
    Piece(
        name="targets",
        title="The same bits on processors",
        shows="The self-test and a sweep give on each of these, on emulators, the bits that they give on the host.",
        limits="Real silicon: run the self-test on the board, and judge its log by `mahovik verify`.",
        command=lambda s: f"mahovik verify {s.file} c --targets {_targets(s)}",
    ),
    Piece(
        name="cost",
        title="Instructions, stack, code",
        shows="What a call costs at ordinary states, counted on emulators; the stack over the graph of calls.",
        limits="Time: instructions are not cycles. The worst case of all inputs, which branches may exceed.",
        command=lambda s: f"mahovik verify {s.file} c --cost --targets {_COST_TARGETS[s.real]} --real {s.real}",
        figure=r"\A[\s\S]*?^\| `forward` \| ([\d,]+) \|",
        words="forward {} instructions",
    ),
)
"""In the order in which they are run and shown; each can be named by `--only`."""


# -- running them, and the folder --------------------------------------------------------------------------------------

Say = Callable[[str, str], None]
"""Progress: name of the running piece, and what it does; "" when it is done."""


def select_pieces(pieces: Sequence[Piece], only: str | None) -> frozenset[str]:
    """Names of the pieces to run: all, or those between the commas of `only`. Raises UsageError for an unknown name."""
    known = [piece.name for piece in pieces]
    wanted = known if only is None else names_in("only", only)
    for name in wanted:
        if name not in known:
            raise UsageError(f'only: unknown "{name}"{suggestion(name, known)}')
    return frozenset(wanted)


def collect(
    stand: Stand,
    text: bytes,
    folder: Path,
    pieces: Sequence[Piece],
    real: str = "double",
    *,
    full: bool = False,
    wanted: Collection[str] | None = None,
    say: Say = lambda name, what: None,
) -> list[Outcome]:
    """Collects the evidence of a stand, whose file has the content `text`, into a folder; `real` of its C.

    Raises UsageError if the folder holds other files, before anything is run.
    """
    results: list[Outcome] = []

    def fill(draft: Path) -> None:
        subject = Subject(stand, real, draft, Path(scratch), full)
        files = delivery(stand, real, (), ("selftest", "eva"))  # which the pieces run
        deliver(draft / "c", stand, files, made_by=provenance(text))
        write(draft / subject.file, text)
        for piece in pieces:
            if wanted is not None and piece.name not in wanted:
                results.append(Outcome(piece, Verdict.LEFT_OUT, "not run", piece.command(subject)))
                continue
            say(piece.name, "runs")
            results.append(_run(piece, subject))
            say(piece.name, "")
        for outcome in results:
            for name, kept in outcome.files.items():
                write(draft / "raw" / outcome.piece.name / name, kept)
        record = _record(subject, results)
        write(draft / "index.html", _page(subject, results, record))
        seal(draft, record)

    _require_place(folder, stand)
    with tempfile.TemporaryDirectory(prefix="mahovik-") as scratch:
        write_folder(folder, fill)
    return results


def _run(piece: Piece, subject: Subject) -> Outcome:
    """Run a piece, unless there is nothing to judge or a tool is missing, in a copy of the folder; keep its output."""
    command = piece.command(subject)
    if reason := piece.idle(subject):
        return Outcome(piece, Verdict.NOTHING, reason, command)
    needs = tools_of(piece, subject)
    if absent := [tool for tool in needs if not is_there(tool)]:
        notes = tuple(f"To install: `{install}`" for install in dict.fromkeys(needs[tool] for tool in absent))
        return Outcome(piece, Verdict.MISSING, f"no {', '.join(absent)}", command, notes)
    place, programs = subject.scratch / piece.name, subject.scratch / "bin"
    shutil.copytree(subject.folder, place)
    programs.mkdir(exist_ok=True)
    write(programs / "mahovik", f'#!/bin/sh\nexec "{sys.executable}" -m mahovik "$@"\n')
    (programs / "mahovik").chmod(0o755)
    package = str(Path(mahovik.__file__).resolve().parent.parent)
    more = {
        "PYTHONPATH": os.pathsep.join(filter(None, (package, os.environ.get("PYTHONPATH")))),
        "PYTHONHASHSEED": "20260",  # another seed of hashes: an order that depends on it would show
        "PATH": f"{programs}{os.pathsep}{os.environ.get('PATH', '')}",
    }
    text: Any = {"encoding": "utf-8", "errors": "surrogateescape"}
    done = subprocess.run(
        ["sh", "-c", command], cwd=place, env=os.environ | more, capture_output=True, check=False, **text
    )
    printed, errors = (_without_paths(printout, subject) for printout in (done.stdout + done.stderr, done.stderr))
    files = {path.name: path.read_text(**text) for pattern in piece.kept for path in sorted(place.glob(pattern))}
    kept = {name: _without_paths(printout, subject).encode(**text) for name, printout in files.items()}
    lines = [line.strip() for line in printed.splitlines() if line.strip()]
    figures = [piece.words.format(said) for said in re.findall(piece.figure, printed, re.MULTILINE)]
    figure, notes, verdict = (figures or lines or [""])[-1], piece.notes, Verdict.PASSED
    if done.returncode != 0:
        verdict, notes = Verdict.FAILED, (*notes, *errors.splitlines()[-5:])
    elif figure.startswith("nothing was compared"):
        verdict = Verdict.NOTHING
    tools = tuple(dict.fromkeys(filter(None, map(version_of, needs))))
    return Outcome(piece, verdict, figure, command, notes, {"output.txt": printed.encode(**text), **kept}, tools)


def _without_paths(text: str, subject: Subject) -> str:
    """A text without names of temporary folders, which differ from machine to machine."""
    for place in (subject.folder, subject.scratch):
        for name in (str(place.resolve()), str(place)):
            text = text.replace(f"{name}/", "").replace(name, ".")
    return text


def conclusion(results: Sequence[Outcome]) -> str:
    """The verdict over all, in one line."""
    names = {verdict: [x.piece.name for x in results if x.verdict is verdict] for verdict in Verdict}
    passed = len(names.pop(Verdict.PASSED))
    ran = passed + len(names[Verdict.FAILED])
    words = [f"{passed} of {ran} pieces passed" if ran else "no piece was run"]
    return "; ".join([*words, *(f"{verdict.value}: {', '.join(of)}" for verdict, of in names.items() if of)])


def failures(results: Sequence[Outcome], strict: bool = False) -> list[str]:
    """Names of pieces that failed; `strict`: of those without their tools as well."""
    bad = {Verdict.FAILED, *((Verdict.MISSING,) if strict else ())}
    return [outcome.piece.name for outcome in results if outcome.verdict in bad]


def as_dicts(results: Sequence[Outcome]) -> list[dict[str, Any]]:
    """What JSON has of each piece."""
    return [
        {
            "name": outcome.piece.name,
            "verdict": outcome.verdict.value,
            "figure": outcome.figure,
            "command": outcome.command,
            "tools": list(outcome.tools),
            "files": [f"raw/{outcome.piece.name}/{name}" for name in outcome.files],
        }
        for outcome in results
    ]


def _record(subject: Subject, results: Sequence[Outcome]) -> dict[str, Any]:
    """The summary for JSON."""
    names = identities(subject.stand)
    return {
        "format": FORMAT,
        "generator": f"mahovik {__version__}",
        "stand": subject.stand.name,
        "structure": names.structure,
        "physics": names.physics,
        "real": subject.real,
        "extent": "full" if subject.full else "quick",
        "pieces": as_dicts(results),
    }


def _page(subject: Subject, results: Sequence[Outcome], record: Mapping[str, Any]) -> str:
    """The page: a table, then a section for each piece; no script, nothing is loaded."""
    styles = dict.fromkeys(Verdict, "open") | {Verdict.PASSED: "good", Verdict.FAILED: "bad"}
    counts = Counter(styles[outcome.verdict] for outcome in results)

    def command(text: str) -> Markup:
        """Words are not broken at their hyphens."""
        return Markup(" ").join(Markup(f"<span>{escape(word)}</span>") for word in text.split(" "))

    def paragraph(text: str) -> Markup:
        """Code between backticks."""
        parts = enumerate(re.split(r"`([^`]*)`", text))
        return Markup("").join(Markup(f"<code>{escape(p)}</code>" if i % 2 else escape(p)) for i, p in parts)

    return template("evidence.html.j2").render(
        record=record,
        bodies=describe_bodies(subject.stand),
        stand_file=subject.file,
        conclusion=conclusion(results),
        style="bad" if counts["bad"] else "open" if counts["open"] else "good",
        styles=styles,
        results=results,
        text=paragraph,
        command=command,
    )


def seal(folder: Path, record: Mapping[str, Any]) -> None:
    """Writes the summary, and the sums of all files."""
    write(folder / RECORD, json.dumps(record, indent=1) + "\n")
    write(folder / SUMS, "".join(f"{hash_}  {name}\n" for name, hash_ in _sums(folder).items()))


def check(folder: Path) -> list[str]:
    """Differences from the sums, a line each. Raises UsageError if there are no sums."""
    path = folder / SUMS
    if not path.is_file():
        raise UsageError(f"{path}: no such file: is {folder} a folder of `mahovik evidence`?")
    lines = content(path).decode("utf-8", "replace").splitlines()
    listed, there = {name: hash_ for hash_, _, name in (line.partition("  ") for line in lines)}, _sums(folder)
    missing = [f"{folder / name}: is missing" for name in listed if name not in there]
    changed = [f"{folder / name}: was changed" for name in listed if there.get(name, listed[name]) != listed[name]]
    return [*missing, *changed, *(f"{folder / name}: is not listed" for name in there if name not in listed)]


def _require_place(folder: Path, stand: Stand) -> None:
    """Raise UsageError unless the place is empty or holds unchanged evidence of the stand."""
    if not os.path.lexists(folder):
        return
    if folder.is_symlink() or not folder.is_dir():
        raise UsageError(f"{folder}: is no folder: choose another place, nothing was written")
    if not any(folder.iterdir()):
        return
    try:
        record = json.loads(content(folder / RECORD))
        name = record["stand"] if record["format"] == FORMAT else None
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        name = None
    if name is None:
        raise UsageError(f"{folder}: is not a folder of `mahovik evidence`: choose another, nothing was written")
    if name != stand.name:
        raise UsageError(f'{folder}: holds evidence of stand "{name}": choose another folder, nothing was written')
    if problems := check(folder):
        raise UsageError(f"{problems[0]}: move it away or choose another folder, nothing was written")


def _sums(folder: Path) -> dict[str, str]:
    """SHA-256 of every file but the sums, by its path in the folder."""
    files = sorted(path for path in folder.rglob("*") if not path.is_dir() or path.is_symlink())
    # a link is not what was written, wherever it leads
    hashes = {path: "a link" if path.is_symlink() else digest(content(path, LARGEST)) for path in files}
    names = {path.relative_to(folder).as_posix(): hash_ for path, hash_ in hashes.items()}
    return {name: hash_ for name, hash_ in names.items() if name != SUMS}
