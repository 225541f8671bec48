"""Cost of the C of the stand: operations of its program; code, stack and instructions on processors."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from markupsafe import Markup

from mahovik.core.emit.manifest import digest
from mahovik.core.program.cost import cost
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.board import compile_one, version
from mahovik.core.toolchain.footprint import STACK_FLAGS, footprint
from mahovik.core.toolchain.targets import TARGETS, Target
from mahovik.errors import ToolchainError
from mahovik.out.report.stand.markup import Cell, markup_of, table
from mahovik.out.report.stand.material import Material, Section, generate_once
from mahovik.proof.cost.measure import TargetCost, measure
from mahovik.proof.verify.targets import parse_targets

COMPILED_TARGETS = (("m7", "double"),)
"""Compiled for where nothing was measured: code and stack are the compiler's, and need no emulator."""


@dataclass(frozen=True)
class Figures:
    """Figures by function for a target and element type; `words`: processor, compiler, flags. `instructions`: or {}.

    `text`: bytes of code of the whole file; `source`: SHA-256 of the C.
    """

    target: str
    real: str
    words: str
    source: str
    instructions: Mapping[str, int]
    stack: Mapping[str, int]
    code: Mapping[str, int]
    text: int

    @property
    def name(self) -> str:
        """Target and element type."""
        return f"{self.target}, {self.real}"


def section(material: Material) -> Section | None:
    """Operations always; figures of `--cost` or `--targets`, else of the compilers that are here."""
    stand, file = material.stand, material.stand_file or f"{material.stand.name}.toml"
    missing: list[str] = []
    if material.costs:
        found, origin = (
            [_accepted_figures(each) for each in material.costs],
            f"from {material.cost_file}, by `mahovik cost`",
        )
    elif material.targets:
        found, origin = _measure_on_targets(stand, material.targets, missing), "measured when this report was made"
    else:
        found, origin = _compile_sizes(stand, missing), "of the compiler, when this report was made"
    missing += [] if any(each.instructions for each in found) else ["instructions: an emulator counts them"]
    html = markup_of(
        "cost",
        origin=origin.replace("`", "``"),
        operations=_operations(stand),
        figures=found,
        tables=[_table(each) for each in found],
        refused=any(not count for each in found for count in each.instructions.values()),
        other=[each.name for each in found if each.source != _source(stand, each.real)],
        missing=missing,
        file=file,
    )
    return Section("cost", "Cost on processors", html)


def _operations(stand: Stand) -> Markup:
    lines: list[list[Cell]] = []
    program = generate_once(stand).program
    for function in program.functions:
        if function.public:
            c = cost(function, program.functions)
            counts = (c.additions, c.multiplications, c.divisions, c.comparisons, c.total)
            lines.append([Markup("<code>{}</code>").format(function.name), *map(_count, counts)])
    head = ("function", "additions>", "products>", "divisions>", "comparisons>", "all>")
    return table(head, [lines])


def _table(given: Figures) -> Markup:
    """Figures of a target, function by function."""
    counted = ("instructions>",) if given.instructions else ()
    lines: list[list[Cell]] = []
    for name in given.code:
        count = given.instructions.get(name, 0)
        own = [_count(count) if count else "refused"] if counted else []
        sizes = [_count(sizes[name]) if name in sizes else "" for sizes in (given.stack, given.code)]
        lines.append([Markup("<code>{}</code>").format(name), *own, *sizes])
    foot = ["whole file", *("" for _ in counted), "", _count(given.text)]
    return table(("function", *counted, "stack, bytes>", "code, bytes>"), [lines], given.name, foot)


def _count(number: int) -> str:
    return f"{number:,}".replace(",", "\u202f") if number >= 10_000 else str(number)


def _source(stand: Stand, real: str) -> str:
    return digest(generate_once(stand, real).files[f"{stand.name}.c"])


def _accepted_figures(given: Mapping[str, Any]) -> Figures:
    """Figures of a target in cost.json."""
    by = {each["function"]: each for each in given["functions"]}
    counter = f"; instructions counted by {given['emulator']}" if given.get("emulator") else ""
    return Figures(
        given["target"], given["real"],
        f"{given.get('title', given['target'])}; {given['compiler']} ``{given.get('flags', '')}``{counter}",
        str(given.get("source", "")),
        {name: each["instructions"] for name, each in by.items() if "instructions" in each},
        {name: each["stack"] for name, each in by.items() if "stack" in each},
        {name: each["code"] for name, each in by.items() if "code" in each},
        given["text"],
    )  # fmt: skip


def _measure_on_targets(stand: Stand, names: str, missing: list[str]) -> list[Figures]:
    """On the targets of `--targets` that a gcc compiles, one by one; what cannot be is added to `missing`."""
    found = []
    for target, real in parse_targets(names):
        if target.linker or target.compiler[0] == "clang":
            missing.append(f"{target.name}, {real}: compiled by clang; frames of the stack are known of gcc only")
            continue
        try:
            found.append(_target_figures(measure(stand, [(target, real)]).targets[0]))
        except ToolchainError as error:
            missing.append(f"{target.name}, {real}: {error}")
    return found


def _target_figures(given: TargetCost) -> Figures:
    counter = f"; instructions counted by {given.emulator or 'callgrind'}"
    return Figures(
        given.target, given.real, f"{given.title}; {given.compiler} ``{given.flags}``{counter}", given.source,
        {f.function: f.instructions for f in given.functions}, {f.function: f.stack for f in given.functions},
        {f.function: f.code for f in given.functions}, given.text,
    )  # fmt: skip


def _compile_sizes(stand: Stand, missing: list[str]) -> list[Figures]:
    """Code and stack by the compilers of COMPILED_TARGETS; those that are not here are added to `missing`."""
    found = []
    for name, real in COMPILED_TARGETS:
        target = TARGETS[name]
        if shutil.which(target.compiler[0]) is None:
            missing.append(f"{name}, {real}: no {target.compiler[0]}: apt-get install {' '.join(target.packages)}")
            continue
        try:
            found.append(_object(stand, target, real))
        except ToolchainError as error:
            missing.append(f"{name}, {real}: {error}")
    return found


def _object(stand: Stand, target: Target, real: str) -> Figures:
    made = generate_once(stand, real)
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as folder:
        scratch = Path(folder)
        for name, text in made.files.items():
            (scratch / name).write_text(text, encoding="utf-8")
        compiled = compile_one(target, f"{stand.name}.c", scratch, target.optimisation, STACK_FLAGS)
        size = footprint(target.compiler[0], compiled)
    public = [f.name for f in made.program.functions if f.public]
    command = f"{version(target.compiler[0])} ``{' '.join((*target.compiler[1:], target.optimisation))}``"
    return Figures(
        target.name, real, f"{target.title}; {command}", _source(stand, real), {},
        {name: size.stack_of(f"{stand.name}_{name}") for name in public},
        {name: size.code_of(f"{stand.name}_{name}") for name in public}, size.text,
    )  # fmt: skip
