"""Targets that a test may use: without their tools it is skipped, in CI it fails."""

from __future__ import annotations

from mahovik.core.toolchain.targets import TARGETS, Target
from toolchain.tools import require

EMBEDDED = ("m3", "m4", "m7", "m33", "m55", "rv32imac", "rv32imafc", "rv32gc", "rv64imac", "rv64gc")
QUICK = ("host", "m4", "m7", "rv64gc")


def target(name: str) -> Target:
    """The target, with all that it needs."""
    found = TARGETS[name]
    for command in (found.compiler[0], found.link[0], *found.emulator[:1]):
        require(command, " ".join(found.packages))
    return found
