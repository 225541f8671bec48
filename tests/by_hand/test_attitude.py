"""Settings of an attitude loop of three equal wheels along x, y, z, all of them by algebra.

Each wheel holds `h = J_spin W0` at the no-load speed `W0` of its motor, and turns with the torque `tau`. Three equal
axes reach a cube, in every direction `h` and `tau`. At the beginning the momentum `H` is along x, where the first wheel
turns with `H / J_spin`: the part `1 - H / h` of all this is left, and a quarter of it is taken. With the largest
moment of inertia `J` a reference turns at most with

    rate = 0.25 (1 - H / h) h / J,        acceleration = 0.25 (1 - H / h) tau / J.

Errors obey `s^2 + 2 zeta w s + w^2`, with the bandwidth `w = 2 pi f`. Momentum is dumped at `w / 5`, with half the
torque of a motor at most; that takes `H / tau_d`, then decays from `tau_d / (w / 5)` to the end.
"""

from __future__ import annotations

from math import ceil, log, pi

import pytest

from by_hand.stands import SPIN, stand, wheel
from mahovik.use.control.attitude import LoopOptions, design_attitude

J, TAU, W0, H = 40.0, 0.05, 600.0, 2.0  # kg m2, N m, rad/s, N m s
AXES = {"a": ([1, 0, 0], [0, 1, 0]), "b": ([0, 1, 0], [0, 0, 1]), "c": ([0, 0, 1], [1, 0, 0])}


def test_settings_of_three_equal_wheels() -> None:
    motor = {"torque": TAU, "speed": W0, "viscous": 1e-5, "coulomb": 2e-3, "coulomb_speed": 0.5}
    wheels = [wheel(name, axis=axis, zero=zero, motor=motor) for name, (axis, zero) in AXES.items()]
    largest = J - (SPIN + 2 * 0.01)  # of the carrier: each wheel adds its spin inertia along one axis
    carrier = {"inertia": [largest, 0.8 * largest, 0.9 * largest], "wrench_input": True}
    task = {"pointing": {"rows": ["wx", "wy", "wz"]}}
    options = LoopOptions(rate=20.0, bandwidth=0.2, damping=0.7, momentum=H, failure="none")
    made = design_attitude(stand(*wheels, carrier=carrier, task=task), options)

    h, w, T = SPIN * W0, 2 * pi * 0.2, 0.05
    left = 0.25 * (1 - H / h)
    end, dump = 1e-3 * H, TAU / 2
    assert made.speeds == pytest.approx((H / SPIN, 0.0, 0.0))
    assert made.settings == {
        "period": T,
        "bandwidth": pytest.approx(w),
        "damping": 0.7,
        "integral": pytest.approx(0.25 * w),
        "integral_most": 0.1,
        "closing_rate": pytest.approx(left * h / J),
        "slew_rate": pytest.approx(left * h / J),
        "slew_acceleration": pytest.approx(left * TAU / J),
        "preferred": pytest.approx((0.0,) * 3),
        "preferred_rate": 0.0,
        "avoid": 0.0,
        "viscous": (1e-5,) * 3,
        "coulomb": (2e-3,) * 3,
        "coulomb_speed": (0.5,) * 3,
        "wanted_momentum": (0.0,) * 3,
        "dump_rate": pytest.approx(w / 5),
        "dump_torque": pytest.approx(dump),
        "dump_begin": pytest.approx(5 * end),
        "dump_end": pytest.approx(end),
    }
    assert made.samples["settle"] == round(25.0 / (w * T)) + 4
    dumped = H / dump + log(dump / (w / 5) / end) / (w / 5)
    assert made.samples["dump"] == round(1.1 * dumped / T) + made.samples["settle"]
    assert made.parts == ceil(T * 2 * max(H / SPIN, 0.1 * W0) / 0.8)
