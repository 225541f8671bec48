"""The states on which functions are measured: those that the self-test draws, the same for every target."""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.test_inputs import Generator, draw, plan
from mahovik.core.program.function import Program

STATES = 4
"""How many; the dearest of them is reported."""


def measuring_states(program: Program) -> list[dict[str, Any]]:
    """Arguments of the public functions by name, a dict a state: ordinary ones, no flywheel locked."""
    planned = plan(program)
    generator = Generator()
    found = [draw(planned, generator, program.precision) for _ in range(STATES)]
    for state in found:
        if "locked" in state:
            state["locked"] = [0] * len(state["locked"])
    return found
