"""`[vary]` of a campaign file: the distribution of every number that varies."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mahovik.core.motion.document import any_list
from mahovik.core.stand.fields import text, vector
from mahovik.core.stand.numbers import StandNumber, StandNumbers
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import PLAIN, SPEED, Dimension, QuantityError, number, show
from mahovik.errors import FileError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.campaign.balance_grade import grade_of, permissible_unbalance
from mahovik.out.campaign.distributions import (
    Discrete,
    Distribution,
    Fixed,
    Lognormal,
    Normal,
    Scaled,
    Triangular,
    Truncated,
    Uniform,
)
from mahovik.out.campaign.draw import Parameter
from mahovik.use.vibration.csv_table import read_columns

KINDS = ("normal", "relative", "tolerance", "uniform", "triangular", "lognormal", "discrete", "table", "grade")
_OPTIONS: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(KINDS, ("least", "most", "group")),
    "discrete": ("weights", "group"),
    "table": ("column", "group"),
    "grade": ("speed", "share"),
}
"""Keys beside that of the kind."""

_MAGNITUDES = frozenset((
    "mass", "static", "dynamic", "displaced_mass", "spin_inertia", "transverse_inertia", "length",
))  # fmt: skip
"""Keys that no stand file takes below zero; unbounded distributions of them end there."""


@dataclass(frozen=True)
class Vary:
    """What `[vary]` says. `files`: tables that it takes values from."""

    parameters: tuple[Parameter, ...]
    files: tuple[Path, ...]


def read_vary(raw: Mapping[str, Any], numbers: StandNumbers, folder: Path, problems: Problems) -> Vary:
    """The numbers that vary; what cannot be read is noted. A plain path has precedence over a pattern."""
    found: dict[str, tuple[str, Parameter]] = {}
    files: list[Path] = []
    for pattern, entry in sorted(raw.items(), key=lambda item: "*" in item[0]):
        where = f"vary {show(pattern)}"
        reader = _Reader(numbers, folder, files)
        try:
            parameters = reader.parameters(pattern, entry)
        except (QuantityError, UsageError) as error:
            problems.add(where, str(error).removeprefix(f"{pattern}: "))
            continue
        for each in parameters:
            path = each.place.path
            if path not in found:
                found[path] = (pattern, each)
            elif "*" not in pattern or "*" in found[path][0]:
                problems.add(where, f"{path} varies twice, also by {show(found[path][0])}")
    for path, (pattern, _) in found.items():
        for other in _same_as(path):
            if other in found:
                problems.add(
                    f"vary {show(pattern)}", f"{path} and {other} are the same unbalance; expected one of them"
                )
    order = {pattern: i for i, pattern in enumerate(raw)}
    listed_ = sorted(found.values(), key=lambda item: order[item[0]])
    return Vary(tuple(parameter for _, parameter in listed_), tuple(files))


def _same_as(path: str) -> tuple[str, ...]:
    """Paths of unbalances that a centre of mass or a product of inertia of the same flywheel decides as well."""
    body, _, rest = path.partition(".")
    static, dynamic = ("center_of_mass[1]", "center_of_mass[2]"), ("inertia.J12", "inertia.J13")
    amounts = dict.fromkeys(static, "static") | dict.fromkeys(dynamic, "dynamic")
    amount = amounts.get(rest)
    return () if amount is None else (f"{body}.unbalance.{amount}", f"{body}.unbalance.{amount}_at")


class _Reader:
    """Reads one entry of `[vary]`."""

    def __init__(self, numbers: StandNumbers, folder: Path, files: list[Path]) -> None:
        self._numbers, self._folder, self._files = numbers, folder, files

    def parameters(self, pattern: str, raw: Any) -> list[Parameter]:
        """The numbers of a path or pattern with their distributions. Raises QuantityError, UsageError."""
        kind = _kind(raw)
        if kind == "grade":
            return self._graded_unbalance(pattern, raw)
        found = []
        for place in self._numbers.find(pattern):
            whole = self._whole(kind, raw, place)
            factor = None if isinstance(whole, Fixed) else place.path
            if kind == "table" and factor is not None:  # measured columns of one body belong together
                factor = f"{raw['table']} {place.body}"
            if "group" in raw and factor is not None:
                factor = f"group {_read_key('group', text, raw['group'])}"
            found.append(Parameter(place, _truncate(whole, raw, place), factor))
        return found

    def _whole(self, kind: str, raw: Mapping[str, Any], place: StandNumber) -> Distribution:
        try:
            return self._read(kind, raw, place)
        except QuantityError as error:
            element = str(error)
            raise QuantityError(f"{kind}{'' if element.startswith('[') else ': '}{element}") from None

    def _read(self, kind: str, raw: Mapping[str, Any], place: StandNumber) -> Distribution:
        given, dimension = raw[kind], place.dimension
        if kind == "normal":
            mean, sigma = vector(given, (2,), dimension)
            if mean < 0.0 and place.key in _MAGNITUDES:
                raise QuantityError(f"[0]: {mean:g} {dimension.si} is negative")
            return Normal(mean, _not_negative(sigma, dimension)) if sigma else Fixed(mean)
        if kind == "relative":
            share = _not_negative(number(given, PLAIN), PLAIN)
            if not place.value:
                raise QuantityError(f"{place.path} is zero in the stand file: expected tolerance or normal")
            return Normal(place.value, share * abs(place.value)) if share else Fixed(place.value)
        if kind == "tolerance":
            return _tolerance(given, place)
        if kind == "uniform":
            low, high = _rising(vector(given, (2,), dimension), dimension)
            return Uniform(low, high) if low < high else Fixed(low)
        if kind == "triangular":
            low, mode, high = _rising(vector(given, (3,), dimension), dimension)
            return Triangular(low, mode, high) if low < high else Fixed(low)
        if kind == "lognormal":
            return _lognormal(given, dimension)
        if kind == "discrete":
            values = vector(given, (len(_list(given)),), dimension)
            return _discrete(values, raw.get("weights"))
        return self._table(given, raw, place)

    def _table(self, given: Any, raw: Mapping[str, Any], place: StandNumber) -> Distribution:
        """A column of a CSV file: one of its rows, each as likely as the others."""
        path = self._folder / text(given)
        names = _columns_of(path)
        column = _read_key("column", text, raw["column"]) if "column" in raw else place.key
        if column not in names:
            raise QuantityError(f"{path.name} has no column {show(column)}{suggestion(column, names)}")
        needed = place.dimension

        def dimension_of(name: str) -> Dimension | None:
            return needed if name == column else Dimension("a text", "")

        try:
            others = [name for name in names if name != column]
            found = read_columns(path, dimension_of, (column,), names, others).numbers[column]
        except FileError as error:
            raise QuantityError(str(error).replace(str(path), path.name)) from None
        if path not in self._files:
            self._files.append(path)
        return Discrete(tuple(found.tolist()), (1.0,) * len(found))

    def _graded_unbalance(self, pattern: str, raw: Mapping[str, Any]) -> list[Parameter]:
        """Static unbalance that a balance grade permits, in a random direction."""
        grade = _read_key("grade", grade_of, raw["grade"])
        if "speed" not in raw:
            raise QuantityError("speed: required with grade, but missing")
        speed = _read_key("speed", lambda given: number(given, SPEED), raw["speed"])
        if speed == 0.0:
            raise QuantityError("speed: expected the highest speed in service, found 0")
        share = self._share(raw.get("share"))
        statics = self._numbers.find(f"{pattern}.static")
        angles = self._numbers.find(f"{pattern}.static_at")
        found = []
        for static, angle in zip(statics, angles, strict=True):
            most = permissible_unbalance(grade, speed, self._numbers.mass(static.body))
            scaled = Fixed(most) if share is None else Scaled(share, most)
            found.append(Parameter(static, scaled, None if share is None else static.path))
            found.append(Parameter(angle, Uniform(-math.pi, math.pi), angle.path))
        return found

    def _share(self, raw: Any) -> Distribution | None:
        """Distribution of the used share of what is permitted; None: all of it."""
        if raw is None:
            return None
        place = StandNumber("share", "", "share", PLAIN, 1.0)
        try:
            kind = _kind(raw)
            if kind in ("table", "grade", "relative", "tolerance"):
                raise QuantityError(f"{kind}: not allowed here")
            found = _truncate(self._whole(kind, raw, place), raw, place)
            if found.support[0] < 0.0:
                raise QuantityError("expected no negative shares")
        except QuantityError as error:
            raise QuantityError(f"share: {error}") from None
        return found


def _kind(raw: Any) -> str:
    """Name of the distribution that a table gives. Raises QuantityError."""
    if not isinstance(raw, Mapping):
        raise QuantityError(f'expected a table such as {{ normal = ["1 g", "0.1 g"] }}, found {show(raw)}')
    kinds = [key for key in raw if key in KINDS]
    known = [*KINDS, *_OPTIONS[kinds[0]]] if kinds else KINDS
    for key in raw:
        if key not in known:
            raise QuantityError(f"unknown key {show(key)}{suggestion(key, known)}")
    if len(kinds) != 1:
        found = " and ".join(kinds) or "none"
        raise QuantityError(f"expected one of {', '.join(KINDS)}, found {found}")
    return str(kinds[0])


def _read_key(key: str, read: Callable[[Any], Any], raw: Any) -> Any:
    """A value of a key, which messages name."""
    try:
        return read(raw)
    except QuantityError as error:
        raise QuantityError(f"{key}: {error}") from None


def _list(raw: Any) -> list[Any]:
    found = any_list(raw["value"] if isinstance(raw, dict) and "value" in raw else raw)
    if not found:
        raise QuantityError("expected at least one value, found an empty list")
    return found


def _not_negative(value: float, dimension: Dimension) -> float:
    if value < 0.0:
        raise QuantityError(f"{value:g} {dimension.si}".rstrip() + " is negative, expected a spread")
    return value


def _rising(values: Sequence[float], dimension: Dimension) -> Sequence[float]:
    for i in range(1, len(values)):
        if values[i] < values[i - 1]:
            raise QuantityError(f"{values[i]:g} is below {values[i - 1]:g} {dimension.si}".rstrip())
    return values


def _tolerance(given: Any, place: StandNumber) -> Distribution:
    """Uniform about the value of the stand file: `"0.05 mm"`, or `["-0.1 mm", "0.3 mm"]`."""
    if isinstance(given, list) or (isinstance(given, dict) and isinstance(given.get("value"), list)):
        low, high = _rising(vector(given, (2,), place.dimension), place.dimension)
    else:
        high = _not_negative(number(given, place.dimension), place.dimension)
        low = -high
    return Uniform(place.value + low, place.value + high) if low < high else Fixed(place.value + low)


def _lognormal(given: Any, dimension: Dimension) -> Distribution:
    pair = _list(given)
    if len(pair) != 2:
        raise QuantityError(f"expected the median and the standard deviation of the logarithm, found {len(pair)}")
    median = _read_key("[0]", lambda raw: number(raw, dimension), pair[0])
    if median <= 0.0:
        raise QuantityError(f"[0]: {median:g} {dimension.si}".rstrip() + " is not above 0")
    sigma = _not_negative(_read_key("[1]", lambda raw: number(raw, PLAIN), pair[1]), PLAIN)
    return Lognormal(median, sigma) if sigma else Fixed(median)


def _discrete(values: tuple[float, ...], raw: Any) -> Distribution:
    if raw is None:
        return Discrete(values, (1.0,) * len(values))
    weights = vector(raw, (len(values),), PLAIN)
    if min(weights) < 0.0 or max(weights) == 0.0:
        raise QuantityError("weights: expected numbers from 0, one of them above 0")
    return Discrete(values, weights)


def _truncate(whole: Distribution, raw: Mapping[str, Any], place: StandNumber) -> Distribution:
    """The distribution within `least` and `most`; magnitudes end at zero in any case."""
    low, high = -math.inf, math.inf
    if place.key in _MAGNITUDES and whole.support[0] == -math.inf:
        low = 0.0
    if "least" in raw:
        low = _read_key("least", lambda given: number(given, place.dimension), raw["least"])
    if "most" in raw:
        high = _read_key("most", lambda given: number(given, place.dimension), raw["most"])
    if low > high:
        raise QuantityError(f"least: {low:g} is above most, {high:g} {place.dimension.si}".rstrip())
    if low <= whole.support[0] and high >= whole.support[1]:
        return whole
    found = Truncated(whole, low, high)
    if isinstance(whole, Fixed) or found.kept_share < 1e-9:
        raise QuantityError("least, most: the distribution has no values between them")
    return found


def _columns_of(path: Path) -> list[str]:
    """Names of the columns of a CSV file, without units."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            cells: list[str] = next((row for row in csv.reader(file) if row and not row[0].startswith("#")), [])
    except OSError as error:
        raise QuantityError(f"{path.name}: cannot be read: {error.strerror or error}") from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise QuantityError(f"{path.name}: not a CSV file: {error}") from None
    return [cell.partition("[")[0].strip() for cell in cells]
