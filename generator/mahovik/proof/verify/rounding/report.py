"""The table of rounding errors as JSON, and its verdict in one line."""

from __future__ import annotations

import json
import math
from typing import Any

from mahovik.proof.verify.report import as_json as report_json
from mahovik.proof.verify.report import conclusion as report_conclusion
from mahovik.proof.verify.rounding.measure import Rounding, RoundingReport

NEGLIGIBLE = 1e-9
"""An error in ulp below this is shown as 0: the answer is exact, what is left is the radius of its enclosure."""


def ulp_text(ulps: float, digits: int = 2) -> str:
    """An error in ulp for people."""
    return "0" if ulps < NEGLIGIBLE else f"{ulps:.{digits}g}"


def conclusion(found: RoundingReport) -> str:
    """The verdict."""
    if not found.report.passed:
        return report_conclusion(found.report)
    worst = max(found.lines, key=lambda line: line.ulps)
    words = f"passed: worst {ulp_text(worst.ulps)} ulp of the natural scale, {worst.row.quantity} ({worst.row.want})"
    return words if worst.limit is None else f"{words}; {worst.limit:g} accepted"


def as_json(found: RoundingReport) -> str:
    """JSON of `verify`, with the errors of each row; null where an error is not finite."""
    table: dict[str, Any] = json.loads(report_json(found.report))
    table["real"] = found.real
    table["conclusion"] = conclusion(found)
    for row, line in zip(table["rows"], found.lines, strict=True):
        for unused in ("second", "between", "disagreement"):
            del row[unused]
        row.update(_errors(line))
    return json.dumps(table, indent=1, allow_nan=False)


def _errors(line: Rounding) -> dict[str, float | None]:
    found = {
        "ulps": line.ulps,
        "ulps_accepted": line.limit,
        "ulps_function_alone": line.alone,
        "ulps_judges": line.judges,
        "worst_judges": line.apart,
        "relative_typical": line.typical,
        "relative_worst": max(line.own, default=0.0),
    }
    return {key: x if x is not None and math.isfinite(x) else None for key, x in found.items()}
