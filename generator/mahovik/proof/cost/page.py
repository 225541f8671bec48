"""COST.md: what a stand's C costs, as a page; and the same as JSON, to compare with later."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

from mahovik import __version__
from mahovik.errors import UsageError
from mahovik.proof.cost.check import COMPARED_FIGURES
from mahovik.proof.cost.measure import STATES, Costs, TargetCost


def page(costs: Costs) -> str:
    """COST.md, the same text for the same figures."""
    sources = "".join(f"\n{real}: {source}" for real, source in sorted({(t.real, t.source) for t in costs.targets}))
    text = (
        f"# Cost of {costs.stand}\n\n"
        f"Written by `mahovik cost`, version {__version__}; structure {costs.structure}, physics {costs.physics}.\n"
        f"Figures of one call with its arguments, at the most expensive of {STATES} ordinary states. "
        "**Instructions, not\n"
        "cycles**: they show what grows; time on silicon depends on memory and pipeline as well.\n\n"
        "*Stack* is the deepest chain of calls by the compiler's own frames; *painted* is what a call was seen to use "
        "on the\nemulator. *Code* is a function with all it calls; functions share most of it.\n\n"
        "What `inverse` costs depends on the state, by limits and damping: its count is of these states, others cost "
        "more.\nThe bytes of a flywheel are those of the table; parameters and options come on top, and "
        "`--gc-sections` drops them\nwhere the program does not name them.\n\n"
        "A step of the recorder (`recorder_step`) is one whose state nothing but steps has written to; taking the "
        "record is not\ncounted. Its painted stack has a frame of the measuring program in it.\n\n"
        f"SHA-256 of the measured `{costs.stand}.c`, by element type:\n\n```text{sources}\n```\n"
    )
    for target in costs.targets:
        text += _target(costs, target)
    return text + _code(costs)


def _target(costs: Costs, found: TargetCost) -> str:
    counted = f"counted by {found.emulator}" if found.emulator else "counted by callgrind"
    text = f"\n## {found.title}: {found.target}, {found.real}\n\n{found.compiler} `{found.flags}`; {counted}.\n\n"
    rows = []
    for f in found.functions:
        calls = f"{f.code:,}{'*' if f.routines else ''}"
        rows.append(
            [
                f"`{f.function}`",
                f"{f.instructions:,}" if f.instructions else "refused",
                f"{f.stack:,}",
                f"{f.painted:,}" * bool(f.painted),
                calls,
            ]
        )
    text += _table(["function", "instructions", "stack, bytes", "painted", "code, bytes"], rows)
    if not all(f.instructions for f in found.functions):
        text += "\nRefused: these states are none for it; `inverse_fast` wants six independent flywheels, or damping.\n"
    routines = sorted({name for f in found.functions for name in f.routines})
    if routines:
        names = ", ".join(f"`{name}`" for name in routines)
        text += f"\n\\* and {names} of the compiler's library, counted in instructions and painted stack only.\n"
    constants = ", ".join(f"`{name}` {size:,}" for name, size in found.constants.items())
    text += (
        f"\nWhole file: {found.text:,} bytes of code; constants: {constants}, literals of the code {found.unnamed:,}.\n"
    )
    if found.flywheel:
        each = ", ".join(f"`{costs.stand}_{name}` {size}" for name, size in found.flywheel.items())
        text += f"Of these, a flywheel takes: {each}.\n"
    return text


def _code(costs: Costs) -> str:
    """How many bytes each function has by itself, by target, with what the compiler cut off it."""
    columns = []
    for target in costs.targets:
        sizes: Counter[str] = Counter()
        for symbol, size in target.symbols.items():
            sizes[symbol.partition(".")[0].removeprefix(f"{costs.stand}_")] += size
        columns.append(sizes)
    names = sorted(set().union(*columns))
    rows = [[f"`{name}`", *(f"{c[name]:,}" if name in c else "" for c in columns)] for name in names]
    head = ["own code, bytes", *(f"{t.target}, {t.real}" for t in costs.targets)]
    return "\n## Code by function\n\nA function that is not there was compiled into its callers.\n\n" + _table(
        head, rows
    )


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [head, ["---", *["---:"] * (len(head) - 1)], *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def as_json(costs: Costs, before: Sequence[Mapping[str, Any]] = ()) -> str:
    """The figures as JSON; those of `before` for other targets and element types stay."""
    new = {(t.target, t.real): asdict(t) for t in costs.targets}
    kept = {(old["target"], old["real"]): old for old in before}
    return json.dumps({**asdict(costs), "targets": list((kept | new).values())}, indent=1) + "\n"


def read_accepted_costs(text: str, where: str) -> list[dict[str, Any]]:
    """The targets of a JSON of `as_json`. Raises UsageError."""
    try:
        found = json.loads(text)["targets"]
        good = all(_is_target(target) for target in found)
    except (ValueError, RecursionError, KeyError, TypeError, AttributeError):
        good = False
    if not good:
        raise UsageError(f"{where}: no figures of `mahovik cost`: restore it, or move it away and accept again")
    return list(found)


def _is_target(found: Mapping[str, Any]) -> bool:
    figures = [found["text"], *found["constants"].values()]
    figures += [f[what] for f in found["functions"] for what in COMPARED_FIGURES if what in f]
    names = [found["target"], found["real"], found["compiler"], *(f["function"] for f in found["functions"])]
    return all(type(n) is int and n >= 0 for n in figures) and all(isinstance(name, str) for name in names)
