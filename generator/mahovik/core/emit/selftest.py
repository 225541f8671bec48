"""The self-test of a stand's C: golden vectors and a sweep, for the host and for the real board."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mahovik import __version__
from mahovik.contract.quantities import DRAWN_STEP, TABLES
from mahovik.core.emit.calls import (
    INDENT,
    Results,
    Shape,
    call,
    declaration,
    initialiser_of,
    over,
    over_members,
    passed,
)
from mahovik.core.emit.draws import Draws
from mahovik.core.emit.hexadecimal import hex_literal
from mahovik.core.emit.layout import wrapped
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.names import Names
from mahovik.core.emit.templates import template
from mahovik.core.lower import test_inputs
from mahovik.core.lower.golden import ACCEPTED, CASES, FAR, LISTED, SWEPT, Golden, tested
from mahovik.core.lower.test_inputs import Input
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.identity import Identities


def selftest(program: Program, golden: Golden, identities: Identities, lanes: int = 1, fast: bool = False) -> str:
    """Text of `<stand>_selftest.c`; `fast`: for C whose bits may differ, compared within ACCEPTED units."""
    return _SelfTest(program, golden).text(identities, lanes, fast)


class _SelfTest:
    """Collects the parts that the template puts in order."""

    def __init__(self, program: Program, golden: Golden) -> None:
        self._program = program
        self._golden = golden
        self._names = Names(program.name)
        self._results_of = Results(self._names)
        self._public = tested(program)
        self._structs = {s.name: s for s in program.structs}

    def text(self, identities: Identities, lanes: int, fast: bool) -> str:
        """The whole file."""
        parts: dict[str, Any] = {
            "members": [
                f"{declaration(self._names, a.name, a.type, a.shape)};" for a in test_inputs.inputs(self._program)
            ],
            "results": [(f.name, self._results(f)) for f in self._public],
            "takes": [self._results_of.struct(s) for s in self._results_of.structs(self._public)],
            "functions": [self._function(f) for f in self._public],
            "draws": self._draws(),
            "scales": over_members(self._names, self._structs["parameters"], self._scaled, "parameters"),
            "inputs": [self._given(case) for case in self._golden.inputs],
            "answers": [self._answers(f) for f in self._public],
        }
        code = "\n".join(str(part) for part in parts.values())
        precision = self._program.precision
        return template("selftest.c.j2").render(
            **parts,
            left_out=[
                self._names.function(f.name) for f in self._program.functions if f.public and f not in self._public
            ],
            name=self._program.name,
            NAME=self._program.name.upper(),
            version=__version__,
            structure=identities.structure,
            physics=identities.physics,
            real=precision.name,
            lanes=lanes,
            wide=lanes > 1,
            fast=fast,
            kind=f"{f' lanes {lanes}' if lanes > 1 else ''}{' fast' if fast else ''}",
            unit="units" if fast else "ulp",
            judged=len(CASES) + (0 if fast else 1),
            accepted=ACCEPTED,
            zero=self._real(0.0),
            greatest=self._real(precision.largest),
            epsilon=self._real(2.0 ** -(53 if precision.width == 64 else 24)),
            width=precision.width,
            cases=CASES,
            far=FAR,
            seed=f"0x{test_inputs.SEED:x}u",
            swept=SWEPT,
            listed=LISTED,
            sign_bit=precision.width - 1,
            bytes=precision.width // 8,
            fast_every=test_inputs.FAST_EVERY,
            fast_last=test_inputs.FAST_EVERY - 1,
            fast_factor=self._real(test_inputs.FAST),
            refused_every=test_inputs.REFUSED_EVERY,
            refused_last=test_inputs.REFUSED_EVERY - 1,
            one=self._real(1.0),
            two=self._real(2.0),
            half_range=self._real(2.0**23),
            takes_ints="take_ints(" in code,
            drawn={each.rule.name.lower() for each in self._golden.plan},
            step=hex_literal(DRAWN_STEP, precision),
            draws_fast="* fast)" in code,
            mounting="mount_table" in self._structs,
        )

    def _real(self, value: float) -> str:
        """A decimal literal."""
        return real_literal(value, self._program.precision)

    # ---- calls ----

    def _results(self, function: Function) -> list[str]:
        """Members of the union for what a function writes."""
        found = [
            f"{declaration(self._names, a.name, a.type, a.shape)};" for a in function.arguments if a.direction != "in"
        ]
        if function.returns is Kind.REAL:
            found.append(f"{declaration(self._names, 'value', Kind.REAL)};")
        return found

    def _function(self, f: Function) -> dict[str, Any]:
        """Lines that call a function, and lines that take its results."""
        begins = [
            line for a in f.arguments if a.direction == "inout" for line in self._begin(a, f"results.{f.name}.{a.name}")
        ]
        text = call(self._names, f, lambda a: self._passed(f, a))
        if f.returns is Kind.STATUS:
            lines = wrapped(f"return {text};", INDENT)
        elif f.returns is Kind.REAL:
            lines = wrapped(f"results.{f.name}.value = {text};", INDENT) + self._good()
        else:
            lines = wrapped(f"{text};", INDENT) + self._good()
        take = list(self._take(f))
        return {
            "name": f.name,
            "call": [*begins, *lines],
            "take": take,
            "reads_status": any("(status " in line for line in take),
        }

    def _good(self) -> list[str]:
        return [f"{INDENT}return {self._names.constant('OK')};"]

    def _begin(self, a: Argument, place: str) -> list[str]:
        """A result that is an input as well begins with the input."""
        source = self._source(a)
        return over(
            self._names, place, a.shape, INDENT, lambda e, indent, _: [f"{indent}{e} = {e.replace(place, source, 1)};"]
        )

    def _source(self, a: Argument) -> str:
        """Where an input stands: in what was drawn, or among the constants of the stand."""
        kind = a.type.name if isinstance(a.type, Struct) else ""
        table = TABLES.get(kind)
        if table is None:
            return f"in.{a.name}"
        varied = table.symbol in ("mounting", "parameters")  # masses are multiplied in each state
        return table.symbol if varied else self._names.function(table.default)

    def _passed(self, f: Function, a: Argument) -> str:
        return passed(a, self._source(a) if a.direction == "in" else f"results.{f.name}.{a.name}")

    # ---- taking results ----

    def _take(self, f: Function) -> Iterator[str]:
        """Lines that take what a function has written; what is an input as well is taken after a refusal too."""
        for a in f.arguments:
            if a.direction == "inout":
                yield from self._results_of.taken(f"results.{f.name}.{a.name}", a.type, a.shape, INDENT)
        out = [(a.name, a.type, a.shape) for a in f.arguments if a.direction == "out"]
        if f.returns is Kind.REAL:
            out.append(("value", Kind.REAL, ()))
        if not out:
            return
        if f.returns is Kind.STATUS:
            yield f"{INDENT}if (status < 0) {{"
            for name, _, _ in out:
                place = f"results.{f.name}.{name}"
                yield from wrapped(f"untouched(sum, &{place}, sizeof {place});", INDENT * 2)
            yield f"{INDENT * 2}return;"
            yield f"{INDENT}}}"
        for name, type_, shape in out:
            yield from self._results_of.taken(f"results.{f.name}.{name}", type_, shape, INDENT)

    # ---- drawing inputs ----

    def _draws(self) -> list[str]:
        """Lines that draw all inputs in the order of the plan."""
        draws = Draws(self._names, "seed", lambda path: f"in.{'.'.join(path)}", self._largest, ", refused")
        return [line for each in self._golden.plan for line in draws.lines(each)]

    def _largest(self, given: Input) -> str:
        return self._real(given.largest) + (" * fast" if given.name in test_inputs.FAST_INPUTS else "")

    def _scaled(self, f: Field, place: str, indent: str, depth: int) -> list[str]:
        """Lines that multiply a member of the parameters where it is a mass or an inertia."""
        if f.name not in test_inputs.SCALED:
            return []
        factor = f"in.{test_inputs.MASS_FACTOR}"
        return over(self._names, place, f.shape, indent, lambda e, i, _: [f"{i}{e} = {e} * {factor};"], depth)

    # ---- golden numbers ----

    def _given(self, case: dict[str, Any]) -> list[str]:
        """Initialiser of one case of golden inputs."""
        lines: list[str] = []

        def visit(name: str, type_: Kind | Struct, shape: Shape, value: Any, indent: str) -> None:
            if isinstance(type_, Struct):
                lines.append(f"{indent}.{name} = {{")
                for f in type_.fields:
                    visit(f.name, f.type, f.shape, value[f.name], indent + INDENT)
                lines.append(f"{indent}}},")
            else:
                lines.extend(wrapped(f".{name} = {self._literal(type_, shape, value)},", indent))

        for a in test_inputs.inputs(self._program):
            visit(a.name, a.type, a.shape, case[a.name], INDENT * 2)
        visit(test_inputs.MASS_FACTOR, Kind.REAL, (), case[test_inputs.MASS_FACTOR], INDENT * 2)
        return lines

    def _literal(self, type_: Kind, shape: Shape, value: Any) -> str:
        return initialiser_of(type_, shape, value, self._program.precision)

    def _answers(self, f: Function) -> dict[str, Any]:
        """What one function must answer."""
        answers = self._golden.answers[f.name]
        precision = self._program.precision
        cases = [(a.status, f"0x{a.hash:08x}u", len(a.listed)) for a in answers]
        numbers = [
            wrapped(", ".join(hex_literal(float(x), precision) for x in a.listed) + ",", INDENT)
            for a in answers
            if a.listed
        ]
        numbers = numbers or [[f"{INDENT}{self._real(0.0)}"]]  # an array has at least one element
        return {"name": f.name, "cases": cases, "numbers": numbers, "sweep": f"0x{self._golden.sweep[f.name]:08x}u"}
