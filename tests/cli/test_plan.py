"""mahovik plan of a slew, and verify of what it writes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.run import run
from mahovik.core.motion.programme import load_programme
from mahovik.stands import path as stand_path


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
    names = {row["quantity"] for row in json.loads(judged.stdout)["rows"] if row["verdict"] == "ok"}
    assert judged.exit_code == 0 and names >= {"slew start", "slew end", "slew path", "slew rest", "motor torque"}
    motion.write_text(json.dumps(keys | {"duration": 1}), encoding="utf-8")
    short = run("plan", sat4, "--motion", str(motion), "-o", str(tmp_path / "q.json"))
    assert short.exit_code == 1 and "BOUND_REACH" in short.stdout and not (tmp_path / "q.json").exists()
