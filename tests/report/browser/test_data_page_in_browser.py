"""The page on measured data in a browser: charts are drawn, nothing is loaded, no error is reported."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from mahovik.core.stand import load
from mahovik.out.report.data.page import Part, write_data_page
from mahovik.out.report.data.panels import confidence_ellipse, order_spectra, waterfall
from mahovik.stands import path
from mahovik.use.measured.orders import OrderMap
from report.browser.chromium import Opened

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = pytest.mark.slow

ORDERS = np.arange(1, 33) / 8.0

INK = """() => [...document.querySelectorAll("figure.chart canvas")].map((each) => {
    const { data } = each.getContext("2d").getImageData(0, 0, each.width, each.height);
    let coloured = 0;
    for (let k = 0; k < data.length; k += 4) {
        const [r, g, b, a] = data.slice(k, k + 4);
        coloured += a > 100 && Math.max(r, g, b) - Math.min(r, g, b) > 60;
    }
    return coloured;
})"""
"""Coloured pixels of each chart: those of its lines."""


def test_charts_are_drawn(browser: Browser, tmp_path: Path) -> None:
    """An ellipse too: both of its halves have an abscissa that rises."""
    speed = np.array([100.0, 200.0, 300.0])
    amplitude = np.exp(-(((ORDERS - 1.0) / 0.2) ** 2)) * speed[:, None]
    found = OrderMap("w1", "acc1.acceleration.x", "m/s2", speed, ORDERS, amplitude)
    panels = (
        waterfall({"measured": found, "modelled": found}),
        order_spectra("RMS", "m/s2", ORDERS, {"residual": found.spectrum}, "w1"),
        confidence_ellipse("Unbalance", ("y, g mm", "z, g mm"), np.array([9.0, 2.0]), np.diag([1.0, 2.0])),
    )
    write_data_page(tmp_path / "p.html", "run", [Part("w1", panels=panels)], stand=load(path("bench8")))
    opened = Opened(browser, tmp_path / "p.html")
    opened.wait_until("document.querySelectorAll('figure.chart canvas').length === 3")
    opened.page.wait_for_timeout(200)
    drawn = opened.page.evaluate(INK)
    assert all(pixels > 500 for pixels in drawn), drawn
    assert opened.complaints == []
    assert opened.requests == [opened.address]
