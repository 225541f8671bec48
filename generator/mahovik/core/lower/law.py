"""What a law of `laws/` adds to a stand's program: members of structs, their numbers, and functions.

Of a law between E0 and the carrier `CarrierProgram`; of one that acts on a body in its own frame `BodyProgram`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.units import Member, Unit, members
from mahovik.core.program.expression import Place
from mahovik.core.program.kernel import argument, body, changed
from mahovik.core.program.types import Field, Kind, NamedCount, Struct
from mahovik.core.stand.declare import Declared, InC
from mahovik.core.stand.model import Body, Mat6, Stand, Structure, Vec3
from mahovik.core.stand.tables import QuantityValidator
from mahovik.core.stand.units import Dimension

SHAPES: dict[Any, tuple[int, ...]] = {Vec3: (3,), Mat6: (6, 6)}

ATTITUDE: Any = argument("attitude of the carrier", 9)
WRENCH: Any = changed("wrench; this law is added to it", 6, unit="N, N m")
OWN_TWIST: Any = argument("twist relative to the fluid, in the body's frame", 6)
"""Arguments of functions that add a wrench."""

Run: TypeAlias = Callable[[str, Mapping[str, Any]], tuple[Any, dict[str, Any]]]
"""What runs a function of the program: its name and inputs; its value and outputs."""

THREE, SIX = range(3), range(6)
CYCLES = ((0, 1, 2), (1, 2, 0), (2, 0, 1))
"""Components of a cross product: the text of a kernel is repeated for each."""


def declared(data: type[Declared]) -> tuple[Field, ...]:
    """Members of a struct that are as a class of data declares them."""
    validators, kinds = data.marked(QuantityValidator), data.annotations()
    fields = []
    for name, mark in data.marked(InC).items():
        dimension = validators[name].dimension if name in validators else None
        unit = dimension.si if mark.unit is None and isinstance(dimension, Dimension) else mark.unit or ""
        fields.append(Field(name, Kind.REAL, SHAPES.get(kinds[name][0], ()), unit, mark.comment))
    return tuple(fields)


class LawProgram(ABC):
    """What both kinds of laws have: `words`, the law in the list of kinds of wrench, and functions."""

    words: str

    def units(self, stand: Stand, struct: Struct, number: int) -> Mapping[str, Unit]:
        """Units of a struct's members, by name, that are those of what slides or turns."""
        return {}

    def members(self, stand: Stand, field: Field, value: Any) -> Iterator[Member]:
        """Every real of one of its members, depth first, for simulators; none that follows from the hold."""
        assert isinstance(field.type, Struct)
        for k, row in enumerate(value):
            yield from members(f"{field.name}[{k + 1}]", field.type, row, self.units(stand, field.type, k))

    @abstractmethod
    def add_functions(self, lib: FunctionSet) -> None:
        """Adds its functions, for stands that have the law."""


class CarrierProgram(LawProgram):
    """A law between E0 and the carrier: LAW of the module `program` of its folder.

    placed       does its wrench depend on the place of O1?
    invalid      what of it may have a length that it must not have, for the list of statuses; "" for nothing
    quaternions  places in the table that must have unit length
    refuses      may its function refuse a state? Its status is RANGE then
    """

    placed = True
    invalid = ""
    quaternions: tuple[str, ...] = ()
    refuses = False

    def arrays(self, structure: Structure) -> list[tuple[Struct, int, str]]:
        """Its structs in the table, how many of each, and the name of the function that adds the wrench of one."""
        return []

    def present(self, structure: Structure) -> bool:
        """Whether a stand has the law."""
        return bool(self.arrays(structure))

    def fields(self, structure: Structure) -> list[Field]:
        """Members that the law adds to the table."""
        return [Field(struct.name, struct, (count,)) for struct, count, _ in self.arrays(structure)]

    @abstractmethod
    def values(self, stand: Stand, run: Run) -> dict[str, Any]:
        """The numbers of its members, by name; `run` runs a function of the program."""

    def act(self, lib: FunctionSet, table: Any, x: Any, C: Place, F: Place, along: bool = False, **more: Place) -> None:
        """Adds its wrench, in E1 about O1, to F, in the text of a kernel. `x`: the state; `C`: the attitude (9).

        `along`: no component that S^T does not take is needed.
        """
        for struct, count, name in self.arrays(lib.layout.structure):
            with body().loop("k", count) as k:
                row = table.member(struct.name)[k]
                named = {struct.name: row, "law": row, "table": table, "x": x, "V": x.V, "C": C, "F": F} | more
                add = body().check if lib[name].returns else body().do
                add(lib[name](*lib.arguments_of(name, **named)))


@dataclass(frozen=True)
class RunTimeInput:
    """A number of every struct of one array of the table that the caller may set at run time.

    array, member  its place, `table.fin[k].deflection`
    limit          name of the bound of its magnitude, such as MAX_SPEED
    count          length of the array
    names          names in the stand file, in the order of the array
    prefix         enumerators of the indices are this and the name in capitals
    words          "deflection of every fin"
    """

    array: str
    member: str
    limit: str
    count: NamedCount
    names: tuple[str, ...]
    prefix: str
    words: str


class BodyProgram(LawProgram):
    """A law that acts on a body in its own frame: LAW of the module `program` of its folder.

    function  name of the function that adds the wrench of a body by its own twist
    array     its array in the table, of which each body has a range, and `plural`, what that has; "" without one
    """

    function: str
    array = ""
    plural = ""

    @abstractmethod
    def bodies(self, structure: Structure) -> set[int]:
        """Indices of the bodies that it acts on."""

    def count(self, structure: Structure) -> int:
        """Length of the array."""
        return 0

    def struct(self, structure: Structure) -> Struct:
        """One element of the array; laws without an array, whose count is 0, have none."""
        raise NotImplementedError

    def rows(self, body: Body, before: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
        """The elements of a body; those of other bodies are before them."""
        return []

    def run_time_input(self, structure: Structure) -> RunTimeInput | None:
        """A number of each element that is set at run time; None where there is none."""
        return None

    def table_fields(self, structure: Structure) -> list[Field]:
        """The array, where it has elements."""
        settable = self.run_time_input(structure)
        count = settable.count if settable else self.count(structure)
        return [Field(self.array, self.struct(structure), (count,))] if int(count) else []

    def damper_fields(self, structure: Structure) -> list[Field]:
        """Members of the damper of a body: the range of its elements."""
        if not self.count(structure):
            return []
        words = f"{self.plural} first_{self.array} .. last_{self.array} - 1 of the table"
        return [Field(f"first_{self.array}", Kind.INT, (), "", words), Field(f"last_{self.array}", Kind.INT)]

    def damper_values(self, body: Body, damper: Struct, rows: dict[str, list[dict[str, Any]]]) -> dict[str, Any]:
        """The members of a damper; the elements of the body are appended to the `rows` of the array."""
        if damper.field(f"first_{self.array}") is None:
            return {}
        elements = rows.setdefault(self.array, [])
        first = len(elements)
        elements += self.rows(body, elements)
        return {f"first_{self.array}": first, f"last_{self.array}": len(elements)}

    def damper_members(self, name: str, damper: Struct, value: Any) -> Iterator[Member]:
        """Every real that the law has in the damper of a body of that name, for simulators."""
        return members(f"{name}.{self.function.removeprefix('add_')}", damper, value)

    def elements(self, lib: FunctionSet, table: Any, damper: Any, index: str = "k") -> Iterator[Any]:
        """`for fin in law.elements(lib, table, damper):` those of one body, in the text of a kernel."""
        first, last = (damper.member(f"{end}_{self.array}") for end in ("first", "last"))
        with body().loop(index, last, first, most=self.count(lib.layout.structure)) as k:
            yield table.member(self.array)[k]
