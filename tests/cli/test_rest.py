"""mahovik rest: tables, JSON, refusals."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import pytest

from cli.run import AUV6, BENCH8, DEMO3, refused, run
from mahovik.stands import path


def test_a_table_for_people() -> None:
    result = run("rest", AUV6)
    assert result.exit_code == 0
    assert "auv6 rests, turned by 8.9" in result.stdout
    assert "free to" in result.stdout
    assert "free to" not in run("rest", BENCH8).stdout


@pytest.mark.parametrize("name", ["auv6", "bench8", "shaker2"])
def test_no_negative_zero_is_printed(name: str) -> None:
    stdout = run("rest", str(path(name))).stdout
    assert not re.search(r"-0(\.0*)?(?![.\d])", stdout), stdout
    assert "-0.0" not in re.findall(r"-?[\d.e-]+", run("rest", str(path(name)), "--json").stdout)


def test_free_directions_have_unit_axes_and_say_what_they_are() -> None:
    rows = [line.split() for line in run("rest", AUV6).stdout.splitlines() if line.startswith((" shift", " turn"))]
    assert [row[0] for row in rows] == ["shift"] * 3 + ["turn"]
    assert math.hypot(*map(float, rows[3][-3:])) == pytest.approx(1.0, abs=1e-5)
    free = json.loads(run("rest", AUV6, "--json").stdout)["free"]
    assert math.hypot(*free[3][3:]) == pytest.approx(1.0, abs=1e-12)


def test_json_can_be_evaluated() -> None:
    found = json.loads(run("rest", BENCH8, "--json", "--phase", "w2=90 deg").stdout)
    assert found["free"] == []
    assert found["unstable"] is False
    line = json.dumps({**found["state"], "want": ["forward"]}) + "\n"
    V_dot = json.loads(run("eval", BENCH8, stdin=line).stdout)["V_dot"]
    assert max(map(abs, V_dot)) <= 1e-12


def test_no_equilibrium_is_status_1_with_direction_and_size() -> None:
    said = refused("rest", str(path("remus6")), status=1)
    assert "nothing carries a force of 6.99" in said
    assert "along (0, 0, -1) in E0" in said
    assert len(said.splitlines()) == 1


@pytest.mark.parametrize(
    ("phase", "words"),
    [
        ("w9=1", 'unknown flywheel "w9", did you mean'),
        ("w1=1 m", 'unit "m" does not fit'),
        ("w1", "is not a number"),
        ("w1=1e9", "out of range"),
    ],
)
def test_bad_phases(phase: str, words: str) -> None:
    assert words in refused("rest", DEMO3, "--phase", phase)


def test_phases_of_a_stand_without_flywheels() -> None:
    Path("brick.toml").write_text('schema = 1\nname = "brick"\n[carrier]\nmass = 2.0\ninertia = [0.1, 0.2, 0.25]\n')
    assert "the stand has none" in refused("rest", "brick.toml", "--phase", "w1=1")
    assert run("rest", "brick.toml").exit_code == 0
