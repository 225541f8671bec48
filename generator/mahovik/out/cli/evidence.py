"""`mahovik evidence`: all evidence for the C of a stand, in one folder."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import CheckError, UsageError
from mahovik.out.cli.arguments import console, load_stand, real_option, table
from mahovik.out.cli.json_output import json_option, print_json
from mahovik.out.cli.progress import progress, shown

if TYPE_CHECKING:
    from mahovik.proof.evidence.piece import Collected


@click.command()
@click.argument("stand_file", metavar="STAND.toml", type=click.Path(), required=False)
@click.option("-o", "output", metavar="DIR", type=click.Path(), help="Folder; default ./NAME-evidence of the stand.")
@click.option("--full", is_flag=True, help="Everything, possibly hours; default --quick, minutes.")
@click.option("--quick", is_flag=True, help="Fewer states, drivers, processors.")
@click.option("--only", metavar="NAME,...", help="Only these pieces; others are listed as left out.")
@click.option("--without", metavar="NAME,...", help="All pieces but these.")
@click.option("--seconds", type=click.IntRange(1, 1_000_000), help="Time of fuzzing. [default: 20, with --full 600]")
@click.option("--check", "checked", metavar="DIR", type=click.Path(), help="Check the SHA-256 sums of a folder only.")
@json_option("Print the table as JSON.")
@real_option
def evidence(
    stand_file: str | None,
    output: str | None,
    full: bool,
    quick: bool,
    only: str | None,
    without: str | None,
    seconds: int | None,
    checked: str | None,
    as_json: bool,
    real: str,
) -> None:
    """Collect the evidence for the C of a stand.

    One folder to hand over: the C, every check that was run with its output and the command to repeat it, an index
    page to read offline, and the SHA-256 of every file.

    Exit status 1 if a piece failed, or none was run. A missing tool is listed with the command that installs it; it
    counts as a failure if the environment has CI=true.
    """
    if checked is not None:
        if stand_file is not None or output is not None:
            raise UsageError("--check DIR checks a folder: without a stand file and -o")
        _check(Path(checked), as_json)
        return
    if stand_file is None:
        raise UsageError("give a stand file, or --check DIR")
    if full and quick:
        raise UsageError("--full, --quick: give only one of them")
    stand = load_stand(stand_file)
    from mahovik.proof.evidence.collect import chosen, failures, nothing_ran
    from mahovik.proof.evidence.pieces import PIECES

    wanted = chosen(PIECES, only, without)
    folder = Path(output if output is not None else f"{stand.name}-evidence")
    found = _collected(stand_file, folder, full, seconds or (600 if full else 20), wanted, real)
    if as_json:
        print_json(_plain(found, folder))
    else:
        _print(found)
        click.echo(click.format_filename(folder / "index.html"))
    if nothing_ran(found):
        raise CheckError(
            f"{stand.name}: no piece was run, so nothing is shown: install what the page names, or choose other pieces"
        )
    strict = os.environ.get("CI", "").lower() in ("true", "1")
    if bad := failures(found, strict):
        raise CheckError(f"{stand.name}: {', '.join(bad)}: failed, or not run because a tool is missing")


def _check(folder: Path, as_json: bool) -> None:
    from mahovik.proof.evidence.folder import check

    found = check(folder)
    if found:
        raise CheckError("\n".join(found))
    if as_json:
        print_json({"folder": str(folder), "passed": True})
    else:
        click.echo(f"{click.format_filename(folder)}   every file as it was written")


def _collected(
    stand_file: str, folder: Path, full: bool, seconds: int, wanted: frozenset[str], real: str
) -> list[Collected]:
    """With a line on a terminal that says what runs; elsewhere a line a piece."""
    from mahovik.core.stand.content import content
    from mahovik.proof.evidence.collect import collect
    from mahovik.proof.evidence.pieces import PIECES

    stand = load_stand(stand_file)
    order = [each.name for each in PIECES if each.name in wanted]
    with progress("generate") as stage:

        def say(name: str, what: str) -> None:
            if what:
                stage.say(f"{order.index(name) + 1} of {len(order)}: {name}, {what}")
            elif not shown():
                click.echo(f"{order.index(name) + 1} of {len(order)}: {name}", err=True)

        return collect(
            stand,
            content(Path(stand_file)),
            folder,
            PIECES,
            real=real,
            full=full,
            seconds=seconds,
            wanted=wanted,
            say=say,
        )


def _plain(found: list[Collected], folder: Path) -> dict[str, Any]:
    from mahovik.proof.evidence.page import conclusion

    pieces = [
        {"name": e.piece.name, "verdict": e.outcome.verdict.value, "figure": e.outcome.figure, "command": e.command}
        for e in found
    ]
    return {"folder": str(folder), "conclusion": conclusion(found), "pieces": pieces}


def _print(found: list[Collected]) -> None:
    from rich.text import Text

    from mahovik.proof.evidence.page import conclusion
    from mahovik.proof.evidence.piece import Verdict

    out = console()
    rows = table("piece", "verdict", "figure")
    styles = {Verdict.PASSED: "green", Verdict.FAILED: "red"}
    for each in found:
        verdict = each.outcome.verdict
        rows.add_row(each.piece.name, Text(verdict.value, styles.get(verdict, "yellow")), Text(each.outcome.figure))
    out.print(rows)
    out.print(Text(conclusion(found), "bold"))
