"""`mahovik verify-programme`: a programme against its stand and motion, by the literal reference."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from mahovik.out.cli.arguments import console, load_stand, stand_argument, table
from mahovik.out.cli.json_output import json_option, print_json
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from collections.abc import Sequence

    from mahovik.proof.verify.programme import Finding


@click.command("verify-programme", short_help="Judge a programme by the reference.")
@stand_argument
@click.argument("motion_file", metavar="M.json", type=click.Path())
@click.argument("programme_file", metavar="P.json", type=click.Path())
@click.option(
    "--tolerance",
    type=click.FloatRange(1e-12, 0.1),
    help="Largest relative residual; the simulation's is 20 times it. Default 1e-6, with damping of V|V| 1e-5.",
)
@json_option("Print JSON instead of a table.")
def verify_programme(
    stand_file: str, motion_file: str, programme_file: str, tolerance: float | None, as_json: bool
) -> None:
    """Verify that a programme makes the carrier move as required.

    Uses only the literal reference and an adaptive integration, independent of planning: the residual of (12) between
    the programme's nodes, the carrier's motion by (8), table, period, bounds, bias, and stability of the motion.

    Exit status: 0 right, 1 refused, 2 bad input.
    """
    from mahovik.core.motion.programme import load_programme
    from mahovik.core.motion.required import load_motion
    from mahovik.proof.verify import programme as verification

    stand = load_stand(stand_file)
    motion = load_motion(motion_file, stand)
    programme = load_programme(programme_file)
    with progress("by the reference"):
        findings = verification.verify_programme(stand, motion, programme, tolerance=tolerance)
    if as_json:
        from mahovik.proof.verify.programme.finding import as_object

        print_json(as_object(stand.name, motion.name, findings))
    else:
        _print(findings)
    if not all(each.passed for each in findings):
        raise SystemExit(1)


def _print(findings: Sequence[Finding]) -> None:
    from rich.text import Text

    out = console(piped=100)  # long words about another stand would widen every row; programs read --json
    rows = table("item", "found>", "accepted>", "verdict", "quantity")
    for each in findings:
        verdict = Text("FAILED", "red") if not each.passed else Text("warns", "yellow") if each.warns else Text("ok")
        rows.add_row(Text(each.name), f"{each.value:.3g}", f"{each.limit:.4g}", verdict, Text(each.words))
    out.print(rows)
    failed = [each.name for each in findings if not each.passed]
    if failed:
        out.print(Text(f"REFUSED: {', '.join(failed)}", "bold red"))
    else:
        out.print(Text("the programme is right", "bold green"))
