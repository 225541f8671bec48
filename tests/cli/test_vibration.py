"""mahovik vibration: files, plain numbers, lines of sight, time, resonances without damping."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from cli.run import refused, run
from mahovik.stands import path

SAT4 = str(path("sat4"))
ONE = ("vibration", SAT4, "--speed", "all=3000rpm", "--speed", "rw2=2987rpm", "--at", "acc1")
SWEEP = ("vibration", SAT4, "--speed", "rw1=0..6000rpm", "--at", "acc1", "--steps", "5")


def test_a_sweep_is_a_file_of_numbers_and_a_document(tmp_path: Path) -> None:
    target = tmp_path / "v.csv"
    sweep = json.loads(run(*SWEEP, "--quantity", "acceleration", "-o", str(target), "--json").stdout)
    rows = list(csv.DictReader(target.read_text(encoding="utf-8").splitlines()))
    assert [float(row["speeds [rad/s]"]) for row in rows] == sweep["speeds"]
    assert [float(row["worst z [m/s2]"]) for row in rows] == [row[2] for row in sweep["worst"]]
    assert sweep["rms"][-1][2] == pytest.approx(4.0 * sweep["rms"][2][2], rel=1e-2) and sweep["units"]["rms"] == "m/s2"
    largest = sweep["largest"]
    assert largest["speed"] == sweep["speeds"][-1] and largest["quantity"] == "acceleration"
    assert largest["value"] == pytest.approx(sweep["length"][-1][1], rel=1e-2)


def test_one_set_of_speeds_is_a_line_a_wheel_and_order() -> None:
    vibration = json.loads(run(*ONE, "--json").stdout)
    first = {line["wheel"]: line for line in vibration["orders"] if line["order"] == 1}
    assert first["rw2"]["frequency"] == pytest.approx(2987 / 60)
    total = [sum(line["amplitude"][i] for line in vibration["orders"]) for i in range(3)]
    assert vibration["worst"] == pytest.approx(total, rel=1e-4) and len(first["rw1"]["amplitude"]) == 3


def test_a_line_of_sight_is_the_angle_where_its_matrix_says_so(tmp_path: Path) -> None:
    file = tmp_path / "sight.csv"
    file.write_text("acc1 rx [-],acc1 ry [-],carrier x [rad/m]\n1,0,0\n0,2,0\n")
    sight, angle = (json.loads(run(*command, "--json").stdout) for command in ((*ONE[:-2], "--sight", str(file)), ONE))
    x, y, _ = angle["rms"]
    assert sight["rms"] == pytest.approx([x, 2 * y, 0.0], rel=1e-9)


@pytest.mark.parametrize(
    "arguments",
    [("vibration", SAT4, "--speed", "all=3000", "--at", "acc1"), ("check", SAT4, "--speed", "3000")],
    ids=["vibration", "check"],
)
def test_a_plain_number_that_may_be_rpm_is_asked_about_in_one_line(arguments: tuple[str, ...]) -> None:
    said = run(*arguments)
    (line,) = [line for line in said.stderr.splitlines() if "its motor" in line]
    assert line.startswith("warning: rw1 turns at up to 28647.9 rpm, its motor at most at 6000; ")
    assert line.endswith("numbers without unit are rad/s, 3000 rpm?")


def test_time_cuts_a_sweep() -> None:
    said = run(*SWEEP, "--time", "1e-9")
    assert said.exit_code == 0 and "warning: coarse near" in said.stdout


SHAPE = ("x [-]", "y [-]", "z [-]", "rx [rad/m]", "ry [rad/m]", "rz [rad/m]")
BODIES = ("rw1", "rw2", "rw3", "rw4", "acc1")


@pytest.fixture(params=["--modes", "--inner-modes"])
def undamped(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[str, str, str]:
    """Options that add a mode of 50 Hz without damping, and its name."""
    file = tmp_path / "m.csv"
    if request.param == "--modes":
        head = ["frequency [Hz]", "damping [-]", "modal mass [kg]", *(f"{b} {part}" for b in BODIES for part in SHAPE)]
        row = ["50", "0", "20", *(f"{0.1 * (j + 1)}" for _ in BODIES for j in range(6))]
        file.write_text(f"{','.join(head)}\n{','.join(row)}\n")
        return "--modes", str(file), "structural mode 1"
    file.write_text("mode,frequency [Hz],damping [-],polar ratio [-]\nradial,50,0,\n")
    return "--inner-modes", f"all={file}", "the radial mode inside rw1"


def test_an_undamped_resonance_is_refused(undamped: tuple[str, str, str]) -> None:
    option, value, name = undamped
    command = ("--speed", "all=3000rpm", "--at", "acc1", option, value, "--require", "rms 1e9 arcsec")
    said = refused("vibration", SAT4, *command, status=1)
    assert said.count("\n") == 1
    assert name in said and "1 x rw1 at 50 Hz" in said and "damping above 0" in said


def test_in_a_sweep_the_speed_is_a_problem_and_the_requirement_fails(undamped: tuple[str, str, str]) -> None:
    option, value, name = undamped
    command = ("--speed", "all=2990..3010rpm", "--steps", "3", "--at", "acc1", option, value)
    limit = ("--require", "rms 1e9 arcsec", "--require", "worst 1e9 arcsec 100..200Hz")
    said = run("vibration", SAT4, *command, *limit, "--json")
    document = json.loads(said.stdout)
    assert said.exit_code == 1 and "RuntimeWarning" not in said.stderr
    assert [(requirement["met"], requirement["value"]) for requirement in document["requirements"]] == [
        (False, None)
    ] * 2
    at = document["rms"].index([None] * 3)
    assert document["speeds"][at] == pytest.approx(314.159265, rel=1e-6)
    assert any(name in message for message in document["messages"])
    assert all(x > 0.0 for row in document["rms"][:at] + document["rms"][at + 1 :] for x in row)
