"""`[suspension]` of a stand file: a 6x6 stiffness and a 6x6 damping between E0 and the carrier."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Annotated, ClassVar, Self

from mahovik.core.stand.declare import (
    AS_MATRIX,
    AS_VECTOR,
    BRAKES,
    PULLS_BACK,
    Declared,
    Draw,
    Drawn,
    Errors,
    InC,
    Note,
    normal,
)
from mahovik.core.stand.fields import LINEAR, ZERO3, Angle3, Length3, matrix, validator
from mahovik.core.stand.law import CarrierLaw
from mahovik.core.stand.model import Mat6, Stand
from mahovik.core.stand.tables import Blocks, Default, Table
from mahovik.core.stand.units import Dimension, QuantityError, show
from mahovik.laws.suspension.isolators import Isolator, summed

STIFFNESS: Blocks = (
    (Dimension("a stiffness", "N/m"), Dimension("a stiffness", "N/rad")),
    (Dimension("a stiffness", "N"), Dimension("a stiffness", "N m/rad")),
)


def _preload(raw: object) -> bool:
    if raw != "weight":
        raise QuantityError(f'expected "weight", found {show(raw)}')
    return True


@dataclass(frozen=True)
class Suspension(CarrierLaw):
    """Suspension of the carrier to E0: wrench `-(stiffness x + damping V)` at O1 in E1 axes.

    `x = (C^T (O1 - position), rotation vector of C_eq^T C)`. Where there are `isolators`, the first four are made of
    them.

    stiffness  wrench `-stiffness x`
    damping    wrench `-damping V`
    position   equilibrium of `O1`, in `E0`
    angles     equilibrium attitude `C_eq`, in the sequence of the file
    preload    with isolators: their springs balance weight and buoyancy in the pose of the file
    """

    stiffness: Annotated[
        Mat6, matrix(STIFFNESS), Default(None), InC("wrench -= stiffness x", "SI"), PULLS_BACK, AS_MATRIX,
        Drawn(lambda draw, of: draw.definite6(900.0)),
    ]  # fmt: skip
    damping: Annotated[
        Mat6, matrix(LINEAR), Default(None), InC("wrench -= damping V", "SI"), BRAKES, AS_MATRIX,
        Drawn(lambda draw, of: draw.definite6(15.0)),
    ]  # fmt: skip
    position: Annotated[Length3, Default(ZERO3), InC("equilibrium of O1, in E0"), AS_VECTOR, normal(0.1)]
    angles: Annotated[Angle3, Default(ZERO3), normal(0.3)]
    preload: Annotated[
        bool, validator(_preload, write=lambda on: "weight", words=(("weight", True),)), Default(False, written=False)
    ] = False
    isolators: tuple[Isolator, ...] = ()

    key: ClassVar[str] = "suspension"
    carries_weight: ClassVar[bool] = True
    legend: ClassVar[tuple[str, str]] = (
        "dotted circle", "suspension: a 6x6 between O1 and the ground, it has no shape",
    )  # fmt: skip
    at_origin: ClassVar[bool] = True
    made_of: ClassVar[dict[str, type[Declared]]] = {"isolator": Isolator}

    @property
    def rows(self) -> tuple[int, ...]:
        """Components of its wrench whose row of stiffness or damping is not zero."""
        return tuple(i for i in range(6) if any(self.stiffness[i]) or any(self.damping[i]))

    @property
    def acts(self) -> bool:
        """Whether any component of its wrench has a number that is not zero."""
        return bool(self.rows)

    @classmethod
    def content(cls, law: Self | None) -> dict[str, object]:
        """All numbers; None without, as identities had it from the beginning."""
        sources = ("isolators", "preload")
        numbers = {} if law is None else asdict(law)
        return {"suspension": {key: x for key, x in numbers.items() if key not in sources} or None}

    @classmethod
    def of_parts(cls, stand: Stand, raw: dict[str, object] | None, tables: dict[str, list[Table]], note: Note) -> Stand:
        """The stand on the suspension that its isolators make; `raw`: the keys of [suspension] in the file."""
        isolators = tuple(map(Isolator.of_table, tables["isolator"]))
        beside = [key for key in raw or {} if key != "preload"]
        if not isolators:
            if "preload" in (raw or {}):
                note(cls.key, "preload", "is of springs that stand as [[isolator]], but there is none")
            return stand
        if beside:
            note(cls.key, beside[0], 'given beside [[isolator]], which make it: expected preload = "weight" alone')
            return stand
        try:
            made = summed(isolators, bool(raw), stand)
        except QuantityError as error:
            note(*error.args)
            return stand
        law = cls(made.stiffness, made.damping, made.position, made.angles, bool(raw), isolators)
        return stand.with_laws(law) if law.acts else stand

    def as_tables(self) -> dict[str, object]:
        """Its tables in a stand file: isolators as such."""
        if not self.isolators:
            return super().as_tables()
        preload = {"suspension": {"preload": "weight"}} if self.preload else {}
        return {**preload, "isolator": [isolator.as_keys() for isolator in self.isolators]}

    def with_errors(self, errors: Errors) -> Self:
        """One whose matrices and place are a little wrong, whatever they are made of."""
        return replace(super().with_errors(errors), isolators=(), preload=False)

    @classmethod
    def structure(cls, law: Self | None, stand: Stand) -> dict[str, object]:
        """Whether there is a suspension."""
        return {"suspension": law is not None}

    @classmethod
    def random_of(cls, draw: Draw, count: int | None, mounts: Sequence[str]) -> Self | None:
        """A definite stiffness and damping, and an equilibrium off the origin; None where there is none."""
        return cls.random(draw) if draw.flag(None if count is None else count > 0) else None


LAW = Suspension
