"""`cross_flow` of a body in the stand file: drag of a slender body, strip by strip along its first axis."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Self

from mahovik.core.stand import units
from mahovik.core.stand.declare import TIMES_EACH, Draw
from mahovik.core.stand.fields import Flag, integer, require_bounds, scalar, validator, vector
from mahovik.core.stand.law import BodyLaw
from mahovik.core.stand.model import Body, Stand
from mahovik.core.stand.tables import Default, Table, TableError
from mahovik.core.stand.units import Dimension, QuantityError

DENSITY = Dimension("a density", "kg/m^3")
MOST_POINTS = 16
"""Points between two stations."""

Numbers = tuple[float, ...]


def _numbers(raw: object, dimension: Dimension) -> Numbers:
    """A list of two numbers or more."""
    values = raw.get("value") if isinstance(raw, dict) else raw
    return vector(raw, (max(2, len(values) if isinstance(values, list) else 0),), dimension)


def _sizes(raw: object, dimension: Dimension) -> Numbers:
    numbers = _numbers(raw, dimension)
    for size in numbers:
        require_bounds(size, dimension.si, 0.0)
    return numbers


def _drags(raw: object) -> Numbers:
    """One number for all stations, or a list."""
    return _sizes(raw if isinstance(raw, list) else [raw, raw], units.PLAIN)


def _points(raw: object) -> int:
    points = integer(raw)
    if not 1 <= points <= MOST_POINTS:
        raise QuantityError(f"expected 1 to {MOST_POINTS} points between two stations, found {points}")
    return points


Places = Annotated[Numbers, validator(lambda raw: _numbers(raw, units.LENGTH), units.LENGTH)]
Lengths = Annotated[Numbers, validator(lambda raw: _sizes(raw, units.LENGTH), units.LENGTH)]
Drags = Annotated[Numbers, validator(_drags, units.PLAIN, shape="number or numbers"), TIMES_EACH]


class Stations(Table):
    """What the lists of one body tell together."""

    def check(self: Any) -> None:
        """Raises TableError unless stations rise, and every table has one number for each station."""
        if any(b <= a for a, b in pairwise(self.x)):
            raise TableError("expected stations that rise", "x")
        n = len(self.x)
        for key in ("height", "breadth", "drag_y", "drag_z"):
            values = getattr(self, key)
            if key.startswith("drag") and len(values) == 2 and values[0] == values[1]:
                setattr(self, key, values[:1] * n)
            elif len(values) != n:
                raise TableError(f"expected {n} numbers, one for each station of `x`, found {len(values)}", key)


@dataclass(frozen=True)
class CrossFlow(BodyLaw):
    """Drag of the motion across the first axis of a body: -(density/2) integral (C_y h |v| v, C_z b |w| w) dx.

    v, w is the velocity of the place x of the axis relative to the fluid, along y and z of the body.

    density   of the fluid
    x         stations along the first axis, rising; between them all tables are linear
    height    `h` along z, which meets `v`, at each station
    breadth   `b` along y, which meets `w`, at each station
    drag_y    `C_y`, one for all stations or one for each
    drag_z    `C_z`, likewise
    points    points of Gauss and Legendre between two stations, 1 to 16
    together  `true`: the drag is along the whole velocity across, `(C_y h v^2 + C_z b w^2) (v, w)/sqrt(v^2 + w^2)`
    """

    density: Annotated[float, scalar(DENSITY, above=0.0)]
    x: Places
    height: Lengths
    breadth: Lengths
    drag_y: Drags
    drag_z: Drags
    points: Annotated[int, validator(_points), Default(2)]
    together: Annotated[Flag, Default(False)]

    key: ClassVar[str] = "cross_flow"
    name: ClassVar[str] = "cross-flow drag"
    keys: ClassVar[type[Table]] = Stations

    @property
    def nonlinear(self) -> bool:
        """True: it is quadratic."""
        return True

    @property
    def has_kinks(self) -> bool:
        """True: it depends on magnitudes."""
        return True

    @property
    def acts(self) -> bool:
        """Whether it drags along y or along z."""
        return (any(self.height) and any(self.drag_y)) or (any(self.breadth) and any(self.drag_z))

    @classmethod
    def structure(cls, stand: Stand) -> dict[str, object]:
        """Body index, number of strips and kind of each cross-flow drag; nothing without, as other stands have it."""
        result = tuple((i, law.points * (len(law.x) - 1), law.together) for i, _, law in cls.of(stand))
        return {"cross_flow": result} if result else {}

    @classmethod
    def random_on(cls, draw: Draw, body: Body) -> Self | None:
        """Two or three pieces of a slender body of any kind, 0.4 m long or so."""
        rng = draw.rng
        n = int(rng.integers(3, 5))
        x = tuple(sorted(float(x) for x in rng.uniform(-0.3, 0.3, n)))

        def table(most: float) -> Numbers:
            return tuple(float(size) for size in rng.uniform(0.1 * most, most, n))

        height, breadth, drag_y, drag_z = table(0.3), table(0.3), table(1.2), table(1.2)
        points, together = int(rng.integers(1, 4)), bool(rng.random() < 0.5)
        return cls(100.0 * body.mass, x, height, breadth, drag_y, drag_z, points, together)


LAW = CrossFlow
