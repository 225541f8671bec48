"""Cost of the C of the stand: operations of its program; code, stack and instructions on processors."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Mapping, Sequence
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
from mahovik.out.report.stand.generated import generated
from mahovik.out.report.stand.markup import Cell, paragraph, table, verdict
from mahovik.out.report.stand.material import Material
from mahovik.out.report.stand.section import Section
from mahovik.proof.cost.measure import TargetCost, measure
from mahovik.proof.verify.targets import asked

COMPILED = (("m7", "double"),)
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
        found, origin = [_accepted(each) for each in material.costs], f"from {material.cost_file}, by `mahovik cost`"
    elif material.targets:
        found, origin = _measured(stand, material.targets, missing), "measured when this report was made"
    else:
        found, origin = _compiled(stand, missing), "of the compiler, when this report was made"
    parts = [_introduction(origin), _operations(stand), _figures(found)]
    other = [each.name for each in found if each.source != _source(stand, each.real)]
    if other:
        words = f"Of other C than this version generates: {'; '.join(other)}. Measure again with `mahovik cost`."
        parts.append(Markup("<p>{}</p>\n").format(verdict(words, "warn")))
    missing += [] if any(each.instructions for each in found) else ["instructions: an emulator counts them"]
    if missing:
        lines = Markup("").join(Markup("<li>{}</li>").format(line) for line in missing)
        parts.append(Markup("<h3>Not measured here</h3>\n<ul>{}</ul>\n").format(lines))
        parts.append(Markup("<p><code>mahovik cost {}</code></p>\n").format(file))
    return Section("cost", "Cost on processors", Markup("").join(parts))


def _introduction(origin: str) -> Markup:
    return paragraph(
        "Operations are additions, multiplications, divisions and comparisons of reals in one call, the dearer of two "
        "branches. Code is a function with all it calls, functions share most of it; stack is the deepest chain of "
        f"calls by the compiler's own frames. Figures of processors: {origin.replace('`', '``')}."
    )


def _operations(stand: Stand) -> Markup:
    lines: list[list[Cell]] = []
    program = generated(stand).program
    for function in program.functions:
        if function.public:
            c = cost(function, program.functions)
            counts = (c.additions, c.multiplications, c.divisions, c.comparisons, c.total)
            lines.append([Markup("<code>{}</code>").format(function.name), *map(_count, counts)])
    head = ("function", "additions>", "products>", "divisions>", "comparisons>", "all>")
    return Markup("<h3>Operations of a call</h3>\n") + table(head, [lines])


def _figures(found: Sequence[Figures]) -> Markup:
    """A table of each target."""
    if not found:
        return Markup("")
    parts = [Markup('<h3>On processors</h3>\n<div class="side">\n')]
    for each in found:
        counted = ("instructions>",) if each.instructions else ()
        lines: list[list[Cell]] = []
        for name in each.code:
            count = each.instructions.get(name, 0)
            own = [_count(count) if count else "refused"] if counted else []
            sizes = [_count(sizes[name]) if name in sizes else "" for sizes in (each.stack, each.code)]
            lines.append([Markup("<code>{}</code>").format(name), *own, *sizes])
        foot = ["whole file", *("" for _ in counted), "", _count(each.text)]
        head = ("function", *counted, "stack, bytes>", "code, bytes>")
        parts.append(table(head, [lines], each.name, foot))
    parts.append(Markup("</div>\n"))
    parts += [paragraph(f"{each.target}: {each.words}.") for each in found]
    if any(not count for each in found for count in each.instructions.values()):
        parts.append(paragraph("Refused: the states of the measurement are none for this function."))
    return Markup("").join(parts)


def _count(number: int) -> str:
    return f"{number:,}".replace(",", "\u202f") if number >= 10_000 else str(number)


def _source(stand: Stand, real: str) -> str:
    return digest(generated(stand, real).files[f"{stand.name}.c"])


def _accepted(given: Mapping[str, Any]) -> Figures:
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


def _measured(stand: Stand, names: str, missing: list[str]) -> list[Figures]:
    """On the targets of `--targets` that a gcc compiles, one by one; what cannot be is added to `missing`."""
    found = []
    for target, real in asked(names):
        if target.linker or target.compiler[0] == "clang":
            missing.append(f"{target.name}, {real}: compiled by clang; frames of the stack are known of gcc only")
            continue
        try:
            found.append(_of(measure(stand, [(target, real)]).targets[0]))
        except ToolchainError as error:
            missing.append(f"{target.name}, {real}: {error}")
    return found


def _of(given: TargetCost) -> Figures:
    counter = f"; instructions counted by {given.emulator or 'callgrind'}"
    return Figures(
        given.target, given.real, f"{given.title}; {given.compiler} ``{given.flags}``{counter}", given.source,
        {f.function: f.instructions for f in given.functions}, {f.function: f.stack for f in given.functions},
        {f.function: f.code for f in given.functions}, given.text,
    )  # fmt: skip


def _compiled(stand: Stand, missing: list[str]) -> list[Figures]:
    """Code and stack by the compilers of COMPILED; those that are not here are added to `missing`."""
    found = []
    for name, real in COMPILED:
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
    made = generated(stand, real)
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
