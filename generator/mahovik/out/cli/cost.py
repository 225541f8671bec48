"""`mahovik cost`: instructions, stack, code and constants on processors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import CheckError, UsageError
from mahovik.out.cli.options import STAND_FILE, choice, command, file_option, flag, json_option, load_stand, option
from mahovik.out.cli.output import print_json_text
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.core.toolchain.targets import Target
    from mahovik.proof.cost import Costs
    from mahovik.proof.verify.delivery import Options


@command(short_help="Measure the C of a stand on processors.")
def cost(
    stand_file: str = STAND_FILE,
    real: str | None = choice(
        "--real", ["double", "float"], "Choose the element type; default: the widest of each processor's FPU."
    ),
    targets: str | None = option(
        "--targets", "Print tables for these processors; default m4, m7, rv32imafc, rv64gc.", metavar="NAME,..."
    ),
    output: str | None = file_option("-o", "DIR", "Use the files in this folder; default ./NAME of the stand."),
    check: bool = flag("--check", "Write nothing, only compare with accepted figures."),
    accept: bool = flag("--accept", "Accept the figures for later comparison."),
    as_json: bool = json_option("Print the figures as JSON."),
) -> None:
    """Measure the C of a stand on processors, with the name, functions and float that the C in the folder has.

    Instructions of every public function (by an emulator that counts; not cycles), stack, code and constants, into
    COST.md beside the C; accepted figures into cost.json. Exit status 1 without writing if a figure is more than 2 %
    above the accepted one of the same compiler version, or was never accepted. With --targets or --real the tables are
    printed instead, and --accept keeps the accepted figures of other targets; so too where a target is left out because
    its tools are missing: the command that installs them is printed. --check leaves none out.
    """
    if check and accept:
        raise UsageError("--check, --accept: give only one of them")
    from mahovik.proof.cost import USUAL, available, page, parse_targets, read_accepted_costs, require_place
    from mahovik.proof.cost import as_json as json_text
    from mahovik.proof.verify.delivery import COST_PAGE, FIGURES, Options, delivered_options, stand_in
    from mahovik.writing import write_all

    stand = load_stand(stand_file)
    folder = Path(output if output is not None else stand.name)
    options = delivered_options(folder) or Options()
    in_float = real is None and options.real == "float"  # else the type of each processor
    pairs = parse_targets(targets, "float" if in_float else real)
    absent: list[str] = []
    if not check:  # a gate that measures less than it should is none
        pairs, absent = available(pairs)
    for line in absent:
        click.echo(f"left out: {line}", err=True)
    usual = targets is None and real is None and not absent
    stand = stand_in(folder, stand, UsageError)
    if not check:
        require_place(folder, stand)
    accepted = read_accepted_costs(folder, stand)
    if check and accepted is None:
        raise UsageError(f"{folder / FIGURES}: no such file: accept figures first, `mahovik cost` without --check")
    before = None if accepted is None else accepted["targets"]
    found = _measure(stand, pairs, options)
    if as_json:
        print_json_text(json_text(found))
    elif not usual and not check:
        click.echo(page(found))
    if before is not None and not accept:
        always = () if in_float else USUAL
        required = (*always, *((t.name, r) for t, r in pairs)) if check else always if usual else ()
        _compare(found, before, required, quiet=as_json)
    files = {COST_PAGE: page(found)} if usual and not check else {}
    if accept or (before is None and usual):
        files[FIGURES] = json_text(found, before or ())
    if files:
        for path in write_all(folder, files):
            click.echo(click.format_filename(path), err=as_json)


def _compare(
    found: Costs, before: Sequence[Mapping[str, Any]], required: Sequence[tuple[str, str]], quiet: bool
) -> None:
    """Print differences from the accepted figures. Raises CheckError if the cost has risen or is not accepted."""
    from mahovik.proof.cost import compare

    result = compare(found, before, required)
    for title, lines in (("rise", result.rises), ("not accepted", result.missing), ("not compared", result.other)):
        for line in lines:
            click.echo(f"{title}: {line}", err=quiet)
    if result.rises or result.missing:
        what = "the cost has risen" if result.rises else "not all figures are accepted"
        raise CheckError(f"{found.stand}: {what}; nothing was written; `mahovik cost --accept` accepts it")
    click.echo(f"{found.stand}: no rise on {'; '.join(result.compared) or 'any target'}", err=quiet)


def _measure(stand: Stand, pairs: Sequence[tuple[Target, str]], options: Options) -> Costs:
    from mahovik.proof.cost import measure

    with progress(f"cost of {stand.name}", len(pairs)) as stage:
        return measure(stand, pairs, stage.at, options.only, "recorder" in options.additions)
