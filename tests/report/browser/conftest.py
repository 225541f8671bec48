"""One browser and a few reports for all tests of this folder."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import BARE, Features, random_stand
from mahovik.out.report.stand.material import gather
from mahovik.out.report.stand.run import Run
from mahovik.stands import path
from mahovik.use.simulate.run import column_names
from report.browser.chromium import Opened, launched

if TYPE_CHECKING:
    from playwright.sync_api import Browser

Opener = Callable[..., Opened]
"""Opens a report by its name; options are those of a browser's context."""

assembled = import_module("mahovik.out.report.stand.page")  # its name is that of its function, too


def made_run(stand: Stand, rows: int = 400, span: float = 0.4, amplitude: float = 3e-5) -> Run:
    """A run that no simulation has made: the carrier vibrates by tens of micrometres, flywheels turn evenly."""
    t = np.linspace(0.0, span, rows)
    columns = {name: np.sin(40.0 * t + i) for i, name in enumerate(column_names(stand, False))}
    turn = amplitude * np.sin(60.0 * t)
    columns |= {"t [s]": t, "qw": np.sqrt(1 - turn**2), "qx": turn, "qy": 0 * t, "qz": 0 * t}
    columns |= {f"{a} [m]": amplitude * np.sin(60.0 * t + k) for k, a in enumerate("xyz")}
    for s, wheel in enumerate(stand.flywheels):
        speed = 100.0 + 5.0 * s
        columns |= {f"phi {wheel.name} [rad]": speed * t + s, f"phi_dot {wheel.name} [rad/s]": 0 * t + speed}
    return Run("made.csv", tuple(wheel.name for wheel in stand.flywheels), columns)


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Headless Chromium."""
    with launched() as found:
        yield found


SCENES: dict[str, Callable[[], Stand]] = {
    "demo3": lambda: load(path("demo3")),
    "none": lambda: random_stand(np.random.default_rng(1), 0, BARE),
    "many": lambda: random_stand(
        np.random.default_rng(2), 64, Features(laws={"leg": 2}, points=2, instruments=2, fluid=True)
    ),
}
"""Stands by name whose reports have a drawing alone."""


@pytest.fixture(scope="session")
def reports(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Report by name, written when it is first asked for: a whole one of bench8 with a run, or one of SCENES."""
    folder = tmp_path_factory.mktemp("reports")

    @cache
    def report(name: str) -> Path:
        found = folder / f"{name}.html"
        if name == "bench8":
            stand = load(path(name))
            text = assembled.page(replace(gather(stand, f"{name}.toml"), run=made_run(stand))).html
        else:
            with pytest.MonkeyPatch.context() as patch:
                patch.setattr(assembled, "ORDER", ("drawing",))
                patch.setattr(assembled, "BESIDE", ())
                patch.setattr(assembled, "generate_once", lambda stand: None)  # no C for these
                text = assembled.page(gather(SCENES[name](), f"{name}.toml")).html
        found.write_text(text, encoding="utf-8")
        return found

    return report


@pytest.fixture
def opened(browser: Browser, reports: Callable[[str], Path]) -> Iterator[Opener]:
    """Opens a report by its name; options are those of a browser's context."""
    open_ones: list[Opened] = []

    def one(name: str, **context: Any) -> Opened:
        open_ones.append(Opened(browser, reports(name), **context))
        return open_ones[-1]

    yield one
    for each in open_ones:
        each.context.close()
