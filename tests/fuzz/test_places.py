"""Paths that are not files, endless files and too large files: every command that reads refuses them in one line."""

from __future__ import annotations

import io
import os
from pathlib import Path

import pytest

from cli.run import DEMO3, run
from fuzz.reading import READERS, check_message, soon
from mahovik.core.motion.read import loads_regime
from mahovik.core.stand import Stand, load
from mahovik.errors import RegimeError
from mahovik.proof.verify import states
from mahovik.proof.verify.backends import NumpyBackend

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


def test_a_line_of_eval_without_an_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(states, "LONGEST", 1000)
    stream = io.BytesIO(b"[" * 5000 + b'\n{"id": 1}\n' + b"{" * 3000)
    answers = [
        text for text, _ in states.evaluate_lines(load_demo3(), NumpyBackend(load_demo3()), states.split_lines(stream))
    ]
    assert len(answers) == 3
    assert "more than 1000 bytes" in answers[0]
    assert '"id": 1' in answers[1]


def load_demo3() -> Stand:
    return load(DEMO3)


@pytest.mark.parametrize("table", ["/dev/zero", ".", "", "\0", "x" * 5000])
def test_a_table_that_is_no_file(table: str, tmp_path: Path) -> None:
    text = f'schema = 1\n[default]\ntable = "{table}"\n'.replace("\0", "\\u0000")
    with soon(), pytest.raises(RegimeError) as found:
        loads_regime(text, load_demo3(), 1.0, folder=tmp_path)
    check_message(str(found.value))
