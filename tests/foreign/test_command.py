"""`mahovik new` of a model as used from the command line: files, messages, and refusals that write nothing."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from cli.run import refused, run
from foreign.test_models import px4
from mahovik.core.stand.fields import name_problem
from mahovik.out.foreign.model import Place, angles_of
from mahovik.out.foreign.original import read
from mahovik.out.foreign.stand import make_stand

MODELS = Path(__file__).parent / "models"
URDF, MJCF = str(MODELS / "sat.urdf"), str(MODELS / "sat.xml")


@pytest.fixture(autouse=True)
def somewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_a_urdf_becomes_a_stand_that_is_checked_and_generated() -> None:
    said = run("new", URDF).output
    assert said.startswith("files: small_sat.toml\ncarrier base_link, 4 flywheels, 1 point\n")
    assert "agrees with MuJoCo's model of the file at 20 random states" in said
    assert os.listdir() == ["small_sat.toml"]
    assert run("check", "small_sat.toml").exit_code == 0
    assert run("generate", "small_sat.toml").exit_code == 0


def test_an_mjcf_too() -> None:
    said = run("new", MJCF, "-o", "new/other.toml", "--name", "other", "--instruments").output
    assert "carrier hub, 1 instrument, 3 flywheels, 2 points" in said
    assert run("check", "new/other.toml").output.startswith("other ")


def test_a_vehicle_of_several_files() -> None:
    said = run("new", str(px4(Path())), "--fix", "g::pitch", "--gravity", "0,0,-9.81").output
    assert said.startswith("files: x.toml\ncarrier base_link, 2 flywheels, 1 point\n")
    assert "gravity = [0.0, 0.0, -9.81]" in Path("x.toml").read_text()
    assert run("check", "x.toml").exit_code == 0


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
        ((MJCF, "--gravity", "0,0,1"), "--gravity: a model of MuJoCo has its own"),
        (("bench8", "--fix", "j"), "--fix: of a FILE of another program, not of the example bench8"),
    ],
)
def test_refused(arguments: tuple[str, ...], said: str) -> None:
    text = refused("new", *arguments)
    assert said in text
    assert text.count("\n") == 1
    assert os.listdir() == []


def test_a_stand_that_disagrees_is_not_written(monkeypatch: pytest.MonkeyPatch) -> None:
    """Should the reading of a file be wrong, MuJoCo notices."""
    monkeypatch.setattr(Place, "point", lambda self, inside: self.origin + 1.01 * self.axes @ inside)
    said = refused("new", URDF, status=1)
    assert said.startswith("error: sat.urdf: the stand differs from MuJoCo's model, forces on the carrier by 0.")
    assert os.listdir() == []


def test_every_name_is_an_identifier_of_its_own() -> None:
    written = ["wheel 1", "wheel_1", "wheel/1", "1st", "колесо", "int", "carrier", "a" * 70, "a" * 71, "x_", "class"]
    places = "".join(f'<site name="{name}"/>' for name in written)
    text = f'<mujoco><worldbody><body><freejoint/><geom size="1"/>{places}</body></worldbody></mujoco>'
    Path("m.xml").write_text(text, encoding="utf-8")
    names = [point.name for point in make_stand(read(Path("m.xml"), None)[0], "m", "m.xml").stand.points]
    assert names[:5] == ["wheel_1", "wheel_1_2", "wheel_1_3", "_1st", "point"]
    assert len(set(names)) == len(written)
    assert [name_problem(name) for name in names] == [None] * len(names)
    assert "carrier" not in names


def test_angles_of_any_axes() -> None:
    """They give the rotation back, also at their singularity, where either of two may be anything."""
    rng = np.random.default_rng(3)
    for _ in range(500):
        psi, theta, phi = rng.uniform(-3, 3, 3)
        if rng.random() < 0.6:
            theta = rng.choice([-1, 1]) * (np.pi / 2 + 10.0 ** rng.uniform(-17, -1) * rng.choice([-1, 0, 1]))
        axes = np.asarray(Rotation.from_euler("ZYX", [psi, theta, phi]).as_matrix())
        again = Rotation.from_euler("ZYX", angles_of(axes)).as_matrix()
        assert np.abs(again - axes).max() < 1e-15 * 4
