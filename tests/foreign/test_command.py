"""`mahovik new` of a model as used from the command line: files, messages, and refusals that write nothing."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from cli.run import refused, run
from mahovik.core.stand.fields import name_problem
from mahovik.out.foreign.model import angles_of
from mahovik.out.foreign.naming import Names

MODELS = Path(__file__).parent / "models"
URDF, MJCF = str(MODELS / "sat.urdf"), str(MODELS / "sat.xml")


@pytest.fixture(autouse=True)
def somewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_a_urdf_becomes_a_stand_that_is_checked_and_generated() -> None:
    said = run("new", URDF).output
    assert said.startswith("files: small_sat.toml\ncarrier base_link, 4 flywheels, 1 point\n")
    assert "agrees with the original in Pinocchio" in said
    assert os.listdir() == ["small_sat.toml"]
    assert run("check", "small_sat.toml").exit_code == 0
    assert run("generate", "small_sat.toml").exit_code == 0


def test_an_mjcf_too() -> None:
    said = run("new", MJCF, "-o", "new/other.toml", "--name", "other", "--instruments").output
    assert "carrier hub, 1 instrument, 3 flywheels, 2 points" in said
    assert "agrees with the original in MuJoCo" in said
    assert run("check", "new/other.toml").output.startswith("other ")


def test_what_alone_was_compared_is_told() -> None:
    """Only torques are compared if the base is fixed on the world."""
    wheel = '<joint name="j" axis="0 0 1"/><inertial pos="1e-3 0 0" mass="1" diaginertia=".01 .01 .015"/>'
    hub = f'<body name="b"><inertial pos="0 0 0" mass="3" diaginertia=".1 .1 .1"/><body name="w">{wheel}</body></body>'
    Path("held.xml").write_text(f'<mujoco model="held"><worldbody>{hub}</worldbody></mujoco>', encoding="utf-8")
    said = run("new", "held.xml", "--carrier", "b").output
    assert "at 20 random states in tau alone, since it is fixed on the world there" in said


def test_nothing_is_overwritten() -> None:
    Path("small_sat.toml").write_text("mine")
    assert refused("new", URDF) == "error: small_sat.toml: exists already, nothing was written\n"
    assert Path("small_sat.toml").read_text() == "mine"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("no.urdf",), "no.urdf: no such file"),
        ((URDF, "--name", "a b"), '--name a b: "a b" is not a C identifier'),
        ((URDF, "--name", "math"), '--name math: "math" is the name of a standard header of C'),
        ((URDF, "--carrier", "wheel4"), "--carrier wheel4: turns"),
        ((URDF, "--gravity", "0,0,nan"), "--gravity 0,0,nan: expected three finite numbers"),
    ],
)
def test_refused(arguments: tuple[str, ...], said: str) -> None:
    text = refused("new", *arguments)
    assert said in text
    assert text.count("\n") == 1
    assert os.listdir() == []


def test_without_pinocchio_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    said = run("new", URDF).output
    assert "not compared with the original: pinocchio is not installed: pip install pin" in said
    assert os.listdir() == ["small_sat.toml"]


def test_a_stand_that_disagrees_is_not_written(monkeypatch: pytest.MonkeyPatch) -> None:
    """Should the reading of a format be wrong for a file, the other program notices."""
    from mahovik.out.foreign import urdf

    monkeypatch.setattr(urdf, "rotation_from_rpy", lambda *_: np.eye(3))
    said = refused("new", URDF, status=1)
    assert said.startswith("error: sat.urdf: the stand differs from the original in Pinocchio")
    assert os.listdir() == []


def test_every_name_is_an_identifier_of_its_own() -> None:
    names = Names()
    given = [
        "wheel 1",
        "wheel_1",
        "wheel/1",
        "1st",
        "",
        "колесо",
        "int",
        "carrier",
        "a" * 300,
        "a" * 301,
        "x_",
        "class",
    ]
    found = [names.name(each, "flywheel") for each in given]
    assert found[:5] == ["wheel_1", "wheel_1_2", "wheel_1_3", "_1st", "flywheel"]
    assert len(set(found)) == len(found)
    assert [name_problem(each) for each in found] == [None] * len(found)
    assert "carrier" not in found


def test_angles_of_any_axes() -> None:
    """At the singularity of the angles as well, where either of two may be anything."""
    rng = np.random.default_rng(3)
    for _ in range(500):
        psi, theta, phi = rng.uniform(-3, 3, 3)
        if rng.random() < 0.6:
            theta = rng.choice([-1, 1]) * (np.pi / 2 + 10.0 ** rng.uniform(-17, -1) * rng.choice([-1, 0, 1]))
        axes = np.asarray(Rotation.from_euler("ZYX", [psi, theta, phi]).as_matrix())
        again = Rotation.from_euler("ZYX", angles_of(axes)).as_matrix()
        assert np.abs(again - axes).max() < 1e-15 * 4
