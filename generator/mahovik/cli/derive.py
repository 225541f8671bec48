"""`mahovik derive`: the matrices of (8)-(11) of a stand, for a person to read."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

import click

from mahovik.cli.arguments import load_stand, stand_argument
from mahovik.errors import UsageError


@click.command()
@stand_argument
@click.option(
    "-o", "output", metavar="FILE.html|FILE.tex", type=click.Path(), help="Default: LaTeX to standard output."
)
def derive(stand_file: str, output: str | None) -> None:
    """Show the derivation, LaTeX or HTML.

    The matrices of (8)-(11): one generic flywheel with symbols, then the numbers of the stand.
    """
    if output is not None and not output.endswith((".html", ".tex")):
        raise UsageError(f"-o {output}: expected a name that ends in .html or .tex")
    stand = load_stand(stand_file)
    from mahovik.verify.files import write

    page = _page()
    text = page.html(stand) if output is not None and output.endswith(".html") else page.latex(stand)
    if output is None:
        click.echo(text)
        return
    write(Path(output), text)
    click.echo(click.format_filename(output))


def _page() -> Any:
    """The module that has `html(stand)` and `latex(stand)`."""
    try:
        return import_module("mahovik.derive.page")
    except ModuleNotFoundError:
        raise UsageError("derive: the page of the derivation is not there yet") from None
