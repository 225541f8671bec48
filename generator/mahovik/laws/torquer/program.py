"""The torquers in the program of a stand."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import WRENCH, CarrierProgram, Run, declared
from mahovik.core.lower.units import Member, vector
from mahovik.core.program.expression import Place
from mahovik.core.program.kernel import Reals, Record, argument, body
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.program.vector import cross
from mahovik.core.stand.model import Stand, Structure
from mahovik.laws.torquer.law import Torquer, Torquers, mount_index

MOUNT = Field("mount", Kind.INT, (), "", "index of the instrument it is mounted on; -1: the carrier")


def torquer_struct(structure: Structure) -> Struct:
    """One torquer; its mount only where there are instruments."""
    fields = (*declared(Torquer), *([MOUNT] if structure.instruments else []))
    return Struct("torquer", "A magnetic dipole on the carrier or an instrument.", fields)


class TorquersProgram(CarrierProgram):
    """All torquers, one after the other."""

    words = "torquers"
    placed = False

    def arrays(self, structure: Structure) -> list[tuple[Struct, int, str]]:
        """One struct per torquer."""
        count = len(structure.law("torquers") or ())
        return [(torquer_struct(structure), count, "add_torquer")] if count else []

    def fields(self, structure: Structure) -> list[Field]:
        """The field, and the torquers."""
        return [*declared(Torquers), *super().fields(structure)]

    def values(self, stand: Stand, run: Run) -> dict[str, object]:
        """Field and dipoles as the file gives them."""
        law = stand.law(Torquers)
        assert law is not None
        rows = [{"dipole": list(torquer.dipole), "mount": mount_index(stand, torquer)} for torquer in law.torquers]
        return {"magnetic_field": list(law.magnetic_field), "torquer": rows}

    def members(self, stand: Stand, field: Field, value: Sequence[object]) -> Iterator[Member]:
        """The field; then torquer by torquer, counted from 1."""
        if field.name == "magnetic_field":
            return vector("magnetic_field", field, value, "magnetic field in E0")
        return super().members(stand, field, value)

    def add_functions(self, lib: FunctionSet) -> None:
        """The moment of one torquer."""
        structure = lib.layout.structure
        torquer_argument: Record = argument(struct=torquer_struct(structure))

        @lib.kernel(equation="(7)")
        def add_torquer(
            table: Record = lib.table,
            torquer: Record = torquer_argument,
            field: Reals = argument("magnetic field in E1", 3, unit="T"),
            F: Reals = WRENCH,
        ) -> None:
            """Adds the moment of one torquer: dipole x field."""
            dipole: Reals = torquer.dipole  # in E1
            if structure.instruments and torquer.mount >= 0:
                dipole[:] = table.sensor[torquer.mount].axes @ torquer.dipole
            F[3:6] += cross(dipole, field)

    def act(
        self, lib: FunctionSet, table: Record, x: Record, C: Place, F: Place, along: bool = False, **more: Place
    ) -> None:
        """Adds the moment of every torquer."""
        field = body().local("field", (3,), comment="magnetic field in E1")
        body().do(lib["rotate_back"](C, table.magnetic_field, field))
        super().act(lib, table, x, C, F, field=field)


LAW = TorquersProgram()
