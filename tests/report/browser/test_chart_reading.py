"""Charts in the browser: numbers under the pointer are those that were drawn; nothing is wider than the page."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from report.browser.chromium import box_of
from report.browser.conftest import Opener

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

pytestmark = pytest.mark.slow

READING = """(chart) => [...chart.querySelectorAll('.u-series:not(.edge)')].map((row) =>
    [row.querySelector('.u-label').textContent, row.querySelector('.u-value').textContent])"""


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
