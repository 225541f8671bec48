"""`mahovik export`: projects of other tools around the emitted C."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.cli.arguments import load_stand, real_option, stand_argument
from mahovik.cli.group import Commands


@click.group(cls=Commands)
def export() -> None:
    """Projects around the C of a stand, for other tools and boards."""


@export.command()
@click.argument("name", metavar="TARGET")
@stand_argument
@click.option("-o", "output", metavar="DIR", type=click.Path(), help="Folder; default ./NAME-TARGET of the stand.")
@click.option(
    "--real", type=click.Choice(["double", "float"]), help="Element type; default: the widest of the target's FPU."
)
def target(name: str, stand_file: str, output: str | None, real: str | None) -> None:
    """Write a project that runs the self-test on a board.

    C of the stand, self-test, startup, linker script, console, Makefile, README: `make run` there runs it on the
    emulator; the README says what to change for another board. Never over a file that mahovik has not written, nor into
    a folder of `mahovik generate`.
    """
    from mahovik.export.target import exportable, project
    from mahovik.verify.delivery import deliver

    found = exportable(name)
    stand = load_stand(stand_file)
    chosen = real or found.real or "double"
    folder = Path(output if output is not None else f"{stand.name}-{name}")
    done = deliver(folder, stand, chosen, project(stand, found, chosen), found.name)
    for path in done.paths:
        click.echo(click.format_filename(path))
    for note in done.notes:
        click.echo(note)


@export.command()
@stand_argument
@click.option("-o", "output", metavar="DIR", type=click.Path(), help="Folder; default ./NAME-fuzz of the stand.")
@real_option
def fuzz(stand_file: str, output: str | None, real: str) -> None:
    """Write a project that fuzzes every public function.

    The C of the stand, a harness for libFuzzer, Makefile, README: `make run` there needs clang.
    """
    from mahovik.export.fuzz import fuzz_project
    from mahovik.verify.delivery import deliver

    stand = load_stand(stand_file)
    done = deliver(Path(output or f"{stand.name}-fuzz"), stand, real, fuzz_project(stand, real), "fuzz")
    for path in done.paths:
        click.echo(click.format_filename(path))
    for note in done.notes:
        click.echo(note)
