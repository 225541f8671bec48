"""Names in C: each begins with the name of the stand."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.program.types import Kind, NamedCount, Shape, Struct

VERIFICATION = "verification/"
"""Folder, below that of the firmware, of files that test or prove it; what is beside it can all be compiled."""

_MACROS_OF_FILES = """
H BATCH_H SERVO_H STRUCTURE PHYSICS TABLE_HASH REAL_BYTES VERSION_MAJOR VERSION_MINOR VERSION_PATCH
CODE CONST ALIGNED APART COPIED ALLOW_FAST_MATH SQRT PLAIN_NAMES
SELFTEST_MAIN SELFTEST_SWEEP FUZZ_MAIN SERVO_MAIN SERVO_TEST_MAIN SERVO_PERIOD SERVO_PERIODS SERVO_TICKS SERVO_LIMITED
"""
RESERVED = frozenset(_MACROS_OF_FILES.split())
"""Names of the files beside a recorder's and a programme's, that no flywheel may have."""


MACROS = frozenset(("I", "complex", "imaginary"))
"""Macros of <complex.h> and <tgmath.h>, which replace every word of their spelling in what is included after them."""


def member(name: str) -> str:
    """Name in C of a member of a struct: `K`; `I_` for what is a macro of the standard library."""
    return f"{name}_" if name in MACROS else name


@dataclass(frozen=True)
class Names:
    """C names of a stand: `bench8_forward`, `bench8_state`, `BENCH8_N`; `word`: of the type of bits.

    `types`: kinds that have a type of C itself.
    """

    prefix: str
    word: str = "word"
    types: Mapping[Kind, str] = field(default_factory=dict)

    def function(self, name: str) -> str:
        return f"{self.prefix}_{name}"

    def constant(self, name: str) -> str:
        return f"{self.prefix.upper()}_{name}"

    def type(self, type_: Kind | Struct) -> str:
        """C type of a scalar kind or a struct."""
        if isinstance(type_, Struct):
            return f"{self.prefix}_{type_.name}"
        plain = "int" if type_ in (Kind.INT, Kind.BOOL) else f"{self.prefix}_{type_.value}"
        return self.types.get(type_) or (f"{self.prefix}_{self.word}" if type_ is Kind.WORD else plain)

    def length(self, count: int | NamedCount) -> str:
        """A length: a named count by its name; of 0, which is any, nothing."""
        return self.constant(count.name) if isinstance(count, NamedCount) else str(count or "")

    def declaration(self, name: str, type_: Kind | Struct, shape: Shape = ()) -> str:
        """`bench8_real F[6]`: type, name, lengths."""
        return f"{self.type(type_)} {name}{self.lengths(shape)}"

    def lengths(self, shape: Shape) -> str:
        """`[6]`, `[BENCH8_N]`, `[]`."""
        return "".join(f"[{self.length(count)}]" for count in shape)

    def enumerators(self, names: Sequence[str], taken: Iterable[str], prefix: str = "") -> list[str]:
        """Enumerators for bodies: the name in capitals; with its number where that is taken already."""
        used = set(taken) | set(STATUS_VALUES)
        result = []
        for number, name in enumerate(names):
            candidate = prefix + name.upper()
            while candidate in used:
                candidate = f"{candidate}_{number}"
            used.add(candidate)
            result.append(self.constant(candidate))
        return result
