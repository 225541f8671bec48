"""The suspension in the report of a stand."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup

from mahovik.core.stand.model import Stand
from mahovik.laws.suspension.data import Suspension
from mahovik.out.report.stand.markup import Cell, figure, vector_cell
from mahovik.out.report.stand.tie import Tie

TITLE = "Suspension"
LEGEND = ("dotted circle", "suspension: a 6x6 between O1 and the ground, it has no shape")


def ties(stand: Stand) -> tuple[Tie, ...]:
    """No lines: it has no shape."""
    return ()


def at_origin(stand: Stand) -> bool:
    """Whether it acts at O1."""
    return stand.law(Suspension) is not None


def cell(stand: Stand) -> Cell:
    """Diagonals and equilibrium of the suspension, in words."""
    given = stand.law(Suspension)
    return "none" if given is None else _cell(given)


def _cell(given: Suspension) -> Markup:
    parts = []
    for words, matrix, units in (
        ("stiffness", given.stiffness, ("N/m", "N m/rad")),
        ("damping", given.damping, ("N s/m", "N m s/rad")),
    ):
        values = np.array(matrix)
        diagonal = np.diag(values)
        linear, angular = (Markup(", ").join(figure(x, 4) for x in diagonal[i : i + 3]) for i in (0, 3))
        text = Markup("{} ({}) {} and ({}) {}").format(words, linear, units[0], angular, units[1])
        if np.any(values - np.diag(diagonal)):
            text += Markup(", coupled")
        parts.append(text)
    parts.append(Markup("equilibrium of O₁ at {}").format(vector_cell(given.position, "m", "the origin of E₀")))
    if any(given.angles):
        parts.append(Markup("turned by {}").format(vector_cell(given.angles, "rad", "")))
    return Markup("; ").join(parts)
