"""Judge the public models of others in tests/audits, and write docs/results/audits.md.

python tools/audits_campaign.py [--jobs 2] [--write]

Exit status 1 where a term is named that the calculation by hand does not have, or one of it is missing.
"""

from __future__ import annotations

import math
import sys
from typing import Any

import campaign
from kept import Campaign, Columns, Figures

sys.path.insert(0, str(campaign.ROOT / "tests"))

LARGE = 1e-11
"""Differences over the natural scale above this are no rounding."""

TABLE = Columns({"model": "{}", "agrees": "{}", "digits": "{}", "differs": "{}", "largest difference": "{}"}, 2)


def row_of(name: str) -> dict[str, Any]:
    """The figures of an audit."""
    from audits.catalogue import AUDITS
    from audits.measure import measure

    audit = AUDITS[name]
    found = measure(audit)
    return {
        "name": name,
        "model": audit.title,
        "source": audit.source,
        "scope": audit.scope,
        "finding": audit.finding,
        "worst": found.worst,
        "agreeing": found.agreeing,
        "differing": list(found.differing),
        "named": [*found.faults, *found.named],
        "by hand": audit.wrong is not None and not found.missing,
        "false": list(found.false),
        "missing": list(found.missing),
    }


def cells(row: dict[str, Any]) -> list[Any]:
    """A line of the table."""
    differing, agreeing = row["differing"], row["agreeing"]
    digits = None if agreeing is None else f"{-math.log10(max(agreeing, 1e-16)):.0f}"
    agrees = "all" if not differing else "none" if agreeing is None else "the others"
    largest = f"{row['worst']:.1%}" if row["worst"] > 1e-3 else f"{row['worst']:.0e}"
    return [row["model"], agrees, digits, ", ".join(differing) or None, largest if row["worst"] > LARGE else None]


def page(found: Figures) -> str:
    """Summary, table, and a paragraph for each model that differs."""
    rows = found["rows"]
    right = [row for row in rows if not row["differing"]]
    named = [row for row in rows if row["named"]]
    false = sum(len(row["false"]) for row in rows)
    missing = sum(len(row["missing"]) for row in rows)
    text = (
        f"{len(rows)} comparisons: {len(right)} agree in everything that is compared, {len(rows) - len(right)} differ. "
        f"Of these {len(named)} differ in a fault or in a few terms, all of them named by the search: {missing} "
        f"missing, {false} false names.\n\n"
    )
    text += TABLE.text(TABLE.rows([cells(row) for row in rows])) + "\n"
    return text + "\n".join(section(row) for row in rows)


def section(row: dict[str, Any]) -> str:
    """Source, scope and finding of a model, and what is named."""
    text = f"## {row['model']}\n\n{row['source']}.\n\nCompared: {_small(row['scope'])}.\n\n{row['finding']}\n"
    for name in row["named"]:
        text += f"\n* {name}"
    if row["named"]:
        text += "\n"
    elif row["differing"]:
        text += "\nNothing is named: the difference is no sum of a few products of the dictionary.\n"
    return text


def _small(words: str) -> str:
    return words[:1].lower() + words[1:]


CAMPAIGN = Campaign(
    "audits",
    campaign.Block("docs/results/audits.md", "audits"),
    page,
)


def main() -> None:
    """Judges, prints; keeps the figures with --write."""
    given = campaign.parser(__doc__, jobs=2, write=False).parse_args()
    from audits.catalogue import AUDITS

    rows = list(campaign.map_rows(row_of, given.jobs, list(AUDITS)))
    for row in rows:
        print(row["name"], f"{row['worst']:.1e}", row["differing"], row["named"], row["false"], row["missing"])
    if given.write:
        CAMPAIGN.keep({"rows": rows})
    raise SystemExit(int(any(row["false"] or row["missing"] for row in rows)))


if __name__ == "__main__":
    main()
