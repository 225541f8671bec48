"""Read the freedom of a design from a file (TOML) or a list of keys; all problems are found before any is reported."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from mahovik.core.motion.document import (
    NOT_NULL,
    choice,
    context_validator,
    document_of,
    positions,
    short_integer,
    text_of,
    whole_number,
)
from mahovik.core.stand.content import TABLE
from mahovik.core.stand.fields import Flag, Table, refuse, scalar, validator, vector
from mahovik.core.stand.model import Stand
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import (
    ANGLE,
    LENGTH,
    MASS,
    PLAIN,
    STATIC_UNBALANCE,
    Dimension,
    QuantityError,
    number,
    show,
)
from mahovik.errors import DesignError
from mahovik.nearest import suggestion
from mahovik.use.design.freedom import MIRRORS, PARTS, WIDTH, Freedom, Key, Limits, Tie, Weights
from mahovik.use.design.space import flywheel_numbers, nearest_two

CHOICES = ("phase", "speed", "number")
DIMENSIONS: dict[Key, Dimension] = {
    "position": LENGTH,
    "angles": ANGLE,
    "unbalance": STATIC_UNBALANCE,
    "unbalance_at": ANGLE,
    "mass": MASS,
    "inertia": PLAIN,
}
MOST_FLYWHEELS, MOST_HARMONICS, FASTEST = 24, 8, 1000

Box = bool | tuple[tuple[float, ...], tuple[float, ...]]
"""Whether a key is free, with default bounds; or its bounds."""


def _box(key: Key) -> Any:
    """A validator of a `Box`."""
    width, dimension = PARTS[key].stop - PARTS[key].start, DIMENSIONS[key]

    def read_bound(raw: dict[str, Any], side: str) -> tuple[float, ...]:
        if side not in raw:
            raise refuse("required, but missing", side)
        try:
            return (number(raw[side], dimension),) if width == 1 else vector(raw[side], (width,), dimension)
        except QuantityError as error:
            raise refuse(str(error), side) from None

    def read(raw: Any) -> Box:
        if isinstance(raw, bool):
            return raw
        if not isinstance(raw, dict):
            raise QuantityError(f"expected true, false or {{ min = .., max = .. }}, found {show(raw)}")
        for name in raw:
            if name not in ("min", "max"):
                raise QuantityError(f"unknown key {show(name)}{suggestion(name, ('min', 'max'))}")
        low, high = read_bound(raw, "min"), read_bound(raw, "max")
        for a, b in zip(low, high, strict=True):
            if a > b:
                raise QuantityError(f"min {a:g} is above max {b:g} {dimension.si}".rstrip())
        if key in ("unbalance", "mass", "inertia") and low[0] < 0.0:
            raise QuantityError(f"min {low[0]:g} is negative")
        if key in ("mass", "inertia") and low[0] == 0.0:
            raise QuantityError("min 0: expected a minimum above 0")
        return low, high

    return validator(read)


def _same(raw: Any) -> tuple[Key, ...]:
    if not isinstance(raw, list):
        raise QuantityError(f"expected a list, found {show(raw)}")
    for key in raw:
        if key not in PARTS:
            raise QuantityError(f"unknown key {show(key)}{suggestion(str(key), PARTS)}")
    return tuple(key for key in PARTS if key in raw)


def _speeds(raw: Any) -> tuple[int, ...] | None:
    if isinstance(raw, bool):
        return (-2, -1, 0, 1, 2) if raw else None
    if not isinstance(raw, list) or not raw:
        raise QuantityError(f"expected turns per period to choose from, as [-1, 1], found {show(raw)}")
    for turns in raw:
        if abs(short_integer(turns)) > FASTEST:
            raise QuantityError(f"expected at most {FASTEST} turns per period, found {turns}")
    return tuple(sorted(set(raw)))


def _number(raw: Any, context: dict[str, Any]) -> tuple[int, int]:
    N = len(context["names"])
    if isinstance(raw, bool):
        return (1, N) if raw else (N, N)
    if not isinstance(raw, list) or len(raw) != 2:
        raise QuantityError(f"expected least and most, as [2, 4], found {show(raw)}")
    least, most = map(short_integer, raw)
    if not 1 <= least <= MOST_FLYWHEELS or not 1 <= most <= MOST_FLYWHEELS:
        raise QuantityError(f"expected 1 to {MOST_FLYWHEELS} flywheels, found {least}, {most}")
    if least > most:
        raise QuantityError(f"least {least} is above most {most}")
    if most > N:
        raise QuantityError(f"{most} flywheels, but the stand has {N}: copy one of its tables for each new one")
    return least, most


Flywheels = Annotated[tuple[int, ...], context_validator(lambda raw, context: positions(raw, context["names"]))]
Mass = Annotated[float | None, scalar(MASS, least=0.0)]
Weight = Annotated[float, scalar(PLAIN, least=0.0)]


class FreeTable(Table):
    """One `[[free]]`: what is free of some flywheels, or of all."""

    flywheels: Flywheels | None = None
    position: Annotated[Box, _box("position")] = False
    angles: Annotated[Box, _box("angles")] = False
    unbalance: Annotated[Box, _box("unbalance")] = False
    unbalance_at: Annotated[Box, _box("unbalance_at")] = False
    mass: Annotated[Box, _box("mass")] = False
    inertia: Annotated[Box, _box("inertia")] = False


class GroupTable(Table):
    """One `[[group]]` of flywheels that are tied."""

    flywheels: Flywheels
    same: Annotated[tuple[Key, ...], validator(_same)] = ()
    mirror: Annotated[str | None, choice(*MIRRORS)] = None


class LimitsTable(Table):
    """`[limits]` of the whole stand."""

    distance: Annotated[float | None, scalar(LENGTH, least=0.0)] = None
    total_mass: Mass = None
    total_unbalance: Annotated[float | None, scalar(STATIC_UNBALANCE, least=0.0)] = None


class CostTable(Table):
    """`[cost]`: weights."""

    unbalance: Weight = 0.0
    torque: Weight = 0.0


class FreedomTable(Table):
    """A freedom file."""

    number: Annotated[tuple[int, int] | None, context_validator(_number)] = None
    phase: Flag = False
    speed: Annotated[tuple[int, ...] | None, validator(_speeds)] = None
    harmonics: Annotated[int, whole_number(0, MOST_HARMONICS)] = 3
    quality: Annotated[float, scalar(PLAIN, above=0.0, most=0.1)] = 1e-3
    free: list[FreeTable] = Field(default_factory=list)
    group: list[GroupTable] = Field(default_factory=list)
    limits: Annotated[LimitsTable | None, NOT_NULL] = None
    cost: Annotated[CostTable | None, NOT_NULL] = None


def load_freedom(path: str | Path, stand: Stand) -> Freedom:
    """Read and check the file at `path` for `stand`. Raises DesignError with every problem."""
    path = Path(path)
    return read_freedom(text_of(path, TABLE, DesignError), stand, path.name)


def read_freedom(text: str, stand: Stand, source: str = "free") -> Freedom:
    """Read and check a freedom given as text; `source` names it in messages. Raises DesignError."""
    return _freedom(document_of(text, source, DesignError, is_json=False), stand, Problems(source))


def freedom_of_keys(keys: str, stand: Stand) -> Freedom:
    """Freedom of all flywheels from `--free position,unbalance`, with default bounds. Raises DesignError."""
    known = (*PARTS, *CHOICES)
    names = [key.strip() for key in keys.split(",")]
    problems = Problems(f"--free {keys}")
    for name in names:
        if name not in known:
            problems.add(f"unknown key {show(name)}{suggestion(name, known)} The name of a freedom file ends in .toml")
    document: dict[str, Any] = {name: True for name in names if name in CHOICES}
    free = {name: True for name in names if name in PARTS}
    return _freedom(document | ({"free": [free]} if free else {}), stand, problems)


def _freedom(document: dict[str, Any], stand: Stand, problems: Problems) -> Freedom:
    """The freedom of a document. Raises DesignError with its problems, and those noted before."""
    if not stand.flywheels:
        problems.add(f"stand {stand.name} has no flywheels: there is nothing to design")
        raise DesignError(problems.lines)
    table = problems.valid(FreedomTable, document, names=[s.name for s in stand.flywheels])
    if table is None or problems.lines:
        raise DesignError(problems.lines)
    N = len(stand.flywheels)
    numbers = table.number or (N, N)
    bounds = _Bounds(stand, problems)
    for i, each in enumerate(table.free):
        bounds.free_by(f"free[{i}]", each)
    choosing = table.phase or table.speed is not None or table.number is not None
    if not bounds.free.any() and not choosing and not problems.lines:
        problems.add(f"nothing is free: free one of {', '.join((*PARTS, *CHOICES))}")
    ties = tuple(_ties(table.group, stand, problems))
    limits = bounds.limits(table.limits or LimitsTable(), numbers[0])
    weights = Weights(**dict(table.cost)) if table.cost is not None and table.cost.model_fields_set else Weights()
    if problems.lines:
        raise DesignError(problems.lines)
    return Freedom(
        bounds.least, bounds.most, bounds.free, ties, limits, weights,
        table.phase, table.speed, numbers, table.harmonics, table.quality,
    )  # fmt: skip


class _Bounds:
    """Bounds of the numbers of every flywheel, which the tables `free` widen one after another."""

    def __init__(self, stand: Stand, problems: Problems) -> None:
        self._stand, self._problems = stand, problems
        self._current = np.array([flywheel_numbers(s) for s in stand.flywheels]).reshape(-1, WIDTH)
        self.least, self.most = self._current.copy(), self._current.copy()
        self.free = np.zeros(self._current.shape, dtype=bool)

    def free_by(self, where: str, table: FreeTable) -> None:
        """Free what one table frees; what it cannot free is noted."""
        flywheels = list(range(len(self.free)) if table.flywheels is None else table.flywheels)
        for key in PARTS:
            box: Box = getattr(table, key)
            if box is False:
                continue
            if key == "unbalance" and any(self._stand.flywheels[s].mass <= 0.0 for s in flywheels):
                self._problems.add(where, key, "a flywheel without mass has no unbalance")
                continue
            least, most = self._default(key) if box is True else (np.array(side) for side in box)
            if box is True and not np.any(most > least):
                words = "all values in the stand are zero: give { min = .., max = .. } instead of true"
                self._problems.add(where, key, words)
                continue
            for s in flywheels:
                self.least[s, PARTS[key]] = least[s] if box is True else least
                self.most[s, PARTS[key]] = most[s] if box is True else most
                self.free[s, PARTS[key]] = True
        if table.unbalance is not False and "unbalance_at" not in table.model_fields_set:
            self.free_by(where, FreeTable.model_construct(flywheels=table.flywheels, unbalance_at=True))

    def _default(self, key: Key) -> tuple[Any, Any]:
        """Default bounds of all flywheels, for a key that is just `true`."""
        now = self._current[:, PARTS[key]]
        if key in ("angles", "unbalance_at"):
            return np.full_like(now, -math.inf), np.full_like(now, math.inf)
        if key == "position":
            far = float(np.abs(now).max())
            return np.full_like(now, -far), np.full_like(now, far)
        if key == "unbalance":
            return np.zeros_like(now), np.full_like(now, 2.0 * float(now.max()))
        return 0.5 * now, 2.0 * now

    def limits(self, table: LimitsTable, flywheels: int) -> Limits:
        """Limits of the whole stand with at least this many flywheels; limits below the bounds are noted.

        Without a limit, flywheels whose positions are free stay apart by half the least distance in the given stand.
        """
        for key, limit, unit, k in (
            ("total_mass", table.total_mass, "kg", PARTS["mass"].start),
            ("total_unbalance", table.total_unbalance, "kg m", PARTS["unbalance"].start),
        ):
            least = float(self.least[:flywheels, k].sum())
            if limit is not None and limit < least * (1.0 - 1e-12):
                self._problems.add("limits", key, f"{limit:g} {unit} is below the sum of the least, {least:g}")
        distance = table.distance
        if distance is None and self.free[:, PARTS["position"]].any():
            now = nearest_two(self._stand)
            distance = None if now is None else 0.5 * now[0]
        return Limits(distance or None, table.total_mass, table.total_unbalance)


def _ties(groups: list[GroupTable], stand: Stand, problems: Problems) -> Iterator[Tie]:
    for i, group in enumerate(groups):
        where, flywheels, mirror = f"group[{i}]", group.flywheels, group.mirror
        if mirror is not None and len(flywheels) != 2:
            problems.add(where, "mirror", f"needs two flywheels, found {len(flywheels)}")
        elif mirror is not None and {"position", "angles"} & set(group.same):
            problems.add(where, "mirror", "contradicts `same` about position and angles")
        elif len(flywheels) < 2:
            problems.add(where, "flywheels", f"a group needs two or more flywheels, found {len(flywheels)}")
        elif mirror is None and not group.same:
            problems.add(where, "nothing is tied: expected `same`, `mirror` or both")
        elif len({stand.flywheels[s].mount for s in flywheels}) > 1:
            problems.add(where, "flywheels", "all flywheels of a group need the same mount")
        else:
            yield Tie(flywheels, group.same, mirror)
