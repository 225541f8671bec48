"""Elementary functions that the C of an attitude loop has of its own: those of the stand's C are internal to it."""

from __future__ import annotations

from mahovik.core import routines
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.program.function import Program
from mahovik.core.program.validate import validate


def attitude_routines(layout: Layout) -> Program:
    """Internal functions `sincos`, `sqrt`, `atan2` in the element type of the layout."""
    lib = Library(layout)
    for function in (routines.sincos, routines.square_root, routines.atan2):
        lib.add(function(layout.precision))
    program = Program(layout.structure.name, layout.precision, (layout.count,), (), lib.functions)
    validate(program)
    return program
