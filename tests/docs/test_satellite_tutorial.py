"""docs/tutorial-satellite.md: its picture is that of its command, its figures are those of the stand file."""

from __future__ import annotations

import re

import pytest

from docs.pages import ROOT, blocks
from mahovik.core.stand import load
from mahovik.stands import path

PAGE = ROOT / "docs" / "tutorial-satellite.md"


def one_line(text: str) -> str:
    """A command without its continuations."""
    return " ".join(text.replace("\\\n", " ").split())


def test_the_picture_is_that_of_the_command_on_the_page() -> None:
    """But for the requirement, which does not change the picture."""
    (block,) = (each for each in blocks(PAGE) if "-o budget.svg" in each.text)
    shown = one_line(block.text).removeprefix("mahovik jitter eye4.toml ").split(" --require")[0]
    assert f"{shown} -o $(CURDIR)/docs/satellite-jitter.svg" in one_line((ROOT / "Makefile").read_text("utf-8"))
    files = {each.file.removesuffix(".csv") for each in blocks(PAGE) if each.file}
    (listed,) = re.findall(r"for file in ([a-z ]+); do", (ROOT / "Makefile").read_text("utf-8"))
    assert files == set(listed.split())


def test_the_figures_of_the_wheel_are_those_of_the_file() -> None:
    stand, page = load(path("eye4")), PAGE.read_text(encoding="utf-8")
    assert "| momentum, torque | 1.0 N m s, 0.1 N m |" in page and "2 g mm, 25 g mm^2 on average" in page
    for wheel in stand.flywheels:
        motor = wheel.motor
        assert motor is not None and motor.speed is not None
        assert (motor.torque, motor.supply) == (0.1, 28.0)
        assert wheel.inertia[0][0] * motor.speed == pytest.approx(1.0, rel=1e-4)
        unbalance = wheel.mass * (wheel.center_of_mass[1] ** 2 + wheel.center_of_mass[2] ** 2) ** 0.5
        assert unbalance == pytest.approx(2e-6, rel=1e-6)
        assert (wheel.inertia[0][1] ** 2 + wheel.inertia[0][2] ** 2) ** 0.5 == pytest.approx(25e-9, rel=1e-6)
