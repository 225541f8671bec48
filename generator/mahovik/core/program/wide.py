"""Types side by side: what one state has as a real is an array of lanes, one of each state of a block."""

from __future__ import annotations

from dataclasses import replace

from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Const, Expr, Place, Variable, integer
from mahovik.core.program.types import Field, Kind, Precision, Struct

BYTES = 64
"""Size of one wide value, bytes: a line of the cache, a register of AVX-512, two of AVX2, four of SSE2 or NEON."""


class Wide:
    """The wide forms of the types of one program. Ints are the same in all lanes and stay as they are."""

    def __init__(self, precision: Precision) -> None:
        self.lanes = BYTES * 8 // precision.width
        here = f"{self.lanes} reals, one a state"
        self.real = Struct("wide", here, (Field("at", Kind.REAL, (self.lanes,)),))
        self.word = Struct("wide_word", f"{self.lanes} words, one a state", (Field("at", Kind.WORD, (self.lanes,)),))
        self._structs: dict[str, Struct] = {}

    def of(self, type_: Kind | Struct) -> Kind | Struct:
        """The wide form of a type."""
        if isinstance(type_, Struct):
            return self._struct(type_)
        if type_ is Kind.BOOL:
            raise TypeError("a condition is not kept from one stretch of code to the next")
        return {Kind.REAL: self.real, Kind.WORD: self.word}.get(type_, type_)

    def _struct(self, struct: Struct) -> Struct:
        if struct.name not in self._structs:
            fields = tuple(replace(f, type=self.of(f.type)) for f in struct.fields)
            purpose = f"{struct.purpose.rstrip('.')}; of {self.lanes} states side by side."
            self._structs[struct.name] = Struct(f"wide_{struct.name}", purpose, fields)
        return self._structs[struct.name]

    def argument(self, a: Argument) -> Argument:
        """An argument in its wide form."""
        return Argument(a.name, self.of(a.type), a.shape, a.direction, a.unit, a.purpose)

    def variable(self, v: Variable) -> Variable:
        """A local variable in its wide form."""
        return Variable(v.name, self.of(v.type), v.shape)

    def place(self, place: Place, wide: Variable, lane: Expr | None) -> Place:
        """A place after its root has become `wide`; for a scalar, its element at `lane`."""
        type_ = self.of(place.type)
        whole = Place(wide, place.path, type_, place.shape)
        if place.shape or type_ is place.type or lane is None or not isinstance(place.type, Kind):
            return whole
        return whole.at[lane]


def lane_bounds(wide: Wide) -> tuple[Const, Const]:
    """First lane, and one more than the last."""
    first, last = integer(0), integer(wide.lanes)
    assert isinstance(first, Const) and isinstance(last, Const)
    return first, last
