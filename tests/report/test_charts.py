"""Charts of pages: no peak is lost, lines lie where the numbers are, text is escaped, nothing is loaded."""

from __future__ import annotations

import json
import re
from html import unescape
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from mahovik.core.stand import load
from mahovik.out.report.data.page import Part, data_page, write_data_page
from mahovik.out.report.data.panels import confidence_ellipse, order_spectra, waterfall
from mahovik.out.report.plot.inline import charts, figure
from mahovik.out.report.plot.panel import (
    BINS,
    Line,
    Mark,
    Panel,
    envelope,
)
from mahovik.stands import path
from mahovik.use.measured.orders import OrderMap


def figure_lines(html: str) -> tuple[dict[str, list[np.ndarray]], dict[str, Any]]:
    """Lines of a figure by name, each in parts (n, 2) as its script reads them, and the facts of its axes."""
    root = ElementTree.fromstring(html)
    facts = json.loads(unescape(root.attrib["data-axes"]))
    left, top, across, down = facts["box"]
    polylines = {}
    for group in (element for element in root.iter() if "data-n" in element.attrib):
        parts = [
            np.array(re.findall(r"-?[\d.]+", p), float).reshape(-1, 2) for p in group[0].attrib["d"].split("M")[1:]
        ]
        polylines[group.attrib["data-n"]] = [(p - [left, top]) / [across, -down] + [0.0, 1.0] for p in parts]
    return polylines, facts


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


def test_names_and_quantities_are_escaped() -> None:
    x = np.arange(3.0)
    evil = '<script>alert("&")</script>'
    marks = (Mark(1.0, 1.0, evil),)
    panel = Panel(evil, (Line(evil, x, x, tag=evil),), note=evil, abscissa=evil, marks=marks, shaded=((0.0, 1.0),))
    html = charts([panel])
    assert "<script" not in html
    root = ElementTree.fromstring(html)
    assert evil in {element.attrib.get("data-n") for element in root.iter()}


ORDERS = np.arange(1, 33) / 8.0


def peak(speed: list[float], size: float) -> OrderMap:
    """A map with one amplitude at order 1."""
    amplitude = np.full((len(speed), len(ORDERS)), 1e-6)
    amplitude[:, ORDERS == 1.0] = size
    return OrderMap("w1", "acc1.acceleration.x", "m/s2", np.array(speed), ORDERS, amplitude)


def test_the_ellipse_holds_95_percent_of_its_distribution() -> None:
    centre, covariance = np.array([100.0, -5.0]), np.array([[4.0, -1.5], [-1.5, 1.0]])
    panel = confidence_ellipse("w1", ("y, g mm", "z, g mm"), centre, covariance)
    high, low = panel.lines
    drawn = np.random.default_rng(3).multivariate_normal(centre, covariance, 20_000)
    x, y = drawn.T
    top = np.interp(x, high.x, high.y, left=np.nan, right=np.nan)
    bottom = np.interp(x, low.x, low.y, left=np.nan, right=np.nan)
    assert abs(np.mean((y < top) & (y > bottom)) - 0.95) < 0.006
    assert panel.span is not None
    assert panel.span[0] < high.x.min()
    assert panel.span[1] > high.x.max()


def test_the_page_escapes_text_and_loads_nothing(tmp_path: Path) -> None:
    stand = load(path("bench8"))
    spectra = {"before": np.linspace(1.0, 0.1, 32), "after": np.zeros(32)}
    panels = (order_spectra("rms", "m/s2", ORDERS, spectra, "w1"), waterfall({"measured": peak([10.0], 1.0)}))
    part = Part("Flywheel <w1>", "Words <b>.", ("name", "x, m>"), (("<i>", "1"),), panels, ("a <note>",), "sum <u>")
    write_data_page(tmp_path / "p.html", "run <1>", [part], stand=stand, files=[("data", "run<1>.csv")])
    html = (tmp_path / "p.html").read_text(encoding="utf-8")
    assert html == data_page("run <1>", [part], stand, [("data", "run<1>.csv")])
    for bad in ("<w1>", "<b>", "<i>", "<note>", "<u>", "<1>"):
        assert bad not in html
    assert not re.search(r"(src|href)=\"https?:", html)
    assert html.count('<figure class="chart"') == 2
