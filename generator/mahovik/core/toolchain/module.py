"""A loadable module of several C files for this machine, as programs of others load it: the binary of an FMU."""

from __future__ import annotations

import platform
import struct
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from mahovik.core.toolchain.compiler import BITS, WARNINGS, run_compiler

STRICT = ("-Wdouble-promotion", "-Wshadow", "-Wundef", "-Wcast-qual", "-Wfloat-equal")
"""Warnings beside those of every compile."""

_SUFFIX = {"linux": ".so", "darwin": ".dylib", "win32": ".dll"}
_SYSTEM = {"linux": "linux", "darwin": "darwin", "win32": "windows"}
_MACHINE = {"x86_64": "x86_64", "amd64": "x86_64", "aarch64": "aarch64", "arm64": "aarch64", "i686": "x86"}


def platform_folder(version: str) -> str:
    """Where an FMU of a version keeps the binary of this machine: `linux64`, in FMI 3 `x86_64-linux`."""
    system = _SYSTEM.get(sys.platform, sys.platform)
    machine = _MACHINE.get(platform.machine().lower(), platform.machine().lower())
    if version == "2.0":
        short = {"windows": "win"}.get(system, system)
        return f"{short}{struct.calcsize('P') * 8}" if machine in ("x86_64", "x86") else f"{machine}-{system}"
    return f"{machine}-{system}"


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
