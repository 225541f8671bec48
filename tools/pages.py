"""Write what pages show of the code: docs/commands.md, tables between marks on the other pages, pictures.

python tools/pages.py [--pictures]

`--pictures`: also run the commands of some pages, and keep the pictures that they draw.
"""

from __future__ import annotations

import re
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import click
from python_reference import python_lines
from reference_tables import MADE as TABLES

from mahovik.out.command_line import main
from mahovik.out.commands import COMMANDS as SECTIONS

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
COMMANDS = DOCS / "commands.md"

DRAWN = ("README.md", "docs/tutorial-pendulum.md", "docs/howto/held-carriers.md", "docs/studies.md")
"""Pages whose own commands draw their pictures."""

HEAD = """# Commands

Look up what every command and option does: what `mahovik COMMAND --help` prints. `mahovik check --tools`
says which compilers, emulators and extras are installed, and how to install the others. For completion in bash, put
`eval "$(_MAHOVIK_COMPLETE=bash_source mahovik)"` into ~/.bashrc; zsh and fish have `zsh_source` and `fish_source`.

```sh
mahovik new bench8
mahovik check bench8.toml
mahovik check bench8.toml --json
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
so. Folders given with `-o` are created. `new` and `generate` never overwrite a file that mahovik did not write. `-o`
also takes a device or a FIFO, such as `/dev/null`: it gets the format that its name ends in, else the first
one that the help lists.

How long a start takes is [measured](results.md#generation).

"""

WIDTH = 100
"""Columns of the help."""

MADE = {**TABLES, "python": python_lines}
"""What stands between marks on pages, by the name of the mark."""


def commands_page() -> str:
    """The page of commands: the --help text of each, section by section."""
    root = click.Context(
        main, info_name="mahovik", max_content_width=WIDTH, terminal_width=WIDTH, **main.context_settings
    )
    parts = [HEAD]
    for title, commands in SECTIONS.items():
        parts.append(f"## {title}\n\n")
        for name in commands:
            parts += help_texts(main, name, root)
    return "".join(parts).rstrip("\n") + "\n"


def help_texts(group: click.Group, name: str, parent: click.Context) -> Iterator[str]:
    """A command of a group, then the commands that it groups."""
    command = group.get_command(parent, name)
    assert command is not None
    context = click.Context(command, parent, command.name, max_content_width=WIDTH, terminal_width=WIDTH)
    yield f"### {context.command_path}\n\n```text\n{command.get_help(context)}\n```\n\n"
    if isinstance(command, click.Group):
        for inner in command.list_commands(context):
            yield from help_texts(command, inner, context)


def filled(page: Path) -> str:
    """The text of a page with what is made of the code between its marks. Raises ValueError for an unknown mark."""

    def replacement(mark: re.Match[str]) -> str:
        if mark[1] not in MADE:
            raise ValueError(f"{page}: unknown mark {mark[1]!r}, expected one of {', '.join(MADE)}")
        lines = "\n".join(MADE[mark[1]]())
        return f"<!-- {mark[1]}: tools/pages.py -->\n\n{lines}\n\n<!-- end of {mark[1]} -->"

    before = page.read_text(encoding="utf-8")
    text, count = re.subn(r"(?s)<!-- ([\w ]+): tools/pages\.py -->.*?<!-- end of \1 -->", replacement, before)
    if count != before.count(": tools/pages.py -->"):
        raise ValueError(f"{page}: a mark has no end")
    return text


def marked_pages() -> list[Path]:
    """Pages with marks."""
    return [page for page in sorted(DOCS.glob("*.md")) if ": tools/pages.py -->" in page.read_text(encoding="utf-8")]


def draw(page: Path) -> None:
    """Run the commands of a page, and keep the pictures that it shows. Raises AssertionError where a command fails."""
    sys.path.append(str(ROOT / "tests"))
    from docs.pages import Session, steps

    with tempfile.TemporaryDirectory() as scratch:
        session = Session(page, Path(scratch))
        for step in steps(page):
            session.run(step)
        for shown in re.findall(r"!\[[^\]]*\]\(([\w/.-]+\.svg)\)", page.read_text(encoding="utf-8")):
            picture = Path(scratch) / Path(shown).name
            if picture.is_file():
                (page.parent / shown).write_text(picture.read_text(encoding="utf-8"), encoding="utf-8")


if __name__ == "__main__":
    COMMANDS.write_text(commands_page(), encoding="utf-8")
    for marked in marked_pages():
        marked.write_text(filled(marked), encoding="utf-8")
    if "--pictures" in sys.argv[1:]:
        for name in DRAWN:
            draw(ROOT / name)
