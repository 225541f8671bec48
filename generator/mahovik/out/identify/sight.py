"""Combinations of free numbers that the data cannot tell, and motion that would show them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.laws import Harmonic
from mahovik.core.motion.regime import FlywheelRegime, Regime
from mahovik.out.identify.free import Free
from mahovik.out.identify.gauss_newton import triangle
from mahovik.out.identify.jacobian import slopes
from mahovik.out.identify.phases import speeds
from mahovik.out.identify.predict import Predictor
from mahovik.out.identify.run import Run

Array = NDArray[np.float64]

LARGE = 0.5
"""A combination whose standard deviation is above this, in natural sizes of its numbers, is unobservable."""

AMOUNTS = (".unbalance.static", ".unbalance.dynamic")

FAR, LEAST_PART, WIDE = 3.0, 0.05, 100.0
"""An unbalance is unseen if its standard error is above FAR times its amount in the file, LARGE times the estimate and
LEAST_PART natural sizes; WIDE: standard deviation of its prior, in natural sizes."""

PART = 0.3
"""Numbers with at least this part of the largest one in a combination are named."""

STEADY = 0.01
"""A speed that changes by less than this share of its size counts as constant."""

TURNS = 2.0
"""Flywheels whose angles differ by fewer turns than this in all runs count as of one speed."""


SWING, LEAST_SWING = 0.3, 5.0
"""Amplitude of the speeds of a trial motion: share of the speed, and least, rad/s."""

TRIAL = 2000
"""Samples of a trial motion."""


def unobservable(
    free: Free, runs: Sequence[Run], theta: Array, noise: Sequence[Array], held: Sequence[Array]
) -> tuple[list[str], list[str]]:
    """Lines about combinations that the data cannot tell, and notes about flywheels of one speed that they can.

    `noise`, `held`: see `Fit`.
    """
    ranges = [speeds(run.predictor._case.regime, run.duration) for run in runs]
    lines: list[str] = []
    notes: list[str] = []
    constant = all(bool(np.all(high - low <= STEADY * np.abs(high) + 1e-6)) for low, high in ranges)
    weak = [direction for direction in held if not _is_whole(direction)]
    together: set[str] = set()
    for a, b, speed, apart in _pairs_of_one_speed(free, runs, ranges):
        pair = {a, b}
        lost = any(_is_of(_name_direction(free, direction), pair) for direction in weak)
        together |= pair if lost else set()
        (lines if lost else notes).append(
            f"{a}.unbalance, {b}.unbalance: {a} and {b} turn at one speed, {speed:.4g} rad/s, in all data, so their "
            f"vibration is of one frequency: let the speeds differ by {apart:.2g} rad/s or more, or add a run that does"
        )
    whole = [direction for direction in held if _is_whole(direction)]
    swung = [*whole, *weak] if constant else []
    shown = _shown_by_swing(free, runs[0], theta, noise[0], swung) if swung else [False] * len(held)
    by_advice: dict[str, dict[str, None]] = {}
    for direction, changing in zip(whole, shown, strict=False):
        (name,) = _name_direction(free, direction)
        by_advice.setdefault(_advice([name], constant, changing, ranges, free), {}).setdefault(name)
    for advice, found in by_advice.items():
        lines.append(f"{', '.join(found)}: {'are' if len(found) > 1 else 'is'} {advice}")
    reported: set[frozenset[str]] = set()
    for direction, changing in zip(weak, shown[len(whole) :], strict=True):
        names = _name_direction(free, direction)
        if frozenset(names) in reported:
            continue
        reported.add(frozenset(names))
        if _is_of(names, together):
            continue
        many = "their combination is" if len(names) > 1 else "is"
        lines.append(f"{', '.join(names)}: {many} {_advice(names, constant, changing, ranges, free)}")
    return lines, notes


def undetermined_directions(free: Free, runs: Sequence[Run], theta: Array, information: Array) -> list[Array]:
    """Unit vectors (k), in natural sizes, that the data do not determine: whole numbers first, then combinations."""
    k = len(information)
    whole = _unseen(free, runs, theta, information)
    rest = [i for i in range(k) if i not in whole]
    found = [np.eye(k)[i] for i in whole]
    for direction in weak_directions(information[:, rest]):
        vector = np.zeros(k)
        vector[rest] = direction
        found.append(vector)
    return found


def _unseen(free: Free, runs: Sequence[Run], theta: Array, information: Array) -> list[int]:
    """Numbers that no channel tells as a whole; of unbalances also those far less certain than their amounts.

    Flywheels of one speed have unbalances of which only combinations are unseen.
    """
    ranges = [speeds(run.predictor._case.regime, run.duration) for run in runs]
    together = {name for a, b, *_ in _pairs_of_one_speed(free, runs, ranges) for name in (a, b)}
    alone = np.linalg.norm(information, axis=0)
    inverse = np.linalg.pinv(information.T @ information + WIDE**-2 * np.eye(len(information)))
    still = _still(free, ranges)
    found, row = [], 0
    for entry in free.entries:
        own = list(range(row, row + len(entry.paths)))
        row += len(own)
        if all(alone[i] * LARGE < 1.0 for i in own):
            found += own
        elif entry.paths[0].endswith(AMOUNTS) and entry.paths[0].split(".")[0] not in together:
            before, now = (float(np.linalg.norm(each[own])) for each in (free.nominal, theta))
            spread = np.linalg.eigvalsh(inverse[np.ix_(own, own)])  # the amount may be seen where the angle is not
            square = spread[-1] if entry.paths[0].split(".")[0] in still else spread[0]
            if entry.scale * math.sqrt(max(float(square), 0.0)) > max(
                FAR * before, LARGE * now, LEAST_PART * entry.scale
            ):
                found += own
    return found + [i for i in range(row, len(information)) if alone[i] * LARGE < 1.0]


def _is_whole(direction: Array) -> bool:
    return bool(np.count_nonzero(direction) == 1)


def _is_of(names: Sequence[str], flywheels: set[str]) -> bool:
    """Whether all names are of unbalances of these flywheels."""
    return bool(names) and all(".unbalance." in name and name.split(".")[0] in flywheels for name in names)


def weak_directions(information: Array) -> list[Array]:
    """Unit vectors (k), in natural sizes, along which the standard deviation is above LARGE."""
    if not information.size:
        return []
    _, sigma, rows = np.linalg.svd(information, full_matrices=True)
    size = np.concatenate([sigma, np.zeros(len(rows) - len(sigma))])
    return [row for row, s in zip(rows, size.tolist(), strict=True) if s * LARGE < 1.0]


def _name_direction(free: Free, direction: Array) -> list[str]:
    """Paths of a combination, the largest parts first; an unbalance is named by its amount."""
    most = float(np.abs(direction).max())
    found: dict[str, None] = {}
    names = [path for entry in free.entries for path in ([entry.paths[0]] * len(entry.paths))]
    names += [f"{point}.delay" for point in free.delays]
    for i in np.argsort(-np.abs(direction)).tolist():
        if abs(float(direction[i])) >= PART * most:
            found.setdefault(names[i])
    return list(found)


def _shown_by_swing(free: Free, run: Run, theta: Array, noise: Array, directions: Sequence[Array]) -> list[bool]:
    """Whether a run as long, in which all speeds swing about their means, would tell the combinations."""
    low, high = speeds(run.predictor._case.regime, run.duration)
    wheels = []
    for i, wheel in enumerate(free.stand.flywheels):
        mean = 0.5 * float(low[i] + high[i])
        swing = max(SWING * abs(mean), LEAST_SWING)
        wheels.append(FlywheelRegime(wheel.name, Harmonic(mean, swing, 3.0 + 0.7 * i, 0.5 * i), 0.3 * i))
    count = min(TRIAL, run.predictor.count)
    regime = Regime("trial", tuple(wheels), {})
    predictor = Predictor(free.stand, regime, run.channels, 0.0, run.predictor.every, count)
    found = slopes(predictor, free, theta, np.zeros(predictor.deviations.count))
    J = np.concatenate([found.by_start * predictor.deviations.scale, found.by_theta * free.scale], axis=2)
    J = (J - J.mean(axis=0)) / noise[:, None]
    extra = predictor.deviations.count
    R = triangle(J.reshape(-1, J.shape[2]))[extra:, extra:] * math.sqrt(run.predictor.count / count)
    return [bool(LARGE * np.linalg.norm(R @ each) > 1.0) for each in directions]


def _advice(
    names: Sequence[str],
    constant: bool,
    changing: bool,
    ranges: Sequence[tuple[Array, Array]],
    free: Free,
) -> str:
    still = _still(free, ranges)
    own = [name.split(".")[0] for name in names if name.split(".")[0] in still]
    if own:
        return f"not seen in the data: {', '.join(dict.fromkeys(own))} stands still, let it turn"
    if constant and changing:
        return "not seen at constant speeds: add a run in which the speeds of the flywheels change"
    if constant:
        return (
            "not seen at constant speeds, nor would it be if they changed: keep it as it is, or add a "
            "sensor at another place"
        )
    return "not seen in this motion: add a run with other speeds, or a sensor at another place; or keep one fixed"


def _still(free: Free, ranges: Sequence[tuple[Array, Array]]) -> list[str]:
    """Flywheels that stand still in all runs."""
    return [
        wheel.name
        for i, wheel in enumerate(free.stand.flywheels)
        if all(max(abs(low[i]), abs(high[i])) < 1e-3 for low, high in ranges)
    ]


def _pairs_of_one_speed(
    free: Free, runs: Sequence[Run], ranges: Sequence[tuple[Array, Array]]
) -> list[tuple[str, str, float, float]]:
    """Pairs of flywheels with free unbalances that no run tells apart, their speed, and the speed between that does."""
    names = [wheel.name for wheel in free.stand.flywheels]
    asked = {path.split(".")[0] for entry in free.entries for path in entry.paths if ".unbalance." in path}
    found = []
    for i, a in enumerate(names):
        for j in range(i + 1, len(names)):
            if a not in asked or names[j] not in asked:
                continue
            apart = 0.0
            for run in runs:
                ends = run.predictor._case.regime.motion(np.linspace(0.0, run.duration, 200))[0]
                between = np.minimum(np.ptp(ends[:, i] - ends[:, j]), np.ptp(ends[:, i] + ends[:, j]))
                apart = max(apart, float(between))
            if apart < TURNS * 2.0 * math.pi:
                longest = max(run.duration for run in runs)
                found.append((a, names[j], float(ranges[0][1][i]), TURNS * 2.0 * math.pi / longest))
    return found
