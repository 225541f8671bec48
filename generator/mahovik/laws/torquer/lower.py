"""The torquers in the program of a stand."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from mahovik.core.formula.derived import FormulaModule
from mahovik.core.formula.derived import wrench as derived
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import LawLowering
from mahovik.core.lower.member import Member, members, vector
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Place
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.torquer.law import Torquers as Data

if TYPE_CHECKING:
    from mahovik.laws.torquer import derive as formulas
else:
    formulas = FormulaModule("laws.torquer.derive")

DIPOLE = Field("dipole", Kind.REAL, (3,), "A m2", "in the axes of its mount; may be set at run time")
MOUNT = Field("mount", Kind.INT, (), "", "index of the instrument it is mounted on; -1: the carrier")


def torquer_struct(structure: Structure) -> Struct:
    """One torquer; its mount only where there are instruments."""
    fields = (DIPOLE, MOUNT) if structure.instruments else (DIPOLE,)
    return Struct("torquer", "A magnetic dipole on the carrier or an instrument.", fields)


class Torquers(LawLowering):
    """All torquers, one after the other."""

    words = "torquers"
    placed = False

    def present(self, structure: Structure) -> bool:
        """Whether there is any."""
        return bool(structure.law("torquers"))

    def fields(self, structure: Structure) -> list[Field]:
        """The field, and one struct per torquer."""
        return [
            Field("magnetic_field", Kind.REAL, (3,), "T", "in E0; may be set at run time"),
            Field("torquer", torquer_struct(structure), (len(structure.law("torquers")),)),
        ]

    def values(self, stand: Stand, run: Any) -> dict[str, Any]:
        """Field and dipoles as the file gives them."""
        law = stand.law(Data)
        assert law is not None
        instruments = [instrument.name for instrument in stand.instruments]
        rows: list[dict[str, Any]] = [{"dipole": list(torquer.dipole)} for torquer in law.torquers]
        for row, torquer in zip(rows, law.torquers, strict=True):
            if instruments:
                row["mount"] = instruments.index(torquer.mount) if torquer.mount in instruments else -1
        return {"magnetic_field": list(law.magnetic_field), "torquer": rows}

    def members(self, stand: Stand, field: Field, value: Any) -> Iterator[Member]:
        """The field; then torquer by torquer, counted from 1."""
        if field.name == "magnetic_field":
            yield from vector("magnetic_field", field, value, "magnetic field in E0")
            return
        assert isinstance(field.type, Struct)
        for k, torquer in enumerate(value):
            yield from members(f"torquer[{k + 1}]", field.type, torquer)

    def add_functions(self, lib: FunctionSet) -> None:
        """The moment of one torquer."""
        lib.add(add_torquer(lib))

    def act(self, lib: FunctionSet, body: Body, table: Place, x: Place, C: Place, F: Place) -> None:
        """Adds the moment of every torquer."""
        field = body.local("field", (3,), comment="magnetic field in E1")
        body.call(lib["rotate_back"], C, table.magnetic_field, field)
        with body.loop("k", len(lib.layout.structure.law("torquers"))) as k:
            named = {"table": table, "torquer": table.torquer[k], "field": field, "F": F}
            body.call(lib["add_torquer"], *lib.arguments_of("add_torquer", **named))


LOWERING = Torquers()


def add_torquer(lib: FunctionSet) -> Function:
    """Moment of one torquer, added to F."""
    structure = lib.layout.structure
    table = lib.table_argument()
    torquer = Argument("torquer", torquer_struct(structure))
    field = Argument("field", Kind.REAL, (3,), unit="T", purpose="magnetic field in E1")
    F = Argument("F", Kind.REAL, (6,), "inout", "N, N m", "wrench; this law is added to it")
    body = Body()
    dipole = body.local("dipole", (3,), comment="in E1")
    body.copy_array(dipole, torquer.place.dipole)
    if structure.instruments:
        with body.when(torquer.place.mount >= 0):
            axes = table.place.sensor[torquer.place.mount].axes
            assign(body, list(dipole), derived.rotated(), {"C": axes, "a": torquer.place.dipole})
    assign(body, list(F.place)[3:], formulas.moment(), {"dipole": dipole, "field": field.place}, add=True)
    return Function(
        "add_torquer",
        "Adds the moment of one torquer: dipole x field.",
        (table, torquer, field, F),
        body.statements,
        equation="(7)",
    )
