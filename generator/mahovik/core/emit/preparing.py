"""C that prepares tables of n stands at once, straight into the lanes in which the batches read them."""

from __future__ import annotations

from typing import Any

from mahovik.core.emit.calls import call, nested_loops, over_members
from mahovik.core.emit.layout import paragraph
from mahovik.core.emit.names import Names
from mahovik.core.lower.batch import Batches
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.variants import law_struct
from mahovik.core.program.types import Field, Kind, Struct


class Preparing:
    """Values of the templates for the function `prepare_batch`; `present`: the program has `prepare`."""

    def __init__(self, layout: Layout, made: Batches, names: Names) -> None:
        self._layout, self._made, self._names = layout, made, names
        self.present = bool(made.preparing)
        self._mounts = len(made.preparing) > 1

    @property
    def structs(self) -> list[Struct]:
        """Narrow structs whose wide forms the header defines."""
        return [self._layout.table, *([self._layout.mount_table] if self._mounts else [])]

    @property
    def arguments(self) -> str:
        """Declarations of all arguments of the function but the first and the number of stands."""
        names, prefix = self._names, self._names.prefix
        given = [f"const {names.type(self._layout.table)} *table", f"const {prefix}_real *const varied[]"]
        given += [f"{prefix}_wide_table tables[]"]
        given += [f"{prefix}_wide_{self._layout.mount_table.name} mountings[]"] if self._mounts else []
        return ", ".join([*given, f"{prefix}_status status[]"])

    def contract(self) -> list[str]:
        """Comment for the header."""
        count, lanes = self._count(), self._made.lanes
        size = f"[(n + {lanes - 1}) / {lanes}]"
        rows = [
            ("parameters", "of all stands, where `varied` has no array"),
            ("table", "its laws, of all stands, where `varied` has no array"),
            (f"varied[{count}]", "for each real of the parameters, then of the laws of a table, in the order of the "
             "members: n numbers, or null where all stands have the same"),
            (f"tables{size}", "out: as `tables` makes them; aligned like those"),
        ]  # fmt: skip
        rows += (
            [(f"mountings{size}", "out: as prepare_mounts makes them; null: none are wanted")] if self._mounts else []
        )
        rows += [("status[n]", "out: of each stand; the table of a refused one must not be used")]
        width = max(len(text) for text, _ in rows)
        lines = paragraph("prepare_batch: tables of n stands, side by side for ..._batch_of.", "/* ", " * ")
        for text, meaning in rows:
            lines += paragraph(meaning, f" *   {text:<{width}}  ", " *   " + " " * (width + 2))
        laws = ", ".join(f.name for f in law_struct(self._layout).fields) or "none"
        lines += paragraph(
            f"Members of a table that are laws: {laws}. Returns the first negative status, or OK.", " * ", " * "
        )
        lines[-1] += " */"
        return lines

    def values(self) -> dict[str, Any]:
        """Values of the template of the source: lines that fill a block, and calls."""
        names = self._names
        first = self._made.preparing[0]
        parameters = names.declaration("each", self._made.widener.wide.of(self._layout.parameters))
        given = {"parameters": "&each", "table": "to", "refused": "&refused"}
        calls = [f"{call(names, first.wide, lambda a: given[a.name])};"]
        if self._mounts:
            place = f"&mountings[first / {self._made.lanes}]"
            into = given | {"mounting": place}
            calls += [
                f"if (mountings != NULL) {{ {call(names, self._made.preparing[1].wide, lambda a: into[a.name])}; }}"
            ]
        return {
            "arguments": self.arguments,
            "mounts": self._mounts,
            "parameters": f"{parameters};",
            "spread": [
                *over_members(names, self._layout.parameters, self._spread("parameters->", "each."), ""),
                *over_members(names, law_struct(self._layout), self._spread("table->", "to->"), ""),
            ],
            "calls": calls,
        }

    def _spread(self, source: str, target: str) -> Any:
        """Lines that put one member of all stands, or of each, into the lanes of a block."""

        def lines(f: Field, place: str, depth: int) -> list[str]:
            def one(e: str, _: int) -> list[str]:
                if f.type is not Kind.REAL:
                    return [f"{target}{e[1:]} = {source}{e[1:]};"]
                return [f"next = {self._names.prefix}_spread(next, {source}{e[1:]}, first, count, &{target}{e[1:]});"]

            return nested_loops(self._names, place, f.shape, one, depth)

        return lines

    def _count(self) -> int:
        """Reals of the parameters and of the laws."""
        return reals(self._layout.parameters) + reals(law_struct(self._layout))


def reals(struct: Struct) -> int:
    """How many reals a struct has."""
    found = 0
    for f in struct.fields:
        each = reals(f.type) if isinstance(f.type, Struct) else int(f.type is Kind.REAL)
        for length in f.shape:
            each *= int(length)
        found += each
    return found
