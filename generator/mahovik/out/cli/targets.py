"""`mahovik verify --targets`: the same bits on every processor."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mahovik.out.cli.arguments import console, table
from mahovik.out.cli.json_output import print_json_text
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.proof.verify.targets import TargetsReport


def verify_on_targets(
    stand: Stand,
    names: str,
    reals: tuple[str, ...] | None,
    states: int | None,
    as_json: bool,
    junit: str | None,
    lanes: int,
) -> None:
    """Run the self-test on targets, print the table, and exit with the verdict as status.

    1: bits differ. 2: a compiler or an emulator is missing, or the processor lacks a feature of the only target; then
    nothing is known.
    """
    from mahovik.proof.verify.files import write
    from mahovik.proof.verify.targets import SWEEP, asked, verify_targets
    from mahovik.proof.verify.targets_report import as_json as json_text
    from mahovik.proof.verify.targets_report import as_junit

    pairs = asked(names, reals)
    with progress(f"verify {stand.name} on targets", len(pairs)) as stage:
        found = verify_targets(stand, pairs, states or SWEEP, stage.at, lanes)
    print_json_text(json_text(found)) if as_json else _print(found)
    if junit is not None:
        write(Path(junit), as_junit(found))
    if not found.passed:
        raise SystemExit(1 if any(row.failed for row in found.rows) else 2)


def _print(found: TargetsReport) -> None:
    from rich.text import Text

    out = console()
    out.print(
        Text(f"self-test of {found.stand} on targets   structure {found.structure}, physics {found.physics}"),
    )
    rows = table("target", "processor", "compiler", "real", "functions>", "states>", "verdict")
    for row in found.rows:
        verdict = Text(row.verdict, "green" if row.verdict == "ok" else "red" if row.failed else "yellow")
        if row.reason:
            verdict.append(f"  {row.reason}")
        counts = (str(row.functions), str(row.states)) if row.functions else ("", "")
        rows.add_row(row.target, Text(row.title), row.built_with, row.real, *counts, verdict)
    out.print(rows)
    out.print(Text(found.conclusion, "bold green" if found.passed else "bold red"))
