"""Charts in the browser: numbers under the pointer are those that were drawn; nothing is wider than the page."""

import json
from pathlib import Path

import numpy as np
import pytest

from mahovik.core.emit.templates import template
from mahovik.out.report.plot.inline import charts
from mahovik.out.report.plot.panel import Line, Panel

from .chromium import Opened

READING = "[...document.querySelectorAll('.reading tr')].map((row) => [...row.cells].map((cell) => cell.textContent))"
LABEL = "svg[aria-label^='{}']"


def read(page, label, share):
    """What the chart whose words begin with `label` tells at a share of its width."""
    picture = page.locator(LABEL.format(label))
    picture.scroll_into_view_if_needed()
    move(page, picture, share)
    return {name: float(value.replace("\N{MINUS SIGN}", "-")) for name, value in page.evaluate(READING)}


def move(page, picture, share) -> None:
    """Move the pointer to a share of the frame's width, in the middle of its height."""
    box = picture.bounding_box()
    left, _, across, _ = json.loads(picture.locator("xpath=../..").get_attribute("data-axes"))["box"]
    unit = box["width"] / float(picture.get_attribute("viewBox").split()[2])
    page.mouse.move(box["x"] + unit * (left + share * across), box["y"] + 0.5 * box["height"])


def test_values_under_the_pointer(opened) -> None:
    page = opened("bench8").page
    found = read(page, "O1, mm, from the start", 0.5)
    t = found["t"]
    assert t == pytest.approx(0.2, abs=0.002)  # half of the run
    for k, axis in enumerate("xyz"):
        expected = 1e3 * 3e-5 * (np.sin(60.0 * t + k) - np.sin(k))
        assert found[axis] == pytest.approx(expected, abs=1e-3)
    speeds = read(page, "speed, rpm", 0.9)
    assert speeds["w3"] == pytest.approx(110.0 * 30.0 / np.pi, rel=1e-3)


def test_of_an_envelope_least_and_largest_are_told(browser, tmp_path: Path) -> None:
    t = np.linspace(0.0, 1.0, 100_000)
    panel = Panel("y, m", (Line("a", t, 3.0 * np.sin(1e4 * t)), Line("b", t, 2.0 + 0.0 * t)))
    script = template("report_chart.js.j2").render()
    style = template("report_chart.css.j2").render()
    path = tmp_path / "chart.html"
    path.write_text(f"<!DOCTYPE html><style>{style}</style>{charts([panel])}<script>{script}</script>", "utf-8")
    page = Opened(browser, path).page
    move(page, page.locator("svg[role]"), 0.25)
    assert page.evaluate(READING) == [["t", "0.25"], ["a", "\N{MINUS SIGN}3 \N{HORIZONTAL ELLIPSIS} 3"], ["b", "2"]]


def test_the_reading_goes_with_the_pointer(opened) -> None:
    page = opened("bench8").page
    assert read(page, "O1, mm, from the start", 0.3)
    page.mouse.move(1, 1)
    assert page.evaluate(READING) == []


@pytest.mark.parametrize("width", [360, 1300])
def test_charts_fit(opened, width: int) -> None:
    page = opened("bench8", viewport={"width": width, "height": 800}).page
    right = (
        "Math.max(...[...document.querySelectorAll('.chart, .chart *')].map((e) => e.getBoundingClientRect().right))"
    )
    assert page.evaluate(right) <= width
    sizes = page.evaluate(
        "[...document.querySelectorAll('.chart .frame text')].map((text) => parseFloat(getComputedStyle(text).fontSize)"
        " * text.ownerSVGElement.getBoundingClientRect().width / text.ownerSVGElement.viewBox.baseVal.width)"
    )
    assert len(sizes) > 50 and min(sizes) >= 11.0


def test_lines_change_with_the_theme(opened) -> None:
    page = opened("bench8", color_scheme="light").page
    stroke = "getComputedStyle(document.querySelector('.chart .line path')).stroke"
    light = page.evaluate(stroke)
    page.evaluate("document.getElementById('theme').click()")
    assert page.evaluate(stroke) != light
