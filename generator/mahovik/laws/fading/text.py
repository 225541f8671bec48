"""Words for fading damping in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.law import DRIVES, negative_diagonal
from mahovik.core.stand.model import Stand
from mahovik.laws.fading.data import FadingDamping

NAME = "fading damping"
CARRIES_WEIGHT = False


def bearers(stand: Stand) -> list[str]:
    """The bodies that have it."""
    return [body.name for body in stand.bodies if body.law(FadingDamping) is not None]


def short(stand: Stand) -> str:
    """The law in a word; empty where no body has it."""
    return NAME if bearers(stand) else ""


def warnings(stand: Stand) -> list[str]:
    """Fading damping that drives: with a negative coefficient on the diagonal."""
    laws = ((body.name, body.law(FadingDamping)) for body in stand.bodies)
    found = (negative_diagonal(f"{name}: fading_damping.linear", law.linear, DRIVES) for name, law in laws if law)
    return [line for lines in found for line in lines]
