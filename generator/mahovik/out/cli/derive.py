"""`mahovik derive`: the matrices of (8)-(11) of a stand, as a document."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.errors import UsageError
from mahovik.out.cli.arguments import load_stand, stand_argument
from mahovik.out.cli.progress import progress


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
    from mahovik.out.report.derivation.page import html, latex
    from mahovik.proof.verify.files import probe, write

    if output is not None:
        probe(Path(output))

    with progress(f"derive {stand.name}"):
        text = html(stand) if output is not None and output.endswith(".html") else latex(stand)
    if output is None:
        click.echo(text, nl=False)
        return
    write(Path(output), text)
    click.echo(click.format_filename(output))
