"""The page on measured data: what its charts show, and that text is escaped and nothing is loaded."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from mahovik.core.stand import load
from mahovik.out.report.data.page import Part, data_page, write_data_page
from mahovik.out.report.data.panels import confidence_ellipse, order_spectra, waterfall
from mahovik.stands import path
from mahovik.use.measured.orders import OrderMap

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


def test_the_waterfall_stands_at_its_speeds() -> None:
    """Three decades are two spectra high; the amplitude a decade below is a third lower."""
    speeds = [100.0, 200.0]
    panel = waterfall({"before": peak(speeds, 1.0), "after": peak(speeds, 0.1)})
    rpm = 30.0 / np.pi
    heights = [float(line.y.max() - line.y.min()) for line in panel.lines]
    assert heights[:2] == [heights[0]] * 2
    assert np.allclose(heights, 200.0 * rpm * np.array([1.0, 1.0, 2.0 / 3.0, 2.0 / 3.0]))
    assert [line.name for line in panel.lines] == ["before", "", "after", ""]
    assert [float(line.y.min()) for line in panel.lines[:2]] == [100.0 * rpm, 200.0 * rpm]


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
