"""The public models of others in tests/audits, judged: what differs, and whether the search names its terms."""

from __future__ import annotations

import math
import re
from argparse import Namespace
from collections.abc import Iterator
from pathlib import PurePosixPath

from campaigns import CORES, Row, Rows, Table, side_by_side

OPTIONS = {"jobs": CORES}

LARGE = 1e-11
"""Differences over the natural scale above this are no rounding."""


def audit_row(name: str) -> tuple[str | float | None, ...]:
    """The row of an audit."""
    from audits.measure import AUDITS
    from audits.measure import measure as measure_audit

    audit = AUDITS[name]
    result = measure_audit(audit)
    agreeing = None if result.agreeing is None else f"{-math.log10(max(result.agreeing, 1e-16)):.0f}"
    worst = result.worst if result.worst > LARGE else None
    return (
        audit.title, audit.source, agreeing, ", ".join(result.differing), worst, audit.finding,
        "; ".join((*result.faults, *result.named)), "; ".join(result.missing), "; ".join(result.false),
    )  # fmt: skip


def measure(options: Namespace) -> Iterator[tuple[str | float | None, ...]]:
    """A row for each audit."""
    from audits.measure import AUDITS

    return side_by_side(audit_row, options.jobs, list(AUDITS))


def is_right(row: Row) -> bool:
    """Whether the search names exactly the terms of the calculation by hand."""
    return not (row["missing"] or row["false"])


def claim(rows: Rows) -> str:
    """How many agree and how many differences are named."""
    right = [row for row in rows if not row["differs"]]
    named = [row for row in rows if row["named"]]
    wrong = sum(not is_right(row) for row in rows)
    return (
        f"Of {len(rows)} public models by others {len(right)} agree in all that is compared and "
        f"{len(rows) - len(right)} differ; of {len(named)} of these the wrong terms are named, of {wrong} others than "
        "by hand"
    )


SOURCE = re.compile(r"github\.com/([\w.-]+/[\w.-]+), ([\w./-]+), ([0-9a-f]{8})")

"""Repository, file and revision."""


def with_links(rows: Rows) -> Rows:
    """The rows with their source behind the finding, as links."""

    def link(file: re.Match[str]) -> str:
        return f"[{PurePosixPath(file[2]).name}, {file[3]}](https://github.com/{file[1]}/blob/{file[3]}/{file[2]})"

    titles = ("model", "finding", "differs", "largest difference")
    words = [f"{row['finding']} {SOURCE.sub(link, row['source'])}" for row in rows]
    return [{title: row[title] for title in titles} | {"finding": text} for row, text in zip(rows, words, strict=True)]


TABLES = {
    "audits": Table(
        measure,
        {
            "model": "{}", "source": "{}", "digits that agree": "{}", "differs": "{}", "largest difference": "{:.1%}",
            "finding": "{}", "named": "{}", "missing": "{}", "false": "{}",
        },
        claim,
        is_right,
        "[How a model is audited](judging.md#published-models).",
        with_links,
    )
}  # fmt: skip
