"""Frama-C Eva on emitted C: runs the delivered script and reads what it printed."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mahovik.errors import ToolchainError

PACKAGE = "frama-c-base"
"""Debian package that has the command."""

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


def version() -> str:
    """`25.0-beta (Manganese)`. Raises ToolchainError where there is no frama-c."""
    if shutil.which("frama-c") is None:
        raise ToolchainError(f"no frama-c: install it, on Debian with `apt-get install {PACKAGE}`")
    done = subprocess.run(["frama-c", "-version"], capture_output=True, text=True, check=False)
    return done.stdout.strip()


def prove(script: Path, wanted: Sequence[str] = (), limit: int | None = None, logs: Path | None = None) -> list[Proof]:
    """Runs `<stand>_eva.sh` on drivers (default: all that is claimed); `limit`: seconds a driver.

    Raises ToolchainError where the script cannot run.
    """
    version()
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
    found = _LINE.fullmatch(line.strip())
    if found is None:
        raise ToolchainError(f"_eva.sh printed {line.strip()!r}, expected `SET_FUNCTION alarms N unproved N seconds N`")
    alarms = None if found["alarms"] == "failed" else int(found["alarms"])
    return Proof(found["function"], found["set"], alarms, int(found["bad"]), int(found["s"]))
