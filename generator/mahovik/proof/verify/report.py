"""The verdict of a verification: its data, as JSON and as JUnit XML."""

from __future__ import annotations

import json
import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mahovik.proof.verify.compare import Row
from mahovik.proof.verify.states import state_line


@dataclass(frozen=True)
class Report:
    """Result of a verification: the stand (without the features in `left_out`), what was judged, and the rows."""

    stand: str
    structure: str
    physics: str
    judged: str
    seed: int
    states: int
    tolerance: float
    rows: tuple[Row, ...]
    error: str = ""
    left_out: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether something was compared and nothing failed."""
        return not self.error and any(row.verdict == "ok" for row in self.rows) and not self.failures

    @property
    def failures(self) -> tuple[Row, ...]:
        """Rows that failed."""
        return tuple(row for row in self.rows if row.failed)


OTHER_TEXT = "its text is not what this version generates"
"""Reason of a row that C of a folder is not compared in, because another version or a hand has written it."""


def conclusion(report: Report) -> str:
    """The verdict in one line; of C with another text than this version's, it says so."""
    differs = any(row.reason == OTHER_TEXT for row in report.rows)
    return _verdict(report) + ("; text differs from this version's" if differs else "")


def _verdict(report: Report) -> str:
    if report.error:
        return f"FAILED: {report.error}"
    if report.failures:
        names = (row.quantity if row.request is not None else f"{row.want} {row.quantity}" for row in report.failures)
        return f"FAILED: {', '.join(dict.fromkeys(name.strip() for name in names))}"
    if not report.passed:
        return _nothing(report)
    ok = [row for row in report.rows if row.verdict == "ok"]
    quantities = [row for row in ok if row.request is not None] or ok  # of wants: functions have scales of their own
    row = max(quantities, key=lambda row: row.excess)
    difference, accepted, pair = row.nearest()
    if has_one_bound(quantities):
        return f"passed: worst {difference:.1e} of the natural scale, {row.tolerance or report.tolerance:.0e} accepted"
    off = f"{difference:.1e} of the natural scale, {accepted:.0e} accepted"
    return f"passed: nearest to its bound {row.quantity}, {pair}: {off}"


def _nothing(report: Report) -> str:
    """That nothing was compared, with the first reason why; not passed, but nothing failed either."""
    reason = next((row.reason for row in report.rows if row.reason), "")
    return f"nothing was compared: {reason}" if reason else "nothing was compared"


def has_one_bound(rows: Sequence[Row]) -> bool:
    """Whether all quantities and pairs of these rows have the same accepted difference."""
    judged = [row for row in rows if row.tolerance is not None]
    return len({bound for row in judged for bound in (row.tolerance, row.derivations or row.tolerance)}) <= 1


def as_json(report: Report, more: Mapping[str, Any] | None = None) -> str:
    """The table as JSON; the keys of `more` are added.

    A difference that is not a finite number (missing, refused) is null.
    """
    rows = [
        {
            "want": row.want,
            "quantity": row.quantity,
            "states": row.states,
            "worst": _finite(row.worst),
            "second": _finite(row.second),
            "between": _finite(row.between),
            "disagreement": row.disagreement,
            "tolerance": row.tolerance or report.tolerance,
            "state": row.state,
            "verdict": row.verdict,
            "reason": row.reason,
        }
        for row in report.rows
    ]
    found: dict[str, Any] = {
        "stand": report.stand,
        "structure": report.structure,
        "physics": report.physics,
        "judged": report.judged,
        "left_out": report.left_out,
        "seed": report.seed,
        "states": report.states,
        "tolerance": report.tolerance,
        "passed": report.passed,
        "conclusion": conclusion(report),
        "rows": rows,
    }
    return json.dumps(found | dict(more or {}), indent=1, allow_nan=False)


def _finite(number: float | None) -> float | None:
    return number if number is not None and math.isfinite(number) else None


def as_junit(report: Report) -> str:
    """The table as JUnit XML: one test case for each row."""
    suite = ET.Element("testsuite", name=f"mahovik verify {report.stand}")
    skipped = 0
    for row in report.rows:
        name = f"{row.want}: {row.quantity}" if row.want else row.quantity
        case = ET.SubElement(suite, "testcase", classname=f"mahovik.{report.stand}", name=name)
        words = f"{row.verdict}, {row.states} states, worst {row.worst:.3g} at {row.state or '-'}"
        if row.second is not None and row.between is not None:
            words += f", second derivation {row.second:.3g} from the reference, {row.between:.3g} from what is judged"
        if row.second is not None or row.tolerance is not None:
            ET.SubElement(case, "system-out").text = _printable(words)
        if row.failed:
            failure = ET.SubElement(
                case, "failure", message=_printable(f"{words} {row.disagreement} {row.reason}".strip())
            )
            failure.text = _printable(state_line(row.request) if row.request else row.reason)
        elif row.verdict != "ok":
            skipped += 1
            ET.SubElement(case, "skipped", message=_printable(f"{row.verdict} {row.reason}".strip()))
    errors = 0
    if report.error or not report.rows:
        errors = 1
        case = ET.SubElement(suite, "testcase", classname=f"mahovik.{report.stand}", name="run")
        ET.SubElement(case, "error", message=_printable(report.error or "nothing was compared"))
    counts = {
        "tests": len(suite),
        "failures": len(report.failures),
        "errors": errors,
        "skipped": skipped,
    }
    for name, number in counts.items():
        suite.set(name, str(number))
    ET.indent(suite)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(suite, encoding="unicode") + "\n"


def worst_lines(report: Report) -> str:
    """States as `eval` takes them: the worst of every quantity that failed, or of all where none did; worst first."""
    rows = [row for row in report.failures or report.rows if row.request is not None]
    rows.sort(key=lambda row: -row.excess)
    return "".join(f"{line}\n" for line in dict.fromkeys(state_line(row.request) for row in rows if row.request))


def _printable(text: str) -> str:
    """Text without characters that XML cannot hold: a foreign program may print anything."""
    return "".join(c if c in "\t\n" or (c >= " " and c.isprintable()) else "?" for c in text)
