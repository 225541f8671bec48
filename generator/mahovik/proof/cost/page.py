"""What a stand's C costs: COST.md, the same as JSON to compare with later, and what has risen since."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from mahovik import __version__
from mahovik.errors import UsageError
from mahovik.proof.cost.measure import STATES, Costs, TargetCost

RISE = 0.02
"""Least relative rise that counts: figures of one compiler are the same in every run, without noise."""

COMPARED_FIGURES = ("instructions", "stack", "code")
"""Figures of a function that are compared."""


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
    return text + "".join(_target(costs, target) for target in costs.targets) + _code(costs)


def _target(costs: Costs, target: TargetCost) -> str:
    counted = f"counted by {target.emulator or 'callgrind'}"
    text = f"\n## {target.title}: {target.target}, {target.real}\n\n{target.compiler} `{target.flags}`; {counted}.\n\n"
    rows = [
        [
            f"`{f.function}`",
            f"{f.instructions:,}" if f.instructions else "refused",
            f"{f.stack:,}",
            f"{f.painted:,}" * bool(f.painted),
            f"{f.code:,}{'*' if f.routines else ''}",
        ]
        for f in target.functions
    ]
    text += _table(["function", "instructions", "stack, bytes", "painted", "code, bytes"], rows)
    if not all(f.instructions for f in target.functions):
        text += "\nRefused: these states are none for it; `inverse_fast` wants six independent flywheels, or damping.\n"
    if routines := sorted({name for f in target.functions for name in f.routines}):
        names = ", ".join(f"`{name}`" for name in routines)
        text += f"\n\\* and {names} of the compiler's library, counted in instructions and painted stack only.\n"
    sizes = ", ".join(f"`{name}` {size:,}" for name, size in target.constants.items())
    text += (
        f"\nWhole file: {target.text:,} bytes of code; constants: {sizes}, literals of the code {target.unnamed:,}.\n"
    )
    if target.flywheel:
        shares = ", ".join(f"`{costs.stand}_{name}` {size}" for name, size in target.flywheel.items())
        text += f"Of these, a flywheel takes: {shares}.\n"
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
    words = "A function that is not there was compiled into its callers."
    return f"\n## Code by function\n\n{words}\n\n{_table(head, rows)}"


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
        targets = json.loads(text)["targets"]
        good = all(_is_target(target) for target in targets)
    except (ValueError, RecursionError, KeyError, TypeError, AttributeError):
        good = False
    if not good:
        raise UsageError(f"{where}: no figures of `mahovik cost`: restore it, or move it away and accept again")
    return list(targets)


def _is_target(target: Mapping[str, Any]) -> bool:
    figures = [target["text"], *target["constants"].values()]
    figures += [f[what] for f in target["functions"] for what in COMPARED_FIGURES if what in f]
    names = [target["target"], target["real"], target["compiler"], *(f["function"] for f in target["functions"])]
    return all(type(n) is int and n >= 0 for n in figures) and all(isinstance(name, str) for name in names)


@dataclass(frozen=True)
class Comparison:
    """`rises`: a line each; `missing`: what has no accepted figures and should, or is not there any more; `compared`:
    targets with the compiler of the accepted figures; `other`: why the rest was not compared.
    """

    rises: tuple[str, ...]
    missing: tuple[str, ...]
    compared: tuple[str, ...]
    other: tuple[str, ...]


def compare(
    costs: Costs, accepted: Sequence[Mapping[str, Any]], required: Sequence[tuple[str, str]] = ()
) -> Comparison:
    """Each target against the accepted figures of that target, element type and compiler.

    `required`: targets and element types that must have accepted figures, measured or not.
    """
    rises: list[str] = []
    compared, other = [], []
    before = {(old["target"], old["real"]): old for old in accepted}
    missing = [f"{target}, {real}" for target, real in dict.fromkeys(required) if (target, real) not in before]
    for new in costs.targets:
        name = f"{new.target}, {new.real}"
        old = before.get((new.target, new.real))
        if old is None:
            if name not in missing:
                other.append(f"{name}: no accepted figures")
        elif old["compiler"] != new.compiler:
            other.append(f"{name}: accepted figures are of {old['compiler']}, this is {new.compiler}")
        else:
            compared.append(name)
            rises += (f"{name}: {line}" for line in _rises(old, new))
            missing += (f"{name}: {line}" for line in _missing(old, new))
    return Comparison(tuple(rises), tuple(missing), tuple(compared), tuple(other))


def _rises(old: Mapping[str, Any], new: TargetCost) -> Iterator[str]:
    before = {f["function"]: f for f in old["functions"]}
    pairs = [("code of the whole file", old["text"], new.text)]
    pairs += [(f"constants {table}", old["constants"].get(table), size) for table, size in new.constants.items()]
    for f in new.functions:
        accepted = before.get(f.function, {})
        pairs += [(f"{f.function}, {what}", accepted.get(what), getattr(f, what)) for what in COMPARED_FIGURES]
    for what, was, now in pairs:
        if was is not None and now > was * (1 + RISE):
            more = f"{100 * (now - was) / was:.1f} % more" if was else "there was none"
            yield f"{what}: {was} accepted, now {now}, {more}"


def _missing(old: Mapping[str, Any], new: TargetCost) -> Iterator[str]:
    """Functions, their figures and tables that only one side has."""
    before = {f["function"]: f for f in old["functions"]}
    now = [f.function for f in new.functions]
    yield from (f"{name}, {what}" for name in now for what in COMPARED_FIGURES if what not in before.get(name, {}))
    yield from (f"{name}, which is not there any more" for name in before if name not in now)
    yield from (f"constants {table}" for table in new.constants if table not in old["constants"])
