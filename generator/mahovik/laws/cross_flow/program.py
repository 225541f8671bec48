"""Cross-flow drag in the program of a stand: the strips of all bodies, one after the other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from itertools import pairwise

import numpy as np

from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import OWN_TWIST, WRENCH, BodyProgram
from mahovik.core.lower.units import Member
from mahovik.core.program.kernel import Reals, Record
from mahovik.core.program.types import Field, Kind, Struct, member
from mahovik.core.stand.model import Body, Stand, Structure
from mahovik.laws.cross_flow.law import CrossFlow

INT, REAL = Kind.INT, Kind.REAL


@dataclass(frozen=True)
class Strip:
    """A strip at x (m): force over the square of its velocity along y and along z (N s2/m2)."""

    x: float
    y: float
    z: float


def strips_of(law: CrossFlow) -> tuple[Strip, ...]:
    """The strips of a body, from the first station on."""
    nodes, weights = np.polynomial.legendre.leggauss(law.points)
    strips = []
    for k, (a, b) in enumerate(pairwise(law.x)):
        half = 0.5 * (b - a)
        for node, weight in zip(nodes.tolist(), weights.tolist(), strict=True):
            x = a + half * (1.0 + node)
            height, breadth, drag_y, drag_z = (
                (table[k + 1] - table[k]) / (b - a) * (x - a) + table[k]
                for table in (law.height, law.breadth, law.drag_y, law.drag_z)
            )
            scale = 0.5 * law.density * half * weight
            strips.append(Strip(x, scale * drag_y * height, scale * drag_z * breadth))
    return tuple(strips)


def _together(structure: Structure) -> bool:
    """Whether on any body both directions act together."""
    return any(together for _, _, together in structure.law("cross_flow") or ())


class Strips(BodyProgram):
    """The strips of the quadrature along every body."""

    words = "cross-flow drag"
    function = "add_strips"
    array = "strip"
    plural = "strips"

    def bodies(self, structure: Structure) -> set[int]:
        """Indices of the bodies that have cross-flow drag."""
        return {index for index, _, _ in structure.law("cross_flow") or ()}

    def count(self, structure: Structure) -> int:
        """Number of strips of all bodies."""
        return sum(count for _, count, _ in structure.law("cross_flow") or ())

    def struct(self, structure: Structure) -> Struct:
        """One strip; `together` only where any body has it."""
        fields = [
            Field("x", REAL, (), "m", "its place along the body's first axis"),
            Field("y", REAL, (), "N s2/m2", "force over the square of its velocity along y"),
            Field("z", REAL, (), "N s2/m2", "likewise along z"),
        ]
        if _together(structure):
            fields.append(
                Field("together", INT, (), "", "1: the drag is along the whole velocity across; 0: y, z apart")
            )
        return Struct("strip", "A strip of a slender body in cross flow.", tuple(fields))

    def rows(self, body: Body, before: Sequence[dict[str, object]]) -> list[dict[str, object]]:
        """The strips of a body."""
        law = body.law(CrossFlow)
        return [asdict(strip) | {"together": int(law.together)} for strip in strips_of(law)] if law else []

    def members(self, stand: Stand, field: Field, value: Sequence[object]) -> Iterator[Member]:
        """The strips, with their bodies."""
        laws = ((body.name, body.law(CrossFlow)) for body in stand.bodies)
        strips = [(name, k) for name, law in laws if law for k in range(len(strips_of(law)))]
        for number, ((name, k), row) in enumerate(zip(strips, value, strict=True)):
            for key, unit, what in (
                ("x", units.METRE, "place along its first axis"),
                ("y", units.law(1, (1, 1)), "drag over the square of its velocity along y"),
                ("z", units.law(1, (1, 1)), "drag over the square of its velocity along z"),
            ):
                text = f"{name}: strip {k + 1} in cross flow, {what}"
                yield Member(f"strip[{number + 1}].{key}", unit, text, float(member(row, key)))

    def add_functions(self, lib: FunctionSet) -> None:
        """The drag of the strips of one body."""
        together = _together(lib.layout.structure)

        @lib.kernel(equation="(7)")
        def add_strips(
            table: Record = lib.table, damper: Record = lib.damper, V: Reals = OWN_TWIST, P: Reals = WRENCH
        ) -> None:
            """Adds the cross-flow drag of one body to its wrench, both in the body's own frame."""
            for strip in self.elements(lib, table, damper):
                v = V[1] + strip.x * V[5]
                w = V[2] - strip.x * V[4]
                Y: float = -(strip.y * (v * abs(v)))
                Z: float = -(strip.z * (w * abs(w)))
                if together and strip.together > 0:
                    across = lib["sqrt"](v * v + w * w)
                    speed = across if across > 0 else 1.0  # of the strip across the axis
                    drag = (strip.y * v * v + strip.z * w * w) / speed
                    Y = -(drag * v)
                    Z = -(drag * w)
                P[1] += Y
                P[2] += Z
                P[4] -= strip.x * Z
                P[5] += strip.x * Y


LAW = Strips()
