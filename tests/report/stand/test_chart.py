"""Charts: no peak is lost, paths lie where the numbers are, names are escaped, colours are those of the page."""

from __future__ import annotations

import json
import re
from html import unescape
from itertools import pairwise
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from mahovik.core.emit.templates import template
from mahovik.out.report.plot.draw import decimal
from mahovik.out.report.plot.inline import charts, figure
from mahovik.out.report.plot.panel import (
    BINS,
    MOST,
    NAMED_LINES,
    Line,
    Mark,
    Panel,
    border,
    condense_lines,
    envelope,
    extent,
    family,
    si_prefix,
)
from mahovik.out.report.stand.run import some_rows


def figure_lines(html: str) -> tuple[dict[str, list[np.ndarray]], dict[str, Any]]:
    """Lines of a figure by name, each in parts (n, 2) as its script reads them, and the facts of its axes."""
    root = ElementTree.fromstring(html)
    facts = json.loads(unescape(root.attrib["data-axes"]))
    left, top, across, down = facts["box"]
    found = {}
    for group in (each for each in root.iter() if "data-n" in each.attrib):
        parts = [
            np.array(re.findall(r"-?[\d.]+", p), float).reshape(-1, 2) for p in group[0].attrib["d"].split("M")[1:]
        ]
        found[group.attrib["data-n"]] = [(p - [left, top]) / [across, -down] + [0.0, 1.0] for p in parts]
    return found, facts


def axis_values(share: np.ndarray, low: float, high: float, log: int) -> np.ndarray:
    """Values at shares of an axis."""
    return low * (high / low) ** share if log else low + (high - low) * share


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
    lines, facts = figure_lines(figure(Panel("y, m", (Line("w", x, y),))))
    parts = lines["w"]
    assert len(parts) == 3
    peak = axis_values(parts[0][:, 1], *facts["y"]).argmax()
    assert axis_values(parts[0][peak], *facts["y"])[1] == pytest.approx(5.0, abs=0.01)
    assert parts[0][peak, 0] == pytest.approx(x[3999], abs=1e-3)
    assert not any(np.any((part[:, 0] > 0.405) & (part[:, 0] < 0.595)) for part in parts)


def test_paths_lie_where_the_numbers_are() -> None:
    x, y = np.linspace(2.0, 4.0, 41), np.geomspace(1e-3, 10.0, 41) * (2.0 + np.sin(np.arange(41)))
    lines, facts = figure_lines(figure(Panel("y, m", (Line("w", x, y),), log=True)))
    assert facts["y"][2] and facts["x"][:2] == [2.0, 4.0]
    (part,) = lines["w"]
    assert np.allclose(axis_values(part[:, 0], *facts["x"]), x, atol=1e-4)
    assert np.allclose(np.log(axis_values(part[:, 1], *facts["y"])), np.log(y), atol=1e-2)


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
    assert not re.search(r"\b(nan|inf)\b", html.lower())


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
    band, kept = condense_lines(lines)
    assert band is not None and band.count == 64 and len(kept) == NAMED_LINES
    assert {"w17", "w40"} <= {line.name for line in kept}
    assert np.array_equal(band.high, values.max(axis=1)) and np.array_equal(band.low, values.min(axis=1))
    html = figure(Panel("speed, rpm", lines))
    assert html.count("<li>") == NAMED_LINES + 1 and "all 64" in html
    assert condense_lines(lines[:MOST]) == (None, lines[:MOST])


@pytest.mark.parametrize(("low", "high"), [(1e-17, 1e-12), (6.0, 40.0), (1.0, 1000.0), (1e-3, 2e9), (10.8, 12.0)])
def test_an_axis_of_powers_of_ten_has_labels(low: float, high: float) -> None:
    x = np.geomspace(low, high, 9)
    html = figure(Panel("y, m", (Line("w", np.arange(9.0), x),), log=True))
    labels = re.findall(r"text-anchor: end[^>]*>([^<]*)<", html)
    assert 1 <= len(labels) <= 12 and len(set(labels)) == len(labels)


def test_numbers_of_one_digit() -> None:
    assert [decimal(x) for x in (0.02, 500.0, 1e-7, 5e-7, 1e9)] == ["0.02", "500", "10⁻⁷", "5·10⁻⁷", "10⁹"]


def test_an_axis_holds_what_it_shows() -> None:
    low, high = extent([np.array([1.0, np.nan, 4.0])])
    assert low < 1.0 and high > 4.0
    assert extent([np.array([1e-9])], least=1e-3) == (-1e-3, 1e-3)
    assert extent([np.array([1e-30, 1.0])], log=True)[0] > 1e-14


def test_no_two_figures_share_a_name() -> None:
    x = np.arange(4.0)
    html = charts([Panel(name, (Line("w", x, k * x),)) for k, name in enumerate(("a", "b"), start=1)])
    names = re.findall(r' id="([^"]+)"', html)
    assert names and len(set(names)) == len(names)
    assert set(re.findall(r'(?:href="|url\()#([\w-]+)', html)) <= set(names)


def test_prefixes() -> None:
    assert si_prefix(2300.0, "N") == (1e-3, "kN")
    assert si_prefix(999.0, "N") == (1.0, "N")
    assert si_prefix(1e-3, "N m") == (1e3, "mN m")
    assert si_prefix(0.0, "N") == (1.0, "N")


def test_some_rows_have_both_ends() -> None:
    assert some_rows(10_001, 1500)[[0, -1]].tolist() == [0, 10_000] and len(some_rows(10_001, 1500)) <= 1502
    assert some_rows(1, 1500).tolist() == [0] and some_rows(3, 1500).tolist() == [0, 1, 2]
