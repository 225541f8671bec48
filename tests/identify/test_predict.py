"""Prediction of channels against the literal reference, and its derivatives against differences it has not used."""

from __future__ import annotations

import numpy as np
import pytest

from identify.stands import bench8, constant
from mahovik.core.motion.laws import Harmonic
from mahovik.core.motion.regime import FlywheelRegime, Regime
from mahovik.errors import UsageError
from mahovik.out.api.model import build
from mahovik.out.identify.channels import channel_of, six_axes
from mahovik.out.identify.free import Free
from mahovik.out.identify.jacobian import slopes, values
from mahovik.out.identify.predict import Predictor, shift_regime
from mahovik.use.simulate.by_scipy import SciPyMotion
from mahovik.use.simulate.case import Case


@pytest.mark.slow
def test_channels_are_those_of_the_literal_reference() -> None:
    stand = bench8(3)
    regime = constant(stand, [100.0, -130.0, 210.0], [0.1, 0.2, 0.3])
    predictor = Predictor(stand, regime, six_axes("imu"), 0.0, 1e-3, 31)
    found = predictor(build(stand).tables({}, 1))[:, :, 0]
    case = Case(stand, regime, predictor._case.start, 0.03)
    for row, moment in zip(found, SciPyMotion(case).moments(False), strict=True):
        reading = moment.points["imu"]
        expected = [*reading["specific_force"], *reading["twist"][3:]]
        assert np.allclose(expected, row, rtol=0.0, atol=[5e-4] * 3 + [5e-6] * 3)  # 0.21 rad a step: 1e-5 of the motion


def test_derivatives_are_those_of_the_channels() -> None:
    stand = bench8(2)
    free = Free(build(stand), ["w*.unbalance", "carrier.mass", "imu.position", "imu.delay"])
    predictor = Predictor(stand, constant(stand, [100.0, 130.0]), six_axes("imu"), 0.0, 1e-3, 200)
    theta, start = free.nominal, np.zeros(12)
    theta[-1] = 3e-4
    at = slopes(predictor, free, theta, start)
    rng = np.random.default_rng(3)
    to, begin = 1e-5 * free.scale * rng.normal(size=len(theta)), 1e-6 * rng.normal(size=12)
    ahead, behind = values(predictor, free, theta + to, begin), values(predictor, free, theta - to, -begin)
    expected, found = (ahead - behind) / 2, at.by_theta @ to + at.by_start @ begin
    seen = slice(5, None)  # before that the delayed sensor tells what was before the first predicted time
    assert np.abs(expected - found)[seen].max() < 1e-7 * np.abs(expected).max()


def test_a_later_beginning_is_the_same_motion() -> None:
    stand = bench8(2)
    wheels = tuple(FlywheelRegime(s.name, Harmonic(100.0, 20.0, 3.0, 0.2), 0.4) for s in stand.flywheels)
    regime = Regime("swing", wheels, {})
    t = np.linspace(0.0, 1.0, 9)
    later, whole = shift_regime(regime, 0.7).motion(t), regime.motion(t + 0.7)
    assert np.allclose(later[0] - later[0][0], whole[0] - whole[0][0])
    assert np.allclose(later[1:], whole[1:])


@pytest.mark.parametrize(
    ("name", "words"),
    [("im.rate.x", 'did you mean "imu"'), ("imu.rate.w", ".x, .y or .z"), ("imu.speed.x", "imu.acceleration or")],
)
def test_unknown_channels_are_named(name: str, words: str) -> None:
    with pytest.raises(UsageError, match=words):
        channel_of(name, bench8(1))


@pytest.mark.parametrize(
    ("path", "words"), [("w9.mass", 'no "w9"'), ("imo.delay", 'did you mean "imu"'), ("w1.encoder.counts", "no|acts")]
)
def test_unknown_free_numbers_are_named(path: str, words: str) -> None:
    with pytest.raises(UsageError, match=words):
        Free(build(bench8(1)), [path])
