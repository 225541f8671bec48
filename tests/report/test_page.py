"""The page of a stand: no peak is lost, text is escaped, nothing is loaded, small; pictures of columns."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

from cli.run import run
from mahovik import stands
from mahovik.contract.quantities import RPM
from mahovik.core.stand import load
from mahovik.out.api.stands import Stand
from mahovik.out.commands.check import check
from mahovik.out.commands.report import limits_part, modes_part, report, requirements_part, vibration_part
from mahovik.out.plots import BINS, Line, Panel, column_panels, draw, envelope, make_figure
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


def test_a_picture_has_the_texts_of_matplotlib_and_is_the_same_again() -> None:
    """Ticks of steps of 0.005 and names with many digits; places in the drawing have two."""
    x = np.linspace(0.0, 1.0, 7)
    panels = [Panel("y 0.12345", (Line("1.00001", x, 0.025 * x), Line("x < 0.125", x, 0.01 * x)))]
    with matplotlib.rc_context({"svg.fonttype": "none"}):
        figure, _ = make_figure(Figure, "", panels)
        figure.draw_without_rendering()
    drawn = str(picture(panels))
    texts = set(map(unescape, re.findall(r"<text[^>]*>([^<]*)</text>", drawn)))
    assert {"0.005", "0.020", "1.00001"} < texts < {text.get_text() for text in figure.findobj(Text)}
    assert not re.search(r"\d\.\d{3}", re.sub(r">[^<]*<|label=\S+ \S+", "><", drawn)) and drawn == picture(panels)


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


T = np.linspace(0.0, 3.0, 31)
TIME = ("t", "s", T)


def shown(*columns: tuple[str, str, object], index: tuple[str, str, object] = TIME) -> dict[str, Panel]:
    return {panel.quantity: panel for panel in column_panels(index, columns)}


def test_a_run_has_speeds_in_rpm_and_angles_in_degrees() -> None:
    wheels = [("phi_dot w1", "rad/s", 10.0 * T), ("phi_dot w2", "rad/s", T), ("tau w1", "N m", 0.5 * T)]
    panels = shown(("x", "m", 1e-3 * T), ("y", "m", 0.0 * T), *wheels, ("phi w1", "rad", T), ("psi", "rad", T))
    assert list(panels) == ["place of O1, m", "speed of the flywheels, rpm", "drive torque, N m", "attitude, deg"]
    speeds = panels["speed of the flywheels, rpm"].lines
    assert [line.name for line in speeds] == ["w1", "w2"] and speeds[0].y[-1] == pytest.approx(30.0 * RPM)
    assert panels["attitude, deg"].lines[0].y[-1] == pytest.approx(np.degrees(3.0))


def test_what_is_required_is_dashed_in_the_colour_of_what_is_reached() -> None:
    (panel,) = shown(("x", "m", T), ("z", "m", 2 * T), ("required x", "m", T), ("required z", "m", T)).values()
    assert [line.dashed for line in panel.lines] == [False, False, True, True]
    assert [line.colour for line in panel.lines] == [0, 1, 0, 1]
    assert panel.lines[2].name == "x, required"


def test_of_a_held_run_what_moves_and_the_reaction_are_shown() -> None:
    zero, angle = 0.0 * T, 2.0 * np.pi * T  # three whole turns
    columns = [(f"v_{a}", "m/s", zero) for a in "xyz"]
    columns += [("qw", "", np.cos(angle / 2)), ("qx", "", zero), ("qy", "", np.sin(angle / 2)), ("qz", "", zero)]
    columns += [(f"hold.reaction.{a}", "N", T) for a in "xyz"] + [(f"hold.reaction.{a}", "N m", zero) for a in "kmn"]
    panels = shown(*columns)
    assert list(panels) == ["attitude as a rotation vector, in E0, deg", "reaction of the hold, in E1 about O1, N"]
    assert np.abs(next(iter(panels.values())).lines[1].y - np.degrees(angle)).max() < 1e-9
    held = shown(*columns, ("q pitch", "rad", angle), ("q_dot pitch", "rad/s", T))
    assert list(held) == [list(panels)[1], "freedoms, deg", "rates of the freedoms, rad/s"]
    follows = shown(("q pitch", "rad", angle), ("required pitch", "rad", angle))
    assert [line.name for line in follows["freedoms, deg"].lines] == ["pitch", "pitch, required"]


def test_other_columns_are_stems() -> None:
    index = ("frequency", "Hz", np.array([10.0, 20.0]))
    (panel,) = shown(("x", "N", np.array([1.0, 0.5])), index=index).values()
    assert panel.lines[0].x.tolist() == [10.0] * 3 + [20.0] * 3 and panel.abscissa == "frequency, Hz"
    assert panel.lines[0].y[:2].tolist() == [0.0, 1.0] and np.isnan(panel.lines[0].y[2])


def test_an_envelope_keeps_every_extreme() -> None:
    rng = np.random.default_rng(3)
    y = rng.normal(size=100_000)
    y[[12_345, 67_890]] = 9.0, -8.0
    y[500:510] = np.nan
    kept = envelope(y)
    assert len(kept) <= 3 * BINS + 2 and np.all(np.diff(kept) > 0)
    assert {0, len(y) - 1, 12_345, 67_890} <= set(kept.tolist()) and np.isnan(y[kept]).any()
    for part in np.array_split(np.arange(len(y)), BINS):
        low, high = int(part[0]), int(part[-1]) + 1
        inside = kept[(kept >= low) & (kept < high)]
        assert np.nanmax(y[inside]) == np.nanmax(y[low:high]) and np.nanmin(y[inside]) == np.nanmin(y[low:high])


def test_the_same_panels_give_the_same_bytes() -> None:
    panels = [Panel("y", (Line("a", T, T),)), Panel("log", (Line("b", T, T + 1.0),), log=True)]
    first = draw("title", panels, ".svg")
    assert first == draw("title", panels, ".svg") and first.startswith(b"<?xml") and b"dc:date" not in first
    assert draw("title", panels, ".png").startswith(b"\x89PNG")


def test_a_command_writes_its_picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    sweep = ("vibration", str(stands.path("shaker2")), "--speed", "all=100..200rpm", "--steps", "2", "--at", "carrier")
    assert run(*sweep, "-o", "r.svg").exit_code == 0
    Path("spin.toml").write_text("schema = 1\ndefault = { speed = 20 }\n", encoding="utf-8")
    motion = ("simulate", str(stands.path("demo3")), "--until", "0.02", "--regime", "spin.toml", "--backend", "scipy")
    assert run(*motion, "-o", "m.svg").exit_code == 0
    assert all(Path(name).read_bytes().startswith(b"<?xml") for name in ("r.svg", "m.svg"))
