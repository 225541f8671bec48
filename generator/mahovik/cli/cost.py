"""`mahovik cost`: instructions, stack, code and constants on processors."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.cli.arguments import load_stand, stand_argument
from mahovik.errors import UsageError

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
@click.option("--check", is_flag=True, help="Write nothing: compare with the files that lie there.")
def cost(stand_file: str, real: str | None, targets: str | None, output: str | None, check: bool) -> None:
    """Measure the C of a stand on processors.

    Instructions of every public function (by an emulator that counts; not cycles), stack, code, constants: COST.md and
    cost.json beside the C. With --check, exit status 1 where a figure is more than 2 % above the one that lies there,
    by the same compiler version; to accept it, write the files anew.
    """
    from mahovik.study.cost.measure import asked

    pairs = asked(targets, real)
    stand = load_stand(stand_file)
    folder = Path(output if output is not None else stand.name)
    if check:
        _check(_measured(stand, pairs), folder)
        return
    from mahovik.study.cost.page import DATA, PAGE, as_json, page
    from mahovik.verify.files import write_all

    found = _measured(stand, pairs)
    for path in write_all(folder, {PAGE: page(found), DATA: as_json(found)}):
        click.echo(click.format_filename(path))


def _measured(stand: Stand, pairs: Sequence[tuple[Target, str]]) -> Costs:
    from rich.console import Console
    from rich.progress import Progress

    from mahovik.study.cost.measure import measure

    err = Console(stderr=True)
    with Progress(console=err, transient=True, disable=not err.is_terminal) as bar:
        task = bar.add_task(f"cost of {stand.name}", total=len(pairs))
        return measure(stand, pairs, lambda done, _: bar.update(task, completed=done))


def _check(found: Costs, folder: Path) -> None:
    from mahovik.study.cost.check import compare
    from mahovik.study.cost.page import DATA, accepted

    path = folder / DATA
    if not path.is_file():
        raise UsageError(f"{path}: no such file: write it first, `mahovik cost` without --check")
    result = compare(found, accepted(path.read_text(encoding="utf-8"), str(path)))
    for line in result.rises:
        click.echo(f"rise: {line}")
    for line in result.other:
        click.echo(f"not compared: {line}")
    if result.rises:
        click.echo(f"FAILED: to accept, write {click.format_filename(folder)} anew: mahovik cost without --check")
        raise SystemExit(1)
    click.echo(f"{found.stand}: no rise on {', '.join(result.compared) or 'no target'}")
