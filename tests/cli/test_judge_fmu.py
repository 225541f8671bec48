"""judge --fmu, of free and of held carriers: FMUs of right and of wrong stands, maps and files that are refused."""

from __future__ import annotations

import json
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import numpy as np
import pytest

from cli.run import BRICK, refused, run
from mahovik.core.stand.random import random_state
from mahovik.core.stand.stand_file import loads
from mahovik.proof.reference.algebra import twists
from mahovik.proof.reference.coordinates import coordinates_at
from mahovik.proof.verify.draw import onto_hold
from mahovik.proof.verify.fmu import FmuBackend, read_map
from toolchain.quick import quick
from verify.holds import PENDULUM

FREE = BRICK + "wrench_input = true\n"
FREE_MAP = """
[state]
quaternion = "carrier.attitude[{i}]"
V = "carrier.V[{i}]"
[state.wrench]
carrier = "carrier.wrench[{i}]"
[forward]
V_dot = "carrier.V_dot[{i}]"
"""
HELD_MAP = """
[state]
position = "carrier.position[{i}]"
quaternion = "carrier.attitude[{i}]"
V = "carrier.V[{i}]"
phi = "{name}.phi"
phi_dot = "{name}.phi_dot"
phi_ddot = "{name}.phi_ddot"
[forward]
V_dot = "carrier.V_dot[{i}]"
reaction = "hold.reaction[{i}]"
"""
JOINT_MAP = """
[state]
q = "joint.{freedom}.s"
u = "joint.{freedom}.v"
phi = "{name}.phi"
phi_dot = "{name}.w"
phi_ddot = "{name}.a"
[forward]
u_dot = ["joint.a"]
"""
"""Map for a model that knows nothing but its joint."""


def held_text(freedoms: str = 'freedoms = ["pitch"]') -> str:
    """The pendulum, held in another way off the origin of E0."""
    return PENDULUM.replace('freedoms = ["pitch"]', f"{freedoms}\nposition = [0.1, 0.2, 0.3]\nangles = [0.1, 0.2, 0.3]")


def exported(text: str, fmu: str, *options: str) -> None:
    Path("exported.toml").write_text(text, encoding="utf-8")
    Path("start.json").write_text("{}", encoding="utf-8")
    settings = [word for one in ("start=start.json", *options) for word in ("--fmu", one)]
    result = run("generate", "exported.toml", "--project", "fmu", *settings, "-o", fmu)
    assert result.exit_code == 0, result.output


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMU of the free stand."""
    folder = tmp_path_factory.mktemp("fmu")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        exported(FREE, "free.fmu")
    return folder / "free.fmu"


def judged(stand: str, fmu: Path | str, map_text: str, *options: str) -> tuple[str, ...]:
    """Arguments of the command; it reads files of the current folder."""
    Path("stand.toml").write_text(stand, encoding="utf-8")
    Path("map.toml").write_text(map_text, encoding="utf-8")
    return ("judge", "stand.toml", "--fmu", str(fmu), "--map", "map.toml", *options)


def test_a_right_fmu_agrees(fmu: Path) -> None:
    result = run(*judged(FREE, fmu, FREE_MAP, "--states", "20", "--json"))
    assert result.exit_code == 0, result.output
    assert [(row["judged"], row["states"]) for row in json.loads(result.stdout)["rows"]] == [("forward", 20)]


@pytest.mark.slow
@pytest.mark.parametrize("freedoms", ['freedoms = ["pitch"]', 'freedoms = ["yaw", "x", "y"]', "axis = [0, 1, 1]"])
def test_an_fmu_of_a_held_carrier_agrees(freedoms: str) -> None:
    """It refuses poses that the hold blocks, so it is asked in those that the hold allows."""
    exported(held_text(freedoms), "held.fmu", "inputs=acceleration")
    result = run(*judged(held_text(freedoms), "held.fmu", HELD_MAP, "--states", "12", "--json"))
    assert result.exit_code == 0, result.output
    rows = {row["quantity"]: row["verdict"] for row in json.loads(result.stdout)["rows"]}
    assert rows == {"u_dot": "ok", "V_dot": "ok", "reaction": "ok"}


@pytest.mark.slow
def test_a_wrong_number_of_a_held_fmu_is_named() -> None:
    wrong = held_text().replace("inertia = [0.02, 0.02,", "inertia = [0.02, 0.025,")
    exported(wrong, "wrong.fmu", "inputs=acceleration")
    result = run(*judged(held_text(), "wrong.fmu", HELD_MAP, "--states", "12", "--explain", "--json"))
    assert result.exit_code == 1
    (fault,) = json.loads(result.stdout)["diagnosis"]["found"]
    assert (fault["number"], fault["value"], fault["expected"]) == ("carrier.inertia.J22", 0.025, 0.02)


def test_a_joint_has_its_angle_and_its_speed() -> None:
    """A model that knows its joint alone is given these, and answers the acceleration of the joint."""
    stand = loads(held_text())
    Path("map.toml").write_text(JOINT_MAP, encoding="utf-8")
    program = FmuBackend.__new__(FmuBackend)
    program._stand, program._map = stand, read_map(Path("map.toml"), stand)
    state = onto_hold(stand, random_state(stand, np.random.default_rng(1)))
    values = program._values(state)
    assert values["joint.pitch.s"] == coordinates_at(stand, state).q[0]
    assert (values["joint.pitch.v"], values["w1.a"]) == (state.u[0], state.phi_ddot[0])
    whole = program._whole({"u_dot": [0.3]})
    assert stand.hold is not None
    assert whole["V_dot"] == pytest.approx(twists(stand.hold)[:, 0] * 0.3)
    assert program._whole({"V_dot": whole["V_dot"]})["u_dot"] == pytest.approx([0.3])


BAD = [
    (FREE, FREE_MAP, "carrier.V[", "carrier.W[", '"carrier.W[1]" is no variable, did you mean'),
    (FREE, FREE_MAP, 'V = "carrier.V[', 'V = "carrier.V_dot[', '"carrier.V_dot[1]" cannot be set'),
    (FREE, FREE_MAP, 'V = "carrier.V[{i}]"', 'V = ["a", "b"]', "state.V: 2 variables, expected 6"),
    (FREE, FREE_MAP, "[forward]", "[foward]", 'did you mean "forward"?'),
    (FREE, FREE_MAP, "quaternion =", "quaternio =", 'did you mean "quaternion"?'),
    (FREE, FREE_MAP, 'carrier = "carrier.wrench[{i}]"', "", "state.wrench.carrier is missing"),
    (FREE, FREE_MAP, '[forward]\nV_dot = "carrier.V_dot[{i}]"', "", "no answers"),
    (FREE, FREE_MAP, 'V = "carrier.V[{i}]"', "V = [1, 2, 3, 4, 5, 6]", "expected the name of a variable"),
    (FREE, FREE_MAP, '"carrier.V[{i}]"', '[{ variable = "a", factor = 0 }]', "the factor not zero"),
    (FREE, FREE_MAP, "[state]", "[state", "no TOML"),
    (held_text(), JOINT_MAP, 'q = "joint.{freedom}.s"\n', "", "state.quaternion or state.angles is missing: answers"),
    (held_text(), JOINT_MAP, 'u = "joint.{freedom}.v"\n', "", "state.V or state.u is missing: answers of this stand"),
    (held_text(), JOINT_MAP, '["joint.a"]', '["a", "b"]', "forward.u_dot: 2 variables, expected 1"),
    (held_text(), JOINT_MAP, 'u_dot = ["joint.a"]', 'reaction = "R[{i}]"', "forward.u_dot is missing"),
    (held_text(), JOINT_MAP, "q =", "orientation =", 'state: unknown key "orientation"'),
]


@pytest.mark.parametrize(("stand", "text", "old", "new", "words"), BAD, ids=[case[-1] for case in BAD])
def test_maps_that_are_refused(fmu: Path, stand: str, text: str, old: str, new: str, words: str) -> None:
    assert old in text
    assert words in refused(*judged(stand, fmu, text.replace(old, new)))


def test_files_that_are_refused(fmu: Path) -> None:
    assert "no such file" in refused(*judged(FREE, "none.fmu", FREE_MAP))
    assert "stand.toml: is a stand file, expected an FMU" in refused(*judged(FREE, "stand.toml", FREE_MAP))
    assert "--map" in refused(*judged(FREE, fmu, FREE_MAP)[:-2])
    assert "of them, expected one" in refused(*judged(FREE, fmu, FREE_MAP), "--with", "cat")


@pytest.mark.parametrize("name", ["../outside", "/outside", "C:outside"])
def test_an_fmu_that_would_write_outside_its_folder_does_not(
    fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    room = tmp_path / "room" / "inner"
    room.mkdir(parents=True)
    monkeypatch.setattr(tempfile, "tempdir", str(room))
    with ZipFile(fmu) as whole, ZipFile(tmp_path / "bad.fmu", "w") as archive:
        for entry in whole.infolist():
            archive.writestr(entry.filename, whole.read(entry))
        archive.writestr(name, "x")
    run(*judged(FREE, tmp_path / "bad.fmu", FREE_MAP, "--states", "1"))
    assert [entry.name for entry in (tmp_path / "room").rglob("*")] == ["inner"]


def late() -> Iterator[bytes]:
    """No lines, after the time limit."""
    time.sleep(3)
    yield from ()


@pytest.mark.parametrize("kill", quick(1, [False, True]))
def test_nothing_of_an_fmu_stays(fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kill: bool) -> None:
    """Its unpacked files are removed, also where its process is killed."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    limit: Any = ("--timeout", "1 s") if kill else ()
    if kill:
        monkeypatch.setattr("mahovik.proof.verify.foreign._lines", lambda _: late())
    result = run(*judged(FREE, fmu, FREE_MAP, "--states", "3", *limit))
    assert result.exit_code == (1 if kill else 0), result.output
    assert list(tmp_path.iterdir()) == []
