"""Static checks of the example stands' C: compilers, analyser, cppcheck. Writes docs/results/static-checks.md.

python tools/static_checks.py [--stands bench8,...] [--page]

Exit status 1 at any warning, at a MISRA deviation or finding that core/toolchain/static_checks.py does not list with
its reason, and at a listed one that no stand has any more.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import campaign

from mahovik.core.emit.delivery import delivery
from mahovik.core.stand import load
from mahovik.core.toolchain.static_checks import (
    COMPILERS,
    DEVIATIONS,
    KNOWN,
    counted,
    findings,
    version,
    warned,
)
from mahovik.stands import names, path

BLOCK = campaign.Block("docs/results/static-checks.md", "misra: tools/static_checks.py")
REALS = ("double", "float")


def written(stand: str, real: str) -> tuple[Path, list[str]]:
    """The delivered folder under build/, and its sources for firmware: not the self-test, not the drivers of Eva."""
    folder = campaign.ROOT / "build" / "static-checks" / f"{stand}-{real}"
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in delivery(load(path(stand)), real).items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder, [f"{stand}.c", f"{stand}_recorder.c"]


def page(counts: dict[tuple[str, str], Counter[str]]) -> str:
    """Rules, counts stand by stand, reasons."""
    rows = []
    for rule, reason in {**DEVIATIONS, **KNOWN}.items():
        cells = [" / ".join(str(counts[stand, real][rule]) for real in REALS) for stand in _stands(counts)]
        rows.append([rule, *cells, reason])
    head = ["rule", *_stands(counts), "reason"]
    tools = ", ".join(version(tool) for tool in (*COMPILERS, "cppcheck"))
    return f"{tools}. Counts: double / float.\n\n{campaign.table(head, rows, None)}"


def _stands(counts: dict[tuple[str, str], Counter[str]]) -> list[str]:
    return list(dict.fromkeys(stand for stand, _ in counts))


def judged(counts: dict[tuple[str, str], Counter[str]], stands: Sequence[str]) -> list[str]:
    """A line for each rule that is not listed, and for each listed one that no example stand breaks."""
    seen = sum(counts.values(), Counter())
    listed = {**DEVIATIONS, **KNOWN}
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
    given = campaign.parser(__doc__, stands=",".join(names()), page=False).parse_args()
    stands = given.stands.split(",")
    counts: dict[tuple[str, str], Counter[str]] = {}
    wrong: list[str] = []
    for stand in stands:
        for real in REALS:
            folder, files = written(stand, real)
            wrong += [f"{stand} {real}: {line}" for line in warned(folder, [*files, f"{stand}_selftest.c"])]
            counts[stand, real] = counted(findings(folder, files))
    wrong += judged(counts, stands)
    for line in wrong:
        print(line, file=sys.stderr)
    if given.page:
        BLOCK.write(page(counts))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
