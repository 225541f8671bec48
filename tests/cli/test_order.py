"""One order of arguments: the stand first, then options; another order works too and says how to write it."""

from __future__ import annotations

import shlex
from pathlib import Path

import click
import pytest

from cli.run import DEMO3, run
from cli.test_json import commands
from mahovik import stands

SHAKER2 = str(stands.path("shaker2"))
SPIN = str(Path(SHAKER2).parent / "shaker2_spin.motion.json")

FORMER = {
    "judge-log": (("log.txt", DEMO3), (DEMO3, "--log", "log.txt")),
    "judge-log, stand first": ((DEMO3, "log.txt"), (DEMO3, "--log", "log.txt")),
    "judge-log, log only": (("log.txt",), ("--log", "log.txt")),
    "replay": (("log.txt", DEMO3), (DEMO3, "--log", "log.txt")),
    "replay, log only": (("log.txt",), ("--log", "log.txt")),
    "verify-programme": ((SHAKER2, SPIN, "p.json"), (SHAKER2, "--motion", SPIN, "--programme", "p.json")),
}
"""Command: arguments in another order, and in the order of all commands."""


@pytest.mark.parametrize("case", FORMER)
def test_another_order_works_and_is_noted(case: str) -> None:
    Path("log.txt").write_text("")
    command = case.partition(",")[0].split()
    other, ours = FORMER[case]
    expected, found = run(*command, *ours), run(*command, *other)
    note, _, rest = found.stderr.partition("\n")
    assert (found.exit_code, found.stdout, rest) == (expected.exit_code, expected.stdout, expected.stderr)
    assert expected.stderr.startswith("error: ") and "note:" not in expected.stderr
    told = shlex.split(note.removeprefix("note: arguments have a new order, from now on write: "))
    words = list(ours)
    assert told == ["mahovik", *command, *words, "..."]


NO_STAND = {"new", "campaign", "import urdf", "import mjcf"}
"""Commands without a stand file."""


def test_the_stand_is_the_first_argument_and_the_only_one() -> None:
    for name, command in commands():
        shown = [piece for p in command.params if isinstance(p, click.Argument) for piece in usage(command, p)]
        expected = [] if name in NO_STAND else ["STAND.toml"]
        assert [piece.strip("[]") for piece in shown if "STAND" in piece] == expected, name
        assert len(shown) <= 1, name


def usage(command: click.Command, argument: click.Argument) -> list[str]:
    return argument.get_usage_pieces(click.Context(command))
