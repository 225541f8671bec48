"""mahovik jitter: tables, files, pictures, requirements, refusals."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from cli.run import refused, run
from mahovik.stands import path

SAT4 = str(path("sat4"))
ONE = ("jitter", SAT4, "--speed", "all=3000rpm", "--speed", "rw2=2987rpm", "--at", "acc1")
HEAD = "order [-],radial force [N/(rad/s)^2],radial moment [N m/(rad/s)^2],tolerance [%]"
HARMONICS = f"{HEAD}\n1,1.5e-6,2e-7,10\n3.2,4e-7,0,20\n"


@pytest.fixture
def wheel(tmp_path: Path) -> str:
    file = tmp_path / "wheel.csv"
    file.write_text(HARMONICS)
    return str(file)


def test_json_has_what_the_contract_names() -> None:
    found = json.loads(run(*ONE, "--quantity", "rate", "--json").stdout)
    assert {"orders", "rms", "worst", "units", "left_out"} <= set(found)
    assert [len(found[name]) for name in ("rms", "rss", "worst", "mean")] == [3] * 4
    first = found["orders"][0]
    assert set(first) >= {"wheel", "order", "frequency", "amplitude"} and len(first["amplitude"]) == 3
    own = [line for line in found["orders"] if line["order"] == 1]
    assert {line["wheel"] for line in own} == {"rw1", "rw2", "rw3", "rw4"}
    assert next(line["frequency"] for line in own if line["wheel"] == "rw2") == pytest.approx(2987 / 60)
    assert found["units"]["rms"] == "rad/s" and found["arcsec"]["unit"] == "arcsec/s"
    assert all(w >= r for w, r in zip(found["worst"], found["rms"], strict=True))


def test_a_sweep_as_a_file_of_numbers(tmp_path: Path) -> None:
    target = tmp_path / "j.csv"
    said = run("jitter", SAT4, "--speed", "all=0..6000rpm", "--at", "acc1", "--steps", "5", "-o", str(target))
    assert said.exit_code == 0 and "the full equations give the same RMS within" in said.stdout
    rows = list(csv.DictReader(target.read_text(encoding="utf-8").splitlines()))
    assert [float(row["speed rw3 [rpm]"]) for row in rows] == [0, 1500, 3000, 4500, 6000]
    assert float(rows[4]["1 x rw1 x [rad]"]) > 0.0 and float(rows[0]["rms x [rad]"]) == 0.0


def test_a_picture(tmp_path: Path) -> None:
    assert run(*ONE, "-o", str(tmp_path / "j.svg")).exit_code == 0
    drawn = (tmp_path / "j.svg").read_text(encoding="utf-8")
    assert "cumulative RMS" in drawn and "budget" in drawn


def test_a_line_of_sight_of_two_angles_is_drawn_along_two_axes(tmp_path: Path) -> None:
    (tmp_path / "camera.csv").write_text("acc1 rx [-],acc1 ry [-]\n1,0\n0,1\n", encoding="utf-8")
    asked = ("jitter", SAT4, "--speed", "all=3000rpm", "--sight", str(tmp_path / "camera.csv"))
    assert run(*asked, "-o", str(tmp_path / "j.svg")).exit_code == 0
    drawn = (tmp_path / "j.svg").read_text(encoding="utf-8")
    assert "<!-- x -->" in drawn and "<!-- y -->" in drawn and "<!-- z -->" not in drawn


def test_a_requirement_decides_the_exit_status(wheel: str) -> None:
    good = run(*ONE, "--harmonics", f"all={wheel}", "--require", "worst 5 arcsec 10..60Hz", "--json")
    verdict = json.loads(good.stdout)["requirements"][0]
    assert good.exit_code == 0 and verdict["met"] and verdict["margin"] > 0.0
    bad = run(*ONE, "--harmonics", f"all={wheel}", "--require", "rms 1e-4 arcsec")
    assert bad.exit_code == 1 and "failed" in bad.stdout


def test_a_mask_is_a_file(tmp_path: Path) -> None:
    mask = tmp_path / "mask.csv"
    mask.write_text("sum,from [Hz],to [Hz],limit [arcsec]\nrms,0,45,1\nworst,45,55,1e-3\n")
    found = run(*ONE, "--require", str(mask), "--json")
    assert found.exit_code == 1
    low, high = json.loads(found.stdout)["requirements"]
    assert low["met"] and not high["met"]
    assert high["value"] == pytest.approx(max(json.loads(found.stdout)["worst"]), rel=1e-3)


def test_a_line_of_sight_is_the_angle_where_its_matrix_says_so(tmp_path: Path) -> None:
    file = tmp_path / "sight.csv"
    file.write_text("acc1 rx [-],acc1 ry [-],carrier x [rad/m]\n1,0,0\n0,2,0\n")
    given = (*ONE[:-2], "--sight", str(file), "--json")
    sight, angle = json.loads(run(*given).stdout), json.loads(run(*ONE, "--json").stdout)
    x, y, _ = angle["rms"]
    assert sight["rms"] == pytest.approx([x, 2 * y, 0.0], rel=1e-12)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (("--speed", "rw9=1"), 'unknown flywheel "rw9"'),
        (("--harmonics", "rw9={wheel}"), 'unknown flywheel "rw9", did you mean'),
        (("--harmonics", "{wheel}"), "expected NAME=FILE.csv"),
        (("--require", "rms 1 kg"), "expected an angle"),
        (("--require", "peak 1 arcsec"), "expected rms, rss or worst"),
        (("--require", "rms 0.1"), 'a limit with a unit, as "rms 0.1 arcsec"'),
        (("--require", "rms 0.1e-3"), 'a limit with a unit, as "rms 0.1 arcsec"'),
        (("--exact",), "no speed is swept"),
        (("--modes", "{wheel}"), 'unknown column "order [-]"'),
        (("--sight", "{wheel}"), "one of --at and --sight"),
        (("--noise", "rw1=missing.csv"), "missing.csv: cannot be read"),
    ],
)
def test_bad_input_is_named_in_one_line(more: tuple[str, ...], words: str, wheel: str) -> None:
    said = refused(*ONE, *(each.replace("{wheel}", wheel) for each in more))
    assert words in said and said.count("\n") == 1


def test_a_speed_beyond_the_motor_is_warned_of() -> None:
    said = run("jitter", SAT4, "--speed", "rw1=7000rpm", "--at", "acc1")
    assert said.exit_code == 0 and "its motor at most at 6000" in said.stderr
