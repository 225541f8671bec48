"""Words for control derivatives in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.laws.control.data import ControlDerivatives

NAME = "control derivatives"
CARRIES_WEIGHT = False


def bearers(stand: Stand) -> list[str]:
    """The bodies that have any."""
    return [body.name for body in stand.bodies if body.law(ControlDerivatives) is not None]


def short(stand: Stand) -> str:
    """The law in a word; empty where no body has it."""
    return NAME if bearers(stand) else ""
