"""`[[fin]]` of a stand file: lift and drag of fins and of bodies, by the angle of the flow and a deflection."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, Literal, Self

from mahovik.contract.quantities import BOUNDS
from mahovik.core.stand import units
from mahovik.core.stand.columns import hypot
from mahovik.core.stand.declare import TIMES, Declared, Draw
from mahovik.core.stand.fields import ZERO3, Direction, Flag, Length3, Mounted, Name, one_word, parallel, scalar
from mahovik.core.stand.law import Actuator, BodyLaw
from mahovik.core.stand.model import Body, Flywheel, Stand
from mahovik.core.stand.tables import Default, Table, TableError
from mahovik.core.stand.units import Dimension

Speed = Literal["along", "across", "whole"]
SPEEDS: tuple[Speed, ...] = ("along", "across", "whole")
"""The components of the fin's velocity in U^2, along chord, span, normal: a; a and c; a, b and c."""

SPEED = one_word({speed: speed for speed in SPEEDS}, '"along", "across" or "whole"')

MOST_DEFLECTION = BOUNDS["MAX_DEFLECTION"].value
"""Largest deflection, rad, in the file and at run time."""

USUAL = 0.3
"""Deflection, rad, of a state that is drawn."""

DENSITY = Dimension("a density", "kg/m^3")
AREA = Dimension("an area", "m^2")


Coefficient = scalar(units.PLAIN, least=0.0)
Ratio = Annotated[float | None, scalar(units.PLAIN, above=0.0)]


class FinTable(Mounted):
    """`[[fin]]`: keys that no field of the data is, and checks of several keys.

    aspect      aspect ratio `R`: `lift_slope` is then `pi R/(1 + sqrt(1 + (R/2)^2))`, and `induced` is
                `1/(pi efficiency R)`
    efficiency  of `induced` by `aspect`; without it 0.7
    """

    aspect: Ratio = None
    efficiency: Ratio = None

    def check(self: Any) -> None:
        """Raises TableError where axes or coefficients are not whole."""
        if parallel(self.chord, self.span):
            raise TableError("parallel to chord, expected another direction", "span")
        if self.aspect is None and self.lift_slope is None:
            raise TableError("required without `aspect`, but missing", "lift_slope")
        if self.efficiency is not None and (self.aspect is None or self.induced is not None):
            raise TableError("goes with `aspect` and without `induced`", "efficiency")


@dataclass(frozen=True)
class Fin(Declared):
    """A lifting surface; its velocity relative to the fluid has a, b, c along chord, span, normal = chord x span.

    name        a C identifier, different from the names of bodies, points and whatever else has a mount
    position    in the frame of its mount
    chord       forward, in the frame of its mount
    span        to one side: its part across the chord counts
    density     of the fluid; lift and drag are `density/2 area U^2` times `C_L` and `C_D`
    area        of the fin
    lift_slope  `C_L = lift_slope A`, per radian of the angle `A = atan2(c, a) + deflection`; required without `aspect`
    drag        `C_D = drag + induced C_L^2`
    induced     see `drag`; without it by `aspect`, or 0
    stall       angle beyond which `C_L` falls linearly, to zero at 90 deg and beyond: a fin astern has drag alone.
                Without it `C_L` grows on, and jumps where `atan2` does
    deflection  positive pushes against the normal, as `c > 0` does; may be set at run time
    speed       squares in `U^2`: `a^2 + c^2`; `"whole"` adds `b^2`, `"along"` is `a^2` alone
    incidence   `true`: drag acts against the velocity `(a, c)`, lift across it; `false`: `A` is the deflection alone,
                drag acts along `-chord`, astern too, lift along `-normal`, as published for rudders of small vehicles
    """

    name: Name
    position: Annotated[Length3, Default(ZERO3)]
    chord: Annotated[Direction, Default((1.0, 0.0, 0.0))]
    span: Annotated[Direction, Default((0.0, 1.0, 0.0))]
    density: Annotated[float, scalar(DENSITY, above=0.0)]
    area: Annotated[float, scalar(AREA, above=0.0)]
    lift_slope: Annotated[float, Coefficient, Default(None), TIMES]
    drag: Annotated[float, Coefficient, Default(0.0), TIMES]
    induced: Annotated[float, Coefficient, Default(None), TIMES]
    stall: Annotated[float | None, scalar(units.ANGLE, above=0.0, most=1.5), Default(None)]
    deflection: Annotated[
        float, scalar(units.ANGLE, least=-MOST_DEFLECTION, most=MOST_DEFLECTION), Default(0.0)
    ]  # fmt: skip
    speed: Annotated[
        Speed, one_word({word: word for word in SPEEDS}, '"along", "across" or "whole"'), Default("across")
    ]
    incidence: Annotated[Flag, Default(True)]

    keys: ClassVar[type[Table]] = FinTable

    @classmethod
    def of_table(cls, table: Table, **more: object) -> Self:
        """The fin; without `lift_slope` and `induced` those of its aspect ratio."""
        return super().of_table(table, lift_slope=_slope(table), induced=_induced_drag(table), **more)


def _slope(table: Any) -> float:
    """Slope of the lift: as given, or of a wing of low aspect ratio A, pi A/(1 + sqrt(1 + (A/2)^2)) (Beard, McLain)."""
    if table.lift_slope is not None:
        return table.lift_slope  # type: ignore[no-any-return]  # of the table
    slope: float = math.pi * table.aspect / (1.0 + hypot(1.0, table.aspect / 2.0))
    return slope


def _induced_drag(table: Any) -> float:
    """Induced drag: as given, else 1/(pi e A) with the efficiency e, 0.7 by default; 0 without aspect ratio."""
    if table.induced is not None:
        return table.induced  # type: ignore[no-any-return]  # of the table
    efficiency = 0.7 if table.efficiency is None else table.efficiency
    return 0.0 if table.aspect is None else 1.0 / (math.pi * efficiency * table.aspect)


@dataclass(frozen=True)
class Fins(BodyLaw):
    """All fins of a body, in the order of the file."""

    fins: tuple[Fin, ...]

    key: ClassVar[str] = "fin"
    name: ClassVar[str] = "fins"
    item: ClassVar[type[Declared]] = Fin
    mounted: ClassVar[bool] = True

    @property
    def nonlinear(self) -> bool:
        """True: lift is quadratic in the velocity."""
        return True

    @property
    def has_kinks(self) -> bool:
        """Whether stall bends the lift, or the flow from behind turns its sign."""
        return any(fin.incidence or fin.stall is not None for fin in self.fins)

    @property
    def inputs(self) -> dict[str, float]:
        """The deflections, rad."""
        return {f"{fin.name}.deflection": fin.deflection for fin in self.fins}

    @property
    def actuators(self) -> dict[str, Actuator]:
        """Fins by name."""
        return {fin.name: Actuator("deflection, rad", MOST_DEFLECTION, USUAL) for fin in self.fins}

    def actuated(self, deflections: Mapping[str, float]) -> Self:
        """The fins with other deflections, rad, by name."""
        return type(self)(
            tuple(replace(fin, deflection=deflections.get(fin.name, fin.deflection)) for fin in self.fins)
        )

    @classmethod
    def structure(cls, stand: Stand) -> dict[str, object]:
        """Body index, names and kinds of the fins of each body; nothing without, as other stands have it."""
        kinds = tuple(
            (i, tuple((fin.name, fin.incidence, fin.stall is not None) for fin in law.fins))
            for i, _, law in cls.of(stand)
        )
        return {"fins": kinds} if kinds else {}

    @classmethod
    def warnings(cls, stand: Stand) -> list[str]:
        """Fins whose lift grows without end with the angle of the flow."""
        fins: Sequence[Fin] = [fin for _, _, law in cls.of(stand) for fin in law.fins]
        names = [fin.name for fin in fins if fin.incidence and fin.stall is None and fin.lift_slope]
        if not names:
            return []
        more = f" (and {len(names) - 1} more)" if len(names) > 1 else ""
        return [
            f"fin {names[0]}{more}: without `stall` its lift grows with the angle of the flow up to 180 deg and jumps "
            "there: give it, such as 15 deg, where the flow may come from the side or from astern"
        ]

    @classmethod
    def random_on(cls, draw: Draw, body: Body) -> Self | None:
        """One or two fins; a flywheel has none. Those that feel the angle of the flow stall: else lift jumps astern."""
        if isinstance(body, Flywheel):
            return None
        return cls(tuple(_random_fin(draw, f"fin{k + 1}_{body.name}") for k in range(int(draw.rng.integers(1, 3)))))


def _random_fin(draw: Draw, name: str) -> Fin:
    rng = draw.rng
    incidence = bool(rng.random() < 0.7)
    stall = draw.uniform(0.2, 0.6) if incidence or rng.random() < 0.5 else None
    return Fin(
        name,
        draw.vec3(0.3),
        draw.vec3(1.0),
        draw.vec3(1.0),
        1000.0,
        draw.uniform(0.002, 0.03),
        draw.uniform(1.0, 5.0),
        draw.uniform(0.0, 0.1),
        draw.uniform(0.0, 0.3),
        stall,
        draw.uniform(-0.5, 0.5),
        SPEEDS[int(rng.integers(3))],
        incidence,
    )


LAW = Fins
