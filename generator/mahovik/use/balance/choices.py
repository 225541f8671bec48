"""Corrections that can be made in a plane: sets of weights, holes, forbidden sectors, a split between screws."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mahovik.nearest import suggestion

KEYS = ("positions", "holes", "first", "amounts", "radii", "forbidden", "most", "each", "remove", "split")

Problem = tuple[str, str]

MANY = 2000
"""Most combinations of position, amount and radius in a plane."""


@dataclass(frozen=True)
class Piece:
    """One weight or hole: its angle (deg), amount and radius; `value`: amount times radius, negative for a hole."""

    degrees: float
    amount: float
    radius: float
    value: float


@dataclass(frozen=True)
class Choice:
    """Pieces of a plane.

    positions  groups of pieces at one angle
    each       most pieces at one angle; most: in the plane, None: any number
    split      whether the amounts are any numbers up to the largest, as of two screws that are filed
    """

    positions: tuple[tuple[Piece, ...], ...]
    each: int = 1
    most: int | None = None
    split: bool = False


def read_choices(given: object, N: int) -> tuple[tuple[Choice | None, ...], list[Problem]]:
    """Choices of N planes from an object for all planes, or a list of objects; null leaves a plane free."""
    if given is None:
        return (), []
    values = given if isinstance(given, list | tuple) else [given] * N
    if len(values) != N:
        return (), [("pieces", f"a list of {len(values)}, but the number of planes is {N}")]
    problems: list[Problem] = []
    found = []
    for k, each in enumerate(values):
        where = f"pieces[{k}]" if isinstance(given, list | tuple) else "pieces"
        try:
            found.append(None if each is None else _read(where, each))
        except _ChoiceError as bad:
            if bad.problem not in problems:
                problems.append(bad.problem)
    return tuple(found), problems


class _ChoiceError(Exception):
    """A problem of a plane."""

    def __init__(self, key: str, words: str) -> None:
        self.problem = (key, words)
        super().__init__(words)


def _read(where: str, raw: object) -> Choice:
    if not isinstance(raw, Mapping):
        raise _ChoiceError(where, f"expected an object or null, found {json.dumps(raw, default=str)[:60]}")
    for key in raw:
        if key not in KEYS:
            raise _ChoiceError(f"{where}.{key}", f"unknown key{suggestion(str(key), KEYS)}")
    angles = _angles(where, raw)
    amounts = _numbers(where, "amounts", raw.get("amounts"), above=0.0)
    radii = _numbers(where, "radii", raw.get("radii", [1.0]), above=0.0)
    sign = -1.0 if _flag(where, "remove", raw) else 1.0
    if len(angles) * len(amounts) * len(radii) > MANY:
        raise _ChoiceError(
            where, f"{len(angles) * len(amounts) * len(radii)} combinations, at most {MANY}; give fewer amounts"
        )
    positions = tuple(tuple(Piece(angle, m, r, sign * m * r) for m in amounts for r in radii) for angle in angles)
    most = raw.get("most")
    return Choice(
        positions,
        _whole(where, "each", raw.get("each", 1)),
        None if most is None else _whole(where, "most", most),
        _flag(where, "split", raw),
    )


def _angles(where: str, raw: Mapping[str, Any]) -> tuple[float, ...]:
    """Angles of the positions outside forbidden sectors, deg."""
    if ("positions" in raw) == ("holes" in raw):
        raise _ChoiceError(where, 'expected "positions", a list of degrees, or "holes", a number of equal divisions')
    if "holes" in raw:
        count = _whole(where, "holes", raw["holes"])
        first = _numbers(where, "first", [raw.get("first", 0.0)])[0]
        angles = tuple(first + 360.0 * i / count for i in range(min(count, MANY)))
    else:
        angles = _numbers(where, "positions", raw["positions"])
    sectors = raw.get("forbidden", [])
    if not isinstance(sectors, list | tuple):
        raise _ChoiceError(f"{where}.forbidden", "expected a list of [from, to], deg")
    for i, sector in enumerate(sectors):
        ends = _numbers(where, f"forbidden[{i}]", sector)
        if len(ends) != 2:
            raise _ChoiceError(f"{where}.forbidden[{i}]", f"expected [from, to], deg, found {len(ends)} numbers")
        width = (ends[1] - ends[0]) % 360.0
        angles = tuple(each for each in angles if (each - ends[0]) % 360.0 > width)
    if not angles:
        raise _ChoiceError(f"{where}.forbidden", "leaves no position")
    return angles


def _numbers(where: str, key: str, values: object, above: float = -math.inf) -> tuple[float, ...]:
    if not isinstance(values, list | tuple) or not values:
        raise _ChoiceError(
            f"{where}.{key}", f"expected a list of numbers, found {json.dumps(values, default=str)[:60]}"
        )
    for each in values:
        if isinstance(each, bool) or not isinstance(each, int | float) or not above < each < math.inf:
            bound = "" if above == -math.inf else f" above {above:g}"
            raise _ChoiceError(f"{where}.{key}", f"expected numbers{bound}, found {json.dumps(each, default=str)[:60]}")
    return tuple(float(each) for each in values)


def _whole(where: str, key: str, value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < 1:
        raise _ChoiceError(
            f"{where}.{key}", f"expected a whole number above 0, found {json.dumps(value, default=str)[:60]}"
        )
    return value


def _flag(where: str, key: str, raw: Mapping[str, Any]) -> bool:
    value = raw.get(key, False)
    if not isinstance(value, bool):
        raise _ChoiceError(f"{where}.{key}", f"expected true or false, found {json.dumps(value, default=str)[:60]}")
    return value
