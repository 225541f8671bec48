"""Two exciters with motor curves on a table: the motion is that of Lagrange's equations by SciPy; they synchronise."""

from __future__ import annotations

import sys
from functools import lru_cache
from typing import Any

import numpy as np
import pytest

import mahovik
from docs.pages import ROOT, blocks
from mahovik.core.stand import loads
from mahovik.stands import path, servo_and_regime

sys.path.append(str(ROOT / "bench"))

from mahovik_bench.exciters import curves_of, lagrange

FILES = {block.file: block.text for block in blocks(ROOT / "docs/studies.md") if block.file}
REGIME = servo_and_regime("two_exciters")["regime"]
TWO_PI = 2 * np.pi


@lru_cache
def run(inertia: tuple[float, ...]) -> Any:
    stand = mahovik.example("two_exciters").replace({"carrier.inertia": inertia})
    at_home = [0, 0, 0, 1, *[0] * 10, 2, 0, 0]
    return mahovik.build(stand).simulate(8.0, regime=str(REGIME), start=at_home, dt=5e-4, every=0.01)


LIGHT, HEAVY = (2.0, 2.5, 3.0), (6.0, 10.0, 6.0)


def test_the_motion_is_that_of_lagranges_equations() -> None:
    motion = run(LIGHT)
    until = 1.5
    times = motion["t"][motion["t"] <= until + 1e-9]
    y = lagrange(2.5, curves_of(path("two_exciters")), until, times)
    n = len(times)
    assert motion["position"][:n, [0, 2]] == pytest.approx(y[:, :2], abs=2e-6)
    assert motion["phi"][:n] == pytest.approx(y[:, 3:5], abs=2e-4)
    assert motion["phi_dot"][:n] == pytest.approx(y[:, 8:], abs=1e-2)


@pytest.mark.parametrize(("inertia", "in_phase"), [(LIGHT, True), (HEAVY, False)])
def test_exciters_fall_into_step_by_the_known_condition(inertia: tuple[float, ...], in_phase: bool) -> None:
    motion = run(inertia)
    total = inertia[1] + 2 * (2 * 0.16 + 0.012)
    assert (64 * 0.16 / total > 2) == in_phase
    apart = motion["phi"][-200:, 0] - motion["phi"][-200:, 1]
    assert np.ptp(apart) < 0.05
    off = (apart - (0.0 if in_phase else np.pi) + np.pi) % TWO_PI - np.pi
    assert np.abs(off).max() < 0.5


def test_a_motor_of_the_file_hangs_as_one_that_delivers_its_line() -> None:
    """The limit of the file, commanded beyond, and the same line as what is delivered: one motion while it drives."""
    curve = [[0, 0.35], ["1500 rpm", 0]]
    stand = mahovik.Stand.of(loads(FILES["rail.toml"])).replace({"ex.motor": {"torque_speed": curve}})
    model = mahovik.build(stand)
    laws = ({"torque": 0.5}, {"torque_speed": curve})
    limited, delivered = (
        model.simulate(5.0, regime={"flywheel": {"ex": law}}, dt=1e-3, every=0.1)["phi"] for law in laws
    )
    np.testing.assert_allclose(limited, delivered, rtol=0, atol=1e-9)


@pytest.mark.parametrize(("torque", "speed"), [(0.35, 60.81), (4.0, 140.0)])
def test_a_weak_motor_hangs_at_the_resonance(torque: float, speed: float) -> None:
    """The powers of motor and vibration are equal at 60.81 rad/s, a little below sqrt(k / m) = 62.83 rad/s."""
    model = mahovik.build(mahovik.Stand.of(loads(FILES["rail.toml"])))
    curve = [[0, torque], [50 * np.pi, 0]]
    motion = model.simulate(20.0, regime={"flywheel": {"ex": {"torque_speed": curve}}}, dt=1e-3, every=0.01)
    mean_speed = motion["phi_dot"][-500:, 0].mean()
    assert mean_speed == pytest.approx(speed, abs=0.05) if torque < 1.0 else mean_speed > speed
