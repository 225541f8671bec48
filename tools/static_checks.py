"""Static checks of the example stands' C: compilers, analyser, cppcheck. Writes docs/results/static-checks.md.

python tools/static_checks.py [--stands bench8,...] [--jobs 2] [--page]

Exit status 1 at any warning, at a MISRA deviation or finding that core/toolchain/static_checks.py does not list with
its reason, and at a listed one that no stand has any more.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import campaign
from kept import Campaign, Columns, Figures

from mahovik.core.emit.delivery import delivery
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.stand import load
from mahovik.core.toolchain.static_checks import (
    COMPILERS,
    DEVIATIONS,
    STANDING_FINDINGS,
    count_by_rule,
    findings,
    version,
    warnings_of,
)
from mahovik.stands import names, path
from mahovik.writing import write_all

REALS = ("double", "float")


def write_folder(stand: str, real: str) -> tuple[Path, list[str]]:
    """The delivered folder under build/, and its sources for firmware: not the self-test, not the drivers of Eva."""
    folder = campaign.ROOT / "build" / "static-checks" / f"{stand}-{real}"
    write_all(folder, delivery(load(path(stand)), real))
    return folder, [f"{stand}.c", f"{stand}_recorder.c"]


def figures(counts: dict[tuple[str, str], Counter[str]]) -> Figures:
    """The figures to keep: counts by rule and stand, in double and float; reasons."""
    rows = [
        {"rule": rule, **{name: [counts[name, real][rule] for real in REALS] for name in _stands(counts)},
         "reason": reason}
        for rule, reason in {**DEVIATIONS, **STANDING_FINDINGS}.items()
    ]  # fmt: skip
    tools = ", ".join(version(tool) for tool in (*COMPILERS, "cppcheck"))
    return {"tools": tools, "stands": _stands(counts), "rows": rows}


def page(found: Figures) -> str:
    """Rules, counts stand by stand, reasons."""
    table = Columns({"rule": "{}", **dict.fromkeys(found["stands"], "{} / {}"), "reason": "{}"}, None)
    return f"{found['tools']}. Counts: double / float.\n\n{table.text(found['rows'])}"


CAMPAIGN = Campaign(
    "static-checks",
    campaign.Block("docs/results/static-checks.md", "misra: tools/static_checks.py"),
    page,
)


def _stands(counts: dict[tuple[str, str], Counter[str]]) -> list[str]:
    return list(dict.fromkeys(stand for stand, _ in counts))


def examine(stand: str, real: str) -> tuple[list[str], Counter[str]]:
    """Complaints of compilers and analyser about a stand's C, and its findings by rule."""
    folder, files = write_folder(stand, real)
    complaints = warnings_of(folder, [*files, f"{VERIFICATION}{stand}_selftest.c"])
    return [f"{stand} {real}: {line}" for line in complaints], count_by_rule(findings(folder, files))


def differences(counts: dict[tuple[str, str], Counter[str]], stands: Sequence[str]) -> list[str]:
    """A line for each rule that is not listed, and for each listed one that no example stand breaks."""
    seen = sum(counts.values(), Counter())
    listed = {**DEVIATIONS, **STANDING_FINDINGS}
    wrong = [
        f"{rule}: {number} times, and not among the listed deviations"
        for rule, number in seen.items()
        if rule not in listed
    ]
    if set(stands) == set(names()):
        wrong += [f"{rule}: listed, but no stand has it: take it from the list" for rule in listed if not seen[rule]]
    return wrong


def main() -> int:
    """Runs what is asked."""
    given = campaign.parser(__doc__, stands=",".join(names()), jobs=campaign.cores(), page=False).parse_args()
    stands = given.stands.split(",")
    pairs = [(stand, real) for stand in stands for real in REALS]
    found = dict(zip(pairs, campaign.map_rows(examine, given.jobs, *zip(*pairs, strict=True)), strict=True))
    wrong = [line for complaints, _ in found.values() for line in complaints]
    counts = {pair: counter for pair, (_, counter) in found.items()}
    wrong += differences(counts, stands)
    for line in wrong:
        print(line, file=sys.stderr)
    if given.page:
        CAMPAIGN.keep(figures(counts))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
