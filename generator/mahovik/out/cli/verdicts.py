"""Tables of verdicts that `mahovik verify` and `mahovik judge` print."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mahovik.out.cli.output import Cell, print_line, print_table

if TYPE_CHECKING:
    from mahovik.proof.verify.check import Check
    from mahovik.proof.verify.report import Report
    from mahovik.proof.verify.rounding.measure import RoundingReport
    from mahovik.proof.verify.targets import TargetRow, TargetsReport


def print_report(found: Report, by: str = "") -> None:
    """Differences of every quantity from the reference, and the conclusion. `by`: head of the column of wants."""
    from mahovik.contract.functions import ALL_WANTS, is_public
    from mahovik.proof.verify.report import conclusion, has_one_limit

    print_line(f"{found.judged} of {found.stand}   {_identities(found)}   seed {found.seed}")
    if found.left_out:
        print_line(f"the stand without: {', '.join(found.left_out)}", "yellow")
    third = any(row.second is not None for row in found.rows)
    second = ("second>",) if third else ()
    limit = () if has_one_limit(found.rows) else ("limit>",)
    named = {row.judged for row in found.rows if row.judged}
    by = by or ("want" if named <= {*ALL_WANTS} else "function" if all(map(is_public, named)) else "judge")
    columns = ("quantity", by, "states>", "worst>", *limit, *second, "at state", "verdict")
    rows = []
    for row in found.rows:
        judged = row.verdict in ("ok", "FAILED") and row.judged
        rows.append((
            row.quantity,
            row.judged,
            str(row.states) if row.states else "",
            f"{row.value:.1e}" if judged else "",
            *(f"{row.limit:.0e}" if judged and row.limit else "" for _ in limit),
            *("" if row.second is None else f"{row.second:.1e}" for _ in second),
            row.state,
            _verdict(row, row.words),
        ))  # fmt: skip
    if found.rows:
        print_table(columns, rows)
    _print_conclusion("FAILED" if found.error else conclusion(found), found.passed)


def print_targets(found: TargetsReport) -> None:
    """The self-test on every processor."""
    print_line(f"self-test of {found.stand} on targets   {_identities(found)}")
    rows = []
    for row in found.rows:
        counts = (str(row.functions), str(row.states)) if row.functions else ("", "")
        rows.append((row.target, row.title, row.built_with, row.real, *counts, _verdict(row, row.reason)))
    print_table(("target", "processor", "compiler", "real", "functions>", "states>", "verdict"), rows)
    _print_conclusion(found.conclusion, found.passed)


def print_rounding(found: RoundingReport) -> None:
    """True errors of the C, in units in the last place and relative to their scale."""
    from mahovik.proof.verify.rounding.measure import NEGLIGIBLE, conclusion, ulp_text

    report = found.report
    print_line(f"rounding of {report.judged} of {report.stand}   {_identities(report)}   seed {report.seed}")
    numbers = ("states>", "ulp>", "function alone>", "judges>", "of scale>", "accepted>", "relative>")
    rows = []
    for line in found.lines:
        row, exact = line.row, line.ulps < NEGLIGIBLE
        ulps = ulp_text(line.ulps), ulp_text(line.alone), ulp_text(line.judges, 1)
        worst, typical = (0.0 if exact else x for x in (row.value, line.typical))
        relative = f"{worst:.1e}", f"{row.limit:.0e}", f"{typical:.1e}"
        rows.append((
            row.quantity, row.judged, str(row.states), *ulps, *relative, row.state, _verdict(row, row.words)
        ))  # fmt: skip
    if found.lines:
        print_table(("quantity", "want", *numbers, "at state", "verdict"), rows)
    _print_conclusion(conclusion(found), report.passed)


def _identities(found: Report | TargetsReport) -> str:
    return f"structure {found.structure}, physics {found.physics}"


def _verdict(row: Check | TargetRow, words: str) -> Cell:
    """The verdict and its words, in its colour."""
    style = "green" if row.verdict == "ok" else "red" if row.failed else "yellow"
    return f"{row.verdict}  {words}".rstrip(), style


def _print_conclusion(words: str, passed: bool) -> None:
    print_line(words, "bold green" if passed else "bold red")
