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

from mahovik.out.report.plot.inline import charts, figure
from mahovik.out.report.plot.panel import (
    BINS,
    Line,
    Mark,
    Panel,
    envelope,
)


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
