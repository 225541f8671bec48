"""Writes docs/commands.md: what every command says of itself with --help, section by section."""

from __future__ import annotations

from collections.abc import Iterator

import campaign
import click

from mahovik.out.cli import SECTIONS, main

PAGE = campaign.ROOT / "docs" / "commands.md"

HEAD = """# Commands

Written by `make commands-page` from the commands themselves: what `mahovik COMMAND --help` prints. Exit status of
all: 0 good; 1 a check failed, or some states; 2 bad input or usage; 130 Ctrl-C. Messages go to standard error, one line
each: where, what was found, what was expected. Files are written whole or not at all.

"""

WIDTH = 100
"""Columns of the help."""


def text() -> str:
    """The page."""
    root = click.Context(main, info_name="mahovik", max_content_width=WIDTH, terminal_width=WIDTH)
    parts = [HEAD]
    for title, commands in SECTIONS.items():
        parts.append(f"## {title}\n\n")
        for command in commands:
            parts += _shown(command, root)
    return "".join(parts).rstrip("\n") + "\n"


def _shown(command: click.Command, parent: click.Context) -> Iterator[str]:
    """A command, then the commands that it groups."""
    context = click.Context(command, parent, command.name, max_content_width=WIDTH, terminal_width=WIDTH)
    yield f"### {context.command_path}\n\n```text\n{command.get_help(context)}\n```\n\n"
    if isinstance(command, click.Group):
        for name in command.list_commands(context):
            yield from _shown(command.commands[name], context)


if __name__ == "__main__":
    PAGE.write_text(text(), encoding="utf-8")
