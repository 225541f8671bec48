"""`mahovik cost`: instructions, stack, code and constants on processors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import CheckError, UsageError
from mahovik.out.cli.arguments import load_stand, stand_argument
from mahovik.out.cli.json_output import json_option, print_json_text
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.core.toolchain.targets import Target
    from mahovik.proof.cost.measure import Costs


@click.command(short_help="Measure the C of a stand on processors.")
@stand_argument
@click.option(
    "--real", type=click.Choice(["double", "float"]), help="Element type; default: the widest of each processor's FPU."
)
@click.option(
    "--targets", metavar="NAME,...", help="Processors to print tables for; default m4, m7, rv32imafc, rv64gc."
)
@click.option(
    "-o", "output", metavar="DIR", type=click.Path(), help="Folder of the files; default ./NAME of the stand."
)
@click.option("--check", is_flag=True, help="Write nothing; needs accepted figures.")
@click.option("--accept", is_flag=True, help="Accept the figures for later comparison.")
@json_option("Print the figures as JSON.")
def cost(
    stand_file: str, real: str | None, targets: str | None, output: str | None, check: bool, accept: bool, as_json: bool
) -> None:
    """Measure the C of a stand on processors, with as many lanes as the C in the folder has.

    Instructions of every public function (by an emulator that counts; not cycles), stack, code and constants, into
    COST.md beside the C; accepted figures into cost.json. Exit status 1 without writing if a figure is more than 2 %
    above the accepted one of the same compiler version, or was never accepted. With --targets or --real the tables are
    printed instead, and --accept keeps the accepted figures of other targets.
    """
    if check and accept:
        raise UsageError("--check, --accept: give only one of them")
    from mahovik.proof.cost.measure import USUAL, asked
    from mahovik.proof.cost.page import accepted, page
    from mahovik.proof.cost.page import as_json as json_text
    from mahovik.proof.verify.cost_files import COST, FIGURES
    from mahovik.proof.verify.delivery import accepted_figures, add_to_delivery, delivered_lanes, require_place_for_cost

    pairs = asked(targets, real)
    usual = targets is None and real is None
    stand = load_stand(stand_file)
    folder = Path(output if output is not None else stand.name)
    if not check:
        require_place_for_cost(folder, stand)
    text = accepted_figures(folder, stand)
    if check and text is None:
        raise UsageError(f"{folder / FIGURES}: no such file: accept figures first, `mahovik cost` without --check")
    lanes = delivered_lanes(folder)
    before = accepted(text, str(folder / FIGURES), lanes) if text is not None else None
    found = _measured(stand, pairs, lanes)
    if as_json:
        print_json_text(json_text(found))
    elif not usual and not check:
        click.echo(page(found))
    if before is not None and not accept:
        required = [*USUAL, *((t.name, r) for t, r in pairs)] if check else USUAL if usual else ()
        _compare(found, before, required, quiet=as_json)
    files = {COST: page(found)} if usual and not check else {}
    if accept or (before is None and usual):
        files[FIGURES] = json_text(found, before or ())
    if files:
        for path in add_to_delivery(folder, files):
            click.echo(click.format_filename(path), err=as_json)


def _compare(
    found: Costs, before: Sequence[Mapping[str, Any]], required: Sequence[tuple[str, str]], quiet: bool
) -> None:
    """Print differences from the accepted figures. Raises CheckError if the cost has risen or is not accepted."""
    from mahovik.proof.cost.check import compare

    result = compare(found, before, required)
    for title, lines in (("rise", result.rises), ("not accepted", result.missing), ("not compared", result.other)):
        for line in lines:
            click.echo(f"{title}: {line}", err=quiet)
    if result.rises or result.missing:
        what = "the cost has risen" if result.rises else "not all figures are accepted"
        raise CheckError(f"{found.stand}: {what}; nothing was written; `mahovik cost --accept` accepts it")
    click.echo(f"{found.stand}: no rise on {'; '.join(result.compared) or 'any target'}", err=quiet)


def _measured(stand: Stand, pairs: Sequence[tuple[Target, str]], lanes: int) -> Costs:
    from mahovik.proof.cost.measure import measure

    with progress(f"cost of {stand.name}", len(pairs)) as stage:
        return measure(stand, pairs, stage.at, lanes)
