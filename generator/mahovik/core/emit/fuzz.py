"""The fuzz harness of a stand's C: bytes of libFuzzer become arguments of every public function.

It is printed from the signatures of the program, so a new public function is fuzzed without further work.
"""

from __future__ import annotations

from typing import Any

from mahovik.contract.functions import row_of
from mahovik.contract.quantities import QUANTITIES, TABLES
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.calls import (
    address,
    argument_text,
    call,
    declaration,
    over_members,
    over_rows,
    row_length,
    take_functions,
    take_lines,
)
from mahovik.core.emit.code import Code
from mahovik.core.emit.declaration import pointer_arguments
from mahovik.core.emit.log_format import RECORDED
from mahovik.core.emit.selftest import Draws
from mahovik.core.lower import test_inputs
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.identity import Identities


def fuzz_harness(program: Program, identities: Identities) -> str:
    """Text of `<stand>_fuzz.c`. Raises ValueError for a public function without status: the harness asks for it."""
    return _Harness(Code(program, identities)).text()


class _Harness:
    """Collects the parts that the template puts in order."""

    def __init__(self, code: Code) -> None:
        self._code, self._names = code, code.names
        self._structs = {s.name: s for s in code.program.structs}
        self._inputs = test_inputs.inputs(code.program)
        self._plan = test_inputs.plan(code.program)
        self._drawing = Draws(
            self._names, "from", lambda path: _argument_name(".".join(path)), lambda drawn: self._largest(drawn.name)
        )

    def text(self) -> str:
        """The whole file."""
        code, precision, parameters = self._code, self._code.precision, self._structs["parameters"]
        takes = take_functions(self._names, code.public)
        draws = [{"name": a.name, "lines": self._draw_lines(a)} for a in self._inputs]
        vary = over_members(self._names, parameters, self._variation_lines, _argument_name("parameters"))
        functions = [self._function(f) for f in code.public]
        lines = [line for part in (*takes, *draws, *functions) for line in part["lines"]] + vary

        def is_called(function: str) -> bool:
            return any(f"{function}(" in line for line in lines)

        return code.render(
            "fuzz.c.j2",
            takes=takes,
            draws=draws,
            vary=vary,
            functions=functions,
            members=[f"static {declaration(self._names, a, _argument_name(a.name))}" for a in self._inputs],
            recorders=[self._recorder(f) for f in code.public if f.name in RECORDED],
            epsilon=code.real(precision.epsilon),
            smallest=code.real(precision.smallest),
            subnormal=code.real(precision.smallest * precision.epsilon),
            bounds=[macro for macro, _, _ in code.limits() if macro != self._names.constant("LARGEST")],
            largest=self._names.constant("LARGEST"),
            stream=self._largest("stream") if self._structs["table"].field("stream") else "",
            options=self._options() if "inverse_options" in self._structs else [],
            mounting="mount_table" in self._structs,
            takes_ints=is_called("take_ints"),
            varies_ints=is_called("vary_ints"),
            draws_flags=is_called("draw_flags"),
            draws_turns=is_called("draw_turns"),
        )

    def _largest(self, name: str) -> str:
        """The bound of an input as C has it."""
        row = QUANTITIES.get(name)
        return self._names.constant(row.bounds[0]) if row and row.bounds else self._code.real(1.0)

    # ---- drawing inputs ----

    def _draw_lines(self, a: Argument) -> list[str]:
        """Lines that draw one argument."""
        return [line for drawn in self._plan if drawn.path[0] == a.name for line in self._drawing.lines(drawn)]

    def _options(self) -> list[str]:
        """Lines that draw options, each member by its bound."""
        options = f"{_argument_name('options')}."
        return [
            f"vary_option(from, {address(options + f.name, f.shape)}, "
            f"{row_length(self._names, f.shape)}, {self._largest(f.name)});"
            for f in self._structs["inverse_options"].fields
        ]

    def _variation_lines(self, f: Field, place: str, depth: int) -> list[str]:
        """Lines that vary the numbers of one member of the parameters.

        A matrix, such as added mass, is symmetric: it is scaled as a whole first, then varied element by element.
        """
        what = "ints" if f.type is Kind.INT else "reals"
        first = f"{place}[0][0]"
        whole = [f"scale(from, &{first}, sizeof {place} / sizeof {first});"] if len(f.shape) == 2 else []
        rows = over_rows(self._names, place, f.shape, lambda row, n: f"vary_{what}(from, {row}, {n});", depth)
        return whole + rows

    # ---- calls ----

    def _function(self, f: Function) -> dict[str, Any]:
        """Return what the template needs to call one function twice and judge it."""
        if f.returns is not Kind.STATUS:
            raise ValueError(f"{f.name}: the fuzz harness judges functions that return a status")
        pointers = pointer_arguments(f)
        results = [a for a in f.arguments if a.direction != "in"]
        state = next((a.name for a in results if a.direction == "out" and self._is_state(f, a)), "")
        places = [(self._result(f, a), a) for a in results]
        drawn, draws = {a.name for a in self._inputs}, self._draws(f)
        kept = [draws.index(a.name) + 1 for a in f.arguments if a.direction == "inout" and a.name in drawn]

        def argument_or_null(a: Argument) -> str:
            text = self._argument_text(a, self._place(f, a))
            return f"null == {pointers.index(a) + 1}u ? NULL : {text}" if a in pointers else text

        def overlapping(a: Argument) -> str:
            return self._argument_text(a, f"{f.name}_{state}" if a.name in (state, "x") else self._place(f, a))

        return {
            "name": f.name,
            "declared": [declaration(self._names, a, place) for place, a in places],
            "draws": draws,
            "missing": [a.name for a in f.arguments if a.optional == "missing"],
            "kept": max(kept, default=0),
            "pointers": len(pointers),
            "results": [(place, self._source(a) if a.direction == "inout" else "") for place, a in places],
            "call": call(self._names, f, argument_or_null),
            "lines": [line for place, a in places for line in take_lines(self._names, place, a.type, a.shape)],
            "refusals": self._mask(f, negative=True, more=("BAD_ARGUMENT",) if pointers else ()),
            "bits": self._mask(f, negative=False),
            "may_ignore": row_of(f.name).unread,
            "overlap": call(self._names, f, overlapping) if state else "",
            "state": f"{f.name}_{state}",
        }

    def _argument_text(self, a: Argument, place: str) -> str:
        text = argument_text(a, place)
        return f"missing ? NULL : {text}" if a.optional == "missing" else text

    def _is_state(self, f: Function, a: Argument) -> bool:
        """A result that may be the state itself: of step and step_driven, as their contract says."""
        return a.name == "next" and any(b.direction == "in" and b.type is a.type for b in f.arguments)

    def _result(self, f: Function, a: Argument) -> str:
        return f"{f.name}_{a.name}"

    def _place(self, f: Function, a: Argument) -> str:
        if a.direction != "in":
            return self._result(f, a)
        return self._source(a)

    def _source(self, a: Argument) -> str:
        kind = a.type.name if isinstance(a.type, Struct) else ""
        return _argument_name(TABLES[kind].symbol if kind in TABLES else a.name)

    def _draws(self, f: Function) -> list[str]:
        """Names of what is drawn for a function, constants first: what prepare refuses is not used."""
        kinds = {a.type.name for a in f.arguments if isinstance(a.type, Struct) and a.direction != "out"}
        draws = []
        if "parameters" in kinds:
            draws.append("parameters")
        elif kinds & {"table", "mount_table"}:
            draws.append("tables")
        if "inverse_options" in kinds:
            draws.append("options")
        names = {a.name for a in self._inputs}
        named = [a for a in f.arguments if a.direction != "out" and a.name in names and a.name != test_inputs.COSINE]
        return draws + [a.name for a in sorted(named, key=lambda a: a.direction != "inout")]

    def _mask(self, f: Function, negative: bool, more: tuple[str, ...] = ()) -> str:
        """Statuses that a function documents: a bit each of the negative ones, the positive ones together."""
        values = sorted({STATUS_VALUES[s] for s in (*f.statuses, *more)})
        if negative:
            return " | ".join(f"1u << {-v}" for v in values if v < 0) or "0u"
        return " | ".join(f"{v}u" for v in values if v > 0) or "0u"

    def _recorder(self, f: Function) -> dict[str, Any]:
        """The recorder's step beside step itself."""
        taken = [a for a in f.arguments if a.name not in ("next", "table", "x")]

        def arguments_with(carry: str) -> str:
            return ", ".join(
                self._argument_text(a, carry if a.optional == "missing" else self._place(f, a)) for a in taken
            )

        texts = {"given": arguments_with("plain_carry"), "given_logged": arguments_with("logged_carry")}
        return {"name": f.name, "draws": self._draws(f), **texts}


def _argument_name(name: str) -> str:
    """Name of an argument in the harness: no name of the program or of the harness begins like it."""
    return f"in_{name}"
