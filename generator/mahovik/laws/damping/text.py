"""Words for damping in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.laws.damping.data import Damping

NAME = "damping"
CARRIES_WEIGHT = False


def bearers(stand: Stand) -> list[str]:
    """The damped bodies."""
    return [body.name for body in stand.bodies if body.law(Damping) is not None]


def short(stand: Stand) -> str:
    """The law in a word; empty where no body has it."""
    return NAME if bearers(stand) else ""
