"""A file of one kind in the place of another: one line says what it is and what is expected."""

from __future__ import annotations

import json
import shlex
from pathlib import Path

import pytest

from cli.run import refused
from mahovik import stands
from mahovik.core.motion.programme import save_programme
from mahovik.core.stand.files import words_of_file
from verify.programme.programmes import shaker

WORDS = {
    "stand.toml": "a stand file", "servo.toml": "a file of servos", "regime.toml": "a regime",
    "motion.json": "a motion file", "programme.json": "a programme file", "campaign.toml": "a campaign file",
    "influence.json": "a file of influences", "state.json": "a state", "table.csv": "a table (CSV)",
    "robot.urdf": "a URDF", "free.toml": "a list of free numbers", "manifest.json": "a manifest of generated C",
    "result.json": "what a command printed with --json", "map.toml": "a map of variables", "lead.zip": "a ZIP archive",
}  # fmt: skip

TEXTS = {
    "regime.toml": 'schema = 1\n[default]\nspeed = "3000 rpm"\n',
    "campaign.toml": 'schema = 1\nstand = "stand.toml"\nsamples = 3\n[vary]\n"carrier.mass" = { tolerance = 0.1 }\n',
    "influence.json": '{"A": ["170@112"], "B": [["235@94"]], "U": ["1.15@0"]}',
    "state.json": '{"V": [0, 0, 0, 0, 0, 1]}',
    "table.csv": "order [-],radial force [N/(rad/s)^2]\n1,1.5e-6\n",
    "robot.urdf": '<robot name="r"><link name="base"/></robot>',
    "free.toml": 'schema = 1\nfree = ["left.mass"]\n',
    "manifest.json": '{"format": 1, "generator": "mahovik 0.1.0", "files": {}}',
    "result.json": json.dumps({"units": {}, "messages": [], "ok": True}),
    "map.toml": '[state]\nV = "v[{i}]"\n[forward]\nV_dot = "a[{i}]"\n',
    "lead.zip": "PK\x03\x04",
}

COMMANDS = {
    "a stand file": "check {}",
    "a regime": "simulate stand.toml --until 1 --regime {}",
    "a motion file": "plan stand.toml --motion {}",
    "a programme file": "generate stand.toml --programme {}",
    "a file of servos": "simulate stand.toml --programme programme.json --motion motion.json --servo {}",
    "a state": "simulate stand.toml --until 1 --start {}",
    "a campaign file": "campaign {} -o out",
    "a file of influences": "balance --influence {}",
    "a table (CSV)": "vibration stand.toml --speed all=100 --at carrier --harmonics all={}",
    "a map of variables": "judge stand.toml --fmu lead.zip --map {}",
    "an FMU": "judge stand.toml --fmu {} --map map.toml",
    "a file of measured data": "identify stand.toml --free left.mass --data {}",
    "a list of free numbers": "identify stand.toml --data table.csv --free {}",
}
"""What an argument expects, and a command that takes it."""


@pytest.fixture(autouse=True)
def files(work_folder: Path) -> set[str]:
    """A file of each kind."""
    example = stands.path("shaker2")
    Path("stand.toml").write_text(example.read_text())
    Path("motion.json").write_text(example.with_name("shaker2_spin.motion.json").read_text())
    Path("servo.toml").write_text((example.parent / "servos" / "bench8.toml").read_text())
    save_programme(shaker()[2], work_folder / "programme.json")
    for name, text in TEXTS.items():
        Path(name).write_text(text)
    return {path.name for path in work_folder.iterdir()}


def test_kinds_are_known_by_content() -> None:
    assert {name: words_of_file(Path(name)) for name in WORDS} == WORDS
    assert words_of_file(Path("missing.toml")) is None


@pytest.mark.parametrize("text", ["\x01a,\x02\nb,c\n", "ab, c\nd, e, f\n"])
def test_a_text_with_a_comma_is_no_table(text: str) -> None:
    Path("random.toml").write_text(text)
    assert refused("check", "random.toml").startswith("error: random.toml: not TOML: ")


@pytest.mark.parametrize("expected", COMMANDS)
def test_one_line_says_what_a_file_is(expected: str, files: set[str]) -> None:
    fits = {"a file of measured data": ("table.csv",), "an FMU": ("lead.zip",), "a regime": ("programme.json",)}
    for name, words in WORDS.items():
        if words == expected or name in fits.get(expected, ()):
            continue
        if expected == "a list of free numbers" and not name.endswith(".toml"):
            continue  # is a path of the stand
        said = refused(*shlex.split(COMMANDS[expected].format(name)))
        assert said == f"error: {name}: is {words}, expected {expected}\n"
    assert {path.name for path in Path().iterdir()} == files


def test_a_file_that_is_no_model_makes_no_stand(files: set[str]) -> None:
    assert refused("new", "stand.toml").startswith("error: stand.toml: is a stand file, expected a URDF")
    assert {path.name for path in Path().iterdir()} == files
