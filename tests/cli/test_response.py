"""mahovik response: tables, files, pictures, refusals."""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

import pytest

from cli.run import AUV6, BENCH8, refused, run
from mahovik.stands import path

SAT4, SHAKER2, REMUS6 = (str(path(name)) for name in ("sat4", "shaker2", "remus6"))
SWEEP = (SAT4, "--speed", "rw1=0..6000rpm", "--at", "acc1", "--steps", "5")


def test_orders_and_rms() -> None:
    said = run("response", *SWEEP, "--band", "20..80Hz")
    assert said.exit_code == 0
    assert "sat4: acceleration of acc1, 5 speeds of rw1" in said.stdout
    assert "1 x rw1 0.0191497 100 6000" in " ".join(said.stdout.split())
    assert "RMS 20..80 Hz" in said.stdout
    assert said.stderr == ""


def test_a_file_of_numbers(tmp_path: Path) -> None:
    target = tmp_path / "r.csv"
    assert run("response", *SWEEP, "-o", str(target)).exit_code == 0
    rows = list(csv.DictReader(target.read_text(encoding="utf-8").splitlines()))
    assert [float(row["speed rw1 [rpm]"]) for row in rows] == [0, 1500, 3000, 4500, 6000]
    assert float(rows[4]["1 x rw1 [m/s2]"]) == pytest.approx(4.0 * float(rows[2]["1 x rw1 [m/s2]"]), rel=1e-2)
    found = json.loads(run("response", *SWEEP, "--json").stdout)
    assert found["lines"][0]["name"] == "1 x rw1"
    assert found["steps"][0]["frequency_Hz"] == []
    assert found["steps"][4]["stable"] is True
    peak = found["steps"][4]["amplitude_re"][0] + found["steps"][4]["amplitude_im"][0]
    assert sum(x * x for x in peak) ** 0.5 == pytest.approx(float(rows[4]["1 x rw1 [m/s2]"]), rel=1e-9)
    assert found["interrupted"] is False


def test_a_picture(tmp_path: Path) -> None:
    target = tmp_path / "r.svg"
    speeds = ("--speed", "left=0..300rpm", "--speed", "right=-0.5*left", "--steps", "3")
    assert run("response", SHAKER2, *speeds, "--at", "carrier", "-o", str(target)).exit_code == 0
    assert target.read_bytes().startswith(b"<?xml")


@pytest.mark.slow
def test_pictures_are_the_same_bytes(tmp_path: Path) -> None:
    target = tmp_path / "r.svg"
    speeds = ("--speed", "left=0..300rpm", "--steps", "7")
    made = []
    for _ in range(2):
        assert run("response", SHAKER2, *speeds, "--at", "carrier", "-o", str(target)).exit_code == 0
        made.append(target.read_bytes())
    assert made[0] == made[1]
    one = tmp_path / "one.png"
    assert run("response", SHAKER2, "--speed", "left=300rpm", "--at", "carrier", "-o", str(one)).exit_code == 0
    assert one.read_bytes()[:4] == b"\x89PNG"


def test_a_stand_that_drifts_is_held_and_that_is_said() -> None:
    said = run("response", AUV6, "--speed", "w1=600rpm", "--at", "sonar").stdout
    assert "the stand is free to drift: a constant wrench of up to" in said


def test_motors_that_cannot_are_named() -> None:
    said = run("response", SAT4, "--speed", "rw1=7000rpm", "--at", "acc1")
    assert "warning: rw1 turns at up to 7000 rpm, its motor at most at 6000" in said.stderr


@pytest.mark.parametrize(
    "arguments",
    [("response", SAT4, "--speed", "all=3000", "--at", "acc1"), ("check", SAT4, "--speed", "3000")],
    ids=["response", "check"],
)
def test_a_plain_number_that_may_be_rpm_is_asked_about_in_one_line(arguments: tuple[str, ...]) -> None:
    said = run(*arguments)
    assert said.exit_code == 0
    (line,) = [line for line in said.stderr.splitlines() if "its motor" in line]
    assert line.startswith("warning: rw1 turns at up to 28647.9 rpm, its motor at most at 6000; 4 flywheels in all")
    assert line.endswith("numbers without unit are rad/s, 3000 rpm?")


def test_speeds_with_a_unit_or_within_the_limit_are_not_asked_about() -> None:
    assert "its motor" not in run("check", SAT4, "--speed", "3000 rpm").stderr
    assert "rpm?" not in run("check", SAT4, "--speed", "7000 rpm").stderr


@pytest.mark.parametrize(
    "arguments",
    [
        ("response", SHAKER2, "--at", "carrier", "--steps", "2", "--speed", "left=0..4000"),
        ("check", SHAKER2, "--speed", "4000"),
    ],
    ids=["response", "check"],
)
def test_a_fast_plain_number_is_asked_about_without_motors(arguments: tuple[str, ...]) -> None:
    (line,) = [line for line in run(*arguments).stderr.splitlines() if "rpm" in line]
    assert line == "warning: left turns at up to 38197.2 rpm; numbers without unit are rad/s, 4000 rpm?"
    *rest, last = arguments
    for slower in (last.replace("4000", "1000"), f"{last} rad/s"):
        assert "rpm?" not in run(*rest, slower).stderr


def test_quiet_asks_about_fast_plain_numbers() -> None:
    at = ("quiet", SAT4, "--point", "acc1", "--band", "1..2Hz", "--speeds")
    assert "--speeds: 28647.9 rpm; numbers without unit are rad/s, 3000 rpm?" in run(*at, "3000").stderr
    assert "rpm?" not in run(*at, "3000 rpm").stderr


def test_time_cuts_a_sweep() -> None:
    said = run("response", *SWEEP, "--time", "1e-9")
    assert said.exit_code == 0
    assert "warning: --time cut the sweep: 1 of 5 speeds are done" in said.stderr


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (("--speed", "w9=1", "--at", "carrier"), '--speed w9=1: unknown flywheel "w9", did you mean "w1"?'),
        (("--speed", "w1=nan", "--at", "carrier"), "--speed w1=nan: expected a finite speed, as w1=1000 rpm"),
        (("--speed", "w1=-inf", "--at", "carrier"), "--speed w1=-inf: expected a finite speed"),
        (("--speed", "w1=0..60Hz", "--at", "carrier"), "a frequency is not one: write rpm or rad/s"),
        (("--speed", "w1=0..6rpm", "--at", "foo"), 'unknown point "foo", expected one of carrier'),
        (("--speed", "w1=6rpm", "--at", "carrier", "--steps", "5"), "--steps: no speed is swept"),
        (("--speed", "w1=100", "--speed", "w2=141.42135623", "--at", "carrier"), "no common period within 1000 turns"),
        (("--speed", "w1=6rpm", "--at", "carrier", "--band", "5..1Hz"), "--band 5..1 Hz: expected two frequencies"),
        (("--speed", "w1=6rpm", "--at", "carrier", "--band", "5..9"), "--band 5..9: expected two frequencies"),
        (("--speed", "w1=6rpm", "--at", "carrier", "--phase", "w1=1kg"), 'unit "kg" does not fit'),
        (
            ("--speed", "w1=6rpm", "--at", "carrier", "-o", "r.pdf"),
            "expected a name that ends in .csv or .json or .svg or .png",
        ),
    ],
)
def test_refusals_are_one_line(given: tuple[str, ...], words: str) -> None:
    said = refused("response", BENCH8, *given)
    assert words in said
    assert len(said.splitlines()) == 1


@pytest.mark.parametrize("lacking", ["place", "matplotlib"])
def test_what_cannot_be_written_is_told_before_anything_is_computed(
    lacking: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def never(*given: object, **more: object) -> None:
        pytest.fail("computed")

    monkeypatch.setattr("mahovik.out.functions.vibration.sweep_speeds", never)
    if lacking == "matplotlib":
        monkeypatch.setitem(sys.modules, "matplotlib", None)
        assert "plot needs matplotlib: pip install" in refused("response", *SWEEP, "-o", "r.png")
    else:
        assert "/proc/r.csv: cannot be written" in refused("response", *SWEEP, "-o", "/proc/r.csv")


def test_a_stand_without_rest_is_status_1() -> None:
    said = refused("response", REMUS6, "--speed", "all=10", "--at", "imu", status=1)
    assert "nothing carries a force" in said
    assert len(said.splitlines()) == 1
