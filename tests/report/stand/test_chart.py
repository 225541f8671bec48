"""Charts: no peak is lost, paths lie where the numbers are, names are escaped, colours are those of the page."""

from __future__ import annotations

import json
import re
from html import unescape
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import pytest

from mahovik.core.emit.templates import template
from mahovik.out.report.plot.panel import Line, Mark, Panel, border, family
from mahovik.out.report.plot.prefix import prefixed
from mahovik.out.report.stand.chart import charts
from mahovik.out.report.stand.chart.axis import Axis, axis
from mahovik.out.report.stand.chart.figure import figure
from mahovik.out.report.stand.chart.many import MOST, NAMED, condensed
from mahovik.out.report.stand.chart.outline import ACROSS, BINS, DOWN, envelope, path
from mahovik.out.report.stand.rows import some_rows


def points(data: str) -> list[np.ndarray]:
    """Of a path, part by part, as its script reads them: (n, 2) in the frame."""
    parts = []
    for part in data.split("M")[1:]:
        numbers = np.array([float(x) for x in re.findall(r"-?[\d.]+", re.sub(r"[hz].*", "", part))]).reshape(-1, 2)
        parts.append(numbers.cumsum(axis=0))
    return parts


def drawn(html: str) -> tuple[list[ElementTree.Element], dict]:
    """The paths of a figure, and its axes."""
    root = ElementTree.fromstring(html)
    facts = json.loads(unescape(root.attrib["data-axes"]))
    return [each for each in root.iter("path") if "data-n" in each.attrib], facts


def test_an_envelope_keeps_every_extreme() -> None:
    rng = np.random.default_rng(3)
    y = rng.normal(size=100_000)
    y[[12_345, 67_890]] = 9.0, -8.0
    kept = envelope(y)
    assert len(kept) <= 2 * BINS + 2 and np.all(np.diff(kept) > 0)
    assert {0, len(y) - 1, 12_345, 67_890} <= set(kept.tolist())
    edges = np.linspace(0, len(y), BINS + 1).astype(int)
    for low, high in pairwise(edges):
        inside = kept[(kept >= low) & (kept < high)]
        assert y[inside].max() == y[low:high].max() and y[inside].min() == y[low:high].min()


@pytest.mark.parametrize("M", [0, 1, 2, 2 * BINS, 2 * BINS + 1, 5003])
def test_an_envelope_of_any_length_has_its_ends(M: int) -> None:
    kept = envelope(np.sin(np.arange(M)))
    assert len(kept) == min(M, len(kept)) and (M == 0 or (kept[0], kept[-1]) == (0, M - 1))
    assert M > 2 * BINS or len(kept) == M


def test_what_is_not_finite_breaks_a_line_and_hides_no_peak() -> None:
    x = np.linspace(0.0, 1.0, 10_000)
    y = np.sin(20 * x)
    y[4000:6000] = np.nan
    y[7000] = np.inf
    y[3999] = 5.0
    parts = points(path(x, y, Axis(0.0, 1.0), Axis(-1.0, 5.0)))
    assert len(parts) == 3
    assert parts[0][-1].tolist() == [round(ACROSS * x[3999]), 0.0]
    assert not any(np.any((part[:, 0] > 0.405 * ACROSS) & (part[:, 0] < 0.595 * ACROSS)) for part in parts)


def test_paths_lie_where_the_numbers_are() -> None:
    x, y = np.linspace(2.0, 4.0, 41), np.geomspace(1e-3, 10.0, 41)
    paths, facts = drawn(figure(Panel("y, m", (Line("w", x, y),), log=True)))
    (low, high, log), (left, right, _) = facts["y"], facts["x"]
    assert log and (left, right) == (2.0, 4.0)
    (part,) = points(paths[0].attrib["d"])
    assert np.allclose(left + (right - left) * part[:, 0] / ACROSS, x, atol=(right - left) / ACROSS)
    assert np.allclose(np.log(low) + np.log(high / low) * (1 - part[:, 1] / DOWN), np.log(y), atol=1e-2)


@pytest.mark.parametrize(
    ("x", "y"),
    [
        (np.zeros(0), np.zeros(0)),
        (np.array([1.0]), np.array([3.0])),
        (np.arange(5.0), np.full(5, 7.0)),
        (np.arange(5.0), np.full(5, 0.0)),
        (np.arange(5.0), np.full(5, np.nan)),
        (np.arange(5.0), np.array([1e300, -1e300, 1e-300, np.inf, 0.0])),
        (np.arange(5.0), 1e6 + 1e-9 * np.arange(5.0)),
    ],
)
@pytest.mark.parametrize("log", [False, True])
def test_any_numbers_are_drawn(x: np.ndarray, y: np.ndarray, log: bool) -> None:
    with np.errstate(over="ignore", invalid="ignore"):
        html = figure(Panel("y, m", (Line("w", x, y),), log=log))
    ElementTree.fromstring(html)
    assert "nan" not in html.lower() and "inf" not in html.lower()


def test_names_and_quantities_are_escaped() -> None:
    x = np.arange(3.0)
    evil = '<script>alert("&")</script>'
    marks = (Mark(1.0, 1.0, evil),)
    panel = Panel(evil, (Line(evil, x, x, tag=evil),), note=evil, abscissa=evil, marks=marks, shaded=((0.0, 1.0),))
    html = charts([panel])
    assert "<script" not in html
    root = ElementTree.fromstring(html)
    assert evil in {each.attrib.get("data-n") for each in root.iter()}


def test_a_figure_says_in_words_what_is_seen() -> None:
    x = np.linspace(0.0, 2.0, 9)
    (picture,) = (
        each
        for each in ElementTree.fromstring(figure(Panel("speed, rpm", family(["w1"], x, x[:, None])))).iter()
        if each.attrib.get("role") == "img"
    )
    assert picture.attrib["aria-label"] == "speed, rpm over t, s from 0 to 2: w1 0 to 2"


def test_colours_are_those_of_the_page() -> None:
    x = np.arange(4.0)
    lines = (*family([f"w{i}" for i in range(10)], x, np.tile(x[:, None], 10)), border("limit", 2.0, 0.0, 3.0))
    found = figure(Panel("speed, rpm", lines)) + template("report_chart.css.j2").render()
    assert not re.search(r"#[0-9a-fA-F]{3,8}\b|rgb|hsl", found)
    known = {"--ink", "--muted", "--faint", "--paper", "--panel", "--line", "--accent", "--warn"}
    assert set(re.findall(r"var\((--[a-z0-9]+)\)", found)) <= known | {f"--c{i}" for i in range(1, 9)}


def test_many_lines_are_a_band_with_the_furthest_by_name() -> None:
    x = np.linspace(0.0, 1.0, 101)
    values = np.sin(x[:, None] + np.arange(64)) + 0.01 * np.arange(64)
    values[50, 17], values[30, 40] = 30.0, -20.0
    lines = family([f"w{i}" for i in range(64)], x, values)
    band, kept = condensed(lines)
    assert band is not None and band.count == 64 and len(kept) == NAMED
    assert {"w17", "w40"} <= {line.name for line in kept}
    assert np.array_equal(band.high, values.max(axis=1)) and np.array_equal(band.low, values.min(axis=1))
    html = figure(Panel("speed, rpm", lines))
    assert html.count("<li>") == NAMED + 1 and "all 64" in html
    assert condensed(lines[:MOST]) == (None, lines[:MOST])


@pytest.mark.parametrize(("low", "high"), [(0.0, 1.0), (-3e-7, 2e-7), (0.02, 0.021), (1e5, 9e6), (-41.0, -40.0)])
def test_ticks_are_round_and_inside(low: float, high: float) -> None:
    own = Axis(low, high)
    ticks, labels = own.ticks(5), own.labels(own.ticks(5))
    assert 2 <= len(ticks) <= 7 and all(low - 1e-12 <= x <= high + 1e-12 for x in ticks)
    shown = [10.0 ** own.factor() * float(label.replace("−", "-")) for label in labels]
    assert np.allclose(shown, ticks, rtol=1e-9, atol=1e-12 * (high - low)) and len(set(labels)) == len(labels)


@pytest.mark.parametrize(("low", "high"), [(1e-17, 1e-12), (6.0, 40.0), (1.0, 1000.0), (1e-3, 2e9)])
def test_ticks_of_powers_of_ten(low: float, high: float) -> None:
    ticks = Axis(low, high, True).ticks(5)
    assert 2 <= len(ticks) <= 12 and all(low <= x <= high for x in ticks)


def test_an_axis_holds_what_it_shows() -> None:
    y = np.array([1.0, np.nan, 4.0])
    own = axis([y])
    assert own.low < 1.0 and own.high > 4.0
    assert axis([np.array([1e-9])], least=1e-3) == Axis(-1e-3, 1e-3)
    assert axis([np.array([1e-30, 1.0])], log=True).low > 1e-14


def test_prefixes() -> None:
    assert prefixed(2300.0, "N") == (1e-3, "kN")
    assert prefixed(999.0, "N") == (1.0, "N")
    assert prefixed(1e-3, "N m") == (1e3, "mN m")
    assert prefixed(0.0, "N") == (1.0, "N")


def test_some_rows_have_both_ends() -> None:
    assert some_rows(10_001, 1500)[[0, -1]].tolist() == [0, 10_000] and len(some_rows(10_001, 1500)) <= 1502
    assert some_rows(1, 1500).tolist() == [0] and some_rows(3, 1500).tolist() == [0, 1, 2]
