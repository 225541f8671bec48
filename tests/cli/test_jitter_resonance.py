"""mahovik jitter without a good answer: an undamped resonance, too low an order; never 0, never a requirement met."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from cli.run import refused, run
from mahovik.stands import path

SAT4 = str(path("sat4"))
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


def test_one_speed_is_refused(undamped: tuple[str, str, str]) -> None:
    option, value, name = undamped
    given = ("--speed", "all=3000rpm", "--at", "acc1", option, value, "--require", "rms 1e9 arcsec")
    said = refused("jitter", SAT4, *given, status=1)
    assert said.count("\n") == 1
    assert name in said and "1 x rw1 at 50 Hz" in said and "damping above 0" in said


@pytest.mark.parametrize("method", [(), ("--exact",)])
def test_in_a_sweep_the_speed_is_a_problem_and_the_requirement_fails(
    undamped: tuple[str, str, str], method: tuple[str, ...], tmp_path: Path
) -> None:
    option, value, name = undamped
    target = tmp_path / "j.csv"
    given = ("--speed", "all=2990..3010rpm", "--steps", "3", "--at", "acc1", option, value, *method)
    limit = ("--require", "rms 1e9 arcsec", "--require", "worst 1e9 arcsec 100..200Hz")
    said = run("jitter", SAT4, *given, *limit, "-o", str(target), "--json")
    found = json.loads(said.stdout)
    assert said.exit_code == 1 and "RuntimeWarning" not in said.stderr
    assert [each["met"] for each in found["requirements"]] == [False, False]
    (problem,) = found["problems"]
    assert problem["speed"] == pytest.approx(314.159265, rel=1e-6) and name in problem["problem"]
    assert found["rms"][1] == [None] * 3 and all(x > 0.0 for x in found["rms"][0] + found["rms"][2])
    row = list(csv.DictReader(target.read_text(encoding="utf-8").splitlines()))[1]
    assert row["rms x [rad]"] == row["worst z [rad]"] == ""


def test_too_low_an_order_is_a_problem_and_a_requirement_fails() -> None:
    """At order 2 the slow line rw1 - 2 rw2 is missing."""
    given = ("--speed", "rw1=3000rpm", "--speed", "rw2=1500.1rpm", "--at", "acc1", "--require", "rms 1 arcsec")
    low, good = (run("jitter", SAT4, *given, *more, "--json") for more in (("--order", "2"), ()))
    assert (low.exit_code, good.exit_code) == (1, 0)
    (problem,) = json.loads(low.stdout)["problems"]
    assert "inaccurate: harmonic balance of order 2 leaves out" in problem["problem"]
    found = json.loads(good.stdout)
    assert found["problems"] == [] and max(found["remainder"]) < 1e-6 * min(found["rms"])
    missing = next(x for x in found["combinations"] if x["wheel"] == "rw1 - 2 rw2")
    assert json.loads(low.stdout)["remainder"] == pytest.approx(missing["amplitude"], rel=0.01)
