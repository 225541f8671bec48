"""`--json` of every command that prints a table: one document on standard output, also where a check fails."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import click
import pytest

import mahovik.proof.evidence.pieces as all_pieces
from cli.run import BENCH8, DEMO3, run
from mahovik.out.cli import main
from mahovik.stands import path
from report.evidence import BAD, GOOD

FOLDER = Path(DEMO3).parent
SAT4, SHAKER2 = str(path("sat4")), str(path("shaker2"))
SPIN, TILT = str(FOLDER / "shaker2_spin.motion.json"), str(FOLDER / "shaker2.motion.json")
TURN = str(FOLDER / "demo3.motion.json")

BAND = ("30..40Hz", "--momentum", "1 0 0")

WITHOUT = {
    "eval": "its output is JSON already, an object a line",
    "generate": "prints the files that it wrote; manifest.json beside them lists them for programs",
    "derive": "prints LaTeX, or the file that it wrote",
    "linearize": "prints the file that it wrote, which is JSON already",
    "plot": "draws a picture",
    "report": "writes a page",
    "import urdf": "writes a stand file",
    "import mjcf": "writes a stand file",
    "campaign shard": "prints a line for each shard",
    "campaign merge": "prints the file that it wrote",
    "campaign report": "writes a page",
    "completion": "prints a script of a shell",
    "export target": "prints the files that it wrote",
    "export attitude": "prints the files that it wrote",
    "export fuzz": "prints the files that it wrote",
    "export programme": "prints the files that it wrote",
    "export servo": "prints the files that it wrote",
    "export fmu": "prints the files that it wrote",
    "export cmake": "prints the files that it wrote",
}
"""Commands without a table, and what they print instead."""

ELSEWHERE = {
    **dict.fromkeys(("campaign run", "campaign status", "campaign resume"), "test_campaign.py"),
    "cost": "test_cost.py",
    "excite": "test_excite.py",
    "identify": "../identify/test_identify.py",
    "judge-log": "test_judge_log.py",
    "replay": "test_replay.py",
}
"""Commands whose cases need much that their own test has."""

GOOD_CASES = {
    "new": ("--list",),
    "check": (DEMO3,),
    "rest": (DEMO3,),
    "doctor": (),
    "modes": (SHAKER2,),
    "response": (SAT4, "--speed", "rw1=1000 rpm", "--at", "acc1"),
    "jitter": (SAT4, "--speed", "rw1=1000 rpm", "--at", "acc1"),
    "quiet": (SAT4, "--point", "acc1", "--band", *BAND, "--time", "0.5", "--backend", "none"),
    "balance": ("--influence", "rotor.json"),
    "simulate": (DEMO3, "--until", "0.001", "--backend", "scipy", "-o", "run.csv"),
    "verify": (DEMO3, "--states", "2"),
    "evidence": (DEMO3, "--only", "good"),
    "design": (SHAKER2, "--motion", SPIN, "--free", "phase", "-o", "d.toml"),
}  # fmt: skip
"""Command -> arguments by which it ends with status 0."""

BAD_CASES = {
    "rest": ("falling.toml",),
    "modes": ("falling.toml",),
    "response": ("falling.toml", "--speed", "w1=10", "--at", "carrier"),
    "jitter": ("falling.toml", "--speed", "w1=10", "--at", "carrier"),
    "quiet": (SAT4, "--point", "acc1", "--band", *BAND, "--limit", "1 rpm"),
    "plan": (DEMO3, "--motion", "far.json", "-o", "p.json"),
    "design": (SHAKER2, "--motion", TILT, "--free", "phase", "-o", "d.toml", "--time", "0.1"),
    "verify": (DEMO3, "--with", "cat", "--states", "2"),
    "judge": (DEMO3, "--with", "cat", "--states", "2"),
    "verify-programme": (SHAKER2, "--motion", SPIN, "--programme", "still.json"),
    "evidence": (DEMO3,),
    "evidence --check": ("broken",),
}
"""Command -> arguments by which it ends with status 1."""


def commands(group: click.Group = main, name: str = "") -> Iterator[tuple[str, click.Command]]:
    """All commands, with the names of their groups before theirs."""
    for each, command in group.commands.items():
        if isinstance(command, click.Group):
            yield from commands(command, f"{name}{each} ")
        else:
            yield f"{name}{each}", command


@pytest.fixture(autouse=True)
def files(own_folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Files that the cases read."""
    monkeypatch.setattr(all_pieces, "PIECES", (GOOD, BAD))
    monkeypatch.delenv("CI", raising=False)
    (own_folder / "broken").mkdir()
    (own_folder / "rotor.json").write_text('{"A": ["2@30"], "ALPHA": [["1@0"]]}', encoding="utf-8")
    (own_folder / "broken" / "SHA256SUMS").write_text(f"{'0' * 64}  c/demo3.c\n", encoding="utf-8")
    wheel = '[[flywheel]]\nname = "w1"\nmass = 1\ninertia = [1, 1, 1]\n'
    carrier = "[carrier]\nmass = 1\ninertia = [1, 1, 1]\n"
    (own_folder / "falling.toml").write_text(
        f'schema = 1\nname = "falling"\ngravity = [0, 0, -9.81]\n{carrier}{wheel}', encoding="utf-8"
    )
    motion = json.loads(Path(TURN).read_text(encoding="utf-8"))
    far = motion | {"harmonics": [{"k": 1, "cos": [0.0, 0.0, 0.1, 1.0, 0.0, 0.0]}], "winding": "any"}
    (own_folder / "far.json").write_text(json.dumps(far), encoding="utf-8")
    still = {
        "schema": 1,
        "stand": {"name": "shaker2", "structure": "0" * 8, "physics": "0" * 8},
        "motion": "other",
        "flywheels": ["w1", "w2"],
        "period": 1.0,
        "bias": [0.0] * 6,
        "winding": [0, 0],
        "fourier": {"mean": [0.0, 0.0], "cos": [[0.0, 0.0]], "sin": [[0.0, 0.0]]},
    }
    (own_folder / "still.json").write_text(json.dumps(still), encoding="utf-8")


def test_every_command_has_it_or_a_reason() -> None:
    """Commands with --json are run here or in their own test."""
    has = {name for name, command in commands() if any("--json" in option.opts for option in command.params)}
    names = {name for name, _ in commands()}
    assert names - has <= set(WITHOUT)
    assert not has & set(WITHOUT)
    cases = {case.split(" --")[0] for case in (*GOOD_CASES, *BAD_CASES)}
    assert has == cases | set(ELSEWHERE)
    here = Path(__file__).parent
    assert all('"--json"' in (here / file).read_text(encoding="utf-8") for file in ELSEWHERE.values())


@pytest.mark.slow
@pytest.mark.parametrize(("command", "arguments"), GOOD_CASES.items(), ids=GOOD_CASES)
def test_one_document(command: str, arguments: tuple[str, ...]) -> None:
    result = run(command, *arguments, "--json")
    assert result.exit_code == 0, result.output
    assert json.loads(result.stdout)
    assert "NaN" not in result.stdout and "Infinity" not in result.stdout
    assert run(command, *arguments).stdout != result.stdout


@pytest.mark.parametrize(("command", "arguments"), BAD_CASES.items(), ids=BAD_CASES)
def test_one_document_where_a_check_fails(command: str, arguments: tuple[str, ...]) -> None:
    result = run(*command.split(), *arguments, "--json")
    assert result.exit_code == 1, result.output
    assert isinstance(json.loads(result.stdout), dict)


def test_the_reasons_are_in_it() -> None:
    result = run("rest", "falling.toml", "--json")
    assert [f"error: {line}" for line in json.loads(result.stdout)["error"]] == result.stderr.splitlines()


def test_nothing_where_the_input_is_bad() -> None:
    result = run("check", "none.toml", "--json")
    assert (result.exit_code, result.stdout) == (2, "")


def test_the_same_bytes_each_time() -> None:
    assert run("check", BENCH8, "--json").stdout == run("check", BENCH8, "--json").stdout
