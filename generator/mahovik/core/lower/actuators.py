"""Inputs in the table that a law takes at run time, such as the deflection of a fin: their check."""

from __future__ import annotations

from typing import Any

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.lower.checks import check_number
from mahovik.core.lower.law import BodyProgram
from mahovik.core.lower.library import Library
from mahovik.core.lower.run_time_input import RunTimeInput
from mahovik.core.program.expression import Status, real
from mahovik.core.program.kernel import OK
from mahovik.core.stand.structure_facts import Structure


def run_time_inputs(structure: Structure) -> tuple[RunTimeInput, ...]:
    """Inputs in the table that laws of the stand take at run time."""
    laws = parts("program", BodyProgram, BODY_LAWS)
    return tuple(given for law in laws if (given := law.run_time_input(structure)) is not None)


def add_check(lib: Library) -> None:
    """Adds `check_actuators`, where the stand has such inputs: NOT_FINITE or RANGE where one is none or too large."""
    inputs = run_time_inputs(lib.layout.structure)
    if not inputs:
        return

    limits = [lib.limit(each.limit) if isinstance(each.limit, str) else real(each.limit) for each in inputs]

    @lib.kernel(purpose=f"Are {', '.join(each.words for each in inputs)} finite and in their ranges?")
    def check_actuators(table: Any = lib.table) -> Status:
        """Are inputs of laws in their ranges?"""
        for each, limit in zip(inputs, limits, strict=True):
            for k in range(each.count):
                check_number(lib, table.member(each.array)[k].member(each.member), limit)
        return OK
