"""Structs of the tables of a flywheel programme. Fields that a table does not use are omitted."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from mahovik.core.program.types import Field, Kind, NamedCount, Struct

SECTORS = 64
"""Parts of a period in which a Fourier table removes the whole turns of a winding."""

RESERVED = frozenset(
    (
        *("PROGRAMME_H", "PROGRAMME_TEST_MAIN"),
        *(
            f"PROGRAMME_{part}{name}"
            for part in ("", "RUNUP_", "RUNDOWN_")
            for name in ("NODES", "HARMONICS", "PERIOD", "DURATION")
        ),
    )
)
"""Names of a programme's header and source, that no flywheel may have."""


@dataclass(frozen=True)
class Form:
    """What decides the text of the C of one table, beside the stand.

    `part` is "" for the programme itself, else "runup" or "rundown". `kind`: "quintic" or "fourier". `rows`: intervals
    of a quintic table, a power of two, at least 8; harmonics of a Fourier table. `cyclic`: the last interval ends on
    the first node, and flywheels have windings. `torque`: drive torques are in the table. `count`: flywheels.
    """

    part: str
    kind: str
    rows: int
    cyclic: bool
    torque: bool
    count: NamedCount

    @property
    def prefix(self) -> str:
        """Prefix of the names of this table."""
        return f"programme_{self.part}_" if self.part else "programme_"

    @cached_property
    def size(self) -> NamedCount:
        """Intervals, or harmonics."""
        name = "NODES" if self.kind == "quintic" else "HARMONICS"
        words = {"quintic": "intervals of the table", "fourier": "harmonics of the table"}[self.kind]
        return NamedCount(f"{self.prefix.upper()}{name}", self.rows, words)

    @cached_property
    def row(self) -> Struct:
        """One node, or one harmonic."""
        n = (self.count,)
        if self.kind == "quintic":
            fields = [
                Field(
                    "phi", Kind.REAL, n, "rad", "angle, less winding and mean" if self.cyclic else "within half a turn"
                ),
                Field("phi_dot", Kind.REAL, n, "rad/s", "its rate"),
                Field("phi_ddot", Kind.REAL, n, "rad/s2", "its second derivative"),
            ]
            fields += [Field("tau", Kind.REAL, n, "N m", "drive torque")] if self.torque else []
            return Struct(f"{self.prefix}node", "A node of the table: each number a flywheel.", tuple(fields))
        fields = [Field("cos", Kind.REAL, n, "rad", "of the angle"), Field("sin", Kind.REAL, n, "rad", "of the angle")]
        if self.torque:
            fields.append(Field("tau_cos", Kind.REAL, n, "N m", "of the drive torque"))
            fields.append(Field("tau_sin", Kind.REAL, n, "N m", "of the drive torque"))
        return Struct(f"{self.prefix}harmonic", "A harmonic of the table: each number a flywheel.", tuple(fields))

    @cached_property
    def table(self) -> Struct:
        """The whole table."""
        n = (self.count,)
        fields = []
        if self.kind == "quintic":
            fields.append(Field("step", Kind.REAL, (), "s", "time between nodes"))
            fields.append(Field("rate", Kind.REAL, (), "1/s", "1 / step"))
        else:
            fields.append(Field("omega", Kind.REAL, (), "rad/s", "2 pi / period"))
        if self.cyclic:
            fields.append(Field("winding", Kind.INT, n, "", "turns per period"))
            fields.append(Field("speed", Kind.REAL, n, "rad/s", "mean speed: 2 pi winding / period"))
            fields.append(Field("mean", Kind.REAL, n, "rad", "mean angle, less the winding"))
        if self.kind == "quintic":
            nodes: int | NamedCount = self.size if self.cyclic else self.rows + 1
            fields.append(Field("node", self.row, (nodes,)))
        else:
            if self.torque:
                fields.append(Field("tau_mean", Kind.REAL, n, "N m", "mean drive torque"))
            fields.append(Field("harmonic", self.row, (self.size,)))
        return Struct(f"{self.prefix}table", "Angles of the flywheels in time.", tuple(fields))
