"""Experiments that are found: bounds, information against other ways to it, and what the search keeps."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mahovik
from identify.data import HIGH, LOW, STEEP, bench8, check_predicted_errors
from identify.test_held import START, STICK, TRUE, table
from mahovik.core.motion.programme import programme_text, read_programme
from mahovik.core.motion.read import loads_regime
from mahovik.errors import RegimeError, UsageError
from mahovik.out.api.model import build
from mahovik.out.api.stands import Stand
from mahovik.out.identify.channels import chosen_channels, six_axes
from mahovik.out.identify.deviations import Deviations
from mahovik.out.identify.estimate import PRIOR, PRIOR_START
from mahovik.out.identify.excite import face
from mahovik.out.identify.excite.bounds import Bounds, bounds_of
from mahovik.out.identify.excite.course import Courses
from mahovik.out.identify.excite.information import quality_of
from mahovik.out.identify.excite.noise import noise_of_channels
from mahovik.out.identify.free import Free


@cache
def courses(N: int = 3, harmonics: int = 2) -> Courses:
    stand = bench8(N)
    return Courses(stand, bounds_of(stand, HIGH, LOW, STEEP, None, 2.0), 2.0, harmonics)


@pytest.fixture
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    """A search of some programmes."""
    monkeypatch.setattr(face, "EVALUATIONS", 16)


@settings(max_examples=25)
@given(st.lists(st.floats(0.0, 1.0), min_size=15, max_size=15), st.floats(0.0, 1.0))
def test_all_numbers_give_programmes_inside_the_bounds(numbers: list[float], share: float) -> None:
    programme = courses().programme(np.array(numbers).reshape(3, 5), share)
    phi, speed, acceleration = programme.at(np.linspace(0.0, 2.0, 801))
    assert speed.min() >= LOW * (1 - 1e-12) and speed.max() <= HIGH * (1 + 1e-12)
    assert np.abs(acceleration).max() <= STEEP * (1 + 1e-12)
    assert np.allclose(phi[-1] - phi[0], 2 * np.pi * np.array(programme.winding))
    assert np.allclose(np.gradient(phi[:, 0], 2.0 / 800)[1:-1], speed[1:-1, 0], atol=1e-2)


@pytest.mark.slow
def test_information_is_that_of_a_dense_least_squares() -> None:
    """The covariance equals that of one least-squares problem in which the offsets of the channels are unknowns too."""
    rng = np.random.default_rng(2)
    free = Free(build(bench8(1)), ["w1.unbalance.static", "carrier.mass"])
    T, C, k, scale = 40, 6, 2, Deviations(free.stand).scale
    J, S = rng.normal(size=(T, C, k)) / free.scale, rng.normal(size=(T, C, 12)) / scale
    found = quality_of(J, S, free, 3.0)
    offsets = np.kron(np.ones((T, 1)), np.eye(C))
    rows = np.sqrt(3.0) * np.hstack([J.reshape(-1, k), S.reshape(-1, 12), offsets])
    prior = np.diag(np.concatenate([1 / (PRIOR * free.scale), 1 / (PRIOR_START * scale), np.zeros(C)]))
    whole = np.linalg.pinv(np.vstack([rows, prior]))
    expected = (whole @ whole.T)[:k, :k]
    assert np.allclose(found.covariance, expected, rtol=1e-9)
    assert found.mean_variance == pytest.approx(np.mean(np.diag(expected) / free.scale**2))
    assert found.volume == pytest.approx(np.linalg.det(expected / np.outer(free.scale, free.scale)) ** (1 / k))


@pytest.mark.slow
def test_predicted_errors_are_those_of_the_estimation() -> None:
    """An estimate from data with this noise states the same covariance."""
    check_predicted_errors(bench8(2), ["w*.unbalance"], six_axes("imu"), np.repeat([0.02, 0.002], 3))


def test_a_programme_is_a_regime() -> None:
    own = courses(2)
    text = programme_text(own.programme(np.full((2, 5), 0.7)))
    t = np.linspace(0.0, 3.0, 11)
    phi, speed, acceleration = loads_regime(text, own.stand, 3.0, is_json=True).motion(t)
    expected = read_programme(text).at(t)
    assert np.allclose(phi, expected.phi - expected.phi[0], rtol=0, atol=1e-11)
    assert np.allclose(speed, expected.phi_dot, rtol=1e-14)
    assert np.allclose(acceleration, expected.phi_ddot, rtol=0, atol=1e-11)
    with pytest.raises(RegimeError, match="programme of the flywheels w1, w2; the stand has w1"):
        loads_regime(text, bench8(1), 1.0, is_json=True)


def test_bounds_by_name_and_by_motor() -> None:
    keys = bench8(2).to_dict()
    keys["flywheel"][0]["motor"] = {"torque": 0.4, "speed": 50.0}
    stand = Stand.from_dict(keys)
    found = bounds_of(stand, {"w2": 80.0}, None, [1.0, 2.0], None, 10.0)
    assert found.speed.tolist() == [50.0, 80.0] and found.acceleration.tolist() == [1.0, 2.0]
    own = np.array([0.1, 0.1, -0.1])
    assert np.allclose(found.available(stand, 0, own, np.array([0.0, 25.0, 25.0])), [0.4, 0.2, 0.4])
    assert isinstance(found, Bounds)


QUICK: dict[str, Any] = {"speed": "1000 rpm", "duration": 0.5, "rate": 500.0}


@pytest.mark.usefixtures("few")
def test_on_a_force_table_errors_are_those_of_a_closed_formula() -> None:
    """A static unbalance U turns with a force U w^2 in two directions: T samples tell each of its two parts to
    sigma / (w^2 sqrt T).
    """
    found = mahovik.excite(
        TRUE, free="second.unbalance.static,second.unbalance.static_at", channels=["hold.reaction.[xyz]"],
        noise={"force": "50 mN"}, harmonics=0, **QUICK,
    )  # fmt: skip
    (static, at), (U, _) = found["error"], found["value"]
    speed = found.found.peaks.speed[[wheel.name for wheel in TRUE.flywheels].index("second")]
    assert static == pytest.approx(0.05 / speed**2 / np.sqrt(250.0), rel=1e-3)
    assert at == pytest.approx(static / U, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("freedoms", [[], ["pitch"], ["x", "z", "pitch"]])
def test_predicted_errors_of_a_held_carrier_are_those_of_the_estimation(freedoms: list[str]) -> None:
    """An estimate from data with this noise states the same covariance."""
    stand = table(freedoms, **START)
    channels = chosen_channels(stand, ())
    check_predicted_errors(stand, ["*.unbalance"], channels, noise_of_channels(channels, {}))


def test_a_free_carrier_has_no_reaction() -> None:
    free = {key: value for key, value in STICK.items() if key != "hold"}
    with pytest.raises(UsageError, match=r'no channel of stick is called "hold.reaction.x"'):
        mahovik.excite(Stand.from_dict(free), channels=["hold.reaction.x"], **QUICK)
