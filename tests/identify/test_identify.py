"""`mahovik identify`: unbalances from data of the literal reference; the file written; mistakes named."""

from __future__ import annotations

import json
import math
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest

import mahovik
from cli.run import refused, run
from identify.data import Array, identified, recorded, stand_text, with_noise, write_csv

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
def test_unbalances_are_right_within_their_standard_errors(files: Path, truth: mahovik.Stand) -> None:
    """They do not depend on the values in the stand file; the file that is written keeps its comments."""
    (files / "changed.toml").write_text(stand_text().replace("static = 0.0", "static = 0.1"), encoding="utf-8")
    wanted, _ = identified(truth, files / "run.csv", "w*.unbalance")
    numbers, result = identified(truth.replace(CHANGED), files / "run.csv", "w*.unbalance")
    assert not result["unobservable"]
    for path, number in numbers.items():
        assert number.standard_error > 0.0
        assert abs(number.value - wanted[path].before) < 4.0 * number.standard_error, path
        assert number.value == pytest.approx(wanted[path].value, rel=0.0, abs=0.02 * number.standard_error)
    for name in ("w1", "w2"):
        static = numbers[f"{name}.unbalance.static"]
        assert static.standard_error < 0.01 * static.value
    assert result["residual"] == pytest.approx(0.1, rel=0.1)  # the noise of the data
    assert not any("white noise" in line for line in result.messages)


@pytest.mark.slow
def test_command(files: Path) -> None:
    """Its JSON can be read, and the stand file that it writes differs in numbers alone."""
    free = "w*.unbalance.static,w*.unbalance.static_at"
    done = run("identify", "stand.toml", "--data", "run.csv", "--free", free, "-o", "new.toml", "--json")
    figures = json.loads(done.stdout)
    assert done.exit_code == 0 and figures["unobservable"] == []
    assert figures["residual"] == pytest.approx(0.1, rel=0.1)
    static = figures["parameters"]["w1.unbalance.static"]
    assert static["unit"] == "kg m"
    (new,) = (w for w in mahovik.load("new.toml").flywheels if w.name == "w1")
    y, z = new.center_of_mass[1:]
    assert new.mass * math.hypot(y, z) == pytest.approx(static["value"], rel=1e-12)
    old, text = (Path(name).read_text(encoding="utf-8").splitlines() for name in ("stand.toml", "new.toml"))
    assert set(old) - set(text) and all("#" not in line for line in set(old) - set(text))
    assert "is read by this command; expected another name" in refused(
        "identify", "stand.toml", "--data", "run.csv", "--free", free, "-o", "stand.toml"
    )


@pytest.mark.slow
def test_a_number_that_no_channel_tells_is_named_and_stays(files: Path, truth: mahovik.Stand) -> None:
    """The place where springs have no force adds a constant to readings, which offsets of the sensors take."""
    free = ["w1.unbalance", "suspension.position[0]"]
    numbers, result = identified(truth.replace({"suspension.position": [0.001, 0.0, 0.0]}), files / "run.csv", free)
    (line,) = result["unobservable"]
    assert line.startswith("suspension.position[0]: ")
    number = numbers["suspension.position[0]"]
    assert number.value == number.before and math.isnan(number.standard_error)
    static = numbers["w1.unbalance.static"]
    assert abs(static.value - static.before) < 4.0 * static.standard_error


@pytest.mark.slow
def test_motion_that_would_show_a_number_is_named(files: Path, truth: mahovik.Stand) -> None:
    """Torques of changing speeds tell the moments about the axes of the flywheels, constant speeds hardly do."""
    _, result = identified(truth, files / "run.csv", ["w1.inertia.J11", "w2.inertia.J11"])
    lines = result["unobservable"]
    assert all(f"w{k}.inertia.J11" in " ".join(lines) for k in (1, 2))
    assert all("add a run in which the speeds of the flywheels change" in line for line in lines)


@pytest.mark.slow
def test_an_estimate_stays_a_body(files: Path, truth: mahovik.Stand) -> None:
    """The flywheels are nearly flat: noise asks for moments that break the triangle inequality."""
    _, result = identified(truth, files / "run.csv", ["w1.unbalance", "w1.inertia.J11"])
    (J,) = (np.array(w.inertia) for w in mahovik.Stand.from_dict(result["stand_keys"]).flywheels if w.name == "w1")
    low, middle, high = np.linalg.eigvalsh(J)
    assert low > 0.0 and low + middle > 0.99 * high


@pytest.mark.slow
@pytest.mark.parametrize("loss", ["soft_l1", "cauchy"])
def test_missing_samples_and_outliers_do_not_move_a_robust_fit(
    tmp_path: Path, exact: Array, truth: mahovik.Stand, loss: str
) -> None:
    rows = with_noise(exact, 10.0, 4)
    rng = np.random.default_rng(5)
    for column in range(1, 7):
        rows[rng.choice(len(rows), 25, replace=False), column] = math.nan
    hit = rng.choice(len(rows), 10, replace=False)
    rows[hit, 1:4] += 20.0 * np.nanstd(rows[:, 1:4], axis=0)
    numbers, _ = identified(truth, write_csv(tmp_path / "bad.csv", rows), "w*.unbalance", loss)
    for path, number in numbers.items():
        assert abs(number.value - number.before) < 4.5 * number.standard_error, path


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--free", "w9.unbalance"], 'no "w9"'),
        (["--free", "imo.delay"], 'did you mean "imu"'),
        (["--free", "none.toml"], "No such file"),
        (["--free", ","], "expected at least one path"),
        (["--free", "w1.mass", "--loss", "huge"], "huber"),
    ],
)
def test_mistakes_are_one_line_and_write_nothing(files: Path, arguments: list[str], words: str) -> None:
    result = refused("identify", "stand.toml", "--data", "run.csv", "-o", "new.toml", *arguments)
    assert words.lower() in result.lower()
    assert not (files / "new.toml").exists()


def test_too_few_data_are_refused(files: Path, exact: Array) -> None:
    write_csv(files / "short.csv", with_noise(exact[:60], 10.0, 1))
    assert "expected at least" in refused(
        "identify", "stand.toml", "--data", "short.csv", "--free", "w*.unbalance", "-o", "new.toml"
    )


def test_sensors_whose_times_are_not_those_of_the_phases_are_refused(files: Path) -> None:
    lines = [line.split(",") for line in (files / "run.csv").read_text(encoding="utf-8").splitlines()]
    late = [[lines[0][0], *lines[0][1:7]], *([repr(float(row[0]) + 100.0), *row[1:7]] for row in lines[1:])]
    (files / "imu.csv").write_text("\n".join(map(",".join, late)), encoding="utf-8")
    (files / "wheels.csv").write_text("\n".join(",".join([row[0], *row[7:]]) for row in lines), encoding="utf-8")
    words = refused("identify", "stand.toml", "--data", "imu.csv", "--data", "wheels.csv", "--free", "w1.mass")
    assert re.search(r"imu.csv covers 100.* s, wheels.csv covers 0 to .* has the phase of w1: expected times", words), (
        words
    )


@pytest.mark.slow
def test_a_file_of_free_numbers_may_have_a_delay(files: Path) -> None:
    """A free delay adds to the known one; together they are the true one, which is none."""
    text = 'schema = 1\nfree = ["imu.delay"]\n[delay]\nimu = "{}"\n'
    (files / "free.toml").write_text(text.format("0.4 ms"), encoding="utf-8")
    numbers, _ = identified("stand.toml", "run.csv", "free.toml")
    delay = numbers["imu.delay"]
    assert abs(delay.value + 4e-4) < 4.0 * delay.standard_error < 2e-4
    late = text.format("0.4 ms").replace("imu.delay", "w1.unbalance.static")
    (files / "free.toml").write_text(late, encoding="utf-8")
    _, result = identified("stand.toml", "run.csv", "free.toml")
    assert any("is no white noise, standard errors are too small: a delay" in line for line in result.messages)
    (files / "free.toml").write_text(text.format("2 mm"), encoding="utf-8")
    words = refused("identify", "stand.toml", "--data", "run.csv", "--free", "free.toml", "-o", "new.toml")
    assert words.strip() == 'error: free.toml: delay.imu: unit "mm" does not fit, expected a time (s)'


@pytest.mark.slow
def test_samples_without_a_phase_are_left_out(files: Path, exact: Array, truth: mahovik.Stand) -> None:
    """The phase of w1 ends after 0.7 s: what was measured later is not compared with a motion that is not known."""
    rows = with_noise(exact, 10.0, 5)
    rows[350:, 7] = np.nan
    write_csv(files / "short.csv", rows)
    numbers, result = identified(truth, files / "short.csv", "w*.unbalance.static,w*.unbalance.static_at")
    where = "samples outside 0 to 0.698 s, where a phase is missing, are left out"
    assert any(note.endswith(f"150 {where}") for note in result.messages)
    for number in numbers.values():
        assert abs(number.value - number.before) < 4.0 * number.standard_error


@pytest.mark.slow
def test_a_channel_of_the_wrong_sign_is_told(files: Path, exact: Array, truth: mahovik.Stand) -> None:
    rows = with_noise(exact, 10.0, 6)
    rows[:, 1] *= -1.0
    _, result = identified(truth, write_csv(files / "sign.csv", rows), "w1.unbalance.static")
    (note,) = (note for note in result.messages if "a sign, an axis" in note)
    assert "imu.acceleration.x: the stand leaves" in note
    assert not result.ok


@pytest.mark.slow
@pytest.mark.filterwarnings("error")
def test_channels_without_a_signal_are_told(files: Path, exact: Array, truth: mahovik.Stand) -> None:
    rows = with_noise(exact, 10.0, 7)
    rows[:, 1:7] = np.random.default_rng(1).normal(size=(len(rows), 6))
    rows[:, 4] = 0.25
    _, result = identified(truth, write_csv(files / "noise.csv", rows), "w*.unbalance")
    assert any(note.startswith("no channel has a signal") for note in result.messages)
    assert result["residual"] == pytest.approx(1.0, abs=0.05)
    share = result["channels"]["share"][list(result["channels"]["channel"]).index("imu.rate.x")]
    assert math.isnan(share)


@pytest.mark.slow
def test_a_flywheel_at_rest_keeps_its_unbalance(tmp_path: Path, truth: mahovik.Stand) -> None:
    small = truth.replace({"w2.unbalance.static": 1e-6, "w2.unbalance.dynamic": 1e-8})
    rows = with_noise(recorded(truth, (150.0, 1e-4), 0.5), 10.0, 4)
    numbers, result = identified(small, write_csv(tmp_path / "rest.csv", rows), "w*.unbalance")
    assert all("w2 stands still, let it turn" in line for line in result["unobservable"])
    named = " ".join(result["unobservable"])
    assert "w2.unbalance.static" in named and "w2.unbalance.dynamic" in named and "w1" not in named
    for path, number in numbers.items():
        if path.startswith("w2"):
            assert number.value == pytest.approx(number.before, rel=1e-3, abs=1e-3 if path.endswith("_at") else 0.0), (
                path
            )
    static = numbers["w1.unbalance.static"]
    assert static.standard_error < 0.01 * static.value
