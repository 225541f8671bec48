"""Channels of sensors while all flywheels turn as measured, of n variants of a stand at once, by the batch C.

Phases of flywheels are fitted by splines, never differentiated. Steps of order 4 under given speeds; numbers and
initial states differ from variant to variant. An initial state is exp(S q) from the home pose with V = S u: of a free
carrier S = E and 12 numbers (q, u), of one with m freedoms 2 m.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import BSpline, generate_knots, make_interp_spline, make_lsq_spline
from scipy.spatial.transform import Rotation

from mahovik.core.motion.functions import Motion
from mahovik.core.motion.laws import SpeedLaw
from mahovik.core.motion.regime import FlywheelRegime, Regime
from mahovik.core.stand.hold import twists
from mahovik.core.toolchain.compiled import compile_library
from mahovik.errors import StateError, UsageError
from mahovik.out.api.stands import Stand
from mahovik.out.api.tables import Tables
from mahovik.use.measured.clocks import Recording
from mahovik.use.measured.headers import LETTERS, sensors
from mahovik.use.numeric.se3 import Array, left_jacobian
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.course import motion, together
from mahovik.use.simulate.held import home

Phase = Callable[..., Array]
"""Phase of a flywheel over time (s), rad; with a second argument its derivative of that order."""

DEGREE = 5
"""Degree of the splines: the acceleration of a flywheel is smooth, too."""

FEWEST, LEAST = 10, 50
"""Samples an interval of a spline has at least, on average; samples of a phase that a fit needs."""

SETTLED = 4
"""Refinements without gain after which the search for knots ends."""

ON_GRID = 1e-3
"""Samples so near to the times of a prediction, in steps, are taken to be there."""

NEAR_CORNER = 3.0
"""Knots of a phase so near to one another, in steps of time, are at a corner."""

TURN = 0.25
"""A step turns no flywheel by more, rad: the error of order 4 is then far below that of any sensor."""

READINGS, TWIST, FORCE = 24, 15, 18
"""Numbers of `points` of one sensor, the first of its angular velocity, the first of its specific force."""

POSE, RATES = (1e-2, 1e-1), (1e-1, 1.0)
"""Natural sizes of a shift (m) and a turn (rad), and of the two parts of a twist (m/s, rad/s)."""


def channels_of(stand: Stand) -> tuple[str, ...]:
    """Labels of all channels that can be predicted: of its sensors, and of the hold of a held carrier."""
    of_hold = [] if stand.hold is None else [f"hold.reaction.{letter}" for letter in LETTERS]
    return (
        *(f"{name}.{key}.{axis}" for name in sensors(stand) for key in ("acceleration", "rate") for axis in "xyz"),
        *of_hold,
    )


def phase_of(recording: Recording, stand: Stand, name: str) -> Phase:
    """The phase of a flywheel over the time since the first sample of a recording. Raises UsageError."""
    values = recording.get(f"{name}.phase")
    if values is None:
        hint = "; a speed does not tell where its unbalance is" if f"{name}.speed" in recording.frame else ""
        raise UsageError(
            f"{recording.source}: nothing tells the phase of {name}{hint}; expected a column "
            f"{name}.count, {name}.phase [rad] or {name}.tacho"
        )
    there = np.isfinite(values)
    if np.count_nonzero(there) < LEAST:
        many = f"{np.count_nonzero(there)} samples, expected at least {LEAST}"
        raise UsageError(f"{recording.source}: {name}.phase has {many}")
    encoder = next(wheel.encoder for wheel in stand.flywheels if wheel.name == name)
    latency = encoder.latency if encoder is not None and name in recording.counted else 0.0
    return fit_phase(recording.t[there] - recording.t[0] - latency, values[there])


def fit_phase(t: Array, phi: Array) -> Phase:
    """The phase of a flywheel whose phases phi (rad, not wrapped) were seen at the times t (s).

    Of a straight line and splines with knots where they are needed, such as at the end of a ramp, the one of least
    Bayesian information criterion n ln(sum of squares / n) + p ln n: what is left is then rounding of counts and noise.
    """
    slope, begin = np.polyfit(t, phi, 1)
    line = BSpline(np.repeat(t[[0, -1]], 2), begin + slope * t[[0, -1]], 1)
    least, worse = _criterion(phi - line(t), 2), 0
    best: Phase = line
    for knots in generate_knots(t, phi, k=DEGREE, s=1e-24 * len(t)):
        inner = len(knots) - 2 * DEGREE - 2
        if worse == SETTLED or (inner and len(t) < FEWEST * inner):
            break
        spline = make_lsq_spline(t, phi, knots, k=DEGREE)
        value = _criterion(phi - spline(t), 2 * inner + DEGREE + 1)  # a knot counts for its place, too
        worse = 0 if value < least else worse + 1
        if value < least:
            least, best = value, spline
    return best


def corners_of(phase: Phase, every: float) -> Array:
    """Times (s) at which the acceleration of a fitted phase jumps: knots are as near there as samples, `every` s."""
    knots = np.unique(phase.t) if isinstance(phase, BSpline) else np.zeros(0)
    return np.asarray(knots[:-1][np.diff(knots) < NEAR_CORNER * every])


def _criterion(residual: Array, numbers: int) -> float:
    n = len(residual)
    mean = max(float(np.mean(residual**2)), 1e-24)  # rounding of a double is the least noise
    return n * math.log(mean) + numbers * math.log(n)


@dataclass(frozen=True, eq=False)
class MeasuredSpeed(SpeedLaw):
    """Law of a flywheel by its phase over time; t = 0 of the law is at `begin`, s."""

    phase: Phase
    begin: float

    def motion(self, t: Array) -> Motion:
        """Motion at the times t (s); the phase is counted from t = 0."""
        turned = self.phase(t + self.begin) - self.phase(np.array([self.begin]))
        return turned, self.phase(t + self.begin, 1), self.phase(t + self.begin, 2)


class Predictor:
    """Predicts channels at `count` evenly spaced times from `begin` (s) on, `every` s apart.

    phases  of all flywheels; channels: labels, see `channels_of`
    start_scale  natural sizes of the numbers of an initial state (D)
    """

    def __init__(
        self, stand: Stand, phases: Sequence[Phase], channels: Sequence[str], begin: float, every: float, count: int
    ) -> None:
        if not phases:
            raise UsageError(f"{stand.name} has no flywheel, expected at least one: a still one has a constant phase")
        self.stand, self.phases, self.channels = stand, tuple(phases), tuple(channels)
        self.times: Array = begin + every * np.arange(count, dtype=np.float64)
        fastest = float(np.abs(self.motion(self.times)[1]).max())
        wheels = tuple(
            FlywheelRegime(wheel.name, MeasuredSpeed(phase, begin), float(phase(np.array([begin]))[0]))
            for wheel, phase in zip(stand.flywheels, phases, strict=True)
        )
        dt = min(every, TURN / fastest) if fastest else every
        self._case = Case(stand, Regime("measured", wheels, {}), home(stand), every * (count - 1), every, dt)
        self._made = compile_library(stand)
        names = sensors(stand)
        self._rows = np.array([_row(label, names) for label in channels], dtype=int)
        held = np.any(self._rows >= READINGS * len(names))
        self._needs = {"readings", "reaction"} if held else {"readings"}
        S = twists(stand.hold)
        turns = np.any(S[3:] != 0.0, axis=0)
        self.start_scale: Array = np.concatenate([np.where(turns, turn, shift) for shift, turn in (POSE, RATES)])

    def motion(self, t: Array) -> tuple[Array, Array, Array]:
        """Phases, speeds and accelerations (T, N) of all flywheels."""
        phi, speeds, rates = (np.column_stack([phase(t, order) for phase in self.phases]) for order in range(3))
        return phi, speeds, rates

    def __call__(self, tables: Tables, starts: Array) -> Array:
        """Channels (count, C, n), SI, of the stands of `tables` from initial states of the numbers `starts` (D, n).

        Raises StateError: a variant leaves the computable range.
        """
        n = len(tables)
        x, out = self._states(tables, starts), np.empty((len(self.times), len(self.channels), n))
        for part, block, _ in together(None, self._made, x, tables):
            row = 0
            for at in motion(self._case, block, self._needs):
                out[row : row + len(at.t), :, part] = np.concatenate([at.readings, at.reaction], axis=1)[:, self._rows]
                row += len(at.t)
            for j in np.flatnonzero(block.status < 0).tolist():
                raise StateError(f"{self.stand.name}: variant {part[j]}: {block.reason(j)}")
        return out

    def _states(self, tables: Tables, starts: Array) -> Array:
        """States (13 + 2 N, n), of flywheels that do not turn."""
        n, still = len(tables), home(self.stand)
        laws = tables.laws()  # of a hold's numbers those that differ
        position = laws.get("home_position", np.array(still.position)[:, None])
        attitude = laws.get("home_attitude", np.array(still.quaternion)[:, None])
        S = laws.get("S", twists(self.stand.hold)[..., None])
        S = np.broadcast_to(S, (*S.shape[:2], n))
        m = S.shape[1]
        step, V = (np.einsum("imn,mn->in", S, part) for part in (starts[:m], starts[m:]))
        C = Rotation.from_quat(np.broadcast_to(attitude, (4, n)).T, scalar_first=True)
        moved = position + C.apply((left_jacobian(step[3:].T) @ step[:3].T[:, :, None])[:, :, 0]).T
        turned, wheels = (C * Rotation.from_rotvec(step[3:].T)).as_quat(scalar_first=True).T, 2 * len(self.phases)
        return np.concatenate([moved, turned, V, np.zeros((wheels, n))])


def _row(label: str, names: Sequence[str]) -> int:
    """Place of a channel among the numbers of `points`, then `reaction`."""
    name, quantity, axis = label.split(".")
    if quantity == "reaction":
        return READINGS * len(names) + LETTERS.index(axis)
    return READINGS * names.index(name) + (TWIST if quantity == "rate" else FORCE) + LETTERS.index(axis)


class Samples:
    """Predicted channels at the times of samples, which sensors tell later than they see them.

    times  of the samples (T, s); grid: even times of the prediction (G, s)
    """

    def __init__(self, grid: Array, times: Array, channels: Sequence[str]) -> None:
        self._grid, self._times = grid, times
        self._names = np.array([label.partition(".")[0] for label in channels])

    def at(self, course: Array, delays: dict[str, float], order: int = 0) -> Array:
        """Channels (T, C, n) of their course (G, C, n) with delays of points (s); or derivatives by time."""
        seen = np.empty((len(self._times), *course.shape[1:]))
        for name in np.unique(self._names):
            columns, t = self._names == name, self._times - delays.get(name, 0.0)
            places = (t - self._grid[0]) / (self._grid[1] - self._grid[0])
            whole = np.round(places).astype(int)
            if order == 0 and np.abs(places - whole).max() < ON_GRID:
                seen[:, columns] = course[whole][:, columns]
            else:
                seen[:, columns] = make_interp_spline(self._grid, course[:, columns], k=DEGREE)(t, order)
        return seen
