"""The report in a browser: no script error, nothing loaded, right numbers under the pointer, on a phone, on paper."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.out.report.stand.material import gather
from mahovik.out.report.stand.run import Run
from mahovik.stands import path
from mahovik.use.simulate.run import column_names
from report.chromium import Opened, box_of, launched

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = pytest.mark.slow

HELD = Path(__file__).resolve().parents[2] / "docs" / "held" / "cube.toml"
READING = """(chart) => [...chart.querySelectorAll('.u-series:not(.edge)')].map((row) =>
    [row.querySelector('.u-label').textContent, row.querySelector('.u-value').textContent])"""


def vibrating_run(stand: Stand, amplitude: float = 3e-5) -> Run:
    """A run that no simulation has made: the carrier vibrates by tens of micrometres, flywheels turn evenly."""
    t = np.linspace(0.0, 0.4, 400)
    columns = {name: np.sin(40.0 * t + i) for i, name in enumerate(column_names(stand, False))}
    turn = amplitude * np.sin(60.0 * t)
    columns |= {"t [s]": t, "qw": np.sqrt(1 - turn**2), "qx": turn, "qy": 0 * t, "qz": 0 * t}
    columns |= {f"{a} [m]": amplitude * np.sin(60.0 * t + k) for k, a in enumerate("xyz")}
    for s, wheel in enumerate(stand.flywheels):
        speed = 100.0 + 5.0 * s
        columns |= {f"phi {wheel.name} [rad]": speed * t + s, f"phi_dot {wheel.name} [rad/s]": 0 * t + speed}
    return Run("made.csv", tuple(wheel.name for wheel in stand.flywheels), columns)


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Headless Chromium."""
    with launched() as chromium:
        yield chromium


@pytest.fixture(scope="module", params=["bench8", "held"])
def report(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A whole report: of bench8 with a run, of a held cube."""
    file = tmp_path_factory.mktemp("reports") / "report.html"
    stand = load(path("bench8") if request.param == "bench8" else HELD)
    material = gather(stand, f"{stand.name}.toml")
    if request.param == "bench8":
        material = replace(material, run=vibrating_run(stand))
    page = import_module("mahovik.out.report.stand.page").page(material)
    file.write_text(page.html, encoding="utf-8")
    return file


def test_no_errors_no_requests_and_no_overflow(browser: Browser, report: Path) -> None:
    """On a phone what is wide scrolls in its own frame; on paper closed parts are open, and controls left out."""
    opened = Opened(browser, report, viewport={"width": 320, "height": 800}, color_scheme="dark")
    page = opened.page
    assert page.evaluate("document.scrollingElement.scrollWidth") <= 320
    page.emulate_media(media="print", color_scheme="dark")
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert not page.locator("#theme").is_visible()
    page.pdf()
    assert page.evaluate("[...document.querySelectorAll('details')].every((each) => each.open)")
    assert opened.complaints == []
    assert opened.requests == [opened.address]
    assert report.stat().st_size < 3e6
    opened.context.close()


def read(page: Page, label: str, share: float) -> dict[str, float]:
    """Values that a chart shows at a share of its width."""
    chart = page.locator(f"figure.chart:has(.uplot[aria-label^='{label}'])").first
    chart.scroll_into_view_if_needed()
    box = box_of(chart.locator(".u-over"))
    page.mouse.move(box["x"] + share * box["width"], box["y"] + 0.5 * box["height"])
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return {name: float(value.replace("\N{MINUS SIGN}", "-")) for name, value in chart.evaluate(READING)}


@pytest.mark.parametrize("report", ["bench8"], indirect=True)
def test_values_under_the_pointer(browser: Browser, report: Path) -> None:
    opened = Opened(browser, report)
    values = read(opened.page, "O1, mm, from the start", 0.5)
    t = values["t"]
    assert t == pytest.approx(0.2, abs=0.002)  # half of the run
    for k, axis in enumerate("xyz"):
        expected = 1e3 * 3e-5 * (np.sin(60.0 * t + k) - np.sin(k))
        assert values[axis] == pytest.approx(expected, abs=1e-3)
    speeds = read(opened.page, "speed, rpm", 0.9)
    assert speeds["w3"] == pytest.approx(110.0 * 30.0 / np.pi, rel=1e-3)
    opened.context.close()
