"""Words for buoyancy in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.laws.buoyancy.data import Buoyancy

NAME = "buoyancy"
CARRIES_WEIGHT = True


def bearers(stand: Stand) -> list[str]:
    """The bodies that displace fluid."""
    return [body.name for body in stand.bodies if body.law(Buoyancy) is not None]


def short(stand: Stand) -> str:
    """The law in a word; empty where no body has it."""
    return NAME if bearers(stand) else ""
