"""Figures for `check`."""

from __future__ import annotations

import math

import pytest

from mahovik.core.stand import load, loads
from mahovik.core.stand.model import Stand
from mahovik.core.stand.summary import summarize
from mahovik.stands import path

BASE = 'schema = 1\nname = "a"\nangles = "{angles}"\ngravity = {gravity}\n[carrier]\nmass = 1\ninertia = [1, 1, 1]\n'


def wheel(extra: str = "") -> str:
    return (
        '[[instrument]]\nname = "i"\nmass = 1\ninertia = [1, 1, 1]\nposition = [1, 0, 0]\nangles = ["90 deg", 0, 0]\n'
        '[[flywheel]]\nname = "w"\nmount = "i"\nposition = [0, 2, 0]\naxis = [0, 0, 1]\nzero = [1, 0, 0]\nmass = 2\n'
        'spin_inertia = 0.02\ntransverse_inertia = [0.011, 0.012]\n'
        'unbalance = {{ static = "30 g mm", static_at = "90 deg", dynamic = "400 g mm^2" }}\n' + extra
    )  # fmt: skip


def stand(angles: str = "ship", gravity: str = "[0, 0, 0]", extra: str = "") -> Stand:
    return loads((BASE + wheel(extra)).format(angles=angles, gravity=gravity))


def test_masses_and_centres_in_the_carrier_frame() -> None:
    summary = summarize(stand())
    assert [(row.name, row.kind, row.mount) for row in summary.bodies] == [
        ("carrier", "carrier", ""),
        ("i", "instrument", "carrier"),
        ("w", "flywheel", "i"),
    ]
    # w: 2 m along axis 2 of the instrument, which is -axis 1 of the carrier; r = 15 um along axis 3 of Es, the same way
    assert summary.bodies[2].center_of_mass == pytest.approx((1 - 2 - 15e-6, 0, 0), abs=1e-15)
    assert summary.mass == 4.0
    assert summary.center_of_mass == pytest.approx((1 / 4 + 2 * (-1 - 15e-6) / 4, 0, 0), abs=1e-15)


def test_unbalance_in_si_and_its_force() -> None:
    (row,) = summarize(stand(), speed=1000.0).unbalance
    assert row.static == pytest.approx(30e-6)
    assert row.dynamic == pytest.approx(400e-9)
    assert row.asymmetry == pytest.approx(-1e-3)
    assert row.spin_inertia == 0.02
    assert row.force == pytest.approx(30e-6 * 1e6)
    assert row.moment == pytest.approx(400e-9 * 1e6)


def test_the_speed_is_asked_or_the_motors_or_3000_rpm() -> None:
    with_motor = stand(extra='motor = {{ speed = "6000 rpm" }}\n')
    assert [
        summarize(example, speed).unbalance[0].speed
        for example, speed in ((stand(), None), (with_motor, None), (with_motor, 5.0))
    ] == pytest.approx([100 * math.pi, 200 * math.pi, 5.0])


@pytest.mark.parametrize(
    ("angles", "gravity", "is_heading"),
    [
        ("ship", "[0, 0, -9.81]", False),
        ("aircraft", "[0, 0, -9.81]", True),
        ("aircraft", "[0, -9.81, 0]", False),
        ("ship", "[0, 9.81, 0]", True),
        ("ship", "[9.81, 0, 0]", False),
        ("ship", "[0.4, 0, -9.8]", False),
        ("ship", "[0, 0, 0]", False),
        ("euler", "[0, 0, 0]", True),
    ],
)
def test_a_singularity_that_is_a_heading_is_a_warning(angles: str, gravity: str, is_heading: bool) -> None:
    warnings = summarize(stand(angles, gravity)).warnings
    assert is_heading == any("singular" in warning for warning in warnings)


def test_weight_that_nothing_carries_is_a_warning() -> None:
    warnings = summarize(stand(gravity="[0, 0, -9.81]")).warnings
    assert warnings == ("nothing carries the weight (no suspension, leg or buoyancy): the stand falls freely",)
    assert summarize(load(path("bench8"))).warnings == ()
