"""mahovik plan: programme files, refusals with a reason, exit statuses."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.run import DEMO3, run
from mahovik.core.motion.programme import load_programme
from mahovik.stands import path as stand_path

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
    assert "status: NO_PROGRAM" in result.stdout and "reason: SPAN" in result.stdout
    assert "force along z" in result.stdout
    assert not (tmp_path / "p.json").exists()


def test_numbers_that_move_are_printed_and_the_stand_is_written(tmp_path: Path) -> None:
    """The stand that results is a stand file, on which the written programme is right, and on no other."""
    motion = changed(tmp_path, SPIN, harmonics=[{"k": 1, "cos": [0, 0, 0.6, 0, 0, 0]}], winding="spin")
    new, programme = tmp_path / "new.toml", tmp_path / "p.json"
    told = run(
        "plan",
        SHAKER,
        "--motion",
        motion,
        "--free",
        "left.unbalance.static",
        "right.unbalance.static",
        "--stand",
        str(new),
        "-o",
        str(programme),
    )
    assert told.exit_code == 0, told.output
    assert "left.unbalance.static" in told.stdout and "status: OK\n" in told.stdout
    judged = [run("verify", stand, str(programme), "--motion", motion).exit_code for stand in (str(new), SHAKER)]
    assert judged == [0, 1]


@pytest.mark.slow
def test_a_slew_goes_through_the_same_commands(tmp_path: Path) -> None:
    """A slew is planned, verified and exported; one that is out of reach is refused in one line."""
    motion, programme = tmp_path / "turn.json", tmp_path / "p.json"
    keys = {"schema": 1, "type": "slew", "name": "turn", "task": "pointing", "end": {"angles": [0.3, 0, 0]}}
    motion.write_text(json.dumps(keys | {"duration": 6}), encoding="utf-8")
    sat4 = str(stand_path("sat4"))
    told = run("plan", sat4, "--motion", str(motion), "-o", str(programme))
    assert told.exit_code == 0 and "duration: 6 s" in told.stdout and "status: OK\n" in told.stdout
    assert load_programme(programme).carrier is not None
    judged = run("verify", sat4, str(programme), "--motion", str(motion), "--json")
    names = {finding["item"] for finding in json.loads(judged.stdout)["findings"] if finding["verdict"] == "ok"}
    assert judged.exit_code == 0 and names >= {"slew start", "slew end", "slew path", "slew rest", "motor torque"}
    motion.write_text(json.dumps(keys | {"duration": 1}), encoding="utf-8")
    short = run("plan", sat4, "--motion", str(motion), "-o", str(tmp_path / "q.json"))
    assert short.exit_code == 1 and "BOUND_REACH" in short.stdout and not (tmp_path / "q.json").exists()
