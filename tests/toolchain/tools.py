"""Tools that a test may need: absent, the test is skipped with the Debian package that has it; in CI it fails."""

import os
import re
import shutil
import subprocess
from functools import cache
from pathlib import Path
from typing import NoReturn

import pytest

from mahovik.core.toolchain.targets import TARGETS, Target

FIRMWARE_WARNINGS = (
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
    "-Wstrict-prototypes",
    "-Wmissing-prototypes",
    "-Werror",
)
"""What strict firmware projects compile with."""

SSE = ("-m32", "-msse2", "-mfpmath=sse")
"""Flags of gcc and clang for 32-bit x86 with numbers as IEEE 754 has them: x87 is refused."""

EMBEDDED = ("m3", "m4", "m7", "m33", "m55", "rv32imac", "rv32imafc", "rv32gc", "rv64imac", "rv64gc")
"""Targets that are boards."""

QUICK = ("host", "m4", "m7", "rv64gc")
"""A few targets: this computer and a board of each kind."""


def require(tool: str, package: str) -> str:
    """Path of a tool; without it the test is skipped, in CI it fails: there nothing is left out."""
    path = shutil.which(tool)
    if path is None:
        _absent(f"no {tool}: apt-get install {package}")
    return path


def target(name: str) -> Target:
    """The target, with all that it needs."""
    chosen = TARGETS[name]
    for command in (chosen.compiler[0], chosen.link[0], *chosen.emulator[:1]):
        require(command, " ".join(chosen.packages))
    return chosen


def require_32_bit() -> str:
    """gcc that builds for 32 bits; else as `require`."""
    gcc = require("gcc", "gcc")
    if not _builds_32_bit():
        _absent("gcc -m32 has no 32-bit headers: apt-get install gcc-multilib")
    return gcc


def compile_c(compiler: str, source: Path, *flags: str | Path) -> None:
    """Runs a compiler on one file with the strict warnings; asserts that it has no complaint."""
    run(compiler, *FIRMWARE_WARNINGS, "-ffp-contract=off", *flags, source)


def compile_elsewhere(source: Path) -> None:
    """Compiles a file by clang and for 32 bits; asserts that neither complains. Writes nothing."""
    compile_c(require("clang", "clang"), source, "-fsyntax-only")
    compile_c(require_32_bit(), source, *SSE, "-fsyntax-only")


def symbols_of(source: Path, folder: Path) -> list[tuple[str, str]]:
    """Kind, as `nm` has it, and name in C of each symbol of the object that gcc makes of a file at -O2."""
    thing = folder / f"{source.stem}.o"
    compile_c(require("gcc", "gcc"), source, "-O2", "-c", "-o", thing)
    listed = re.sub(r"_f(32|64)_[0-9a-f]{8}$", "", run(require("nm", "binutils"), thing), flags=re.MULTILINE)
    return [(kind, symbol) for kind, symbol in (line.split()[-2:] for line in listed.splitlines())]


def run(*command: str | Path) -> str:
    """Runs a command that must succeed in silence, and returns what it printed."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{' '.join(str(c) for c in command)}\n{done.stderr}"
    assert done.stderr == ""
    return done.stdout


@cache
def _builds_32_bit() -> bool:
    command = ["gcc", "-m32", "-fsyntax-only", "-x", "c", "-"]
    text = "#include <stdint.h>\n#include <sys/types.h>\nuint64_t x;\n"
    return subprocess.run(command, input=text, text=True, capture_output=True, check=False).returncode == 0


def _absent(message: str) -> NoReturn:
    if os.environ.get("CI"):
        pytest.fail(message)
    pytest.skip(message)
