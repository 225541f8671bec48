"""`mahovik verify`: the generated C, or any other program, against the literal reference."""

from __future__ import annotations

import click

from mahovik.cli.arguments import load_stand, stand_argument


@click.command()
@stand_argument
def verify(stand_file: str) -> None:
    """Judge C or any program by the reference."""
    load_stand(stand_file)
