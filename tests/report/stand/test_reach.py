"""Reach: m e omega^2 by hand; wrenches of the literal reference over a turn; limits of speed and drives."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand import Stand, loads
from mahovik.core.stand.state import rest_state
from mahovik.proof import reference
from mahovik.use.study.reach import reach
from report.stand.runs import example

ONE = """
schema = 1
name = "one"
angles = "ship"
gravity = [0, 0, 0]
[carrier]
mass = 10.0
center_of_mass = [0, 0, 0]
inertia = [1.0, 1.0, 1.0]
inertia_about = "origin"
[[flywheel]]
name = "w"
mount = "carrier"
position = [0.3, 0, 0]
angles = [0, 0]
mass = 2.0
center_of_mass = [0, 0.003, 0.004]
inertia = [0.004, 0.003, 0.003]
inertia_about = "center_of_mass"
motor = { torque = 0.2, speed = "3000 rpm" }
"""


def spun(stand: Stand, s: int, phi: float, speed: float) -> np.ndarray:
    """J phi' of the reference, of one flywheel that turns on a carrier at rest."""
    rest = rest_state(stand)
    at = [0.0] * len(stand.flywheels)
    angles, speeds = [*at], [*at]
    angles[s], speeds[s] = phi, speed
    found = reference.evaluate(stand, replace(rest, phi=tuple(angles), phi_dot=tuple(speeds)), ["matrices"])
    return np.asarray(found["J"] @ np.array(speeds))


def test_one_flywheel_by_hand() -> None:
    found, omega = reach(loads(ONE)), 100.0
    force = 2.0 * 0.005 * omega**2  # m e omega^2: about x, so along y and z, at an arm of 0.3 m along x
    wrench = found.wrench(np.array([omega]))[0]
    assert wrench == pytest.approx([0.0, force, force, 0.0, 0.3 * force, 0.3 * force], rel=1e-12, abs=1e-9)
    static, dynamic = found.wrenches(np.array([omega, 100 * math.pi, 101 * math.pi]))
    assert static[0, 0] == pytest.approx(force) and dynamic[0, 0] == pytest.approx(0.0, abs=1e-12)
    assert static[1, 0] == pytest.approx(0.01 * (100 * math.pi) ** 2) and math.isnan(static[2, 0])


def test_drives_react_about_their_axes_and_not_at_their_own_speed() -> None:
    found = reach(loads(ONE)).reaction(np.array([0.0, 50 * math.pi, 100 * math.pi]))
    assert found == pytest.approx(np.array([[0.2, 0, 0], [0.1, 0, 0], [0, 0, 0]]), abs=1e-15)


@pytest.mark.parametrize("name", ["bench8", "auv6", "sat4"])
def test_along_axes_it_is_what_the_reference_reaches_in_a_turn(name: str) -> None:
    stand, speed = example(name), 37.0
    expected = np.zeros(6)
    for s in range(len(stand.flywheels)):
        first, second = (spun(stand, s, phi, speed) for phi in (0.0, math.pi / 2))
        expected += np.hypot(first, second)
        for phi in (0.4, 2.5):
            assert np.all(np.abs(spun(stand, s, phi, speed)) <= np.hypot(first, second) * (1 + 1e-9) + 1e-12)
    assert reach(stand).wrench(np.array([speed]))[0] == pytest.approx(expected, rel=1e-9, abs=1e-9 * expected.max())
