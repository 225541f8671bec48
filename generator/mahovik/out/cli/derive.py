"""`mahovik derive`: the matrices of (8)-(11) of a stand, as a document."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.out.cli.options import STAND_FILE, command, file_option, load_stand
from mahovik.out.cli.output import print_paths, require_suffix
from mahovik.out.progress import progress


@command()
def derive(
    stand_file: str = STAND_FILE,
    output: str | None = file_option("-o", "FILE.html|FILE.tex", "Write this file; default: LaTeX to standard output."),
) -> None:
    """Show the derivation, LaTeX or HTML.

    The matrices of (8)-(11): one generic flywheel with symbols, then the numbers of the stand.
    """
    suffix = ".tex" if output is None else require_suffix(output, (".html", ".tex"))
    stand = load_stand(stand_file)
    from mahovik.out.report.derivation.page import html, latex
    from mahovik.writing import probe, write

    if output is not None:
        probe(Path(output))

    with progress(f"derive {stand.name}"):
        text = html(stand) if suffix == ".html" else latex(stand)
    if output is None:
        click.echo(text, nl=False)
        return
    write(Path(output), text)
    print_paths([output])
