"""Phases from encoders and tachos: of a flywheel that turns evenly everything is a straight line.

A count that is read `L` late shows at `t` the phase of `t - L`. With `W` rad/s the phase at `t = 0` of a recording
whose counts begin at zero is `W L`. A tacho whose pulses are a tenth of a turn long rises once a turn: its rising
edges are the zeros of the phase.
"""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from by_hand.stands import stand, wheel
from mahovik.core.motion.laws import Constant
from mahovik.out.identify.phases import motion_of
from mahovik.use.measured.recording import Channel, Recording
from mahovik.use.measured.tacho import find_pulses, phase_of

W, LATE = 200.0, 3e-3
T = np.arange(0.0, 1.0, 1e-3)


@pytest.mark.parametrize(("source", "late"), [("count", LATE), ("", 0.0)])
def test_the_latency_of_an_encoder_is_that_of_its_counts(source: str, late: float) -> None:
    own = stand(wheel("w", encoder={"counts": 4096, "latency": LATE}))
    channel = Channel("flywheel", "w", "phase", "", "rad", W * T, source)
    found = motion_of(Recording(T, (channel,), "data"), own).flywheels[0]
    assert found.phase == pytest.approx(W * late, abs=1e-9)
    assert isinstance(found.law, Constant) and found.law.speed == pytest.approx(W)


def test_a_tacho_is_zero_where_it_rises() -> None:
    phase = W * T - 1.0
    found = find_pulses(T, (np.mod(phase, 2 * pi) < 0.2 * pi).astype(float))
    assert found is not None
    rises = (1.0 + 2 * pi * np.arange(len(found.times))) / W
    assert found.times == pytest.approx(rises, abs=6e-4)  # half a sample
    seen = phase_of(found, T, 1.0)
    known = np.isfinite(seen)
    assert seen[known] == pytest.approx(phase[known], abs=W * 1.2e-3)
