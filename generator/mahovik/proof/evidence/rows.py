"""Rows of the harness as a table of the page."""

from __future__ import annotations

from mahovik.proof.evidence.piece import Table
from mahovik.proof.verify.compare import Row
from mahovik.proof.verify.report import Report


def of_report(report: Report) -> Table:
    """The table that `mahovik verify` prints."""
    third = any(row.second is not None for row in report.rows)
    head = ("quantity", "by", "states>", "worst>", *(("second>", "between>") if third else ()), "verdict")
    return Table(head, tuple(_row(row, third) for row in report.rows))


def _row(row: Row, third: bool) -> tuple[str, ...]:
    figures = bool(row.want) and row.verdict in ("ok", "FAILED")
    pair = ("" if off is None else f"{off:.1e}" for off in (row.second, row.between) if third)
    said = " ".join(words for words in (row.verdict, row.disagreement, row.reason) if words)
    states = str(row.states) if row.states else ""
    return (row.quantity, row.want, states, f"{row.worst:.1e}" if figures else "", *pair, said)
