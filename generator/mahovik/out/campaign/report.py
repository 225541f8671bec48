"""What the rows of a campaign say: quantiles with intervals, why samples have none, what a quantity depends on."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from scipy import stats

from mahovik.out.campaign.file import Campaign
from mahovik.out.campaign.vary import IN_BLOCKS
from mahovik.out.plots import Line, Panel
from mahovik.out.report.page import Part, page
from mahovik.out.result import Result, column, fitted
from mahovik.use.numeric.se3 import Array
from mahovik.writing import write

CONFIDENCE = 0.95
SHARES = (0.05, 0.5, 0.95)
"""Quantiles of a quantity."""
BINS, MOST_REASONS = 20, 20
"""Bins of a number whose influence is estimated; reasons that are shown."""
ENOUGH = 4 * BINS
"""Samples from which on that influence is estimated."""


def summarise(campaign: Campaign, tables: Iterable[Any], chunks: int) -> Result:
    """The summary of the rows in tables of pyarrow, which are of so many chunks in a row from the first sample on."""
    rows = import_module("pyarrow").concat_tables(tables)
    reasons: dict[str, list[str]] = {}
    for reason in filter(None, rows["error"].to_pylist()):
        reasons.setdefault(re.sub(r"[-+.\d]+", "", reason), []).append(reason)  # the numbers of each sample differ
    values = {name: rows[name].to_numpy() for name in rows.column_names if name in campaign.units}
    figures = [_figures(values[q.name], campaign.design.kind not in IN_BLOCKS) for q in campaign.quantities]
    names = [q.name for q in campaign.quantities]
    columns = [column("quantity", "", names), column("unit", "", [q.unit for q in campaign.quantities])]
    columns += [column(key, "", [q[key] for q in figures]) for key in figures[0]]
    meta: dict[str, Any] = {
        "samples": len(rows), "of_samples": campaign.design.samples, "chunks": chunks, "of_chunks": campaign.chunks,
        "without_quantities": sum(map(len, reasons.values())),
    }  # fmt: skip
    if reasons:
        groups = sorted(reasons.values(), key=len, reverse=True)[:MOST_REASONS]
        texts, counts = [group[0] for group in groups], [len(group) for group in groups]
        meta["reasons"] = Result(
            "why samples have no quantities", (column("reason", "", texts), column("samples", "", counts))
        )
    meta["sensitivity"] = _sensitivity(campaign, values)
    few = campaign.design.kind not in IN_BLOCKS and not meta["sensitivity"].count
    messages = [f"what a quantity depends on is estimated from {ENOUGH} samples on"] if few else []
    if campaign.design.kind not in IN_BLOCKS:
        messages.append("95 % from, to: the 95 % quantile is between them with 95 % confidence; -: too few samples")
    messages += [varied.remark for varied in campaign.draw.varied if varied.remark]
    panels = [_histogram(q.name, q.unit, values[q.name]) for q in campaign.quantities]
    return Result(
        f"campaign {campaign.name}: {len(rows)} of {campaign.design.samples} samples", columns, rows="quantities",
        index="quantity", meta=meta, details=("of_samples", "chunks", "of_chunks"), messages=messages, drawings=panels,
    )  # fmt: skip


def _figures(values: Array, has_quantiles: bool) -> dict[str, float]:
    """Figures of a quantity; quantiles lie between two order statistics, whatever the distribution (binomial law)."""
    known = values[~np.isnan(values)]
    n = len(known)
    figures = {"mean": known.mean() if n else np.nan, "deviation": known.std(ddof=1) if n > 1 else np.nan}
    if has_quantiles:
        for share in SHARES:
            interval = quantile_interval(known, share)
            figures |= {f"{100 * share:g} %": interval[0]}
        figures |= {"95 % from": interval[1], "95 % to": interval[2]}
    return figures | {"least": known.min(initial=np.inf), "largest": known.max(initial=-np.inf)}


def quantile_interval(values: Array, share: float, confidence: float = CONFIDENCE) -> tuple[float, float, float]:
    """The quantile below which a share of the values is, and an interval that has it with this confidence.

    The ends of the interval are two of the values; NaN where there are too few of them.
    """
    if not len(values):
        return np.nan, np.nan, np.nan
    interval = stats.quantile_test(values, p=share).confidence_interval(confidence)
    return float(np.quantile(values, share, method="inverted_cdf")), float(interval.low), float(interval.high)


def _sensitivity(campaign: Campaign, values: Mapping[str, Array]) -> Result:
    """What each quantity depends on, largest first: by the design where it says so, else by shares of the variance."""
    rows: list[dict[str, Any]] = []
    title = "sensitivity"
    for quantity in campaign.quantities:
        y = values[quantity.name]
        figures, used = campaign.design.sensitivity(y)
        names: Sequence[str] = campaign.design.factors
        if campaign.design.kind not in IN_BLOCKS:
            known = ~np.isnan(y)
            used, names = int(known.sum()), [varied.number.path for varied in campaign.draw.varied if varied.factor]
            if used >= ENOUGH:
                figures = {"share": np.array([variance_share(values[path][known], y[known]) for path in names])}
        if figures:
            key = next(iter({"ST", "mu_star", "share"} & figures.keys()))
            for k in np.argsort(-figures[key], kind="stable").tolist():
                rows.append({"quantity": quantity.name, "number": names[k]} | {n: v[k] for n, v in figures.items()})
            title = f"sensitivity, by {used} samples"
    return Result(title, [column(key, "", [row[key] for row in rows]) for key in (rows[0] if rows else ())])


def variance_share(x: Array, y: Array) -> float:
    """Share of the variance of y (n) that x (n) has by itself: that of the means in bins of x, less their scatter.

    It estimates the first Sobol' index from rows as they are, for straight and for other dependences.
    """
    parts = np.array_split(y[np.argsort(x, kind="stable")], BINS)
    total, means = float(np.var(y)), [part.mean() for part in parts]
    between = float(np.average((means - y.mean()) ** 2, weights=[len(part) for part in parts]))
    unbiased = between - (total - between) * (BINS - 1) / (len(y) - BINS)
    return float(np.clip(unbiased / total, 0.0, 1.0)) if total > 0.0 else 0.0


def _histogram(name: str, unit: str, values: Array) -> Panel:
    known = values[~np.isnan(values)]
    counts, edges = np.histogram(known, bins="doane" if len(known) > 2 and np.ptp(known) > 0.0 else 1)
    shown = fitted(column(name, unit, np.repeat(edges, 2)[1:-1]))
    line = Line("samples", shown.values, np.repeat(counts, 2))
    return Panel("samples", (line,), abscissa=shown.head, top=float(counts.max()))


def write_report(campaign: Campaign, result: Result, path: Path) -> None:
    """Write a page of the summary with a histogram of each quantity, which opens offline. Raises UsageError."""
    part = Part("Quantities", html=result._repr_html_(), panels=tuple(result.drawings))
    write(path, page(campaign.name, [part], campaign.stand, [("campaign", campaign.path.name)]))
