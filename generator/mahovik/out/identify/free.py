"""Free numbers of a stand: paths that are estimated, and the numbers theta by which they are.

The amount and angle of an unbalance are estimated as its parts along the flywheel's second and third axes, in which
the motion is nearly linear and which have no singular point.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.inertia import inertia_about_origin
from mahovik.core.stand.numbers import StandNumber, StandNumbers
from mahovik.core.stand.units import TIME, Dimension
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.model import Model, build
from mahovik.out.api.stands import Stand
from mahovik.out.api.tables import Tables
from mahovik.out.campaign.signals import sensors

Array = NDArray[np.float64]

SHARE = 0.02
"""Share of a moment of inertia that an unbalance or product may be which is zero in the file; for scaling."""

SMALL_LENGTH, SMALL_ANGLE = 0.01, 0.02
"""Sizes of places (m) and directions (rad) that are zero in the file."""

STEP = 1e-4
"""Step of central differences, of the scale of a number."""

DELAY = "delay"

_LENGTHS = ("position", "pivot", "center_of_mass", "ground", "carrier", "center")
_ANGLES = ("angles",)


@dataclass(frozen=True)
class Entry:
    """One path or the two of an unbalance, with one theta each; `scale`: natural size of its theta, SI."""

    numbers: tuple[StandNumber, ...]
    scale: float

    @property
    def polar(self) -> bool:
        """Amount and angle, estimated by parts."""
        return len(self.numbers) == 2

    @property
    def paths(self) -> tuple[str, ...]:
        """Names of its results."""
        return tuple(place.path for place in self.numbers)

    def theta(self, values: Sequence[float]) -> list[float]:
        """Numbers that are estimated, from values of the paths."""
        if not self.polar:
            return list(values)
        amount, angle = values
        return [amount * math.cos(angle), amount * math.sin(angle)]

    def values(self, theta: Array) -> Array:
        """Values of the paths (k, n) from theta (k, n)."""
        if not self.polar:
            return theta
        return np.stack([np.hypot(theta[0], theta[1]), np.arctan2(theta[1], theta[0])])

    def slopes(self, theta: Array) -> Array:
        """d values / d theta (k, k) at theta (k)."""
        if not self.polar:
            return np.eye(1)
        c, s = theta
        r2 = c * c + s * s
        r = math.sqrt(r2)
        return np.array([[c / r, s / r], [-s / r2, c / r2]]) if r else np.full((2, 2), math.nan)


class Free:
    """All free numbers of a stand.

    `delays`: points whose delay is free; their delays (s) come after the numbers of the stand in theta.
    """

    def __init__(self, model: Model, paths: Sequence[str]) -> None:
        """`paths`: as `StandNumbers.find` takes them; also `NAME.unbalance`, all of it, and `POINT.delay`."""
        self.stand = Stand.of(model.stand)
        numbers = StandNumbers(self.stand, self.stand.to_dict())
        found: dict[str, StandNumber] = {}
        delays: list[str] = []
        for path in paths:
            if path.endswith(f".{DELAY}"):
                delays.append(_point(path, self.stand))
                continue
            whole = path.endswith(".unbalance")
            for each in (
                [f"{path}.{key}" for key in ("static", "static_at", "dynamic", "dynamic_at")] if whole else [path]
            ):
                found |= {place.path: place for place in numbers.find(each)}
        if not found and not delays:
            raise UsageError("--free: expected at least one path, such as w*.unbalance")
        self.stand = Stand.from_dict(numbers.written_out(found.values()), self.stand.name)
        self.model = build(self.stand)
        self.delays = tuple(dict.fromkeys(delays))
        self.entries = tuple(_entries(found, self.stand))

    @property
    def paths(self) -> tuple[str, ...]:
        """Names of the results, with delays last."""
        return (*(path for entry in self.entries for path in entry.paths), *(f"{p}.{DELAY}" for p in self.delays))

    @property
    def dimensions(self) -> tuple[Dimension, ...]:
        """Dimensions of the results."""
        return (*(place.dimension for e in self.entries for place in e.numbers), *(TIME for _ in self.delays))

    @property
    def size(self) -> int:
        """How many numbers of the stand, without delays."""
        return sum(len(entry.numbers) for entry in self.entries)

    @property
    def nominal(self) -> Array:
        """theta of the stand file; delays zero."""
        own = [t for entry in self.entries for t in entry.theta([place.value for place in entry.numbers])]
        return np.array([*own, *(0.0 for _ in self.delays)])

    @property
    def scale(self) -> Array:
        """Natural size of each theta; of a delay 1 ms."""
        return np.array([*(e.scale for e in self.entries for _ in e.numbers), *(1e-3 for _ in self.delays)])

    def values(self, theta: Array) -> Array:
        """Values of all paths (k, n) from theta (k, n)."""
        rows = [entry.values(theta[own]) for entry, own in self._parts()]
        return np.concatenate([*rows, theta[self.size :]]) if rows else theta

    def slopes(self, theta: Array) -> Array:
        """d values / d theta (k, k)."""
        found = np.eye(len(theta))
        for entry, own in self._parts():
            found[own, own] = entry.slopes(theta[own])
        return found

    def changes(self, theta: Array) -> Mapping[str, Array]:
        """Changes for `Model.tables`, for n thetas (k, n)."""
        values = self.values(theta)
        paths = [path for entry in self.entries for path in entry.paths]
        return {path: np.ascontiguousarray(values[i]) for i, path in enumerate(paths)}

    def tables(self, theta: Array) -> Tables:
        """Tables of the stands with n thetas (k, n). Raises StandError: a stand cannot be."""
        return self.model.tables(self.changes(theta), theta.shape[1])

    def _parts(self) -> list[tuple[Entry, slice]]:
        found, row = [], 0
        for entry in self.entries:
            found.append((entry, slice(row, row + len(entry.numbers))))
            row += len(entry.numbers)
        return found


def _entries(found: Mapping[str, StandNumber], stand: Stand) -> list[Entry]:
    """Amounts and angles of unbalances together, where both are free."""
    entries = []
    for path, place in found.items():
        amount = path.removesuffix("_at")
        if path.endswith("_at") and ".unbalance." in path and amount in found:
            continue
        partner = found.get(f"{path}_at") if ".unbalance." in path else None
        entries.append(Entry((place,) if partner is None else (place, partner), _scale(place, stand)))
    return entries


def _scale(place: StandNumber, stand: Stand) -> float:
    """Natural size of a number: as in the file; where that is zero, what a real stand may have."""
    body = next((each for each in stand.bodies if each.name == place.body), None)
    if ".unbalance." in place.path and body is not None and not place.key.endswith("_at"):
        spin = float(inertia_about_origin(body)[0, 0])
        anywhere = SHARE * (math.sqrt(spin * body.mass) if place.key == "static" else spin)
        return max(abs(place.value), anywhere)
    if place.key == "inertia" and body is not None:
        return max(abs(place.value), SHARE * float(np.trace(inertia_about_origin(body))))
    if place.key in _LENGTHS:
        return max(abs(place.value), SMALL_LENGTH)
    if place.key in _ANGLES or place.key.endswith("_at"):
        return max(abs(place.value), SMALL_ANGLE)
    return abs(place.value) or SHARE


def _point(path: str, stand: Stand) -> str:
    known, name = sensors(stand), path.removesuffix(f".{DELAY}")
    if name not in known:
        raise UsageError(f'{path}: {stand.name} has no point or instrument "{name}"{suggestion(name, known)}')
    return name
