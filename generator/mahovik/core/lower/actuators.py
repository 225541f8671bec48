"""Inputs in the table that a law takes at run time, such as the deflection of a fin: their check."""

from __future__ import annotations

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.lower.law import BodyProgram
from mahovik.core.lower.library import Library
from mahovik.core.lower.run_time_input import RunTimeInput
from mahovik.core.program.build import Body
from mahovik.core.program.expression import Const
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind
from mahovik.core.stand.structure_facts import Structure


def run_time_inputs(structure: Structure) -> tuple[RunTimeInput, ...]:
    """Inputs in the table that laws of the stand take at run time."""
    laws = parts("program", BodyProgram, BODY_LAWS)
    return tuple(given for law in laws if (given := law.run_time_input(structure)) is not None)


def add_check(lib: Library) -> None:
    """Adds `check_actuators`, where the stand has such inputs."""
    if run_time_inputs(lib.layout.structure):
        lib.add(check_actuators(lib))


def check_actuators(lib: Library) -> Function:
    """NOT_FINITE or RANGE where an input in the table is no number or too large."""
    table = lib.table_argument()
    body, inputs = Body(), run_time_inputs(lib.layout.structure)
    for each in inputs:
        limit = lib.limits[each.limit].expression if isinstance(each.limit, str) else Const(each.limit, Kind.REAL)
        with body.loop("k", each.count) as k:
            lib.check_number(body, table.place.member(each.array)[k].member(each.member), limit)
    return body.checked_function(
        "check_actuators",
        f"Are {', '.join(each.words for each in inputs)} finite and in their ranges?",
        (table,),
    )
