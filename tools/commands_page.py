"""Writes docs/commands.md: what every command says of itself with --help, section by section."""

from __future__ import annotations

from collections.abc import Iterator

import campaign
import click

from mahovik.out.cli import SECTIONS, main

PAGE = campaign.ROOT / "docs" / "commands.md"

HEAD = """# Commands

Look up what every command and option does: what `mahovik COMMAND --help` prints. `mahovik completion bash|zsh|fish`
makes a shell complete names. `mahovik doctor` says which compilers, emulators and extras there are, and how to
install the others.

```sh
mahovik new bench8
mahovik check bench8.toml
mahovik check bench8.toml --json
mahovik new --list --json
```

| exit status | meaning |
|---|---|
| 0 | good |
| 1 | a check failed, or some of the states |
| 2 | bad input or usage; nothing was computed |
| 130 | Ctrl-C |

**Messages** are on standard error, one line for each problem: where, what was found, what was expected. A misspelt
name of a command, option, key, unit, body, point or target is answered with the nearest known one, or with all.

**JSON.** Every command that prints a table has `--json`: one document on standard output, in SI, with the names of
files and C, the same bytes for the same input. A failed check prints its table all the same, or `{"error": [...]}`;
with status 2 there is no output. Commands without a table print the files that they wrote.

**Progress** is a line on standard error for work of more than a second, only on a terminal (not where `TERM` is
`dumb`). **Colours** are on terminals only; `NO_COLOR=1` switches them off, `FORCE_COLOR=1` on. Tables fold in
narrow terminals and never in a pipe.

**Files** are written whole or not at all, also after Ctrl-C; searches and runs keep what they have so far and say
so. Folders given with `-o` are made. `new`, `generate` and `export` never overwrite a file that mahovik did not
write.

How long a start takes is [measured](results/generation.md). The rest of this page is written by `make
commands-page`.

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
