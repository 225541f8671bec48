"""Faults of data that an identification tells: signs and axes beside channels of noise, senses of phases, bad fits."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path

import numpy as np
import pytest

import mahovik
from identify.data import Array, recorded, stand_text, with_noise, write_csv
from mahovik.out.identify.face import Identification, _correlation, _errors
from toolchain.quick import quick

SILENT = (3, 4, 6)
"""Channels made noise alone: acceleration z, rates x and z."""


@pytest.fixture(scope="module")
def truth() -> mahovik.Stand:
    return mahovik.Stand.from_dict(tomllib.loads(stand_text()))


@pytest.fixture(scope="module")
def clean(truth: mahovik.Stand) -> Array:
    """Data with noise; three channels have noise alone, ten times what the stand would show there."""
    rows = with_noise(recorded(truth, duration=0.8), 20.0, 7)
    rng = np.random.default_rng(8)
    for c in SILENT:
        rows[:, c] = 10.0 * rows[:, c].std() * rng.normal(size=len(rows))
    return rows


def identified(folder: Path, truth: mahovik.Stand, rows: Array) -> Identification:
    return mahovik.identify(truth, write_csv(folder / "run.csv", rows), "w*.unbalance")


@pytest.mark.slow
def test_channels_of_noise_fake_nothing(tmp_path: Path, truth: mahovik.Stand, clean: Array) -> None:
    found = identified(tmp_path, truth, clean)
    assert found.notes == ()
    assert found.residual == pytest.approx(0.05, rel=0.15)  # of the channels with a signal
    shares = {name: each.share for name, each in next(iter(found.channels.values())).items()}
    assert shares["imu.rate.x"] == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize("channel", quick(0, [1, 5]))
def test_channels_of_noise_hide_no_sign(tmp_path: Path, truth: mahovik.Stand, clean: Array, channel: int) -> None:
    rows = clean.copy()
    rows[:, channel] *= -1.0
    name, axis = {1: ("imu.acceleration", "x"), 5: ("imu.rate", "y")}[channel]
    bad, wrong = identified(tmp_path, truth, rows).notes
    assert f"{name}.{axis}" in bad.split(":")[0] and "% of the data: a sign" in bad
    assert wrong.startswith(f"{name}: signs or axes are evidently wrong: with {axis} = -{axis} the fit leaves")


@pytest.mark.slow
def test_a_phase_of_the_wrong_sense_is_told(tmp_path: Path, truth: mahovik.Stand, clean: Array) -> None:
    rows = clean.copy()
    rows[:, 7] *= -1.0
    *_, note = identified(tmp_path, truth, rows).notes
    assert note.startswith("w1: the phase evidently runs the other way: turned round, the fit leaves")


@pytest.mark.slow
def test_a_bad_fit_of_other_reasons_accuses_no_sensor(tmp_path: Path, truth: mahovik.Stand, clean: Array) -> None:
    """The unbalance of w1 is elsewhere, and not free."""
    file = write_csv(tmp_path / "run.csv", clean)
    at = mahovik.identify(truth, file, "w1.unbalance.static_at").parameters["w1.unbalance.static_at"].before
    found = mahovik.identify(truth.replace({"w1.unbalance.static_at": at + 1.7}), file, "w2.unbalance")
    (note,) = found.notes
    assert "or a number that is not free?" in note


@pytest.mark.slow
@pytest.mark.filterwarnings("error")
def test_channels_without_a_signal_are_told(tmp_path: Path, truth: mahovik.Stand, clean: Array) -> None:
    rows = clean.copy()
    rows[:, 1:7] = np.random.default_rng(1).normal(size=(len(rows), 6))
    rows[:, 4] = 0.25
    found = identified(tmp_path, truth, rows)
    assert any(note.startswith("no channel has a signal") for note in found.notes)
    assert found.residual == pytest.approx(1.0, abs=0.05)
    ((name, channels),) = found.channels.items()
    assert math.isnan(channels["imu.rate.x"].share)
    assert found.to_dict()["channels"][name]["imu.rate.x"]["share"] is None


@pytest.mark.filterwarnings("error")
def test_what_has_no_standard_error_is_nan() -> None:
    covariance = np.array([[4.0, 1.0, 0.0], [1.0, -1e-20, 0.0], [0.0, 0.0, math.nan]])
    assert _errors(covariance).tolist() == pytest.approx([2.0, math.nan, math.nan], nan_ok=True)
    found = _correlation(covariance)
    assert found[0, 0] == 1.0 and np.isnan(found[1:]).all()


@pytest.mark.slow
def test_a_flywheel_at_rest_keeps_its_unbalance(tmp_path: Path, truth: mahovik.Stand) -> None:
    small = truth.replace({"w2.unbalance.static": 1e-6, "w2.unbalance.dynamic": 1e-8})
    rows = with_noise(recorded(truth, (150.0, 1e-4), 0.5), 10.0, 4)
    found = mahovik.identify(small, write_csv(tmp_path / "rest.csv", rows), "w*.unbalance")
    (line,) = found.unobservable
    assert line.startswith("w2.unbalance.static, w2.unbalance.dynamic: are not seen in the data: w2 stands still")
    for path, each in found.parameters.items():
        if path.startswith("w2"):
            assert each.value == pytest.approx(each.before, rel=1e-3, abs=1e-3 if path.endswith("_at") else 0.0), path
    static = found.parameters["w1.unbalance.static"]
    assert static.standard_error < 0.01 * static.value
