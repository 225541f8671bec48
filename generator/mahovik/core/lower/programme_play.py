"""The functions of a programme run by the interpreter: answers for its self-test, and for judging its tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.core.lower.golden import fnv1a
from mahovik.core.lower.programme import Course, ProgrammeProgram
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import Kind, Precision

TICKS, PERIODS = 97, 3
"""The control loop of the self-test: an increment that leaves something over."""

SWEEP = 200
"""Ticks of it."""

GOOD = (0.0, 2.0**-20, 0.25, 1.0 / 3.0, 0.5, 0.7109375, 0.96875)
"""Phases that are answered, beside the largest; they lie on nodes and between."""

REFUSED = (-0.25, 1.5)
"""Phases that are out of range; infinity and NaN are made by the test itself."""


@dataclass(frozen=True)
class GoldenCourse:
    """Phases of a table with the answers to them, all outputs in order."""

    course: Course
    phases: tuple[Any, ...]
    answers: tuple[tuple[Any, ...], ...]


@dataclass(frozen=True)
class Golden:
    """Answers of every table, and the hash of the outputs of the self-test's control loop."""

    courses: tuple[GoldenCourse, ...]
    hash: int


class Player:
    """Interpreter and tables of a programme; `values` by part, "" the programme itself."""

    def __init__(self, made: ProgrammeProgram, values: Mapping[str, Mapping[str, Any]]) -> None:
        self._made = made
        self._precision: Precision = made.program.precision
        self._interpreter = Interpreter(made.program)
        self._tables = {
            c.form.part: self._interpreter.fill_storage(c.form.table, values[c.form.part]) for c in made.courses
        }

    def at(self, course: Course, phase: float) -> tuple[int, dict[str, Any]]:
        """Status and outputs by name."""
        inputs = {"table": self._tables[course.form.part], "phase": phase}
        status, outputs = self._interpreter.run(course.inner.name, inputs)
        return int(status), outputs

    def many(self, course: Course, phases: Sequence[float]) -> dict[str, np.ndarray[Any, np.dtype[np.float64]]]:
        """Outputs (M, N each) by name at good phases."""
        outputs = [a for a in course.inner.arguments if a.direction != "in"]
        storage = [self._interpreter.argument(a) for a in outputs]
        table, scalar = self._tables[course.form.part], self._interpreter.fill_storage
        answers = np.empty((len(phases), len(outputs), int(course.form.count)))
        for row, phase in zip(answers, phases, strict=True):
            self._interpreter.call(course.inner.name, table, scalar(Kind.REAL, phase), *storage)
            row[:] = storage
        return {a.name: answers[:, k] for k, a in enumerate(outputs)}

    def golden(self) -> Golden:
        """Answers for the self-test."""
        scalar = self._precision.scalar
        courses = []
        for course in self._made.courses:
            last = scalar(1) if not course.form.cyclic else scalar(1) - scalar(2.0**-self._precision.significand)
            phases = tuple(scalar(x) for x in (*GOOD, last))
            answers = tuple(self._as_tuple(self.at(course, float(x))[1]) for x in phases)
            courses.append(GoldenCourse(course, phases, answers))
        return Golden(tuple(courses), self._loop())

    def _as_tuple(self, outputs: Mapping[str, Any]) -> tuple[Any, ...]:
        return tuple(self._precision.scalar(x) for values in outputs.values() for x in values)

    def _loop(self) -> int:
        """FNV-1a of all outputs of the programme at the phases of a clock."""
        kind = f"<f{self._precision.width // 8}"
        run = self._interpreter.run
        _, outputs_of_start = run("programme_start", {"ticks": TICKS, "periods": PERIODS})
        clock, total = outputs_of_start["clock"], fnv1a(b"")
        for _ in range(SWEEP):
            clock = run("programme_advance", {"clock": clock})[1]["clock"]
            phase = run("programme_phase", {"clock": clock})[1]["phase"]
            outputs = self.at(self._made.courses[0], phase)[1]
            total = fnv1a(np.array([phase, *self._as_tuple(outputs)], dtype=kind).tobytes(), total)
        return total
