"""Names in C: each begins with the name of the stand."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.program.types import Kind, Struct


@dataclass(frozen=True)
class Names:
    """C names of a stand: `bench8_forward`, `bench8_state`, `BENCH8_N`."""

    prefix: str

    def function(self, name: str) -> str:
        return f"{self.prefix}_{name}"

    def constant(self, name: str) -> str:
        return f"{self.prefix.upper()}_{name}"

    def type(self, type_: Kind | Struct) -> str:
        """C type of a scalar kind or a struct."""
        if isinstance(type_, Struct):
            return f"{self.prefix}_{type_.name}"
        return {
            Kind.REAL: f"{self.prefix}_real",
            Kind.WORD: f"{self.prefix}_word",
            Kind.STATUS: f"{self.prefix}_status",
            Kind.INT: "int",
            Kind.BOOL: "int",
        }[type_]

    def enumerators(self, names: Sequence[str], taken: Iterable[str], prefix: str = "") -> list[str]:
        """Enumerators for bodies: the name in capitals; with its number where that is taken already."""
        used = set(taken) | set(STATUS_VALUES)
        found = []
        for number, name in enumerate(names):
            candidate = prefix + name.upper()
            while candidate in used:
                candidate = f"{candidate}_{number}"
            used.add(candidate)
            found.append(self.constant(candidate))
        return found
