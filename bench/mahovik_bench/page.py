"""docs/results/benchmarks.md and its plots, from the data of a run. Nothing on the page is typed but its words."""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from typing import Any

from mahovik_bench import tables
from mahovik_bench.plot import plot
from mahovik_bench.targets import SCALAR, least
from mahovik_bench.works import WORKS

Results = dict[str, Any]
Figures = dict[str, Any]

PLOTTED = ("forward", "coupled", "torque")
QUIET = 0.1
"""A median spread beyond this is called out."""

TARGETS = """## Targets

Instructions of the scalar build (-O2), checks included, depend on no processor. Times are compared within one run: the
flags that one tries first, `-O3 -march=native`, must not be slower than -O2 (median of paired ratios), and a state in a
batch is bounded by what `forward` takes there (least times). Ratios to the peers stand in the tables of each work.

"""

SIZES = """
Generation: the whole process, imports included. MuJoCo comes compiled: its row is the adapter alone. Pinocchio's is
of all that its headers instantiate, for any joints. Compile times are those of when a library entered the cache,
on a machine that did other work as well.
"""


def figures(results: Results) -> Figures:
    """The figures to keep, as the page shows them: lines, and tables of cells."""
    times = {}
    for work in WORKS:
        found = [tables.work_table(results, work)]
        if any(not name.startswith("mahovik ") for name in tables.names(results, work)):
            found.append(tables.ratio_table(results, work))
        if any(one["instructions"] for one in results["cases"].values()):
            found.append(tables.count_table(results, work))
        times[work] = found
    versions = ", ".join(f"{name} {version}" for name, version in results["versions"].items())
    machine = [f"{key}: {value}" for key, value in results["machine"].items()]
    return {
        "state": _state(results),
        "machine": [*machine, versions, f"{results['repetitions']} repetitions"],
        "flags": tables.table(["build", "flags"], [[name, f"`{flags}`"] for name, flags in results["flags"].items()]),
        "absent": [f"{name}: {why}" for name, why in sorted(results["absent"].items())],
        "targets": tables.target_table(results),
        "won": tables.won_by_peers(results),
        "times": times,
        "slopes": tables.slope_table(results),
        "made": tables.made_table(results),
        "agreement": tables.agreement_table(results),
    }


def page(found: Figures) -> str:
    """The part of the page that holds figures."""
    parts = [_lines(found["state"]), "\n## Machine, versions, flags\n\n", _lines(found["machine"]), "\n"]
    parts.append(tables.text(found["flags"]))
    if found["absent"]:
        parts += ["\nNot here:\n\n", _lines(found["absent"])]
    parts += ["\n", TARGETS, tables.text(found["targets"]), "\n## Where a peer is faster\n\n"]
    nowhere = f"Nowhere in this run: {SCALAR} is faster than every peer in every work that both have.\n"
    parts += [_lines(found["won"]) or nowhere, "\n## Times\n"]
    for work, of_work in found["times"].items():
        parts.append(f"\n### {work}\n\n{WORKS[work].meaning}.\n\n")
        if work in PLOTTED:
            parts.append(f"![{work}: ns over the number of flywheels](benchmarks-{work}.svg)\n\n")
        parts.append("\n".join(tables.text(each) for each in of_work))
    parts.append("\n## A further flywheel\n\nStraight lines through least times and counts.\n\n")
    parts += [tables.text(found["slopes"]), "\n## Size, compiling, generation\n\n", tables.text(found["made"]), SIZES]
    parts += ["\n## Agreement\n\nThe largest difference to the NumPy reference, relative to the "]
    parts += ["[natural scale](../verification.md#the-natural-scale).\n\n", tables.text(found["agreement"])]
    parts += ["\nSlopes: of the peers to ours, over the largest element of a block.\n"]
    return "".join(parts)


def _lines(lines: Sequence[str]) -> str:
    return "".join(f"* {line}\n" for line in lines)


def plots(results: Results) -> dict[str, str]:
    """SVG by path."""
    found = {}
    for work in PLOTTED:
        lines = {name: least(results, work, name) for name in tables.names(results, work)}
        drawn = {name: line for name, line in lines.items() if line}
        if drawn:
            found[f"docs/results/benchmarks-{work}.svg"] = plot(f"{work}: ns of a call, least", drawn)
    return found


def median_spread(results: Results) -> float:
    """How far medians lie above least times, over all contestants of compiled code."""
    found = [
        row["spread"]
        for one in results["cases"].values()
        for work in one["times"]["independent"].values()
        for name, row in work.items()
        if not name.startswith("numpy")
    ]
    return statistics.median(found) if found else 0.0


def _state(results: Results) -> list[str]:
    """The state of the machine, and a warning where it was busy."""
    load, spread = results["load"], median_spread(results)
    cores = int(results["machine"]["cores"])
    found = [
        f"In this run {load['before']:.1f} processes wanted to run before the timing and {load['after']:.1f} "
        f"after it, on {cores} cores;\n  the median block was {spread:.1%} above the fastest "
        "(median over contestants)."
    ]
    if spread > QUIET or load["before"] > cores:
        found.append("**The machine was busy.** Ratios of paired blocks and counts hold; single times may not.")
    return found
