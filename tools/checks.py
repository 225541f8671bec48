"""Run other programs on a delivered folder: compilers, analyser, cppcheck with MISRA C:2012, Frama-C Eva, libFuzzer."""

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
from mahovik.core.toolchain.checks import ANALYSER, CPPCHECK, DEVIATIONS, FLAGS, LIMITS, STANDING_FINDINGS, WARNINGS
from mahovik.errors import CheckError, ToolchainError

COMPILERS = ("gcc", "clang")


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

_COUNTED = re.compile(r"^stat::number_of_executed_units:\s*(\d+)", re.MULTILINE)
_DONE = re.compile(r"^#\d+\s+(?:DONE|INITED)\s+cov: (\d+) ft: (\d+) corp: (\d+)", re.MULTILINE)


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
