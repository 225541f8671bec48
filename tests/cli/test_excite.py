"""mahovik excite: its output, its programme as a table in C, and bad input."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from cli.run import BENCH8, refused, run
from identify.data import bench8
from mahovik.core.motion.programme import load_programme
from mahovik.out.identify.excite import face
from mahovik.out.identify.excite.search import search

QUICK = ("--speed", "1000 rpm", "--duration", "0.5", "--rate", "500", "-o", "p.json")


@pytest.fixture(autouse=True)
def folder(own_folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two flywheels of bench8 with an IMU; a search of few programmes."""
    monkeypatch.setattr(face, "EVALUATIONS", 10)
    bench8(2).save("a.toml")
    return own_folder


@pytest.mark.slow
def test_errors_of_both_programmes_are_told(folder: Path) -> None:
    result = run("excite", "a.toml", *QUICK, "--json", "--noise", "rate=0.1 deg/s", "--speed-min", "w1=100 rpm")
    assert result.exit_code == 0, result.output
    found = json.loads(result.stdout)
    assert [row["path"] for row in found["parameters"]][:2] == ["w1.unbalance.static", "w1.unbalance.static_at"]
    assert all(row["standard_error"] > 0.0 and row["standard_error_constant"] > 0.0 for row in found["parameters"])
    assert found["gain"] >= 1.0 and found["status"] == "OK" and found["effort"]["tried"] == 10
    assert load_programme(folder / "p.json").winding == tuple(found["programme"]["winding"])
    told = run("excite", "a.toml", *QUICK)
    assert "times less than at constant speeds" in told.stdout and "w2.unbalance.dynamic" in told.stdout


def test_free_numbers_of_a_file(folder: Path) -> None:
    (folder / "free.toml").write_text('schema = 1\nfree = ["w1.unbalance.static", "carrier.mass"]\n', encoding="utf-8")
    found = json.loads(run("excite", "a.toml", *QUICK, "--free", "free.toml", "--json").stdout)
    assert [row["path"] for row in found["parameters"]] == ["w1.unbalance.static", "carrier.mass"]


def test_a_file_of_other_keys_names_all_of_them() -> None:
    Path("b.toml").write_text("schema = 1\nmass = 2\nname = 3\n", encoding="utf-8")
    said = refused("excite", "a.toml", *QUICK, "--free", "b.toml").splitlines()
    assert len(said) > 1 and all("b.toml" in line for line in said)


@pytest.mark.slow
def test_half_the_noise_is_half_the_error() -> None:
    def errors(*noise: str) -> list[float]:
        options = [word for each in noise for word in ("--noise", each)]
        found = json.loads(run("excite", "a.toml", *QUICK, *options, "--json").stdout)
        return [row["standard_error_constant"] for row in found["parameters"]]

    once, half = errors("acceleration=0.02", "rate=0.002"), errors("imu.acceleration=0.01", "rate=0.001")
    assert half == pytest.approx([x / 2 for x in once], rel=1e-3)


@pytest.mark.slow
def test_the_programme_is_a_table_for_firmware(folder: Path) -> None:
    assert run("excite", "a.toml", *QUICK).exit_code == 0
    assert run("generate", "a.toml", "-o", "board").exit_code == 0
    result = run("export", "programme", "a.toml", "--programme", "p.json", "-o", "board", "--table", "fourier")
    assert result.exit_code == 0, result.output
    assert (folder / "board" / "bench8_programme.c").is_file()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--free", ","), "expected at least one path"),
        (("--free", "w1.unbalanse"), 'did you mean "unbalance"'),
        (("--free", "v1.mass"), "did you mean"),
        (("--free", "none.toml"), "none.toml: no such file"),
        (("--speed", "w3=1000 rpm"), 'unknown flywheel "w3"'),
        (("--speed", "10,20,30"), "3 numbers, but the stand has 2 flywheels"),
        (("--speed-min", "1200 rpm"), "leaves no room below"),
        (("--speed-min", "990 rpm", "--speed", "995 rpm"), "bounds leave no room"),
        (("--speed", "1 rpm"), "longer --duration"),
        (("--acceleration", "0"), "expected a number above 0"),
        (("--noise", "imu.rat=1"), 'did you mean "imu.rate"'),
        (("--noise", "rate"), "expected NAME=VALUE"),
        (("--noise", "rate=0"), "expected a number above 0"),
        (("--rate", "1e9"), "samples, expected"),
        (("--duration", "soon"), "--duration"),
    ],
)
def test_bad_input_writes_nothing(folder: Path, options: tuple[str, ...], words: str) -> None:
    said = refused("excite", "a.toml", *QUICK, *options)
    assert words in said and said.startswith("error: ") and said.count("\n") == 1
    assert not (folder / "p.json").exists()


def test_a_stand_without_sensors_or_bounds(folder: Path) -> None:
    assert "has no instrument or point" in refused("excite", BENCH8, *QUICK)
    assert "nothing bounds the speed of w1" in refused("excite", "a.toml", "-o", "p.json")


def test_ctrl_c_writes_the_best_so_far(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def pressed(value: Any, courses: Any, budget: Any, seed: int) -> Any:
        budget.interrupt()
        return search(value, courses, budget, seed)

    monkeypatch.setattr(face, "search", pressed)
    result = run("excite", "a.toml", *QUICK)
    assert result.exit_code == 130 and "interrupted: this is the best so far" in result.stderr
    assert load_programme(folder / "p.json").motion == "excite"


def test_numbers_that_noise_hides_are_named() -> None:
    loud = ("--noise", "acceleration=1e9", "--noise", "rate=1e9")
    result = run("excite", "a.toml", *QUICK, *loud, "--free", "w1.mass,carrier.mass")
    assert result.exit_code == 0
    assert "warning: the programme hardly shows w1.mass, carrier.mass\n" in result.stderr


def test_one_wheel_is_best_at_a_constant_speed_and_a_zero_unbalance_has_no_angle() -> None:
    """The force table of the examples: nothing is "1 times less", and no error is "nan"."""
    table = Path(__file__).parents[2] / "docs" / "held" / "force_table.toml"
    result = run("excite", str(table), "--time", "0.001", *QUICK)
    assert result.exit_code == 0, result.output
    assert "no programme was found that tells more than constant speeds" in result.stdout
    assert "wheel.unbalance.dynamic_at: no angle, as the unbalance is zero" in result.stdout
    assert "nan" not in result.stdout and "another run may find more" not in result.output
