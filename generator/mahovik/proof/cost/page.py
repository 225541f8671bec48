"""What a stand's C costs: COST.md, the same as JSON to compare with later, and what has risen since.

Both files lie beside the C and are no part of its delivery: the manifest does not list them.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from mahovik import __version__
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand.content import content
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.proof.cost.measure import STATES, Costs, TargetCost
from mahovik.proof.verify.delivery import COST_PAGE, FIGURES, delivered_options, is_cost_page, require_own

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
        "more.\n`--gc-sections` drops parameters and options that the program does not name.\n\n"
        "A step of the recorder (`recorder_step`) is one whose state nothing but steps has written to; taking the "
        "record is not\ncounted. Its painted stack has a frame of the measuring program in it.\n\n"
        f"SHA-256 of the measured `{costs.stand}.c`, by element type:\n\n```text{sources}\n```\n"
    )
    return text + "".join(map(_target, costs.targets))


def _target(target: TargetCost) -> str:
    rows = [
        ("function", "instructions", "stack, bytes", "painted", "code, bytes"),
        ("---", *["---:"] * 4),
        *(
            (
                f"`{f.function}`",
                f"{f.instructions:,}" if f.instructions else "refused",
                f"{f.stack:,}",
                f"{f.painted:,}" * bool(f.painted),
                f"{f.code:,}{'*' if f.routines else ''}",
            )
            for f in target.functions
        ),
    ]
    counted = f"counted by {target.emulator or 'callgrind'}"
    text = f"\n## {target.title}: {target.target}, {target.real}\n\n{target.compiler} `{target.flags}`; {counted}.\n\n"
    text += "".join(f"| {' | '.join(row)} |\n" for row in rows)
    if not all(f.instructions for f in target.functions):
        text += "\nRefused: these states are none for it; `inverse_fast` wants six independent flywheels, or damping.\n"
    if routines := sorted({name for f in target.functions for name in f.routines}):
        names = ", ".join(f"`{name}`" for name in routines)
        text += f"\n\\* and {names} of the compiler's library, counted in instructions and painted stack only.\n"
    sizes = ", ".join(f"`{name}` {size:,}" for name, size in target.constants.items())
    return (
        f"{text}\nWhole file: {target.text:,} bytes of code; constants: {sizes}, "
        f"literals of the code {target.unnamed:,}.\n"
    )


def as_json(costs: Costs, before: Sequence[Mapping[str, Any]] = ()) -> str:
    """The figures as JSON; those of `before` for other targets and element types stay."""
    new = {(t.target, t.real): asdict(t) for t in costs.targets}
    kept = {(old["target"], old["real"]): old for old in before}
    return json.dumps({**asdict(costs), "targets": list((kept | new).values())}, indent=1) + "\n"


def read_accepted_costs(folder: Path, stand: Stand) -> dict[str, Any] | None:
    """What `as_json` wrote for a stand into a folder; None where there is none. Raises UsageError."""
    path = folder / FIGURES
    if not path.is_file():
        return None
    try:
        costs = json.loads(content(path))
        names = [t[key] for t in costs["targets"] for key in ("target", "real", "compiler")]
        names += [f["function"] for t in costs["targets"] for f in t["functions"]]
        figures = [number for t in costs["targets"] for number in _figures(t).values()]
        good = all(type(n) is int and n >= 0 for n in figures) and all(isinstance(name, str) for name in names)
        if good and costs["stand"] == stand.name:
            return dict(costs)
    except (ValueError, RecursionError, KeyError, TypeError, AttributeError):
        pass
    raise UsageError(f"{path}: no figures of `mahovik cost` for {stand.name}: restore it, or move it away")


def require_place(folder: Path, stand: Stand) -> None:
    """Raises UsageError unless COST.md and cost.json of a stand may be written into a folder.

    That is one that is new or empty, or that holds this stand's C as its file gives it; COST.md there must be ours.
    """
    options = delivered_options(folder)
    if options is not None:
        require_own(folder, stand)
        made, source = generate_all(stand, options.real, options.only).files, folder / f"{stand.name}.c"
        if not source.is_file() or source.read_bytes() != made[source.name].encode():
            raise UsageError(
                f"{folder}: holds other C than the stand file gives: `mahovik generate` first, nothing was written"
            )
    elif folder.is_dir() and any(path.name not in (COST_PAGE, FIGURES) for path in folder.iterdir()):
        raise UsageError(
            f"{folder}: is neither empty nor a folder of `mahovik generate`: choose another, nothing was written"
        )
    if (folder / COST_PAGE).exists() and not is_cost_page(folder, stand):
        raise UsageError(
            f"{folder / COST_PAGE}: was not written by mahovik for {stand.name}: move it away or choose another "
            "folder, nothing was written"
        )


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
    for target in costs.targets:
        name, new = f"{target.target}, {target.real}", asdict(target)
        old = before.get((target.target, target.real))
        if old is None:
            other += [f"{name}: no accepted figures"] if name not in missing else []
            continue
        if old["compiler"] != new["compiler"]:
            other.append(f"{name}: accepted figures are of {old['compiler']}, this is {new['compiler']}")
            continue
        compared.append(name)
        was, functions = _figures(old), {f["function"] for f in new["functions"]}
        for what, now in _figures(new).items():
            if what not in was:
                missing.append(f"{name}: {what}")
            elif now > was[what] * (1 + RISE):
                more = f"{100 * (now - was[what]) / was[what]:.1f} % more" if was[what] else "there was none"
                rises.append(f"{name}: {what}: {was[what]} accepted, now {now}, {more}")
        gone = [f["function"] for f in old["functions"] if f["function"] not in functions]
        missing += [f"{name}: {function}, which is not there any more" for function in gone]
    return Comparison(tuple(rises), tuple(missing), tuple(compared), tuple(other))


def _figures(target: Mapping[str, Any]) -> dict[str, int]:
    """All figures of a target that are compared, by what they are of."""
    tables = {f"constants {table}": size for table, size in target["constants"].items()}
    functions = {
        f"{f['function']}, {what}": f[what] for f in target["functions"] for what in COMPARED_FIGURES if what in f
    }
    return {"code of the whole file": target["text"], **tables, **functions}
