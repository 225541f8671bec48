"""How a quantity is spread: histogram, quantiles with their confidence intervals, and how these settled."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from mahovik.out.campaign.convergence import Goal, quantile_interval
from mahovik.out.report.page import figure, table
from mahovik.out.report.plots import Line, Mark, Panel, limit

Array = NDArray[np.float64]

QUANTILES = (0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99, 0.999)
SHOWN = 0.95
"""Quantile whose convergence is shown, where the campaign names none."""

CONFIDENCE = 0.95
MOST_BINS = 80
FEW = 20
"""Samples from which on the convergence is shown."""

STEPS = 40
"""Numbers of samples at which the quantile is shown."""


def unit_text(unit: str) -> str:
    """Unit after a name."""
    return "" if unit in ("", "1") else f", {unit}"


def histogram(name: str, unit: str, values: Array) -> Panel:
    """Share of the samples in each bin."""
    bins = int(np.clip(np.sqrt(len(values)), 5, MOST_BINS))
    counts, edges = np.histogram(values, bins)
    share = counts / len(values)
    x, y = np.repeat(edges, 2), np.concatenate([[0.0], np.repeat(share, 2), [0.0]])
    return Panel("share of the samples", (Line("", x, y),), abscissa=f"{name}{unit_text(unit)}", note=f"{bins} bins")


def quantile_table(name: str, unit: str, values: Array) -> Markup:
    """Quantiles with their intervals; mean, standard deviation and ends."""
    rows = []
    for p in QUANTILES:
        found = quantile_interval(values, p, CONFIDENCE)
        ends = [figure(x, 4) if np.isfinite(x) else Markup("too few samples") for x in (found.low, found.high)]
        rows.append([f"{100.0 * p:g} % below", figure(found.value, 5), *ends])
    error = float(values.std(ddof=1) / np.sqrt(len(values))) if len(values) > 1 else 0.0
    mean = float(values.mean())
    ends = [figure(mean - 1.96 * error, 4), figure(mean + 1.96 * error, 4)]
    other = [
        ["mean", figure(mean, 5), *ends],
        ["standard deviation", figure(float(values.std(ddof=1)) if len(values) > 1 else 0.0, 5), "", ""],
        ["smallest", figure(float(values.min()), 5), "", ""],
        ["largest", figure(float(values.max()), 5), "", ""],
    ]
    head = ["", f"{name}{unit_text(unit)}>", "from>", "to>"]
    return table(head, [*rows, *other], f"{len(values)} samples; from, to: {CONFIDENCE:.0%} confidence intervals")


def settling(name: str, unit: str, values: Array, goal: Goal | None) -> Panel:
    """Quantile and its interval against the number of samples."""
    p, confidence = (goal.p, goal.confidence) if goal is not None else (SHOWN, CONFIDENCE)
    counts = np.unique(np.geomspace(FEW, len(values), STEPS).astype(int))
    found = [quantile_interval(values[:n], p, confidence) for n in counts]
    x = counts.astype(float)
    low, value, high = (np.array([getattr(each, key) for each in found]) for key in ("low", "value", "high"))
    lines = (
        Line(f"{100.0 * p:g} % below", x, value),
        Line("interval", x, np.where(np.isfinite(low), low, np.nan), None, dashed=True),
        Line("", x, np.where(np.isfinite(high), high, np.nan), None, dashed=True),
    )
    return Panel(f"{name}{unit_text(unit)}", lines, abscissa="samples", log_abscissa=True)


def scatter(
    name: str, unit: str, values: Array, against: tuple[str, str, Array], means: tuple[Array, Array], worst: list[Mark]
) -> Panel:
    """Quantity against a parameter: means in bins, some samples, and the worst ones."""
    parameter, other_unit, column = against
    every = max(1, len(values) // SAMPLES)
    marks = [Mark(float(x), float(y), "a sample") for x, y in zip(column[::every], values[::every], strict=True)]
    ends = np.array(_span(np.append(column[::every], [mark.x for mark in worst])))
    levels = (limit("smallest", ends, float(values.min())), limit("largest", ends, float(values.max())))
    return Panel(
        f"{name}{unit_text(unit)}",
        (Line("mean in bins", *means), *levels),
        abscissa=f"{parameter}{unit_text(other_unit)}",
        marks=(*marks, *worst),
        span=(float(ends[0]), float(ends[1])),
    )


SAMPLES = 250
"""Samples of a scatter."""


def _span(x: Array) -> tuple[float, float]:
    low, high = float(x.min()), float(x.max())
    room = 0.03 * (high - low) or 1.0
    return low - room, high + room
