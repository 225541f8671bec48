"""What commands print and write: tables, `--json`, files, the end of a search.

`--json` prints one document on standard output and nothing else there, also if a check fails. Its keys are the names
and units of the rest of the project: SI, and the same order for the same input.
"""

from __future__ import annotations

import json
import math
import os
import shutil
import sys
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from itertools import zip_longest
from pathlib import Path
from typing import Any

import click

from mahovik.errors import UsageError

Cell = str | tuple[str, str]
"""Text of a cell of a table, or the text with its style."""

INTERRUPTED = 130
"""Exit status after Ctrl-C: 128 plus the number of the signal, as in shells."""

CLOSED = 141
"""Exit status where the reader of standard output has closed it, as `head` does: as in shells after SIGPIPE."""

_ASKED, _PRINTED = "mahovik.json", "mahovik.json.printed"


def print_line(words: str, style: str = "", name: str = "") -> None:
    """Print a line that narrow terminals fold, after a `name` in bold; `style`: "bold", a colour, or "bold red"."""
    first, *more = _folded(name + words, _width(None))
    _print([_styled(name, "bold") + _styled(first[len(name) :], style), *(_styled(line, style) for line in more)])


def print_table(
    columns: Sequence[str],
    rows: Iterable[Sequence[Cell]],
    *,
    title: str | None = None,
    total: Sequence[str] = (),
    piped: int | None = None,
) -> None:
    """Print a table; a column whose name ends in ">" is right-aligned. Narrow terminals fold, never cut.

    `total`: a last row, under a line; `piped`: width at which a table is folded that goes into a pipe.
    """
    table = [[(name.removesuffix(">"), "bold") for name in columns]]
    table += [
        [(cell, "") if isinstance(cell, str) else cell for cell in row] for row in (*rows, *filter(None, [total]))
    ]
    texts_of = [[text for text, _ in column] for column in zip(*table, strict=True)]
    widths = [max(len(line) for text in texts for line in text.split("\n")) for texts in texts_of]
    words = [max((len(word) for text in texts for word in text.split()), default=1) for texts in texts_of]
    limit, between = _width(piped), 3 * len(widths) - 1
    while limit is not None and sum(widths) + between > limit and max(widths) > 1:
        # between words as long as any column can be folded there
        foldable = [i for i, width in enumerate(widths) if width > words[i]] or range(len(widths))
        widths[max(foldable, key=lambda i: widths[i])] -= 1
    width = sum(widths) + between
    empty, rule = " " * width, "─" if sys.stdout.encoding.lower().startswith("utf") else "-"
    lines = [_styled(line.ljust(width), "bold") for line in _folded(title, width)] if title else []
    for number, row in enumerate(table):
        if number == 0 or (total and 1 < number == len(table) - 1):
            lines.append(empty)
        folded = [_folded(text, size) for (text, _), size in zip(row, widths, strict=True)]
        for texts in zip_longest(*folded, fillvalue=""):
            parts = zip(texts, row, widths, columns, strict=True)
            cells = (
                _styled(x.rjust(n) if name.endswith(">") else x.ljust(n), style) for x, (_, style), n, name in parts
            )
            lines.append(f" {'   '.join(cells)} ")
        if number == 0:
            lines.append(f" {rule * (width - 2)} ")
    _print([*lines, empty])


def _width(piped: int | None) -> int | None:
    """Columns at which lines are folded: those of a terminal; None: they are not."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else piped


def _folded(text: str, width: int | None) -> list[str]:
    """Lines of at most this width."""
    lines = text.split("\n")
    if width is None or max(map(len, lines)) <= width:
        return lines
    return [part for line in lines for part in textwrap.wrap(line, width, break_on_hyphens=False) or [""]]


def _styled(text: str, style: str) -> str:
    colour = style.removeprefix("bold").strip()
    return click.style(text, fg=colour or None, bold=style.startswith("bold") or None) if style else text


def _print(lines: Iterable[str]) -> None:
    """Print lines; styles on a terminal unless NO_COLOR or TERM=dumb is set, elsewhere only if FORCE_COLOR is set."""
    plain = os.environ.get("NO_COLOR") or os.environ.get("TERM", "").lower() in ("dumb", "unknown")
    click.echo("\n".join(lines), color=False if plain else bool(os.environ.get("FORCE_COLOR")) or None)


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
    from mahovik.out.report.plots import require

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
