"""Picture of a verdict: what was found in each row, as a share of what is accepted there."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mahovik.out.report.plot.panel import Array, Panel, limit, stems


def shares(what: str, found: Mapping[str, Array], accepted: Array) -> Panel:
    """Found values by name, over rows counted from 1, each divided by the value accepted in its row.

    Rows without a number, and those where nothing but zero is accepted, are left out.
    """
    rows = np.arange(1.0, len(accepted) + 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        parts = {name: np.asarray(values, dtype=np.float64) / accepted for name, values in found.items()}
    drawn = {name: np.where(np.isfinite(each) & (each > 0.0), each, np.nan) for name, each in parts.items()}
    foot = min((float(x) for each in drawn.values() for x in each if x > 0.0), default=1.0) / 3.0
    middle = (len(drawn) - 1) / 2
    lines = [stems(name, rows + (k - middle) / 4, each, k, foot) for k, (name, each) in enumerate(drawn.items())]
    across = np.array([0.5, len(rows) + 0.5])
    return Panel(
        f"{what}, share of what is accepted", (*lines, limit("accepted", across, 1.0)), log=True,
        abscissa="row", span=(0.5, len(rows) + 0.5),
    )  # fmt: skip
