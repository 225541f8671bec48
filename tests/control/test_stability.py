"""Stability of the sampled, delayed loop, against the servo's own program driving a rotor step by step."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.lower.layout import Layout
from mahovik.core.lower.servo.form import ServoForm
from mahovik.core.lower.servo.program import lower_servo
from mahovik.core.motion.servo import Servo, read_servo
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
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
    loop_gains,
    margins,
    rotor_inertia,
    rotor_loop,
)

SHAKER, SAT4 = load(path("shaker2")), load(path("sat4"))
T = 1e-3


def _closed(one: Loop) -> np.ndarray:
    return one.A + np.outer(one.B, one.C)


def servo(bandwidth: float, text: str = "", stand: Stand = SHAKER) -> Servo:
    return read_servo(f'schema = 1\nsample_period = "1 ms"\nbandwidth = "{bandwidth} Hz"\n{text}\n', stand)


def driven(given: Servo, late: float, light: float, difference: bool, count: int) -> np.ndarray:
    """Angles of the first rotor, by the servo's program and exact motion under torques that act `late` s later."""
    layout = Layout(structure(SHAKER), DOUBLE)
    run = Interpreter(lower_servo(layout, ServoForm(layout.count))).run
    J, g = rotor_inertia(SHAKER)[0] / light, gains(SHAKER, given)
    state = run("servo_reset", {})[1]["state"]
    zero = [0.0, 0.0]
    x, before, found, events = np.array([1e-3, 0.0]), 1e-3, [], []
    acting = 0.0
    for k in range(count):
        speed = (x[0] - before) / T if difference else x[1]
        before = x[0]
        found.append(x[0])
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
    return np.array(found)


@pytest.mark.parametrize("late", [0.0, 0.3e-3, 1e-3, 2.6e-3])
@pytest.mark.parametrize("difference", [False, True])
def test_the_linear_loop_is_what_the_servo_does(late: float, difference: bool) -> None:
    given = servo(20, 'integral = "2 Hz"\nspeed_filter = "150 Hz"')
    one = rotor_loop(loop_gains(given), T, late, 1.1, difference)
    x = np.zeros(len(one.B))
    x[0] = 1e-3
    if difference:
        x[-1] = 1e-3
    closed, expected = _closed(one), driven(given, late, 1.1, difference, 120)
    found = []
    for _ in range(120):
        found.append(x[0])
        x = closed @ x
    assert np.abs(expected[-20:]).max() < 0.8e-3  # something happened
    assert np.allclose(found, expected, rtol=0, atol=1e-13)


def test_fast_sampling_has_the_poles_asked_for() -> None:
    given = servo(10, 'integral = "1 Hz"')
    poles = np.linalg.eigvals(_closed(rotor_loop(loop_gains(given), 1e-5, 0.0, 1.0, False)))
    omega, zeta = 20 * math.pi, 0.8
    wanted = [complex(-zeta * omega, omega * math.sqrt(1 - zeta**2)), complex(-2 * math.pi)]
    for pole in wanted:
        assert np.min(np.abs(np.log(poles[np.abs(poles) > 0.5]) / 1e-5 - pole)) < 2e-3 * abs(pole)


def test_margins_are_where_it_begins_to_swing() -> None:
    given = servo(60, 'latency = "300 us"\nintegral = "5 Hz"')
    found, each = margins(SHAKER, given, light=1.0), loop_gains(given)

    def radius(factor: float, late: float = 0.3e-3) -> float:
        scaled = LoopGains(each.angle * factor, each.speed * factor, each.integral * factor, each.filter)
        return rotor_loop(scaled, T, late, 1.0, False).radius()

    assert radius(found.gain * 0.999) < 1 < radius(found.gain * 1.001)
    assert radius(0.999 / found.less) > 1 > radius(1.001 / found.less)
    assert radius(1.0, 0.3e-3 + 0.99 * found.delay) < 1 < radius(1.0, 0.3e-3 + 1.01 * found.delay)


def test_delay_lightness_and_encoders_cost_margin() -> None:
    base = margins(SHAKER, servo(60), light=1.0)
    assert margins(SHAKER, servo(60, 'latency = "1 ms"'), light=1.0).phase < base.phase - 10
    assert margins(SHAKER, servo(60), light=1.5).gain < base.gain / 1.4
    read, exact = (servo(60, f'encoder = "{word}"', SAT4) for word in ("stand", "ideal"))
    assert delay(SAT4, read) == pytest.approx(50e-6)
    assert margins(SAT4, read).phase < margins(SAT4, exact).phase - 5


def test_what_is_refused_and_what_is_advised() -> None:
    given = servo(180, 'latency = "1 ms"')
    with pytest.raises(CheckError) as caught:
        check_margins(SHAKER, given, "S.toml")
    words = str(caught.value)
    assert "\n" not in words
    assert words.startswith("S.toml: bandwidth 180 Hz at 1 ms per sample and 1 ms of delay: unstable, its poles reach ")
    advised = float(words.partition("give at most ")[2].partition(" Hz")[0])
    assert check_margins(SHAKER, servo(advised, 'latency = "1 ms"'), "S.toml").are_sufficient
    over = margins(SHAKER, servo(advised * 1.02, 'latency = "1 ms"'))
    assert over.gain < LEAST_GAIN or over.phase < LEAST_PHASE


def test_no_bandwidth_helps() -> None:
    given = servo(20, "damping_ratio = 0.05")
    assert highest_bandwidth(SHAKER, given, 1.0) is None
    with pytest.raises(CheckError, match=r"phase margin \d+ deg .*: a lower bandwidth does not help: give"):
        check_margins(SHAKER, given, "S.toml")
    assert check_margins(SHAKER, replace(given, damping_ratio=0.8), "S.toml").are_sufficient
