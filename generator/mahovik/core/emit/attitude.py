"""`<stand>_attitude.h`, `.c`: an attitude loop with its settings as a constant; a `main` that runs it on the plant."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mahovik.core.emit.code import Code
from mahovik.core.emit.generate import Generated
from mahovik.core.lower.attitude import lower_attitude
from mahovik.core.stand.model import Stand, Task
from mahovik.core.stand.structure import identities

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
    """Texts of an attitude loop beside the C of its stand."""

    def __init__(self, stand: Stand, generated: Generated, tables: AttitudeTables) -> None:
        self._stand, self._tables = stand, tables
        places = [("wx", "wy", "wz").index(row.component) for row in tables.task.rows]
        program = lower_attitude(generated.layout, generated.program, tables.task.name, places, tables.dumps)
        self._code = Code(program, identities(stand), word="attitude_word")  # the stand's header declares none
        self._facts = {
            "task": tables.task.name,
            "dumps": tables.dumps,
            "wrenches": 6 * len(generated.layout.inputs),
        }

    def files(self) -> dict[str, str]:
        """Header and source by file name."""
        name, code = f"{self._stand.name}_attitude", self._code
        config = code.program.structs[0]
        header = self.render(
            "attitude.h.j2",
            structs=code.structs(code.program.structs),
            functions=code.public_declarations(code.public),
        )
        source = self.render(
            "attitude.c.j2",
            limits=[*code.limits, *code.constants],
            tables=[code.table("attitude_default", config, self._tables.settings)],
            functions=code.functions,
        )
        return {f"{name}.h": header, f"{name}.c": source}

    def list_literals(self, values: tuple[float, ...]) -> str:
        """Literals, one after the other."""
        return ", ".join(map(self._code.real, values))

    def render(self, name: str, **more: Any) -> str:
        """A template rendered with the values that all of them use."""
        return self._code.render(name, **self._facts, eps=self._code.precision.epsilon, **more)
