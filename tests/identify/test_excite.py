"""Experiments that are found: bounds, information against other ways to it, and what the search keeps."""

from __future__ import annotations

import os
import signal
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mahovik
from identify.experiments import HIGH, LOW, STEEP, check_predicted_errors
from identify.stands import bench8
from mahovik.core.motion.programme import load_programme, programme_text, read_programme
from mahovik.core.motion.read import load, loads_regime
from mahovik.errors import RegimeError
from mahovik.out.api.model import build
from mahovik.out.api.stands import Stand
from mahovik.out.identify.channels import six_axes
from mahovik.out.identify.deviations import Deviations
from mahovik.out.identify.estimate import PRIOR, PRIOR_START
from mahovik.out.identify.excite import face
from mahovik.out.identify.excite.bounds import Bounds, bounds_of
from mahovik.out.identify.excite.course import Courses
from mahovik.out.identify.excite.information import quality_of
from mahovik.out.identify.free import Free

SECONDS = 0.5


@cache
def courses(N: int = 3, harmonics: int = 2) -> Courses:
    stand = bench8(N)
    return Courses(stand, bounds_of(stand, HIGH, LOW, STEEP, None, 2.0), 2.0, harmonics)


def moderate(N: int, **options: object) -> face.Excitation:
    """A small search."""
    settings = {"speed": "1000 rpm", "speed_min": "400 rpm", "duration": SECONDS, "rate": 500.0, **options}
    return mahovik.excite(bench8(N), **settings)  # type: ignore[arg-type]


@pytest.fixture
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    """A search of some programmes."""
    monkeypatch.setattr(face, "EVALUATIONS", 16)


@given(st.lists(st.floats(0.0, 1.0), min_size=15, max_size=15), st.floats(0.0, 1.0))
def test_all_numbers_give_programmes_inside_the_bounds(numbers: list[float], share: float) -> None:
    programme = courses().programme(np.array(numbers).reshape(3, 5), share)
    phi, speed, acceleration = programme.at(np.linspace(0.0, 2.0, 801))
    assert speed.min() >= LOW * (1 - 1e-12) and speed.max() <= HIGH * (1 + 1e-12)
    assert np.abs(acceleration).max() <= STEEP * (1 + 1e-12)
    assert np.allclose(phi[-1] - phi[0], 2 * np.pi * np.array(programme.winding))
    assert np.allclose(np.gradient(phi[:, 0], 2.0 / 800)[1:-1], speed[1:-1, 0], atol=1e-2)


def test_modulations_use_what_is_allowed() -> None:
    """The whole room about the mean speed, or the whole acceleration."""
    numbers = np.tile([0.5, 1.0, 0.5, 0.5, 0.5], (3, 1))
    own = courses()
    assert np.abs(own.programme(numbers).at(np.linspace(0.0, 2.0, 801)).phi_ddot).max() == pytest.approx(STEEP)
    wide = Courses(own.stand, bounds_of(own.stand, HIGH, LOW, None, None, 2.0), 2.0, 2)
    speeds = wide.programme(numbers).at(np.linspace(0.0, 2.0, 801)).phi_dot
    assert np.ptp(speeds[:, 0]) > 0.9 * (HIGH - LOW)


def test_constant_speeds_are_distinct_and_reach_both_bounds() -> None:
    own = courses(8)
    programme = own.programme(own.even())
    speed = programme.at(np.zeros(1)).phi_dot[0]
    assert len(set(programme.winding)) == 8
    assert HIGH - own.base < speed[-1] <= HIGH and LOW <= speed[0] < LOW + own.base
    assert np.ptp(programme.at(np.linspace(0.0, 2.0, 50)).phi_dot, axis=0).max() == 0.0


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


@pytest.mark.slow
@pytest.mark.usefixtures("few")
def test_a_search_lowers_the_variance_inside_the_bounds(tmp_path: Path) -> None:
    found = moderate(3, acceleration=50.0)
    assert found.status == "OK" and found.gain > 1.5 and found.effort["tried"] == 16
    kept = found.found.peaks
    assert kept.speed.max() <= 1000 * np.pi / 30 and kept.speed_min.min() >= 400 * np.pi / 30
    assert (found["error"] > 0.0).all() and found["error"].shape == (12,)
    assert np.mean(found["error"] / found["error at constant speeds"]) < 0.9
    again = moderate(3, acceleration=50.0)
    assert programme_text(again.found.programme) == programme_text(found.found.programme)
    found.save(tmp_path / "p.json")
    kept_file = load_programme(tmp_path / "p.json")
    t = np.linspace(0.0, SECONDS, 7)
    assert np.array_equal(kept_file.at(t).phi, found.found.programme.at(t).phi)
    assert kept_file.report["peak_speed"] == kept.speed.tolist()


@pytest.mark.slow
@pytest.mark.usefixtures("few")
def test_a_moment_of_inertia_needs_changing_speeds() -> None:
    """The moment about its axis acts mostly by the acceleration of the flywheel."""
    found = moderate(1, free="w1.inertia.J11", speed="300 rpm", speed_min=None)
    assert found.gain > 100.0
    assert found.found.peaks.acceleration.max() > 1.0 and found.even.peaks.acceleration.max() == 0.0


@pytest.mark.slow
@pytest.mark.usefixtures("few")
def test_motors_limit_the_modulation() -> None:
    options = {"free": "w1.inertia.J11", "speed": "300 rpm", "speed_min": "60 rpm"}
    loose = moderate(1, **options)
    most = 0.5 * float(loose.found.peaks.torque[0])
    found = moderate(1, **options, torque=most)
    if found.status == "OK":
        assert found.found.peaks.torque[0] <= most
    else:
        assert "torque" in found.words[0]
    assert found.found.peaks.acceleration[0] < loose.found.peaks.acceleration[0]
    impossible = moderate(1, **options, torque=1e-6)
    assert impossible.status == "OK_LIMIT" and "w1: torque of" in impossible.words[0]


@pytest.mark.slow
def test_ctrl_c_keeps_the_best_so_far() -> None:
    def press(now: mahovik.Progress) -> None:
        if now.done == 12:
            os.kill(os.getpid(), signal.SIGINT)

    found = moderate(2, progress=press)
    assert found.interrupted and found.effort["tried"] <= 14 and found.gain >= 1.0


def test_a_programme_is_a_regime(tmp_path: Path) -> None:
    own = courses(2)
    programme = own.programme(np.full((2, 5), 0.7))
    text = programme_text(programme)
    path = tmp_path / "p.json"
    path.write_text(text, encoding="utf-8")
    t = np.linspace(0.0, 3.0, 11)
    phi, speed, acceleration = load(path, own.stand, 3.0).motion(t)
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
