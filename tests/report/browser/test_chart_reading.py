"""Charts in the browser: numbers under the pointer are those that were drawn; nothing is wider than the page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from mahovik.core.emit.templates import source_text, template
from mahovik.out.report.plot.inline import charts
from mahovik.out.report.plot.panel import Line, Panel
from report.browser.chromium import Opened, box_of
from report.browser.conftest import Opener

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator, Page

pytestmark = pytest.mark.slow

READING = """(chart) => [...chart.querySelectorAll('.u-series:not(.edge)')].map((row) =>
    [row.querySelector('.u-label').textContent, row.querySelector('.u-value').textContent])"""
SCALES = "(chart) => ['x', 'y'].map((key) => [chart.plot.scales[key].min, chart.plot.scales[key].max])"


def chart_of(page: Page, label: str) -> Locator:
    """The chart whose label begins with `label`."""
    return page.locator(f"figure.chart:has(.uplot[aria-label^='{label}'])").first


def read(page: Page, label: str, share: float) -> dict[str, float]:
    """Values that a chart shows at a share of its width."""
    chart = chart_of(page, label)
    move(page, chart, share)
    return {name: float(value.replace("\N{MINUS SIGN}", "-")) for name, value in chart.evaluate(READING)}


def move(page: Page, chart: Locator, share: float, height: float = 0.5) -> None:
    """Move the pointer to shares of the frame's width and height."""
    chart.scroll_into_view_if_needed()
    box = box_of(chart.locator(".u-over"))
    page.mouse.move(box["x"] + share * box["width"], box["y"] + height * box["height"])
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def test_values_under_the_pointer(opened: Opener) -> None:
    page = opened("bench8").page
    found = read(page, "O1, mm, from the start", 0.5)
    t = found["t"]
    assert t == pytest.approx(0.2, abs=0.002)  # half of the run
    for k, axis in enumerate("xyz"):
        expected = 1e3 * 3e-5 * (np.sin(60.0 * t + k) - np.sin(k))
        assert found[axis] == pytest.approx(expected, abs=1e-3)
    speeds = read(page, "speed, rpm", 0.9)
    assert speeds["w3"] == pytest.approx(110.0 * 30.0 / np.pi, rel=1e-3)


def page_of(panels: list[Panel], path: Path) -> Path:
    """A page with these charts and their script alone."""
    script = source_text("uplot/uPlot.iife.min.js") + template("report_chart.js.j2").render()
    style = source_text("uplot/uPlot.min.css") + template("report_chart.css.j2").render()
    path.write_text(f"<!DOCTYPE html><style>{style}</style>{charts(panels)}<script>{script}</script>", "utf-8")
    return path


LABELS = "(chart) => chart.plot.axes[1]._values.filter((label) => label)"
ZOOMED = """(chart, ratio) => {
    const { min, max } = chart.plot.scales.y, middle = Math.sqrt(min * max);
    chart.plot.setScale('y', { min: middle / Math.sqrt(ratio), max: middle * Math.sqrt(ratio) });
    return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
}"""


def test_a_logarithmic_axis_may_begin_anywhere_and_has_labels(browser: Browser, tmp_path: Path) -> None:
    """Values of 0.1045 to 104 once made the script loop until it had no memory left."""
    ranges = [(0.1045, 104.0), (1e-17, 1e-12), (23.8, 4252.0), (3.1, 9.6), (10.8, 12.0), (2e7, 6e7), (1e-6, 2e9)]
    panels = [
        Panel(f"y{k}, m", (Line("a", np.arange(9.0), np.geomspace(low, high, 9)),), log=True)
        for k, (low, high) in enumerate(ranges)
    ]
    opened = Opened(browser, page_of(panels, tmp_path / "chart.html"))
    for k in range(len(ranges)):
        chart = chart_of(opened.page, f"y{k}, m")
        for ratio in (None, 50.0, 7.0, 1.3, 1.001):
            if ratio is not None:
                chart.evaluate(ZOOMED, ratio)
            labels = chart.evaluate(LABELS)
            assert 2 <= len(labels) <= 12, (ranges[k], ratio, labels)
            assert len(set(labels)) == len(labels)
    assert opened.complaints == []


def test_of_an_envelope_least_and_largest_are_told(browser: Browser, tmp_path: Path) -> None:
    t = np.linspace(0.0, 1.0, 100_000)
    panel = Panel("y, m", (Line("a", t, 3.0 * np.sin(1e4 * t)), Line("b", t, 2.0 + 0.0 * t)))
    page = Opened(browser, page_of([panel], tmp_path / "chart.html")).page
    move(page, chart_of(page, "y, m"), 0.25)
    (_, t_shown), (_, a), (_, b) = chart_of(page, "y, m").evaluate(READING)
    assert float(t_shown) == pytest.approx(0.25, abs=0.002)
    least, largest = (float(x.replace("\N{MINUS SIGN}", "-")) for x in a.split(" \N{HORIZONTAL ELLIPSIS} "))
    assert [least, largest] == pytest.approx([-3.0, 3.0], abs=0.01)
    assert b == "2"


def test_the_reading_goes_with_the_pointer(opened: Opener) -> None:
    page = opened("bench8").page
    assert read(page, "O1, mm, from the start", 0.3)
    page.mouse.move(1, 1)
    assert {value for _, value in chart_of(page, "O1, mm").evaluate(READING)} == {""}


def test_dragging_zooms_and_a_double_click_goes_back(opened: Opener) -> None:
    page = opened("bench8").page
    chart = chart_of(page, "O1, mm, from the start")
    whole = chart.evaluate(SCALES)
    move(page, chart, 0.25, 0.25)
    page.mouse.down()
    move(page, chart, 0.75, 0.75)
    page.mouse.up()
    for (low, high), (first, last) in zip(chart.evaluate(SCALES), whole, strict=True):
        assert [low, high] == pytest.approx(
            [first + share * (last - first) for share in (0.25, 0.75)], abs=0.02 * (last - first)
        )
    page.mouse.dblclick(*(box_of(chart.locator(".u-over"))[k] + 60 for k in ("x", "y")))
    assert chart.evaluate(SCALES) == whole


def test_without_scripts_the_drawing_stays(opened: Opener) -> None:
    page = opened("bench8", java_script_enabled=False).page
    assert page.locator("figure.chart .frame > svg").first.is_visible()
    assert page.locator(".uplot").count() == 0


@pytest.mark.parametrize("width", [360, 1300])
def test_charts_fit(opened: Opener, width: int) -> None:
    page = opened("bench8", viewport={"width": width, "height": 800}).page
    right = (
        "Math.max(...[...document.querySelectorAll('.chart, .chart *')].map((e) => e.getBoundingClientRect().right))"
    )
    assert page.evaluate(right) <= width
    sizes = page.evaluate(
        "[...document.querySelectorAll('figure.chart')].map((chart) => parseFloat(chart.plot.axes[0].font[1]))"
    )
    assert len(sizes) > 5 and min(sizes) >= 11.0


def test_lines_change_with_the_theme(opened: Opener) -> None:
    page = opened("bench8", color_scheme="light").page
    stroke = "getComputedStyle(document.querySelector('.chart .line path')).stroke"
    light = page.evaluate(stroke)
    drawn = "document.querySelector('.uplot canvas').toDataURL()"
    before = page.evaluate(drawn)
    page.evaluate("document.getElementById('theme').click()")
    assert page.evaluate(stroke) != light
    page.wait_for_function(f"(before) => {drawn} !== before", arg=before)
