"""Static checks of a delivered folder: warnings of two compilers, an analyser, cppcheck with its MISRA C:2012 addon.

cppcheck reads the C once as it is delivered: a folder has one element type, so there is nothing to configure. The
script of `--with eva` is run here too: Frama-C's proofs.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from mahovik.core.toolchain import process
from mahovik.errors import ToolchainError

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
