"""Fuzzing a stand's C by libFuzzer: the project with its harness, how it is compiled and run, what a run says."""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
from collections.abc import Sequence
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
        raise CheckError(f"{program}: {_finding(done.stderr)}")
    edges, features, kept = (int(word) for word in last[-1])
    return FuzzRun(int(counted[1]), edges, features, kept)


def minimise(program: Path, corpus: Path) -> None:
    """Leaves in a corpus only inputs that reach something no smaller one reaches. Raises CheckError."""
    smaller = corpus.with_name(f"{corpus.name}.smaller")
    shutil.rmtree(smaller, ignore_errors=True)
    smaller.mkdir()
    done = _run([str(program), *LIMITS, "-merge=1", str(smaller), str(corpus)], program.parent)
    if done.returncode != 0:
        raise CheckError(f"{program}: {_finding(done.stderr)}")
    shutil.rmtree(corpus)
    smaller.rename(corpus)


def _finding(text: str) -> str:
    """The lines that say what went wrong, and which input did it."""
    words = ("runtime error", "ERROR", "Test unit written", "refused", "same bits", "status", "finite", "Error")
    lines = [line for line in text.splitlines() if any(word in line for word in words) and not line.startswith("#")]
    return "\n".join(lines[:12]) or text[-500:]


def _run(command: Sequence[str], folder: Path) -> subprocess.CompletedProcess[str]:
    try:
        return process.run(command, folder)
    except OSError as error:
        raise ToolchainError(f"{command[0]}: cannot be run: {error.strerror or error}") from error
