"""`mahovik evidence`: all evidence for the C of a stand, in one folder."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.errors import CheckError, UsageError
from mahovik.out.cli.options import (
    REAL,
    argument,
    command,
    file_option,
    flag,
    is_given,
    json_option,
    load_stand,
    option,
)
from mahovik.out.cli.output import print_json, print_line, print_table
from mahovik.out.progress import can_show_line, progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.proof.evidence import Outcome
    from mahovik.proof.verify.delivery import Options

FUZZ_SECONDS = (20, 600)
"""s of fuzzing: quick, full."""


@command()
def evidence(
    stand_file: str | None = argument("STAND.toml", required=False),
    output: str | None = file_option("-o", "DIR", "Write into this folder; default ./NAME-evidence of the stand."),
    full: bool = flag("--full", "Run everything, possibly for hours; default: --quick, for minutes."),
    quick: bool = flag("--quick", "Run fewer states, drivers and processors."),
    only: str | None = option("--only", "Run only these pieces, and list the others as left out.", metavar="NAME,..."),
    without: str | None = option("--without", "Run all pieces but these.", metavar="NAME,..."),
    seconds: int | None = option(
        "--seconds",
        f"Fuzz for this number of seconds; default {FUZZ_SECONDS[0]}, with --full {FUZZ_SECONDS[1]}.",
        type=click.IntRange(1, 1000000),
    ),
    checked: str | None = file_option("--check", "DIR", "Check the SHA-256 sums of a folder only."),
    as_json: bool = json_option("Print the table as JSON."),
    real: str = REAL,
    against: str | None = file_option(
        "--against", "DIR", "Use the prefix, element type, functions and additions of this folder."
    ),
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
    from mahovik.proof.verify.delivery import Options, delivered_options

    stand, options = load_stand(stand_file), Options(real)
    if against is not None:
        from mahovik.proof.verify.delivery import stand_in

        delivered = delivered_options(Path(against))
        if delivered is None:
            raise UsageError(f"{against}: no manifest.json: give a folder of `mahovik generate`")
        if is_given("real") and real != delivered.real:
            raise UsageError(f"{against}: its C is {delivered.real}, expected {real}: leave --real out")
        stand, options = stand_in(Path(against), stand), delivered
    from mahovik.proof.evidence import PIECES, Verdict, as_dicts, conclusion, failures, select_pieces

    wanted = select_pieces(PIECES, only, without)
    folder = Path(output if output is not None else f"{stand.name}-evidence")
    found = _collect(stand, stand_file, folder, full, seconds or FUZZ_SECONDS[full], wanted, options)
    if as_json:
        print_json({"folder": str(folder), "conclusion": conclusion(found), "pieces": as_dicts(found)})
    else:
        styles = {Verdict.PASSED: "green", Verdict.FAILED: "red"}
        rows = [(x.piece.name, (x.verdict.value, styles.get(x.verdict, "yellow")), x.figure) for x in found]
        print_table(("piece", "verdict", "figure"), rows)
        print_line(conclusion(found), "bold")
        click.echo(click.format_filename(folder / "index.html"))
    if not any(outcome.verdict in (Verdict.PASSED, Verdict.FAILED) for outcome in found):
        raise CheckError(
            f"{stand.name}: no piece was run, so nothing is shown: install what the page names, or choose other pieces"
        )
    strict = os.environ.get("CI", "").lower() in ("true", "1")
    if bad := failures(found, strict):
        raise CheckError(f"{stand.name}: {', '.join(bad)}: failed, or not run because a tool is missing")


def _check(folder: Path, as_json: bool) -> None:
    from mahovik.proof.evidence import check

    found = check(folder)
    if found:
        raise CheckError("\n".join(found))
    if as_json:
        print_json({"folder": str(folder), "passed": True})
    else:
        click.echo(f"{click.format_filename(folder)}   every file as it was written")


def _collect(
    stand: Stand,
    stand_file: str,
    folder: Path,
    full: bool,
    seconds: int,
    wanted: frozenset[str],
    options: Options,
) -> list[Outcome]:
    """Collected pieces; a line on a terminal says what runs, elsewhere there is one line per piece."""
    from mahovik.core.stand.content import content
    from mahovik.proof.evidence import PIECES, collect

    order = [each.name for each in PIECES if each.name in wanted]
    with progress("generate") as stage:

        def say(name: str, what: str) -> None:
            if what:
                stage.say(f"{order.index(name) + 1} of {len(order)}: {name}, {what}")
            elif not can_show_line():
                click.echo(f"{order.index(name) + 1} of {len(order)}: {name}", err=True)

        text = content(Path(stand_file))
        return collect(stand, text, folder, PIECES, options, full=full, seconds=seconds, wanted=wanted, say=say)
