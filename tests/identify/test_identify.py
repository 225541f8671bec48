"""`mahovik identify`: unbalances found from data of the literal reference; the file written; mistakes named."""

from __future__ import annotations

import json
import math
import tomllib
from pathlib import Path

import numpy as np
import pytest

import mahovik
from cli.run import refused, run
from identify.data import Array, recorded, stand_text, with_noise, write_csv
from mahovik.out.identify.face import Identification, _correlation, _errors
from toolchain.quick import quick

CHANGED = {
    "w1.unbalance.static": 0.004,
    "w1.unbalance.static_at": 0.2,
    "w2.unbalance.static": 0.005,
    "w2.unbalance.dynamic": 4e-5,
}
"""Numbers of the stand file before; the data are of others."""


@pytest.fixture(scope="module")
def truth() -> mahovik.Stand:
    return mahovik.Stand.from_dict(tomllib.loads(stand_text()))


@pytest.fixture(scope="module")
def exact(truth: mahovik.Stand) -> Array:
    """Data without noise of the first two flywheels of bench8."""
    return recorded(truth)


@pytest.fixture
def files(tmp_path: Path, exact: Array, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with stand.toml, of other unbalances with comments and units, and run.csv with noise."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "stand.toml").write_text(stand_text(), encoding="utf-8")
    write_csv(tmp_path / "run.csv", with_noise(exact, 10.0, 1))
    return tmp_path


@pytest.mark.slow
def test_unbalances_are_found_within_their_standard_errors(files: Path, truth: mahovik.Stand) -> None:
    wanted = mahovik.identify(truth, files / "run.csv", "w*.unbalance")
    found = mahovik.identify(truth.replace(CHANGED), files / "run.csv", "w*.unbalance")
    assert not found.unobservable
    for path, each in found.parameters.items():
        true = wanted.parameters[path].before
        assert each.standard_error > 0.0
        assert abs(each.value - true) < 4.0 * each.standard_error, path
        assert each.value == pytest.approx(wanted.parameters[path].value, rel=0.0, abs=0.02 * each.standard_error)
    for name in ("w1", "w2"):
        static = found.parameters[f"{name}.unbalance.static"]
        assert static.standard_error < 0.01 * static.value
    assert found.residual == pytest.approx(0.1, rel=0.1)  # the noise of the data


@pytest.mark.slow
def test_two_flywheels_at_one_speed_are_named(tmp_path: Path, truth: mahovik.Stand) -> None:
    rows = recorded(truth, (150.0, 150.0), 0.5)
    found = mahovik.identify(truth, write_csv(tmp_path / "same.csv", with_noise(rows, 10.0, 2)), "w*.unbalance")
    (line,) = (each for each in found.notes if "one speed" in each)
    assert "w1" in line and "w2" in line and "rad/s" in line
    assert not found.unobservable  # the flywheels are at other places: channels tell them apart


@pytest.mark.slow
def test_a_number_that_no_channel_tells_is_named_and_stays(files: Path, truth: mahovik.Stand) -> None:
    """Where the springs have no force only adds a constant to readings, which offsets of the sensors take."""
    free = ["w1.unbalance", "suspension.position[0]"]
    found = mahovik.identify(truth.replace({"suspension.position": [0.001, 0.0, 0.0]}), files / "run.csv", free)
    (line,) = found.unobservable
    assert line.startswith("suspension.position[0]: ")
    each = found.parameters["suspension.position[0]"]
    assert each.value == pytest.approx(each.before, rel=1e-6)
    static = found.parameters["w1.unbalance.static"]
    assert abs(static.value - static.before) < 4.0 * static.standard_error


@pytest.mark.slow
def test_motion_that_would_show_a_number_is_named(files: Path, truth: mahovik.Stand) -> None:
    """Torques of changing speeds tell the moments about the axes of the flywheels, constant speeds hardly do."""
    found = mahovik.identify(truth, files / "run.csv", ["w1.inertia.J11", "w2.inertia.J11"])
    (line,) = found.unobservable
    assert "w1.inertia.J11" in line and "w2.inertia.J11" in line
    assert "add a run in which the speeds of the flywheels change" in line


@pytest.mark.slow
def test_an_estimate_stays_a_body(files: Path, truth: mahovik.Stand) -> None:
    """The flywheels are nearly flat: noise asks for moments that break the triangle inequality."""
    found = mahovik.identify(truth, files / "run.csv", ["w1.unbalance", "w1.inertia.J11"])
    (J,) = (np.array(each.inertia) for each in found.stand.flywheels if each.name == "w1")
    low, middle, high = np.linalg.eigvalsh(J)
    assert low > 0.0 and low + middle > 0.99 * high


@pytest.mark.slow
def test_missing_samples_and_outliers_do_not_move_a_robust_fit(
    tmp_path: Path, exact: Array, truth: mahovik.Stand
) -> None:
    rows = with_noise(exact, 10.0, 4)
    rng = np.random.default_rng(5)
    for column in range(1, 7):
        rows[rng.choice(len(rows), 25, replace=False), column] = math.nan
    hit = rng.choice(len(rows), 10, replace=False)
    rows[hit, 1:4] += 20.0 * np.nanstd(rows[:, 1:4], axis=0)
    file = write_csv(tmp_path / "bad.csv", rows)
    found = mahovik.identify(truth, file, "w*.unbalance", loss="soft_l1")
    for path, each in found.parameters.items():
        assert abs(each.value - each.before) < 4.5 * each.standard_error, path


@pytest.mark.slow
def test_data_that_were_not_used_are_predicted_better(files: Path, truth: mahovik.Stand) -> None:
    other = with_noise(recorded(truth, (131.0, 190.0), 0.4), 10.0, 6)
    write_csv(files / "other.csv", other)
    found = mahovik.identify(truth.replace(CHANGED), "run.csv", "w*.unbalance", check=["other.csv"])
    assert found.check is not None
    after, before = found.check
    assert after < 0.12 < before


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--free", "w9.unbalance"], 'no "w9"'),
        (["--free", "none.toml"], "no such file"),
        (["--free", "w*.unbalance", "--check", "none.csv"], "no such file"),
        (["--free", ","], "expected at least one path"),
    ],
)
def test_mistakes_are_one_line_and_write_nothing(files: Path, arguments: list[str], words: str) -> None:
    result = refused("identify", "stand.toml", "--data", "run.csv", "-o", "new.toml", *arguments)
    assert words in result
    assert not (files / "new.toml").exists()


def test_too_few_data_are_refused(files: Path, exact: Array) -> None:
    write_csv(files / "short.csv", with_noise(exact[:60], 10.0, 1))
    assert "expected at least" in refused(
        "identify", "stand.toml", "--data", "short.csv", "--free", "w*.unbalance", "-o", "new.toml"
    )


@pytest.mark.slow
def test_a_file_of_free_numbers_may_have_a_delay(files: Path) -> None:
    """A free delay adds to the known one; together they are the true one, which is none."""
    text = 'schema = 1\nfree = ["imu.delay"]\n[delay]\nimu = "{}"\n'
    (files / "free.toml").write_text(text.format("0.4 ms"), encoding="utf-8")
    found = mahovik.identify("stand.toml", "run.csv", "free.toml").parameters["imu.delay"]
    assert abs(found.value + 4e-4) < 4.0 * found.standard_error < 2e-4
    (files / "free.toml").write_text(text.format("2 mm"), encoding="utf-8")
    words = refused("identify", "stand.toml", "--data", "run.csv", "--free", "free.toml", "-o", "new.toml")
    assert words.strip() == 'error: free.toml: delay.imu: unit "mm" does not fit, expected a time (s)'


@pytest.mark.slow
def test_an_order_that_the_stand_does_not_have_stands_out_of_the_residual(files: Path, exact: Array) -> None:
    """A third order of w1 is measured: figures by order and the page show it."""
    rows = with_noise(exact, 30.0, 3)
    strange = float(rows[:, 1].std())
    rows[:, 1] += strange * np.cos(3.0 * exact[:, 7])
    write_csv(files / "strange.csv", rows)
    free = "w*.unbalance.static,w*.unbalance.static_at"
    arguments = ("identify", "stand.toml", "--data", "strange.csv", "--free", free)
    result = run(*arguments, "-o", "new.toml", "--report", "page.html", "--json")
    orders = json.loads(result.stdout)["residual_orders"]["strange.csv"]
    assert orders["w1"]["imu.acceleration.x"][2] == pytest.approx(strange, rel=0.1)
    others = [*orders["w1"]["imu.acceleration.y"], *orders["w2"]["imu.acceleration.y"]]
    assert max(others) < 0.1 * strange
    page = (files / "page.html").read_text(encoding="utf-8")
    assert "Flywheel w2" in page
    assert "Static unbalance" in page
    assert "page.pdf" in refused(*arguments, "-o", "other.toml", "--report", "page.pdf")
    assert not (files / "other.toml").exists()


@pytest.mark.slow
def test_samples_without_a_phase_are_left_out(files: Path, exact: Array, truth: mahovik.Stand) -> None:
    """The phase of w1 ends after 0.7 s: what was measured later is not compared with a motion that is not known."""
    rows = with_noise(exact, 10.0, 5)
    rows[350:, 7] = np.nan
    write_csv(files / "short.csv", rows)
    found = mahovik.identify(truth, files / "short.csv", "w*.unbalance.static,w*.unbalance.static_at")
    assert any("149 samples outside 0 to 0.698 s, where a phase is missing" in note for note in found.notes)
    for each in found.parameters.values():
        assert abs(each.value - each.before) < 4.0 * each.standard_error


SILENT = (3, 4, 6)
"""Channels made noise alone: acceleration z, rates x and z."""


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
