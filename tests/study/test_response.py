"""Steady motions: laws they must keep, motion in time, speeds as they are asked for, sweeps."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.motion.regime import steady_regime
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError, UsageError
from mahovik.proof import reference
from mahovik.stands import path
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.run import simulate
from mahovik.use.study.linear import linear_model
from mahovik.use.vibration.lines import LineName, Lines
from mahovik.use.vibration.plant import Scene
from mahovik.use.vibration.speeds import common_period, read_speeds
from mahovik.use.vibration.steady import Steady, steady
from mahovik.use.vibration.study import vibration
from mahovik.use.vibration.view import find_view
from physics.general import suspension_of

RPM = math.pi / 30


@pytest.fixture(scope="module")
def bench8() -> Scene:
    return Scene.of(load(path("bench8")))


def unbalanced(stand: Stand, share: float) -> Stand:
    """The stand with a share of the first flywheel's static unbalance, the others without any, all symmetric."""
    wheels = []
    for k, wheel in enumerate(stand.flywheels):
        x, y, z = wheel.center_of_mass
        c = (x, share * y, share * z) if k == 0 else (0.0, 0.0, 0.0)
        J = wheel.inertia[1][1]
        about = ((wheel.inertia[0][0], 0.0, 0.0), (0.0, J, 0.0), (0.0, 0.0, J))
        wheels.append(replace(wheel, center_of_mass=c, inertia=about, inertia_about="center_of_mass"))
    return replace(
        stand,
        flywheels=tuple(wheels),
        gravity=(0.0, 0.0, 0.0),
    ).with_laws(replace(suspension_of(stand), position=(0.0, 0.0, 0.0)))


def test_small_unbalance_is_answered_as_the_linear_model_says() -> None:
    """The wrench at rest through A, B, C, D; what is left is of the second order in the unbalance."""
    stand, Omega = load(path("bench8")), 40.0
    left = []
    for share in (1e-2, 1e-3):
        one = unbalanced(stand, share)
        harmonic = steady(one, [Omega] + [0.0] * 7).harmonics(find_view(one, "carrier"))[1][1]
        model = linear_model(one, replace(Scene.of(one).rest, phi_dot=(Omega,) + (0.0,) * 7), ["carrier"], locked=True)
        phases = [replace(model.state, phi=(phi,) + (0.0,) * 7) for phi in (0.0, math.pi / 2)]
        # V* at rest without springs is the wrench over K; as the linear model has B = K^-1 there, its forces
        wrenches = [np.linalg.solve(model.B[6:], linear_model(one, at, []).state.V_dot) for at in phases]
        F = wrenches[0] - 1j * wrenches[1]
        H = model.C[6:] @ np.linalg.solve(1j * Omega * np.eye(12) - model.A, model.B) + model.D[6:]
        left.append(np.abs(H @ F - harmonic).max() / np.abs(harmonic).max())
    assert left[0] < 1e-2
    assert left[1] < left[0] / 5


def test_a_floating_stand_keeps_its_centre_of_mass() -> None:
    """sat4: no wrench is needed to hold its mean place, and its momentum is the same at all nodes, in E0: none."""
    stand = load(path("sat4"))
    response = steady(stand, [628.0, 0.0, 314.0, 0.0])
    assert np.abs(response.hold).max() < 1e-14
    assert not response.unstable
    y = response.full().y
    moved = y[:, :6]
    assert np.abs(moved.mean(axis=0)).max() < np.abs(moved).max() ** 2, "its mean place is that of rest to second order"
    states = [response.state(np.array([theta])) for theta in (0.0, 2.0)]
    momenta = [reference.evaluate(stand, state, ["momentum"])["Z0"] for state in states]
    size = 60.0 * np.abs(y[:, 6:9]).max()
    assert np.abs(momenta[0][:3]).max() < 1e-8 * size
    assert np.abs(momenta[1] - momenta[0]).max() < 1e-9


@pytest.mark.parametrize(
    ("speeds", "base", "turns"),
    [
        ((0.0, 0.0), 0.0, (0, 0)),
        ((100.0, -50.0, 0.0), 50.0, (2, -1, 0)),
        ((1000 * RPM, 1010 * RPM), 10 * RPM, (100, 101)),
        ((100 / 3, 100 / 7), 100 / 21, (7, 3)),
    ],
)
def test_common_periods(speeds: tuple[float, ...], base: float, turns: tuple[int, ...]) -> None:
    period = common_period(speeds)
    assert period is not None and period.turns == turns
    assert period.base == pytest.approx(base, rel=1e-12)
    assert np.allclose(period.speeds, speeds, rtol=1e-9, atol=0)


@pytest.mark.parametrize("speeds", [(100.0, 100.0 * math.sqrt(2)), (1.0, 1000.5), (100.0, 100.001)])
def test_speeds_without_a_common_period(speeds: tuple[float, ...]) -> None:
    assert common_period(speeds) is None


def test_speeds_as_asked() -> None:
    stand = load(path("shaker2"))
    asked = read_speeds(stand, ["left=0..600rpm", "right=-0.5*left"])
    assert asked.swept == 0
    assert np.allclose(asked.values(3), [0.0, 300 * RPM, 600 * RPM])
    assert np.allclose(asked.speeds(10.0), [10.0, -5.0])
    assert read_speeds(stand, ["all=10..20"]).speeds(15.0) == (15.0, 15.0)
    assert read_speeds(stand, ["right=-left", "left=10 rpm"]).speeds(0.0) == pytest.approx((10 * RPM, -10 * RPM))
    assert read_speeds(stand, ["left=6rpm..1rad/s"]).sweep == pytest.approx((6 * RPM, 1.0))
    assert read_speeds(stand, ["right=3"]).values(1) == (3.0,)


@pytest.mark.parametrize(
    ("texts", "words"),
    [
        (["up=1"], 'unknown flywheel "up", expected one of left, right, all'),
        (["left"], "expected NAME=SPEED"),
        (["left=50Hz"], "a frequency is not one"),
        (["left=1..2", "right=1..3"], "one can be swept"),
        (["left=right", "right=left"], "follow one another"),
        (["left=1", "left=2"], "has a speed already"),
        (["left=left"], "left follows itself; give it a speed"),
        ("left", "speed left: expected NAME=SPEED"),
        ({"up": 1000.0}, "speed up=1000: unknown flywheel"),
        (["left=5rpm..5rpm"], "expected a range from the lower speed to the higher"),
        (["left=100..10"], "left=100..10: expected a range from the lower speed to the higher"),
        (["left=2**right"], "is not a unit"),
        (["left=1e400"], "left=1e400"),
        (["left=0..1e6"], "at most 100000 is possible"),
        (["left=1e5", "right=2*left"], "right would turn at"),
    ],
)
def test_speeds_that_are_refused(texts: str | list[str] | dict[str, float], words: str) -> None:
    with pytest.raises(UsageError, match=words.replace("*", r"\*")) as error:
        read_speeds(load(path("shaker2")), texts)
    assert "\n" not in str(error.value)


def test_a_sweep_finds_the_resonance(bench8: Scene) -> None:
    speeds = read_speeds(bench8.stand, ["w1=30..150rpm", "w2=w1"])
    sweep = vibration(bench8, speeds, find_view(bench8.stand, "carrier", "displacement"), steps=13)
    peak = sweep.value[sweep.largest().step]
    assert 80 * RPM < peak < 120 * RPM
    assert sweep.largest().frequency * 2 * np.pi == pytest.approx(peak)
    assert np.isfinite(sweep.sums().rms).all() and sweep.coarse is None


def undamped(share: float) -> Stand:
    """bench8 with an unbalanced flywheel alone, and springs without damping: 1.5 Hz in translation."""
    stand = unbalanced(load(path("bench8")), share)
    return stand.with_laws(replace(suspension_of(stand), damping=((0.0,) * 6,) * 6))


def test_an_undamped_resonance_is_a_problem_and_the_sweep_goes_on() -> None:
    stand = undamped(1.0)
    view = find_view(stand, "carrier")
    sweep = vibration(stand, read_speeds(stand, ["w1=84..96rpm"]), view, steps=3)
    at = int(np.argmin(np.abs(sweep.value - 90 * RPM)))
    assert {0, len(sweep.value) - 1}.isdisjoint(sweep.problems)
    assert "an undamped resonance, or the carrier moves too violently" in sweep.problems[at]
    assert np.isnan(sweep.sums().rms[at]).all()
    with pytest.raises(CheckError, match="an undamped resonance"):
        vibration(stand, read_speeds(stand, ["w1=90rpm"]), view)


def test_a_heavy_unbalance_is_unstable() -> None:
    heavy = steady(undamped(100.0), [2 * math.pi * 1.8] + [0.0] * 7)  # parametric resonance
    assert heavy.multiplier > 1.1
    assert heavy.unstable


def test_rms_of_a_band() -> None:
    amplitudes = np.array([[[3.0, 0, 0], [4.0j, 1.0, 0]]])
    lines = Lines((LineName("w", 1.0), LineName("w", 2.0)), np.array([[10.0, 20.0]]), amplitudes)
    assert np.allclose(lines.sums().rms, [5 / math.sqrt(2), 1 / math.sqrt(2), 0])
    assert np.allclose(lines.sums(band=(5.0, 15.0)).rms, [3 / math.sqrt(2), 0, 0])
    assert np.allclose(lines.sums(band=(20.0, 30.0)).rms[0, 0], 4 / math.sqrt(2))


POSE_AND_V = (
    *("x [m]", "y [m]", "z [m]", "qw", "qx", "qy", "qz", "v_x [m/s]", "v_y [m/s]", "v_z [m/s]"),
    *(f"omega_{a} [rad/s]" for a in "xyz"),
)


def returned(motion: Steady, periods: int) -> float:
    """Distance of the carrier from where it began after some periods, relative to its amplitude."""
    until = periods * 2.0 * math.pi / motion.base[0]
    regime = steady_regime(motion.scene.stand, motion.speeds.tolist())
    run = simulate(Case(motion.scene.stand, regime, motion.state(np.zeros(1)), until, until), "scipy")
    data = np.column_stack([run[name] for name in POSE_AND_V])
    off, size = np.abs(data[-1] - data[0]), np.ptp(motion.full().y, axis=0)
    parts = ((slice(0, 3), 1.0), (slice(3, 7), 2.0), (slice(7, 10), 1.0), (slice(10, 13), 1.0))
    return float(max(k * off[a].max() / size[3 * i : 3 * i + 3].max() for i, (a, k) in enumerate(parts)))


def test_the_reference_comes_back_after_a_period() -> None:
    assert returned(steady(load(path("bench8")), [62.8] * 8), 1) < 1e-8
