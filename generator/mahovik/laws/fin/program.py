"""Fins in the program of a stand: those of all bodies, one after the other."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import CYCLES, OWN_TWIST, THREE, WRENCH, BodyProgram, RunTimeInput
from mahovik.core.program.expression import real
from mahovik.core.program.kernel import Reals, Record, reals
from mahovik.core.program.types import Field, Kind, NamedCount, Struct
from mahovik.core.program.vector import dot
from mahovik.core.stand.fields import unit
from mahovik.core.stand.model import Body, Structure, Vec3
from mahovik.laws.fin.law import SPEEDS, Fin, Fins

INT, REAL = Kind.INT, Kind.REAL
RIGHT_ANGLE = math.pi / 2
AHEAD = (real(1), real(0))
"""Direction of the flow where its angle does not count."""


def axes_of(fin: Fin) -> tuple[Vec3, Vec3, Vec3]:
    """Chord, span and normal of length one, at right angles, in the body's frame."""
    chord = unit(fin.chord)
    normal = unit(_cross(chord, unit(fin.span)))
    return chord, _cross(normal, chord), normal


def _cross(a: Vec3, b: Vec3) -> Vec3:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _kinds(structure: Structure) -> list[tuple[str, bool, bool]]:
    """Name of each fin, whether the angle of the flow counts, whether it stalls."""
    return [kind for _, kinds in structure.law("fins") or () for kind in kinds]


def fin_struct(stalls: bool, incidence: bool) -> Struct:
    """One fin; `stall` and `incidence` only where any fin has them."""
    fields = [
        Field("deflection", REAL, (), "rad", "may be set at run time, up to MAX_DEFLECTION"),
        Field("position", REAL, (3,), "m", "in the body's frame, as the axes"),
        Field("chord", REAL, (3,), "", "axes of length one: forward"),
        Field("span", REAL, (3,), "", "to the side"),
        Field("normal", REAL, (3,), "", "chord x span; a positive deflection pushes against it"),
        Field("size", REAL, (), "kg/m", "density/2 times area"),
        Field("lift_slope", REAL, (), "1/rad", "C_L over the angle"),
        Field("drag", REAL, (), "", "C_D without lift"),
        Field("induced", REAL, (), "", "C_D over C_L^2"),
        Field("speed", INT, (), "", "squares in U^2 are of: 0 chord; 1 chord, normal; 2 all axes"),
    ]
    if stalls:
        fields.append(Field("stall", REAL, (), "rad", "angle beyond which lift falls; 0: it does not"))
    if incidence:
        fields.append(Field("incidence", INT, (), "", "1: the angle of the flow counts; 0: the deflection alone"))
    return Struct("fin", "A lifting surface.", tuple(fields))


class LiftingFins(BodyProgram):
    """The fins of every body."""

    words = "fins"
    function = "add_fins"
    array = "fin"
    plural = "fins"

    def bodies(self, structure: Structure) -> set[int]:
        """Indices of the bodies that have fins."""
        return {index for index, _ in structure.law("fins") or ()}

    def count(self, structure: Structure) -> int:
        """Number of fins of all bodies."""
        return len(_kinds(structure))

    def run_time_input(self, structure: Structure) -> RunTimeInput | None:
        """The deflections; None without fins."""
        names = tuple(name for name, _, _ in _kinds(structure))
        count = NamedCount("FINS", len(names), "fins: those of the table, whose deflections are inputs")
        words = "deflections of fins"
        return RunTimeInput("fin", "deflection", "MAX_DEFLECTION", count, names, "FIN_", words) if names else None

    def struct(self, structure: Structure) -> Struct:
        """One fin."""
        kinds = _kinds(structure)
        return fin_struct(any(stalls for *_, stalls in kinds), any(incidence for _, incidence, _ in kinds))

    def rows(self, body: Body, before: Sequence[dict[str, object]]) -> list[dict[str, object]]:
        """The fins of a body."""
        rows, law = [], body.law(Fins)
        for fin in law.fins if law else ():
            row: dict[str, object] = {key: getattr(fin, key) for key in ("deflection", "lift_slope", "drag", "induced")}
            row |= {key: list(axis) for key, axis in zip(("chord", "span", "normal"), axes_of(fin), strict=True)}
            row |= {"position": list(fin.position), "size": 0.5 * fin.density * fin.area}
            row |= {"speed": SPEEDS.index(fin.speed), "incidence": int(fin.incidence)}
            rows.append(row | {"stall": 0.0 if fin.stall is None else fin.stall})
        return rows

    def add_functions(self, lib: FunctionSet) -> None:
        """Lift and drag of the fins of one body."""
        kinds = _kinds(lib.layout.structure)
        turning, stalling = any(incidence for _, incidence, _ in kinds), any(stalls for *_, stalls in kinds)

        @lib.kernel(equation="(7)")
        def add_fins(
            table: Record = lib.table, damper: Record = lib.damper, V: Reals = OWN_TWIST, P: Reals = WRENCH
        ) -> None:
            """Adds lift and drag of the fins of one body to its wrench, both in the body's own frame."""
            for fin in self.elements(lib, table, damper):
                r = fin.position
                velocity = reals(3)  # of the fin
                for i, j, k in CYCLES:
                    velocity[i] = V[i] + (V[3 + j] * r[k] - V[3 + k] * r[j])
                a = dot(fin.chord, velocity)
                b = dot(fin.span, velocity)
                c = dot(fin.normal, velocity)
                square: float = a * a  # U^2
                if fin.speed > 0:
                    square += c * c
                if fin.speed > 1:
                    square += b * b
                pressure = fin.size * square
                flow = AHEAD
                angle: float = fin.deflection  # of the lift
                if turning:
                    plane = a * a + c * c
                    ahead = reals()  # direction of the flow
                    up = reals()
                    ahead = 1
                    up = 0
                    if fin.incidence > 0 and plane > 0:
                        speed = lib["sqrt"](plane)
                        ahead = a / speed
                        up = c / speed
                        angle += lib["atan2"](c, a)
                    flow = (ahead, up)
                size: float = abs(angle)  # of the angle that lifts
                if stalling and fin.stall > 0 and size > fin.stall:
                    fade = fin.stall / (RIGHT_ANGLE - fin.stall)
                    size = fade * (RIGHT_ANGLE - size) if size < RIGHT_ANGLE else 0.0
                C_L = fin.lift_slope * (-size if angle < 0 else size)
                lift = pressure * C_L
                drag = pressure * (fin.drag + fin.induced * C_L * C_L)
                along = lift * flow[1] - drag * flow[0]  # force along the chord
                across = -(lift * flow[0] + drag * flow[1])  # force along the normal
                force = reals(3)
                for i in THREE:
                    force[i] = along * fin.chord[i] + across * fin.normal[i]
                for i, j, k in CYCLES:
                    P[i] += force[i]
                    P[3 + i] += r[j] * force[k] - r[k] * force[j]


LAW = LiftingFins()
