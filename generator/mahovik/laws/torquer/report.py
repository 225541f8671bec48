"""The torquers in the report of a stand."""

from __future__ import annotations

from markupsafe import Markup

from mahovik.core.stand.model import Stand
from mahovik.laws.torquer.data import Torquers
from mahovik.out.report.stand.markup import Cell, vector_cell
from mahovik.out.report.stand.tie import Tie

TITLE = "Torquers"
LEGEND = ("", "")


def ties(stand: Stand) -> tuple[Tie, ...]:
    """No lines: a dipole has no ends."""
    return ()


def at_origin(stand: Stand) -> bool:
    """False: a torquer has no place."""
    return False


def cell(stand: Stand) -> Cell:
    """The field, and one line per torquer."""
    law = stand.law(Torquers)
    if law is None:
        return "none"
    lines = [Markup("field {} of E₀").format(vector_cell(law.magnetic_field, "T", "zero"))]
    for torquer in law.torquers:
        dipole = vector_cell(torquer.dipole, "A m²", "zero")
        lines.append(Markup("{}: dipole {} of {}").format(torquer.name, dipole, torquer.mount))
    return Markup("<br>").join(lines)
