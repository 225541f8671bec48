"""Paths that are not files, endless files and too large files: every command that reads refuses them in one line."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from cli.run import DEMO3, run
from fuzz.reading import READERS, check_message, soon

pytestmark = READERS

COMMANDS = {
    "check": ("check", "{}"),
    "derive": ("derive", "{}", "-o", "{out}"),
    "generate": ("generate", "{}", "-o", "{out}"),
    "verify": ("verify", "{}"),
    "verify --against": ("verify", DEMO3, "--against", "{}"),
    "eval": ("eval", "{}"),
    "rest": ("rest", "{}"),
    "cost": ("cost", "{}", "-o", "{out}"),
    "export target": ("export", "target", "{}", "--target", "m7", "-o", "{out}"),
    "export fuzz": ("export", "fuzz", "{}", "-o", "{out}"),
    "simulate": ("simulate", "{}", "--until", "0.001", "-o", "{out}/x.csv"),
    "regime": ("simulate", DEMO3, "--until", "0.001", "-o", "{out}/x.csv", "--regime", "{}"),
    "start": ("simulate", DEMO3, "--until", "0.001", "-o", "{out}/x.csv", "--start", "{}"),
    "replay": ("replay", "--log", "{}"),
    "replay, stand": ("replay", DEMO3, "--log", "{}"),
    "judge-log": ("judge-log", "--log", "{}"),
    "judge-log, stand": ("judge-log", DEMO3, "--log", "{}"),
}
PLACES = ("missing", "folder", "empty", "/dev/zero", "a/b", "blank", "closed")


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("command", COMMANDS)
def test_a_place_that_holds_nothing_to_read(command: str, place: str, tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "empty").touch()
    (tmp_path / "blank").write_bytes(b" \r\n\t\n" * 9)
    (tmp_path / "closed").write_bytes(b"x")
    os.chmod(tmp_path / "closed", 0)
    target = str(tmp_path / place)
    words = [word.replace("{}", target).replace("{out}", str(tmp_path / "out")) for word in COMMANDS[command]]
    with soon(60):
        result = run(*words)
    assert result.exit_code in (1, 2)
    check_message(result.stderr)
    assert len(result.stderr.splitlines()) < 30
    assert not (tmp_path / "out").exists()
