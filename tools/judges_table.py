"""What outside judges say of the example stands: writes docs/judges.md, and its short table into README.md.

python tools/judges_table.py [--states 200]
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from mahovik.stand import load
from mahovik.stands import names, path
from mahovik.verify.judges.compare import JUDGES, MOTION, QUANTITIES, verify_judges
from mahovik.verify.judges.rigid import missing, stripped
from mahovik.verify.report import Report

ROOT = Path(__file__).resolve().parents[1]
BEGIN, END = "<!-- judges: tools/judges_table.py -->", "<!-- end of judges -->"
WORDS = (*QUANTITIES.values(), MOTION)


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table, numbers to the right."""
    lines = [head, ["---", *["---:"] * (len(head) - 1)], *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def worst(reports: Sequence[Report], judge: str, quantity: str) -> str:
    """The largest difference over stands; nothing where no stand has the quantity."""
    found = [row.worst for r in reports for row in r.rows if (row.want, row.quantity) == (judge, quantity)]
    return f"{max(found):.0e}" if found else ""


def short(reports: Sequence[Report], versions: Sequence[str]) -> str:
    """Quantities by judges: the worst of all stands."""
    rows = [[quantity, *(worst(reports, judge, quantity) for judge in JUDGES)] for quantity in WORDS]
    return table(["generated C against", *versions], rows)


def page(reports: Sequence[Report], dry: Sequence[str], versions: Sequence[str], states: int) -> str:
    """The whole page."""
    text = (
        "# Outside judges\n\n"
        "Written by `python tools/judges_table.py`. The generated C against multibody programs of others, given the "
        "same stand:\nthe largest difference relative to the natural scale "
        "([what that is](verification.md#the-natural-scale)), over "
        f"{states} random and extreme states a stand.\n"
        f"They know no fluid, suspension or legs; these were taken out of {', '.join(dry)}.\n"
    )
    for judge, version in zip(JUDGES, versions, strict=True):
        rows = [[quantity, *(worst([r], judge, quantity) for r in reports)] for quantity in WORDS]
        text += f"\n## {version}\n\n" + table(["quantity", *(r.stand for r in reports)], rows)
    return text


def with_table(readme: str, text: str) -> str:
    """README with the table between its markers."""
    before, rest = readme.split(BEGIN)
    return f"{before}{BEGIN}\n\n{text}\n{END}{rest.split(END)[1]}"


def main() -> None:
    """Run the judges, write both files. Exit status 1 where one disagrees."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--states", type=int, default=200)
    states = parser.parse_args().states
    stands = [load(path(name)) for name in names()]
    reports = [verify_judges(stripped(stand), count=states) for stand in stands]
    versions = [word.strip() for word in reports[0].judged.removeprefix("generated C against ").split(",")]
    dry = [f"`{stand.name}`" for stand in stands if missing(stand)]
    (ROOT / "docs" / "judges.md").write_text(page(reports, dry, versions, states), encoding="utf-8")
    readme = ROOT / "README.md"
    text = with_table(readme.read_text(encoding="utf-8"), short(reports, versions))
    readme.write_text(text, encoding="utf-8")
    raise SystemExit(0 if all(report.passed for report in reports) else 1)


if __name__ == "__main__":
    main()
