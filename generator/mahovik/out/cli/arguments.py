"""Arguments and options shared by several commands, and the console for tables."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from mahovik.core.stand.model import Stand
    from mahovik.proof.verify.delivery import Delivered

stand_argument = click.argument("stand_file", metavar="STAND.toml", type=click.Path())
real_option = click.option(
    "--real", type=click.Choice(["double", "float"]), default="double", show_default=True, help="Element type of the C."
)
lanes_option = click.option(
    "--lanes",
    type=click.Choice(["1", "2", "4", "8"]),
    callback=lambda _context, _option, value: value and int(value),
    help="Flywheels per vector; default 1, with --fast chosen by their number.",
)
fast_option = click.option("--fast", is_flag=True, help="For a desktop processor: bits are not reproducible.")


def load_stand(stand_file: str) -> Stand:
    """The stand of a file. Raises StandError."""
    from mahovik.core.stand import load

    return load(stand_file)


def given(option: str) -> bool:
    """Whether the user gave an option of the running command, by its name in Python."""
    source = click.get_current_context().get_parameter_source(option)
    return source not in (None, click.core.ParameterSource.DEFAULT)


def console(piped: int = 4000) -> Console:
    """Console as wide as the terminal; in pipes no line is cut or folded before `piped` columns.

    Colours on a terminal, unless NO_COLOR is set or TERM is dumb; elsewhere only if FORCE_COLOR is set.
    """
    from rich.console import Console

    return Console(highlight=False, width=None if sys.stdout.isatty() else piped)


def table(*columns: str, title: str | None = None) -> Table:
    """A plain table; a column whose name ends in ">" is right-aligned. Narrow terminals fold, never cut."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    found = Table(title=title, title_justify="left", title_style="bold", box=SIMPLE_HEAD, pad_edge=False, safe_box=True)
    for name in columns:
        right: Any = "right" if name.endswith(">") else "left"
        found.add_column(name.removesuffix(">"), justify=right, overflow="fold")
    return found


def echo_delivery(done: Delivered) -> None:
    """Print the paths of a delivered folder and its notes, a line each."""
    for path in done.paths:
        click.echo(click.format_filename(path))
    for note in done.notes:
        click.echo(note)
