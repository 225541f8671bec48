"""The self-test of a stand's C: golden vectors and a sweep, for the host and for the real board."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from mahovik.contract.quantities import DRAWN_STEP, TABLES, Draw
from mahovik.core.emit.calls import (
    argument_text,
    call,
    declaration,
    initialiser_of,
    nested_loops,
    over_members,
    over_rows,
    row_length,
    take_functions,
    take_lines,
)
from mahovik.core.emit.code import INDENT, Code
from mahovik.core.emit.layout import wrap_statement
from mahovik.core.emit.names import Names, member
from mahovik.core.lower import test_inputs
from mahovik.core.lower.golden import CASES, FAR, LISTED, SWEPT, Golden, is_prepared, tested_functions
from mahovik.core.lower.test_inputs import Input
from mahovik.core.lower.trials import ALL, CHANGED, Path
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Field, Kind, Shape, Struct
from mahovik.core.stand.identity import Identities

_SPECIAL = {"inf": "infinite", "nan": "not_a_number"}
"""Constants of the self-test for numbers that no literal of C99 is."""


def selftest(program: Program, golden: Golden, identities: Identities) -> str:
    """Text of `<stand>_selftest.c`."""
    return _SelfTest(Code(program, identities), golden).text()


def is_pointer(a: Argument) -> bool:
    """Whether an argument is an address that must not be null."""
    return (bool(a.shape) or a.variable.pointer) and not a.optional


class _SelfTest:
    """Collects the parts that the template puts in order."""

    def __init__(self, code: Code, golden: Golden) -> None:
        self._code, self._golden, self._names = code, golden, code.names
        self._tested = tested_functions(code.program)
        self._structs = {s.name: s for s in code.program.structs}

    def text(self) -> str:
        """The whole file."""
        code, drawn = self._code, test_inputs.inputs(self._code.program)
        parameters = self._structs["parameters"]
        functions = [self._function(f) for f in self._tested]
        takes = take_functions(self._names, self._tested)
        draws = self._draws()
        return code.render(
            "selftest.c.j2",
            members=[declaration(self._names, a) for a in drawn],
            takes=takes,
            functions=functions,
            draws=draws,
            refusing=any("refused" in line for draw in draws for line in (draw if isinstance(draw, list) else [draw])),
            scales=over_members(self._names, parameters, self._scaling_lines, "parameters"),
            inputs=[self._case_initialiser(case, drawn) for case in self._golden.inputs],
            left_out=[self._names.function(f.name) for f in code.public if f not in self._tested],
            judged=len(CASES) + 2,
            to_integer=code.real(1.5 * 2.0 ** (code.precision.significand - 1)),
            cases=CASES,
            sign_bit=code.precision.width - 1,
            far=FAR,
            seed=f"0x{test_inputs.SEED:x}u",
            swept=SWEPT,
            listed=LISTED,
            fast_every=test_inputs.FAST_EVERY,
            fast_last=test_inputs.FAST_EVERY - 1,
            fast_factor=test_inputs.FAST,
            refused_every=test_inputs.REFUSED_EVERY,
            refused_last=test_inputs.REFUSED_EVERY - 1,
            takes_ints=any("take_ints(" in line for part in (*takes, *functions) for line in part["lines"]),
            drawn={part.rule.name.lower() for part in (*self._golden.plan, *self._golden.options_plan)},
            step=DRAWN_STEP,
            draws_fast=any("* fast)" in line for line in draws),
            mounting="mount_table" in self._structs,
            options="inverse_options" in self._structs and bool(self._golden.options_plan),
            options_draws=self._options_draws(),
            options_every=test_inputs.OPTIONS_EVERY,
            options_last=test_inputs.OPTIONS_EVERY - 1,
            omitted_every=test_inputs.OMITTED_EVERY,
            omitted_last=test_inputs.OMITTED_EVERY - 1,
            **self._trials(),
        )

    # ---- calls ----

    def _function(self, f: Function) -> dict[str, Any]:
        """Values of the template for one function: results, a call, lines that take results, expected answers."""
        results = [a for a in f.arguments if a.direction != "in"]
        status, number = f.returns is Kind.STATUS, f.returns is Kind.REAL
        out = [(a.name, a.type, a.shape) for a in results if a.direction == "out"]
        out += [("value", Kind.REAL, ())] if number else []
        kept = [(a.name, a.type, a.shape) for a in results if a.direction == "inout"]
        text = call(self._names, f, lambda a: self._argument_text(f, a))
        returned = "return " if status else f"results.{f.name}.value = " if number else ""
        answers = self._golden.answers[f.name]
        return {
            "name": f.name,
            "results": [declaration(self._names, a) for a in results]
            + ([f"{self._names.declaration('value', Kind.REAL)};"] if number else []),
            "pointers": sum(is_pointer(a) for a in f.arguments) if status else 0,
            "begins": [line for a in results if a.direction == "inout" for line in self._begin(f, a)],
            "call": wrap_statement(f"{returned}{text};", INDENT),
            "status": status,
            "refusable": status and bool(out),
            "kept_bytes": " + ".join(f"sizeof results.{f.name}.{name}" for name, *_ in kept) or "0u",
            "kept": [line for check in kept for line in self._take_lines(f, *check)],
            "lines": [line for check in out for line in self._take_lines(f, *check)],
            "cases": [(a.status, f"0x{a.hash:08x}u", len(a.listed)) for a in answers],
            "numbers": [
                wrap_statement(", ".join(map(self._code.hex, a.listed)) + ",", INDENT) for a in answers if a.listed
            ],
            "sweep": f"0x{self._golden.sweep[f.name]:08x}u",
        }

    def _take_lines(self, f: Function, name: str, type_: Kind | Struct, shape: Shape) -> list[str]:
        return take_lines(self._names, f"results.{f.name}.{name}", type_, shape)

    def _begin(self, f: Function, a: Argument) -> list[str]:
        """Lines that begin a result; one that is also an input begins with the input."""
        place, source = f"results.{f.name}.{a.name}", self._source(a)
        return nested_loops(self._names, place, a.shape, lambda e, _: [f"{e} = {e.replace(place, source, 1)};"])

    def _source(self, a: Argument) -> str:
        """Place of an input: among the drawn inputs, or among the constants of the stand."""
        kind = a.type.name if isinstance(a.type, Struct) else ""
        table = TABLES.get(kind)
        if table is None:
            return f"in.{a.name}"
        varied = table.symbol in ("mounting", *CHANGED)
        return table.symbol if varied else self._names.function(table.default)

    def _argument_text(self, f: Function, a: Argument) -> str:
        text = argument_text(a, self._source(a) if a.direction == "in" else f"results.{f.name}.{a.name}")
        if isinstance(a.type, Struct) and a.type.name == "table" and a.direction == "in":
            text = "table"
        if a.optional:
            return f"(omitted < 0) ? NULL : {text}"
        number = (
            [argument.name for argument in f.arguments if is_pointer(argument)].index(a.name) + 1
            if is_pointer(a)
            else 0
        )
        return f"(omitted == {number}) ? NULL : {text}" if number and f.returns is Kind.STATUS else text

    # ---- trials ----

    def _bits(self, value: float) -> str:
        """Bits of a number as a literal."""
        size = self._code.precision.width // 8
        return f"0x{int.from_bytes(np.array(value, f'<f{size}').tobytes(), 'little'):x}u"

    def _trials(self) -> dict[str, Any]:
        """Values of the template for the trials: statements of each change, and a row for each answer."""
        numbers = {f.name: k for k, f in enumerate(self._tested)}
        changes = list(dict.fromkeys(tuple(trial.changes.items()) for trial in self._golden.trials))
        values = {str(value) for trial in changes for _, value in trial}
        prepares, rows = "prepare" in numbers, []
        for trial in self._golden.trials:
            words = [0] * (len(numbers) // 32 + 1)
            for name in trial.functions:
                words[numbers[name] // 32] |= 1 << numbers[name] % 32
            called = ", ".join(f"0x{word:x}u" for word in words)
            made = any(is_prepared(f, trial.changes) for f in self._tested if f.name in trial.functions)
            prepared = f"{int(made)}, " if prepares else ""
            at = changes.index(tuple(trial.changes.items()))
            rows.append(f"{{ {at}, {trial.status}, {prepared}0x{trial.hash:08x}u, {{ {called} }} }},")
        return {
            "changes": [[line for path, value in trial for line in self._change(path, value)] for trial in changes],
            "trials": rows,
            "specials": {_SPECIAL[x]: self._bits(float(x)) for x in _SPECIAL if x in values},
            "words": len(numbers) // 32 + 1,
            "prepares": prepares,
        }

    def _change(self, path: Path, value: float) -> list[str]:
        """Statements that put a value into a place."""
        root = str(path[0])
        arguments = (a for f in self._tested for a in f.arguments if a.name == root)
        type_ = next(arguments).type
        place = root if root in CHANGED else f"in.{root}"
        loop = ""
        for part in path[1:]:
            if part == ALL:
                place, loop = f"{place}[s]", f"for (int s = 0; s < {self._names.constant('N')}; ++s) "
            elif isinstance(part, int):
                place = f"{place}[{part}]"
            else:
                assert isinstance(type_, Struct)
                type_ = next(f.type for f in type_.fields if f.name == part)
                place = f"{place}.{member(part)}"
        if str(value) in _SPECIAL:
            text = f"{_SPECIAL[str(value)]}.real"
        else:
            text = str(int(value)) if type_ is Kind.INT else self._code.hex(value)
        return [f"{loop}{{ {place} = {text}; }}" if loop else f"{place} = {text};"]

    # ---- drawing inputs ----

    def _options_draws(self) -> list[str]:
        """Lines that draw the options of `inverse`."""
        draws = Draws(self._names, "seed", ".".join, lambda drawn: self._code.real(drawn.largest))
        return [line for drawn in self._golden.options_plan for line in draws.lines(drawn)]

    def _draws(self) -> list[str]:
        """Lines that draw all inputs in the order of the plan."""
        draws = Draws(self._names, "seed", lambda path: f"in.{'.'.join(path)}", self._largest, ", refused")
        return [line for drawn in self._golden.plan for line in draws.lines(drawn)]

    def _largest(self, drawn: Input) -> str:
        return self._code.real(drawn.largest) + (" * fast" if drawn.name in test_inputs.FAST_INPUTS else "")

    def _scaling_lines(self, f: Field, place: str, depth: int) -> list[str]:
        """Lines that multiply a member of the parameters where it is a mass or an inertia."""
        if f.name not in test_inputs.SCALED:
            return []
        factor = f"in.{test_inputs.MASS_FACTOR}"
        return nested_loops(self._names, place, f.shape, lambda e, _: [f"{e} = {e} * {factor};"], depth)

    # ---- golden numbers ----

    def _case_initialiser(self, case: dict[str, Any], drawn: Sequence[Argument]) -> list[str]:
        """Initialiser of one case of golden inputs."""
        lines: list[str] = []

        def visit(name: str, type_: Kind | Struct, shape: Shape, value: Any, indent: str) -> None:
            if isinstance(type_, Struct):
                lines.append(f"{indent}.{name} = {{")
                for f in type_.fields:
                    visit(f.name, f.type, f.shape, value[f.name], indent + INDENT)
                lines.append(f"{indent}}},")
            else:
                literal = initialiser_of(type_, shape, value, self._code.precision)
                lines.extend(wrap_statement(f".{name} = {literal},", indent))

        for a in drawn:
            visit(a.name, a.type, a.shape, case[a.name], INDENT * 2)
        visit(test_inputs.MASS_FACTOR, Kind.REAL, (), case[test_inputs.MASS_FACTOR], INDENT * 2)
        return lines


class Draws:
    """Calls of `draw_reals`, `draw_flags` and similar functions, which a template defines.

    source    variable that they draw from
    place     C text of an input from its path
    largest   C text of the largest magnitude of an input
    attitude  last arguments of `draw_attitude`
    """

    def __init__(
        self,
        names: Names,
        source: str,
        place: Callable[[tuple[str, ...]], str],
        largest: Callable[[Input], str],
        attitude: str = "",
    ) -> None:
        self._names, self._source, self._attitude = names, source, attitude
        self._place, self._largest = place, largest

    def lines(self, drawn: Input) -> list[str]:
        """Lines that draw one input."""
        place, source, rule = self._place(drawn.path), self._source, drawn.rule
        if rule is Draw.ATTITUDE:
            return [f"draw_attitude({source}, {place}{self._attitude});"]
        if rule is Draw.TURNS:
            cosine = self._place((*drawn.path[:-1], test_inputs.COSINE))
            return [f"draw_turns({source}, {place}, {cosine}, {row_length(self._names, drawn.shape)});"]
        if rule in (Draw.REALS, Draw.POWER, Draw.FLAGS):
            what = {Draw.REALS: "reals", Draw.POWER: "powers", Draw.FLAGS: "flags"}[rule]
            more = "" if rule is Draw.FLAGS else f", {self._largest(drawn)}"
            return over_rows(
                self._names, place, drawn.shape, lambda row, n: f"draw_{what}({source}, {row}, {n}{more});"
            )
        values = {
            Draw.ORDER: f"draw_order({source})",
            Draw.STEP: f"draw_step({source})",
            Draw.SHARE: f"draw_share({source})",
            Draw.FACTOR: f"draw_factor({source}, {self._largest(drawn)})",
        }
        return [f"{place} = {values[rule]};"]
