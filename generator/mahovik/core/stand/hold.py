"""`[hold]` of a stand file: how the carrier can move where it is not free, V = S u."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations
from operator import mul
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.declare import Declared, Note
from mahovik.core.stand.fields import ZERO3, Angle3, Direction, Length3, Vec3, Vec6, rows, validator, vector
from mahovik.core.stand.tables import Default, Table, keys_of
from mahovik.core.stand.units import PLAIN, QuantityError, show
from mahovik.nearest import suggestion

Array = NDArray[np.float64]

FreedomKind = Literal["turn", "slide", "twist"]

TWIST_LETTERS = ("u", "v", "w", "p", "q", "r")


@dataclass(frozen=True)
class Freedom:
    """One way in which a held carrier can move at speed u, in E1: `turn` about the pivot, `slide`, or a `twist` of O1.

    direction   of a turn or slide, of any length: u is in rad/s or m/s along its unit vector
    twist       of a twist: V at u = 1, as written
    """

    kind: FreedomKind
    direction: Vec3 = (0.0, 0.0, 0.0)
    twist: Vec6 = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


AXES: tuple[Vec3, Vec3, Vec3] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

FREEDOMS: dict[str, Freedom] = {
    **{name: Freedom("slide", AXES[k]) for k, name in enumerate("xyz")},
    **{name: Freedom("turn", AXES[k]) for k, name in enumerate(("roll", "pitch", "yaw"))},
}
"""Freedoms by their names in the file."""

TWIST_NAMES = tuple(FREEDOMS)
"""Directions of E1 of the six components of a twist."""

PLACE_OF_HOLD = ("pivot", "position", "angles")
"""Keys of a hold that say where it holds the carrier."""

_NAMES = {freedom: name for name, freedom in FREEDOMS.items()}

DEPENDENT = 1e-9
"""Sine of the angle of a column of S to those before it, below which it says nothing new; `physical` asks for more."""


def _freedoms(raw: Any) -> tuple[Freedom, ...]:
    if not isinstance(raw, list):
        raise QuantityError(f'expected a list of names such as ["yaw"], or [] for clamped, found {show(raw)}')
    for i, name in enumerate(raw):
        if not isinstance(name, str):
            raise QuantityError(f"[{i}]: expected one of {', '.join(FREEDOMS)}, found {show(name)}")
        if name not in FREEDOMS:
            raise QuantityError(f"[{i}]: unknown freedom {show(name)}{suggestion(name, FREEDOMS)}")
        if name in raw[:i]:
            raise QuantityError(f"{name} is given twice")
    return tuple(FREEDOMS[name] for name in raw)


def _basis(raw: Any) -> tuple[Freedom, ...]:
    if not isinstance(raw, list) or not raw:
        shown = "an empty list (freedoms = [] is clamped)" if isinstance(raw, list) else show(raw)
        raise QuantityError(f"expected rows of six numbers, u v w p q r at u = 1, found {shown}")

    def twist(row: Any) -> Freedom:
        a, b, c, d, e, f = vector(row, (6,), PLAIN)
        if not any((a, b, c, d, e, f)):
            raise QuantityError("a row of zeros is no motion")
        return Freedom("twist", twist=(a, b, c, d, e, f))

    return rows(raw, twist)


class HoldForm(Table):
    """Keys of `[hold]` that say how the carrier can move; a hold has one of them.

    freedoms  any of `x` `y` `z` (along) `roll` `pitch` `yaw` (about) the axes of `E1`, m/s and rad/s; `[]` is clamped
    axis      one freedom: turning about this axis through the pivot, rad/s
    slide     one freedom: along this direction, m/s
    basis     rows of `S^T`: the six components of `V` at `u = 1`, SI
    """

    freedoms: Annotated[tuple[Freedom, ...], validator(_freedoms, shape="list of names")] | None = None
    axis: Direction | None = None
    slide: Direction | None = None
    basis: Annotated[tuple[Freedom, ...], validator(_basis, shape="rows of 6 numbers")] | None = None


@dataclass(frozen=True)
class Hold(Declared):
    """What holds the carrier: it moves as V = S u, a column of S (6 x m) for each freedom, constant in E1.

    freedoms  m of them, independent; none: clamped
    pivot     in `E1`: what turns, turns about it; without it about `O1`
    position  home pose in `E0`: place of `O1` where all freedoms are zero
    angles    home attitude, in the sequence of the file
    """

    freedoms: tuple[Freedom, ...]
    pivot: Annotated[Length3, Default(None)]
    position: Annotated[Length3, Default(ZERO3)]
    angles: Annotated[Angle3, Default(ZERO3)]

    keys: ClassVar[type[Table]] = HoldForm

    @classmethod
    def read(cls, table: Any, note: Note) -> Hold | None:
        """The hold of a valid table; None where that is not in order, which is noted."""
        known = keys_of(HoldForm)
        ways = {key: way for key in known if (way := getattr(table, key)) is not None}
        if len(ways) != 1:
            one_of = ", ".join(known)
            note(f'found {" and ".join(ways) or "none"} of {one_of}, expected one, such as freedoms = ["yaw"]')
            return None
        ((key, way),) = ways.items()
        kinds: dict[str, FreedomKind] = {"axis": "turn", "slide": "slide"}
        freedoms = (Freedom(kinds[key], way),) if key in kinds else way
        if table.pivot is not None and all(freedom.kind != "turn" for freedom in freedoms):
            note("pivot", f"given together with {key}, where nothing turns about it: leave it out")
            return None
        hold = cls(freedoms, table.pivot or ZERO3, table.position, table.angles)
        row = _first_dependent(twists(hold)) if key == "basis" else None  # named freedoms are independent
        if row is not None:
            earlier = "row 0" if row == 1 else f"rows 0 to {row - 1}"
            note("basis", f"row {row} follows from {earlier}: rows must be independent, leave it out")
            return None
        return hold

    def as_keys(self) -> dict[str, Any]:
        """Its keys in a stand file, in SI; without a pivot that nothing turns about."""
        kinds = [freedom.kind for freedom in self.freedoms]
        result: dict[str, Any]
        if kinds and kinds[0] == "twist":
            result = {"basis": [freedom.twist for freedom in self.freedoms]}
        elif len(kinds) == 1 and self.freedoms[0] not in _NAMES:
            result = {"axis" if kinds[0] == "turn" else "slide": self.freedoms[0].direction}
        else:
            result = {"freedoms": [_NAMES[freedom] for freedom in self.freedoms]}
        if kinds and kinds[0] != "twist" and any(self.pivot):
            result["pivot"] = self.pivot
        return result | {"position": self.position, "angles": self.angles}


def kinds(hold: Hold) -> tuple[str, ...]:
    """Names of the freedoms in FREEDOMS; of those without a name their kinds."""
    return tuple(_NAMES.get(freedom, freedom.kind) for freedom in hold.freedoms)


def twists(hold: Hold | None) -> Array:
    """S (6 x m): the twists of O1 in E1 at u = 1; m/s and rad/s for one of u. Without hold S = E, 6 x 6."""
    if hold is None:
        return np.eye(6)
    return np.array(twist_columns(hold), dtype=np.float64).reshape(-1, 6).T


def twist_columns(hold: Hold) -> list[list[Any]]:
    """Columns of S, six numbers each; of many samples the pivot may have columns of numbers in place of numbers."""
    return [_twist(freedom, hold.pivot) for freedom in hold.freedoms]


def _twist(freedom: Freedom, pivot: Vec3) -> list[Any]:
    if freedom.kind == "twist":
        return list(freedom.twist)
    unit = _unit(freedom)
    return [*unit, 0.0, 0.0, 0.0] if freedom.kind == "slide" else [*_cross(pivot, unit), *unit]


def _unit(freedom: Freedom) -> list[float]:
    """Direction of length 1 of what slides or turns."""
    most = max(map(abs, freedom.direction))  # squares neither overflow nor vanish
    x, y, z = (component / most for component in freedom.direction)
    length = math.sqrt(x * x + y * y + z * z)  # the same bits on every machine
    return [x / length, y / length, z / length]


def _cross(a: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    """a x b (3), of numbers or of columns of numbers."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def wrenches(hold: Hold | None) -> Array:
    """W (6 x m), S^T W = E: wrench at O1 in E1 of a force 1 along each freedom, which has no power in the others.

    A force through the pivot of what slides, a moment of what turns, S (S^T S)^-1 of a basis, E without hold. By it
    u = W^T V.
    """
    if hold is None:
        return np.eye(6)
    return np.array(wrench_columns(hold), dtype=np.float64).reshape(-1, 6).T


def wrench_columns(hold: Hold) -> list[list[Any]]:
    """Columns of W, six numbers each, as `twist_columns` has those of S."""
    if any(freedom.kind == "twist" for freedom in hold.freedoms):
        columns: list[list[Any]] = _dual(twists(hold)).T.tolist()
        return columns
    result = []
    for freedom in hold.freedoms:
        twist = _twist(freedom, ZERO3)
        result.append([*twist[:3], *(a + b for a, b in zip(twist[3:], _cross(hold.pivot, twist[:3]), strict=True))])
    return result


def _dual(S: Array) -> Array:
    """S (S^T S)^-1 of independent columns, exact before it is rounded: the same bits on every machine."""
    columns = [[Fraction(x) for x in column] for column in S.T.tolist()]
    rows = [[*(sum(map(mul, a, b), Fraction(0)) for b in columns), *a] for a in columns]  # (S^T S | S^T), to be reduced
    for k in range(len(rows)):
        scaled = [x / rows[k][k] for x in rows[k]]
        rows = [
            scaled if i == k else [x - row[k] * y for x, y in zip(row, scaled, strict=True)]
            for i, row in enumerate(rows)
        ]
    return np.array([[float(x) for x in row[len(columns) :]] for row in rows], dtype=np.float64).reshape(-1, 6).T


def find_freedom(hold: Hold, name: str | None) -> int:
    """Place of the freedom that a table of the hold is about, by its name or its number, "1" for the first.

    Without a name it is the only one. Raises QuantityError.
    """
    names = freedom_names(hold)
    if not names:
        raise QuantityError("the hold is clamped: it has no freedom")
    if name is None and len(names) > 1:
        known = ", ".join(freedom_labels(hold))
        raise QuantityError(f"required where there are several freedoms, expected one of {known}")
    if name is None:
        return 0
    numbers = [str(k + 1) for k in range(len(names))]
    if name in numbers:
        return numbers.index(name)
    if name not in names:
        where = f"; {numbered}" if (numbered := numbers_in_words(hold)) else ""
        raise QuantityError(f"{show(name)} is no freedom of this hold{suggestion(name, names)}{where}")
    return names.index(name)


def coordinate_problem(hold: Hold, freedom: int) -> str | None:
    """Why a freedom has no coordinate whose rate is its speed; None where it has one.

    The angle about an axis is one where nothing else turns, the way along a direction where nothing turns it.
    """
    wanted = hold.freedoms[freedom]
    turns = [turn for turn in hold.freedoms if turn.kind == "turn"]
    if wanted.kind == "twist":
        return "a freedom of a basis has no coordinate"
    if wanted.kind == "turn" and len(turns) > 1:
        return "where several freedoms turn, none has an angle of its own"
    if wanted.kind == "slide" and any(turn.direction != wanted.direction for turn in turns):
        return "where another freedom turns its direction, what slides has no coordinate of its own"
    return None


def _arms(S: Array) -> list[float]:
    """Distances (m) from O1 at which what a column turns moves as fast as O1; at least one."""
    turning = np.linalg.norm(S[3:], axis=0)
    arms = np.linalg.norm(S[:3], axis=0)[turning > 0] / turning[turning > 0]
    return [float(arm) for arm in arms if arm > 1e-9] or [1e-9]


def _scale(S: Array, arm: float) -> Array:
    """S with lengths divided by an arm, columns of length 1."""
    scaled = S / np.array([[arm]] * 3 + [[1.0]] * 3)
    return np.asarray(scaled / np.linalg.norm(scaled, axis=0))


def _first_dependent(S: Array) -> int | None:
    """Number of the first column that those before it give, by whatever arm; None where all are independent."""
    tried = [_scale(S, arm) for arm in _arms(S)]
    for k in range(1, S.shape[1]):
        if all(_distance(scaled[:, k], scaled[:, :k]) < DEPENDENT for scaled in tried):
            return k
    return None


def _distance(vector_: Array, columns: Array) -> float:
    """Distance of a vector (6) from the span of columns."""
    share, *_ = np.linalg.lstsq(columns, vector_, rcond=None)
    return float(np.linalg.norm(vector_ - columns @ share))


def is_closed(hold: Hold) -> bool:
    """Whether the twists are closed: the bracket of any two is one of them, so that poses have m coordinates.

    The bracket of (v, omega) and (v', omega') is (omega x v' + v x omega', omega x omega').
    """
    S = twists(replace(hold, pivot=ZERO3))  # wherever the pivot is
    S = _scale(S, max(_arms(S)))
    for i in range(S.shape[1]):
        for j in range(i):
            v, omega, v2, omega2 = S[:3, i], S[3:, i], S[:3, j], S[3:, j]
            bracket = np.concatenate([np.cross(omega, v2) + np.cross(v, omega2), np.cross(omega, omega2)])
            if _distance(bracket, S) > DEPENDENT:
                return False
    return True


def closing_words(hold: Hold) -> str:
    """What makes a set of freedoms closed, "expected also x": the fewest freedoms along and about the axes of E1."""
    for count in range(1, len(FREEDOMS)):
        for names in combinations(FREEDOMS, count):
            more = [FREEDOMS[name] for name in names if FREEDOMS[name] not in hold.freedoms]
            if len(more) == count and is_closed(replace(hold, freedoms=(*hold.freedoms, *more))):
                return f"expected also {', '.join(names)}"
    return "expected a closed set"


def has_coordinates(hold: Hold) -> bool:
    """Whether poses have coordinates of the freedoms: a closed set of named freedoms, or one turn or slide alone."""
    named = len(hold.freedoms) == 1 or all(freedom in _NAMES for freedom in hold.freedoms)
    plain = all(freedom.kind != "twist" for freedom in hold.freedoms)
    return bool(hold.freedoms) and named and plain and is_closed(hold)


def no_coordinates(hold: Hold) -> str:
    """Why a hold has no coordinates, in words."""
    if not hold.freedoms:
        return "the carrier is clamped"
    basis = any(freedom.kind == "twist" for freedom in hold.freedoms)
    return "a basis of [hold] has no coordinates" if basis else "the freedoms of [hold] have no coordinates"


def numbered_freedoms(hold: Hold) -> list[int]:
    """Freedoms with a number of their own among the coordinates: not the three turns about a point together."""
    turns = sum(freedom.kind == "turn" for freedom in hold.freedoms)
    return [k for k, freedom in enumerate(hold.freedoms) if freedom.kind != "turn" or turns == 1]


def carried_point(hold: Hold) -> tuple[Vec3, list[list[float]]]:
    """A point of E1, and the projector (3x3) to the directions in which a motion carries it, both in E1.

    Of a closed set it is the pivot, carried by what slides alone. Of other sets it is O1, which goes anywhere.
    """
    whole = [[float(i == j) for j in range(3)] for i in range(3)]
    if any(freedom.kind == "twist" for freedom in hold.freedoms) or not is_closed(hold):
        return (0.0, 0.0, 0.0), whole
    slides = [_unit(f) for f in hold.freedoms if f.kind == "slide"]
    return hold.pivot, [[sum(d[i] * d[j] for d in slides) for j in range(3)] for i in range(3)]


def words(hold: Hold) -> str:
    """How the carrier can move, in a line for people."""
    if not hold.freedoms:
        return "clamped: it does not move, and the reaction is what is asked for"
    count = len(hold.freedoms)
    if not is_closed(hold):
        closed = f"not a closed set, {closing_words(hold)}: poses have more coordinates than there are freedoms"
    elif has_coordinates(hold):
        closed = "a closed set: poses have as many coordinates"
    else:
        closed = (
            "a closed set: `rest`, `modes` and `plan` count along it from the home pose; as a basis it has no "
            "coordinates in `eval` and in the C"
        )
    return f"{count} freedom{'s' if count > 1 else ''}, {', '.join(freedom_words(hold))}; {closed}"


def freedom_names(hold: Hold) -> list[str]:
    """A name for each freedom: that of the file, such as `yaw`, or 1, 2, ... by its place."""
    return [_NAMES.get(freedom, str(k + 1)) for k, freedom in enumerate(hold.freedoms)]


def freedom_words(hold: Hold) -> list[str]:
    """Each freedom in words: its name, or how it moves, such as `turning about (0, 0.6, 0.8)`."""
    return list(map(_word, hold.freedoms))


def freedom_labels(hold: Hold) -> list[str]:
    """Each freedom by its name; one that is known by its place also in words: `1 (turning about (0, 0.6, 0.8))`."""
    pairs = zip(freedom_names(hold), freedom_words(hold), strict=True)
    return [name if name == what else f"{name} ({what})" for name, what in pairs]


def numbers_in_words(hold: Hold | None, prefix: str = "") -> str:
    """What freedoms are that go by their places: `1 is turning about (0, 0.6, 0.8)`; empty where all have names.

    `prefix` stands before each place, as in a column `q_1`.
    """
    if hold is None:
        return ""
    pairs = zip(freedom_names(hold), freedom_words(hold), strict=True)
    return ", ".join(f"{prefix}{name} is {what}" for name, what in pairs if name != what)


def _word(freedom: Freedom) -> str:
    if freedom in _NAMES:
        return _NAMES[freedom]
    if freedom.kind == "twist":
        moved = (f"{x:+g} {letter}" for x, letter in zip(freedom.twist, TWIST_LETTERS, strict=True) if x)
        return "twist " + " ".join(moved)
    axis = ", ".join(f"{x + 0.0:g}" for x in _unit(freedom))
    return f"turning about ({axis})" if freedom.kind == "turn" else f"sliding along ({axis})"


def twist_of(hold: Hold, u: Sequence[float]) -> Vec6:
    """V = S u (6), of a V_dot = S u_dot as well."""
    a, b, c, d, e, f = (twists(hold) @ np.array(u, dtype=np.float64)).tolist()
    return (a, b, c, d, e, f)
