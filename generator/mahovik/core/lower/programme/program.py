"""The program of a flywheel programme: the functions of its tables and of its clock."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from mahovik.core import routines
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.lower.programme import clock
from mahovik.core.lower.programme.form import Form
from mahovik.core.lower.programme.fourier import fourier
from mahovik.core.lower.programme.quintic import quintic
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Struct
from mahovik.core.program.validate import validate


@dataclass(frozen=True)
class Course:
    """A table's functions: `inner` takes the table, `outer` is what the header has, with the table left out."""

    form: Form
    inner: Function
    outer: Function


@dataclass(frozen=True)
class ProgrammeProgram:
    """The program, and of each table its functions; the programme itself comes first."""

    program: Program
    courses: tuple[Course, ...]

    @property
    def public(self) -> tuple[Function, ...]:
        """The functions of the header, in its order."""
        return (*(c.outer for c in self.courses), *(f for f in self.program.functions if f.public))


def lower_programme(layout: Layout, forms: Sequence[Form]) -> ProgrammeProgram:
    """Functions for tables of these forms. Their text depends on the forms and the stand's structure alone."""
    lib = Library(layout)
    precision = layout.precision
    if any(form.kind == "fourier" for form in forms):
        lib.add(routines.sincos(precision))
    lib.add(routines.unwind(precision))
    lib.add(routines.wrap(precision, lib["unwound"]))
    courses = []
    for form in forms:
        inner = lib.add(quintic(lib, form) if form.kind == "quintic" else fourier(lib, form))
        courses.append(Course(form, inner, _outer(form, inner)))
    for function in (clock.start(lib), clock.advance(lib), clock.phase(lib)):
        lib.add(function)
    counts = (layout.count, *(form.size for form in forms))
    tables: list[Struct] = [clock.CLOCK]
    for form in forms:
        tables += [form.row, form.table]
    program = Program(layout.structure.name, precision, counts, tuple(tables), lib.functions)
    validate(program)
    return ProgrammeProgram(program, tuple(courses))


_WORDS = {
    "": "what the flywheels are to do at a phase of the programme",
    "runup": "what the flywheels are to do at a phase of the run-up, which ends on phase 0 of the programme",
    "rundown": "what the flywheels are to do at a phase of the run-down, which begins on phase 0 of the programme",
}


def _outer(form: Form, inner: Function) -> Function:
    notes = ["The three belong together: speeds and accelerations are derivatives of the angles, to rounding."]
    if form.kind == "fourier":
        notes = ["Speeds and accelerations are derivatives of the angles, term by term."]
    arguments = tuple(a for a in inner.arguments if a.name != "table")
    purpose = _WORDS[form.part]
    return replace(
        inner,
        name=f"{form.prefix}at",
        purpose=f"{purpose[0].upper()}{purpose[1:]}.",
        arguments=arguments,
        notes=tuple(notes),
        public=True,
    )
