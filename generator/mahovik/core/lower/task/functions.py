"""The functions of all tasks of a stand, in an order in which each comes after those that it calls."""

from __future__ import annotations

from mahovik.core import routines
from mahovik.core.lower import allocate
from mahovik.core.lower.library import Library
from mahovik.core.lower.task.demand import demand_turning, project, scale_turning
from mahovik.core.lower.task.fast import inverse_fast_task
from mahovik.core.lower.task.inverse import inverse_task
from mahovik.core.lower.task.rows import Rows
from mahovik.core.routines.jacobi import numbered


def add_tasks(lib: Library) -> None:
    """`inverse_TASK`, `inverse_fast_TASK` of each task, and what they share: some by their number of rows."""
    layout = lib.layout
    tasks = [Rows(layout, task) for task in layout.structure.tasks]
    if any(rows.turning for rows in tasks):
        lib.add(demand_turning(lib))
        lib.add(scale_turning(lib))
    for rows in tasks:
        if numbered("allocate", len(rows)) not in lib:
            lib.add(
                routines.orthogonalise(layout.inverse_work, layout.count, lib["sqrt"], layout.precision.name, len(rows))
            )
            lib.add(allocate.solve_gram(lib, len(rows)))
            lib.add(allocate.allocate(lib, len(rows)))
        lib.add(project(lib, rows))
        lib.add(inverse_task(lib, rows))
        lib.add(inverse_fast_task(lib, rows))
        if layout.sine_input:
            lib.add(inverse_fast_task(lib, rows, at=True))
