"""Prediction of channels and its derivatives, the solver, and numbers in the text of a stand file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import least_squares

import mahovik
from identify.data import bench8, constant
from mahovik.core.stand import identities, loads
from mahovik.core.stand.numbers import StandNumber, StandNumbers
from mahovik.errors import UsageError
from mahovik.out.api.model import build
from mahovik.out.identify.channels import channel_of, six_axes
from mahovik.out.identify.document import with_numbers
from mahovik.out.identify.free import Free
from mahovik.out.identify.gauss_newton import LOSSES, Loss, minimise
from mahovik.out.identify.jacobian import slopes, values
from mahovik.out.identify.predict import Predictor
from mahovik.use.simulate import judge
from mahovik.use.simulate.case import Case


@pytest.mark.slow
def test_channels_are_those_of_the_literal_reference() -> None:
    stand = bench8(3)
    regime = constant(stand, [100.0, -130.0, 210.0], [0.1, 0.2, 0.3])
    predictor = Predictor(stand, regime, six_axes("imu"), 0.0, 1e-3, 31)
    found = predictor(build(stand).tables({}, 1))[:, :, 0]
    case = Case(stand, regime, predictor._case.start, 0.03)
    imu = [p.name for p in (*stand.instruments, *stand.points)].index("imu")
    start = np.array([*case.start.position, *(case.start.quaternion or (1.0, 0.0, 0.0, 0.0)), *case.start.V])
    readings = np.concatenate([at.readings[:, 24 * imu : 24 * imu + 24, 0] for at in judge.motion(case, start)])
    expected = np.hstack([readings[:, 18:21], readings[:, 15:18]])
    assert np.allclose(expected, found, rtol=0.0, atol=[5e-4] * 3 + [5e-6] * 3)  # 0.21 rad a step: 1e-5 of the motion


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


@pytest.mark.parametrize("loss", LOSSES)
def test_the_least_loss_is_that_of_scipy(loss: Loss) -> None:
    rng = np.random.default_rng(3)
    t = np.linspace(0.0, 2.0, 80)
    y = 2.0 * np.exp(-0.8 * t) + 0.01 * rng.normal(size=80)
    y[::10] += 1.0

    def residuals(z: np.ndarray) -> np.ndarray:
        return np.asarray((z[0] * np.exp(-z[1] * t) - y) / 0.05)

    def jacobian(z: np.ndarray, _exact: bool = True) -> np.ndarray:
        decay = np.exp(-z[1] * t)
        return np.column_stack([decay, -z[0] * t * decay]) / 0.05

    expected = least_squares(residuals, [1.0, 0.1], jacobian, loss=loss, xtol=1e-12, ftol=1e-14, gtol=1e-12).x
    assert np.allclose(minimise(residuals, jacobian, np.array([1.0, 0.1]), loss), expected, rtol=1e-4)


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
    found = numbers.find(path)
    return mahovik.Stand.from_dict(numbers.with_values(dict.fromkeys(found, value))), found


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
