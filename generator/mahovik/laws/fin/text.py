"""Words for fins in checks and tables."""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.laws.fin.data import Fins

NAME = "fins"
CARRIES_WEIGHT = False


def bearers(stand: Stand) -> list[str]:
    """The bodies that have any."""
    return [body.name for body in stand.bodies if body.law(Fins) is not None]


def short(stand: Stand) -> str:
    """The law in a word; empty where no body has it."""
    return NAME if bearers(stand) else ""


def warnings(stand: Stand) -> list[str]:
    """Fins whose lift grows without end with the angle of the flow."""
    laws = [law for body in stand.bodies if (law := body.law(Fins)) is not None]
    names = [fin.name for law in laws for fin in law.fins if fin.incidence and fin.stall is None and fin.lift_slope]
    if not names:
        return []
    more = f" (and {len(names) - 1} more)" if len(names) > 1 else ""
    return [
        f"fin {names[0]}{more}: without `stall` its lift grows with the angle of the flow up to 180 deg and jumps "
        "there: give it, such as 15 deg, where the flow may come from the side or from astern"
    ]
