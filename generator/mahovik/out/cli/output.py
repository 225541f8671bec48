"""What commands print and write: tables, `--json`, files, the end of a search.

`--json` prints one document on standard output and nothing else there, also if a check fails. Its keys are the names
and units of the rest of the project: SI, and the same order for the same input.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import UsageError

if TYPE_CHECKING:
    from rich.console import Console

Cell = str | tuple[str, str]
"""Text of a cell of a table, or the text with its style."""

INTERRUPTED = 130
"""Exit status after Ctrl-C: 128 plus the number of the signal, as in shells."""

CLOSED = 141
"""Exit status where the reader of standard output has closed it, as `head` does: as in shells after SIGPIPE."""

_ASKED, _PRINTED = "mahovik.json", "mahovik.json.printed"


def console(piped: int = 4000) -> Console:
    """Console as wide as the terminal; in pipes no line is cut or folded before `piped` columns.

    Colours on a terminal, unless NO_COLOR is set or TERM is dumb; elsewhere only if FORCE_COLOR is set.
    """
    from rich.console import Console

    class Piped(Console):
        def on_broken_pipe(self) -> None:  # Rich would end with status 1, that of a failed check
            raise BrokenPipeError

    return Piped(highlight=False, width=None if sys.stdout.isatty() else piped)


def print_line(words: str, style: str = "") -> None:
    """Print a line that narrow terminals fold."""
    from rich.text import Text

    console().print(Text(words, style))


def print_table(
    columns: Sequence[str],
    rows: Iterable[Sequence[Cell]],
    *,
    title: str | None = None,
    total: Sequence[Cell] = (),
    piped: int = 4000,
) -> None:
    """Print a table; a column whose name ends in ">" is right-aligned. Narrow terminals fold, never cut.

    `total`: a last row, under a line.
    """
    from rich.box import SIMPLE_HEAD
    from rich.table import Table
    from rich.text import Text

    found = Table(title=title, title_justify="left", title_style="bold", box=SIMPLE_HEAD, pad_edge=False, safe_box=True)
    for name in columns:
        right: Any = "right" if name.endswith(">") else "left"
        found.add_column(name.removesuffix(">"), justify=right, overflow="fold")
    for row in rows:
        found.add_row(*(Text(*cell) if isinstance(cell, tuple) else Text(cell) for cell in row))
    if total:
        found.add_section()
        found.add_row(*map(str, total))
    console(piped).print(found)


def print_paths(paths: Iterable[Path | str], notes: Iterable[str] = (), err: bool = False) -> None:
    """Print the paths of written files, then notes, a line each."""
    for path in paths:
        click.echo(click.format_filename(path), err=err)
    for note in notes:
        click.echo(note, err=err)


def require_suffix(output: str, suffixes: Sequence[str]) -> str:
    """Return the format of an output file, one of `suffixes`: how its name ends, the first for a device or a FIFO.

    Raises UsageError.
    """
    from mahovik.writing import format_of

    found = format_of(Path(output), suffixes)
    if found is None:
        raise UsageError(f"-o {output}: expected a name that ends in {' or '.join(suffixes)}")
    return found


def require_other_file(path: Path, read: Iterable[str], where: str, what: str) -> None:
    """Raise UsageError if an output file is one that the command reads, and probe that it can be written."""
    from mahovik.writing import probe

    if path.exists() and any(path.samefile(name) for name in read):
        raise UsageError(f"{where}: {path} is read by this command; give another name for the {what}")
    probe(path)


def require_page(path: str, read: Iterable[str]) -> None:
    """Raise UsageError for a page of charts that could not be written, before the work."""
    from mahovik.out.report.plot.draw import require

    require_suffix(path, [".html"])
    require_other_file(Path(path), read, f"--report {path}", "page")
    require("report")


def new_file(output: str | None, name: str) -> Path:
    """Path of a new stand file: the given one, or NAME.toml in the given folder.

    Raises UsageError for a file that exists; a device or a FIFO is written through.
    """
    from mahovik.writing import is_written_through

    path = Path(output) if output is not None else Path(f"{name}.toml")
    if path.is_dir() or (output is not None and output.endswith("/")):
        path = path / f"{name}.toml"
    if path.exists() and not is_written_through(path):
        raise UsageError(f"{path}: exists already, nothing was written")
    return path


def end_of_search(found: Any, good: Iterable[str], kept: bool, more: str = "another run may find more") -> None:
    """Print what cut a search short, and exit by its `status`: 0 for the good ones; `kept`: it has found something.

    more   what more time may bring, in words
    """
    if found.effort and found.effort.get("cut_by_time"):
        click.echo(f"warning: --time cut the search: {more}", err=True)
    if found.interrupted:
        best = "this is the best so far" if kept else "nothing was found yet, nothing is written"
        click.echo(f"interrupted: {best}", err=True)
        raise SystemExit(INTERRUPTED)
    if found.status not in good:
        raise SystemExit(1)


def print_json(values: Any) -> None:
    """Print the document of the running command: plain data and NumPy's; null for what is not finite."""
    print_json_text(json.dumps(_plain(values), indent=1, allow_nan=False))


def print_json_text(text: str) -> None:
    """Print a text that is already JSON."""
    click.echo(text.rstrip("\n"))
    click.get_current_context().meta[_PRINTED] = True


def print_failure(ctx: click.Context, lines: list[str]) -> None:
    """Print the reasons as JSON if --json was given and nothing was printed, so that a program gets one document."""
    if ctx.meta.get(_ASKED) and not ctx.meta.get(_PRINTED):
        click.echo(json.dumps({"error": lines}, indent=1))


def note_json(ctx: click.Context, _option: click.Parameter, value: bool) -> bool:
    """Callback of `--json`: keep whether it was given for `print_failure`."""
    ctx.meta[_ASKED] = value
    return value


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return _plain(value.tolist()) if hasattr(value, "tolist") else value
