"""A program as C: its facts, structs, functions and tables, ready for the templates that print them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

from mahovik.core.emit.declaration import contract, definition, null_check, prototype, struct_lines, summary, zeros
from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.layout import comment_lines
from mahovik.core.emit.literal import hex_literal, initialiser, real_literal
from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import Statements
from mahovik.core.emit.templates import template
from mahovik.core.lower.golden import fnv1a
from mahovik.core.lower.limits import constants, limits
from mahovik.core.program.call import Call
from mahovik.core.program.expression import BitCast, Choice, Const
from mahovik.core.program.function import Function, Program
from mahovik.core.program.restrictable import restrictable
from mahovik.core.program.types import Kind, Struct
from mahovik.core.program.walk import expressions
from mahovik.core.stand.structure import Identities

_IDENTITY = (
    "The linker sees names that end in the kind of the reals and a hash of this header: a caller with the header of "
    "another stand, element type, choice of functions or version does not link. Define {} for all files, "
    "and it sees the names as they are, as dlsym, --wrap and other languages need them."
)
"""Comment above the names of the linker."""

_EXCESS = {
    32: "FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16",
    64: "FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1 && FLT_EVAL_METHOD != 16",
}
"""Condition of C, by bits of a real, that results keep more digits than the type; 16 is about _Float16 alone."""

INDENT = "    "
"""One indent."""


class Code:
    """A program with the names and literals that it has in C; `word`, `types`: as of Names."""

    def __init__(
        self, program: Program, identities: Identities, word: str = "word", types: Mapping[Kind, str] | None = None
    ) -> None:
        self.program, self.precision, self.names = program, program.precision, Names(program.name, word, types or {})
        self.public = [f for f in program.functions if f.public]
        self._statements = Statements(self.names, Expressions(self.names, self.precision))
        self._facts = {
            "name": program.name,
            "NAME": program.name.upper(),
            "structure": identities.structure,
            "physics": identities.physics,
            "real": self.precision.name,
            "width": self.precision.width,
            "real_bytes": self.precision.width // 8,
            "real_prefix": "DBL" if self.precision.width == 64 else "FLT",
            "real_digits": self.precision.significand,
            "excess": _EXCESS[self.precision.width],
            "literal": self.real,
            "hexadecimal": self.hex,
            "zeros": zeros(self.public, self.names),
            "words": self.words,
            "word_type": self.names.type(Kind.WORD),
            "bits_of": Kind.WORD in self.casts,
            "real_of": Kind.REAL in self.casts,
        }

    def render(self, name: str, **more: Any) -> str:
        """The text of a template, which knows the facts of the program and what else is given."""
        text = template(name).render(**self._facts | more)
        return self._with_identity(text) if name.endswith(".h.j2") else text

    def _with_identity(self, header: str) -> str:
        """A header with macros that give its functions and constants names for the linker, which end in its hash."""
        name, suffix = self.program.name, f"f{self.precision.width}_{fnv1a(header.encode('ascii')):08x}"
        public = re.findall(rf"^(?:extern const )?\w+ ({name}_\w+)[(;]", header, re.MULTILINE)
        width = max(map(len, public), default=0)
        plain = f"{name.upper()}_PLAIN_NAMES"
        lines = [*comment_lines(_IDENTITY.format(plain)), f"#ifndef {plain}"]
        lines += [f"#define {symbol:<{width}} {symbol}_{suffix}" for symbol in public]
        begin = '#ifdef __cplusplus\nextern "C" {\n'
        return header.replace(begin, "\n".join([*lines, "#endif", "", begin]), 1)

    # -- literals ------------------------------------------------------------------------------------------------------

    def real(self, value: float) -> str:
        """A decimal literal."""
        return real_literal(value, self.precision)

    def number(self, value: float) -> str:
        """A decimal literal; the largest number by its name."""
        return self.names.constant("LARGEST") if value == self.precision.largest else self.real(value)

    def hex(self, value: Any) -> str:
        """A hexadecimal literal."""
        return hex_literal(float(value), self.precision)

    @property
    def limits(self) -> list[tuple[str, str, str]]:
        """Macro, value and meaning of the bounds that the program uses."""
        return [
            (self.names.constant(x.name), self.real(x.value), f"{x.unit}; {x.comment}" if x.unit else x.comment)
            for x in limits(self.precision).values()
            if x.name in self._named
        ]

    @property
    def constants(self) -> list[tuple[str, str, str]]:
        """Macro, value and meaning of the other constants with names that the program uses."""
        known = (x for x in constants(self.precision) if x.name in self._named)
        return [(self.names.constant(x.name), self.real(x), x.comment) for x in known]

    @cached_property
    def _named(self) -> set[str]:
        return {e.name for f in self.program.functions for e in expressions(f.body) if isinstance(e, Const)}

    # -- what a program consists of ------------------------------------------------------------------------------------

    def structs(self, structs: Iterable[Struct]) -> list[list[str]]:
        """Definitions of structs."""
        return [struct_lines(s, self.names) for s in structs]

    def public_declarations(self, functions: Iterable[Function]) -> list[dict[str, Any]]:
        """Contract and prototype of public functions."""
        return [{"comment": contract(f, self.program), "prototype": prototype(f, self.names)} for f in functions]

    @cached_property
    def functions(self) -> list[dict[str, Any]]:
        """Comment, prototype and body of each function."""
        return [self.function(f) for f in self.program.functions]

    def function(self, f: Function) -> dict[str, Any]:
        """Comment, prototype and body of one function, for the templates."""
        body = [*null_check(f, self.names), *self._statements.function(f)]
        return {
            "comment": summary(f),
            "definition": definition(f, self.names, self._restrictable),
            "prototype": prototype(f, self.names, self._restrictable),
            "body": body,
            "apart": f.apart,
            "copied": f.copied,
        }

    def table(
        self, name: str, struct: Struct, value: Mapping[str, Any], labels: Mapping[str, list[str]] | None = None
    ) -> dict[str, Any]:
        """Definition of a constant; `labels`: names of the rows of array members, for a comment at their end."""
        return {
            "declaration": f"const {self.names.declaration(self.names.function(name), struct)}",
            "lines": initialiser(struct, value, self.number, labels or {}),
        }

    @cached_property
    def casts(self) -> set[Kind]:
        """Kinds that bits are cast to."""
        result = (e for f in self.program.functions for e in expressions(f.body))
        return {e.kind for e in result if isinstance(e, BitCast)}

    @cached_property
    def chooses(self) -> bool:
        """Is a real chosen by its bits?"""
        return any(isinstance(e, Choice) for f in self.program.functions for e in expressions(f.body))

    @property
    def words(self) -> bool:
        """Whether the type of bits is used."""
        every = (e for f in self.program.functions for e in expressions(f.body) if not isinstance(e, Call))
        return bool(self.casts) or any(getattr(e, "kind", None) is Kind.WORD for e in every)

    @cached_property
    def _restrictable(self) -> frozenset[tuple[str, str]]:
        return restrictable(self.program)
