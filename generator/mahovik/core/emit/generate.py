"""From a stand to the text of its C files."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from mahovik.contract.functions import ALL, CHOSEN, FUNCTIONS, is_default, row_of, task_of
from mahovik.contract.quantities import short
from mahovik.contract.status import STATUS_VALUES, STATUSES
from mahovik.core.emit.code import Code
from mahovik.core.emit.layout import comment_lines, wrap_statement
from mahovik.core.emit.log_format import RESERVED
from mahovik.core.emit.names import RESERVED as OF_STANDS
from mahovik.core.emit.names import Names
from mahovik.core.lower.layout import Layout, run_time_inputs
from mahovik.core.lower.limits import constants, limits, thresholds
from mahovik.core.lower.program import lower_layout
from mahovik.core.lower.programme import RESERVED as OF_PROGRAMMES
from mahovik.core.lower.stream import NAME as STREAM_PROFILE
from mahovik.core.lower.values import Values
from mahovik.core.program.function import Function, Program
from mahovik.core.program.simplify import restrict_program
from mahovik.core.program.types import DOUBLE, FLOAT, NamedCount, Struct
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities, structure
from mahovik.errors import UsageError
from mahovik.nearest import suggestion

PRECISIONS = {"double": DOUBLE, "float": FLOAT}
"""Element types that `generate` offers."""

_CONSTANTS = ("state", "parameters", "table")
"""Structs of every header; those of its constants are among them."""

_ALWAYS = ("OK", "NOT_FINITE", "RANGE", "BAD_ARGUMENT")
"""Statuses of the header of a part as well: what is exported to stand beside it returns them too."""


@dataclass(frozen=True)
class Generated:
    """A stand's program with its numbers and C text by file name.

    `only`: names of its public functions, or ALL; `chosen`: those that `--only` has to name, none of the default.
    """

    layout: Layout
    program: Program
    values: Values
    files: dict[str, str]
    only: tuple[str, ...] = ALL
    chosen: tuple[str, ...] = ()

    @property
    def part(self) -> Program | None:
        """The program where it has some of the public functions only."""
        return None if self.only == ALL else self.program


def generate(stand: Stand, precision_name: str = "double") -> dict[str, str]:
    """C of a stand: file name to text, header first. Raises UsageError, StandError."""
    return generate_all(stand, precision_name).files


def generate_all(
    stand: Stand,
    precision_name: str = "double",
    only: tuple[str, ...] | None = None,
    chosen: tuple[str, ...] = (),
) -> Generated:
    """Return the files of `generate`, with the program and its numbers.

    `only`: public functions to emit, with what they need; empty: those that `is_default` names; ALL: all; None: all but
    those of CHOSEN that `chosen` does not name, which is what the judges and Python need.
    """
    if precision_name not in PRECISIONS:
        raise UsageError(f"real {precision_name}: only {', '.join(PRECISIONS)} can be generated")
    layout = Layout(structure(stand), PRECISIONS[precision_name])
    named = (*CHOSEN,) if only == ALL else (*(only or ()), *chosen)
    other = (name for name in only or () if name not in FUNCTIONS | CHOSEN and not task_of(name))  # slips, all listed
    slopes = only in (None, ALL) or any("jacobian" in name for name in only) or any(other)
    program = lower_layout(layout, tuple(name for name in CHOSEN if name in named), slopes)
    values = Values(stand, layout, program)
    only = ALL if only in (None, ALL) else _public_names(program, only or (), stand.name)
    asked = () if only == _public_names(program, (), stand.name) else only
    if only != ALL:
        program = restrict_program(program, only, _CONSTANTS)
    printer = _Printer(stand, layout, values, Code(program, identities(stand)), only != ALL)
    files = {f"{stand.name}.h": printer.header(), f"{stand.name}.c": printer.source()}
    return Generated(layout, program, values, files, only, asked)


def _public_names(program: Program, only: tuple[str, ...], name: str) -> tuple[str, ...]:
    """The names, or those of the default, in the order of the program. Raises UsageError for one that is not there."""
    public = [f.name for f in program.functions if f.public]
    for wanted in only:
        if wanted == "list":
            raise UsageError("only list: `mahovik generate STAND.toml --only list` prints names, expected names or all")
        if wanted not in public:
            near = suggestion(wanted, [name for name in (*public, *CHOSEN, *ALL) if name != wanted])
            raise UsageError(f"only {wanted}: the C of {name} has no such function{near}")
    names = {*only} or {function for function in public if is_default(function)}
    if any("mounting" in row_of(function).takes for function in names):
        names.add("prepare_mounts")  # which makes the table of mounts
    return tuple(function for function in public if function in names)


def header_structs(program: Program) -> tuple[Struct, ...]:
    """The structs of a program that public functions and constants need; only the source declares the others."""
    types = [a.type for f in program.functions if f.public for a in f.arguments if isinstance(a.type, Struct)]
    types += [s for s in program.structs if s.name in _CONSTANTS]
    names = {held.name for struct in types for held in struct.inner_structs()}
    return tuple(s for s in program.structs if s.name in names)


class _Printer:
    """Collects the parts that the templates put in order."""

    def __init__(self, stand: Stand, layout: Layout, values: Values, code: Code, part: bool) -> None:
        self._stand, self._layout, self._values, self._code = stand, layout, values, code
        self._names, self._program, self._part = code.names, code.program, part
        self._known = {"bodies": describe_bodies(stand)}

    def header(self) -> str:
        """The header: the manual of the generated code."""
        return self._code.render(
            "stand.h.j2",
            **self._known,
            limits=self._code.limits,
            constants=self._code.constants,
            statuses=self._statuses(),
            checked=_checked(self._layout),
            prepares=any(f.name == "prepare" for f in self._code.public),
            takes_root=any(f.name == "sqrt" for f in self._program.functions),
            held=self._layout.held,
            tasks=self._layout.structure.tasks,
            V=self._layout.twist,
            stream=self._layout.stream,
            at_depth=" at the depth of O1" if self._layout.structure.stream_stations else "",
            enums=self._enums(),
            structs=self._code.structs(header_structs(self._program)),
            externs=[
                (f"extern const {self._names.type(struct)} {self._names.function(name)};", meaning)
                for name, struct, _, meaning in self._constants()
            ],
            functions=self._code.public_declarations(self._code.public),
        )

    def _statuses(self) -> Iterator[list[str]]:
        """Lines of each enumerator of a status."""
        rows = statuses(self._names, self._layout, self._program if self._part else None)
        for name, value, meaning in rows:
            lead = f"    {f'{name} = {value}' + ',' * (name != rows[-1][0]):<36}  "
            yield comment_lines(meaning, lead, " " * len(lead))

    def source(self) -> str:
        """The source: routines, internal functions, public functions, tables."""
        labels = self._labels()
        return self._code.render(
            "stand.c.j2",
            **self._known,
            internal=self._code.structs(s for s in self._program.structs if s not in header_structs(self._program)),
            functions=[self._function(f) for f in self._program.functions],
            tables=[self._code.table(name, struct, value, labels) for name, struct, value, _ in self._constants()],
        )

    def _enums(self) -> list[list[str]]:
        """Enumerators of flywheels, of run-time wrenches and other inputs, and of sensors."""
        layout = self._layout
        taken = {c.name for c in self._program.counts} | set(limits(self._program.precision))
        taken |= {x.name for x in constants(self._program.precision)}
        taken |= OF_STANDS | RESERVED | OF_PROGRAMMES
        rows: list[tuple[tuple[str, ...], str, NamedCount, str]] = [
            (layout.structure.flywheels, "", layout.count, layout.count.comment),
            (layout.inputs, "WRENCH_", layout.input_count, f"{layout.input_count.comment}: six numbers each"),
            *((x.names, x.prefix, x.count, x.count.comment) for x in run_time_inputs(layout.structure)),
            (layout.sensors, "SENSOR_", layout.sensor_count, layout.sensor_count.comment),
        ]
        enums = []
        for names, prefix, count, comment in rows:
            if names:
                entries = self._names.enumerators(names, taken, prefix)
                taken |= {entry.removeprefix(self._names.constant("")) for entry in entries}
                text = f"enum {{ {', '.join(entries)}, {self._names.constant(count.name)} = {len(names)} }};"
                enums.append([f"/* {comment} */", *wrap_statement(text, "")])
        return enums

    def _function(self, f: Function) -> dict[str, Any]:
        """A function; what the header says of a public one is not said again. `hook`: macro that replaces its body."""
        function = self._code.function(f) | {"hook": self._names.constant("SQRT") if f.name == "sqrt" else ""}
        return function | {"comment": []} if f.public else function

    def _constants(self) -> list[tuple[str, Struct, dict[str, Any], str]]:
        """Constant tables: name without prefix, type, value, meaning."""
        layout, values = self._layout, self._values
        constants = [
            ("default_parameters", layout.parameters, values.parameters, "of the stand file"),
            ("default", layout.table, values.table, "made of them"),
        ]
        if values.options is not None and layout.inverse_options in self._program.structs:
            constants.append(
                ("default_options", layout.inverse_options, values.options, "of inverse, by the stand file")
            )
        return constants

    def _labels(self) -> dict[str, list[str]]:
        """Names of the rows of tables."""
        stand = self._stand
        return {
            "flywheel": [s.name for s in stand.flywheels],
            "instrument": [p.name for p in stand.instruments],
            "sensor": list(self._layout.sensors),
            "frame": [stand.bodies[o.index].name for o in self._layout.local_bodies],
        }


def statuses(names: Names, layout: Layout, part: Program | None) -> list[tuple[str, int, str]]:
    """Name in C, number and meaning of each for this stand; of a part of its functions, of those that may occur."""
    functions = part.functions if part else ()
    occurring = {*_ALWAYS, *(status for f in functions if f.public for status in f.statuses)} if part else STATUS_VALUES
    decided = thresholds(layout.precision)
    words = {
        "unreachable": short(decided.unreachable),
        "rank": short(decided.rank),
        "lengths": ", ".join(_lengths(layout)),
    }
    result = [s for s in STATUSES if s.name in occurring]
    return [(names.constant(s.name), s.value, s.meaning.format(**words)) for s in result]


def _lengths(layout: Layout) -> Iterator[str]:
    """Words for the parts of this stand whose length may be refused."""
    yield "quaternion off unit length"
    if layout.sine_input:
        yield "sine and cosine likewise"
    yield from (law.invalid for law in layout.law_tables if law.invalid)
    if layout.structure.stream_stations:
        yield "depth outside of the stream's profile"


def _checked(layout: Layout) -> str:
    """Members of the table that every function checks."""
    members = [
        name for name, there in (("stream", layout.stream), (STREAM_PROFILE, layout.structure.stream_stations)) if there
    ]
    members += [f"{item.array}[].{item.member}" for item in run_time_inputs(layout.structure)]
    return f"{', '.join(members)} alone" if members else "nothing"


def describe_bodies(stand: Stand) -> str:
    """Bodies of a stand in words: `carrier, 1 instrument, 8 flywheels`."""
    numbers = {"instrument": len(stand.instruments), "flywheel": len(stand.flywheels)}
    return ", ".join(["carrier", *(f"{n} {noun}{'' if n == 1 else 's'}" for noun, n in numbers.items())])
