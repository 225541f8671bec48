"""One order of arguments: the stand first, then options."""

from __future__ import annotations

import click

from cli.test_json import commands

NO_STAND = {"new", "campaign"}
"""Commands without a stand file."""


def test_the_stand_is_the_first_argument_and_the_only_one() -> None:
    for name, command in commands():
        shown = [piece for p in command.params if isinstance(p, click.Argument) for piece in usage(command, p)]
        expected = [] if name in NO_STAND else ["STAND.toml"]
        assert [piece.strip("[]") for piece in shown if "STAND" in piece] == expected, name
        assert len(shown) <= 1 + (name == "verify"), name


def usage(command: click.Command, argument: click.Argument) -> list[str]:
    return argument.get_usage_pieces(click.Context(command))
