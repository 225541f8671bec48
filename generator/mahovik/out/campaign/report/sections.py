"""Sections of the page: what was computed, one section for each quantity, the worst samples."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from mahovik.errors import UsageError
from mahovik.out.campaign.convergence import quantile_interval
from mahovik.out.campaign.dataset import Status, count_of
from mahovik.out.campaign.reached import words
from mahovik.out.campaign.report.influence import Influence, bin_means, influences
from mahovik.out.campaign.report.query import Query
from mahovik.out.campaign.report.spread import FEW, histogram, quantile_table, scatter, settling, unit_text
from mahovik.out.campaign.rows import Work
from mahovik.out.report.page import Part, Row, figure, paragraph, picture, table
from mahovik.out.report.plots import Mark

Array = NDArray[np.float64]

MOST_ROWS = 200_000
"""Rows from which influences are estimated: of more, one in several."""

SHOWN = 12
"""Parameters of a table."""

BAR = 150.0
"""Width of the longest bar."""

INFLUENCE_WORDS = (
    "Share: of the variance of the quantity, by this number alone, from means in 20 bins; what is missing to 100 % in "
    "all is due to numbers together, and to estimation. Change: while this number rises by its standard deviation, in "
    "standard deviations of the quantity, by linear regression, which explains {explained} of the variance. Rank: rank "
    "correlation."
)

FIGURES = {
    "S1": "alone, S1>",
    "S1_conf": "±>",
    "ST": "with others, ST>",
    "ST_conf": "±>",
    "mu_star": "mean size of the effect, µ*>",
    "mu_star_conf": "±>",
    "sigma": "spread of the effect, σ>",
}
"""Heads of the columns of a sensitivity analysis."""


def overview(state: Status, query: Query) -> Part:
    """Counts of samples, and reasons of those without quantities."""
    known = state.manifest
    parts = [
        f"{state.rows} samples in {count_of(len(state.records), 'shard')}",
        f"{state.failed} of them without quantities" if state.failed else "all with all quantities",
    ]
    if known.end < known.samples:
        parts.append(f"enough of the {known.samples} that were allowed")
    words = f"{', '.join(parts)}. Numbers that vary: {len(known.parameters)}."
    rows = tuple((text, str(count), str(first)) for text, count, first in query.reasons())
    head = ("Why samples have no quantities", "samples>", "first>") if rows else ()
    failures = () if state.complete else (f"{known.end - state.rows} of {known.end} samples are missing or damaged",)
    return Part("Samples", words, head, rows, failures=failures, summary=parts[0])


def quantity(work: Work, query: Query, name: str, worst: int) -> Part | None:
    """One quantity: how it is spread, and on which numbers it depends; None where no sample has it."""
    manifest, unit = query.manifest, query.manifest.quantities[name]
    values = query.columns([name])[name]
    values = values[~np.isnan(values)]
    if not len(values):
        return None
    goal = work.goal if work.goal is not None and work.goal.of == name else None
    every = -(-manifest.end // MOST_ROWS)
    columns = query.columns([name, *manifest.parameters], every)
    kept = ~np.isnan(columns[name])
    parameters = {path: columns[path][kept] for path in manifest.parameters}
    found, explained = influences(parameters, columns[name][kept])
    panels = [histogram(name, unit, values)]
    if work.has_quantiles and len(values) > FEW:
        panels.append(settling(name, unit, values, goal))
    if found:
        path = found[0].parameter
        marks = [
            Mark(query.parameters_of(number)[path], value, f"sample {number}")
            for number, value in query.largest(name, worst)
        ]
        against = (path, manifest.parameters[path], parameters[path])
        means = bin_means(parameters[path], columns[name][kept])
        panels.append(scatter(name, unit, columns[name][kept], against, means, marks))
    html = picture(panels) + (quantile_table(name, unit, values) if work.has_quantiles else Markup(""))
    if goal is not None:
        html = paragraph(f"{words(goal, goal.interval(values))}.") + html
    if found:
        html += tornado(found, explained)
    html += _by_design(work, query, name)
    of = unit_text(unit)[1:]
    if work.has_quantiles:
        middle, high = (quantile_interval(values, p).value for p in (0.5, 0.95))
        summary = f"half of the samples below {middle:.4g}{of}, 95 % below {high:.4g}{of}"
    else:
        summary = f"between {values.min():.4g}{of} and {values.max():.4g}{of}"
    return Part(name, html=html, summary=summary)


def tornado(found: list[Influence], explained: float) -> Markup:
    """Influences as bars, the largest first."""
    rows = [
        [each.parameter, bar(each.share, False), _percent(each.share), bar(each.change, True), figure(each.change, 2),
         figure(each.rank, 2)]
        for each in found[:SHOWN]
    ]  # fmt: skip
    more = f" The {SHOWN} largest of {len(found)}." if len(found) > SHOWN else ""
    caption = INFLUENCE_WORDS.format(explained=f"{max(explained, 0.0):.0%}") + more
    return table(["Number", "share", ">", "change", ">", "rank>"], rows, caption)


def bar(value: float, signed: bool) -> Markup:
    """A bar of a share, from the left; of a signed number up to 1, from the middle."""
    size = BAR * min(abs(value), 1.0) / (2.0 if signed else 1.0)
    start = 0.0 if not signed else BAR / 2.0 - (size if value < 0.0 else 0.0)
    colour = "--c2" if value < 0.0 else "--c1"
    return Markup(
        '<svg class="bar" role="img" aria-label="{}" width="{}" height="12" viewBox="0 0 {} 12">'
        '<rect x="{:.1f}" y="1" width="{:.1f}" height="10" style="fill:var({})"/></svg>'
    ).format(f"{value:.2g}", int(BAR), int(BAR), start, size, colour)


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %"


def _by_design(work: Work, query: Query, name: str) -> Markup:
    """Figures of the design of the campaign, where it has any: Sobol' indices, or effects of Morris."""
    try:
        found = work.sensitivity(query.with_gaps(name))
    except UsageError:
        return Markup("")
    keys = [key for key in FIGURES if key in found.figures]
    first = "ST" if "ST" in keys else "mu_star"
    order = np.argsort(-found.figures[first], kind="stable")
    rows = [[found.factors[k], *(figure(float(found.figures[key][k]), 3) for key in keys)] for k in order]
    left_out = f"; {found.left_out} left out, as their blocks have samples without it" if found.left_out else ""
    title = "Sobol' indices" if "ST" in keys else "Elementary effects of Morris"
    caption = f"{title}, from {found.used} samples{left_out}; ±: halves of 95 % confidence intervals"
    return table(["Number", *(FIGURES[key] for key in keys)], rows, caption)


def worst_samples(query: Query, most: int, files: dict[tuple[str, int], str]) -> Part | None:
    """Samples with the largest quantities, and their stand files."""
    rows: list[Row] = []
    for name in query.manifest.quantities:
        unit = query.manifest.quantities[name]
        rows += [
            [f"{name}{unit_text(unit)}", str(number), figure(value, 5), files.get((name, number), "cannot be")]
            for number, value in query.largest(name, most)
        ]
    if not rows:
        return None
    words = "The stand of a sample is a stand file like any other: `mahovik check`, `mahovik simulate`."
    return Part("Largest values", words, ("Quantity", "sample>", "value>", "stand file"), tuple(rows))
