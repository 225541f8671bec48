"""`<stand>_attitude.h`, `.c`: an attitude loop with its settings as a constant; a `main` that runs it on the plant."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mahovik.core.emit.code import Code
from mahovik.core.lower.attitude import attitude_routines
from mahovik.core.lower.layout import Layout
from mahovik.core.program.types import Kind
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand, Task

_NEEDED = ("step", "wrap")


@dataclass(frozen=True)
class AttitudeTables:
    """The numbers of a loop: members of its settings; `dumps`: with those that dump momentum."""

    task: Task
    dumps: bool
    settings: Mapping[str, float | tuple[float, ...]]


def needed_functions(tables: AttitudeTables) -> tuple[str, ...]:
    """Public functions of the stand that the loop and its example call."""
    return (f"torque_for_{tables.task.name}", *_NEEDED, *(("momentum",) if tables.dumps else ()))


class AttitudePrinter:
    """Texts of an attitude loop."""

    def __init__(self, stand: Stand, layout: Layout, tables: AttitudeTables) -> None:
        self._stand, self._tables = stand, tables
        self._code = Code(attitude_routines(layout), identities(stand), word="attitude_word")
        components = [row.component for row in tables.task.rows]
        places = [("wx", "wy", "wz").index(component) for component in components]
        self._facts = {
            "task": tables.task.name,
            "dumps": tables.dumps,
            "wrenches": 6 * len(layout.inputs),
            "count": int(layout.count),
            "harmonics": [(f.name, int(f.shape[0])) for f in layout.row.fields if f.name.endswith(("c", "s"))],
            "rows": list(enumerate(places)),
            "demand": ", ".join(f"made.demand.wanted[{place}]" for place in places),
        }

    def files(self) -> dict[str, str]:
        """Header and source by file name."""
        name = f"{self._stand.name}_attitude"
        source = self.render(
            "attitude.c.j2",
            limits=self._code.limits(("MAX_STEP", "MAX_WRENCH", "LARGEST")),
            word=self._code.names.type(Kind.WORD),
            uses_word=self._code.words,
            uses_bits_of=Kind.WORD in self._code.casts,
            uses_real_of=Kind.REAL in self._code.casts,
            functions=self._code.functions,
            settings={member: self.numbers(value) for member, value in self._tables.settings.items()},
        )
        return {f"{name}.h": self.render("attitude.h.j2"), f"{name}.c": source}

    def numbers(self, value: float | tuple[float, ...]) -> str:
        """Literals of one or several numbers, as an initialiser of C."""
        if isinstance(value, tuple):
            return f"{{ {self.list_literals(value)} }}"
        return self._code.real(value)

    def list_literals(self, values: tuple[float, ...]) -> str:
        """Literals, one after the other."""
        return ", ".join(self._code.real(v) for v in values)

    def render(self, name: str, **more: Any) -> str:
        """A template rendered with the values that all of them use."""
        return self._code.render(name, **self._facts, eps=self._code.precision.epsilon, **more)
