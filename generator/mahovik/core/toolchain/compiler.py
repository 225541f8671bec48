"""The host's C compiler: finding it, running it, and what it is."""

from __future__ import annotations

import os
import platform
import shlex
import shutil
import struct
import sys
import tempfile
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path

from mahovik.errors import NoCompilerError, ToolchainError

WARNINGS = ("-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror")
"""Every compile of emitted C uses these: a warning is an error."""

BITS = ("-ffp-contract=off",)
"""No fused multiply-add: the same bits on every processor."""

SHARED = ("-shared", "-fPIC")
"""Flags of a library that is loaded."""

CANDIDATES = ("cc", "gcc", "clang")


def find_compiler(named: str | None = None) -> list[str]:
    """The compiler's command: as named, else the environment's CC, else cc, gcc or clang. Raises ToolchainError.

    Where nothing is named and none is there, that is a NoCompilerError.
    """
    chosen = (os.environ.get("CC", "") if named is None else named).strip()
    where, remedy = ("CC=", "unset CC or name") if named is None else ("compiler ", "leave it out or name")
    if chosen or named is not None:
        try:
            command = shlex.split(chosen)
        except ValueError as error:
            raise ToolchainError(f"{where}{chosen}: {error}") from error
        if not command or shutil.which(command[0]) is None:
            raise ToolchainError(f"{where}{chosen}: no such command; {remedy} an installed C compiler")
        return command
    for candidate in CANDIDATES:
        if shutil.which(candidate) is not None:
            return [candidate]
    raise NoCompilerError("no C compiler found (cc, gcc, clang): install one, on Debian with `apt-get install gcc`")


def run_compiler(arguments: Sequence[str], what: str, compiler: Sequence[str] = ()) -> str:
    """Runs the compiler and returns what it printed. Raises ToolchainError with its first complaint."""
    from mahovik.core.toolchain.process import run  # its `subprocess` would slow the start of what compiles nothing

    command = [*(compiler or find_compiler()), *arguments]
    try:
        done = run(command)
    except OSError as error:
        raise ToolchainError(f"{command[0]} cannot be run: {error.strerror}") from error
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        first = next((line for line in lines if "error" in line), lines[0] if lines else "no message")
        raise ToolchainError(f"{command[0]} refused {what}: {first}")
    return done.stdout


def preprocess(header: Path, *more: str) -> str:
    """A header as the compiler sees it with `more` flags: declarations without directives. Raises ToolchainError."""
    return run_compiler(["-std=c99", *more, "-E", "-P", "-x", "c", str(header)], header.name)


@lru_cache
def machine(compiler: tuple[str, ...]) -> str:
    """Macros that the compiler predefines on this processor: where they are equal, so is the code it makes."""
    return run_compiler(["-march=native", "-dM", "-E", "-x", "c", os.devnull], "no file at all", compiler)


def program_file(compiler: tuple[str, ...]) -> str:
    """The file of the compiler's program: path, size, time of change; and the architecture of this processor.

    Where they are equal, so is the code that is compiled without `-march=native`.
    """
    path = Path(shutil.which(compiler[0]) or compiler[0]).resolve()
    stat = path.stat()
    return f"{path} {stat.st_size} {stat.st_mtime_ns} {platform.machine()}"


# -- a module as programs of others load it: the binary of an FMU ------------------------------------------------------

STRICT = ("-Wdouble-promotion", "-Wshadow", "-Wundef", "-Wcast-qual", "-Wfloat-equal")
"""Warnings beside those of every compile."""

_SUFFIX = {"linux": ".so", "darwin": ".dylib", "win32": ".dll"}
_SYSTEM = {"linux": "linux", "darwin": "darwin", "win32": "win"}
_MACHINE = {"x86_64": "x86_64", "amd64": "x86_64", "aarch64": "aarch64", "arm64": "aarch64", "i686": "x86"}


def platform_folder() -> str:
    """Folder of an FMU that keeps the binary of this machine, such as `linux64`."""
    system = _SYSTEM.get(sys.platform, sys.platform)
    machine = _MACHINE.get(platform.machine().lower(), platform.machine().lower())
    return f"{system}{struct.calcsize('P') * 8}" if machine in ("x86_64", "x86") else f"{machine}-{system}"


def module_suffix() -> str:
    """Suffix of extension modules on this machine."""
    return _SUFFIX.get(sys.platform, ".so")


def build_module(files: Mapping[str, str], compiled: Sequence[str]) -> bytes:
    """The module that those of the files that are `compiled` give. Raises ToolchainError."""
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
        folder = Path(scratch)
        for name, text in files.items():
            (folder / name).write_text(text, encoding="utf-8")
        target = folder / f"module{module_suffix()}"
        flags = [*WARNINGS, *STRICT, *BITS, "-O2", "-shared", "-fPIC", "-fvisibility=hidden"]
        sources = [str(folder / name) for name in compiled]
        run_compiler([*flags, f"-I{folder}", *sources, "-o", str(target)], "the sources of the FMU")
        return target.read_bytes()
