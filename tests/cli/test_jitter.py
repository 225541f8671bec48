"""mahovik jitter: tables, files, pictures, requirements, refusals."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from cli.run import run
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


def test_a_sweep_as_a_file_of_numbers(tmp_path: Path) -> None:
    target = tmp_path / "j.csv"
    said = run("jitter", SAT4, "--speed", "all=0..6000rpm", "--at", "acc1", "--steps", "5", "-o", str(target))
    assert said.exit_code == 0 and "the full equations give the same RMS within" in said.stdout
    rows = list(csv.DictReader(target.read_text(encoding="utf-8").splitlines()))
    assert [float(row["speed rw3 [rpm]"]) for row in rows] == [0, 1500, 3000, 4500, 6000]
    assert float(rows[4]["1 x rw1 x [rad]"]) > 0.0 and float(rows[0]["rms x [rad]"]) == 0.0


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
