"""Servos: gains, margins of the sampled loop and rotors on free and held carriers, against other means."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from export.held_servos import ARM, MASS, SPIN, WHOLE, pendulum
from export.held_servos import servo as held_servo
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.servo import ServoForm, lower_servo
from mahovik.core.motion.servo import Servo, read_servo
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand import load, loads
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.structure import structure
from mahovik.errors import CheckError
from mahovik.stands import path
from mahovik.use.control.servo import (
    LEAST_GAIN,
    LEAST_PHASE,
    Loop,
    LoopGains,
    check_margins,
    delay,
    gains,
    highest_bandwidth,
    lightness,
    loop_gains,
    margins,
    rotor_inertia,
    rotor_loop,
    samples,
)

SHAKER, SAT4 = load(path("shaker2")), load(path("sat4"))
T = 1e-3


def _closed(one: Loop) -> np.ndarray:
    return one.A + np.outer(one.B, one.C)


def servo(bandwidth: float, text: str = "", stand: Stand = SHAKER) -> Servo:
    return read_servo(f'schema = 1\nsample_period = "1 ms"\nbandwidth = "{bandwidth} Hz"\n{text}\n', stand)


def driven(settings: Servo, late: float, light: float, difference: bool, count: int) -> np.ndarray:
    """Angles of the first rotor, by the servo's program and exact motion under torques that act `late` s later."""
    layout = Layout(structure(SHAKER), DOUBLE)
    run = Interpreter(lower_servo(layout, ServoForm(layout.count))).run
    J, g = rotor_inertia(SHAKER)[0] / light, gains(SHAKER, settings)
    state = run("servo_reset", {})[1]["state"]
    zero = [0.0, 0.0]
    x, before, angles, events = np.array([1e-3, 0.0]), 1e-3, [], []
    acting = 0.0
    for k in range(count):
        speed = (x[0] - before) / T if difference else x[1]
        before = x[0]
        angles.append(x[0])
        inputs = {"gains": g, "state": state, "phi_ref": zero, "phi_dot_ref": zero, "tau_ff": zero}
        outputs = run("servo_step", {**inputs, "phi": [x[0], 0.0], "phi_dot": [speed, 0.0]})[1]
        state = outputs["state"]
        events.append((k * T + late, outputs["tau"][0]))
        now, end = k * T, (k + 1) * T
        while now < end - 1e-12:
            if events and events[0][0] <= now + 1e-12:
                acting = events.pop(0)[1]
            until = min(end, events[0][0]) if events else end
            h = until - now
            x = np.array([x[0] + h * x[1] + h * h / 2 * acting / J, x[1] + h * acting / J])
            now = until
    return np.array(angles)


@pytest.mark.parametrize("late", [0.0, 0.3e-3, 1e-3, 2.6e-3])
@pytest.mark.parametrize("difference", [False, True])
def test_the_linear_loop_is_what_the_servo_does(late: float, difference: bool) -> None:
    settings = servo(20, 'integral = "2 Hz"\nspeed_filter = "150 Hz"')
    one = rotor_loop(loop_gains(settings), T, late, 1.1, difference)
    x = np.zeros(len(one.B))
    x[0] = 1e-3
    if difference:
        x[-1] = 1e-3
    closed, expected = _closed(one), driven(settings, late, 1.1, difference, 120)
    angles = []
    for _ in range(120):
        angles.append(x[0])
        x = closed @ x
    assert np.abs(expected[-20:]).max() < 0.8e-3  # something happened
    assert np.allclose(angles, expected, rtol=0, atol=1e-13)


def test_margins_are_where_it_begins_to_swing() -> None:
    settings = servo(60, 'latency = "300 us"\nintegral = "5 Hz"')
    margin, loop = margins(SHAKER, settings, light=1.0), loop_gains(settings)

    def radius(factor: float, late: float = 0.3e-3) -> float:
        scaled = LoopGains(loop.angle * factor, loop.speed * factor, loop.integral * factor, loop.filter)
        return rotor_loop(scaled, T, late, 1.0, False).radius()

    assert radius(margin.gain * 0.999) < 1 < radius(margin.gain * 1.001)
    assert radius(0.999 / margin.less) > 1 > radius(1.001 / margin.less)
    assert radius(1.0, 0.3e-3 + 0.99 * margin.delay) < 1 < radius(1.0, 0.3e-3 + 1.01 * margin.delay)


def test_delay_lightness_and_encoders_cost_margin() -> None:
    base = margins(SHAKER, servo(60), light=1.0)
    assert margins(SHAKER, servo(60, 'latency = "1 ms"'), light=1.0).phase < base.phase - 10
    assert margins(SHAKER, servo(60), light=1.5).gain < base.gain / 1.4
    read, exact = (servo(60, f'encoder = "{word}"', SAT4) for word in ("stand", "ideal"))
    assert delay(SAT4, read) == pytest.approx(50e-6)
    assert margins(SAT4, read).phase < margins(SAT4, exact).phase - 5


def test_what_is_refused_and_what_is_advised() -> None:
    settings = servo(180, 'latency = "1 ms"')
    with pytest.raises(CheckError) as caught:
        check_margins(SHAKER, settings, "S.toml")
    words = str(caught.value)
    assert "\n" not in words
    assert words.startswith("S.toml: bandwidth 180 Hz at 1 ms per sample and 1 ms of delay: unstable, its poles reach ")
    advised = float(words.partition("give at most ")[2].partition(" Hz")[0])
    assert check_margins(SHAKER, servo(advised, 'latency = "1 ms"'), "S.toml").are_sufficient
    over = margins(SHAKER, servo(advised * 1.02, 'latency = "1 ms"'))
    assert over.gain < LEAST_GAIN or over.phase < LEAST_PHASE


def test_no_bandwidth_helps() -> None:
    settings = servo(20, "damping_ratio = 0.05")
    assert highest_bandwidth(SHAKER, settings, 1.0) is None
    with pytest.raises(CheckError, match=r"phase margin \d+ deg .*: a lower bandwidth does not help: give"):
        check_margins(SHAKER, settings, "S.toml")
    assert check_margins(SHAKER, replace(settings, damping_ratio=0.8), "S.toml").are_sufficient


def test_the_continuous_loop_has_the_poles_asked_for() -> None:
    settings = servo(50, 'integral = "5 Hz"\ndamping_ratio = 0.6')
    loop = loop_gains(settings)
    omega = 100 * math.pi
    wanted = np.polymul([1, 2 * 0.6 * omega, omega**2], [1, 10 * math.pi])
    assert [1, loop.speed, loop.angle, loop.integral] == pytest.approx(list(wanted), rel=1e-14)
    halved = loop_gains(settings, omega / 2)
    assert halved.integral == pytest.approx(loop.integral / 8)  # all poles keep their proportion


def test_inertia_of_a_rotor_is_about_its_axis() -> None:
    """In shaker2 it is 9e-4 about the mass centre, and that of 0.5 kg 4 mm off the axis."""
    assert rotor_inertia(SHAKER) == pytest.approx([0.0009 + 0.5 * 0.004**2] * 2, rel=1e-14)


def test_members_of_the_struct() -> None:
    text = 'latency = "250 us"\nintegral = "5 Hz"\nspeed_filter = "200 Hz"\ntorque_rate = 40\n'
    settings = servo(50, text + 'torque_limit = ["50 mN m", 0.1]')
    members, loop = gains(SHAKER, settings, 0.05), loop_gains(settings)
    J = rotor_inertia(SHAKER)
    assert members["angle"] == pytest.approx(J * loop.angle)
    assert members["integral"] == pytest.approx(J * loop.integral * 1e-3)
    assert members["filter"] == pytest.approx(1 - math.exp(-400 * math.pi * 1e-3))
    assert members["back"] == pytest.approx([1 - math.exp(-100 * math.pi * 1e-3)] * 2)
    assert (members["limit"], members["change"]) == ([0.05, 0.1], [0.04, 0.04])
    assert members["lead"] == pytest.approx(0.75e-3 / 0.05)
    assert gains(SHAKER, servo(50))["limit"] == [1e9, 1e9]


def test_friction_of_the_stand_file() -> None:
    members = gains(SAT4, servo(50, stand=SAT4))
    motor = SAT4.flywheels[0].motor
    assert motor is not None
    assert members["coulomb"] == [5e-4] * 4
    assert members["coulomb_rate"] == [1 / motor.coulomb_speed] * 4
    assert gains(SAT4, servo(50, "friction = false", SAT4))["coulomb"] == [0.0] * 4


@pytest.mark.parametrize(
    ("period", "span", "expected"),
    [("1 ms", 0.1, (100, 1)), ("1 ms", 0.0333, (333, 10)), ("0.3 ms", 0.1, (1000, 3)), ("1 ms", 0.1234567, None)],
)
def test_samples_of_whole_periods(period: str, span: float, expected: tuple[int, int]) -> None:
    settings = read_servo(f'schema = 1\nsample_period = "{period}"\nbandwidth = "10 Hz"', SHAKER)
    ticks, periods = samples(settings, span)
    assert ticks / periods == pytest.approx(span / settings.period, rel=1e-12)
    assert expected is None or (ticks, periods) == expected


def test_too_few_samples() -> None:
    with pytest.raises(CheckError, match=r"S.toml: sample_period 0.001 s: 2.5 samples in a period of 0.0025 s, "):
        samples(servo(50), 0.0025, "S.toml")
    odd, whole = samples(servo(50), 1 / 3 + 1e-13)
    assert odd / whole == pytest.approx(1000 / 3, rel=1e-9)
    assert odd < 2**31


FREE = replace(pendulum(), hold=None)


def closed_radius(stand: Stand, settings: Servo, factor: float) -> float:
    """Largest pole of wheel and hinge together, sampled, with the torque delayed: none of this is of the package.

    (WHOLE, SPIN; SPIN, SPIN) (theta'', phi'') = (-MASS g ARM theta, tau), tau = -angle phi - speed phi' some time ago.
    """
    inertia = np.array([[WHOLE, SPIN], [SPIN, SPIN]])
    A = np.zeros((5, 5))  # theta, phi, their rates, the torque
    A[:2, 2:4] = np.eye(2)
    A[2:4, 0] = np.linalg.solve(inertia, [stand.gravity[2] * MASS * ARM, 0.0])
    A[2:4, 4] = np.linalg.solve(inertia, [0.0, 1.0])
    late, T, gains = delay(stand, settings), settings.period, loop_gains(settings)
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


def test_a_rail_takes_what_is_along_it() -> None:
    """Two exciters of unbalance U on it are lighter by at most 1 / (1 - 2 U^2 / (mass J)), pointing across it."""
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
    stand, settings = pendulum(), held_servo()
    margin = margins(stand, settings)
    assert margin.lightness > 1.4
    assert closed_radius(stand, settings, margin.gain * 0.99) < 1.0 < closed_radius(stand, settings, margin.gain * 1.01)
    of_free = margins(FREE, settings)  # a free carrier makes it lighter still
    assert closed_radius(stand, settings, of_free.gain * 1.01) < 1.0


def test_what_the_hold_makes_unstable_is_refused_with_a_bandwidth_that_is_accepted() -> None:
    clamped = replace(pendulum(), hold=Hold((), (0, 0, 0), (0, 0, 0), (0, 0, 0)))
    text = 'schema = 1\nsample_period = "1 ms"\nlatency = "1300 us"\nbandwidth = "{} Hz"\n'
    settings = next(
        one
        for hertz in np.arange(30.0, 200.0, 1.0)
        if not margins(pendulum(), one := read_servo(text.format(hertz), pendulum())).are_sufficient
    )
    assert margins(clamped, settings).are_sufficient
    with pytest.raises(
        CheckError, match=r"s.toml: bandwidth .*: give at most ([\d.]+) Hz; nothing was written"
    ) as refused:
        check_margins(pendulum(), settings, "s.toml")
    hertz = float(str(refused.value).split("at most ")[1].split(" Hz")[0])
    assert hertz * 2 * math.pi < settings.bandwidth
    assert margins(pendulum(), read_servo(text.format(hertz), pendulum())).are_sufficient
