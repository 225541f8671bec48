"""judge --fmu of held carriers: FMUs of right and of wrong stands, maps by the freedoms, maps that are refused."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from cli.run import refused, run
from cli.test_eval_held import TEXT
from mahovik.core.stand.random_state import random_state
from mahovik.core.stand.read import loads
from mahovik.errors import DataError
from mahovik.proof.reference.coordinates import coordinates_at
from mahovik.proof.reference.hold import twists
from mahovik.proof.verify.fmu.mapping import FmuMap, read_map
from mahovik.proof.verify.fmu.program import FmuProgram
from mahovik.proof.verify.held import onto_hold

STATE = """
[state]
position = "carrier.position[{i}]"
quaternion = "carrier.attitude[{i}]"
V = "carrier.V[{i}]"
phi = "{name}.phi"
phi_dot = "{name}.phi_dot"
phi_ddot = "{name}.phi_ddot"
"""
MAP = STATE + '[forward]\nV_dot = "carrier.V_dot[{i}]"\n'
REACTION = 'reaction = "hold.reaction[{i}]"\n'
OWN = """
[state]
q = "joint.{freedom}.s"
u = "joint.{freedom}.v"
phi = "{name}.phi"
phi_dot = "{name}.w"
phi_ddot = "{name}.a"
[forward]
u_dot = ["joint.a"]
"""


def stand_text(ways: str) -> str:
    """The pendulum, held in another way off the origin of E0."""
    return TEXT.replace('freedoms = ["pitch"]', f"{ways}\nposition = [0.1, 0.2, 0.3]\nangles = [0.1, 0.2, 0.3]")


def judged(stand: str, fmu: str, *more: str) -> Any:
    return run("judge", stand, "--fmu", fmu, "--map", "map.toml", "--states", "12", "--json", *more)


@pytest.mark.slow
@pytest.mark.parametrize("ways", ['freedoms = ["pitch"]', 'freedoms = ["yaw", "x", "y"]', "axis = [0, 1, 1]"])
def test_an_fmu_of_a_held_carrier_agrees(ways: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It refuses poses that the hold blocks, so it is asked in those that the hold allows."""
    monkeypatch.chdir(tmp_path)
    Path("held.toml").write_text(stand_text(ways), encoding="utf-8")
    Path("start.json").write_text("{}", encoding="utf-8")
    options = ("--inputs", "acceleration", "--start", "start.json", "-o", "held.fmu")
    assert run("export", "fmu", "held.toml", *options).exit_code == 0
    for text, reaction in ((MAP, "not offered"), (MAP + REACTION, "ok")):
        Path("map.toml").write_text(text, encoding="utf-8")
        result = judged("held.toml", "held.fmu")
        assert result.exit_code == 0, result.output
        rows = {row["quantity"]: row["verdict"] for row in json.loads(result.stdout)["rows"]}
        assert rows == {"u_dot": "ok", "V_dot": "ok", "reaction": reaction}


@pytest.mark.slow
def test_wrong_terms_of_an_fmu_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = stand_text('freedoms = ["pitch"]')
    Path("held.toml").write_text(text, encoding="utf-8")
    Path("wrong.toml").write_text(text.replace("inertia = [0.02, 0.02,", "inertia = [0.02, 0.025,"), encoding="utf-8")
    Path("map.toml").write_text(MAP + REACTION, encoding="utf-8")
    assert run("export", "fmu", "wrong.toml", "--inputs", "acceleration", "-o", "wrong.fmu").exit_code == 0
    result = judged("held.toml", "wrong.fmu", "--explain")
    assert result.exit_code == 1
    (term,) = json.loads(result.stdout)["diagnosis"]["found"]
    assert (term["want"], term["component"], term["term"], term["coefficient"]) == ("forward", "M", "q_dot", "I_yy")
    inertia = 0.02 + 0.0004 + 2.5 * 0.2**2 + 0.0006
    assert term["factor"] == pytest.approx(-1 - 0.005 / inertia, rel=1e-3)


def mapped(ways: str, text: str, folder: Path) -> FmuMap:
    file = folder / "map.toml"
    file.write_text(text, encoding="utf-8")
    return read_map(file, loads(stand_text(ways)))


def test_a_joint_has_its_angle_and_its_speed(tmp_path: Path) -> None:
    """A model that knows its joint alone is given these, and answers the acceleration of the joint."""
    ways = 'freedoms = ["pitch"]'
    stand, found = loads(stand_text(ways)), mapped(ways, OWN, tmp_path)
    state = onto_hold(stand, random_state(stand, np.random.default_rng(1)))
    program = FmuProgram.__new__(FmuProgram)
    program._stand, program._map = stand, found
    values = program._values(state)
    assert values["joint.pitch.s"] == coordinates_at(stand, state).q[0]
    assert (values["joint.pitch.v"], values["w1.a"]) == (state.u[0], state.phi_ddot[0])
    whole = program._whole({"u_dot": [0.3]})
    assert stand.hold is not None
    assert whole["V_dot"] == pytest.approx(twists(stand.hold)[:, 0] * 0.3)
    assert program._whole({"V_dot": whole["V_dot"]})["u_dot"] == pytest.approx([0.3])


def test_freedoms_without_a_name_go_by_their_numbers(tmp_path: Path) -> None:
    found = mapped("axis = [0, 1, 1]", OWN, tmp_path)
    assert [place.variable for place in (*found.inputs["q"], *found.inputs["u"])] == ["joint.1.s", "joint.1.v"]
    ball = OWN.replace("q =", "orientation = 'joint.q[{i}]'\nunused =").replace('["joint.a"]', '"a[{i}]"')
    with pytest.raises(DataError, match=r'state: unknown key "unused"'):
        mapped('freedoms = ["roll", "pitch", "yaw"]', ball, tmp_path)
    kept = "\n".join(line for line in ball.splitlines() if "unused" not in line)
    assert len(mapped('freedoms = ["roll", "pitch", "yaw"]', kept, tmp_path).inputs["orientation"]) == 4


BAD = {
    "no pose": ('q = "joint.{freedom}.s"\n', "", "state.quaternion is missing: answers of this stand depend on it"),
    "no speed": ('u = "joint.{freedom}.v"\n', "", "state.V or state.u is missing: every state has it"),
    "too many": ('["joint.a"]', '["a", "b"]', "forward.u_dot: 2 variables, expected 1"),
    "no motion": ('u_dot = ["joint.a"]', 'reaction = "R[{i}]"', "forward.u_dot is missing"),
    "no input": ("[forward]", '[reaction]\nreaction = "R[{i}]"\n[forward]', "state.V_dot or state.u_dot is missing"),
    "no coordinate": ("q =", "orientation =", 'state: unknown key "orientation"'),
}


@pytest.mark.parametrize("name", BAD)
def test_maps_that_are_refused(name: str, tmp_path: Path) -> None:
    old, new, words = BAD[name]
    assert old in OWN
    (tmp_path / "held.toml").write_text(stand_text('freedoms = ["pitch"]'), encoding="utf-8")
    (tmp_path / "map.toml").write_text(OWN.replace(old, new), encoding="utf-8")
    files = (str(tmp_path / "held.toml"), "--fmu", str(tmp_path / "a.fmu"), "--map", str(tmp_path / "map.toml"))
    assert words in refused("judge", *files)
