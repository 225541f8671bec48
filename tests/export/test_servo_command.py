"""`mahovik export servo`: what it writes where, and what it refuses."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.run import refused, run
from export.programmes import spin, stand_files
from export.servos import HEAD, TRIM
from mahovik import stands
from mahovik.core.motion.programme import save_programme

STAND = str(stands.path("shaker2"))
MOTION = str(stands.path("shaker2").parent / "shaker2_spin.motion.json")
FILES = sorted(
    [f"shaker2_programme{end}" for end in (".c", ".h", ".json", ".md", "_test.c")]
    + [f"shaker2_servo{end}" for end in (".c", ".h", ".json", ".md", "_test.c", "_main.c")]
)


@pytest.fixture
def arguments(tmp_path: Path) -> list[str]:
    """A programme and a servo as files, a folder D to write to."""
    save_programme(spin(), tmp_path / "P.json")
    (tmp_path / "S.toml").write_text(HEAD + TRIM)
    given = ["--programme", str(tmp_path / "P.json"), "--servo", str(tmp_path / "S.toml"), "-o", str(tmp_path / "D")]
    return ["export", "servo", STAND, *given]


def test_files_and_what_is_said(arguments: list[str], tmp_path: Path) -> None:
    folder = tmp_path / "D"
    folder.mkdir()
    for name, text in stand_files("float").items():
        (folder / name).write_text(text)
    result = run(*arguments, "--motion", MOTION)
    assert result.exit_code == 0, result.output
    assert sorted({path.name for path in folder.rglob("*.*")} - {"shaker2.c", "shaker2.h"}) == FILES
    said = result.stdout.splitlines()[len(FILES) :]
    assert "float" in said[0]
    assert "servo: 0.5 ms per sample, 0.7 ms of delay; 100 samples are 1 period" in said
    (folder / "shaker2_servo.c").write_text("mine")
    assert "shaker2_servo.c: was changed by hand" in refused(*arguments, "--motion", MOTION)
    assert (folder / "shaker2_servo.c").read_text() == "mine"


def test_torques_and_trim_want_the_motion(arguments: list[str], tmp_path: Path) -> None:
    wanted = "needs the motion of the programme: give --motion MOTION.json, or"
    assert f"S.toml: feedforward: {wanted} feedforward = false" in refused(*arguments)
    (tmp_path / "S.toml").write_text(HEAD + "feedforward = false\n" + TRIM)
    assert f"S.toml: trim: {wanted} trim = false" in refused(*arguments)
    assert not (tmp_path / "D").exists()


def test_what_is_not_stable_is_refused(arguments: list[str], tmp_path: Path) -> None:
    (tmp_path / "S.toml").write_text(HEAD.replace("60 Hz", "400 Hz"))
    said = refused(*arguments, "--motion", MOTION, status=1)
    assert said.count("\n") == 1
    assert "S.toml: bandwidth 400 Hz at 0.5 ms per sample and 0.7 ms of delay: unstable" in said
    assert "give at most " in said
    assert not (tmp_path / "D").exists()


def test_bad_servo_files(arguments: list[str], tmp_path: Path) -> None:
    (tmp_path / "S.toml").write_text(HEAD + "gain = 3\n")
    assert 'S.toml: unknown key "gain", expected one of name, sample_period' in refused(*arguments)
    (tmp_path / "S.toml").unlink()
    assert "S.toml: no such file" in refused(*arguments)


def test_a_programme_of_another_stand_is_refused(arguments: list[str], tmp_path: Path) -> None:
    """Before a trim is computed, in one line; whatever the number of flywheels."""
    bench8 = str(stands.path("bench8").with_name("bench8.motion.json"))
    for name, motion in (("bench8", bench8), ("shaker2", MOTION)):
        stand = tmp_path / "other.toml"
        stand.write_text(stands.path(name).read_text().replace("mass = 0.5", "mass = 0.6"))
        said = refused("export", "servo", str(stand), *arguments[3:], "--motion", motion, status=1)
        assert "P.json: programme of another stand" in said
        assert said.count("\n") == 1
    assert not (tmp_path / "D").exists()
