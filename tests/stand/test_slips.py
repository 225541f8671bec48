"""Warnings of plausible slips: they come where a unit was missed, and not for the examples."""

from __future__ import annotations

import math

import pytest

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


def motor(speed: str) -> tuple[str, str]:
    """The change that gives w1 a motor of this speed."""
    wheel = 'unbalance = { static = "12 g mm" }'
    return wheel, f"motor = {{ speed = {speed} }}\n{wheel}"


def spun(inertia: str) -> tuple[str, str]:
    """The change that makes w1 a wheel of 2.4 kg with this inertia about all axes."""
    old = 'mass = 1\nspin_inertia = 0.002\ntransverse_inertia = 0.0011\nunbalance = { static = "12'
    return old, f'mass = 2.4\nspin_inertia = "{inertia}"\ntransverse_inertia = "{inertia}"\nunbalance = {{ static = "12'


SLIPS = [
    # 1.5 mm at 3000 rpm is 471 mm/s
    (
        ("12 g mm", "150 g cm"),
        "flywheel w1: a static unbalance of 1500 g mm on 1 kg is G 630 at 3000 rpm, 11.8 times G 40: "
        "a slip in its unit?",
    ),
    # 0.1 kg m2 as numbers of kg mm2: sqrt(1.5e5/10) m, where the tip is at 0.5 m
    (
        ("[0.1, 0.1, 0.1]", "[1e5, 1e5, 1e5]"),
        "carrier: its radius of gyration is 122 m, 246 times the distance of what stands on it; it would be lighter "
        "than any gas: a slip in the unit of its inertia or mass?",
    ),
    # a disc of 1 kg and 0.002 kg m2 has a radius of 63.2 mm
    (
        motor("6000"),
        "flywheel w1: at 6000 rad/s, 57296 rpm, the rim of a disc of its mass and inertia, of 0.0632 m, runs at "
        "379.5 m/s, above 300: rpm written as rad/s?",
    ),
    # sqrt(1.5 191/2.4) m, beside 0.122 m of the carrier
    (
        spun("191 kg m^2"),
        "w1: its radius of gyration is 10.9 m, 89.2 times the largest of the other bodies: a slip in the unit of its "
        "inertia or mass?",
    ),
    # sqrt(0.3/20) = 0.122 m: the origin is outside beyond 0.367 m
    (
        ('["2 mm"', '["0.4 m"'),
        "carrier: its centre of mass is 0.4 m from the origin of its frame, 3.27 times its radius of gyration of "
        "0.122 m, which is outside the body: a slip in the unit?",
    ),
    (('["120 mm"', '["120 m"'), "flywheel w1: its position is 120 m from the middle of the bodies, "),
    (('["300 mm"', "[300"), "instrument camera: its position is 300 m from the middle of the bodies, "),
    (('["500 mm"', "[3.7"), "point tip: its position is 3."),
]


@pytest.mark.parametrize(("change", "words"), SLIPS)
def test_a_slip_is_named_with_its_numbers(change: tuple[str, str], words: str) -> None:
    assert any(line.startswith(words) for line in warnings(change))


@pytest.mark.parametrize(
    "change",
    [
        ("12 g mm", "120 g cm"),  # 377 mm/s
        ("[0.1, 0.1, 0.1]", "[100, 100, 100]"),
        motor('"6000 rpm"'),
        spun("191 kg cm^2"),
        ('["2 mm"', '["0.36 m"'),
        ('["500 mm"', "[3.3"),
    ],
)
def test_what_a_little_less_is_no_slip(change: tuple[str, str]) -> None:
    assert not any("slip" in line or "rpm written" in line for line in warnings(change))


@pytest.mark.parametrize("name", stands.names())
def test_the_examples_have_no_slips(name: str) -> None:
    assert not any("slip" in line for line in summarize(load(stands.path(name))).warnings)


def test_flywheels_that_are_all_unbalanced_are_so_on_purpose() -> None:
    """Shakers and vibration motors, also with the speed of a motor."""
    both = (("12 g mm", "150 g cm"), ("11 g mm", "160 g cm"))
    assert warnings(*both) == warnings(motor('"3000 rpm"'), *both) == ()


def test_a_free_carrier_without_mass() -> None:
    text = GOOD.replace("mass = 10\n", "mass = 0\n").replace('center_of_mass = ["2 mm", 0, 0]\n', "")
    instrument = text[text.index("[[instrument]]") : text.index('[[flywheel]]\nname = "w1"')]
    assert not any("its mass is 0" in line for line in summarize(loads(text)).warnings)
    bare = summarize(loads(text.replace(instrument, ""))).warnings
    assert any(line.startswith("carrier: its mass is 0") for line in bare)
    held = text.replace(instrument, "").replace("[[flywheel]]", '[hold]\nfreedoms = ["yaw"]\n[[flywheel]]', 1)
    assert not any("its mass is 0" in line for line in summarize(loads(held)).warnings)


@pytest.mark.parametrize("excess", [0.999, 1.001])
def test_the_densest_ball_is_the_bound(excess: float) -> None:
    """A ball of osmium of 2.4 kg has the inertia 2/5 m r^2; a little less is impossible."""
    radius = (2.4 / 22.6e3 / (4 / 3 * math.pi)) ** (1 / 3)
    lines = warnings(spun(f"{0.4 * 2.4 * radius**2 / excess!r} kg m^2"))
    assert any("osmium" in line for line in lines) == (excess > 1.0)


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
        (
            "added_mass",
            "fading_damping = { linear = [1, 1, -23, 1, 1, 1], rate = 3 }\nadded_mass",
            "carrier: fading_damping.linear has -23 for w: it drives",
        ),
        ("stiffness = [1e3", "stiffness = [-1e3", "suspension.stiffness has -1000 for u: it pushes away"),
        ("damping = [1, 1, 1, 1", "damping = [1, 1, 1, -1", "suspension.damping has -1 for p: it drives"),
    ],
)
def test_a_sign_on_a_diagonal_that_drives(old: str, new: str, line: str) -> None:
    text = FLOATING + SUSPENSION
    assert old in text and summarize(loads(text)).warnings == ()
    (warning,) = summarize(loads(text.replace(old, new))).warnings
    assert warning.startswith(line)


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
