"""mahovik modes: files and states."""

from __future__ import annotations

import json
from pathlib import Path

from cli.run import run
from mahovik.stands import path

SHAKER2 = str(path("shaker2"))
FREE = ("--flywheels", "free")


def test_about_a_state(tmp_path: Path) -> None:
    state = tmp_path / "state.json"
    state.write_text(json.dumps({"V": [1, 0, 0, 0, 0, 0.1], "phi_dot": [10, 0], "phi_ddot": [5, 0]}), encoding="utf-8")
    target = tmp_path / "model.json"
    assert run("modes", SHAKER2, *FREE, "--at", str(state), "--points", "carrier", "-o", str(target)).exit_code == 0
    model = json.loads(target.read_text(encoding="utf-8"))
    assert model["state"]["phi_ddot"] == [5.0, 0.0]
    assert model["state"]["tau"][0] != 0.0
    assert model["A"][0][1] == 0.1  # -<omega>
    assert model["points"] == ["carrier"]
    rest = tmp_path / "rest.json"
    rest.write_text(json.dumps(json.loads(run("check", SHAKER2, "--json").stdout)["rest"]["state"]), encoding="utf-8")
    assert run("modes", SHAKER2, "--at", str(rest), "-o", str(target)).exit_code == 0
    model = json.loads(target.read_text(encoding="utf-8"))
    assert len(model["states"]) == 12
    assert model["points"] == ["carrier"]  # shaker2 has no points


def test_an_unstable_pose_is_named(tmp_path: Path) -> None:
    """The pose with the unbalance up is called unstable, that with the unbalance down is not."""
    state = tmp_path / "state.json"
    for angle, unstable in ((90, True), (270, False)):
        phases = [part for name in ("left", "right") for part in ("--phase", f"{name}={angle} deg")]
        pose = json.loads(run("check", SHAKER2, "--json", *phases).stdout)["rest"]["state"]
        state.write_text(json.dumps(pose), encoding="utf-8")
        said = run("modes", SHAKER2, "--flywheels", "free", "--at", str(state)).stdout
        assert ("warning: unstable" in said) == unstable
