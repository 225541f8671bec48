"""Steady states over a range of speeds: spectra at one point, lines of orders, RMS, natural frequencies."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError
from mahovik.use.study.response.motion import UNITS, Spectrum, rms
from mahovik.use.study.response.periodic import UNSTABLE, periodic_response
from mahovik.use.study.response.scene import Scene
from mahovik.use.study.response.speed_plan import SpeedPlan
from mahovik.use.study.response.speeds import Turning, common_period

Array = NDArray[np.float64]

ORDERS = 6
"""Orders of each flywheel reported as lines."""

SEEN = 1e-6
"""Part of the largest amplitude of all lines below which a line is left out."""


@dataclass(frozen=True, eq=False)
class Step:
    """The steady state at one speed.

    value        the swept speed, rad/s; speeds (N, rad/s) of all
    frequencies  (H + 1, Hz); amplitudes (H + 1, 3) complex, of the quantity at the point
    natural      Hz; hold (6); multiplier: see Periodic
    problem      why there is no steady state; amplitudes and the rest are then empty
    """

    value: float
    turning: Turning
    frequencies: Array
    amplitudes: Spectrum
    natural: Array
    hold: Array
    multiplier: float
    problem: str | None = None

    @property
    def stable(self) -> bool:
        """Whether deviations do not grow."""
        return self.multiplier <= 1.0 + UNSTABLE

    @property
    def sizes(self) -> Array:
        """(H + 1): magnitudes of the amplitudes, root of the sum of squares over the axes."""
        return np.asarray(np.linalg.norm(self.amplitudes, axis=1))

    def at(self, k: int) -> tuple[float, float]:
        """Frequency (Hz) and magnitude of harmonic k; NaN for the mean, and without a steady state."""
        if k == 0 or self.problem is not None:
            return np.nan, np.nan
        return float(k * self.turning.base / (2.0 * np.pi)), float(self.sizes[k]) if k < len(self.sizes) else 0.0


@dataclass(frozen=True, eq=False)
class OrderLine:
    """An order of the flywheels over the steps: its name, as `2 x w1, w2`, frequency (Hz) and magnitude, or NaN.

    Orders that coincide at all steps are one line, as `1 x w1 = 2 x w2` if w2 turns half as fast.
    """

    name: str
    frequency: Array
    size: Array

    @property
    def largest(self) -> float:
        """The largest magnitude."""
        return float(np.nanmax(self.size, initial=0.0))


@dataclass(frozen=True, eq=False)
class Sweep:
    """Steps over a range of speeds, seen at a point. `interrupted`: some steps are missing."""

    stand: Stand
    asked: SpeedPlan
    point: str
    quantity: str
    band: tuple[float, float] | None
    steps: tuple[Step, ...]
    interrupted: bool = False

    @property
    def unit(self) -> str:
        """Unit of the amplitudes."""
        return UNITS[self.quantity]

    @property
    def values(self) -> Array:
        """The swept speed by step, rad/s."""
        return np.array([step.value for step in self.steps])

    def rms(self, band: tuple[float, float] | None = None) -> Array:
        """(steps, 3): root mean square on each axis, of all or within a band (Hz); NaN: no steady state."""
        found = [rms(step.amplitudes, step.frequencies, band) for step in self.steps]
        missing = np.array([step.problem is not None for step in self.steps])
        return np.where(missing[:, None], np.nan, np.array(found).reshape(-1, 3))

    def lines(self) -> tuple[OrderLine, ...]:
        """Orders of the flywheels that turn, largest amplitude first."""
        found = [self._line(names, harmonics) for harmonics, names in self._orders().items()]
        largest = max((line.largest for line in found), default=0.0)
        return tuple(sorted((x for x in found if x.largest > SEEN * largest), key=lambda line: -line.largest))

    def _orders(self) -> dict[tuple[int, ...], list[str]]:
        """Harmonics by step of the common period -> names of the orders present."""
        together: dict[tuple[int, ...], list[str]] = {}
        for s, wheel in enumerate(self.stand.flywheels):
            turns = tuple(abs(step.turning.turns[s]) for step in self.steps)
            if any(turns):
                together.setdefault(turns, []).append(wheel.name)
        orders: dict[tuple[int, ...], list[str]] = {}
        for order in range(1, ORDERS + 1):
            for turns, wheels in together.items():
                harmonics = tuple(order * n for n in turns)
                orders.setdefault(harmonics, []).append(f"{order} x {', '.join(wheels)}")
        return orders

    def _line(self, names: list[str], harmonics: tuple[int, ...]) -> OrderLine:
        found = [step.at(k) for step, k in zip(self.steps, harmonics, strict=True)]
        frequency, size = np.array(found).reshape(-1, 2).T
        return OrderLine(" = ".join(names), frequency, size)


def sweep(
    stand: Stand,
    asked: SpeedPlan,
    steps: int,
    point: str,
    *,
    quantity: str = "acceleration",
    band: tuple[float, float] | None = None,
    phases: Sequence[float] | None = None,
    go_on: Callable[[int], bool] = lambda done: True,
) -> Sweep:
    """Steady states at `steps` speeds. `go_on` (steps done) is called before each; Ctrl-C or False ends early.

    Raises UsageError before anything is computed: unknown point, speeds without a common period. CheckError: no
    equilibrium, or no step has a steady state.
    """
    values = asked.values(steps)
    turnings = [common_period(asked.speeds(value)) for value in values]
    found: list[Step] = []
    whole = False
    try:
        for step in _steps(Scene.of(stand), values, turnings, point, quantity, phases, go_on):
            found.append(step)
        whole = len(found) == len(values)
    except KeyboardInterrupt:
        pass
    if found and all(step.problem is not None for step in found):
        raise CheckError(str(found[0].problem))
    return Sweep(stand, asked, point, quantity, band, tuple(found), not whole)


def _steps(
    scene: Scene,
    values: Sequence[float],
    turnings: Sequence[Turning],
    point: str,
    quantity: str,
    phases: Sequence[float] | None,
    go_on: Callable[[int], bool],
) -> Iterator[Step]:
    for done, (value, turning) in enumerate(zip(values, turnings, strict=True)):
        if not go_on(done):
            return
        try:
            found = periodic_response(scene, turning.speeds, [point], phases)
        except CheckError as error:
            none = np.zeros((0, 3), dtype=np.complex128)
            yield Step(value, turning, np.zeros(0), none, np.zeros(0), np.zeros(6), np.nan, str(error))
            continue
        spectrum = found.points[point].harmonics(quantity)
        yield Step(value, turning, found.frequencies, spectrum, found.natural, found.hold, found.multiplier)
