"""`<stand>_programme.h`, `.c`: a flywheel programme as tables, with its clock, self-test, page and manifest."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from mahovik.core.emit.calls import call
from mahovik.core.emit.code import INDENT, Code
from mahovik.core.emit.declaration import struct_lines
from mahovik.core.emit.layout import paragraph, wrap_statement
from mahovik.core.emit.manifest import manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.lower.programme import CLOCK, Course, ProgrammeProgram
from mahovik.core.lower.programme_play import PERIODS, REFUSED, SWEEP, TICKS, Golden, GoldenCourse
from mahovik.core.program.types import Kind, numbers
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities


@dataclass(frozen=True)
class Facts:
    """Facts and tables in the files, apart from their functions.

    motion     name of the required motion
    tables     part, period or duration (s) and numbers of each table
    measured   sizes and errors of each table, for the manifest
    lines      the same in words, a line each
    limit      that the error was compared with
    """

    motion: str
    tables: tuple[tuple[str, float, Mapping[str, Any]], ...]
    measured: tuple[Mapping[str, Any], ...]
    lines: tuple[str, ...]
    limit: float


def rename_files(files: dict[str, str], stand_name: str, called: str) -> dict[str, str]:
    """Files of a programme, or of its servo, with the programme's name in the place of `programme`.

    Names of files are replaced as well; the names of a servo and its trim come after that of its programme.
    """
    if called == "programme":
        return files
    words = {"programme": called, "servo": f"{called}_servo", "trim": f"{called}_trim"}
    names = {f"{stand_name}_{old}": f"{stand_name}_{new}" for old, new in words.items()}
    names |= {old.upper(): new.upper() for old, new in names.items()}
    pattern = re.compile(rf"\b({'|'.join(map(re.escape, names))})(?=_|\b)")

    def replace_names(text: str) -> str:
        return pattern.sub(lambda result: names[result[0]], text)

    return {replace_names(name): replace_names(text) for name, text in files.items()}


class ProgrammePrinter:
    """Texts of a programme beside the C of its stand."""

    def __init__(self, stand: Stand, made: ProgrammeProgram, golden: Golden, facts: Facts) -> None:
        self._stand, self._made, self._golden, self._facts = stand, made, golden, facts
        self._code = Code(made.program, identities(stand), word="programme_word")  # the stand's header declares none
        self._names = self._code.names
        form = made.courses[0].form
        self._known = {
            "motion": facts.motion,
            "torque": form.torque,
            "cyclic": form.cyclic,
            "parts": [c.form.part for c in made.courses if c.form.part],
            "method": _METHOD[form.kind],
            "table_bytes": sum(numbers(c.form.table) for c in made.courses) * made.program.precision.width // 8,
            "limit": f"{facts.limit:g}",
        }

    def files(self, called: str = "programme") -> dict[str, str]:
        """Text by file name; the manifest, last, has the hashes of the others.

        `called`: what names of files, types and functions have after that of the stand, so that programmes can lie in
        one image.
        """
        name = f"{self._stand.name}_programme"
        files = {
            f"{name}.h": self.header(),
            f"{name}.c": self.source(),
            f"{VERIFICATION}{name}_test.c": self.test(),
            f"{name}.md": self.page(),
        }
        files = rename_files(files, self._stand.name, called)
        return files | {f"{self._stand.name}_{called}.json": self.manifest(files)}

    def header(self) -> str:
        """The header: the manual."""
        sizes = [c.form.size for c in self._made.courses]
        return self._code.render(
            "programme.h.j2",
            **self._known,
            spans=self._spans(),
            counts=[(self._names.constant(size.name), int(size), size.comment) for size in sizes],
            clock=struct_lines(CLOCK, self._names),
            functions=self._code.public_declarations(self._made.public),
        )

    def source(self) -> str:
        """The source: tables, then functions."""
        values = {part: value for part, _, value in self._facts.tables}
        tables = [(c.form.table, values[c.form.part]) for c in self._made.courses]
        return self._code.render(
            "programme.c.j2",
            **self._known,
            limits=[*self._code.limits, *self._code.constants],
            facts=[text for line in self._facts.lines for text in paragraph(line, " *   ", " *     ")],
            structs=self._code.structs(s for s in self._made.program.structs if s is not CLOCK),
            tables=[self._code.table(f"{table.name}_values", table, value) for table, value in tables],
            functions=self._code.functions + [self._wrapper(c) for c in self._made.courses],
        )

    def test(self) -> str:
        """The self-test: golden answers, refusals, a control loop."""
        return self._code.render(
            "programme_test.c.j2",
            **self._known,
            word=self._names.type(Kind.WORD),
            hashes_rows=False,
            courses=[self._answers(g) for g in self._golden.courses],
            refused=[self._code.hex(x) for x in REFUSED],
            largest=self._code.real(self._code.precision.largest),
            ticks=TICKS,
            periods=PERIODS,
            sweep=SWEEP,
            hash=f"0x{self._golden.hash:08x}u",
        )

    def page(self) -> str:
        """The page: contents, use and accuracy."""
        first = self._made.courses[0].form
        return self._code.render(
            "programme.md.j2",
            **self._known,
            lines=self._facts.lines,
            functions=[(self._names.function(f.name), f.purpose) for f in self._made.public],
            columns=[(f.name, f.unit, f.comment) for f in first.row.fields],
            quintic=first.kind == "quintic",
        )

    def manifest(self, files: Mapping[str, str]) -> str:
        """Manifest: identity of the stand and hash of every file, without dates."""
        facts = self._facts
        tables = [dict(table) for table in facts.measured]
        more = {"programme": facts.motion, "tables": tables, "limit": facts.limit}
        return manifest(self._stand, self._code.precision.name, files, more)

    # -- parts ---------------------------------------------------------------------------------------------------------

    def _spans(self) -> list[tuple[str, str, str]]:
        """Macro, value and meaning of periods and durations, in columns."""
        rows = []
        for course, (_, span, _) in zip(self._made.courses, self._facts.tables, strict=True):
            word = "period" if course.form.cyclic else "duration"
            macro = self._names.constant(f"{course.form.prefix}{word}".upper())
            rows.append((macro, self._code.real(span), f"s; {word}"))
        width = max(len(macro) for macro, _, _ in rows)
        return [(f"{macro:<{width}}", f"{value:<8}", words) for macro, value, words in rows]

    def _wrapper(self, course: Course) -> dict[str, Any]:
        """The public function of a course, which passes on to the one that takes the table."""
        texts = {a.name: a.name for a in course.inner.arguments}
        texts["table"] = f"&{self._names.function(course.form.table.name)}_values"
        function = self._code.function(replace(course.outer, body=()))
        return function | {
            "body": function["body"] + wrap_statement(f"return {call(self._names, course.inner, texts)};", INDENT)
        }

    def _answers(self, golden: GoldenCourse) -> dict[str, Any]:
        outer = golden.course.outer
        rows = [wrap_statement(f"{{ {', '.join(map(self._code.hex, answer))} }},", INDENT) for answer in golden.answers]
        return {
            "name": outer.name,
            "function": self._names.function(outer.name),
            "outputs": [a.name for a in outer.arguments if a.direction != "in"],
            "phases": [self._code.hex(x) for x in golden.phases],
            "answers": [line for lines in rows for line in lines],
            "cases": len(golden.phases),
            "one": golden.course.form.cyclic,
        }


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
