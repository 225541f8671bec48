"""The fuzz harness of a stand's C: bytes of libFuzzer become arguments of every public function.

It is printed from the signatures of the program, so a new public function is fuzzed without anybody's doing.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mahovik import __version__
from mahovik.contract.functions import FUNCTIONS
from mahovik.contract.quantities import QUANTITIES, TABLES
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.calls import INDENT, Results, address, call, declaration, over, over_members, passed, row_length
from mahovik.core.emit.declaration import pointed
from mahovik.core.emit.draws import Draws
from mahovik.core.emit.layout import wrapped
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.names import Names
from mahovik.core.emit.templates import template
from mahovik.core.lower import test_inputs
from mahovik.core.lower.limits import limits
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.identity import Identities


def fuzz_harness(program: Program, identities: Identities) -> str:
    """Text of `<stand>_fuzz.c`. Raises ValueError for a public function without status: the harness asks for it."""
    return _Harness(program).text(identities)


class _Harness:
    """Collects the parts that the template puts in order."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._names = Names(program.name)
        self._results = Results(self._names)
        self._public = [f for f in program.functions if f.public]
        self._structs = {s.name: s for s in program.structs}
        self._inputs = test_inputs.inputs(program)
        self._plan = test_inputs.plan(program)
        self._limits = limits(program.precision)
        self._drawing = Draws(
            self._names, "from", lambda path: _given(".".join(path)), lambda given: self._largest(given.name)
        )

    def text(self, identities: Identities) -> str:
        """The whole file."""
        precision = self._program.precision
        table = self._structs["table"]
        parts: dict[str, Any] = {
            "members": [f"static {declaration(self._names, _given(a.name), a.type, a.shape)};" for a in self._inputs],
            "takes": [self._results.struct(s) for s in self._results.structs(self._public)],
            "draws": [{"name": a.name, "lines": list(self._drawn(a))} for a in self._inputs],
            "vary": over_members(self._names, self._structs["parameters"], self._varied, _given("parameters")),
            "functions": [self._function(f) for f in self._public],
            "recorders": [self._recorder(f) for f in self._public if f.name in ("step", "step_driven")],
        }
        code = "\n".join(str(part) for part in parts.values())
        return template("fuzz.c.j2").render(
            **parts,
            name=self._program.name,
            NAME=self._program.name.upper(),
            version=__version__,
            structure=identities.structure,
            physics=identities.physics,
            width=precision.width,
            bytes=precision.width // 8,
            real=self._real,
            epsilon=self._real(precision.epsilon),
            smallest=self._real(precision.smallest),
            subnormal=self._real(precision.smallest * precision.epsilon),
            bounds=[self._names.constant(n) for n in self._limits if n != "LARGEST"],
            largest=self._names.constant("LARGEST"),
            stream=self._largest("stream") if table.field("stream") else "",
            options=self._options() if "inverse_options" in self._structs else [],
            mounting="mount_table" in self._structs,
            takes_ints="take_ints(" in code,
            varies_ints="vary_ints(" in code,
            draws_flags="draw_flags(" in code,
            draws_turns="draw_turns(" in code,
            draws_int="draw_int(" in code,
        )

    def _real(self, value: float) -> str:
        return real_literal(value, self._program.precision)

    def _largest(self, name: str) -> str:
        """The bound of an input as C has it."""
        row = QUANTITIES.get(name)
        return self._names.constant(row.bounds[0]) if row and row.bounds else self._real(1.0)

    # ---- drawing inputs ----

    def _drawn(self, a: Argument) -> Iterator[str]:
        """Lines that draw one argument."""
        for each in self._plan:
            if each.path[0] == a.name:
                yield from self._drawing.lines(each)

    def _options(self) -> list[str]:
        """Lines that draw options, each member by its bound."""
        options = f"{_given('options')}."
        return [
            f"{INDENT}vary_option(from, {address(options + f.name, f.shape)}, "
            f"{row_length(self._names, f.shape)}, {self._largest(f.name)});"
            for f in self._structs["inverse_options"].fields
        ]

    def _varied(self, f: Field, place: str, indent: str, depth: int) -> list[str]:
        """Lines that vary the numbers of one member of the parameters.

        A matrix, such as added mass, is symmetric: it is scaled as a whole first, then varied element by element.
        """
        what = "ints" if f.type is Kind.INT else "reals"
        first = f"{place}[0][0]"
        whole = [f"{indent}scale(from, &{first}, sizeof {place} / sizeof {first});"] if len(f.shape) == 2 else []
        size = row_length(self._names, f.shape)
        return whole + over(
            self._names,
            place,
            f.shape[:-1],
            indent,
            lambda row, i, _: [f"{i}vary_{what}(from, {address(row, f.shape)}, {size});"],
            depth,
        )

    # ---- calls ----

    def _function(self, f: Function) -> dict[str, Any]:
        """Return what the template needs to call one function twice and judge it."""
        if f.returns is not Kind.STATUS:
            raise ValueError(f"{f.name}: the fuzz harness judges functions that return a status")
        pointers = pointed(f)
        results = [a for a in f.arguments if a.direction != "in"]
        state = next((a.name for a in results if a.direction == "out" and self._is_state(f, a)), "")
        return {
            "name": f.name,
            "declared": [f"static {declaration(self._names, self._result(f, a), a.type, a.shape)};" for a in results],
            "draws": self._draws(f),
            "kept": sum(a.direction == "inout" and a.name in {i.name for i in self._inputs} for a in f.arguments),
            "pointers": len(pointers),
            "begins": [line for a in results for line in self._begin(f, a)],
            "call": wrapped(self._call(f, pointers), INDENT * 2),
            "untouched": [line for a in results for line in self._untouched(f, a)],
            "taken": [
                line for a in results for line in self._results.taken(self._result(f, a), a.type, a.shape, INDENT * 3)
            ],
            "refusals": self._mask(f, negative=True, more=("BAD_ARGUMENT",) if pointers else ()),
            "bits": self._mask(f, negative=False),
            "may_ignore": FUNCTIONS[f.name].unread,
            "overlap": wrapped(self._overlapping(f, state), INDENT * 2) if state else [],
            "state": self._result(f, next(a for a in results if a.name == state)) if state else "",
        }

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
        return _given(TABLES[kind].symbol if kind in TABLES else a.name)

    def _draws(self, f: Function) -> list[str]:
        """Names of what is drawn for a function, constants first: what prepare refuses is not used."""
        kinds = {a.type.name for a in f.arguments if isinstance(a.type, Struct) and a.direction != "out"}
        found = []
        if "parameters" in kinds:
            found.append("parameters")
        elif kinds & {"table", "mount_table"}:
            found.append("tables")
        if "inverse_options" in kinds:
            found.append("options")
        names = {a.name for a in self._inputs}
        named = [a for a in f.arguments if a.direction != "out" and a.name in names and a.name != test_inputs.COSINE]
        return found + [a.name for a in sorted(named, key=lambda a: a.direction != "inout")]

    def _begin(self, f: Function, a: Argument) -> Iterator[str]:
        """Lines that fill a result before a call."""
        place = self._result(f, a)
        if a.direction == "inout":
            yield f"{INDENT * 2}memcpy(&{place}, &{self._source(a)}, sizeof {place});"
        else:
            yield f"{INDENT * 2}memset(&{place}, fill[round], sizeof {place});"

    def _untouched(self, f: Function, a: Argument) -> Iterator[str]:
        place = self._result(f, a)
        if a.direction == "inout":
            yield f"{INDENT * 3}expect(memcmp(&{place}, &{self._source(a)}, sizeof {place}) == 0, WRITTEN);"
        else:
            yield f"{INDENT * 3}expect(filled(&{place}, sizeof {place}, fill[round]), WRITTEN);"

    def _call(self, f: Function, pointers: list[Argument]) -> str:
        def given(a: Argument) -> str:
            text = passed(a, self._place(f, a))
            return f"null == {pointers.index(a) + 1}u ? NULL : {text}" if a in pointers else text

        return f"const status got = {call(self._names, f, given)};"

    def _overlapping(self, f: Function, state: str) -> str:
        def given(a: Argument) -> str:
            return passed(a, f"{f.name}_{state}" if a.name in (state, "x") else self._place(f, a))

        return f"const status got = {call(self._names, f, given)};"

    def _mask(self, f: Function, negative: bool, more: tuple[str, ...] = ()) -> str:
        """Statuses that a function documents: a bit each of the negative ones, the positive ones together."""
        values = sorted({STATUS_VALUES[s] for s in (*f.statuses, *more)})
        if negative:
            return " | ".join(f"1u << {-v}" for v in values if v < 0) or "0u"
        return " | ".join(f"{v}u" for v in values if v > 0) or "0u"

    def _recorder(self, f: Function) -> dict[str, Any]:
        """The recorder's step beside step itself."""
        taken = [a for a in f.arguments if a.name != "next"]
        given = [passed(a, self._place(f, a)) for a in taken if a.name not in ("table", "x")]
        before = self._names.function(f.name)
        after = self._names.function(f"recorder_{f.name}")
        rest = ", ".join(given)
        return {
            "name": f.name,
            "draws": self._draws(f),
            "plain": wrapped(f"const status expected = {before}(&in_table, &in_x, {rest}, &plain);", INDENT),
            "logged": wrapped(f"const status got = {after}(&log, &in_table, &logged, {rest});", INDENT * 2),
        }


def _given(name: str) -> str:
    """What an argument is called in the harness: no name of the program, nor of the harness, begins like that."""
    return f"in_{name}"
