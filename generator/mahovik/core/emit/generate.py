"""From a stand to the text of its C files."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mahovik import __version__
from mahovik.core.emit.constant import initialiser
from mahovik.core.emit.declaration import null_check, prototype, public_declarations, struct_lines, summary
from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.layout import paragraph, wrapped
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.log_format import RESERVED
from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import Statements
from mahovik.core.emit.status import statuses
from mahovik.core.emit.templates import template
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.limits import limits
from mahovik.core.lower.program import lower_layout
from mahovik.core.lower.programme.form import RESERVED as OF_PROGRAMMES
from mahovik.core.lower.values import Values
from mahovik.core.program.expression import BitCast
from mahovik.core.program.function import Function, Program
from mahovik.core.program.restrictable import restrictable
from mahovik.core.program.types import DOUBLE, FLOAT, Struct
from mahovik.core.program.walk import expressions
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure
from mahovik.errors import UsageError

PRECISIONS = {"double": DOUBLE, "float": FLOAT}
"""Element types that `generate` offers."""

_INTERNAL = frozenset(("sums", "coupling", "schur", "inverse_work", "lane_sums", "lane_coupling", "lane_schur"))
"""Structs of the source alone."""

LANES = (1, 2, 4, 8)
"""Flywheels side by side that `generate` offers."""


def host_lanes(flywheels: int) -> int:
    """The number of lanes that suits a desk's processor: docs/results/lanes.md measures it. Firmware has 1."""
    return 1 if flywheels < 2 else 2 if flywheels <= 4 else 4


@dataclass(frozen=True)
class Generated:
    """A stand's program with its numbers and C text by file name; `fast`: its bits need not be the same everywhere."""

    layout: Layout
    program: Program
    values: Values
    files: dict[str, str]
    fast: bool = False


def generate(stand: Stand, precision_name: str = "double", lanes: int = 1, fast: bool = False) -> dict[str, str]:
    """C of a stand: file name to text, header first. Raises UsageError, StandError."""
    return generate_all(stand, precision_name, lanes, fast).files


def generate_all(stand: Stand, precision_name: str = "double", lanes: int = 1, fast: bool = False) -> Generated:
    """Return the files of `generate`, with the program and its numbers. `fast` changes what the header says."""
    if precision_name not in PRECISIONS:
        raise UsageError(f"--real {precision_name}: only {', '.join(PRECISIONS)} can be generated")
    if lanes not in LANES:
        raise UsageError(f"--lanes {lanes}: only {', '.join(map(str, LANES))} can be generated")
    layout = Layout(structure(stand), PRECISIONS[precision_name], lanes if stand.flywheels else 1)
    program = lower_layout(layout)
    values = Values(stand, layout, program)
    printer = _Printer(stand, layout, program, values, fast)
    files = {f"{stand.name}.h": printer.header(), f"{stand.name}.c": printer.source()}
    return Generated(layout, program, values, files, fast)


def internal(layout: Layout, struct: Struct) -> bool:
    """Is a struct of the source alone? By blocks, so is the row of one flywheel."""
    return struct.name in _INTERNAL or (layout.lanes > 1 and struct is layout.row)


class _Printer:
    """Collects the parts that the templates put in order."""

    def __init__(self, stand: Stand, layout: Layout, program: Program, values: Values, fast: bool) -> None:
        self._stand = stand
        self._fast = fast
        self._layout = layout
        self._program = program
        self._values = values
        self._names = Names(program.name)
        self._expressions = Expressions(self._names, program.precision)
        self._statements = Statements(self._names, self._expressions)
        self._restrictable = restrictable(program)
        self._identities = identities(stand)

    def header(self) -> str:
        """The header: the manual of the generated code."""
        public = [f for f in self._program.functions if f.public]
        functions = public_declarations(public, self._program, self._names)
        structs = [struct_lines(s, self._names) for s in self._program.structs if not internal(self._layout, s)]
        return template("stand.h.j2").render(
            **self._common(),
            limits=self._limits(),
            statuses=statuses(self._names, self._layout),
            enums=self._enums(),
            structs=structs,
            externs=self._externs(),
            functions=functions,
        )

    def source(self) -> str:
        """The source: routines, internal functions, public functions, tables."""
        own = [struct_lines(s, self._names) for s in self._program.structs if internal(self._layout, s)]
        return template("stand.c.j2").render(
            **self._common(),
            bits=any(isinstance(e, BitCast) for f in self._program.functions for e in expressions(f.body)),
            internal=own,
            functions=[self._function(f) for f in self._program.functions],
            tables=self._tables(),
        )

    def _common(self) -> dict[str, Any]:
        stand = self._stand
        return {
            "name": stand.name,
            "NAME": stand.name.upper(),
            "version": __version__,
            "structure": self._identities.structure,
            "physics": self._identities.physics,
            "real": self._program.precision.name,
            "width": self._program.precision.width,
            "bodies": described(stand),
            "lanes": self._layout.lanes,
            "wide": self._layout.lanes > 1,
            "fast": self._fast,
        }

    def _limits(self) -> list[tuple[str, str, str]]:
        precision = self._program.precision
        return [
            (
                self._names.constant(x.name),
                real_literal(x.value, precision),
                f"{x.unit}; {x.comment}" if x.unit else x.comment,
            )
            for x in limits(precision).values()
        ]

    def _enums(self) -> list[list[str]]:
        """Enumerators of flywheels and of run-time wrenches."""
        layout = self._layout
        taken = {c.name for c in self._program.counts} | set(limits(self._program.precision))
        taken |= {"STRUCTURE", "PHYSICS", "LANES", "FAST", "H", "CODE", "CONST"} | RESERVED | OF_PROGRAMMES
        found = []
        if layout.flywheels:
            names = list(layout.structure.flywheels)
            entries = self._names.enumerators(names, taken)
            taken |= {entry.removeprefix(self._names.constant("")) for entry in entries}
            found.append(self._enum(entries, layout.count.name, len(names), layout.count.comment))
        for count in layout.lane_counts[1:]:  # their own number is a macro, so that the source can refuse another
            text = f"enum {{ {self._names.constant(count.name)} = {int(count)} }};  /* {count.comment} */"
            found.append([text])
        if layout.inputs:
            names = list(layout.inputs)
            entries = self._names.enumerators(names, taken, "WRENCH_")
            count = layout.input_count
            found.append(self._enum(entries, count.name, len(names), f"{count.comment}: six numbers each"))
        if layout.sensors:
            entries = self._names.enumerators(list(layout.sensors), taken, "SENSOR_")
            count = layout.sensor_count
            found.append(self._enum(entries, count.name, len(layout.sensors), count.comment))
        return found

    def _enum(self, entries: list[str], count: str, value: int, comment: str) -> list[str]:
        text = f"enum {{ {', '.join(entries)}, {self._names.constant(count)} = {value} }};"
        return [f"/* {comment} */", *wrapped(text, "")]

    def _function(self, f: Function) -> dict[str, Any]:
        if f.public:
            comment = paragraph(f"{f.equation or f.purpose}", "/* ", " * ")
            comment[-1] += " */"
        else:
            comment = summary(f)
        return {
            "comment": comment,
            "prototype": prototype(f, self._names, self._restrictable),
            "body": [*null_check(f, self._names), *self._statements.block(f.body, "    ")],
        }

    def _constants(self) -> list[tuple[str, Struct, dict[str, Any], str]]:
        """Constant tables: name without prefix, type, value, meaning."""
        layout, values = self._layout, self._values
        found = [
            ("default_parameters", layout.parameters, values.parameters, "of the stand file"),
            ("default", layout.table, values.table, "what prepare makes of them"),
        ]
        if values.options is not None:
            found.append(("default_options", layout.inverse_options, values.options, "of inverse, by the stand file"))
        return found

    def _externs(self) -> list[tuple[str, str]]:
        """Declarations of the constant tables with their comments."""
        return [
            (f"extern const {self._names.type(struct)} {self._names.function(name)};", meaning)
            for name, struct, _, meaning in self._constants()
        ]

    def _tables(self) -> list[dict[str, Any]]:
        """Definitions of the constant tables."""
        return [
            {
                "declaration": f"const {self._names.type(struct)} {self._names.function(name)}",
                "lines": self._table(struct, value),
            }
            for name, struct, value, _ in self._constants()
        ]

    def _table(self, struct: Struct, value: dict[str, Any]) -> list[str]:
        stand = self._stand
        labels = {
            "flywheel": [s.name for s in stand.flywheels],
            "instrument": [p.name for p in stand.instruments],
            "sensor": list(self._layout.sensors),
            "frame": [stand.bodies[o.index].name for o in self._layout.own],
        }
        return initialiser(struct, value, self._program.precision, labels)


def described(stand: Stand) -> str:
    """What a stand consists of: `carrier, 1 instrument, 8 flywheels`."""
    return ", ".join(
        ["carrier", _counted(len(stand.instruments), "instrument"), _counted(len(stand.flywheels), "flywheel")]
    )


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
