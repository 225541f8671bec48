"""`mahovik verify-programme`: a programme against its stand and motion, by the literal reference."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from mahovik.errors import UsageError
from mahovik.out.cli.options import STAND_FILE, command, file_option, is_given, json_option, load_stand, option
from mahovik.out.cli.output import print_json, print_line, print_table
from mahovik.out.cli.stand_first import FURTHER, STAND, needed_option, stand_first
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from collections.abc import Sequence

    from mahovik.proof.verify.check import Check


@command("verify-programme", short_help="Judge a programme by the reference.")
def verify_programme(
    stand_file: str = STAND_FILE,
    further: tuple[str, ...] = FURTHER,
    motion: str | None = needed_option("--motion", "M.json", "Read the required motion from this file."),
    programme: str | None = needed_option("--programme", "P.json", "Verify this programme."),
    tolerance: float | None = option(
        "--tolerance",
        "Accept this relative residual, and 20 times it in simulation; default 1e-6, with damping of V|V| 1e-5.",
        type=click.FloatRange(1e-12, 0.1),
    ),
    against: str | None = file_option("--against", "DIR", "Judge also the C of the programme in this folder."),
    name: str = option("--name", "Judge the C of this name, with --against.", default="programme"),
    as_json: bool = json_option("Print JSON instead of a table."),
) -> None:
    """Verify that a programme makes the carrier move as required.

    Uses only the literal reference and an adaptive integration, independent of planning: the residual of (12) between
    the programme's nodes, the carrier's motion by (8), table, period, bounds and bias.
    With --against, every function of the C that `generate --programme` wrote there: its angles, their residual of (12),
    drive torques, run-up and run-down, and the clock.

    Exit status: 0 right, 1 refused, 2 bad input.
    """
    from mahovik.out.functions.programmes import verify_programme as judged

    given = {"--motion": motion, "--programme": programme}
    stand_file, (motion_file, programme_file) = stand_first(
        stand_file, further, given, former=(STAND, "--motion", "--programme")
    )
    if against is None and is_given("name"):
        raise UsageError("--name: no C is judged; give its folder, as --against DIR")
    stand = load_stand(stand_file)
    with progress("by the reference") as stage:
        found = judged(
            stand, motion_file, programme_file, tolerance=tolerance, against=against, name=name, progress=stage.show
        )
    findings = found.findings
    if as_json:
        from mahovik.proof.verify.programme.verification import as_item

        items, owner = [as_item(item) for item in findings], {"stand": stand.name, "motion": found.motion.name}
        print_json({**owner, "passed": found.passed, "findings": items})
    else:
        _print(findings)
    if not found.passed:
        raise SystemExit(1)


def _print(items: Sequence[Check]) -> None:
    rows = []
    for item in items:
        verdict = ("FAILED", "red") if item.failed else ("ok", "")
        rows.append((item.quantity, f"{item.value:.3g}", f"{item.limit:.4g}", verdict, item.words))
    # long words about another stand would widen every row; programs read --json
    print_table(("item", "found>", "accepted>", "verdict", "quantity"), rows, piped=100)
    failed = [item.quantity for item in items if item.failed]
    if failed:
        print_line(f"REFUSED: {', '.join(failed)}", "bold red")
    else:
        print_line("the programme is right", "bold green")
