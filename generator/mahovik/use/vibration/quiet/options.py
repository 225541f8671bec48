"""Options of `mahovik quiet`, and the flywheels under them: speeds that hold the momentum, and limits."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import linprog

from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.state import rest_state
from mahovik.errors import CheckError, UsageError, whole_number
from mahovik.nearest import suggestion
from mahovik.proof.reference import pieces
from mahovik.proof.reference.screw import f
from mahovik.use.numeric import Array
from mahovik.use.vibration.band import check_band
from mahovik.use.vibration.view import REACTION


class Measure(NamedTuple):
    """Kind of jitter: a motion of the point, integrated this many times; `turning`: rotation of its axes."""

    unit: str
    turning: bool
    integrals: int


MEASURES = {
    "acceleration": Measure("m/s2", False, 0),
    "velocity": Measure("m/s", False, 1),
    "displacement": Measure("m", False, 2),
    "rate": Measure("rad/s", True, 0),
    "angle": Measure("rad", True, 1),
    "force": Measure("N", False, 0),
    "moment": Measure("N m", False, 0),
}

LOADS = ("force", "moment")
"""Measures of the reaction of a hold."""

Interval = tuple[float, float]


@dataclass(frozen=True)
class QuietOptions:
    """Options of a search for quiet speeds, in SI and Hz. Raises UsageError for options without meaning.

    point      name of a point or instrument; REACTION: that of the hold
    band       Hz, the lower first
    momentum   of the flywheels relative to the carrier, in E1, N m s; None: that of `speeds`
    speeds     initial ones, rad/s; None: the smallest that give the momentum
    axes       directions in the point's axes (unit vectors), whose mean squares are added
    measure    a key of MEASURES
    limit      largest |phi'|, rad/s; None: the no-load speeds of the motors
    least      least |phi'|, rad/s
    change     largest change of a speed, rad/s; None: any
    reduction  sufficient factor: choose the least change that reaches it; None: the lowest RMS
    avoid      frequencies (Hz, from, to) to keep all orders of the speeds out of
    orders     these orders
    modes      also avoid the natural frequencies of the carrier on its suspension
    margin     around those, on both sides, as a part of the frequency
    guard      a speed counts as outside the band only if it is outside by this part of the band's end
    """

    point: str
    band: Interval
    momentum: tuple[float, ...] | None = None
    speeds: tuple[float, ...] | None = None
    axes: tuple[tuple[float, ...], ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    measure: str = "acceleration"
    limit: float | None = None
    least: float = 0.0
    change: float | None = None
    reduction: float | None = None
    avoid: tuple[Interval, ...] = ()
    orders: tuple[int, ...] = (1, 2)
    modes: bool = False
    margin: float = 0.1
    guard: float = 0.02
    seed: int = 0

    def __post_init__(self) -> None:
        for name, limits in (("band", self.band), *(("avoid", each) for each in self.avoid)):
            check_band(name, limits)
        whole_number("seed", self.seed, 0)
        for axis in self.axes:
            if not (len(axis) == 3 and math.isclose(math.hypot(*axis), 1.0, rel_tol=1e-6)):
                raise UsageError(f"axes: {list(axis)}, expected directions of three numbers and length 1")
        if self.momentum is not None and len(self.momentum) != 3:
            raise UsageError(f"momentum: {len(self.momentum)} numbers, expected 3")
        if self.momentum is None and self.speeds is None:
            raise UsageError("neither --momentum nor --speeds: give the momentum to hold, or the present speeds")
        if self.measure not in MEASURES:
            raise UsageError(f"--measure {self.measure}: expected one of {', '.join(MEASURES)}")
        if self.band[0] == 0.0 and MEASURES[self.measure].integrals:
            raise UsageError(f"--band from 0 Hz: a drift has no {self.measure} in a band; begin above 0")
        for name, value in (("limit", self.limit), ("change", self.change)):
            if value is not None and not (math.isfinite(value) and value > 0.0):
                raise UsageError(f"--{name}: {value:.6g} rad/s, expected a speed above 0")
        if not (math.isfinite(self.least) and self.least >= 0.0):
            raise UsageError(f"--least: {self.least:.6g} rad/s, expected a speed of at least 0")
        if self.reduction is not None and not 1.0 < self.reduction < math.inf:
            raise UsageError(f"--reduction {self.reduction:g}: expected a factor above 1")
        for name, value in (("margin", self.margin), ("guard", self.guard)):
            if not 0.0 <= value < 1.0:
                raise UsageError(f"--{name} {value:g}: expected a fraction of 1, as 10%")
        if not self.orders or min(self.orders) < 1:
            raise UsageError("--orders: expected whole numbers from 1, as 1,2")

    @property
    def guarded_band(self) -> Interval:
        """The band with its guard, Hz."""
        return self.band[0] * (1.0 - self.guard), self.band[1] * (1.0 + self.guard)


def check_options(stand: Stand, options: QuietOptions) -> None:
    """Check that the options fit the stand. Raises UsageError."""
    names = [*(p.name for p in stand.instruments), *(p.name for p in stand.points)]
    if stand.hold is not None:
        names.append(REACTION)
        _check_held(stand.name, stand.hold, options)
    elif options.measure in LOADS:
        raise UsageError(f"--measure {options.measure}: {stand.name} has no [hold], and a point transmits no force")
    if options.point not in names:
        hint = suggestion(options.point, names, "the stand has no points: add a [[point]]")
        raise UsageError(f"--point {options.point}: no point or instrument of that name{hint}")
    N = len(stand.flywheels)
    if options.speeds is not None and len(options.speeds) != N:
        raise UsageError(f"--speeds: {len(options.speeds)} numbers, but the stand has {N} flywheels")
    if not all(math.isfinite(x) for x in (*(options.speeds or ()), *(options.momentum or ()))):
        raise UsageError("--momentum, --speeds: expected finite numbers")


def _check_held(name: str, hold: Hold, options: QuietOptions) -> None:
    """Check what a held carrier can be asked. Raises UsageError."""
    load, reaction = options.measure in LOADS, options.point == REACTION
    if load is not reaction:
        known = LOADS if reaction else [each for each in MEASURES if each not in LOADS]
        raise UsageError(f"--measure {options.measure}: {options.point} has none; expected one of {', '.join(known)}")
    if not hold.freedoms and not reaction:
        raise UsageError(f"--point {options.point}: {name} is clamped, and no point moves; expected {REACTION}")
    if options.momentum is not None and not np.any(twists(hold)[3:]):
        raise UsageError(f"--momentum: {name} turns about nothing, and its hold takes all momentum; give --speeds")


RANK = 1e-9
"""Part of the largest singular value below which one is zero."""


@dataclass(frozen=True, eq=False)
class Wheels:
    """axes (3 x N): mean angular momentum in E1 of unit speeds, spin inertia by spin axis, kg m2.

    Of a held carrier only its parts along the freedoms that turn count: axes has a row for each.

    nullspace (N x d): orthonormal; speeds without momentum. momentum (3, N m s): the required one.
    start (N, rad/s): speeds that hold it, nearest to the given ones.
    distance (rad/s): distance of `start` from the given speeds.
    """

    names: tuple[str, ...]
    axes: Array
    nullspace: Array
    momentum: Array
    start: Array
    distance: float
    limit: Array

    @staticmethod
    def of(stand: Stand, options: QuietOptions) -> Wheels:
        """Wheels of a stand for some options. Raises UsageError: too few flywheels, momentum out of their axes' span.

        CheckError: the momentum needs more than the limits.
        """
        N = len(stand.flywheels)
        kept = np.eye(3) if stand.hold is None else _turning_rows(stand.hold)
        axes = kept @ momentum_axes(stand)
        left, sizes, right = np.linalg.svd(axes)
        rank = int(np.sum(sizes > RANK * sizes.max())) if sizes.size else 0
        if N == 1:
            raise UsageError(f"{stand.name}: one flywheel has nothing to cancel its unbalance; expected 2 or more")
        if rank >= N or N < 2:
            raise UsageError(
                f"{stand.name}: {N} flywheels with spin axes of rank {rank} leave no speeds free; "
                f"expected {max(rank + 1, 2)} or more"
            )
        nullspace = right[rank:].T
        given = None if options.speeds is None else np.array(options.speeds)
        momentum = axes @ given if options.momentum is None and given is not None else kept @ np.array(options.momentum)
        outside = float(np.linalg.norm(left[:, rank:].T @ momentum))
        if outside > 1e-9 * max(float(np.linalg.norm(momentum)), 1e-30):
            raise UsageError(
                f"{stand.name}: --momentum: {outside:.4g} N m s of it are perpendicular to all spin axes (rank "
                f"{rank}): no speeds hold it"
            )
        begin = np.zeros(N) if given is None else given
        start = begin + np.linalg.pinv(axes, rcond=RANK) @ (momentum - axes @ begin)
        moved = 0.0 if given is None else float(np.abs(start - given).max())
        names = tuple(s.name for s in stand.flywheels)
        found = Wheels(names, axes, nullspace, momentum, start, moved, speed_limits(stand, options))
        found.check_reach()
        return found

    def check_reach(self) -> None:
        """Check that some speeds within the limits hold the momentum. Raises CheckError."""
        least, speeds = self.least_load()
        if least > 1.0 + 1e-9:
            worst = int(np.argmax(np.abs(speeds) / self.limit))
            raise CheckError(
                f"momentum out of reach: it needs {least:.4g} times the speed limits, at best {self.names[worst]} at "
                f"{rpm(abs(speeds[worst])):.5g} rpm (limit {rpm(self.limit[worst]):.5g} rpm)"
            )

    def least_load(self) -> tuple[float, Array]:
        """The least t for which speeds |phi'_s| <= t limit_s hold the momentum, and those speeds."""
        finite = np.isfinite(self.limit)
        if not finite.any():
            return 0.0, self.start
        N = len(self.start)
        bound = np.where(finite, self.limit, 0.0)[finite]
        rows = np.eye(N)[finite]
        cost = np.append(np.zeros(N), 1.0)
        upper = np.vstack([np.column_stack([rows, -bound]), np.column_stack([-rows, -bound])])
        scale = float(np.abs(self.axes).max(initial=0.0)) or 1.0
        equal, right = np.column_stack([self.axes / scale, np.zeros(len(self.axes))]), self.momentum / scale
        free: Any = [(None, None)] * N + [(0.0, None)]
        found = linprog(cost, upper, np.zeros(len(upper)), equal, right, free, method="highs")
        if found.x is None:  # rank below 3: some rows depend on others, up to rounding
            return float((np.abs(self.start[finite]) / bound).max()), self.start
        return float(found.x[-1]), np.asarray(found.x[:N])


def _turning_rows(hold: Hold) -> Array:
    """Directions (r x 3, unit) in E1 of the freedoms that turn: along them wheels and carrier share momentum."""
    turns = twists(hold)[3:].T
    size = np.linalg.norm(turns, axis=1)
    return np.asarray(turns[size > 0.0] / size[size > 0.0, None])


def momentum_axes(stand: Stand) -> Array:
    """3 x N: spin inertia along the spin axis, in E1. The mean of I_s over phase, its angular part."""
    bodies = pieces(stand, rest_state(stand)).flywheels
    columns = [s.L[3:, 3:] @ f[3:] * float(f @ s.Theta @ f) for s in bodies]
    return np.column_stack(columns) if columns else np.zeros((3, 0))


def speed_limits(stand: Stand, options: QuietOptions) -> Array:
    """Speed limits (N, rad/s): the given limit, else the no-load speed of the motor, else none."""
    speeds = [np.inf if s.motor is None or s.motor.speed is None else s.motor.speed for s in stand.flywheels]
    own = np.array(speeds, dtype=np.float64)
    return own if options.limit is None else np.minimum(own, options.limit)


def rpm(speed: float) -> float:
    """Revolutions per minute, from rad/s."""
    return float(speed * 30.0 / np.pi)
