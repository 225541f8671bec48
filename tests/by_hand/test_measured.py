"""Phases from encoders and tachos: of a flywheel that turns evenly everything is a straight line.

A count that is read `L` late shows at `t` the phase of `t - L`. With `W` rad/s the phase at `t = 0` of a recording
whose counts begin at zero is `W L`. A tacho whose pulses are a tenth of a turn long rises once a turn: its rising
edges are the zeros of the phase.
"""

from __future__ import annotations

from math import pi, sqrt
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from by_hand.stands import stand, wheel
from identify.data import identified
from mahovik.out.identify.estimate import Loss
from mahovik.out.identify.predict import phase_of as fitted_phase
from mahovik.use.measured.clocks import Recording, find_pulses, phase_of

W, LATE = 200.0, 3e-3
T = np.arange(0.0, 1.0, 1e-3)


@pytest.mark.parametrize(("counted", "late"), [({"w"}, LATE), (set(), 0.0)])
def test_the_latency_of_an_encoder_is_that_of_its_counts(counted: set[str], late: float) -> None:
    encoded = stand(wheel("w", encoder={"counts": 4096, "latency": LATE}))
    frame = pd.DataFrame({"w.phase": W * T}, index=T)
    phase = fitted_phase(Recording(frame, "data", (), frozenset(counted)), encoded, "w")
    assert phase(np.zeros(1)) == pytest.approx(W * late, abs=1e-9)
    assert phase(T, 1) == pytest.approx(W)


def test_a_tacho_is_zero_where_it_rises() -> None:
    phase = W * T - 1.0
    pulses = find_pulses(T, (np.mod(phase, 2 * pi) < 0.2 * pi).astype(float))
    assert pulses is not None
    rises = (1.0 + 2 * pi * np.arange(len(pulses.times))) / W
    assert pulses.times == pytest.approx(rises, abs=6e-4)  # half a sample
    seen = phase_of(pulses, T, 1.0)
    known = np.isfinite(seen)
    assert seen[known] == pytest.approx(phase[known], abs=W * 1.2e-3)


U, AT, NOISE, SAMPLES = 1e-4, 0.8, 0.05, 2000  # kg m, rad, N


@pytest.mark.parametrize("loss", ["linear", "soft_l1"])
def test_unbalance_on_a_force_table_and_its_standard_errors(loss: Loss, tmp_path: Path) -> None:
    """The table holds the carrier with `-U W^2 (cos, sin)` of the phase; n samples of both leave `s / (W^2 sqrt n)`.

    The loss soft_l1 counts a sample that is off by z deviations as 1 / sqrt(1 + z^2) of one.
    """
    t = 1e-3 * np.arange(SAMPLES)
    forces = -U * W**2 * np.stack([np.cos(W * t + AT), np.sin(W * t + AT)], axis=1)
    measured = forces + np.random.default_rng(1).normal(scale=NOISE, size=forces.shape)
    head = "time [s],hold.reaction.x [N],hold.reaction.y [N],w.phase [rad]"
    rows = np.column_stack([t, measured, W * t])
    np.savetxt(tmp_path / "run.csv", rows, fmt="%.12g", delimiter=",", header=head, comments="")
    unbalanced = wheel("w", transverse_inertia=0.011, unbalance={"static": 1.5 * U, "static_at": 0.5})
    held = stand(unbalanced, hold={"freedoms": []})
    parameters, _ = identified(held, tmp_path / "run.csv", "w.unbalance.static*", loss)
    z = np.linspace(-8.0, 8.0, 1601)
    counts = np.exp(-(z**2) / 2) / np.sqrt(1 + z**2) / sqrt(2 * pi) * 0.01
    error = NOISE / W**2 / sqrt(SAMPLES * (1.0 if loss == "linear" else counts.sum()))
    size, at = (parameters[f"w.unbalance.static{key}"] for key in ("", "_at"))
    assert size.standard_error == pytest.approx(error, rel=0.05)
    assert at.standard_error == pytest.approx(error / U, rel=0.05)
    assert abs(size.value - U) < 4 * error and abs(at.value - AT) < 4 * error / U
