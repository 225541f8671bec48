"""`mahovik verify --rigorous`: the true error of the C, by ball arithmetic."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mahovik.errors import UsageError
from mahovik.out.cli.arguments import console, table
from mahovik.out.cli.json_output import print_json_text
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.proof.verify.rounding.measure import RoundingReport


def verify_rigorously(
    stand: Stand, seed: int, states: int, against: str | None, real: str, as_json: bool
) -> RoundingReport:
    """Measure, and print the table. Raises UsageError without python-flint."""
    try:
        from mahovik.proof.verify.rounding.measure import measure_rounding
        from mahovik.proof.verify.rounding.report import as_json as json_text
    except ImportError as error:
        if (error.name or "").partition(".")[0] != "flint":
            raise
        raise UsageError("--rigorous: python-flint is not installed: pip install 'mahovik[rigorous]'") from None
    with progress(f"enclose {stand.name}", states) as stage:
        found = measure_rounding(
            stand,
            seed=seed,
            count=states,
            real=real,
            against=None if against is None else Path(against),
            progress=stage.at,
        )
    print_json_text(json_text(found)) if as_json else _print(found)
    return found


def _print(found: RoundingReport) -> None:
    from rich.text import Text

    from mahovik.proof.verify.rounding.report import NEGLIGIBLE, conclusion, ulp_text

    out, report = console(), found.report
    head = f"rounding of {report.judged} of {report.stand}   structure {report.structure}, physics {report.physics}"
    out.print(Text(f"{head}   seed {report.seed}"))
    numbers = ("states>", "ulp>", "function alone>", "judges>", "of scale>", "accepted>", "relative>")
    rows = table("quantity", "want", *numbers, "at state", "verdict")
    for line in found.lines:
        row, exact = line.row, line.ulps < NEGLIGIBLE
        verdict = Text(row.verdict, "red" if row.failed else "green")
        if row.reason:
            verdict.append(f"  {row.reason}")
        rows.add_row(
            Text(row.quantity),
            row.want,
            str(row.states),
            ulp_text(line.ulps),
            ulp_text(line.alone),
            ulp_text(line.judges, 1),
            f"{0.0 if exact else row.worst:.1e}",
            f"{row.tolerance:.0e}",
            f"{0.0 if exact else line.typical:.1e}",
            Text(row.state),
            verdict,
        )
    if found.lines:
        out.print(rows)
    out.print(Text(conclusion(found), "bold green" if report.passed else "bold red"))
