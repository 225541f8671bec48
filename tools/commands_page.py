"""Writes docs/commands.md: the --help text of every command, section by section."""

from __future__ import annotations

from collections.abc import Iterator

import campaign
import click

from mahovik.out.cli import SECTIONS, main

PAGE = campaign.ROOT / "docs" / "commands.md"

HEAD = """# Commands

Look up what every command and option does: what `mahovik COMMAND --help` prints. `mahovik completion bash|zsh|fish`
makes a shell complete names. `mahovik doctor` says which compilers, emulators and extras are installed, and how to
install the others.

```sh
mahovik new bench8
mahovik check bench8.toml
mahovik check bench8.toml --json
mahovik new --list --json
```

| exit status | meaning |
|---|---|
| 0 | success |
| 1 | a check failed, or some states were refused |
| 2 | bad input or usage; nothing was computed |
| 130 | Ctrl-C |
| 141 | whoever reads standard output has closed it, as `head` does |

**Messages** are on standard error, one line for each problem: where, what was found, what was expected. A misspelt
name of a command, option, key, unit, body, point or target gives a suggestion, or the list of all known names.

**JSON.** Every command that prints a table has `--json`: one document on standard output, in SI, with the names of
files and C, the same bytes for the same input. A failed check still prints its table, or `{"error": [...]}`;
with status 2 there is no output. Commands without a table print the files that they wrote.

**Progress** is a line on standard error for work of more than a second, only on a terminal (not where `TERM` is
`dumb`). **Colours** are used on terminals only; `NO_COLOR=1` switches them off, `FORCE_COLOR=1` on. Tables fold in
narrow terminals and never in a pipe.

**Files** are written whole or not at all, also after Ctrl-C; searches and runs keep their results so far and say
so. Folders given with `-o` are created. `new`, `generate` and `export` never overwrite a file that mahovik did not
write. `-o` also takes a device or a FIFO, such as `/dev/null`: it gets the format that its name ends in, else the first
one that the help lists.

How long a start takes is [measured](results/generation.md). The rest of this page is written by `make
commands-page`.

"""

WIDTH = 100
"""Columns of the help."""


def text() -> str:
    """The page."""
    settings = main.context_settings  # a bare context does not have them
    root = click.Context(main, info_name="mahovik", max_content_width=WIDTH, terminal_width=WIDTH, **settings)
    parts = [HEAD]
    for title, commands in SECTIONS.items():
        parts.append(f"## {title}\n\n")
        for command in commands:
            parts += _help_sections(command, root)
    return "".join(parts).rstrip("\n") + "\n"


def _help_sections(command: click.Command, parent: click.Context) -> Iterator[str]:
    """A command, then the commands that it groups."""
    context = click.Context(command, parent, command.name, max_content_width=WIDTH, terminal_width=WIDTH)
    yield f"### {context.command_path}\n\n```text\n{command.get_help(context)}\n```\n\n"
    if isinstance(command, click.Group):
        for name in command.list_commands(context):
            yield from _help_sections(command.commands[name], context)


if __name__ == "__main__":
    PAGE.write_text(text(), encoding="utf-8")
