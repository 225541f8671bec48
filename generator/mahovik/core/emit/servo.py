"""`<stand>_servo.h`, `.c`: servos and trim with their gains as const tables; self-test, example, page, manifest."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from mahovik.contract.functions import is_public
from mahovik.core.emit.code import INDENT, Code
from mahovik.core.emit.layout import paragraph, wrap_statement
from mahovik.core.emit.manifest import manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.programme import rename_files
from mahovik.core.lower import servo_golden as expected
from mahovik.core.lower.servo import ServoForm
from mahovik.core.lower.servo_golden import Golden
from mahovik.core.program.function import Program
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities


@dataclass(frozen=True)
class ServoTables:
    """The numbers of a servo, as its structs have them, and facts for its page.

    gains, design    members by name; `design` None without a trim
    period           between samples, s
    ticks, periods   number of samples in a number of periods of the programme; None where no programme is known
    lines            what was computed, a line each
    loop             what the example and its page have besides
    """

    gains: Mapping[str, Any]
    design: Mapping[str, Any] | None
    period: float
    ticks: int | None = None
    periods: int | None = None
    lines: tuple[str, ...] = ()
    loop: Mapping[str, Any] = field(default_factory=dict)


class ServoPrinter:
    """Texts of servos, and of their trim, beside the C of their stand."""

    def __init__(self, stand: Stand, program: Program, form: ServoForm, tables: ServoTables) -> None:
        self._stand, self._form, self._tables = stand, form, tables
        self._code = Code(program, identities(stand), word="servo_word")  # the stand's header declares none

    def code(self) -> dict[str, str]:
        """Header and source by file name: all that firmware needs beside `<stand>.h`."""
        name = f"{self._stand.name}_servo"
        return {f"{name}.h": self.header(), f"{name}.c": self.source()}

    def files(self, golden: Golden, what: str, called: str = "programme") -> dict[str, str]:
        """Text by file name, with an example beside the tables of a programme; the manifest, last, has the hashes.

        `what`: the name of the servo; `called`: that of its programme in C, which names of the servo then have as well.
        """
        name, example = f"{self._stand.name}_servo", self.render("servo_main.c.j2")
        files = self.code() | {
            f"{VERIFICATION}{name}_main.c": example,
            f"{VERIFICATION}{name}_test.c": self.test(golden),
            f"{name}.md": self.page(example),
        }
        files = rename_files(files, self._stand.name, called)
        (manifest,) = rename_files({f"{name}.json": ""}, self._stand.name, called)
        return files | {manifest: self.manifest(files, what)}

    def header(self) -> str:
        """The header: the manual."""
        program, names = self._code.program, self._code.names
        return self.render(
            "servo.h.j2",
            counts=[(names.constant(c.name), int(c), c.comment) for c in program.counts[1:]],
            structs=self._code.structs(program.structs),
            functions=self._code.public_declarations(self._code.public),
        )

    def source(self) -> str:
        """The source: tables, then functions."""
        form, tables = self._form, self._tables
        constants = [self._code.table("servo_default", form.gains, tables.gains)]
        if tables.design is not None:
            constants.append(self._code.table("trim_default", form.design, tables.design))
        return self.render(
            "servo.c.j2",
            limits=[*self._code.limits, *self._code.constants],
            tables=constants,
            functions=self._code.functions,
        )

    def test(self, golden: Golden) -> str:
        """The self-test: golden torques, long runs, refusals."""
        rows = [wrap_statement(f"{{ {', '.join(map(self._code.hex, row))} }},", INDENT) for row in golden.torques]
        return self.render(
            "servo_test.c.j2",
            word=f"uint{self._code.precision.width}_t",
            hashes_rows=True,
            torques=[line for lines in rows for line in lines],
            listed=len(golden.torques),
            sweep=expected.SWEEP,
            seed=f"0x{expected.SEED:x}u",
            multiplier=f"{expected.MULTIPLIER}u",
            increment=f"{expected.INCREMENT}u",
            lost=expected.LOST,
            settling=expected.SETTLING,
            window=expected.WINDOW,
            largest={name: self._code.hex(value * 2.0**-23) for name, value in expected.LARGEST.items()},
            bit=self._code.hex(2.0**-24),
            servo_hash=f"0x{golden.servo:08x}u",
            trim_hash=f"0x{golden.trim or 0:08x}u",
            greatest=self._code.real(self._code.precision.largest),
        )

    def page(self, example: str) -> str:
        """The page: contents and use, with the functions of the stand's C that the example calls."""
        called = dict.fromkeys(filter(is_public, re.findall(rf"\b{self._stand.name}_(\w+)\(", example)))
        return self.render(
            "servo.md.j2",
            functions=[(self._code.names.function(f.name), f.purpose) for f in self._code.public],
            called=",".join(called),
        )

    def manifest(self, files: Mapping[str, str], what: str) -> str:
        """Manifest: identity of the stand and hash of every file, without dates."""
        return manifest(self._stand, self._code.precision.name, files, {"servo": what})

    def render(self, name: str, **more: Any) -> str:
        """A template rendered with the values that all of them use. The status that it adds has a name of its own."""
        tables, limited = self._tables, self._code.names.constant("LIMITED")
        text = self._code.render(
            name,
            trim=self._form.trim is not None,
            period=self._code.real(tables.period),
            ticks=tables.ticks,
            periods=tables.periods,
            lines=tables.lines,
            facts=[text for line in tables.lines for text in paragraph(line, " *   ", " *     ")],
            **tables.loop,
            **more,
        )
        return text.replace(limited, self._code.names.constant("SERVO_LIMITED"))
