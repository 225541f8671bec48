"""Checks of a delivered folder by other programs: compilers, an analyser, cppcheck with MISRA C:2012; Eva; libFuzzer.

cppcheck reads the C once as it is delivered: a folder has one element type, so there is nothing to configure.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from mahovik.core.emit.fuzz import fuzz_harness
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.manifest import with_manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.recorder import recorder_files
from mahovik.core.emit.templates import template
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.core.toolchain import process
from mahovik.core.toolchain.compiler import BITS
from mahovik.errors import CheckError, ToolchainError

WARNINGS = (
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wdouble-promotion",
    "-Wshadow",
    "-Wundef",
    "-Wcast-qual",
    "-Wfloat-equal",
    "-Werror",
)
"""Options of both compilers: a warning is an error."""

COMPILERS = ("gcc", "clang")

ANALYSER = ("clang", "-std=c99", "--analyze", "--analyzer-output", "text", "-Xclang", "-analyzer-werror")

CPPCHECK = (
    "cppcheck",
    "-q",
    "--addon=misra",
    "--enable=warning,portability,performance,style",
    # it reads no headers of the C library; without any -D it leaves out, without a word, a file that ends in #error
    *(f"-D{macro}" for macro in ("FLT_RADIX=2", "FLT_EVAL_METHOD=0", "FLT_MANT_DIG=24", "DBL_MANT_DIG=53")),
    "-DINT_MAX=2147483647",
    "--inconclusive",
    "--std=c99",
    "--suppress=missingIncludeSystem",
    "--template={id}:{file}:{line}",
)

DEVIATIONS = {
    "2.3": "a type whose only use is that it does not compile with a header of another element type",
    "2.4": "tags of structs and enums that are used by their typedef alone",
    "8.7": "functions of the header that no other file of the folder calls: they are the interface",
    "8.9": "tables that one function of the recorder reads stand at the top of its file",
    "8.14": "`restrict`: results of internal functions overlap no argument, and the compiler may know",
    "9.3": "a struct that begins as a copy of another, which the addon takes for a part of a list",
    "10.1": "a bit is chosen between by `?:`, an unsigned constant shifted by an int",
    "10.3": "the outcome of a comparison is kept as an int, 0 or 1, and chooses between reals",
    "10.4": "statuses are or-ed as bits, an int beside an enumerator; a size beside the constant 0",
    "10.6": "a constant of 32 bits chosen into a word of 64",
    "10.8": "a difference of ints, in 0 to 30, as the width of a shift",
    "12.1": "precedence of * over +, of comparison over &&: formulas as the model writes them, without more brackets",
    "12.3": "two variables in one declaration, sine and cosine of one phase; and declarations that the addon takes for "
    "the comma operator",
    "13.3": "an index that is used and moved on",
    "14.4": "a bit of a mask as a condition",
    "15.5": "a function returns where a check fails, before anything is written",
    "17.8": "an argument passed by value is shifted out byte by byte; zeros take the place of a null array",
    "19.2": "a union reads the bits of a real; defined in C99 (6.5.2.3, footnote 82)",
}
"""Rules of MISRA C:2012 that the emitted C does not keep, as the addon counts them, with the reason."""

STANDING_FINDINGS = {
    "incorrectLogicOperator": "`a > 0` or `a <= 0` is false of NaN, and that is what is asked",
    "oppositeExpression": "the same line",
    "variableScope": "a local array that stands before the branch which alone reads it",
}
"""Findings of cppcheck itself that stay, with the reason."""


@dataclass(frozen=True)
class Finding:
    """Where a check complains: the rule without `misra-c2012-`, or cppcheck's name of it."""

    rule: str
    file: str
    line: int

    @property
    def is_accepted(self) -> bool:
        return self.rule in DEVIATIONS or self.rule in STANDING_FINDINGS


def require(tool: str, package: str = "") -> None:
    """Raises ToolchainError where a tool is missing; `package`: of Debian, where its name is another one."""
    if shutil.which(tool) is None:
        raise ToolchainError(f"no {tool}: install it, on Debian with `apt-get install {package or tool}`")


def version(tool: str) -> str:
    """`cppcheck 2.10`: name and number of a tool."""
    require(tool)
    done = process.run([tool, "--version"])
    match = re.search(r"\d+(\.\d+)+", done.stdout)
    return f"{tool} {match[0] if match else 'of unknown version'}"


def warnings_of(folder: Path, files: Sequence[str]) -> list[str]:
    """Complaints of compilers and analyser, one per line; empty if there are none."""
    complaints = []
    commands = [(compiler, *WARNINGS, "-O2", "-c", "-o", "/dev/null") for compiler in COMPILERS]
    for command in [*commands, ANALYSER]:
        require(command[0])
        for file in files:
            done = process.run([*command, file], folder)
            said = [line for line in done.stderr.splitlines() if "warning:" in line or "error:" in line]
            if done.returncode != 0 and not said:
                said = [f"{file}: status {done.returncode}"]
            complaints += [f"{command[0]}{' --analyze' if command is ANALYSER else ''}: {line}" for line in said]
    return complaints


def findings(folder: Path, files: Sequence[str]) -> list[Finding]:
    """Findings of cppcheck and its addon. Raises ToolchainError where it cannot run."""
    require("cppcheck")
    done = process.run([*CPPCHECK, *files], folder)
    if done.returncode != 0:
        raise ToolchainError(f"cppcheck ended with status {done.returncode}: {(done.stdout + done.stderr).strip()}")
    return [_finding(line) for line in done.stderr.splitlines() if line.strip()]


def _finding(line: str) -> Finding:
    parts = line.rsplit(":", 2)
    if len(parts) != 3 or not parts[2].isdigit():
        raise ToolchainError(f"cppcheck printed {line!r}, expected `rule:file:line`")
    return Finding(parts[0].removeprefix("misra-c2012-"), parts[1], int(parts[2]))


def count_by_rule(by_rule: Iterable[Finding]) -> Counter[str]:
    """Number of breaches of each rule."""
    return Counter(breach.rule for breach in by_rule)


# -- Frama-C Eva ------------------------------------------------------------------------------------------------------

_LINE = re.compile(
    r"(?P<set>[a-z]+)_(?P<function>\w+) alarms (?P<alarms>\d+|failed) unproved (?P<bad>\d+) seconds (?P<s>\d+)"
)


@dataclass(frozen=True)
class Proof:
    """One driver's outcome. `alarms`: operations not shown to be defined, None where the analysis did not end or never
    came back from the function; `unproved`: properties of the results; `seconds` of wall clock."""

    function: str
    set: str
    alarms: int | None
    unproved: int
    seconds: int

    @property
    def holds(self) -> bool:
        return self.alarms == 0 and self.unproved == 0


def prove(script: Path, wanted: Sequence[str] = (), limit: int | None = None, logs: Path | None = None) -> list[Proof]:
    """Runs `<stand>_eva.sh` on drivers (default: all that is claimed); `limit`: seconds a driver.

    Raises ToolchainError where the script cannot run.
    """
    require("frama-c", "frama-c-base")
    environment = dict(os.environ)
    if limit is not None:
        environment["EVA_LIMIT"] = str(limit)
    if logs is not None:
        logs.mkdir(parents=True, exist_ok=True)
        environment["EVA_LOGS"] = str(logs.resolve())
    command = ["sh", script.name, *wanted]
    done = subprocess.run(command, cwd=script.parent, env=environment, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        raise ToolchainError(
            f"{script.name} ended with status {done.returncode}: {done.stderr.strip() or 'no message'}"
        )
    return [parse_proof(line) for line in done.stdout.splitlines()]


def parse_proof(line: str) -> Proof:
    """Proof reported by a line of the script. Raises ToolchainError for another line."""
    match = _LINE.fullmatch(line.strip())
    if match is None:
        raise ToolchainError(f"_eva.sh printed {line.strip()!r}, expected `SET_FUNCTION alarms N unproved N seconds N`")
    alarms = None if match["alarms"] == "failed" else int(match["alarms"])
    return Proof(match["function"], match["set"], alarms, int(match["bad"]), int(match["s"]))


# -- fuzzing by libFuzzer ----------------------------------------------------------------------------------------------

SANITIZERS = (
    "-fno-sanitize-recover=all",  # without it a fault is printed and the exit status is 0
    "-fsanitize=fuzzer,undefined,address,float-divide-by-zero",  # the last is not in `undefined`
    "-fno-sanitize-coverage=trace-cmp",  # a harness that draws from tables need not guess constants: half as fast again
)
FLAGS = ("-std=c99", "-g", "-O2", *BITS, "-Wall", "-Wextra", *SANITIZERS)
"""Compiler flags of a harness and what it calls."""

LIMITS = ("-len_control=0", "-max_len=1024", "-timeout=10", "-rss_limit_mb=0", "-malloc_limit_mb=64")
"""Options of a run: long inputs from the start; an input that takes seconds, or one large allocation, is a finding.

The limit of resident memory is off: libFuzzer reads the kernel's peak, which begins with the memory of the process that
started it, so that a large parent alone would be a finding.
"""

_COUNTED = re.compile(r"^stat::number_of_executed_units:\s*(\d+)", re.MULTILINE)
_DONE = re.compile(r"^#\d+\s+(?:DONE|INITED)\s+cov: (\d+) ft: (\d+) corp: (\d+)", re.MULTILINE)


def sources(name: str) -> tuple[str, ...]:
    """Files that are compiled and linked."""
    return (f"{name}.c", f"{VERIFICATION}{name}_recorder.c", f"{name}_fuzz.c")


def fuzz_project(stand: Stand, real: str) -> dict[str, str]:
    """The project's files, text by file name. Raises StandError, UsageError."""
    generated = generate_all(stand, real)
    name = stand.name
    words = {
        "name": name,
        "NAME": name.upper(),
        "real": real,
        "flags": shlex.join(FLAGS),
        "limits": shlex.join(LIMITS),
        "sources": " ".join(sources(name)),
    }
    files = {
        **generated.files,
        **recorder_files(stand, generated),
        f"{name}_fuzz.c": fuzz_harness(generated.program, identities(stand)),
        "Makefile": template("fuzz.mk.j2").render(**words),
    }
    return with_manifest(stand, generated, files, "fuzz")


@dataclass(frozen=True)
class FuzzRun:
    """What libFuzzer says of a run: inputs executed, edges and features reached, inputs kept."""

    executions: int
    edges: int
    features: int
    kept: int


def compile_harness(folder: Path, sources: Sequence[str], program: str = "fuzz") -> Path:
    """Compiles and links the sources of a folder with clang. Raises ToolchainError."""
    if shutil.which("clang") is None:
        raise ToolchainError("no clang: install clang and its runtime, on Debian with tools/fuzz-packages.sh")
    done = _run(["clang", *FLAGS, *sources, "-o", program], folder)
    if done.returncode != 0:
        hint = (
            "" if "libclang_rt" not in done.stderr else ": on Debian, tools/fuzz-packages.sh installs what is missing"
        )
        raise ToolchainError(f"clang cannot build the fuzz harness{hint}\n{done.stderr.strip()}")
    return folder / program


def fuzz(program: Path, corpus: Path, *, runs: int = 0, seconds: int = 0, seed: int = 1) -> FuzzRun:
    """Runs a harness on a corpus, which grows. Raises CheckError with what it found; the input is kept beside it."""
    corpus.mkdir(parents=True, exist_ok=True)
    bounds = [f"-runs={runs}"] if runs else []
    bounds += [f"-max_total_time={seconds}"] if seconds else []
    done = _run([str(program), *LIMITS, *bounds, f"-seed={seed}", "-print_final_stats=1", str(corpus)], program.parent)
    counted, last = _COUNTED.search(done.stderr), _DONE.findall(done.stderr)
    if done.returncode != 0 or counted is None or not last:
        raise CheckError(f"{program}: {_what_went_wrong(done.stderr)}")
    edges, features, kept = (int(word) for word in last[-1])
    return FuzzRun(int(counted[1]), edges, features, kept)


def minimise(program: Path, corpus: Path) -> None:
    """Leaves in a corpus only inputs that reach something no smaller one reaches. Raises CheckError."""
    smaller = corpus.with_name(f"{corpus.name}.smaller")
    shutil.rmtree(smaller, ignore_errors=True)
    smaller.mkdir()
    done = _run([str(program), *LIMITS, "-merge=1", str(smaller), str(corpus)], program.parent)
    if done.returncode != 0:
        raise CheckError(f"{program}: {_what_went_wrong(done.stderr)}")
    shutil.rmtree(corpus)
    smaller.rename(corpus)


def _what_went_wrong(text: str) -> str:
    """The lines that say what went wrong, and which input did it."""
    words = ("runtime error", "ERROR", "Test unit written", "refused", "same bits", "status", "finite", "Error")
    lines = [line for line in text.splitlines() if any(word in line for word in words) and not line.startswith("#")]
    return "\n".join(lines[:12]) or text[-500:]


def _run(command: Sequence[str], folder: Path) -> subprocess.CompletedProcess[str]:
    try:
        return process.run(command, folder)
    except OSError as error:
        raise ToolchainError(f"{command[0]}: cannot be run: {error.strerror or error}") from error
