"""The page of a stand: no peak is lost, text is escaped, nothing is loaded, small; parts say what there is to say."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.stand import load
from mahovik.out.api.stands import Stand
from mahovik.out.commands.check import check
from mahovik.out.commands.report import limits_part, modes_part, report, requirements_part, vibration_part
from mahovik.out.plots import Line, Panel
from mahovik.out.report.page import Part, page, picture
from mahovik.out.result import Result, column
from report.chromium import Opened, launched
from report.reports import read, words

HELD = Path(__file__).resolve().parents[2] / "docs" / "held"


def stand_of(name: str) -> Stand:
    file = HELD / f"{name}.toml" if (HELD / f"{name}.toml").exists() else stands.path(name)
    return Stand.of(load(file))


def test_text_is_escaped_and_nothing_is_loaded() -> None:
    evil, x = '<script>alert("&")</script>', np.arange(3.0)
    drawn = (Panel(evil, (Line(evil, x, x, tag=evil),), note=evil, abscissa=evil, marks=((1.0, 1.0),)),)
    rows = Result(evil, (column(evil, "", [evil]), column("n", "kg", [1.0])))
    part = Part(evil, f"{evil} `{evil}`", (rows,), drawn, notes=(evil,), summary=evil, failures=(evil,))
    stand = load(stands.path("bench8"))
    html = page(evil, [part], stand, [("data", evil)])
    assert "<script" not in html and read(html).wrong == []
    addresses = re.sub(r'(xmlns(:\w+)?|about)="http[^"]*"', "", html)  # names, which nobody asks for
    assert not re.search(r"(https?:|file:|@import|//[a-z])", addresses)


def test_a_picture_is_the_same_text_again() -> None:
    x = np.linspace(0.0, 1.0, 7)
    assert picture([Panel("y", (Line("a", x, x),))]) == picture([Panel("y", (Line("a", x, x),))])


def test_vibration_and_requirements_at_points() -> None:
    stand = stand_of("sat4")
    part = requirements_part(stand, "acc1", ("rms 1 arcsec", "rms 1e-9 arcsec"))
    assert part is not None and part.failures == ("acc1: rms 1e-9 arcsec is not met",)
    assert part.tables[0]["verdict"].tolist() == ["met", "FAILED"]
    assert '<span class="bad">FAILED</span>' in part.markup
    seen = vibration_part(stand, ("carrier", "acc1"))
    assert seen is not None and len(seen.panels) == 2 and "carrier at most" in seen.summary
    limits = limits_part(check(stand))
    assert limits is not None and "19.6 N m s in every direction" in limits.summary


@pytest.mark.parametrize(
    ("name", "modes", "vibration"),
    [
        ("demo3", "", "Nothing shakes carrier: the flywheels are balanced."),
        ("remus6", "no pose to be linear about", "there is no steady vibration to show"),
        ("force_table", None, "hold.reaction at most"),
    ],
)
def test_what_cannot_be_shown_is_said(name: str, modes: str | None, vibration: str) -> None:
    stand = stand_of(name)
    swinging = modes_part(stand)
    shaking = vibration_part(stand, ["carrier" if stand.hold is None else "hold.reaction"])
    assert (swinging is None) is (modes is None)
    assert swinging is None or modes is None or modes in swinging.words
    assert shaking is not None
    assert vibration in " ".join([shaking.words, *shaking.notes, shaking.summary])


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::mahovik.MahovikWarning")
@pytest.mark.parametrize("name", [*stands.names(), "cube"])
def test_four_screens_without_requests_or_overflow(name: str, tmp_path: Path) -> None:
    """Light, dark, on a phone and on paper; at most 300 kB."""
    file = tmp_path / "page.html"
    assert report(stand_of(name), output=file).ok and file.stat().st_size < 300_000
    html = file.read_text(encoding="utf-8")
    assert read(html).wrong == [] and stand_of(name).name in words(html)
    with launched() as browser:
        opened = Opened(browser, file, viewport={"width": 1280, "height": 900}, color_scheme="dark")
        shown = opened.page
        assert shown.evaluate("document.scrollingElement.scrollHeight") <= 4 * 900
        shown.set_viewport_size({"width": 320, "height": 800})
        assert shown.evaluate("document.scrollingElement.scrollWidth") <= 320
        shown.emulate_media(media="print", color_scheme="dark")
        assert shown.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
        assert opened.complaints == [] and opened.requests == [opened.address]
        opened.context.close()
