"""Warnings of plausible slips: they come where a unit was missed, and not for the examples."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from cli.run import run
from mahovik import stands
from mahovik.core.stand import load, loads
from mahovik.core.stand.summary import summarize
from mahovik.errors import StandError

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
        "a slip in its unit?"
    )
    assert warnings(("12 g mm", "120 g cm")) == ()  # 377 mm/s


def test_flywheels_that_are_all_unbalanced_are_so_on_purpose() -> None:
    """Shakers and vibration motors, also one alone, also with the speed of a motor."""
    both = (("12 g mm", "150 g cm"), ("11 g mm", "160 g cm"))
    motor = ('unbalance = { static = "150', 'motor = { speed = "3000 rpm" }\nunbalance = { static = "150')
    assert warnings(*both) == warnings(*both, motor) == ()
    wheel = GOOD[GOOD.index('[[flywheel]]\nname = "w2"') : GOOD.index("[[point]]")]
    assert warnings((wheel, ""), both[0], motor) == ()


def test_a_carrier_whose_inertia_is_in_a_unit_far_too_small() -> None:
    """0.1 kg m2 written as numbers of kg mm2: sqrt(1.5e5/10) m, where the tip is at 0.5 m."""
    (line,) = (line for line in warnings(("[0.1, 0.1, 0.1]", "[1e5, 1e5, 1e5]")) if "lighter" in line)
    assert line == (
        "carrier: its radius of gyration is 122 m, 246 times the distance of what stands on it; it would be "
        "lighter than any gas: a slip in the unit of its inertia or mass?"
    )
    assert not any("lighter" in line for line in warnings(("[0.1, 0.1, 0.1]", "[100, 100, 100]")))


def test_a_free_carrier_without_mass() -> None:
    text = GOOD.replace("mass = 10\n", "mass = 0\n").replace('center_of_mass = ["2 mm", 0, 0]\n', "")
    instrument = text[text.index("[[instrument]]") : text.index('[[flywheel]]\nname = "w1"')]
    assert not any("its mass is 0" in line for line in summarize(loads(text)).warnings)
    bare = summarize(loads(text.replace(instrument, ""))).warnings
    assert any(line.startswith("carrier: its mass is 0") for line in bare)
    held = text.replace(instrument, "").replace("[[flywheel]]", '[hold]\nfreedoms = ["yaw"]\n[[flywheel]]', 1)
    assert not any("its mass is 0" in line for line in summarize(loads(held)).warnings)


def test_a_rim_faster_than_metal_bears() -> None:
    """The disc of 1 kg and 0.002 kg m2 has a radius of 63.2 mm: 379 m/s at 6000 rad/s, 39.7 m/s at 6000 rpm."""
    wheel = 'unbalance = { static = "12'
    assert warnings((wheel, f'motor = {{ speed = "6000 rpm" }}\n{wheel}')) == ()
    (line,) = (line for line in warnings((wheel, f"motor = {{ speed = 6000 }}\n{wheel}")) if "rim" in line)
    assert line == (
        "flywheel w1: at 6000 rad/s, 57296 rpm, the rim of a disc of its mass and inertia, of 0.0632 m, runs at "
        "379.5 m/s, above 300: rpm written as rad/s?"
    )


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


FLOATING = """schema = 1
name = "rov"
gravity = [0, 0, -9.81]
[carrier]
mass = 13.5
inertia = [0.26, 0.23, 0.37]
added_mass = [1.272, 1.424, 3.736, 0.0378, 0.027, 0.0444]
buoyancy = { displaced_mass = 13.5, center = [0, 0, 0.03] }
damping = { linear = [13.7, 1, 23, 0.5, 0.8, 0.1], quadratic = [14.1, 21.7, 19, 0.119, 0.047, 0.15] }
"""
SUSPENSION = "[suspension]\nstiffness = [1e3, 1e3, 1e3, 9, 9, 9]\ndamping = [1, 1, 1, 1, 1, 1]\n"


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("linear = [13.7, 1,", "linear = [-13.7, -1,", "carrier: damping.linear has -13.7 for u, -1 for v: it drives"),
        ("0.047, 0.15", "0.047, -0.15", "carrier: damping.quadratic has -0.15 for r: it drives"),
        ("stiffness = [1e3", "stiffness = [-1e3", "suspension.stiffness has -1000 for u: it pushes away"),
        ("damping = [1, 1, 1, 1", "damping = [1, 1, 1, -1", "suspension.damping has -1 for p: it drives"),
    ],
)
def test_a_sign_on_a_diagonal_that_drives(old: str, new: str, line: str) -> None:
    text = FLOATING + SUSPENSION
    assert old in text and summarize(loads(text)).warnings == ()
    (found,) = summarize(loads(text.replace(old, new))).warnings
    assert found.startswith(line)


def test_a_center_of_buoyancy_below_the_centre_of_mass_of_what_can_tilt() -> None:
    below = FLOATING.replace("0.03]", "-0.03]")
    assert summarize(loads(FLOATING)).warnings == ()
    (line,) = summarize(loads(below)).warnings
    assert line.startswith("buoyancy: its centre is 30 mm below the centre of mass")
    down = below.replace("-9.81", "9.81")
    assert summarize(loads(below + SUSPENSION)).warnings == summarize(loads(down)).warnings == ()
    for freedom, warned in (("yaw", False), ("roll", True)):
        held = summarize(loads(f'{below}[hold]\nfreedoms = ["{freedom}"]\n')).warnings
        assert (line in held) == warned


def test_added_mass_with_the_signs_of_derivatives_is_refused_by_the_convention() -> None:
    """One negative number is a slip of another kind."""
    text = FLOATING.replace("added_mass = [1.272, 1.424, 3.736, 0.0378, 0.027, 0.0444]", "added_mass = {}")
    sign = "published derivatives (X_udot, ...) are negative, added mass is minus these; expected other signs"
    for diagonal, all_of_them in (("[-1.2, -1.4, -3.7, 0, -0.02, -0.04]", True), ("[1.2, -1.4, 3.7, 0, 0, 0]", False)):
        with pytest.raises(StandError) as caught:
            loads(text.replace("{}", diagonal))
        assert (sign in str(caught.value)) == all_of_them
