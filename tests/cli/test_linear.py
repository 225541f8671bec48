"""mahovik linearize, modes: files, tables, JSON, refusals."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.io import loadmat

from cli.run import AUV6, BENCH8, refused, run
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


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"V": [1]}, "V: expected 6 numbers, found 1"),
        ({"tau": [1, 2]}, '"tau" is not part of a start, expected some of'),
        ({"phi": [1e9, 0]}, "phi[0]: 1e+09 is out of range"),
        ([], "expected an object, found []"),
    ],
)
def test_states_that_are_refused(given: object, words: str, tmp_path: Path) -> None:
    state, target = tmp_path / "state.json", tmp_path / "model.json"
    state.write_text(json.dumps(given), encoding="utf-8")
    said = refused("linearize", SHAKER2, "--at", str(state), "-o", str(target))
    assert words in said
    assert len(said.splitlines()) == 1
    assert not target.exists()


def test_other_refusals(tmp_path: Path) -> None:
    target = str(tmp_path / "model.json")
    assert 'unknown point "acc2", did you mean "acc1"?' in refused("linearize", SAT4, "--points", "acc2", "-o", target)
    assert "expected a name that ends in .json or .mat" in refused("linearize", SAT4, "-o", str(tmp_path / "model.txt"))
    assert "cannot be read" in refused("linearize", SAT4, "--at", str(tmp_path / "none.json"), "-o", target)
    said = refused("linearize", REMUS6, "-o", target, status=1)
    assert "nothing carries a force" in said
    assert "give a state by --at STATE.json" in said
    assert len(said.splitlines()) == 1
    assert not list(tmp_path.iterdir())


def test_modes_for_people() -> None:
    said = run("modes", BENCH8).stdout
    assert said.startswith("bench8 at rest, flywheels locked")
    assert "1.45265         0.06115   rz 1  ry 0.03 at -7 deg" in said
    free = run("modes", AUV6).stdout
    assert "without a frequency: a free" in free
    assert "phi left 1  phi right 1" in run("modes", SHAKER2, "--flywheels", "free").stdout


def test_modes_as_json() -> None:
    found = json.loads(run("modes", SHAKER2, "--flywheels", "free", "--json").stdout)
    assert found["coordinates"][-1] == "phi right [rad]"
    assert found["zero_eigenvalues"] == 0
    frequencies = [mode["frequency"] for mode in found["modes"]]
    assert frequencies == sorted(frequencies)
    assert len(frequencies) == 8
    assert all(len(mode["shape"][1]) == 8 for mode in found["modes"])


def test_an_unstable_pose_is_named(tmp_path: Path) -> None:
    """Unbalance up, and down."""
    state = tmp_path / "state.json"
    for angle, unstable in ((90, True), (270, False)):
        phases = [part for name in ("left", "right") for part in ("--phase", f"{name}={angle} deg")]
        state.write_text(run("rest", SHAKER2, "--json", *phases).stdout, encoding="utf-8")
        said = run("modes", SHAKER2, "--flywheels", "free", "--at", str(state)).stdout
        assert ("warning: unstable" in said) == unstable


def test_a_moment_of_a_motion_is_not_called_unstable(tmp_path: Path) -> None:
    """Unbalance that turns shakes the carrier: the eigenvalues of a moment do not show stability."""
    state = tmp_path / "state.json"
    state.write_text('{"phi_dot": [314, 0, 0, 0]}', encoding="utf-8")
    said = run("modes", SAT4, "--at", str(state)).stdout
    assert "growth" in said
    assert "valid for one moment" in said
    assert "unstable" not in said
    assert json.loads(run("modes", SAT4, "--at", str(state), "--json").stdout)["steady"] is False
    assert json.loads(run("modes", SAT4, "--json").stdout)["steady"] is True
