"""Every command: `--json` is one document on standard output, also where a check fails; the stand comes first."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click
import pytest

import mahovik.proof.evidence as all_pieces
from cli.run import DEMO3, run
from mahovik.out.command_line import main
from mahovik.stands import path
from report.reports import BAD, GOOD

SAT4, SHAKER2 = str(path("sat4")), str(path("shaker2"))
SPIN = str(Path(SHAKER2).with_name("shaker2_spin.motion.json"))
BAND = ("30..40Hz", "--momentum", "1 0 0")

WITHOUT = {
    "eval",
}
"""Commands without a table: they print lines of JSON, a script, or the files that they wrote."""

ELSEWHERE = {"campaign", "identify", "replay", "report"}
"""Commands whose cases need much that their own test has."""

CASES: dict[str, tuple[int, tuple[str, ...]]] = {
    "new": (0, ("--list",)),
    "check": (0, (DEMO3,)),
    "generate": (0, (DEMO3,)),
    "check, tools": (0, ("--tools",)),
    "modes": (0, (SHAKER2,)),
    "modes, falling": (1, ("falling.toml",)),
    "vibration": (0, (SAT4, "--speed", "rw1=1000 rpm", "--at", "acc1", "--quantity", "acceleration")),
    "vibration, falling": (1, ("falling.toml", "--speed", "w1=10", "--at", "carrier")),
    "vibration, slow": (1, (SAT4, "--speed", "0", "--at", "acc1", "--band", *BAND, "--improve", "--limit", "1 rpm")),
    "balance": (0, ("--influence", "rotor.json")),
    "simulate": (0, (DEMO3, "--until", "0.001", "--backend", "scipy", "-o", "run.csv")),
    "plan, far": (1, (DEMO3, "--motion", "far.json", "-o", "p.json")),
    "plan, free": (0, (SHAKER2, "--motion", SPIN, "--free", "*t.mass", "--stand", "new.toml")),
    "judge, cat": (1, (DEMO3, "--with", "cat", "--states", "2")),
    "verify": (0, (DEMO3, "--states", "2")),
    "verify, all": (0, (DEMO3, "--states", "2", "--all")),
    "verify, other": (1, (SHAKER2, "still.json", "--motion", SPIN)),
    "evidence": (0, (DEMO3, "--only", "good")),
    "evidence, bad": (1, (DEMO3,)),
    "evidence, broken": (1, ("--check", "broken")),
}
"""Command, and what is special: its exit status and arguments."""


def commands(group: click.Group = main, name: str = "") -> Iterator[tuple[str, click.Command]]:
    """All commands, with the names of their groups before theirs."""
    context = click.Context(group)
    for child in group.list_commands(context):
        command = group.get_command(context, child)
        assert command is not None
        if isinstance(command, click.Group):
            yield from commands(command, f"{name}{child} ")
        else:
            yield f"{name}{child}", command


@pytest.fixture(autouse=True)
def files(work_folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Files that the cases read."""
    monkeypatch.setattr(all_pieces, "PIECES", (GOOD, BAD))
    monkeypatch.delenv("CI", raising=False)
    Path("broken").mkdir()
    Path("broken/SHA256SUMS").write_text(f"{'0' * 64}  c/demo3.c\n", encoding="utf-8")
    Path("rotor.json").write_text('{"A": ["2@30"], "ALPHA": [["1@0"]]}', encoding="utf-8")
    body = "mass = 1\ninertia = [1, 1, 1]\n"
    stand = f'schema = 1\nname = "falling"\ngravity = [0, 0, -9.81]\n[carrier]\n{body}[[flywheel]]\nname = "w1"\n{body}'
    Path("falling.toml").write_text(stand, encoding="utf-8")
    motion = json.loads(Path(DEMO3).with_name("demo3.motion.json").read_text(encoding="utf-8"))
    far = motion | {"harmonics": [{"k": 1, "cos": [0.0, 0.0, 0.1, 1.0, 0.0, 0.0]}], "winding": "any"}
    Path("far.json").write_text(json.dumps(far), encoding="utf-8")
    still: dict[str, Any] = {"schema": 1, "motion": "other", "flywheels": ["w1", "w2"], "period": 1.0}
    still |= {"stand": {"name": "shaker2", "structure": "0" * 8, "physics": "0" * 8}}
    still |= {"bias": [0.0] * 6, "winding": [0, 0]}
    still |= {"fourier": {"mean": [0.0, 0.0], "cos": [[0.0, 0.0]], "sin": [[0.0, 0.0]]}}
    Path("still.json").write_text(json.dumps(still), encoding="utf-8")


def test_every_command_has_it_or_prints_no_table() -> None:
    has = {name for name, command in commands() if any("--json" in option.opts for option in command.params)}
    assert {name for name, _ in commands()} - has <= WITHOUT and not has & WITHOUT
    assert has == {case.partition(",")[0] for case in CASES} | ELSEWHERE


def numbers(value: Any) -> Iterator[float]:
    """All numbers of a document."""
    if isinstance(value, dict | list):
        for part in value.values() if isinstance(value, dict) else value:
            yield from numbers(part)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield float(value)


@pytest.mark.parametrize("case", CASES)
def test_one_document_and_a_table_where_rows_are_printed(case: str) -> None:
    status, arguments = CASES[case]
    command = case.partition(",")[0]
    saves = "save" in {one.name for one in dict(commands())[command].params} and "-o" not in arguments
    saved = ("-o", "saved.csv") if saves else ()
    result = run(command, *arguments, *saved, "--json")
    assert result.exit_code == status, result.output
    assert json.loads(result.stdout)
    assert "NaN" not in result.stdout and "Infinity" not in result.stdout
    if saved and not status:
        assert len(Path("saved.csv").read_text(encoding="utf-8").splitlines()) > 1


@pytest.mark.parametrize(
    ("command", "number"),
    [("modes", r"(?m)^ [a-z]+ +(\d\S+)"), ("vibration", r"(?<![\w.-])\d+\.\d{4,}(?:e-\d+)?(?!\w)")],
)
def test_the_numbers_of_the_table_are_in_the_document(command: str, number: str) -> None:
    _, arguments = CASES[command]
    known = [abs(x) for x in numbers(json.loads(run(command, *arguments, "--json").stdout))]
    printed = [float(x) for x in re.findall(number, run(command, *arguments).stdout)]
    assert len(printed) >= 3 and all(any(x == pytest.approx(y, rel=1e-3) for y in known) for x in printed)


def test_the_reasons_are_in_it_and_nothing_where_the_input_is_bad() -> None:
    result = run("modes", "falling.toml", "--json")
    assert [f"error: {line}" for line in json.loads(result.stdout)["error"]] == result.stderr.splitlines()
    result = run("check", "none.toml", "--json")
    assert (result.exit_code, result.stdout) == (2, "")


NO_STAND = {"new", "campaign"}
"""Commands without a stand file."""


def test_the_stand_is_the_first_argument_and_the_only_one() -> None:
    for name, command in commands():
        context = click.Context(command)
        arguments = [p for p in command.params if isinstance(p, click.Argument)]
        shown = [piece for argument in arguments for piece in argument.get_usage_pieces(context)]
        expected = [] if name in NO_STAND else ["STAND.toml"]
        assert [piece.strip("[]") for piece in shown if "STAND" in piece] == expected, name
        assert len(shown) <= 1 + (name == "verify"), name
