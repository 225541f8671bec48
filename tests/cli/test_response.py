"""mahovik response: tables, files, pictures, refusals."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from cli.run import run
from mahovik.stands import path

SAT4, SHAKER2, REMUS6 = (str(path(name)) for name in ("sat4", "shaker2", "remus6"))
SWEEP = (SAT4, "--speed", "rw1=0..6000rpm", "--at", "acc1", "--steps", "5")


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


def test_time_cuts_a_sweep() -> None:
    said = run("response", *SWEEP, "--time", "1e-9")
    assert said.exit_code == 0
    assert "warning: --time cut the sweep: 1 of 5 speeds are done" in said.stderr
