"""`<stand>_batch.h`, `<stand>_batch.c`: the functions of a stand for many states at once.

Tables of n stands are prepared straight into the lanes in which the batches read them.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

from mahovik.contract.functions import BATCH_FUNCTIONS
from mahovik.contract.quantities import is_shared
from mahovik.core.emit.calls import call, nested_loops, over_members, over_rows
from mahovik.core.emit.code import Code
from mahovik.core.emit.declaration import pointer_arguments, zeros, zeros_for_null
from mahovik.core.emit.generate import Generated, header_structs
from mahovik.core.emit.layout import paragraph
from mahovik.core.emit.names import Names
from mahovik.core.lower.batch import BOTH, PREPARED, Batch, Batches, batches
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.program import lower_layout
from mahovik.core.lower.values import law_struct
from mahovik.core.program.call import Argument
from mahovik.core.program.refusal import POSITIVE
from mahovik.core.program.types import Field, Kind, Struct, numbers
from mahovik.core.program.walk import used_structs
from mahovik.core.program.widen import BYTES
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.errors import UsageError


def batch_files(
    stand: Stand, generated: Generated, table_forms: tuple[bool, ...] = BOTH, left_out: Collection[str] = ()
) -> dict[str, str]:
    """Header and source of the batches of generated C.

    table_forms  of one stand, of n stands, or BOTH, as delivered
    left_out     functions that get no batch, nor their forms for tasks

    Raises UsageError where no function has a batch.
    """
    made = batches(generated.program, table_forms, left_out)
    if not made.batches:
        public = {
            f.name for f in lower_layout(generated.layout, slopes=False).functions if f.public
        }  # of the whole stand
        names = ", ".join(name for name in BATCH_FUNCTIONS if name in public)
        raise UsageError(f"batch: none of the functions {', '.join(generated.only)} has one, expected one of {names}")
    printer = _Printer(generated, made, Code(made.program, identities(stand)), True in table_forms)
    return {f"{stand.name}_batch.h": printer.header(), f"{stand.name}_batch.c": printer.source()}


class _Printer:
    """Collects the parts that the two templates put in order."""

    def __init__(self, generated: Generated, made: Batches, code: Code, tables: bool) -> None:
        """`tables`: there are batches of n stands, with the tables that they take."""
        self._generated, self._made, self._code, self._names = generated, made, code, code.names
        self._wide = made.widener.wide
        self._preparing = Preparing(generated.layout, made, self._names)
        self._public_structs: list[Struct] = []
        self._tables = self._preparing.structs if tables else []
        for narrow in self._tables:
            wide = self._wide.of(narrow)
            assert isinstance(wide, Struct)
            inner = [s for s in wide.inner_structs() if s is not self._wide.real]
            self._public_structs += [s for s in inner if s not in self._public_structs]
        self._known = {
            "lanes": made.lanes,
            "round_up": made.lanes - 1,
            "bytes": BYTES,
            "positive": POSITIVE,
            "of_tables": tables,
        }

    def header(self) -> str:
        """Text of the header: facts common to all functions, then each function."""
        state = self._generated.layout.state
        return self._code.render(
            "batch.h.j2",
            **self._known,
            components=_reals(state),
            members=", ".join(f"{f.name}[{int(f.shape[0])}]" for f in state.fields),
            wide=self._wide.real,
            structs=self._code.structs(self._public_structs),
            functions=[{"comment": self._contract(b), **self._signature(b)} for b in self._made.batches],
            preparing=self._preparing,
            singles=self._singles(),
        )

    def source(self) -> str:
        """The source: functions in lanes, then the loops over blocks."""
        generated, table = self._generated, self._generated.layout.table
        known = {s.name for s in header_structs(generated.program)}
        known |= {s.name for s in (self._wide.real, self._wide.word, *self._public_structs)}
        return self._code.render(
            "batch.c.j2",
            **self._known,
            internal=self._code.structs(s for s in used_structs(self._code.program.functions) if s.name not in known),
            bits=bool(self._code.casts) or self._code.chooses,
            chooses=self._code.chooses,
            functions=self._code.functions,
            zeros=zeros((b.narrow for b in self._made.batches), self._names),
            put=number_lines(self._names, table, lambda f, e: f"to->{e}{_lane(f)} = from->{e};"),
            alike=number_lines(
                self._names,
                table,
                lambda f, e: "" if f.type is Kind.REAL else f"if (to->{e} != from->{e}) {{ return 0; }}",
            ),
            batches=[self._batch(b) for b in self._made.batches],
            preparing=self._preparing.values() if self._preparing.present else None,
            singles=self._singles(),
        )

    def _singles(self) -> list[dict[str, Any]]:
        """What takes one table, or the mountings of one stand, out of a block."""
        names = {s.name: argument for s, argument in zip(self._tables, PREPARED, strict=False)}
        return [
            {
                "name": f"{names[s.name]}_at",
                "wide": f"wide_{s.name}",
                "type": self._names.type(s),
                "argument": names[s.name],
                "lines": number_lines(self._names, s, lambda f, e: f"to->{e} = from->{e}{_lane(f)};"),
            }
            for s in self._tables
        ]

    # -- one batch -----------------------------------------------------------------------------------------------------

    def _contract(self, batch: Batch) -> list[str]:
        """Comment for the header."""
        lines = paragraph(f"{_name(batch)}: {batch.narrow.name} of n states.", "/* ", " * ")
        rows = [(self._argument_with_size(a, batch), a) for a in batch.narrow.arguments]
        width = max(len("status[n]"), *(len(text) for text, _ in rows))
        for text, a in rows:
            purpose = a.purpose.partition("; may overlap")[0]  # true of one state alone
            meaning = "; ".join(part for part in (a.unit, purpose) if part)
            if a.name in PREPARED and batch.own_table:
                maker = "prepare_batch" if a.name == "mounting" else "tables"
                meaning = f"what {self._names.function(maker)} made"
            direction = "out: " if a.direction != "in" else ""
            lead = f" *   {text:<{width}}  "
            lines += paragraph(direction + meaning, lead, " *   " + " " * (width + 2))
        return [*lines, f" *   {'status[n]':<{width}}  out: of each state */"]

    def _argument_with_size(self, a: Argument, batch: Batch) -> str:
        """An argument with its size: x[29 n], tau[8 n], locked[8]."""
        if a.name in PREPARED:
            return f"{a.name}s[(n + {self._made.lanes - 1}) / {self._made.lanes}]" if batch.own_table else a.name
        if isinstance(a.type, Struct):
            return f"{a.name}[{numbers(a.type, a.shape)} n]" if _varies(a) else a.name
        if not a.shape:
            return a.name
        return f"{a.name}[{int(a.shape[0])}{' n' if _varies(a) else ''}]"

    def _signature(self, batch: Batch) -> dict[str, Any]:
        """Name of a batch, and declarations of its first argument and of those after the counts."""
        table, *following = [self._batch_declaration(a, batch) for a in batch.narrow.arguments]
        status = f"{self._names.type(Kind.STATUS)} status[]"
        return {"name": self._names.function(_name(batch)), "table": table, "others": ", ".join([*following, status])}

    def _batch_declaration(self, a: Argument, batch: Batch) -> str:
        """An argument of the batch: reals of all states, or a value common to all."""
        if isinstance(a.type, Struct) and not _varies(a):
            wide = f"const {self._names.prefix}_wide_{a.type.name} {a.name}s[]"
            lanes = batch.own_table and a.name in PREPARED
            return wide if lanes else f"const {self._names.type(a.type)} *{a.name}"
        const = "const " if a.direction == "in" and (a.shape or isinstance(a.type, Struct)) else ""
        if _varies(a):
            return f"{const}{self._names.type(Kind.REAL)} {a.name}[]"
        return f"{const}{self._names.declaration(a.name, a.type, a.shape)}"

    def _batch(self, batch: Batch) -> dict[str, Any]:
        """Values of the template for a batch."""
        tables = PREPARED if batch.own_table else {}
        texts = {a.name: f"{a.name}s" if a.name in tables else a.name for a in batch.narrow.arguments}
        pointers = [texts[a.name] for a in pointer_arguments(batch.narrow)]
        varying = [a for a in batch.narrow.arguments if _varies(a)]
        first, *following = texts.values()
        return self._signature(batch) | {
            "aligned": [f"{a.name}s" for a in batch.narrow.arguments if a.name in tables],
            "declarations": [
                f"{self._names.declaration(f'wide_{a.name}', self._wide.of(a.type), a.shape)};" for a in varying
            ],
            "loads": [line for a in varying if a.direction == "in" for line in self._rows(a, "load")],
            "stores": [line for a in varying if a.direction != "in" for line in self._rows(a, "store")],
            "call": call(self._names, batch.wide, lambda a: self._argument_text(a, batch)),
            "zeros_for_null": zeros_for_null(batch.narrow, self._names),
            "null": " || ".join(f"{p} == NULL" for p in [*pointers, "status"]),
            "first": first,
            "passed": ", ".join([*following, "status"]),
        }

    def _argument_text(self, a: Argument, batch: Batch) -> str:
        """Argument of the function in lanes."""
        if a.name == "refused":
            return "&refused"
        if a.name in PREPARED:
            return f"&{a.name}s[first / {self._made.lanes}]" if batch.own_table else a.name
        narrow = next(b for b in batch.narrow.arguments if b.name == a.name)
        if not _varies(narrow):
            return a.name
        return f"&wide_{a.name}" if isinstance(narrow.type, Struct) and not narrow.shape else f"wide_{a.name}"

    def _rows(self, a: Argument, what: str) -> list[str]:
        """Lines that move all reals of an argument, row by row, by a function that moves the rows of an array."""
        place, array = f"wide_{a.name}", f"{what}_{a.name}"
        const = "const " if what == "load" else ""
        arguments = ", ".join(
            [array, "n", "first", "count", "{}", "{}"] + (["&refused", "whole"] if what == "store" else [])
        )

        def row(address: str, size: str) -> str:
            return f"{array} = {self._names.function(what)}({arguments.format(address, size)});"

        lines = [f"{const}{self._names.type(Kind.REAL)} *{array} = {a.name};"]
        if not isinstance(a.type, Struct):
            return [*lines, *over_rows(self._names, place, a.shape, row)]

        def members(element: str, depth: int) -> list[str]:
            assert isinstance(a.type, Struct)
            return over_members(
                self._names, a.type, lambda f, e, d: over_rows(self._names, e, f.shape, row, d), element, depth
            )

        return [*lines, *nested_loops(self._names, place, a.shape, members)]


def number_lines(names: Names, struct: Struct, statement: Callable[[Field, str], str]) -> list[str]:
    """Lines with a statement for each number of a struct, from its field and place; "" for none."""

    def lines(f: Field, place: str, depth: int) -> list[str]:
        return nested_loops(names, place, f.shape, lambda e, _: filter(None, [statement(f, e[1:])]), depth)

    return over_members(names, struct, lines, "")


def _lane(f: Field) -> str:
    """Lane k of a wide member."""
    return ".at[k]" if f.type is Kind.REAL else ""


def _name(batch: Batch) -> str:
    return f"{batch.narrow.name}_batch{'_of' if batch.own_table else ''}"


def _varies(a: Argument) -> bool:
    """Does it differ from state to state?"""
    if a.name in PREPARED or is_shared(a.name):
        return False
    return isinstance(a.type, Struct) or (a.type is Kind.REAL and bool(a.shape))


def _reals(struct: Struct) -> str:
    """How many reals a struct of arrays has, in words: 13 + 2 N."""
    fixed = sum(f.shape[0] for f in struct.fields if isinstance(f.shape[0], int))
    named = sum(1 for f in struct.fields if not isinstance(f.shape[0], int))
    return f"{fixed} + {named} N" if named else str(fixed)


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
        declarations = [f"const {names.type(self._layout.table)} *table", f"const {prefix}_real *const varied[]"]
        declarations += [f"{prefix}_wide_table tables[]"]
        declarations += [f"{prefix}_wide_{self._layout.mount_table.name} mountings[]"] if self._mounts else []
        return ", ".join([*declarations, f"{prefix}_status status[]"])

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
        texts = {"parameters": "&each", "table": "to", "refused": "&refused"}
        calls = [f"{call(names, first.wide, lambda a: texts[a.name])};"]
        if self._mounts:
            place = f"&mountings[first / {self._made.lanes}]"
            into = texts | {"mounting": place}
            calls += [
                f"if (mountings != NULL) {{ {call(names, self._made.preparing[1].wide, lambda a: into[a.name])}; }}"
            ]
        return {
            "arguments": self.arguments,
            "mounts": self._mounts,
            "parameters": f"{parameters};",
            "spread": [
                *number_lines(names, self._layout.parameters, self._spread("parameters->", "each.")),
                *number_lines(names, law_struct(self._layout), self._spread("table->", "to->")),
            ],
            "calls": calls,
        }

    def _spread(self, source: str, target: str) -> Callable[[Field, str], str]:
        """What puts a member of all stands, or of each, into the lanes of a block."""

        def statement(f: Field, e: str) -> str:
            if f.type is not Kind.REAL:
                return f"{target}{e} = {source}{e};"
            return f"next = {self._names.prefix}_spread(next, {source}{e}, first, count, &{target}{e});"

        return statement

    def _count(self) -> int:
        """Reals of the parameters and of the laws."""
        structs = (self._layout.parameters, law_struct(self._layout))
        return sum(numbers(struct, kinds=(Kind.REAL,)) for struct in structs)
