"""Prediction of channels and its derivatives, and numbers in the text of a stand file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import mahovik
from identify.data import bench8
from mahovik.core.motion.laws import Constant
from mahovik.core.motion.regime import FlywheelRegime, Regime
from mahovik.core.stand import identities, loads
from mahovik.core.stand.numbers import StandNumber, StandNumbers
from mahovik.out.identify.estimate import slopes
from mahovik.out.identify.free import Free, with_numbers
from mahovik.out.identify.predict import Phase, Predictor, channels_of
from mahovik.use.simulate import judge
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.held import home


def turning(speed: float, begin: float) -> Phase:
    """A constant speed, rad/s."""
    return lambda t, order=0: np.asarray((begin + speed * t, 0.0 * t + speed, 0.0 * t)[order])


@pytest.mark.slow
def test_channels_are_those_of_the_literal_reference() -> None:
    stand, speeds, begins = bench8(3), (100.0, -130.0, 210.0), (0.1, 0.2, 0.3)
    phases = [turning(w, begin) for w, begin in zip(speeds, begins, strict=True)]
    predictor = Predictor(stand, phases, channels_of(stand), 0.0, 1e-3, 31)
    predicted = predictor(Free(stand, ["carrier.mass"]).tables(np.array([[stand.carrier.mass]])), np.zeros((12, 1)))
    wheels = zip(stand.flywheels, speeds, begins, strict=True)
    regime = Regime("constant", tuple(FlywheelRegime(s.name, Constant(w), p) for s, w, p in wheels), {})
    case = Case(stand, regime, home(stand), 0.03)
    start = np.array([0.0] * 3 + [1.0] + [0.0] * 9)
    readings = np.concatenate([at.readings[:, -24:, 0] for at in judge.motion(case, start)])  # of the one point
    expected = np.hstack([readings[:, 18:21], readings[:, 15:18]])
    atol = [5e-4] * 3 + [5e-6] * 3  # 0.21 rad a step: 1e-5 of the motion
    assert np.allclose(expected, predicted[:, :, 0], rtol=0.0, atol=atol)


def test_derivatives_are_those_of_the_channels() -> None:
    stand = bench8(2)
    free = Free(stand, ["w*.unbalance", "carrier.mass", "imu.position"])
    predictor = Predictor(stand, [turning(100.0, 0.0), turning(130.0, 0.0)], channels_of(stand), 0.0, 1e-3, 200)
    theta, start, rng = free.nominal, np.zeros(12), np.random.default_rng(3)
    _, by = slopes(predictor, free, theta, start)
    to, begin = 1e-5 * rng.normal(size=len(theta)), 1e-6 * rng.normal(size=12)
    ends = theta[:, None] + (free.scale * to)[:, None] * [1.0, -1.0]
    ahead, behind = np.moveaxis(predictor(free.tables(ends), begin[:, None] * [1.0, -1.0]), 2, 0)
    expected, predicted = (ahead - behind) / 2, by @ np.concatenate([to, begin / predictor.start_scale])
    assert np.abs(expected - predicted).max() < 1e-7 * np.abs(expected).max()


TEXT = """
schema = 1
name = "bench"
gravity = { value = [0, 0, -981], unit = "cm/s^2" }  # down
[carrier]
mass = "8 kg"  # scale
inertia = [0.12, 0.15, 0.2]
damping = { linear = [1, 2, 3, 4, 5, 6] }
[suspension]
stiffness = [4000, 4000, 6000, 60, 60, "80 N m/rad"]  # springs
[[flywheel]]
name = "w1"
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = "800 g"
spin_inertia = 0.0016
transverse_inertia = { value = [9, 9.5], unit = "kg cm^2" }
unbalance = { static = "0.5 g cm", static_at = "10 deg" }  # a guess
[[point]]
name = "imu"
position = ["10 mm", 0, "20 mm"]
"""


def with_value(stand: mahovik.Stand, path: str, value: float) -> tuple[mahovik.Stand, list[StandNumber]]:
    """The stand with another number, as an estimate changes it, and the place of the number."""
    numbers = StandNumbers(stand, stand.to_dict())
    matches = numbers.find(path)
    return mahovik.Stand.from_dict(numbers.with_values(dict.fromkeys(matches, value))), matches


@pytest.mark.parametrize(
    ("path", "value", "line"),
    [
        ("carrier.mass", 8.25, 'mass = "8.25 kg"  # scale'),
        ("gravity[2]", -9.82, 'gravity = { value = [0, 0, -982.0], unit = "cm/s^2" }  # down'),
        ("suspension.stiffness[1][1]", 4100.0, 'stiffness = [4000, 4100.0, 6000, 60, 60, "80 N m/rad"]  # springs'),
        ("suspension.stiffness[5][5]", 81.0, 'stiffness = [4000, 4000, 6000, 60, 60, "81 N m/rad"]  # springs'),
        ("carrier.damping.linear[0][0]", 1.5, "damping = { linear = [1.5, 2, 3, 4, 5, 6] }"),
        ("w1.spin_inertia", 0.0017, "spin_inertia = 0.0017"),
        ("w1.transverse_inertia[1]", 0.0011, 'transverse_inertia = { value = [9, 11.0], unit = "kg cm^2" }'),
        ("w1.unbalance.static", 2e-6, 'unbalance = { static = "0.2 g cm", static_at = "10 deg" }  # a guess'),
        ("imu.position[0]", 0.012, 'position = ["12 mm", 0, "20 mm"]'),
    ],
)
def test_a_number_keeps_its_form(path: str, value: float, line: str, tmp_path: Path) -> None:
    file = tmp_path / "bench.toml"
    file.write_text(TEXT, encoding="utf-8")
    new, places = with_value(mahovik.load(file), path, value)
    text = with_numbers(TEXT, new, places)
    (changed,) = set(text.splitlines()) - set(TEXT.splitlines())
    assert changed == line
    assert identities(loads(text)) == identities(new)
