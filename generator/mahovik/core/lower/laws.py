"""The sum of wrenches in E1."""

from __future__ import annotations

from mahovik.core.formula.derived import wrench as derived
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.expression import Place


def add_force(body: Body, target: list[Place], origin: Place, force: list[Place], moment: list[Place] | None) -> None:
    """F += T (force; moment): a wrench at `origin`, in axes of E1."""
    for t, f in zip(target[:3], force, strict=True):
        body.add(t, f)
    formula = derived.moment_of_force() if moment is None else derived.moved_moment()
    binding = {"O": origin, "f": force, "n": moment}
    assign(body, target[3:], formula, binding, add=True)
