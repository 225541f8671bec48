"""Tools of the commands that are installed on this machine, and the command that installs each."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import metadata

from mahovik.core.toolchain import process
from mahovik.core.toolchain.compiler import find_compiler
from mahovik.core.toolchain.targets import TARGETS
from mahovik.errors import ToolchainError

_SECONDS = 10.0

CHECKERS = (
    ("frama-c", "frama-c-base", "proofs of the C: Eva"),
    ("cppcheck", "cppcheck", "static checks of the C"),
    ("cmake", "cmake", "projects of generate --project cmake"),
    ("valgrind", "valgrind", "verify --cost: instructions of the host"),
)
"""Command, Debian package, what asks for it."""


@dataclass(frozen=True)
class Finding:
    """One tool.

    what     its name
    serves   what asks for it
    found    its version, or "" where it is missing
    install  the command that installs it
    """

    what: str
    serves: str
    installed: str
    install: str


def findings() -> tuple[Finding, ...]:
    """The C compiler, the compilers and emulators of targets, checkers, extras of the Python package."""
    return (*_compiler(), *_of_targets(), *_checkers(), *_extras())


def _compiler() -> Iterator[Finding]:
    try:
        command = find_compiler()
    except ToolchainError:
        command = []
    yield Finding("C compiler", "verify, simulate", _version(command), "apt-get install gcc libc6-dev")


def _of_targets() -> Iterator[Finding]:
    """One line per command, with the targets that need it."""
    serves: dict[str, list[str]] = {}
    packages: dict[str, tuple[str, ...]] = {}
    for target in TARGETS.values():
        for command in dict.fromkeys((target.compiler[0], target.link[0], *target.emulator[:1])):
            serves.setdefault(command, []).append(target.name)
            packages.setdefault(command, target.packages)
    for command, names in serves.items():
        more = f" and {len(names) - 3} more" if len(names) > 3 else ""
        serve = f"targets {', '.join(names[:3])}{more}"
        yield Finding(command, serve, _version([command]), f"apt-get install {' '.join(packages[command])}")


def _checkers() -> Iterator[Finding]:
    for command, package, serves in CHECKERS:
        yield Finding(command, serves, _version([command]), f"apt-get install {package}")


def _extras() -> Iterator[Finding]:
    """Packages of each extra of the installed package; nothing is imported."""
    try:
        required = metadata.requires("mahovik") or []
    except metadata.PackageNotFoundError:
        return
    for extra in sorted(metadata.metadata("mahovik").get_all("Provides-Extra") or []):
        if extra == "test":
            continue
        names = [line for line in required if re.search(rf"extra == ['\"]{extra}['\"]", line)]
        versions = {name: _distribution(name) for name in (re.split(r"[ ;<>=\[]", line)[0] for line in names)}
        complete = all(versions.values())
        installed = ", ".join(f"{name} {version}" for name, version in versions.items()) if complete else ""
        yield Finding(f"extra {extra}", ", ".join(versions), installed, f"pip install 'mahovik[{extra}]'")


def _distribution(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return ""


def _version(command: list[str]) -> str:
    """First line of the tool's version; "" where it is missing or does not start."""
    if not command or shutil.which(command[0]) is None:
        return ""
    asked = "-version" if command[0] == "frama-c" else "--version"
    try:
        done = process.run([*command, asked], timeout=_SECONDS)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    lines = done.stdout.strip().splitlines()
    return lines[0] if done.returncode == 0 and lines else ""
