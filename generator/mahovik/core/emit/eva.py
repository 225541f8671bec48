"""Drivers of Frama-C Eva for a stand's C, and the script that runs them: what a reviewer repeats."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import prod, sqrt
from typing import Any

from mahovik import __version__
from mahovik.contract.functions import ANY, BITS, FUNCTIONS, NORMAL
from mahovik.contract.quantities import ORDINARY_STEP, TABLES, ordinary, ordinary_integers
from mahovik.core.emit.calls import call, declaration, over, passed
from mahovik.core.emit.generate import Generated
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.names import Names
from mahovik.core.emit.templates import template
from mahovik.core.lower.limits import UNIT_SQUARE_MIN
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Program
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.identity import Identities

ROUTINE = "routine"
"""Set of the drivers of the routines that work on bits; the other sets are those of the contract."""

ROUTINES = ("sincos", "sqrt", "atan2")

_UNROLLED = 6
"""Turns of a loop that are followed one by one even where Eva does not see how many there are: at least an array's."""

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
        """Must it be without alarm? Others are tried."""
        return self.set == ROUTINE or self.set in FUNCTIONS[self.function].claimed

    @property
    def finite(self) -> bool:
        """Are infinities and NaN on the way alarms?"""
        return self.set in (NORMAL, ANY)


def provable(generated: Generated) -> bool:
    """Whether C gets drivers: that of one lane, not fast.

    With more lanes Eva raises alarms; in fast C contraction is another arithmetic than the one that it follows.
    """
    return generated.layout.lanes == 1 and not generated.fast


def drivers(program: Program) -> tuple[Driver, ...]:
    """All drivers of a stand: of each public function on each set, then of the routines."""
    public = [f.name for f in program.functions if f.public]
    known = {f.name for f in program.functions}
    found = [Driver(name, kind) for name in public for kind in (NORMAL, ANY, BITS)]
    return (*found, *(Driver(name, ROUTINE) for name in ROUTINES if name in known))


def _angles(program: Program) -> dict[str, Any] | None:
    """Places of `sincos_each`: of its angles, and those beyond, which it sets to zero; None where there is none."""
    found = next((f for f in program.functions if f.name == "sincos_each"), None)
    if found is None:
        return None
    x, sine, _ = found.arguments
    count, room = int(x.shape[0]), int(sine.shape[0])
    return {"given": range(count), "beyond": range(count, room), "last": count - 1, "last_place": room - 1}


def eva_files(program: Program, identities: Identities) -> dict[str, str]:
    """`<stand>_eva.c` and `<stand>_eva.sh`."""
    writer = _Writer(program)
    every = drivers(program)
    printed = ["\n".join(writer.driver(each)) for each in every]
    words: dict[str, Any] = {
        "name": program.name,
        "NAME": program.name.upper(),
        "version": __version__,
        "structure": identities.structure,
        "physics": identities.physics,
        "real": program.precision.name,
        "suffix": "" if program.precision.name == "double" else "f",
        "atan2": any(f.name == "atan2" for f in program.functions),
        "angles": _angles(program),
        "unroll": max([_UNROLLED, *(int(n) for c in program.structs for f in c.fields for n in f.shape)]),
        "public": [f.name for f in program.functions if f.public],
        "checks": [f.name for f in program.functions if f.returns is Kind.STATUS and not f.public],
        "fills": list(writer.fills),
        "merged": [f.name for f in program.functions if f.returns is not Kind.STATUS or f.name in _MERGED],
    }
    source = template("eva.c.j2").render(
        **words,
        drivers=printed,
        shared=[*writer.fills.values(), *writer.asserts.values()],
        square_min=writer.real(UNIT_SQUARE_MIN),
        least=writer.real(round(sqrt(UNIT_SQUARE_MIN) / 2 - 5e-4, 3)),
        octants=[(i, 2 * i, 2 * i + 1) for i in range(4)],
        below=writer.real(0.99),
        above=writer.real(1.01),
        zero=writer.real(0.0),
        max_phase=f"{program.precision.max_phase:.1f}",
        one=writer.real(1.0),
    )
    script = template("eva.sh.j2").render(**words, drivers=every)
    return {f"{program.name}_eva.c": source, f"{program.name}_eva.sh": script}


class _Writer:
    """Prints drivers, and keeps the functions they share: `fills` fill a struct with a set, `asserts` look at one."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._names = Names(program.name)
        self.fills: dict[str, str] = {}
        self.asserts: dict[str, str] = {}

    def real(self, value: float) -> str:
        return real_literal(value, self._program.precision)

    def driver(self, driver: Driver) -> Iterator[str]:
        """Lines of one driver."""
        function = self._program.function(driver.function)
        name = self._names.function(driver.entry)
        yield f"void {name}(void);"
        yield f"void {name}(void)"
        yield "{"
        kind = BITS if driver.set == ROUTINE else driver.set
        for a in function.arguments:
            yield from (f"    {line}" for line in self._given(a, kind))
        text = call(self._names, function, self._passed)
        if function.returns is not Kind.STATUS:
            yield f"    {'(void)' if function.returns else ''}{text};"
            yield "    Frama_C_show_each_returned(0);"
            yield "}"
            return
        results = [a for a in function.arguments if a.direction == "out"]
        yield f"    const {self._names.type(Kind.STATUS)} status = {text};"
        yield "    if (status < 0) {"
        for a in results:
            yield from (f"        {line}" for line in self._asserted("untouched", a))
        yield "    } else {"
        yield "        Frama_C_show_each_returned(status);"
        for a in function.arguments:
            if a.direction != "in":
                what = "initialised" if kind == BITS else "written"
                yield from (f"        {line}" for line in self._asserted(what, a))
        yield "    }"
        yield "}"

    # ---- inputs ----

    def _given(self, a: Argument, kind: str) -> Iterator[str]:
        """Declares an argument and fills it, where it is read."""
        type_ = self._names.type(a.type)
        if isinstance(a.type, Struct) and a.type.name == "table" and (a.direction == "inout" or a.type.field("stream")):
            yield f"{type_} {a.name} = {self._names.function('default')};"
            if a.type.field("stream"):
                yield from self._filled(f"{a.name}.stream", Field("stream", Kind.REAL, (3,)), kind)
            return
        if self._default(a):
            return
        yield f"{declaration(self._names, a.name, a.type, a.shape)};"
        if a.direction == "out":
            return
        if isinstance(a.type, Struct) and a.type.name == "mount_table":
            given = self._names.function("default_parameters")
            yield f"(void){self._names.function('prepare_mounts')}(&{given}, &{a.name});"
        elif isinstance(a.type, Struct) and not a.shape:
            yield f"{self._fill(a.type, kind)}(&{a.name});"
        else:
            yield from self._filled(a.name, Field(a.name, a.type, a.shape), kind)

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
            lines = (line for f in struct.fields for line in self._member("x->", f, kind, middle))
            self.fills[name] = self._shared(name, f"{self._names.type(struct)} *x", lines)
        return name

    def _shared(self, name: str, argument: str, lines: Iterator[str]) -> str:
        return "\n".join([f"static void {name}({argument})", "{", *(f"    {line}" for line in lines), "}"])

    def _member(self, prefix: str, f: Field, kind: str, middle: str) -> Iterator[str]:
        return self._filled(f"{prefix}{f.name}", f, kind, f"{middle}{f.name}" if middle else "")

    def _filled(self, place: str, f: Field, kind: str, middle: str = "") -> Iterator[str]:
        """Fills a place with all values of a set."""
        if isinstance(f.type, Struct):
            fields = f.type.fields

            def members(element: str, indent: str, _: int) -> list[str]:
                about = f"{middle}{element.removeprefix(place)}." if middle else ""
                return [indent + line for m in fields for line in self._member(f"{element}.", m, kind, about)]

            yield from over(self._names, place, f.shape, "", members)
            return
        first = self._first(place, f.shape)
        number = prod(int(n) for n in f.shape)
        if f.type is Kind.INT:
            low, high = ordinary_integers(f.name) if kind == NORMAL else ("INT_MIN", "INT_MAX")
            yield f"integers({first}, {number}, {low}, {high});"
        elif middle:
            yield f"about({first}, {self._first(middle, f.shape)}, {number});"
        elif f.name == "attitude" and kind != BITS:
            size = self.real(2.0) if kind == NORMAL else self._names.constant("LARGEST")
            yield f"quaternion({place}, {size});"
        elif kind == BITS and not f.shape:
            yield f"one_of_all(&{place});"
        elif kind == BITS:
            yield f"all_bits({first}, {number});"
        elif f.name == "dt" and kind == NORMAL:
            yield f"{place} = real_in({self.real(ORDINARY_STEP[0])}, {self.real(ORDINARY_STEP[1])});"
        else:
            size = self._names.constant("LARGEST")
            if kind == NORMAL:
                size = self.real(ordinary(f.name))
            yield f"reals({first}, {number}, {size});"

    def _passed(self, a: Argument) -> str:
        return passed(a, self._default(a) or a.name)

    # ---- results ----

    def _asserted(self, what: str, a: Argument) -> Iterator[str]:
        if isinstance(a.type, Struct) and not a.shape:
            yield f"{self._look(what, a.type)}(&{a.name});"
        else:
            yield from self._of(what, a.name, Field(a.name, a.type, a.shape))

    def _look(self, what: str, struct: Struct) -> str:
        """Name of the function that asserts something of all of a struct."""
        name = f"{what}_{struct.name}"
        if name not in self.asserts:
            lines = (line for f in struct.fields for line in self._of(what, f"x->{f.name}", f))
            self.asserts[name] = self._shared(name, f"const {self._names.type(struct)} *x", lines)
        return name

    def _of(self, what: str, place: str, f: Field) -> Iterator[str]:
        if isinstance(f.type, Struct):
            places = [f"{place}[{k}]" for k in range(prod(int(n) for n in f.shape))] if f.shape else [place]
            for each in places:
                for member in f.type.fields:
                    yield from self._of(what, f"{each}.{member.name}", member)
            return
        count = prod(int(n) for n in f.shape)
        if f.type is Kind.REAL:
            yield f"{what}({self._first(place, f.shape)}, {count});"
        elif what != "untouched":
            yield f"/*@ check \\initialized(&{self._first(place, f.shape)[1:]}); */"

    def _first(self, place: str, shape: tuple[Any, ...]) -> str:
        """Address of the first element."""
        return f"&{place}{'[0]' * len(shape)}"
