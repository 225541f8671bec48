"""The functions of all tasks of a stand, in an order in which each comes after those that it calls."""

from __future__ import annotations

from mahovik.core import routines
from mahovik.core.lower import allocate
from mahovik.core.lower.library import Library
from mahovik.core.lower.task.demand import demand_turning, project, scale_turning
from mahovik.core.lower.task.fast import inverse_fast_task
from mahovik.core.lower.task.inverse import inverse_task
from mahovik.core.lower.task.rows import Rows
from mahovik.core.lower.task.torque_demand import torque_demand
from mahovik.core.lower.task.torque_for import torque_for_task
from mahovik.core.routines.jacobi import name_for_rows


def add_tasks(lib: Library) -> None:
    """`inverse_TASK`, `inverse_fast_TASK` of each task, and what they share: some by their number of rows."""
    layout = lib.layout
    tasks = [Rows(layout, task) for task in layout.structure.tasks]
    if any(rows.turning for rows in tasks):
        lib.add(demand_turning(lib))
        lib.add(scale_turning(lib))
    for rows in tasks:
        if name_for_rows("allocate", len(rows)) not in lib:
            lib.add(
                routines.orthogonalise(layout.inverse_work, layout.count, lib["sqrt"], layout.precision.name, len(rows))
            )
            lib.add(allocate.solve_gram(lib, len(rows)))
            lib.add(allocate.allocate(lib, len(rows)))
        lib.add(project(lib, rows))
        lib.add(inverse_task(lib, rows))
        lib.add(inverse_fast_task(lib, rows))
        base = torque_demand(lib, rows.turning)
        if base.name not in lib:
            lib.add(base)
        _add_bounded(lib, len(rows))
        lib.add(torque_for_task(lib, rows))


def _add_bounded(lib: Library, rows: int) -> None:
    """Least squares and shares within bounds, for a number of rows."""
    if f"bounded_least_squares_{rows}" in lib:
        return
    count, at = lib.layout.count, lib.thresholds
    lib.add(routines.bounded_least_squares(rows, count, lib["sqrt"], at.bounded))
    lib.add(routines.largest_share(rows, count, at.share_pivot, at.unreachable))
