"""Propellers in the program of a stand: those of all bodies, one after the other."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import CYCLES, OWN_TWIST, THREE, WRENCH, BodyProgram, RunTimeInput
from mahovik.core.lower.units import Member
from mahovik.core.program.kernel import Reals, Record, reals
from mahovik.core.program.types import Field, Kind, NamedCount, Struct, member
from mahovik.core.program.vector import dot
from mahovik.core.stand.fields import unit
from mahovik.core.stand.model import Body, Stand, Structure, Vec3
from mahovik.laws.propeller.law import Propeller, Propellers

INT, REAL = Kind.INT, Kind.REAL


@dataclass(frozen=True)
class Screw:
    """Thrust and torque on the body as t0 |n| n + t1 |n| u + t2 |u| u of the speed n (rad/s) and the velocity u (m/s).

    axis    of length one
    thrust  t0 (N s2/rad2), t1 (N s2/(rad m)), t2 (N s2/m2)
    torque  likewise, about the axis, N m
    """

    axis: Vec3
    thrust: Vec3
    torque: Vec3


def screw_of(p: Propeller) -> Screw:
    """The propeller so."""
    force = p.density * p.diameter**4
    hand = 1.0 if p.left else -1.0
    thrust = _in_radians(p, p.thrust, (1.0 - p.deduction) * force)
    return Screw(unit(p.axis), thrust, _in_radians(p, p.torque, hand * force * p.diameter))


def _in_radians(p: Propeller, k: Vec3, size: float) -> Vec3:
    advance = (1.0 - p.wake) / p.diameter
    return (
        size * k[0] / (math.tau * math.tau),
        size * k[1] * advance / math.tau,
        size * k[2] * abs(advance) * advance,
    )


def _kinds(structure: Structure) -> list[tuple[str, bool]]:
    """Name of each propeller, and whether it meets the length of the velocity."""
    return [kind for _, kinds in structure.law("propellers") or () for kind in kinds]


def _whole(structure: Structure) -> bool:
    """Whether any propeller meets the length of the velocity."""
    return any(whole for _, whole in _kinds(structure))


def _units(row: int) -> tuple[units.Unit, ...]:
    """Units of a component of a wrench over the squares of a turn, turn and velocity, velocity."""
    return tuple(units.law(row, factors) for factors in ((3, 3), (0, 3), (0, 0)))


class ScrewPropellers(BodyProgram):
    """The propellers of every body."""

    words = "propellers"
    function = "add_propellers"
    array = "propeller"
    plural = "propellers"

    def bodies(self, structure: Structure) -> set[int]:
        """Indices of the bodies that have propellers."""
        return {index for index, _ in structure.law("propellers") or ()}

    def count(self, structure: Structure) -> int:
        """Number of propellers of all bodies."""
        return len(_kinds(structure))

    def run_time_input(self, structure: Structure) -> RunTimeInput | None:
        """The speeds; None without propellers."""
        names = tuple(name for name, _ in _kinds(structure))
        count = NamedCount("PROPELLERS", len(names), "propellers: those of the table, whose speeds are inputs")
        words = "speeds of propellers"
        return RunTimeInput("propeller", "speed", "MAX_SPEED", count, names, "PROPELLER_", words) if names else None

    def struct(self, structure: Structure) -> Struct:
        """One propeller; `whole` only where any is so."""
        fields = [
            Field("speed", REAL, (), "rad/s", "n; may be set at run time, up to MAX_SPEED"),
            Field("position", REAL, (3,), "m", "in the body's frame, as the axis"),
            Field("axis", REAL, (3,), "", "direction of the thrust, of length one"),
            Field(
                "thrust",
                REAL,
                (3,),
                "SI",
                "t0, t1, t2: thrust += t0 |n| n + t1 |n| a + t2 |a| a, a the speed of advance",
            ),
            Field("torque", REAL, (3,), "SI", "likewise, on the body about the axis"),
        ]
        if _whole(structure):
            fields.append(Field("whole", INT, (), "", "1: a is the length of the velocity; 0: its part along the axis"))
        return Struct("propeller", "A propeller of which the speed is given.", tuple(fields))

    def rows(self, body: Body, before: Sequence[dict[str, object]]) -> list[dict[str, object]]:
        """The propellers of a body."""
        law = body.law(Propellers)
        pairs = [(p, screw_of(p)) for p in law.propellers] if law else []
        return [
            {"speed": p.speed, "position": list(p.position), "axis": list(screw.axis), "thrust": list(screw.thrust),
             "torque": list(screw.torque), "whole": int(p.whole)}
            for p, screw in pairs
        ]  # fmt: skip

    def members(self, stand: Stand, field: Field, value: Sequence[object]) -> Iterator[Member]:
        """The propellers, with their bodies and names."""
        propellers = [
            (body.name, p.name) for body in stand.bodies if (law := body.law(Propellers)) for p in law.propellers
        ]
        for number, ((name, propeller), row) in enumerate(zip(propellers, value, strict=True)):
            place, of = f"propeller[{number + 1}]", f"{name}: propeller {propeller}"
            yield Member(f"{place}.speed", units.ANGULAR_VELOCITY, f"{of}, speed", float(member(row, "speed")))
            for key, unit_of, what in (
                ("position", (units.METRE,) * 3, "place in the body's frame"),
                ("axis", (units.NONE,) * 3, "direction of its thrust"),
                ("thrust", _units(0), "thrust by |n| n, |n| u, |u| u"),
                ("torque", _units(3), "torque by |n| n, |n| u, |u| u"),
            ):
                for i, (dimension, size) in enumerate(zip(unit_of, member(row, key), strict=True)):
                    yield Member(f"{place}.{key}[{i + 1}]", dimension, f"{of}, {what}; component {i + 1}", float(size))

    def add_functions(self, lib: FunctionSet) -> None:
        """Thrust and torque of the propellers of one body."""
        whole = _whole(lib.layout.structure)

        @lib.kernel(equation="(7)")
        def add_propellers(
            table: Record = lib.table, damper: Record = lib.damper, V: Reals = OWN_TWIST, P: Reals = WRENCH
        ) -> None:
            """Adds thrust and torque of the propellers of one body to its wrench, both in the body's own frame."""
            for p in self.elements(lib, table, damper):
                r = p.position
                velocity = reals(3)  # of the propeller
                for i, j, k in CYCLES:
                    velocity[i] = V[i] + (V[3 + j] * r[k] - V[3 + k] * r[j])
                u: float = dot(p.axis, velocity)  # velocity that it meets
                if whole and p.whole > 0:
                    u = lib["sqrt"](dot(velocity, velocity))
                squares = (abs(p.speed) * p.speed, abs(p.speed) * u, abs(u) * u)
                thrust = dot(p.thrust, squares)
                torque = dot(p.torque, squares)
                force = reals(3)
                for i in THREE:
                    force[i] = thrust * p.axis[i]
                for i, j, k in CYCLES:
                    P[i] += force[i]
                    P[3 + i] += torque * p.axis[i] + (r[j] * force[k] - r[k] * force[j])


LAW = ScrewPropellers()
