"""`<stand>_programme.h`, `.c`: a flywheel programme as tables, with its clock, self-test, page and manifest."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
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
from mahovik.core.lower.programme.clock import CLOCK
from mahovik.core.lower.programme.play import PERIODS, REFUSED, SWEEP, TICKS, Golden, GoldenCourse
from mahovik.core.lower.programme.program import Course, ProgrammeProgram
from mahovik.core.program.expression import BitCast
from mahovik.core.program.function import Function
from mahovik.core.program.restrictable import restrictable
from mahovik.core.program.types import Kind, Precision, Struct
from mahovik.core.program.walk import expressions
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand


@dataclass(frozen=True)
class Facts:
    """What the files say and hold beside their functions.

    motion     name of the required motion
    tables     part, period or duration (s) and numbers of each table
    measured   sizes and errors of each table, as the manifest has them
    lines      the same in words, a line each
    limit      that the error was compared with
    """

    motion: str
    tables: tuple[tuple[str, float, Mapping[str, Any]], ...]
    measured: tuple[Mapping[str, Any], ...]
    lines: tuple[str, ...]
    limit: float


def programme_files(stand: Stand, made: ProgrammeProgram, golden: Golden, facts: Facts) -> dict[str, str]:
    """Text by file name; the manifest, last, has the hashes of the others."""
    printer = _Printer(stand, made, golden, facts)
    name = f"{stand.name}_programme"
    files = {
        f"{name}.h": printer.header(),
        f"{name}.c": printer.source(),
        f"{name}_test.c": printer.test(),
        f"{name}.md": printer.page(),
    }
    return files | {f"{name}.json": printer.manifest(files)}


class _Names(Names):
    """Names of the stand, with a word type of its own: the stand's header declares none."""

    def type(self, type_: Kind | Struct) -> str:
        return f"{self.prefix}_programme_word" if type_ is Kind.WORD else super().type(type_)


class _Printer:
    """Collects the parts that the templates put in order."""

    def __init__(self, stand: Stand, made: ProgrammeProgram, golden: Golden, facts: Facts) -> None:
        self._stand = stand
        self._made = made
        self._golden = golden
        self._facts = facts
        self._names = _Names(made.program.name)
        self._precision: Precision = made.program.precision
        self._statements = Statements(self._names, Expressions(self._names, self._precision))
        self._restrictable = restrictable(made.program)

    def header(self) -> str:
        """The header: the manual."""
        return template("programme.h.j2").render(
            **self._common(),
            spans=self._spans(),
            counts=[
                (self._names.constant(c.form.size.name), int(c.form.size), c.form.size.comment)
                for c in self._made.courses
            ],
            clock=struct_lines(CLOCK, self._names),
            functions=public_declarations(self._made.public, self._made.program, self._names),
        )

    def source(self) -> str:
        """The source: tables, then functions."""
        program = self._made.program
        values = {part: value for part, _, value in self._facts.tables}
        return template("programme.c.j2").render(
            **self._common(),
            facts=[text for line in self._facts.lines for text in paragraph(line, " *   ", " *     ")],
            limit=f"{self._facts.limit:g}",
            structs=[struct_lines(s, self._names) for s in program.structs if s is not CLOCK],
            tables=[self._table(c, values[c.form.part]) for c in self._made.courses],
            functions=[self._function(f) for f in program.functions],
            wrappers=[self._wrapper(c) for c in self._made.courses],
        )

    def test(self) -> str:
        """The self-test: golden answers, refusals, a control loop."""
        return template("programme_test.c.j2").render(
            **self._common(),
            courses=[self._answers(g) for g in self._golden.courses],
            refused=[self._hex(x) for x in REFUSED],
            largest=real_literal(self._precision.largest, self._precision),
            ticks=TICKS,
            periods=PERIODS,
            sweep=SWEEP,
            hash=f"0x{self._golden.hash:08x}u",
        )

    def page(self) -> str:
        """What it is, how to use it, how good it is."""
        first = self._made.courses[0].form
        return template("programme.md.j2").render(
            **self._common(),
            lines=self._facts.lines,
            limit=f"{self._facts.limit:g}",
            functions=[(self._names.function(f.name), f.purpose) for f in self._made.public],
            columns=[(f.name, f.unit, f.comment) for f in first.row.fields],
            quintic=first.kind == "quintic",
        )

    def manifest(self, files: Mapping[str, str]) -> str:
        """Manifest: identity of the stand and hash of every file, without dates."""
        facts = self._facts
        tables = [dict(each) for each in facts.measured]
        more = {"programme": facts.motion, "tables": tables, "limit": facts.limit}
        return manifest_with(self._stand, self._precision.name, files, more)

    # -- parts ---------------------------------------------------------------------------------------------------------

    def _common(self) -> dict[str, Any]:
        found, forms = identities(self._stand), [c.form for c in self._made.courses]
        width = self._precision.width
        return {
            "name": self._stand.name,
            "NAME": self._stand.name.upper(),
            "version": __version__,
            "structure": found.structure,
            "physics": found.physics,
            "motion": self._facts.motion,
            "real": self._precision.name,
            "real_bytes": width // 8,
            "width": width,
            "torque": forms[0].torque,
            "cyclic": forms[0].cyclic,
            "word": self._names.type(Kind.WORD),
            "uses_real_of": any(
                isinstance(e, BitCast) and e.kind is Kind.REAL
                for f in self._made.program.functions
                for e in expressions(f.body)
            ),
            "parts": [form.part for form in forms if form.part],
            "method": _METHOD[forms[0].kind],
            "table_bytes": sum(_numbers(form.table) * width // 8 for form in forms),
        }

    def _spans(self) -> list[tuple[str, str, str]]:
        """Macro, value and meaning of periods and durations, in columns."""
        rows = []
        for course, (_, span, _) in zip(self._made.courses, self._facts.tables, strict=True):
            word = "period" if course.form.cyclic else "duration"
            macro = self._names.constant(f"{course.form.prefix}{word}".upper())
            rows.append((macro, real_literal(span, self._precision), f"s; {word}"))
        width = max(len(macro) for macro, _, _ in rows)
        return [(f"{macro:<{width}}", f"{value:<8}", words) for macro, value, words in rows]

    def _table(self, course: Course, value: Mapping[str, Any]) -> dict[str, Any]:
        table = course.form.table
        return {
            "declaration": f"static const {self._names.type(table)} {self._names.function(table.name)}_values",
            "lines": initialiser(table, dict(value), self._precision, {}),
        }

    def _function(self, f: Function) -> dict[str, Any]:
        body = [*null_check(f, self._names), *self._statements.block(f.body, "    ")]
        return {"comment": summary(f), "prototype": prototype(f, self._names, self._restrictable), "body": body}

    def _wrapper(self, course: Course) -> dict[str, Any]:
        table = f"&{self._names.function(course.form.table.name)}_values"
        passed = ", ".join([table, *(a.name for a in course.outer.arguments)])
        call = f"return {self._names.function(course.inner.name)}({passed});"
        body = [*null_check(course.outer, self._names), *wrapped(call, "    ")]
        return {"comment": summary(course.outer), "prototype": prototype(course.outer, self._names), "body": body}

    def _answers(self, golden: GoldenCourse) -> dict[str, Any]:
        outputs = [a.name for a in golden.course.outer.arguments if a.direction != "in"]
        rows = [wrapped(f"{{ {', '.join(map(self._hex, answer))} }},", "    ") for answer in golden.answers]
        return {
            "name": golden.course.outer.name,
            "function": self._names.function(golden.course.outer.name),
            "outputs": outputs,
            "phases": [self._hex(x) for x in golden.phases],
            "answers": [line for lines in rows for line in lines],
            "cases": len(golden.phases),
            "one": golden.course.form.cyclic,
        }

    def _hex(self, value: Any) -> str:
        return hex_literal(float(value), self._precision)


_METHOD = {
    "quintic": (
        "Angles are quintic Hermite polynomials between the nodes, from angle, speed and acceleration at both; speeds "
        "and accelerations are their derivatives. A drive torque is the polynomial of degree 5 through the six nodes "
        "about the place."
    ),
    "fourier": (
        "Angles are Fourier sums, speeds and accelerations their derivatives, term by term; so are drive torques. One "
        "sine and cosine a call, those of higher harmonics by the sum of angles."
    ),
}


def _numbers(struct: Struct) -> int:
    """How many numbers a struct has."""
    return sum(_sizes(struct))


def _sizes(struct: Struct) -> Iterator[int]:
    for f in struct.fields:
        size = 1
        for count in f.shape:
            size *= int(count)
        yield size * (_numbers(f.type) if isinstance(f.type, Struct) else 1)
