"""`<stand>_batch.h`, `<stand>_batch.c`: the functions of a stand for many states at once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mahovik import __version__
from mahovik.core.emit.declaration import prototype, struct_lines, summary
from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.generate import Generated, internal
from mahovik.core.emit.layout import paragraph, wrapped
from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import Statements, dimensions
from mahovik.core.emit.templates import template
from mahovik.core.lower.batch import Batch, Batches, batches
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import BitCast
from mahovik.core.program.function import Function
from mahovik.core.program.restrictable import restrictable
from mahovik.core.program.statement import Declare, Loop, Statement, When
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.program.walk import expressions
from mahovik.core.program.wide import BYTES
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError


def batch_files(stand: Stand, generated: Generated) -> dict[str, str]:
    """Header and source of the batches of generated C. Raises UsageError where it is not of one lane, or fast."""
    if generated.layout.lanes > 1 or generated.fast:
        raise UsageError("--batch: not with --lanes, --fast: it has lanes of its own, and the bits of single calls")
    printer = _Printer(stand, generated, batches(generated.program))
    return {f"{stand.name}_batch.h": printer.header(), f"{stand.name}_batch.c": printer.source()}


class _Printer:
    """Collects the parts that the two templates put in order."""

    def __init__(self, stand: Stand, generated: Generated, made: Batches) -> None:
        self._stand = stand
        self._generated = generated
        self._made = made
        self._program = made.program
        self._names = Names(self._program.name)
        self._statements = Statements(self._names, Expressions(self._names, self._program.precision))
        self._restrictable = restrictable(self._program)
        self._structs = _used_structs(self._program.functions)
        wide_table = made.widener.wide.of(generated.layout.table)
        assert isinstance(wide_table, Struct)
        self._public_structs = [s for s in _with_members(wide_table) if s is not made.widener.wide.real]

    def header(self) -> str:
        """The header: what is the same for all functions in the beginning, then each."""
        state = self._generated.layout.state
        members = [f"{f.name}[{int(f.shape[0])}]" for f in state.fields]
        return template("batch.h.j2").render(
            **self._common(),
            components=_reals(state),
            members=", ".join(members),
            wide=self._made.widener.wide.real,
            structs=[struct_lines(s, self._names) for s in self._public_structs],
            functions=[self._contract(b) for b in self._made.batches],
        )

    def source(self) -> str:
        """The source: functions in lanes, then the loops over blocks."""
        base = (self._made.widener.wide.real, self._made.widener.wide.word)
        known = {s.name for s in self._program_structs()}
        own = [s for s in self._structs if s not in base and s not in self._public_structs and s.name not in known]
        return template("batch.c.j2").render(
            **self._common(),
            internal=[struct_lines(s, self._names) for s in own],
            bits=any(isinstance(e, BitCast) for f in self._program.functions for e in expressions(f.body)),
            functions=[self._function(f) for f in self._program.functions],
            put=_copied(self._generated.layout.table),
            alike=_compared(self._generated.layout.table),
            load=self._moving("load", "const {real} from[], size_t n, size_t first, size_t count, {wide} to[restrict]"),
            store=self._moving(
                "store",
                "const {wide} from[], const {wide}_word *refused, int whole, size_t n, size_t first, size_t count, "
                "{real} to[restrict]",
            ),
            batches=[self._batch(b) for b in self._made.batches],
        )

    def _moving(self, name: str, arguments: str) -> str:
        """Prototype of what moves rows between arrays and lanes."""
        words = {"real": self._names.type(Kind.REAL), "wide": self._names.type(self._made.widener.wide.real)}
        text = f"static void {self._names.function(name)}({arguments.format(**words)}, size_t rows)"
        return "\n".join(wrapped(text, ""))

    def _program_structs(self) -> list[Struct]:
        """Structs of the header of the stand."""
        return [s for s in self._generated.program.structs if not internal(self._generated.layout, s)]

    def _common(self) -> dict[str, Any]:
        found = identities(self._stand)
        head = f"{self._names.type(Kind.STATUS)} {self._names.function('tables')}("
        table, wide = self._names.type(self._generated.layout.table), f"{self._names.prefix}_wide_table"
        return {
            "name": self._stand.name,
            "NAME": self._stand.name.upper(),
            "version": __version__,
            "structure": found.structure,
            "physics": found.physics,
            "width": self._program.precision.width,
            "lanes": self._made.lanes,
            "last": self._made.lanes - 1,
            "bytes": BYTES,
            "tables": f"{head}const {table} table[], size_t n, {wide} tables[])",
        }

    def _function(self, f: Function) -> dict[str, Any]:
        return {
            "comment": summary(f),
            "prototype": prototype(f, self._names, self._restrictable),
            "body": self._statements.block(f.body, "    "),
        }

    # -- one batch -----------------------------------------------------------------------------------------------------

    def _name(self, batch: Batch) -> str:
        return f"{batch.narrow.name}_batch{'_of' if batch.each else ''}"

    def _contract(self, batch: Batch) -> dict[str, Any]:
        """Comment and prototype for the header."""
        lines = paragraph(f"{self._name(batch)}: {batch.narrow.name} of n states.", "/* ", " * ")
        rows = [(self._given(a, batch), a) for a in batch.narrow.arguments]
        width = max(len("status[n]"), *(len(text) for text, _ in rows))
        for text, a in rows:
            purpose = a.purpose.partition("; may overlap")[0]  # true of one state alone
            meaning = "; ".join(part for part in (a.unit, purpose) if part)
            if a.name == "table":
                meaning = f"what {self._names.function('tables')} made" if batch.each else a.purpose
            direction = "out: " if a.direction != "in" else ""
            lead = f" *   {text:<{width}}  "
            lines += paragraph(direction + meaning, lead, " *   " + " " * (width + 2))
        lines.append(f" *   {'status[n]':<{width}}  out: of each state")
        lines[-1] += " */"
        return {"comment": lines, "prototype": self._prototype(batch)}

    def _given(self, a: Argument, batch: Batch) -> str:
        """An argument with its size: x[29 n], tau[8 n], locked[8]."""
        if a.name == "table":
            return f"tables[(n + {self._made.lanes - 1}) / {self._made.lanes}]" if batch.each else a.name
        if isinstance(a.type, Struct):
            return f"{a.name}[{sum(int(f.shape[0]) for f in a.type.fields)} n]"
        if not a.shape:
            return a.name
        return f"{a.name}[{int(a.shape[0])}{' n' if self._varies(a) else ''}]"

    def _prototype(self, batch: Batch, block: bool = False) -> str:
        arguments = [self._declared(a, batch) for a in batch.narrow.arguments]
        counts = "size_t n, size_t first" if block else "size_t n"
        arguments[1:1] = [counts]
        arguments.append(f"{self._names.type(Kind.STATUS)} status[]")
        what = (
            f"static int {self._names.function(self._name(batch))}_block("
            if block
            else (f"{self._names.type(Kind.STATUS)} {self._names.function(self._name(batch))}(")
        )
        return "\n".join(wrapped(f"{what}{', '.join(arguments)})", ""))

    def _declared(self, a: Argument, batch: Batch) -> str:
        """An argument of the batch: reals of all states, or what is the same for all."""
        real = self._names.type(Kind.REAL)
        const = "const " if a.direction == "in" else ""
        if a.name == "table":
            if batch.each:
                return f"const {self._names.prefix}_wide_table tables[]"
            return f"const {self._names.type(a.type)} *table"
        if not self._varies(a):
            sizes = "".join(dimensions(self._names, a.shape))
            return f"{const if sizes else ''}{self._names.type(a.type)} {a.name}{sizes}"
        return f"{const}{real} {a.name}[]"

    @staticmethod
    def _varies(a: Argument) -> bool:
        return isinstance(a.type, Struct) or (a.type is Kind.REAL and bool(a.shape))

    def _batch(self, batch: Batch) -> dict[str, Any]:
        names = self._names
        wide = self._made.widener.wide
        state = [a for a in batch.narrow.arguments if self._varies(a) and a.name != "table"]
        declarations, loads, stores = [], [], []
        for a in state:
            sizes = "".join(dimensions(names, a.shape))
            declarations.append(f"{names.type(wide.of(a.type))} wide_{a.name}{sizes};")
            for place, offset, rows in _rows(a, names):
                at = f"{a.name} + {offset} * n" if offset != "0" else a.name
                if a.direction == "in":
                    loads.append(f"{names.function('load')}({at}, n, first, count, wide_{place}, {rows});")
                else:
                    where = "&refused, whole, n, first, count"
                    stores.append(f"{names.function('store')}(wide_{place}, {where}, {at}, {rows});")
        passed = [self._passed(a, batch) for a in batch.narrow.arguments]
        call = f"{names.function(batch.wide.name)}({', '.join([*passed, '&refused'])});"
        given = {a.name: "tables" if a.name == "table" and batch.each else a.name for a in batch.narrow.arguments}
        first, *others = given.values()
        handed = ", ".join([first, "n", f"(size_t)b * {self._made.lanes}", *others, "status"])
        block = f"any |= {names.function(self._name(batch))}_block({handed});"
        pointers = [given[a.name] for a in batch.narrow.arguments if a.shape or isinstance(a.type, Struct)]
        condition = " || ".join(f"{p} == NULL" for p in [*pointers, "status"])
        return {
            "name": names.function(self._name(batch)),
            "each": batch.each,
            "block": self._prototype(batch, block=True),
            "prototype": self._prototype(batch),
            "declarations": declarations,
            "loads": loads,
            "stores": stores,
            "call": wrapped(call, "    "),
            "null": wrapped(f"if ({condition}) {{ return {names.constant('BAD_ARGUMENT')}; }}", "    "),
            "passed": wrapped(block, "        "),
        }

    def _passed(self, a: Argument, batch: Batch) -> str:
        if a.name == "table":
            return f"&tables[first / {self._made.lanes}]" if batch.each else "table"
        if not self._varies(a):
            return a.name
        return f"&wide_{a.name}" if isinstance(a.type, Struct) else f"wide_{a.name}"


def _rows(a: Argument, names: Names) -> list[tuple[str, str, str]]:
    """(place, offset in components, rows) of the arrays of an argument."""
    if not isinstance(a.type, Struct):
        return [(a.name, "0", dimensions(names, a.shape)[0].strip("[]"))]
    found = []
    offset: list[str] = []
    for f in a.type.fields:
        rows = dimensions(names, f.shape)[0].strip("[]")
        text = " + ".join(offset) or "0"
        found.append((f"{a.name}.{f.name}", f"({text})" if len(offset) > 1 else text, rows))
        offset.append(rows)
    return found


def _reals(struct: Struct) -> str:
    """How many reals a struct of arrays has, in words: 13 + 2 N."""
    fixed = sum(f.shape[0] for f in struct.fields if isinstance(f.shape[0], int))
    named = sum(1 for f in struct.fields if not isinstance(f.shape[0], int))
    return f"{fixed} + {named} N" if named else str(fixed)


def _with_members(struct: Struct) -> list[Struct]:
    """A struct after those that it holds."""
    found: list[Struct] = []
    for f in struct.fields:
        if isinstance(f.type, Struct):
            found += [s for s in _with_members(f.type) if s not in found]
    return [*found, struct]


def _used_structs(functions: tuple[Function, ...]) -> list[Struct]:
    """Struct types of arguments and local variables, each after those that it holds."""
    found: list[Struct] = []

    def add(type_: Kind | Struct) -> None:
        if isinstance(type_, Struct):
            found.extend(s for s in _with_members(type_) if s not in found)

    def visit(body: tuple[Statement, ...]) -> None:
        for s in body:
            match s:
                case Declare(variable):
                    add(variable.type)
                case Loop():
                    visit(s.body)
                case When():
                    visit((*s.body, *s.otherwise))

    for function in functions:
        for a in function.arguments:
            add(a.type)
        visit(function.body)
    return found


def _copied(struct: Struct) -> list[str]:
    """C lines that put a narrow struct into lane k of a wide one."""
    return _each(struct, lambda f, at: f"to->{at}{'.at[k]' if f.type is Kind.REAL else ''} = from->{at};")


def _compared(struct: Struct) -> list[str]:
    """C lines that return 0 where an int of two narrow structs differs."""
    return _each(struct, lambda f, at: "" if f.type is Kind.REAL else f"if (to->{at} != from->{at}) {{ return 0; }}")


def _each(struct: Struct, line: Callable[[Field, str], str], path: str = "", depth: int = 0) -> list[str]:
    """A line for every member that is a scalar, in loops over arrays."""
    found: list[str] = []
    for f in struct.fields:
        at = f"{path}{f.name}"
        heads = []
        for number, count in enumerate(f.shape):
            index = "ijlmpq"[depth + number]
            heads.append(f"for (int {index} = 0; {index} < {int(count)}; ++{index}) {{")
            at += f"[{index}]"
        if isinstance(f.type, Struct):
            inner = _each(f.type, line, f"{at}.", depth + len(f.shape))
        else:
            text = line(f, at)
            inner = [text] if text else []
        if not inner:
            continue
        for number, head in enumerate(heads):
            found.append("    " * number + head)
        found += ["    " * len(heads) + x for x in inner]
        for number in reversed(range(len(heads))):
            found.append("    " * number + "}")
    return found
