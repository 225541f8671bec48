"""docs/results/benchmarks.md and its plots, from the data of a run. Nothing on the page is typed but its words."""

from __future__ import annotations

import statistics
from typing import Any

from mahovik_bench import tables
from mahovik_bench.plot import plot
from mahovik_bench.targets import SCALAR, least
from mahovik_bench.works import WORKS

Results = dict[str, Any]

PAGE = "docs/results/benchmarks.md"
PLOTTED = ("forward", "coupled", "torque")
QUIET = 0.1
"""A median spread beyond this is called out."""

INTRODUCTION = """# Benchmarks

Written by `make bench`: a free carrier with unbalanced, asymmetric flywheels, no gravity, no fluid; every body is a
cloud of point masses. All libraries are loaded into one process, get the same states, and take turns in short blocks.
A ratio is the median over repetitions of paired blocks; *least* and *median* are of all blocks. Times are in ns,
independent calls unless a table says *chained*, where each call waits for the result of the one before.

## Read this first

* **Nothing of a peer is slow by fault of its own.** Pinocchio and MuJoCo take any tree of joints at run time; MuJoCo
  does more in a call (sensors, tendons, energy). RNEA and `mj_inverse` give the wrench on the carrier as well, while
  `torque` gives the torques alone. `forward` for given accelerations is nothing that they offer: for Pinocchio it is
  put together from CRBA, RNEA and Eigen's LDLT of the carrier's block, and MuJoCo has none.
* **The expressions for CasADi, SymPy and SymForce are the literal equations**, as one writes them from the paper, with
  zeros left out. Tables of harmonics, derived by hand and given to CasADi, would be another peer, which is not here.
* mahovik checks every input on every call; the peers check none.
* CasADi generates faster than mahovik, and of few flywheels it compiles faster as well: see the sizes. CasADi's
  Jacobian is given for two flywheels only, since its C grows too large to compile in the time there is; `inverse` and
  `step` are nothing that the peers offer in C.
* Straight code of the *native* builds may be fused by gcc 12 in spite of `-ffp-contract=off`; where the bits matter it
  takes [one more flag](../targets.md#what-changes-the-bits).
* *batch* takes 64 states in a call, side by side in vectors: its times are a state's, and none is chained. Its bits
  are those of single calls, so it has no fused multiply-add, which bounds it where a peer's build may use them.
* Instructions are those of one call at one state, counted by callgrind, which knows no AVX-512: builds for this
  processor are timed and not counted, and Pinocchio is counted in a build for AVX2. Instructions are exact, but no
  time: vector builds have fewer and longer ones.
* Compile times are wall-clock, two at a time, on the machine as it was.
"""

TARGETS = """## Targets

Of the scalar build (-O2), of flywheels across the host's lanes, of batches: how many times faster than the best build
of the best peer that was timed at that number of flywheels (median of paired ratios). The ratios asked for come from a
prototype on another processor, where the prototype's C was faster than ours is here and CasADi's slower; those of
instructions depend on no processor.

"""

SIZES = """
Generation: the whole process, imports included. MuJoCo comes compiled: its row is of our adapter alone. Pinocchio's is
of all that its headers instantiate, for any joints. Compile times are those of when a library entered the cache,
on a machine that did other work as well.
"""


def page(results: Results) -> str:
    """The text of the page."""
    parts = [INTRODUCTION, _state(results), _who(results), TARGETS, tables.target_table(results)]
    parts += ["\n## Where a peer is faster\n\n", _won(results)]
    parts.append("\n## Times\n")
    for work in WORKS:
        parts.append(f"\n### {work}\n\n{WORKS[work].meaning}.\n\n")
        if work in PLOTTED:
            parts.append(f"![{work}: ns over the number of flywheels](benchmarks-{work}.svg)\n\n")
        parts.append(tables.work_table(results, work))
        if any(not name.startswith("mahovik ") for name in tables.names(results, work)):
            parts += ["\n", tables.ratio_table(results, work)]
        if any(one["instructions"] for one in results["cases"].values()):
            parts += ["\n", tables.count_table(results, work)]
    parts += [
        "\n## A further flywheel\n\nStraight lines through least times and counts.\n\n",
        tables.slope_table(results),
    ]
    parts += ["\n## Size, compiling, generation\n\n", tables.made_table(results)]
    parts += [SIZES]
    parts += ["\n## Agreement\n\nThe largest difference to the NumPy reference, relative to the "]
    parts += ["[natural scale](../verification.md#the-natural-scale).\n\n", tables.agreement_table(results)]
    parts += ["\nSlopes: of the peers to ours, over the largest element of a block.\n"]
    return "".join(parts)


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


def _state(results: Results) -> str:
    """The state of the machine, and a warning where it was busy."""
    load, spread = results["load"], median_spread(results)
    cores = int(results["machine"]["cores"])
    text = (
        f"* In this run {load['before']:.1f} processes wanted to run before the timing and {load['after']:.1f} "
        f"after it, on {cores} cores;\n  the median block was {spread:.1%} above the fastest "
        "(median over contestants).\n"
    )
    if spread > QUIET or load["before"] > cores:
        text += "* **The machine was busy.** Ratios of paired blocks and counts hold; single times may not.\n"
    return text


def _who(results: Results) -> str:
    """Machine, versions, flags, who is absent."""
    text = "\n## Machine, versions, flags\n\n"
    text += "".join(f"* {key}: {value}\n" for key, value in results["machine"].items())
    text += "* " + ", ".join(f"{name} {version}" for name, version in results["versions"].items()) + "\n"
    text += f"* {results['repetitions']} repetitions\n\n"
    text += tables.table(["build", "flags"], [[name, f"`{flags}`"] for name, flags in results["flags"].items()])
    if results["absent"]:
        text += "\nNot here:\n\n"
        text += "".join(f"* {name}: {why}\n" for name, why in sorted(results["absent"].items()))
    return text + "\n"


def _won(results: Results) -> str:
    lines = tables.won_by_peers(results)
    if not lines:
        return f"Nowhere in this run: {SCALAR} is faster than every peer in every work that both have.\n"
    return "".join(f"* {line}\n" for line in lines)
