"""README.md: what its first screen shows, and an example that a real stand could follow."""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path
from subprocess import run

import numpy as np
import pytest

from docs.execute import Session, steps
from docs.pages import ROOT, blocks
from mahovik import __version__
from mahovik.core.stand import loads

README = ROOT / "README.md"
SCREEN = 30
"""Lines of the first screen."""


def test_the_first_screen_has_a_stand_a_command_and_a_picture() -> None:
    text = README.read_text(encoding="utf-8")
    stand, command = blocks(README)[:2]
    assert stand.file == "telescope.toml" and len(stand.text.splitlines()) <= 11
    assert loads(stand.text).flywheels
    assert len(command.text.splitlines()) == 1
    (picture,) = re.findall(r"!\[[^]]*\]\(([^)]+)\)", "\n".join(text.splitlines()[:SCREEN]))
    assert (ROOT / picture).is_file()
    recipe = (ROOT / "Makefile").read_text(encoding="utf-8")
    drawn = command.text.strip().removeprefix("mahovik ").replace("telescope.toml", "build/demo/telescope.toml")
    assert drawn.replace("-o jitter.svg", f"-o {picture}") in recipe


@pytest.mark.slow
def test_the_planned_motion_is_one_that_motors_can_do(tmp_path: Path) -> None:
    """Motors of half a kilogram turn at some thousand rpm, with tenths of a newton metre."""
    (step,) = (each for each in steps(README) if "mahovik plan" in each.block.text)
    session = Session(README, tmp_path)
    run([sys.executable, "-m", "mahovik", "new", "shaker2", "-o", tmp_path / "mine.toml"], check=True)
    session.run(step)
    programme, printed = json.loads((tmp_path / "programme.json").read_text()), "".join(session.outputs)
    assert programme["winding"] == [1, -1]
    peaks = np.array(
        re.findall(r"^ (?:left|right) +([\d.e+-]+) +([\d.e+-]+) +([\d.e+-]+)", printed, re.MULTILINE), float
    )
    assert peaks.shape == (2, 3)
    assert np.all(peaks.max(axis=0) < [500.0, 100.0, 0.2])


def test_the_citation_names_this_version() -> None:
    """CITATION.cff has the keys that its format 1.2 requires."""
    found = dict(re.findall(r"^([\w-]+): *(.*)$", (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE))
    assert {"authors", "cff-version", "message", "title"} <= set(found)
    assert (found["cff-version"], found["version"]) == ("1.2.0", __version__)


def test_who_contributes_finds_the_words_and_the_checks() -> None:
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert "docs/glossary.md" in text and "(CONTRIBUTING.md)" in README.read_text(encoding="utf-8")
