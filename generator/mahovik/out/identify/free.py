"""Free numbers of a stand: paths that are estimated, and the numbers theta by which they are.

The amount and angle of an unbalance are estimated as its parts along the flywheel's second and third axes, in which
the motion is nearly linear and which have no singular point.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import tomlkit

from mahovik.core.stand.fields import Text
from mahovik.core.stand.files import TABLE, document_of, text_of
from mahovik.core.stand.masses import inertia_about_origin
from mahovik.core.stand.numbers import StandNumber, StandNumbers, exact, ways_of
from mahovik.core.stand.stand_file import dumps
from mahovik.core.stand.tables import NOTHING, Problems, Table, TableError
from mahovik.core.stand.units import TIME, Dimension, QuantityError, factor, number
from mahovik.errors import DataError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.model import build
from mahovik.out.api.stands import Stand
from mahovik.out.api.tables import Tables
from mahovik.use.measured.headers import sensors
from mahovik.use.numeric.se3 import Array

SHARE = 0.02
"""Share of a moment of inertia that an unbalance or product may be which is zero in the file; for scaling."""

SMALL_LENGTH, SMALL_ANGLE, SMALL_DELAY = 0.01, 0.02, 1e-3
"""Sizes of places (m) and directions (rad) that are zero in the file, and of delays of sensors (s)."""

UNBALANCE = ("static", "static_at", "dynamic", "dynamic_at")

_LENGTHS = ("position", "pivot", "center_of_mass", "ground", "carrier", "center")


class FreeFile(Table):
    """Keys of FREE.toml: paths that are free, and known delays of sensors by their point, s or texts with a unit."""

    free: Sequence[Text]
    delay: Mapping[str, Any] = NOTHING

    def check(self) -> None:
        """Raises TableError where nothing is free."""
        if not self.free:
            raise TableError("expected at least one", "free")


class Free:
    """Free numbers of a stand; in theta the delays of sensors come after the numbers of the stand.

    numbers  of the stand file; paths: names of all results
    scale    natural size of each theta: that of the file, or where this is zero what a real stand may have
    delayed  points whose delay is free; known: delays of points that are given, s
    """

    def __init__(self, stand: Stand, paths: Sequence[str], known: Mapping[str, float] | None = None) -> None:
        """`paths`: as `StandNumbers.find` takes them; also `NAME.unbalance`, all of it, and `POINT.delay`."""
        self.known = dict(known or {})
        points = sensors(stand)
        free_delays = [path.removesuffix(".delay") for path in paths if path.endswith(".delay")]
        for name in (*self.known, *free_delays):
            if name not in points:
                raise UsageError(
                    f"{name}.delay: {stand.name} has no such point or instrument{suggestion(name, points)}"
                )
        self.delayed = tuple(dict.fromkeys(free_delays))
        of_file = StandNumbers(stand, stand.to_dict())
        chosen: dict[str, StandNumber] = {}
        for path in (path for path in paths if not path.endswith(".delay")):
            whole = [f"{path}.{key}" for key in UNBALANCE] if path.endswith(".unbalance") else [path]
            chosen |= {place.path: place for pattern in whole for place in of_file.find(pattern)}
        if not chosen and not self.delayed:
            raise UsageError("free: expected at least one path, such as w*.unbalance")
        self.numbers = tuple(chosen.values())
        self.paths = (*chosen, *(f"{name}.delay" for name in self.delayed))
        self.units = (*(place.dimension.si or "1" for place in self.numbers), *(TIME.si for _ in self.delayed))
        self._pairs = [
            (self.paths.index(path), self.paths.index(f"{path}_at"))
            for path in chosen
            if ".unbalance." in path and f"{path}_at" in chosen
        ]
        self.stand = Stand.from_dict(of_file.written_out(self.numbers), stand.name)
        self._model = build(self.stand)
        self.nominal = self._theta(np.array([*(place.value for place in self.numbers), *(0.0 for _ in self.delayed)]))
        self.scale = np.array([*(_scale(x, stand) for x in self.numbers), *(SMALL_DELAY for _ in self.delayed)])
        for amount, angle in self._pairs:
            self.scale[angle] = self.scale[amount]

    @property
    def size(self) -> int:
        """How many numbers of the stand, without delays."""
        return len(self.numbers)

    def delays(self, theta: Array) -> dict[str, float]:
        """Delays of points (s): the known ones, and those of theta in addition."""
        free = dict(zip(self.delayed, theta[self.size :].tolist(), strict=True))
        return {name: self.known.get(name, 0.0) + free.get(name, 0.0) for name in {**self.known, **free}}

    def _theta(self, values: Array) -> Array:
        theta = values.copy()
        for amount, angle in self._pairs:
            theta[amount], theta[angle] = (values[amount] * f(values[angle]) for f in (math.cos, math.sin))
        return theta

    def values(self, theta: Array) -> Array:
        """Values of all paths (k, ...) from theta (k, ...)."""
        values = theta.copy()
        for amount, angle in self._pairs:
            values[amount] = np.hypot(theta[amount], theta[angle])
            values[angle] = np.arctan2(theta[angle], theta[amount])
        return values

    def slopes(self, theta: Array) -> Array:
        """d values / d theta (k, k); NaN for the parts of no unbalance."""
        slopes = np.eye(len(theta))
        for amount, angle in self._pairs:
            c, s = theta[amount], theta[angle]
            r = math.hypot(c, s)
            block = np.array([[c / r, s / r], [-s / r**2, c / r**2]]) if r else np.full((2, 2), math.nan)
            slopes[np.ix_((amount, angle), (amount, angle))] = block
        return slopes

    def tables(self, theta: Array) -> Tables:
        """Tables of the stands with n thetas (k, n). Raises StandError: a stand cannot be."""
        values = np.ascontiguousarray(self.values(theta)[: self.size])
        changes = {place.path: row for place, row in zip(self.numbers, values, strict=True)}
        return self._model.tables(changes, theta.shape[1])


def _scale(place: StandNumber, stand: Stand) -> float:
    """Natural size of a number of the stand."""
    body = next((candidate for candidate in stand.bodies if candidate.name == place.body), None)
    least = SHARE
    if ".unbalance." in place.path and body is not None and not place.key.endswith("_at"):
        spin = float(inertia_about_origin(body)[0, 0])
        least = SHARE * (math.sqrt(spin * body.mass) if place.key == "static" else spin)
    elif place.key == "inertia" and body is not None:
        least = SHARE * float(np.trace(inertia_about_origin(body)))
    elif place.key in _LENGTHS:
        least = SMALL_LENGTH
    elif place.key == "angles" or place.key.endswith("_at"):
        least = SMALL_ANGLE
    else:
        return abs(place.value) or SHARE
    return max(abs(place.value), least)


def read_free(free: str | Sequence[str] | Mapping[str, Any]) -> tuple[tuple[str, ...], dict[str, float]]:
    """Paths, and known delays of sensors (s): of texts separated by commas, of a file that ends in .toml, or its keys.

    Raises DataError.
    """
    if isinstance(free, str) and not free.endswith(".toml"):
        return tuple(path.strip() for path in free.split(",") if path.strip()), {}
    if not isinstance(free, str | Mapping):
        return tuple(free), {}
    problems, delays = Problems(free if isinstance(free, str) else "free"), dict[str, float]()
    document: Mapping[str, Any] = exact(free)
    if isinstance(free, str):
        document = document_of(
            text_of(Path(free), "a list of free numbers", TABLE, DataError), free, DataError, is_json=False
        )
    table = problems.valid(FreeFile, document)
    for point, value in ({} if table is None else table.delay).items():
        try:
            delays[point] = number(value, TIME)
        except QuantityError as error:
            problems.add(f"delay.{point}: {error}")
    if table is None or problems.lines:
        raise DataError(problems.lines)
    return tuple(table.free), delays


_NUMBER = re.compile(r"\s*[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s*")


def with_numbers(text: str, new: Stand, numbers: Sequence[StandNumber]) -> str:
    """The text of a stand file in which these numbers are those of `new`, in the units of the file.

    A flywheel that its file gives by centre of mass and inertia takes another unbalance as these, in SI.
    """
    document: Any = tomlkit.parse(text)
    target = new.to_dict()
    for leaf in numbers:
        for way in ways_of(target, leaf.path):
            key, rest = str(way[0]), list(way[1:])
            wheel = document[key][rest[0]] if "unbalance" in rest else {}
            if "inertia" in wheel or "center_of_mass" in wheel:
                for name in ("center_of_mass", "inertia", "inertia_about"):
                    wheel[name] = _plain(target[key][rest[0]][name])
            else:
                _put(document, key, target[key], rest, leaf.dimension)
    return tomlkit.dumps(document)


def stand_text(source: Any, stand: Stand, new: Stand, paths: Sequence[str]) -> str:
    """The text of the stand's file with the numbers of `new` under paths; of a stand without file one in SI."""
    if not isinstance(source, str | Path):
        return dumps(new)
    numbers = StandNumbers(stand, stand.to_dict())
    text = Path(source).read_text(encoding="utf-8-sig")
    return with_numbers(text, new, [number for path in paths for number in numbers.find(path)])


def _put(place: Any, key: Any, value: Any, rest: list[Any], dimension: Dimension, unit: str | None = None) -> None:
    """Set in `place[key]`, whose numbers have a unit or their own, what is at the steps `rest` in `value`, SI."""
    old = place[key] if not isinstance(place, dict) or key in place else None
    scale = float(factor(unit, dimension)) if unit else 1.0
    if isinstance(old, dict) and old.keys() == {"value", "unit"}:
        _put(old, "value", value, rest, dimension, str(old["unit"]))
    elif not rest and old is not None and not isinstance(old, list):
        suffix = _NUMBER.sub("", str(old), count=1) if isinstance(old, str) else ""
        if not (suffix or unit):
            place[key] = float(value)
            return
        shown = float(value) / (float(factor(suffix, dimension)) if suffix else scale)
        digits = [f"{shown:.{count}g}" for count in (15, 16, 17)]  # the fewest that are read as the same number
        one = next((x for x in digits if number(f"{x} {suffix or unit}", dimension) == float(value)), digits[-1])
        place[key] = f"{one} {suffix}" if suffix else float(one)
    elif isinstance(old, dict) or (isinstance(old, list) and _shape(old) == _shape(value)):
        _put(old, rest[0], value[rest[0]], rest[1:], dimension, unit)
    elif isinstance(old, list) and len(rest) == 2 and _is_diagonal(value):
        _put(old, rest[0], value[rest[0]][rest[0]], [], dimension, unit)
    else:
        place[key] = _plain(value, scale)


def _is_diagonal(matrix: Any) -> bool:
    return not any(float(x) for i, row in enumerate(matrix) for k, x in enumerate(row) if i != k)


def _shape(value: Any) -> tuple[int, ...]:
    return (len(value), *_shape(value[0])) if isinstance(value, list) and value else ()


def _plain(value: Any, scale: float = 1.0) -> Any:
    if isinstance(value, list):
        return [_plain(element, scale) for element in value]
    if isinstance(value, dict):
        return {key: _plain(element) for key, element in value.items()}
    return value if isinstance(value, str) else float(value) / scale
