"""The self-test of a stand's C: golden vectors and a sweep, for the host and for the real board."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mahovik import __version__
from mahovik.contract.quantities import DRAWN_STEP, TABLES, Draw
from mahovik.core.emit.hexadecimal import hex_literal
from mahovik.core.emit.layout import wrapped
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.names import Names
from mahovik.core.emit.places import STEP, Results, closed, length, loops
from mahovik.core.emit.statement import dimensions
from mahovik.core.emit.templates import template
from mahovik.core.lower import test_inputs
from mahovik.core.lower.golden import ACCEPTED, CASES, FAR, LISTED, SWEPT, Golden, tested
from mahovik.core.lower.test_inputs import Input
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Kind, Struct
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
            "members": [f"{self._declared(a.name, a.type, a.shape)};" for a in test_inputs.inputs(self._program)],
            "results": [(f.name, self._results(f)) for f in self._public],
            "takes": [self._results_of.struct(s) for s in self._results_of.structs(self._public)],
            "functions": [self._function(f) for f in self._public],
            "draws": list(self._draws()),
            "scales": self._scale(self._structs["parameters"], "parameters"),
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
            draws_flags="draw_flags(" in code,
            draws_fast="* fast)" in code,
            draws_turns="draw_turns(" in code,
            mounting="mount_table" in self._structs,
        )

    def _real(self, value: float) -> str:
        """A decimal literal."""
        return real_literal(value, self._program.precision)

    def _declared(self, name: str, type_: Kind | Struct, shape: tuple[Any, ...]) -> str:
        return f"{self._names.type(type_)} {name}{''.join(dimensions(self._names, shape))}"

    # ---- calls ----

    def _results(self, function: Function) -> list[str]:
        """Members of the union for what a function writes."""
        found = [f"{self._declared(a.name, a.type, a.shape)};" for a in function.arguments if a.direction != "in"]
        if function.returns is Kind.REAL:
            found.append(f"{self._declared('value', Kind.REAL, ())};")
        return found

    def _function(self, f: Function) -> dict[str, Any]:
        """How a function is called, and how its results are taken."""
        begins = [
            line for a in f.arguments if a.direction == "inout" for line in self._begin(a, f"results.{f.name}.{a.name}")
        ]
        call = f"{self._names.function(f.name)}({', '.join(self._passed(f, a) for a in f.arguments)})"
        if f.returns is Kind.STATUS:
            lines = wrapped(f"return {call};", STEP)
        elif f.returns is Kind.REAL:
            lines = wrapped(f"results.{f.name}.value = {call};", STEP) + self._good()
        else:
            lines = wrapped(f"{call};", STEP) + self._good()
        take = list(self._take(f))
        return {
            "name": f.name,
            "call": [*begins, *lines],
            "take": take,
            "reads_status": any("(status " in line for line in take),
        }

    def _good(self) -> list[str]:
        return [f"{STEP}return {self._names.constant('OK')};"]

    def _begin(self, a: Argument, place: str) -> Iterator[str]:
        """A result that is an input as well begins with the input."""
        if a.shape:
            loop, element, indent = loops(place, len(a.shape), [length(self._names, n) for n in a.shape], STEP)
            yield from loop
            yield f"{indent}{element} = {element.replace(place, 'in.' + a.name, 1)};"
            yield from closed(len(loop), STEP)
        else:
            yield f"{STEP}{place} = {self._source(a)};"

    def _source(self, a: Argument) -> str:
        """Where an input stands: in what was drawn, or among the constants of the stand."""
        kind = a.type.name if isinstance(a.type, Struct) else ""
        table = TABLES.get(kind)
        if table is None:
            return f"in.{a.name}"
        varied = table.symbol in ("mounting", "parameters")  # masses are multiplied in each state
        return table.symbol if varied else self._names.function(table.default)

    def _passed(self, f: Function, a: Argument) -> str:
        place = self._source(a) if a.direction == "in" else f"results.{f.name}.{a.name}"
        return f"&{place}" if a.variable.pointer else place

    # ---- taking results ----

    def _take(self, f: Function) -> Iterator[str]:
        """Lines that take what a function has written; what is an input as well is taken after a refusal too."""
        for a in f.arguments:
            if a.direction == "inout":
                yield from self._results_of.taken(f"results.{f.name}.{a.name}", a.type, a.shape, STEP)
        out = [(a.name, a.type, a.shape) for a in f.arguments if a.direction == "out"]
        if f.returns is Kind.REAL:
            out.append(("value", Kind.REAL, ()))
        if not out:
            return
        if f.returns is Kind.STATUS:
            yield f"{STEP}if (status < 0) {{"
            for name, _, _ in out:
                place = f"results.{f.name}.{name}"
                yield f"{STEP * 2}untouched(sum, &{place}, sizeof {place});"
            yield f"{STEP * 2}return;"
            yield f"{STEP}}}"
        for name, type_, shape in out:
            yield from self._results_of.taken(f"results.{f.name}.{name}", type_, shape, STEP)

    # ---- drawing inputs ----

    def _draws(self) -> Iterator[str]:
        """Lines that draw all inputs in the order of the plan."""
        for each in self._golden.plan:
            place = f"in.{'.'.join(each.path)}"
            yield from self._draw(each, place)

    def _draw(self, each: Input, place: str) -> Iterator[str]:
        match each.rule:
            case Draw.ATTITUDE:
                yield f"{STEP}draw_attitude(seed, {place}, refused);"
            case Draw.TURNS:
                cosine = "in." + ".".join((*each.path[:-1], test_inputs.COSINE))
                yield f"{STEP}draw_turns(seed, {place}, {cosine}, {length(self._names, each.shape[-1])});"
            case Draw.INTEGER:
                yield f"{STEP}{place} = {each.lowest} + (int)(draw_word(seed) % {each.span}u);"
            case Draw.ORDER:
                yield f"{STEP}{place} = (draw_word(seed) & 0x100u) != 0u ? 4 : 2;"
            case Draw.STEP:
                yield f"{STEP}{place} = {hex_literal(DRAWN_STEP, self._program.precision)};"
            case Draw.FACTOR:
                yield f"{STEP}{place} = {self._real(1.0)} + draw_real(seed, {self._real(each.largest)});"
            case Draw.REALS | Draw.FLAGS:
                outer = each.shape[:-1]
                loop, element, inner = loops(place, len(outer), [length(self._names, n) for n in outer], STEP)
                yield from loop
                address = element if each.shape else f"&{element}"
                count = length(self._names, each.shape[-1]) if each.shape else "1"
                if each.rule is Draw.FLAGS:
                    yield f"{inner}draw_flags(seed, {address}, {count});"
                else:
                    size = self._real(each.largest) + (" * fast" if each.name in test_inputs.FAST_INPUTS else "")
                    yield f"{inner}draw_reals(seed, {address}, {count}, {size});"
                yield from closed(len(loop), STEP)

    def _scale(self, struct: Struct, place: str, depth: int = 0) -> list[str]:
        """Lines that multiply masses and inertias of the parameters."""
        found: list[str] = []
        for f in struct.fields:
            if not isinstance(f.type, Struct) and f.name not in test_inputs.SCALED:
                continue
            loop, element, inner = loops(
                f"{place}.{f.name}", len(f.shape), [length(self._names, n) for n in f.shape], STEP * (depth + 1), depth
            )
            if isinstance(f.type, Struct):
                body = self._scale(f.type, element, depth + len(loop))
            else:
                body = [f"{inner}{element} = {element} * in.{test_inputs.MASS_FACTOR};"]
            if body:
                found += [*loop, *body, *closed(len(loop), STEP * (depth + 1))]
        return found

    # ---- golden numbers ----

    def _given(self, case: dict[str, Any]) -> list[str]:
        """Initialiser of one case of golden inputs."""
        lines: list[str] = []

        def visit(name: str, type_: Kind | Struct, shape: tuple[Any, ...], value: Any, indent: str) -> None:
            if isinstance(type_, Struct):
                lines.append(f"{indent}.{name} = {{")
                for f in type_.fields:
                    visit(f.name, f.type, f.shape, value[f.name], indent + STEP)
                lines.append(f"{indent}}},")
            else:
                lines.extend(wrapped(f".{name} = {self._literal(type_, shape, value)},", indent))

        for a in test_inputs.inputs(self._program):
            visit(a.name, a.type, a.shape, case[a.name], STEP * 2)
        visit(test_inputs.MASS_FACTOR, Kind.REAL, (), case[test_inputs.MASS_FACTOR], STEP * 2)
        return lines

    def _literal(self, type_: Kind, shape: tuple[Any, ...], value: Any) -> str:
        if shape:
            return "{ " + ", ".join(self._literal(type_, shape[1:], each) for each in value) + " }"
        return hex_literal(float(value), self._program.precision) if type_ is Kind.REAL else str(int(value))

    def _answers(self, f: Function) -> dict[str, Any]:
        """What one function must answer."""
        answers = self._golden.answers[f.name]
        precision = self._program.precision
        cases = [(a.status, f"0x{a.hash:08x}u", len(a.listed)) for a in answers]
        numbers = [
            wrapped(", ".join(hex_literal(float(x), precision) for x in a.listed) + ",", STEP)
            for a in answers
            if a.listed
        ]
        numbers = numbers or [[f"{STEP}{self._real(0.0)}"]]  # an array has at least one element
        return {"name": f.name, "cases": cases, "numbers": numbers, "sweep": f"0x{self._golden.sweep[f.name]:08x}u"}
