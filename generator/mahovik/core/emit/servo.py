"""`<stand>_servo.h`, `.c`: servos and trim with their gains as const tables; self-test, example, page, manifest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from mahovik import __version__
from mahovik.core.emit.constant import initialiser
from mahovik.core.emit.declaration import null_check, prototype, public_declarations, struct_lines, summary
from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.hexadecimal import hex_literal
from mahovik.core.emit.layout import paragraph, wrapped
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.manifest import manifest_with
from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import Statements
from mahovik.core.emit.templates import template
from mahovik.core.lower.servo import golden as expected
from mahovik.core.lower.servo.form import ServoForm
from mahovik.core.lower.servo.golden import Golden
from mahovik.core.program.expression import BitCast
from mahovik.core.program.function import Function, Program
from mahovik.core.program.restrictable import restrictable
from mahovik.core.program.types import Kind, Struct
from mahovik.core.program.walk import expressions
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand


@dataclass(frozen=True)
class ServoTables:
    """The numbers of a servo, as its structs have them, and what is to be said of it.

    gains, design    members by name; `design` None without a trim
    period           between samples, s
    ticks, periods   so many samples are so many periods of the programme; None where no programme is known
    lines            what was computed, a line each
    loop             what the example and its page have besides
    """

    gains: Mapping[str, Any]
    design: Mapping[str, Any] | None
    period: float
    ticks: int | None = None
    periods: int | None = None
    lines: tuple[str, ...] = ()
    loop: Mapping[str, Any] = field(default_factory=dict)


def servo_code(stand: Stand, program: Program, form: ServoForm, tables: ServoTables) -> dict[str, str]:
    """Header and source by file name: all that firmware needs beside `<stand>.h`."""
    printer = _Printer(stand, program, form, tables)
    name = f"{stand.name}_servo"
    return {f"{name}.h": printer.header(), f"{name}.c": printer.source()}


def servo_files(
    stand: Stand, program: Program, form: ServoForm, tables: ServoTables, golden: Golden, what: str
) -> dict[str, str]:
    """Text by file name, with an example beside the tables of a programme; the manifest, last, has the hashes.

    `what`: the name of the servo.
    """
    printer = _Printer(stand, program, form, tables)
    name = f"{stand.name}_servo"
    files = servo_code(stand, program, form, tables) | {
        f"{name}_main.c": printer.rendered("servo_main.c.j2"),
        f"{name}_test.c": printer.test(golden),
        f"{name}.md": printer.page(),
    }
    return files | {f"{name}.json": printer.manifest(files, what)}


def servo_program_text(
    name: str, stand: Stand, program: Program, form: ServoForm, tables: ServoTables, **more: Any
) -> str:
    """A program of the template `name` that runs the servos of these tables."""
    return _Printer(stand, program, form, tables).rendered(name, **more)


class _Names(Names):
    """Names of the stand, with a word type of its own: the stand's header declares none."""

    def type(self, type_: Kind | Struct) -> str:
        return f"{self.prefix}_servo_word" if type_ is Kind.WORD else super().type(type_)


class _Printer:
    """Collects the parts that the templates put in order."""

    def __init__(self, stand: Stand, program: Program, form: ServoForm, tables: ServoTables) -> None:
        self._stand, self._program, self._form, self._tables = stand, program, form, tables
        self._names = _Names(program.name)
        self._precision = program.precision
        self._statements = Statements(self._names, Expressions(self._names, self._precision))
        self._restrictable = restrictable(program)
        self._public = [f for f in program.functions if f.public]

    def header(self) -> str:
        """The header: the manual."""
        return self.rendered(
            "servo.h.j2",
            counts=[(self._names.constant(c.name), int(c), c.comment) for c in self._program.counts[1:]],
            structs=[struct_lines(s, self._names) for s in self._program.structs],
            functions=public_declarations(self._public, self._program, self._names),
        )

    def source(self) -> str:
        """The source: tables, then functions."""
        cast = {e.kind for f in self._program.functions for e in expressions(f.body) if isinstance(e, BitCast)}
        words = any(Kind.WORD in _kinds(f) for f in self._program.functions)
        return self.rendered(
            "servo.c.j2",
            uses_word=bool(cast) or words,
            uses_bits_of=Kind.WORD in cast,
            uses_real_of=Kind.REAL in cast,
            tables=list(self._constants()),
            functions=[self._function(f) for f in self._program.functions],
        )

    def test(self, golden: Golden) -> str:
        """The self-test: golden torques, long runs, refusals."""
        rows = [wrapped(f"{{ {', '.join(map(self._hex, row))} }},", "    ") for row in golden.torques]
        return self.rendered(
            "servo_test.c.j2",
            torques=[line for lines in rows for line in lines],
            listed=len(golden.torques),
            sweep=expected.SWEEP,
            seed=f"0x{expected.SEED:x}u",
            multiplier=f"{expected.MULTIPLIER}u",
            increment=f"{expected.INCREMENT}u",
            settling=expected.SETTLING,
            window=expected.WINDOW,
            largest={name: self._hex(value * 2.0**-23) for name, value in expected.LARGEST.items()},
            bit=self._hex(2.0**-24),
            servo_hash=f"0x{golden.servo:08x}u",
            trim_hash=f"0x{golden.trim or 0:08x}u",
            greatest=real_literal(self._precision.largest, self._precision),
        )

    def page(self) -> str:
        """What it is, how to use it."""
        return self.rendered("servo.md.j2", functions=[(self._names.function(f.name), f.purpose) for f in self._public])

    def manifest(self, files: Mapping[str, str], what: str) -> str:
        """Manifest: identity of the stand and hash of every file, without dates."""
        return manifest_with(self._stand, self._precision.name, files, {"servo": what})

    def rendered(self, name: str, **more: Any) -> str:
        """A template with what all of them know."""
        found, tables = identities(self._stand), self._tables
        return template(name).render(
            name=self._stand.name,
            NAME=self._stand.name.upper(),
            version=__version__,
            structure=found.structure,
            physics=found.physics,
            real=self._precision.name,
            real_bytes=self._precision.width // 8,
            width=self._precision.width,
            word=self._names.type(Kind.WORD),
            trim=self._form.trim is not None,
            period=real_literal(tables.period, self._precision),
            ticks=tables.ticks,
            periods=tables.periods,
            lines=tables.lines,
            facts=[text for line in tables.lines for text in paragraph(line, " *   ", " *     ")],
            **tables.loop,
            **more,
        )

    # -- parts ---------------------------------------------------------------------------------------------------------

    def _constants(self) -> list[dict[str, Any]]:
        """The gains, and the design of the trim."""
        found = [(self._form.gains, "servo_default", dict(self._tables.gains))]
        if self._form.trim is not None:
            assert self._tables.design is not None
            found.append((self._form.design, "trim_default", dict(self._tables.design)))
        return [
            {
                "declaration": f"const {self._names.type(struct)} {self._names.function(name)}",
                "lines": initialiser(struct, value, self._precision, {}),
            }
            for struct, name, value in found
        ]

    def _function(self, f: Function) -> dict[str, Any]:
        body = [*null_check(f, self._names), *self._statements.block(f.body, "    ")]
        return {"comment": summary(f), "prototype": prototype(f, self._names, self._restrictable), "body": body}

    def _hex(self, value: Any) -> str:
        return hex_literal(float(value), self._precision)


def _kinds(function: Function) -> set[Kind]:
    """Kinds of the expressions of a function."""
    return {e.kind for e in expressions(function.body) if hasattr(e, "kind")}
