"""Tables of the page, from the data of a run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from mahovik_bench.slopes import slope
from mahovik_bench.targets import SCALAR, counted, least, verdicts
from mahovik_bench.works import WORKS

Results = dict[str, Any]


Table = dict[str, Any]
"""A table as it is kept: `head` and `rows` of cells."""


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
    """A table of cells."""
    return {"head": list(head), "rows": [list(row) for row in rows]}


def text(kept: Table) -> str:
    """A Markdown table; all columns but the first to the right."""
    lines = [kept["head"], ["---", *["---:"] * (len(kept["head"]) - 1)], *kept["rows"]]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def names(results: Results, work: str) -> list[str]:
    """Who has the work, ours first, in the order of their roster."""
    found: dict[str, None] = {}
    for one in results["cases"].values():
        found |= dict.fromkeys(one["times"]["independent"][work])
        found |= dict.fromkeys(name for name, counts in one["instructions"].items() if work in counts)
    return sorted(found, key=lambda name: not name.startswith("mahovik "))


def ns(value: float) -> str:
    """Three digits."""
    return f"{value:,.0f}" if value >= 100 else f"{value:.1f}"


def work_table(results: Results, work: str) -> Table:
    """Times: least, median and median chained, by contestant and N."""
    Ns = list(results["cases"])
    head = [f"`{work}`: least / median / chained", *(f"N = {N}" for N in Ns)]
    rows = []
    for name in names(results, work):
        cells = []
        for one in results["cases"].values():
            alone, chain = (one["times"][mode][work].get(name) for mode in ("independent", "chained"))
            shown = [ns(alone["least"]), ns(alone["median"])] if alone else []
            cells.append(" / ".join([*shown, *([ns(chain["median"])] if chain else [])]))
        if any(cells):
            rows.append([name, *cells])
    return table(head, rows)


def ratio_table(results: Results, work: str) -> Table:
    """How many times faster than each other contestant the scalar build is."""
    rows = []
    for name in names(results, work):
        if name == SCALAR:
            continue
        cells = []
        for one in results["cases"].values():
            row = one["times"]["independent"][work].get(name)
            cells.append("" if row is None or SCALAR not in row["ratios"] else f"{row['ratios'][SCALAR]:.2f}")
        if any(cells):
            rows.append([name, *cells])
    return table([f"`{work}`: time over that of {SCALAR}", *(f"N = {N}" for N in results["cases"])], rows)


def count_table(results: Results, work: str) -> Table:
    """Instructions of a call."""
    rows = []
    for name in names(results, work):
        by_N = counted(results, work, name)
        if by_N:
            rows.append([name, *(f"{by_N[int(N)]:,.0f}" if int(N) in by_N else "" for N in results["cases"])])
    return table([f"`{work}`: instructions", *(f"N = {N}" for N in results["cases"])], rows)


def slope_table(results: Results) -> Table:
    """Cost of a further flywheel."""
    rows = []
    for work in WORKS:
        for name in names(results, work):
            line, counts = slope(least(results, work, name)), slope(counted(results, work, name))
            if line is None and counts is None:
                continue
            cells = [f"{line[0]:.1f}", f"{line[1]:.0f}"] if line else ["", ""]
            cells += [f"{counts[0]:.0f}", f"{counts[1]:.0f}"] if counts else ["", ""]
            rows.append([f"`{work}`, {name}", *cells])
    return table(["", "ns a flywheel", "ns at none", "instructions a flywheel", "instructions at none"], rows)


def made_table(results: Results) -> Table:
    """Size, compile time, generation."""
    rows = []
    for N, one in results["cases"].items():
        for name, made in one["made"].items():
            effort = made["generated"]
            generated = [f"{effort['seconds']:.1f}", f"{effort['memory']:.0f}"] if effort["seconds"] else ["", ""]
            compiled = [f"{made['compiled']['seconds']:.1f}", f"{made['compiled']['memory']:.0f}"]
            rows.append([f"N = {N}, {name}", f"{made['text']:,}", f"{made['data']:,}", *compiled, *generated])
    head = ["", "code, bytes", "constants, bytes", "C compile, s", "its memory, MB", "generation, s", "its memory, MB"]
    return table(head, rows)


def agreement_table(results: Results) -> Table:
    """The largest difference to the reference over its natural scale."""
    found: dict[tuple[str, str], dict[str, float]] = {}
    for N, one in results["cases"].items():
        for work, by_name in one["agreement"].items():
            for name, worst in by_name.items():
                found.setdefault((work, name), {})[N] = worst
    rows = [
        [f"`{work}`, {name}", *(f"{by_N[N]:.0e}" if N in by_N else "" for N in results["cases"])]
        for (work, name), by_N in found.items()
    ]
    return table(["", *(f"N = {N}" for N in results["cases"])], rows)


def target_table(results: Results) -> Table:
    """Table of the targets: what was asked for, what was measured, and whether it was reached."""
    words = {True: "reached", False: "**not reached**", None: "not measured"}
    rows = [[v.what, v.N, v.asked, v.found, words[v.reached]] for v in verdicts(results)]
    return table(["", "N", "asked", "found", "verdict"], rows)


def won_by_peers(results: Results) -> list[str]:
    """Where a peer is faster than our scalar build, or has fewer instructions; whether than all of ours."""
    return [
        line
        for work in WORKS
        for N, one in results["cases"].items()
        for line in (
            *_faster(one["times"]["independent"][work], f"`{work}`, N = {N}"),
            *_faster(one["times"]["chained"][work], f"`{work}`, N = {N}, chained"),
            *_shorter({n: c[work] for n, c in one["instructions"].items() if work in c}, f"`{work}`, N = {N}"),
        )
    ]


def _faster(times: Mapping[str, Any], where: str) -> Iterator[str]:
    """Lines about the times of one work."""
    for name, row in times.items():
        if name.startswith("mahovik ") or row["ratios"].get(SCALAR, 1.0) >= 1.0:
            continue
        ours = max(row["ratios"], key=lambda build: row["ratios"][build])
        best = row["ratios"][ours]
        rest = "and than every other build of ours" if best < 1.0 else f"not than {ours}: {best:.2f}"
        yield f"{where}: {name} is faster than {SCALAR} ({row['ratios'][SCALAR]:.2f}), {rest}"


def _shorter(counts: Mapping[str, int], where: str) -> Iterator[str]:
    """Lines about the instructions of one work."""
    own = counts.get(SCALAR)
    for name, count in counts.items():
        if own is not None and not name.startswith("mahovik ") and count < own:
            yield f"{where}: {name} has fewer instructions than {SCALAR}, {count:,} against {own:,}"
