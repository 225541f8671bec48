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


TURNS = """schema = 1
name = "box"
gravity = [0, 0, -9.81]
[carrier]
mass = "100 kg"
inertia = [3.0, 4.0, 5.0]
buoyancy = { displaced_mass = "100 kg", center = [0, 0, "-50 mm"] }
damping = { linear = [50, 50, 50, 5, 5, 5] }
[[flywheel]]
name = "w"
mass = 1e-9
spin_inertia = 1e-9
transverse_inertia = 1e-9
buoyancy = { displaced_mass = 1e-9 }
"""


@pytest.mark.parametrize(
    "command",
    [
        ("modes",),
        ("linearize", "-o", "a.json"),
        ("simulate", "--until", "0.02", "--every", "0.01", "-o", "a.csv", "--backend", "scipy"),
        ("response", "--speed", "w=600rpm", "--at", "carrier"),
        ("jitter", "--speed", "w=600rpm", "--at", "carrier"),
    ],
)
def test_what_starts_from_a_turned_rest_pose_says_so(
    command: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The centre of buoyancy is below the centre of mass, so that the box hangs upside down; above it, it does not."""
    line = "warning: starts from rest, where the stand is turned by 180 deg from E0: see mahovik rest"
    name, *options = command
    monkeypatch.chdir(tmp_path)
    for text, warned in ((TURNS, True), (TURNS.replace('"-50 mm"', '"50 mm"'), False)):
        (tmp_path / "box.toml").write_text(text)
        done = run(name, "box.toml", *options)
        assert done.exit_code == 0, done.stderr
        assert done.stderr.splitlines().count(line) == warned
        for file in tmp_path.glob("a.*"):
            file.unlink()
