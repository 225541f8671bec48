"""mahovik plan: programme files, refusals with a reason, exit statuses."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.run import DEMO3, run
from mahovik.core.motion.programme import load_programme
from mahovik.stands import path as stand_path
from mahovik.use.plan import Plan
from verify.programme.programmes import shaker

SHAKER = str(stand_path("shaker2"))
SPIN = str(Path(SHAKER).with_name("shaker2_spin.motion.json"))
TURN = str(Path(DEMO3).with_name("demo3.motion.json"))


def changed(tmp_path: Path, source: str, **keys: object) -> str:
    """A motion file with keys changed."""
    motion = json.loads(Path(source).read_text(encoding="utf-8")) | keys
    path = tmp_path / "changed.motion.json"
    path.write_text(json.dumps(motion), encoding="utf-8")
    return str(path)


def test_what_is_out_of_reach_is_refused_with_the_reason(tmp_path: Path) -> None:
    """SPAN: status 1, one line why, and no file."""
    cos = [0.0, 0.0, 0.1, 1.0, 0.0, 0.0]
    motion = changed(tmp_path, TURN, harmonics=[{"k": 1, "cos": cos}], winding="any")
    result = run("plan", DEMO3, "--motion", motion, "-o", str(tmp_path / "p.json"))
    assert result.exit_code == 1
    assert result.stdout == "NO_PROGRAM SPAN\n"
    assert "force along z" in result.stderr
    assert not (tmp_path / "p.json").exists()


@pytest.mark.slow
def test_fewer_than_were_to_be_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A message says so, and no file of an earlier run is left that could be mistaken for a new one."""
    programme = shaker()[2]
    monkeypatch.setattr("mahovik.use.plan.plan_motion", lambda *_: Plan("OK", None, (), (), (programme,)))
    folder = tmp_path / "new"
    folder.mkdir()
    for name in ("p.2.json", "p.3.json", "p.4.json"):
        (folder / name).write_text("{}")
    result = run("plan", SHAKER, "--motion", SPIN, "-o", str(folder / "p.json"), "--keep", "3", "--json")
    assert result.exit_code == 0
    assert "warning: 1 of 3 programmes found" in result.stderr
    assert "p.2.json was removed: it was from an earlier run" in result.stderr
    assert sorted(path.name for path in folder.iterdir()) == ["p.4.json", "p.json"]
    found = json.loads(result.stdout)
    assert (found["status"], [Path(each["file"]).name for each in found["programmes"]]) == ("OK", ["p.json"])
    assert load_programme(folder / "p.json").motion == programme.motion


@pytest.mark.slow
def test_a_slew_goes_through_the_same_commands(tmp_path: Path) -> None:
    """Planned, verified, exported with as many nodes as it needs; refused in one line."""
    motion, programme = tmp_path / "turn.json", tmp_path / "p.json"
    keys = {"schema": 1, "type": "slew", "name": "turn", "task": "pointing", "end": {"angles": [0.3, 0, 0]}}
    motion.write_text(json.dumps(keys | {"duration": 6}), encoding="utf-8")
    sat4 = str(stand_path("sat4"))
    told = run("plan", sat4, "--motion", str(motion), "-o", str(programme))
    assert told.exit_code == 0 and "quietest slew, 6 s" in told.stdout and "\nOK\n" in told.stdout
    assert load_programme(programme).carrier is not None
    judged = run("verify-programme", sat4, "--motion", str(motion), "--programme", str(programme), "--json")
    names = {each["name"] for each in json.loads(judged.stdout)["findings"] if each["passed"]}
    assert judged.exit_code == 0 and names >= {"slew start", "slew end", "slew path", "slew rest", "motor torque"}
    motion.write_text(json.dumps(keys | {"duration": 1}), encoding="utf-8")
    short = run("plan", sat4, "--motion", str(motion), "-o", str(tmp_path / "q.json"))
    assert short.exit_code == 1 and "BOUND_REACH" in short.stdout and not (tmp_path / "q.json").exists()
