"""Servos of held stands: rotors by the freedoms alone, and the sampled loop of the whole held plant as its judge."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from export.held_servos import ARM, MASS, SPIN, WHOLE, pendulum, servo
from mahovik.core.motion.servo import Servo, read_servo
from mahovik.core.stand import load, loads
from mahovik.core.stand.model import Freedom, Hold, Stand
from mahovik.errors import CheckError
from mahovik.stands import path
from mahovik.use.control.servo import check_margins, delay, lightness, loop_gains, margins

SHAKER = load(path("shaker2"))
FREE = replace(pendulum(), hold=None)


def closed_radius(stand: Stand, given: Servo, factor: float) -> float:
    """Largest pole of wheel and hinge together, sampled, with the torque delayed: none of this is of the package.

    (WHOLE, SPIN; SPIN, SPIN) (theta'', phi'') = (-MASS g ARM theta, tau), tau = -angle phi - speed phi' some time ago.
    """
    inertia = np.array([[WHOLE, SPIN], [SPIN, SPIN]])
    A = np.zeros((5, 5))  # theta, phi, their rates, the torque
    A[:2, 2:4] = np.eye(2)
    A[2:4, 0] = np.linalg.solve(inertia, [stand.gravity[2] * MASS * ARM, 0.0])
    A[2:4, 4] = np.linalg.solve(inertia, [0.0, 1.0])
    late, T, gains = delay(stand, given), given.period, loop_gains(given)
    assert T < late < 2 * T
    before, after = expm(A * (late - T)), expm(A * (2 * T - late))
    law = -factor * SPIN * np.array([0.0, gains.angle, 0.0, gains.speed])
    whole = np.zeros((6, 6))  # x, torques of one sample ago and of two
    whole[:4, :4] = after[:4, :4] @ before[:4, :4]
    whole[:4, 5] = after[:4, :4] @ before[:4, 4]
    whole[:4, 4] = after[:4, 4]
    whole[4, :4], whole[5, 4] = law, 1.0
    return float(np.abs(np.linalg.eigvals(whole)).max())


def test_a_wheel_on_a_hinge_is_lighter_by_the_closed_formula() -> None:
    """J - J^2 / WHOLE: the wheel turns against the hinge alone, wherever its mass is."""
    assert lightness(pendulum()) == pytest.approx(WHOLE / (WHOLE - SPIN), rel=1e-13)
    assert abs(lightness(FREE) - WHOLE / (WHOLE - SPIN)) > 0.1


def test_a_clamped_carrier_leaves_rotors_as_they_are() -> None:
    clamped = replace(SHAKER, hold=Hold((), (0, 0, 0), (0, 0, 0), (0, 0, 0)))
    assert lightness(clamped) == 1.0 < lightness(SHAKER)


def test_six_freedoms_are_a_free_carrier() -> None:
    rows = np.eye(6)[[3, 1, 5, 0, 2, 4]].tolist()
    whole = tuple(Freedom("twist", twist=tuple(row)) for row in rows)
    held = replace(SHAKER, hold=Hold(whole, (0, 0, 0), (0, 0, 0), (0, 0, 0)))
    assert lightness(held) == pytest.approx(lightness(SHAKER), rel=1e-13)


def test_a_rail_takes_what_is_along_it() -> None:
    """Two exciters of unbalance U on a rail: at most 1 / (1 - 2 U^2 / (mass J)), where both point across it."""
    text = """
schema = 1
name = "rail"
carrier = { mass = 6.0, inertia = [0.1, 0.1, 0.1] }
hold = { slide = [0, 0, 1] }
"""
    for k, y in enumerate((-0.1, 0.1)):
        text += f"""
[[flywheel]]
name = "w{k}"
axis = [1, 0, 0]
zero = [0, 0, 1]
position = [0, {y}, 0]
mass = 1.0
spin_inertia = 0.002
transverse_inertia = 0.0012
unbalance = {{ static = 0.02 }}
"""
    most = 1 / (1 - 2 * 0.02**2 / (8.0 * 0.002))
    assert 0.99 * most < lightness(loads(text)) <= most


def test_the_gain_margin_is_that_of_the_whole_held_plant() -> None:
    """The margin leaves out its weight, whose motion is much slower than the servo."""
    stand, given = pendulum(), servo()
    found = margins(stand, given)
    assert found.lightness > 1.4
    assert closed_radius(stand, given, found.gain * 0.99) < 1.0 < closed_radius(stand, given, found.gain * 1.01)
    assert closed_radius(stand, given, margins(FREE, given).gain * 1.01) < 1.0  # a free carrier makes it lighter still


def test_what_the_hold_makes_unstable_is_refused_with_a_bandwidth_that_is_accepted() -> None:
    clamped = replace(pendulum(), hold=Hold((), (0, 0, 0), (0, 0, 0), (0, 0, 0)))
    text = 'schema = 1\nsample_period = "1 ms"\nlatency = "1300 us"\nbandwidth = "{} Hz"\n'
    given = next(
        one
        for hertz in np.arange(30.0, 200.0, 1.0)
        if not margins(pendulum(), one := read_servo(text.format(hertz), pendulum())).are_sufficient
    )
    assert margins(clamped, given).are_sufficient
    with pytest.raises(
        CheckError, match=r"s.toml: bandwidth .*: give at most ([\d.]+) Hz; nothing was written"
    ) as told:
        check_margins(pendulum(), given, "s.toml")
    hertz = float(str(told.value).split("at most ")[1].split(" Hz")[0])
    assert hertz * 2 * math.pi < given.bandwidth
    assert margins(pendulum(), read_servo(text.format(hertz), pendulum())).are_sufficient
