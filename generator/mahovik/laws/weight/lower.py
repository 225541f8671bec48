"""Weight in the program of a stand: of all bodies in the total wrench, of one flywheel on its mount.

The Archimedes force is of the same form, so both are added at once where the stand displaces fluid.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from mahovik.core.formula.derived import FormulaModule
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.expression import Place
from mahovik.core.stand.structure_facts import Structure

if TYPE_CHECKING:
    from mahovik.laws.weight import derive as formulas
else:
    formulas = FormulaModule("laws.weight.derive")


def words(structure: Structure) -> str:
    """The law in a word; empty where the stand does not have it."""
    return "weight" if structure.weight else ""


def add_weight(body: Body, displaces: bool, numbers: Mapping[str, Any], F: Place) -> None:
    """Adds the weight of all bodies to F, in E1 about O1; `numbers`: of the symbols of `derive.weight`."""
    body.note("weight of all bodies: its line of action moves with the flywheels")
    assign(body, list(F), formulas.weight(displaces), dict(numbers), add=True)


def subtract_weight(body: Body, displaces: bool, numbers: Mapping[str, Any], W: Place) -> None:
    """Subtracts the weight of one flywheel from W, in Es about Os."""
    assign(body, list(W), formulas.weight_reaction(displaces), dict(numbers), add=True)
