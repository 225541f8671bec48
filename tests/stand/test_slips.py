"""Warnings of plausible slips: they come where a unit was missed, and not for the examples."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from cli.run import run
from mahovik import stands
from mahovik.core.stand import load, loads
from mahovik.core.stand.summary import summarize

GOOD = """schema = 1
name = "a"
[carrier]
mass = 10
inertia = [0.1, 0.1, 0.1]
center_of_mass = ["2 mm", 0, 0]
inertia_about = "center_of_mass"
[[instrument]]
name = "camera"
mass = 1
inertia = [0.002, 0.002, 0.002]
position = ["300 mm", 0, 0]
[[flywheel]]
name = "w1"
position = ["120 mm", 0, 0]
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = 1
spin_inertia = 0.002
transverse_inertia = 0.0011
unbalance = { static = "12 g mm" }
[[flywheel]]
name = "w2"
position = ["-120 mm", 0, 0]
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = 1
spin_inertia = 0.002
transverse_inertia = 0.0011
unbalance = { static = "11 g mm" }
[[point]]
name = "tip"
position = ["500 mm", 0, 0]
"""


def warnings(*changes: tuple[str, str]) -> tuple[str, ...]:
    text = GOOD
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return summarize(loads(text)).warnings


def test_a_stand_without_slips() -> None:
    assert warnings() == ()


@pytest.mark.parametrize("name", stands.names())
def test_the_examples_have_no_slips(name: str) -> None:
    assert not any("slip" in line for line in summarize(load(stands.path(name))).warnings)


def test_an_unbalance_far_above_g_40() -> None:
    """1500 g mm on 1 kg is 1.5 mm, at 3000 rpm 471 mm/s: 11.8 times G 40."""
    (line,) = warnings(("12 g mm", "150 g cm"))
    assert line == (
        "flywheel w1: a static unbalance of 1500 g mm on 1 kg is G 630 at 3000 rpm, 11.8 times G 40: "
        "on purpose, or a slip in its unit?"
    )
    assert warnings(("12 g mm", "120 g cm")) == ()  # 377 mm/s


def test_flywheels_that_are_all_unbalanced_are_so_on_purpose_unless_their_speed_is_known() -> None:
    both = (("12 g mm", "150 g cm"), ("11 g mm", "160 g cm"))
    assert warnings(*both) == ()
    motor = ('unbalance = { static = "150', 'motor = { speed = "3000 rpm" }\nunbalance = { static = "150')
    (line,) = warnings(*both, motor)
    assert line.startswith("flywheel w1: a static unbalance of 1500 g mm")
    found = GOOD.replace("12 g mm", "150 g cm").replace("11 g mm", "160 g cm")
    (asked,) = summarize(loads(found), 314.0).warnings
    assert asked.startswith("flywheel w2 (and 1 more): a static unbalance of 1600 g mm")


def test_a_lone_flywheel_has_no_other_that_shows_its_purpose() -> None:
    """15 g m on a wheel of 2.4 kg."""
    wheel = GOOD[GOOD.index('[[flywheel]]\nname = "w2"') : GOOD.index("[[point]]")]
    lone = GOOD.replace(wheel, "").replace("mass = 1\nspin", "mass = 2.4\nspin").replace("12 g mm", "15 g m")
    (line,) = summarize(loads(lone)).warnings
    assert line.startswith("flywheel w1: a static unbalance of 15000 g mm on 2.4 kg is G 4000 at 3000 rpm, 49.1 times")


def spun(inertia: str) -> str:
    """The stand with a wheel w1 of 2.4 kg and this inertia about all axes."""
    old = 'mass = 1\nspin_inertia = 0.002\ntransverse_inertia = 0.0011\nunbalance = { static = "12'
    assert old in GOOD
    new = f'mass = 2.4\nspin_inertia = "{inertia}"\ntransverse_inertia = "{inertia}"\nunbalance = {{ static = "12'
    return GOOD.replace(old, new)


def test_an_inertia_written_in_a_unit_far_too_large() -> None:
    """sqrt(1.5 191/2.4) m, beside 0.122 m of the carrier."""
    assert summarize(loads(spun("191 kg cm^2"))).warnings == ()
    (line,) = (line for line in summarize(loads(spun("191 kg m^2"))).warnings if "radius of gyration is" in line)
    assert line == (
        "w1: its radius of gyration is 10.9 m, 89.2 times the largest of the other bodies: "
        "a slip in the unit of its inertia or mass?"
    )


def test_an_inertia_written_in_a_unit_far_too_small() -> None:
    """0.191 kg cm2: the ball of the same moments has a radius of sqrt(5/2 1.91e-5/2.4) = 4.46 mm."""
    (line,) = (line for line in summarize(loads(spun("0.191 kg cm^2"))).warnings if "osmium" in line)
    density = 2.4 / (4 / 3 * math.pi * (2.5 * 1.91e-5 / 2.4) ** 1.5)
    assert f"is {density / 22.6e3:.3g} times denser than osmium" in line
    assert line.startswith("w1: 2.4 kg with a radius of gyration of 0.00346 m is ")


@pytest.mark.parametrize("excess", [0.999, 1.001])
def test_the_densest_ball_is_the_bound(excess: float) -> None:
    """A ball of osmium of 2.4 kg has the inertia 2/5 m r^2; a little less is impossible."""
    radius = (2.4 / 22.6e3 / (4 / 3 * math.pi)) ** (1 / 3)
    found = summarize(loads(spun(f"{0.4 * 2.4 * radius**2 / excess!r} kg m^2"))).warnings
    assert any("osmium" in line for line in found) == (excess > 1.0)


@pytest.mark.parametrize(
    ("change", "name", "distance"),
    [
        (('["120 mm"', '["120 m"'), "flywheel w1", "120"),
        (('["300 mm"', "[300"), "instrument camera", "300"),
        (('["500 mm"', "[500"), "point tip", "500"),
    ],
)
def test_a_place_far_outside(change: tuple[str, str], name: str, distance: str) -> None:
    (line,) = (line for line in warnings(change) if "position" in line)
    assert line.startswith(f"{name}: its position is {distance} m from the middle of the bodies, ")
    assert line.endswith(": a slip in the unit?")


def test_a_place_at_ten_times_the_size_is_not_reported_and_one_beyond_is() -> None:
    """The bodies reach 0.33 m from their middle at x = 0.025 m: the camera's distance and radius of gyration."""
    assert warnings(('["500 mm"', "[3.3")) == ()
    assert len(warnings(('["500 mm"', "[3.7"))) == 1


def test_a_centre_of_mass_outside_its_body() -> None:
    """The carrier's radius of gyration is sqrt(0.3/20) = 0.122 m: the origin is outside beyond 0.367 m."""
    (line,) = warnings(('["2 mm"', '["0.4 m"'))
    assert line == (
        "carrier: its centre of mass is 0.4 m from the origin of its frame, 3.27 times its radius of gyration of "
        "0.122 m, which is outside the body: a slip in the unit?"
    )
    assert warnings(('["2 mm"', '["0.36 m"')) == ()


def test_an_unbalance_is_shown_as_it_is_written(tmp_path: Path) -> None:
    text = GOOD.replace("12 g mm", "15 kg mm").replace("spin_inertia = 0.002", "spin_inertia = 2")
    file = tmp_path / "a.toml"
    file.write_text(text.replace("transverse_inertia = 0.0011", "transverse_inertia = 2"))
    assert "flywheel w1: a static unbalance of 15 kg mm on 1 kg" in run("check", str(file)).stdout
    line, *_ = summarize(load(file)).warnings
    assert "a static unbalance of 15000 g mm on 1 kg" in line
