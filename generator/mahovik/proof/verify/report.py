"""The verdict of a verification: its data, as JSON and as JUnit XML."""

from __future__ import annotations

import json
import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mahovik.proof.verify.check import Check
from mahovik.proof.verify.states import state_line


@dataclass(frozen=True)
class Report:
    """Result of a verification: the stand (without the features in `left_out`), what was judged, and the checks."""

    stand: str
    structure: str
    physics: str
    judged: str
    seed: int
    states: int
    tolerance: float
    rows: tuple[Check, ...]
    error: str = ""
    left_out: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether something was compared and nothing failed."""
        return not self.error and any(row.verdict == "ok" for row in self.rows) and not self.failures

    @property
    def failures(self) -> tuple[Check, ...]:
        """Rows that failed."""
        return tuple(row for row in self.rows if row.failed)


TEXT = "text = as generated"
"""Quantity of the row on the text of a folder; its words say where that differs, and who has written it."""

REPORT_KEYS = ("stand", "structure", "physics", "judged", "left_out", "seed", "states", "tolerance", "passed")
ROW_KEYS = ("judged", "quantity", "states", "skipped", "value", "limit", "second", "state", "verdict", "words")
"""What the JSON of a report holds, besides its conclusion and rows, and what it holds of each row."""

OTHER_TEXT = "its text is not what this version generates"
"""Reason of a row that C of a folder is not compared in, because another version or a hand has written it."""


def conclusion(report: Report) -> str:
    """The verdict in one line; of C with another text than this version's, it says so."""
    differs = next((row.words for row in report.rows if row.quantity == TEXT and row.words), "")
    return _verdict(report) + (f"; text differs from this version's, {differs}" if differs else "")


def _verdict(report: Report) -> str:
    if report.error:
        return f"FAILED: {report.error}"
    if report.failures:
        names = (row.quantity if row.request is not None else f"{row.judged} {row.quantity}" for row in report.failures)
        return f"FAILED: {', '.join(dict.fromkeys(name.strip() for name in names))}"
    if not report.passed:
        return _nothing(report)
    ok = [row for row in report.rows if row.verdict == "ok"]
    alike = [row for row in ok if row.limit == report.tolerance] or ok
    row = max(alike, key=lambda row: row.value)
    return f"passed: worst {row.value:.1e} of the natural scale, {row.limit:.0e} accepted"


def _nothing(report: Report) -> str:
    """That nothing was compared, with the first reason why; not passed, but nothing failed either."""
    reason = next((row.words for row in report.rows if row.words), "")
    return f"nothing was compared: {reason}" if reason else "nothing was compared"


def as_json(report: Report, more: Mapping[str, Any] | None = None) -> str:
    """The table as JSON; the keys of `more` are added.

    A difference that is not a finite number (missing, refused) is null.
    """
    rows = [{key: _finite(getattr(row, key)) for key in ROW_KEYS} for row in report.rows]
    about = {key: getattr(report, key) for key in REPORT_KEYS}
    found = {**about, "conclusion": conclusion(report), "rows": rows, **(more or {})}
    return json.dumps(found, indent=1, allow_nan=False)


def _finite(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def as_junit(report: Report) -> str:
    """The table as JUnit XML: one test case for each row."""
    suite = ET.Element("testsuite", name=f"mahovik verify {report.stand}")
    skipped = 0
    for row in report.rows:
        name = f"{row.judged}: {row.quantity}" if row.judged else row.quantity
        case = ET.SubElement(suite, "testcase", classname=f"mahovik.{report.stand}", name=name)
        words = f"{row.verdict}, {row.states} states, largest difference {row.value:.3g} at {row.state or '-'}"
        if row.second is not None:
            words += f", second derivation {row.second:.3g} from the reference"
        if row.limit:
            ET.SubElement(case, "system-out").text = _printable(words)
        if row.failed:
            failure = ET.SubElement(case, "failure", message=_printable(f"{words} {row.words}".strip()))
            failure.text = _printable(state_line(row.request) if row.request else row.words)
        elif row.verdict != "ok":
            skipped += 1
            ET.SubElement(case, "skipped", message=_printable(f"{row.verdict} {row.words}".strip()))
    errors = int(bool(report.error or not report.rows))
    if errors:
        case = ET.SubElement(suite, "testcase", classname=f"mahovik.{report.stand}", name="run")
        ET.SubElement(case, "error", message=_printable(report.error or "nothing was compared"))
    counts = {"tests": len(suite), "failures": len(report.failures), "errors": errors, "skipped": skipped}
    for name, number in counts.items():
        suite.set(name, str(number))
    ET.indent(suite)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(suite, encoding="unicode") + "\n"


def worst_lines(report: Report) -> str:
    """States as `eval` takes them: the worst of every quantity that failed, or of all where none did; worst first."""
    rows = [row for row in report.failures or report.rows if row.request is not None]
    rows.sort(key=lambda row: -row.share)
    return "".join(f"{line}\n" for line in dict.fromkeys(state_line(row.request) for row in rows if row.request))


def _printable(text: str) -> str:
    """Text without characters that XML cannot hold: a foreign program may print anything."""
    return "".join(c if c in "\t\n" or (c >= " " and c.isprintable()) else "?" for c in text)
