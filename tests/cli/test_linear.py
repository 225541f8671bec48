"""mahovik linearize, modes: files, tables, JSON, refusals."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from scipy.io import loadmat

from cli.run import run
from mahovik.stands import path

SAT4, SHAKER2, REMUS6 = (str(path(name)) for name in ("sat4", "shaker2", "remus6"))


def test_a_model_in_both_formats(tmp_path: Path) -> None:
    said = run("linearize", SAT4, "-o", str(tmp_path / "model.json"))
    assert said.exit_code == 0
    assert "20 states, 10 inputs, 9 outputs" in said.stdout
    assert run("linearize", SAT4, "-o", str(tmp_path / "model.mat")).exit_code == 0
    text = json.loads((tmp_path / "model.json").read_text(encoding="utf-8"))
    mat = loadmat(tmp_path / "model.mat", simplify_cells=True)
    for name in "ABCD":
        assert np.array_equal(text[name], mat[name])
    assert text["outputs"][:2] == ["d_x acc1", "d_y acc1"]
    assert text["input_units"][:5] == ["N m", "N m", "N m", "N m", "N"]


def test_about_a_state(tmp_path: Path) -> None:
    state = tmp_path / "state.json"
    state.write_text(json.dumps({"V": [1, 0, 0, 0, 0, 0.1], "phi_dot": [10, 0], "phi_ddot": [5, 0]}), encoding="utf-8")
    target = tmp_path / "model.json"
    assert run("linearize", SHAKER2, "--at", str(state), "--points", "carrier", "-o", str(target)).exit_code == 0
    found = json.loads(target.read_text(encoding="utf-8"))
    assert found["state"]["phi_ddot"] == [5.0, 0.0]
    assert found["state"]["tau"][0] != 0.0
    assert found["A"][0][1] == 0.1  # -<omega>
    assert found["points"] == ["carrier"]
    rest = tmp_path / "rest.json"
    rest.write_text(run("rest", SHAKER2, "--json").stdout, encoding="utf-8")
    assert run("linearize", SHAKER2, "--at", str(rest), "--flywheels", "locked", "-o", str(target)).exit_code == 0
    found = json.loads(target.read_text(encoding="utf-8"))
    assert len(found["states"]) == 12
    assert found["points"] == ["carrier"]  # shaker2 has no points


def test_an_unstable_pose_is_named(tmp_path: Path) -> None:
    """Unbalance up, and down."""
    state = tmp_path / "state.json"
    for angle, unstable in ((90, True), (270, False)):
        phases = [part for name in ("left", "right") for part in ("--phase", f"{name}={angle} deg")]
        state.write_text(run("rest", SHAKER2, "--json", *phases).stdout, encoding="utf-8")
        said = run("modes", SHAKER2, "--flywheels", "free", "--at", str(state)).stdout
        assert ("warning: unstable" in said) == unstable
