"""Drivers of Frama-C Eva for a stand's C, and the script that runs them, for a reviewer to repeat."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import prod, sqrt
from typing import Any

import numpy as np

from mahovik.contract.functions import ANY, BITS, NORMAL, row_of
from mahovik.contract.quantities import ORDINARY_STEP, TABLES, ordinary, ordinary_integers
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.calls import argument_text, call, declaration, nested_loops
from mahovik.core.emit.code import Code
from mahovik.core.emit.declaration import prototype
from mahovik.core.emit.generate import Generated
from mahovik.core.emit.names import VERIFICATION, member
from mahovik.core.lower.checks import state_limits
from mahovik.core.lower.limits import UNIT_SQUARE_MIN
from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import Const
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.program.walk import expressions
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities

ROUTINE = "routine"
"""Set of the drivers of the routines that work on bits and of CHECKS; the other sets are those of the contract."""

ROUTINES = ("sincos", "sqrt", "atan2", "exp")

CHECKS = ("check_state", "check_motion")
"""Checks with sums of squares, whose limits intervals do not see: the sets normal and any take them by a contract."""

LEAST = round(sqrt(UNIT_SQUARE_MIN) / 2 - 5e-4, 3)
"""A component of each quaternion that is accepted is as large, by more than CLEARLY."""
CLEARLY = 2e-4
"""So much larger it is said to be, so that rounding of LEAST leaves no number between the cases of a driver."""

_UNROLLED = 6
"""Iterations that Eva follows one by one, even if it cannot determine their number: at least an array's length."""

_MERGED = ("solve_coupled", "check_inertia")
"""Functions with a status whose branches need not be kept apart; those without a status are merged as well."""


@dataclass(frozen=True)
class Driver:
    """One run of Eva: a function, or a routine, on a set of inputs."""

    function: str
    set: str

    @property
    def entry(self) -> str:
        """Name of its C function, without the stand's prefix."""
        return f"eva_{self.set}_{self.function}"

    @property
    def claimed(self) -> bool:
        """Whether it must be without alarm; others are only tried."""
        return self.set == ROUTINE or self.set in row_of(self.function).claimed

    @property
    def finite(self) -> bool:
        """Are infinities and NaN on the way alarms?"""
        return self.set in (NORMAL, ANY)


def drivers(program: Program) -> tuple[Driver, ...]:
    """All drivers of a stand: of each public function on each set, then of the routines and CHECKS."""
    public = [f.name for f in program.functions if f.public]
    known = {f.name for f in program.functions}
    result = [Driver(name, kind) for name in public for kind in (NORMAL, ANY, BITS)]
    return (*result, *(Driver(name, ROUTINE) for name in (*ROUTINES, *CHECKS) if name in known))


def _angles(program: Program) -> dict[str, Any] | None:
    """Places of the angles of `sincos_each`; None where there is none."""
    function = next((f for f in program.functions if f.name == "sincos_each"), None)
    if function is None:
        return None
    count = int(function.arguments[0].shape[0])
    return {"given": range(count), "last": count - 1}


def eva_files(stand: Stand, generated: Generated) -> dict[str, str]:
    """`<stand>_eva.c`, which is empty for any other reader than Frama-C, and `<stand>_eva.sh`, in VERIFICATION."""
    program = generated.program
    code = Code(program, identities(stand))
    writer = _Writer(code)
    every = drivers(program)
    printed = [writer.driver(entry) for entry in every]
    contracts = [writer.contract(program.function(name)) for name in CHECKS if name in writer.known]
    words: dict[str, Any] = {
        "suffix": "" if code.precision.name == "double" else "f",
        "atan2": any(f.name == "atan2" for f in program.functions),
        "exp": any(f.name == "exp" for f in program.functions),
        "angles": _angles(program),
        "unroll": max([_UNROLLED, *(int(n) for c in program.structs for f in c.fields for n in f.shape)]),
        "public": [f.name for f in code.public],
        "coarse": STATUS_VALUES["COARSE"],
        "trusted": [entry["name"] for entry in contracts],
        "checks": [f.name for f in program.functions if f.returns is Kind.STATUS and not f.public],
        "fills": list(writer.fills),
        "merged": [f.name for f in program.functions if f.returns is not Kind.STATUS or f.name in _MERGED],
    }
    source = code.render(
        "eva.c.j2",
        **words,
        drivers=printed,
        contracts=contracts,
        shared=[*writer.fills.values(), *writer.asserts.values()],
        square_min=UNIT_SQUARE_MIN,
        large_elements=[(i, 2 * i, 2 * i + 1) for i in range(4)],
        least=LEAST,
        max_phase=f"{code.precision.max_phase:.1f}",
    )
    script = code.render("eva.sh.j2", **words, drivers=every)
    place = f"{VERIFICATION}{program.name}_eva"
    return {f"{place}.c": source, f"{place}.sh": script}


class _Writer:
    """Makes drivers, and keeps the functions they share: `fills` fill a struct with a set, `asserts` look at one."""

    def __init__(self, code: Code) -> None:
        self._code, self._names = code, code.names
        self.known = {f.name for f in code.program.functions}
        self.fills: dict[str, dict[str, Any]] = {}
        self.asserts: dict[str, dict[str, Any]] = {}

    def driver(self, driver: Driver) -> dict[str, Any]:
        """Values of the template for one driver."""
        function = self._code.program.function(driver.function)
        if function.name in CHECKS:
            return self._refusals(function, driver.entry)
        kind = BITS if driver.set == ROUTINE else driver.set
        results = [a for a in function.arguments if a.direction != "in"]
        status = function.returns is Kind.STATUS
        return {
            "entry": driver.entry,
            "refused": False,
            "given": [line for a in function.arguments for line in self._argument_setup(a, kind)],
            "call": call(self._names, function, self._argument_text),
            "status": status,
            "ignored": "(void)" if function.returns else "",
            "untouched": [
                line for a in results if status and a.direction == "out" for line in self._assertions("untouched", a)
            ],
            "written": [
                line
                for a in results
                if status
                for line in self._assertions("initialised" if kind == BITS else "written", a)
            ],
        }

    def _argument_text(self, a: Argument) -> str:
        text = argument_text(a, self._default(a) or a.name)
        return f"Frama_C_interval(0, 1) == 0 ? NULL : {text}" if a.optional == "missing" else text

    # ---- checks ----

    def contract(self, f: Function) -> dict[str, Any]:
        """Contract of a check for finite arguments: they are within their limits, or it refuses them."""
        within = [
            f"-{limit} <= {place}[{i}] <= {limit}"
            for place, count, limit, _ in self._limits(f, "x->")
            for i in range(count)
        ]
        large = f"{LEAST + CLEARLY:.4f}"
        components = (f"x->attitude[{i}] >= {large} || x->attitude[{i}] <= -{large}" for i in range(4))
        return {
            "name": f.name,
            "reads": ", ".join(["*x", *(f"values[0 .. {int(a.shape[0]) - 1}], limit" for a in f.arguments if a.shape)]),
            "within": [*within, f"({' || '.join(components)})"],
            "prototype": prototype(f, self._names),
        }

    def _limits(self, f: Function, prefix: str) -> list[tuple[str, int, str, str]]:
        """Arrays that a check looks at, how many of their numbers, their limit, and the next number after it."""
        state = f.arguments[0].type
        assert isinstance(state, Struct)
        limits = [
            (f"{prefix}{name}", int(count), self._number(limit), self._above(limit))
            for name, count, limit in state_limits(state, self._code.precision)
        ]
        return limits + [("values", int(a.shape[0]), "limit", "above") for a in f.arguments if a.shape]

    def _number(self, limit: Const) -> str:
        return self._names.constant(limit.name) if limit.name else self._code.real(float(limit.value))

    def _above(self, limit: Const) -> str:
        """The next number."""
        scalar = self._code.precision.scalar
        return self._code.hex(np.nextafter(scalar(limit.value), scalar(np.inf)))

    def _refusals(self, f: Function, entry: str) -> dict[str, Any]:
        """Values of the template for a check: a number beyond its limit, or a quaternion without a large component."""
        state, largest = f.arguments[0].type, self._names.constant("LARGEST")
        assert isinstance(state, Struct)
        statements = [f"{self._names.type(state)} x;"]
        statements += [f"reals(x.{field.name}, {int(field.shape[0])}, {largest});" for field in state.fields]
        for a in f.arguments:
            if a.shape:
                limits = self._limits_passed(f)
                real = self._names.type(Kind.REAL)
                statements += [f"{declaration(self._names, a)}", f"{real} limit, above;"]
                statements += [f"reals({a.name}, {int(a.shape[0])}, {largest});"]
                statements += [f"switch (Frama_C_interval(0, {len(limits) - 1})) {{"]
                for i, limit in enumerate(limits):
                    case = f"case {i}:" if i < len(limits) - 1 else "default:"
                    statements.append(f"{case} limit = {self._number(limit)}; above = {self._above(limit)}; break;")
                statements.append("}")
        statements.append("int beyond = 0;")
        for place, count, _, above in self._limits(f, "x."):
            statements.append(f"if (beyond == 0) {{ beyond = one_beyond({place}, {count}, {above}); }}")
        statements.append(f"if (beyond == 0) {{ reals(x.attitude, 4, {self._code.real(LEAST + 1.5 * CLEARLY)}); }}")
        text = call(self._names, f, lambda a: "&x" if a.name == "x" else a.name)
        return {"entry": entry, "given": statements, "call": text, "refused": True}

    def _limits_passed(self, f: Function) -> list[Const]:
        """Limits that callers give to a check, each once."""
        constants: dict[str, Const] = {}
        for caller in self._code.program.functions:
            for e in expressions(caller.body):
                if isinstance(e, Call) and e.signature.name == f.name:
                    limit = e.arguments[-1]
                    assert isinstance(limit, Const)
                    constants[limit.name] = limit
        return list(constants.values())

    # ---- inputs ----

    def _argument_setup(self, a: Argument, kind: str) -> Iterator[str]:
        """Declares an argument and fills it, where it is read."""
        if isinstance(a.type, Struct) and a.type.name == "table" and (a.direction == "inout" or a.type.field("stream")):
            yield f"{self._names.declaration(a.name, a.type)} = {self._names.function('default')};"
            if a.type.field("stream"):
                yield from self._fill_statements(f"{a.name}.stream", Field("stream", Kind.REAL, (3,)), kind)
            return
        if self._default(a):
            return
        yield declaration(self._names, a)
        if a.direction == "out":
            return
        if isinstance(a.type, Struct) and a.type.name == "mount_table":
            function = self._names.function("default_parameters")
            yield f"(void){self._names.function('prepare_mounts')}(&{function}, &{a.name});"
        elif isinstance(a.type, Struct) and not a.shape:
            yield f"{self._fill(a.type, kind)}(&{a.name});"
        else:
            yield from self._fill_statements(a.name, Field(a.name, a.type, a.shape), kind)

    def _default(self, a: Argument) -> str:
        """The constant that an argument is, or nothing."""
        if not isinstance(a.type, Struct) or a.direction != "in":
            return ""
        if a.type.name == "table" and not a.type.field("stream"):
            return self._names.function("default")
        return ""

    def _fill(self, struct: Struct, kind: str) -> str:
        """Name of the function that fills a struct with all values of a set."""
        name = f"{kind}_{struct.name}"
        if name not in self.fills:
            middle = ""
            if struct.name in TABLES and kind == NORMAL:
                middle = f"{self._names.function(TABLES[struct.name].default)}."
            lines = [line for f in struct.fields for line in self._member("x->", f, kind, middle)]
            self.fills[name] = {"name": name, "type": self._names.type(struct), "lines": lines}
        return name

    def _member(self, prefix: str, f: Field, kind: str, middle: str) -> Iterator[str]:
        name = member(f.name)
        return self._fill_statements(f"{prefix}{name}", f, kind, f"{middle}{name}" if middle else "")

    def _fill_statements(self, place: str, f: Field, kind: str, middle: str = "") -> Iterator[str]:
        """Fills a place with all values of a set."""
        if isinstance(f.type, Struct):
            fields = f.type.fields

            def members(element: str, _: int) -> list[str]:
                about = f"{middle}{element.removeprefix(place)}." if middle else ""
                return [line for m in fields for line in self._member(f"{element}.", m, kind, about)]

            yield from nested_loops(self._names, place, f.shape, members)
            return
        first = self._first(place, f.shape)
        number = prod(int(n) for n in f.shape)
        if f.type is Kind.INT:
            low, high = ordinary_integers(f.name) if kind == NORMAL else ("INT_MIN", "INT_MAX")
            yield f"integers({first}, {number}, {low}, {high});"
        elif middle:
            yield f"about({first}, {self._first(middle, f.shape)}, {number});"
        elif f.name == "attitude" and kind != BITS:
            size = self._code.real(2.0) if kind == NORMAL else self._names.constant("LARGEST")
            yield f"quaternion({place}, {size});"
        elif kind == BITS and not f.shape:
            yield f"one_of_all(&{place});"
        elif kind == BITS:
            yield f"all_bits({first}, {number});"
        elif f.name == "dt" and kind == NORMAL:
            yield f"{place} = real_in({self._code.real(ORDINARY_STEP[0])}, {self._code.real(ORDINARY_STEP[1])});"
        else:
            size = self._names.constant("LARGEST")
            if kind == NORMAL:
                size = self._code.real(ordinary(f.name))
            yield f"reals({first}, {number}, {size});"

    # ---- results ----

    def _assertions(self, what: str, a: Argument) -> Iterator[str]:
        if isinstance(a.type, Struct) and not a.shape:
            yield f"{self._look(what, a.type)}(&{a.name});"
        else:
            yield from self._of(what, a.name, Field(a.name, a.type, a.shape))

    def _look(self, what: str, struct: Struct) -> str:
        """Name of the function that asserts a property of every member of a struct."""
        name = f"{what}_{struct.name}"
        if name not in self.asserts:
            lines = [line for f in struct.fields for line in self._of(what, f"x->{member(f.name)}", f)]
            self.asserts[name] = {"name": name, "type": f"const {self._names.type(struct)}", "lines": lines}
        return name

    def _of(self, what: str, place: str, f: Field) -> Iterator[str]:
        if isinstance(f.type, Struct):
            places = [f"{place}[{k}]" for k in range(prod(int(n) for n in f.shape))] if f.shape else [place]
            for element in places:
                for inner in f.type.fields:
                    yield from self._of(what, f"{element}.{member(inner.name)}", inner)
            return
        count = prod(int(n) for n in f.shape)
        if f.type is Kind.REAL:
            yield f"{what}({self._first(place, f.shape)}, {count});"
        elif what != "untouched":
            yield f"/*@ check \\initialized(&{self._first(place, f.shape)[1:]}); */"

    def _first(self, place: str, shape: tuple[Any, ...]) -> str:
        """Address of the first element."""
        return f"&{place}{'[0]' * len(shape)}"
