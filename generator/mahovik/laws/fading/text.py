"""Words for fading damping in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.model import TWIST_LETTERS, Stand
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
    found = []
    for body in stand.bodies:
        law = body.law(FadingDamping)
        if law is None:
            continue
        for letter, value in zip(TWIST_LETTERS, (law.linear[i][i] for i in range(6)), strict=True):
            if value < 0.0:
                found.append(
                    f"{body.name}: fading_damping.linear has {value:.5g} for {letter}: it drives where it should "
                    "brake; coefficients that damp are positive"
                )
    return found
