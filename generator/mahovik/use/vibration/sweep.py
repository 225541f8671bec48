"""Steady states over a range of speeds: spectra at one point, lines of orders, RMS, natural frequencies.

As a file: JSON with everything, CSV with a row per speed.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError, UsageError
from mahovik.use.numeric import Array, Complex
from mahovik.use.study.linear.model import encode_lines
from mahovik.use.vibration.band import check_band, rms
from mahovik.use.vibration.campbell import orders_of
from mahovik.use.vibration.peaks import ROUNDS, merged, resonances, unsettled
from mahovik.use.vibration.periodic import UNSTABLE, periodic_response
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.speeds import SpeedPlan, Turning, common_period
from mahovik.use.vibration.view import AXES, Observable, find_view

ORDERS = 6
"""Orders of each flywheel reported as lines."""

SMALLEST_LINE = 1e-6
"""Part of the largest amplitude of all lines below which a line is left out."""

ROUNDING = 1e-12
"""Part of the largest mean below which a line is rounding, and left out: a balanced wheel shakes a mount by nothing."""

STILL = 1e-15
"""SI: a smaller RMS is rounding."""


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
    amplitudes: Complex
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
    """Steps over a range of speeds, seen at a point.

    planned   number of steps, of which some are missing where the sweep was ended
    coarse    a speed (rad/s) near which the largest amplitude is not known to be the true one; None: it is
    """

    stand: Stand
    plan: SpeedPlan
    point: str
    quantity: str
    band: tuple[float, float] | None
    steps: tuple[Step, ...]
    planned: int
    axes: tuple[str, ...] = AXES
    unit: str = ""
    coarse: float | None = None

    @property
    def interrupted(self) -> bool:
        """Whether some steps are missing."""
        return len(self.steps) < self.planned

    @property
    def values(self) -> Array:
        """The swept speed by step, rad/s."""
        return np.array([step.value for step in self.steps])

    def rms(self, band: tuple[float, float] | None = None) -> Array:
        """(steps, axes): root mean square on each axis, of all or within a band (Hz); NaN: no steady state."""
        found = [rms(step.amplitudes, step.frequencies, band) for step in self.steps]
        missing = np.array([step.problem is not None for step in self.steps])
        return np.where(missing[:, None], np.nan, np.array(found).reshape(-1, len(self.axes)))

    def rms_columns(self) -> list[tuple[str, Array]]:
        """RMS along each axis and, of several, together, each with its name; then those within the band."""
        parts = [("rms", self.rms())] + ([("band rms", self.rms(self.band))] if self.band else [])
        found = []
        for name, table in parts:
            found += [(f"{name} {axis}", table[:, i]) for i, axis in enumerate(self.axes)]
            if len(self.axes) > 1:
                found.append((f"{name} {''.join(self.axes)}", np.linalg.norm(table, axis=1)))
        return found

    def lines(self) -> tuple[OrderLine, ...]:
        """Orders of the flywheels that turn, largest amplitude first."""
        found = [self._line(names, harmonics) for harmonics, names in self._orders().items()]
        largest = max((line.largest for line in found), default=0.0)
        means = (float(step.sizes[0]) for step in self.steps if step.problem is None and len(step.sizes))
        least = max(SMALLEST_LINE * largest, ROUNDING * max(means, default=0.0))
        return tuple(sorted((x for x in found if x.largest > least), key=lambda line: -line.largest))

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
    quantity: str | None = None,
    band: tuple[float, float] | None = None,
    phases: Sequence[float] | None = None,
    go_on: Callable[[int, int], bool] = lambda done, planned: True,
) -> Sweep:
    """Steady states at `steps` even speeds and at resonances between them.

    `go_on` (steps done, planned) is called before each; Ctrl-C or False ends early.

    `point`: or another name of `find_view`. Raises UsageError before anything is computed: unknown point, speeds
    without a common period. CheckError: no equilibrium, or no step has a steady state.
    """
    (found,) = sweep_outputs(
        stand, asked, steps, [find_view(stand, point, quantity)], band=band, phases=phases, go_on=go_on
    )
    return found


def sweep_outputs(
    stand: Stand,
    asked: SpeedPlan,
    steps: int,
    views: Sequence[Observable],
    *,
    band: tuple[float, float] | None = None,
    phases: Sequence[float] | None = None,
    go_on: Callable[[int, int], bool] = lambda done, planned: True,
) -> list[Sweep]:
    """A sweep of each view of the same steady states; otherwise as `sweep`."""
    if band is not None:
        check_band("band", band)
    values = np.array(asked.values(steps))
    for value in values:
        common_period(asked.speeds(float(value)))
    found: dict[float, list[Step]] = {}
    coarse = np.zeros(0)
    try:
        scene = Scene.of(stand)
        orders = [orders_of(scene)] * len(stand.flywheels)
        values = merged(asked, values, _periodic(asked, resonances(scene, asked, steps, orders)))
        for _ in range(ROUNDS):
            for value in values:
                if float(value) not in found:
                    if not go_on(len(found), len(values)):
                        break
                    turning = common_period(asked.speeds(float(value)))
                    found[float(value)] = _steps(scene, float(value), turning, views, phases)
            coarse = _unsettled(found, len(views))
            more = merged(asked, values, _periodic(asked, coarse))
            if len(found) < len(values) or len(more) == len(values):
                break
            values = more
    except KeyboardInterrupt:
        if not found:
            raise
    rows = [found[float(value)] for value in values if float(value) in found]
    if rows and all(each[0].problem is not None for each in rows):
        raise CheckError(str(rows[0][0].problem))
    return [
        Sweep(
            stand, asked, view.name, view.quantity, band, tuple(each[k] for each in rows), len(values), view.axes,
            view.measure.unit, float(coarse[0]) if len(coarse) else None,
        )
        for k, view in enumerate(views)
    ]  # fmt: skip


FINER = 100
"""Parts of a speed that is kept constant, to which an added speed is rounded: both then have a common period."""


def _periodic(asked: SpeedPlan, values: Array) -> Array:
    """Values of the swept speed, rounded where it must be, at which the flywheels have a common period."""
    base = common_period(asked.constant).base / FINER
    near = [float(round(x / base) * base) if base else float(x) for x in values]
    return np.array([x for x in near if _has_period(asked.speeds(x))])


def _has_period(speeds: Sequence[float]) -> bool:
    try:
        common_period(speeds)
    except UsageError:
        return False
    return True


def _unsettled(found: dict[float, list[Step]], outputs: int) -> Array:
    """Speeds to be added about the largest RMS of every output."""
    values = sorted(found)
    sizes = [[_size(found[value][k]) for value in values] for k in range(outputs)]
    return np.concatenate([unsettled(np.array(values), np.array(each)) for each in sizes])


def _size(step: Step) -> float:
    """RMS, root of the sum of squares over the axes; NaN without a steady state, 0 where it is rounding."""
    if step.problem is not None:
        return math.nan
    size = float(np.linalg.norm(rms(step.amplitudes, step.frequencies)))
    return size if size > max(STILL, ROUNDING * float(step.sizes[0])) else 0.0


def _steps(
    scene: Scene, value: float, turning: Turning, views: Sequence[Observable], phases: Sequence[float] | None
) -> list[Step]:
    """The steady state at one speed, seen by each view."""
    try:
        found = periodic_response(scene, turning.speeds, phases)
    except CheckError as error:
        none = [np.zeros((0, len(view.axes)), dtype=np.complex128) for view in views]
        return [Step(value, turning, np.zeros(0), x, np.zeros(0), np.zeros(6), np.nan, str(error)) for x in none]
    spectra = [found.harmonics(view) for view in views]
    return [Step(value, turning, found.frequencies, x, found.natural, found.hold, found.multiplier) for x in spectra]


NEGLIGIBLE = 1e-9
"""Part of the largest amplitude of a step: smaller harmonics are not written."""


def as_object(found: Sweep) -> dict[str, Any]:
    """Contents of the JSON file; SI, frequencies in Hz."""
    asked = found.plan
    return {
        "schema": 1,
        "stand": found.stand.name,
        "point": found.point,
        "quantity": found.quantity,
        "unit": found.unit,
        "band_Hz": None if found.band is None else list(found.band),
        "flywheels": list(asked.names),
        "swept": None if asked.swept is None else asked.names[asked.swept],
        "interrupted": found.interrupted,
        "lines": [
            {
                "name": line.name,
                "frequency_Hz": _numbers(line.frequency),
                "amplitude": _numbers(line.size),
            }
            for line in found.lines()
        ],
        "rms": [_numbers(row) for row in found.rms()],
        "band_rms": None if found.band is None else [_numbers(row) for row in found.rms(found.band)],
        "steps": [_step_object(step) for step in found.steps],
    }


def _step_object(step: Step) -> dict[str, Any]:
    sizes = step.sizes
    kept = np.flatnonzero(sizes > NEGLIGIBLE * sizes.max(initial=0.0))
    return {
        "speeds": list(step.turning.speeds),
        "turns": list(step.turning.turns),
        "problem": step.problem,
        "stable": None if step.problem else bool(step.stable),
        "largest_multiplier": None if not np.isfinite(step.multiplier) else step.multiplier,
        "hold": step.hold,
        "natural_Hz": step.natural,
        "frequency_Hz": step.frequencies[kept],
        "amplitude_re": step.amplitudes[kept].real,
        "amplitude_im": step.amplitudes[kept].imag,
    }


def _numbers(row: Any) -> list[float | None]:
    """A row of numbers; null without a steady state."""
    return [float(x) if np.isfinite(x) else None for x in row]


def json_text(found: Sweep) -> str:
    """JSON, one key per line."""
    return encode_lines(as_object(found)) + "\n"


def csv_text(found: Sweep) -> str:
    """A row per speed: speeds, RMS on the axes and together, within the band, amplitudes of the orders."""
    unit, lines, columns = found.unit, found.lines(), found.rms_columns()
    names = [f"speed {name} [rpm]" for name in found.plan.names]
    names += [f"{name} [{unit}]" for name, _ in columns]
    names += [f"{line.name} [{unit}]" for line in lines]
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(names)
    for i, step in enumerate(found.steps):
        row = [RPM * speed for speed in step.turning.speeds]
        row += [values[i] for _, values in columns]
        row += [float(line.size[i]) for line in lines]
        writer.writerow([f"{x:.12g}" if np.isfinite(x) else "" for x in row])
    return file.getvalue()
