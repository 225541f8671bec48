"""`mahovik generate`: the C of a stand."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.cli.arguments import load_stand, real_option, stand_argument


@click.command()
@stand_argument
@click.option(
    "-o", "output", metavar="DIR", type=click.Path(), help="Folder to write into; default ./NAME of the stand."
)
@real_option
def generate(stand_file: str, output: str | None, real: str) -> None:
    """Write the C of a stand.

    A header and a source, all or nothing. Needs no compiler.
    """
    stand = load_stand(stand_file)
    from mahovik.emit.generate import generate as texts
    from mahovik.verify.files import write_all

    files = texts(stand, real)
    for path in write_all(Path(output if output is not None else stand.name), files):
        click.echo(f"{click.format_filename(path)}   {files[path.name].count(chr(10))} lines")
