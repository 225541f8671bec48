"""`mahovik cost`: instructions, stack, code and constants on processors."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.cli.arguments import load_stand, stand_argument
from mahovik.errors import CheckError, UsageError

if TYPE_CHECKING:
    from mahovik.stand.model import Stand
    from mahovik.study.cost.measure import Costs
    from mahovik.toolchain.targets import Target


@click.command()
@stand_argument
@click.option(
    "--real", type=click.Choice(["double", "float"]), help="Element type; default: the widest of each processor's FPU."
)
@click.option("--targets", metavar="NAME,...", help="Processors; default m4, m7, rv32imafc, rv64gc.")
@click.option(
    "-o", "output", metavar="DIR", type=click.Path(), help="Folder of the files; default ./NAME of the stand."
)
@click.option("--check", is_flag=True, help="Write nothing.")
@click.option("--accept", is_flag=True, help="Accept the figures: what later ones are compared with.")
def cost(stand_file: str, real: str | None, targets: str | None, output: str | None, check: bool, accept: bool) -> None:
    """Measure the C of a stand on processors.

    Instructions of every public function (by an emulator that counts; not cycles), stack, code and constants, into
    COST.md beside the C; accepted figures into cost.json. Exit status 1 where a figure is more than 2 % above the
    accepted one, by the same version of the compiler.
    """
    if check and accept:
        raise UsageError("--check, --accept: one of them")
    from mahovik.study.cost.check import compare
    from mahovik.study.cost.measure import asked
    from mahovik.study.cost.page import DATA, PAGE, accepted, as_json, page
    from mahovik.verify.delivery import add_to_delivery
    from mahovik.verify.files import write

    pairs = asked(targets, real)
    stand = load_stand(stand_file)
    folder = Path(output if output is not None else stand.name)
    data = folder / DATA
    if check and not data.is_file():
        raise UsageError(f"{data}: no such file: accept figures first, `mahovik cost` without --check")
    before = accepted(data.read_text(encoding="utf-8"), str(data)) if data.is_file() and not accept else None
    found = _measured(stand, pairs)
    if not check:
        for path in add_to_delivery(folder, PAGE, page(found)):
            click.echo(click.format_filename(path))
    if before is None:
        write(data, as_json(found))
        click.echo(click.format_filename(data))
        return
    result = compare(found, before)
    for line in (*(f"rise: {line}" for line in result.rises), *(f"not compared: {line}" for line in result.other)):
        click.echo(line)
    if result.rises:
        raise CheckError(f"{stand.name}: the cost has risen; `mahovik cost --accept` accepts it")
    click.echo(f"{stand.name}: no rise on {'; '.join(result.compared) or 'any target'}")


def _measured(stand: Stand, pairs: Sequence[tuple[Target, str]]) -> Costs:
    from rich.console import Console
    from rich.progress import Progress

    from mahovik.study.cost.measure import measure

    err = Console(stderr=True)
    with Progress(console=err, transient=True, disable=not err.is_terminal) as bar:
        task = bar.add_task(f"cost of {stand.name}", total=len(pairs))
        return measure(stand, pairs, lambda done, _: bar.update(task, completed=done))
