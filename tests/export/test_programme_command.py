"""`mahovik generate --programme`: what it writes where, and what it refuses."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from cli.run import refused, run
from export.programmes import motion, spin, stand, stand_files
from mahovik import stands
from mahovik.core.motion.programme import Programme, save_programme
from mahovik.errors import CheckError
from mahovik.out.export.programme import export_programme

STAND = str(stands.path("shaker2"))
MOTION = str(stands.path("shaker2").parent / "shaker2_spin.motion.json")
FILES = [f"shaker2_programme{end}" for end in (".c", ".h", ".json", ".md", "_test.c")]


@pytest.fixture
def saved(tmp_path: Path) -> str:
    """A programme file."""
    return save(spin(), tmp_path)


def save(programme: Programme, folder: Path) -> str:
    """A programme as a file in a folder."""
    save_programme(programme, folder / "P.json")
    return str(folder / "P.json")


def test_files_and_what_is_said(saved: str, tmp_path: Path) -> None:
    folder = tmp_path / "made"
    result = run("generate", STAND, "--programme", saved, "--motion", MOTION, "-o", str(folder))
    assert result.exit_code == 0, result.output
    assert {path.name for path in folder.rglob("*.*")} >= {*FILES, "shaker2.c"}
    lines = result.stdout.splitlines()
    lines = lines[[line.startswith("programme: ") for line in lines].index(True) :]
    assert lines[0] == "programme: quintic, 256 intervals, double, 0.05 s"
    assert lines[-2].startswith("programme: relative residual ")
    assert lines[-1] == "accepted error of the tables: 1e-06"
    again = run("generate", STAND, "--programme", saved, "--motion", MOTION, "-o", str(folder), "--table", "fourier")
    assert "programme: fourier, 2 harmonics, double" in again.stdout


def test_a_project_under_another_name_plays_the_programme_and_is_checked(saved: str, tmp_path: Path) -> None:
    """The folder knows name, project and functions; what is changed by hand is found, and not overwritten."""
    folder = tmp_path / "made"
    play = ("generate", STAND, "--programme", saved, "--motion", MOTION, "-o", str(folder))
    result = run(*play, "--project", "cmake", "--prefix", "vib", "--only", "forward")
    assert result.exit_code == 0, result.output
    assert run(*play).exit_code == run(*play, "--check").exit_code == 0
    assert run("generate", STAND, "-o", str(folder), "--check").exit_code == 0
    judged = run("verify", STAND, str(folder), "--programme", saved, "--motion", MOTION)
    assert judged.exit_code == 0 and "C torque" in judged.stdout
    source = folder / "vib_programme.c"
    source.write_text(source.read_text() + "\n")
    said = refused(*play, "--check", status=1)
    assert said == f"error: {source}: is not what the generator makes of the stand file\n"
    assert f"{source}: was changed by hand" in refused(*play)
    said = refused("generate", STAND, "-o", str(folder), "--check", status=1)
    assert said == f"error: {source}: is not what vib_programme.json lists\n"
    judged = run("verify", STAND, str(folder), "--programme", saved, "--motion", MOTION)
    said = judged.stdout.splitlines()[-1]
    assert judged.exit_code == 0 and "edited by hand after mahovik" in said and "; vib_programme.c, line " in said
    judged = run("verify", STAND, str(folder), "--states", "2")
    assert judged.exit_code == 1 and "vib_programme = as written" in judged.stdout


@pytest.mark.parametrize("name", ["forward", "left", "2nd"])
def test_a_name_that_the_stand_has_is_refused(name: str, saved: str, tmp_path: Path) -> None:
    message = refused("generate", STAND, "--programme", saved, "-o", str(tmp_path / "new"), "--name", name)
    assert f"--name {name}: " in message
    assert not (tmp_path / "new").exists()


def test_the_element_type_is_that_of_the_header(saved: str, tmp_path: Path) -> None:
    for name, text in stand_files("float").items():
        (tmp_path / name).write_text(text)
    assert "64 intervals, float" in run("generate", STAND, "--programme", saved, "-o", str(tmp_path)).stdout
    said = refused("generate", STAND, "--programme", saved, "-o", str(tmp_path), "--real", "double")
    assert said.startswith("error: --real double: ") and "has float; leave it out" in said
    header = tmp_path / "shaker2.h"
    text = header.read_text()
    physics = text.split("SHAKER2_PHYSICS   0x")[1][:8]
    header.write_text(text.replace(physics, "00000000"))
    assert "is of another stand" in refused("generate", STAND, "--programme", saved, "-o", str(tmp_path), status=1)


@pytest.mark.parametrize("part", ["", "runup"])
def test_a_programme_that_exceeds_its_bounds_is_refused(part: str, tmp_path: Path) -> None:
    """It exceeds bounds by the report of its planner, those of a run-up as well."""
    over = {"exceeded": ["speed of upper 131 rad/s exceeds its bound, 100 rad/s"]}
    saved = save(replace(spin(), report={part: over} if part else over), tmp_path)
    folder = tmp_path / "made"
    result = run("generate", STAND, "--programme", saved, "-o", str(folder))
    assert result.exit_code == 1
    assert result.stderr.splitlines()[-1].endswith(
        "P.json: exceeds its bounds: speed of upper 131 rad/s exceeds its bound, 100 rad/s: plan again; "
        "nothing was written"
    )
    assert not folder.exists()


def test_bounds_of_the_motion_are_measured() -> None:
    """Speeds of 126 rad/s are above the bound of 100, whatever the programme reports."""
    bounded = replace(motion(), bounds=replace(motion().bounds, speed=(100.0, 100.0)))
    with pytest.raises(CheckError, match=r"exceeds its bounds: bound speed \w+: 125\.\d+ of 100 rad/s"):
        export_programme(stand(), spin(), bounded)
