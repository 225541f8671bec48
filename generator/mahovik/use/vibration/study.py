"""Jitter of a point at constant speeds of the flywheels: one set by harmonic balance, a sweep to first order.

A sweep solves the linear equations about the mean motion at every speed, with each flywheel's first order, and compares
with the full equations at some of the speeds; `exact` solves the full equations at all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError, whole_number
from mahovik.use.numeric import Array
from mahovik.use.vibration.balance import Balance, balance
from mahovik.use.vibration.campbell import orders_of
from mahovik.use.vibration.chain import Chain, Makers, undamped_mode
from mahovik.use.vibration.exact import constant_load, exact_lines, left_out_of, rounding_of
from mahovik.use.vibration.lines import CONSTANT, UNBALANCE, LineName, Lines
from mahovik.use.vibration.noise import Broadband, broadband
from mahovik.use.vibration.peaks import ROUNDS, merged, resonances, unsettled
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.speeds import SpeedPlan
from mahovik.use.vibration.view import LoadView, Observable, Quantity

TOO_MUCH = 0.01
"""Part of the worst case that may be left out without a warning."""

CHECKED = 4
"""Speeds of a sweep at which the full equations are solved, beside the worst."""


class Check(NamedTuple):
    """The full equations at one speed of a sweep: index of the speed, what they leave out, and how far the RMS is off.

    off   difference of the RMS (root of the sum of squares over the axes) to first order, as a part of the exact one
    """

    step: int
    left_out: float
    off: float


@dataclass(frozen=True, eq=False)
class Jitter:
    """Lines at a point over S speeds.

    seen       the point and quantity; chain: what the wheels' wrenches drive, with the makers' tables
    noise      broadband part, of the worst speed (by the lines)
    speeds     (S, N; rad/s); value (S): the swept speed; phases (N, rad) at t = 0
    lines      L lines at S speeds
    method     "harmonic balance" or "first order"
    left_out   (S): largest remaining acceleration of the full equations at random phases, relative; NaN where not found
    remainder  (S, 3): sum of amplitudes of the quantity's lines that the balance leaves out; NaN where not found
    checks     full equations at some speeds of a sweep to first order
    hold       (6): constant wrench that keeps the mean place of a stand that is free to drift, largest over speeds
    order      largest sum of |k_s| of the harmonic balance, by speed
    problems   speeds without a steady state or with an inaccurate one, and why; no requirement is met there
    """

    stand: Stand
    asked: SpeedPlan
    seen: Observable
    chain: Chain
    speeds: Array
    value: Array
    phases: Array
    lines: Lines
    noise: Broadband | None
    method: str
    left_out: Array
    remainder: Array
    checks: tuple[Check, ...]
    hold: Array
    order: tuple[int, ...]
    problems: tuple[tuple[int, str], ...]
    interrupted: bool = False

    @property
    def point(self) -> str:
        """Name of the point, or of the table of sensitivities."""
        return self.seen.name

    @property
    def quantity(self) -> str:
        """Name of the quantity."""
        return self.seen.quantity

    @property
    def measure(self) -> Quantity:
        """Unit and kind of the quantity."""
        return self.seen.measure

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the axes of the quantity; of three columns of values the first, where it has fewer."""
        return self.seen.axes

    @property
    def swept(self) -> bool:
        """Whether a speed is swept."""
        return self.asked.sweep is not None

    @property
    def mean(self) -> Array:
        """(S, 3): constant part of the quantity."""
        constant = self.lines.frequency[:, :, None] == 0.0
        return np.asarray(np.where(constant, self.lines.amplitude.real, 0.0).sum(axis=1))

    def sums(self, band: tuple[float, float] = (0.0, np.inf)) -> dict[str, Array]:
        """rms, rss, worst within a band (Hz), mean (S, 3 each), by name; NaN where there is no steady motion.

        Noise is in the first two, three times its RMS in `worst`.
        """
        lines, noise = self.lines.of_band(band), self.noise
        square = 0.0 if noise is None else noise.mean_square(band[1]) - noise.mean_square(band[0])
        return {
            "rms": np.sqrt(lines.rms() ** 2 + square),
            "rss": np.sqrt(lines.rss() ** 2 + square),
            "worst": lines.worst() + 3.0 * np.sqrt(square),
            "mean": self.mean,
        }

    @property
    def toleranced(self) -> Jitter:
        """This jitter with the largest amplitudes that the makers' tolerances allow."""
        return replace(self, lines=self.lines.with_tolerances())

    @property
    def worst_step(self) -> int:
        """The speed of the largest RMS over all phases (root of the sum of squares of the axes)."""
        return _largest(self.lines)


def _largest(lines: Lines) -> int:
    total = np.linalg.norm(lines.rss(), axis=1)
    return int(np.argmax(np.where(np.isfinite(total), total, -1.0)))


def jitter(
    stand: Stand,
    asked: SpeedPlan,
    steps: int,
    seen: Observable,
    *,
    phases: Sequence[float] | None = None,
    makers: Makers | None = None,
    order: int | None = None,
    exact: bool = False,
    go_on: Callable[[int, int], bool] = lambda done, planned: True,
) -> Jitter:
    """Jitter at `steps` speeds (one without a sweep). `go_on` (exact ones done, planned) is called before each
    exact one.

    makers   tables of the wheels' disturbances and of structural modes; an order in a wheel's table replaces its own
    order    of the harmonic balance, the largest sum of |k_s|; None: raised until at most 1e-6 is left out
    exact    solve the full equations at every speed of a sweep

    Raises UsageError, JitterFileError: a mode shape is missing. CheckError: no equilibrium, or no speed has a steady
    state.
    """
    if order is not None:
        whole_number("order", order, 1, 20)
    value = np.array(asked.values(steps))
    fastest = np.abs(asked.rows(value)).max(axis=0)
    start = np.zeros(len(fastest)) if phases is None else np.array(phases, dtype=np.float64)
    scene = Scene.of(stand)
    chain = Chain.of(scene, seen, makers or Makers(), fastest)
    if asked.sweep is not None:
        tables = chain.makers.harmonics
        orders = [
            {*orders_of(scene), *tables[name].order} if name in tables else orders_of(scene) for name in asked.names
        ]
        value = merged(asked, value, resonances(scene, asked, steps, orders, chain.modes))
        for _ in range(ROUNDS):
            more = merged(asked, value, unsettled(value, _Study(scene, asked, chain, value, start, order).sizes()))
            if len(more) == len(value):
                break
            value = more
    study = _Study(scene, asked, chain, value, start, order)
    if len(value) == 1 or exact:
        return study.exact(go_on)
    return study.first_order(go_on)


@dataclass(frozen=True, eq=False)
class _Study:
    scene: Scene
    asked: SpeedPlan
    chain: Chain
    value: Array
    phases: Array
    order: int | None

    @property
    def speeds(self) -> Array:
        """Speeds (S, N; rad/s)."""
        return self.asked.rows(self.value)

    def sizes(self) -> Array:
        """RMS (S) over all phases to first order, root of the sum of squares over the axes; NaN at a resonance."""
        lines = self.linear_lines().join(self.chain.table_lines(self.speeds))
        return np.where(lines.is_finite, np.linalg.norm(lines.rss(), axis=1), np.nan)

    def _balance(self, i: int) -> Balance:
        return balance(self.scene, self.speeds[i].tolist(), self.phases.tolist(), self.order)

    def _exact_lines(self, found: Balance) -> Lines:
        return self._drop_tabled(exact_lines(found, self.chain.seen, self.phases, self.chain))

    def _drop_tabled(self, lines: Lines) -> Lines:
        """Lines without those that a maker's table replaces."""
        tables = self.chain.makers.harmonics
        which = [
            name.source != UNBALANCE or name.wheel not in tables or name.order not in tables[name.wheel].order
            for name in lines.names
        ]
        return lines.select(np.array(which, dtype=bool))

    def exact(self, go_on: Callable[[int, int], bool]) -> Jitter:
        """The full equations at every speed. Raises CheckError if there is a steady state at none."""
        found: list[tuple[Balance, Lines] | None] = []
        problems: list[tuple[int, str]] = []
        try:
            for i in range(len(self.value)):
                if not go_on(i, len(self.value)):
                    break
                try:
                    one = self._balance(i)
                    found.append((one, self._exact_lines(one)))
                except CheckError as error:
                    problems.append((i, str(error)))
                    found.append(None)
        except KeyboardInterrupt:
            if not found:
                raise
        good = [each for each in found if each is not None]
        if found and not good:
            raise CheckError(problems[0][1])
        left = np.array([np.nan if each is None else each[0].left_out for each in found])
        remainder = np.full((len(found), 3), np.nan)
        for i, each in enumerate(found):
            if each is not None:
                remainder[i] = left_out_of(each[0], self.chain.seen)
                problems += self._inaccuracy(i, each[0], each[1], remainder[i])
        hold = max((b.hold for b, _ in good), key=lambda w: float(np.abs(w).max()), default=np.zeros(6))
        orders = tuple(0 if each is None else each[0].order for each in found)
        lines = _together([None if each is None else each[1] for each in found])
        return self._result(lines, "harmonic balance", left, remainder, (), hold, orders, tuple(problems))

    def _inaccuracy(self, i: int, found: Balance, lines: Lines, remainder: Array) -> list[tuple[int, str]]:
        """A problem if too much is left out at a speed, or it is not known how much."""
        worst, left = float(np.linalg.norm(lines.worst()[0])), float(np.linalg.norm(remainder))
        known = np.isfinite(remainder).all()
        if left <= rounding_of(found, self.chain.seen):
            return []
        share = (left / worst if worst else 0.0) if known else found.left_out
        if share <= TOO_MUCH or not np.isfinite(worst):
            return []
        of = self.chain.seen.quantity if known else "acceleration"
        why = f" ({found.short})" if found.short else ""
        return [(i, f"inaccurate: harmonic balance of order {found.order} leaves out {share:.2g} of the {of}{why}")]

    def _resonances(self, lines: Lines, besides: set[int]) -> list[tuple[int, str]]:
        """Speeds at which a line has no finite amplitude, and why."""
        found = []
        for i in np.flatnonzero(~lines.is_finite).tolist():
            if i not in besides:
                at = np.flatnonzero(~np.isfinite(lines.amplitude[i]).all(axis=1))[0]
                hertz = float(lines.frequency[i, at])
                mode = undamped_mode(self.chain.makers, self.chain.names, self.speeds[i], 2.0 * np.pi * hertz)
                what = f"{mode}: expected a damping above 0" if mode else "the stand itself: expected some damping"
                found.append((i, f"line {lines.names[at].text} at {hertz:.6g} Hz is an undamped resonance of {what}"))
        return found

    def first_order(self, go_on: Callable[[int, int], bool]) -> Jitter:
        """The linear equations at every speed, compared with the full ones at some."""
        own = self.linear_lines()
        total = np.linalg.norm(own.rms(), axis=1)
        S = len(self.value)
        worst = int(np.nanargmax(np.where(np.isfinite(total), total, -1.0)))
        chosen = sorted({worst, *np.linspace(0, S - 1, CHECKED).astype(int).tolist()})
        left, checks, hold = np.full(S, np.nan), [], np.zeros(6)
        problems, interrupted = [], False
        try:
            for n, i in enumerate(chosen):
                if not go_on(n, len(chosen)):
                    interrupted = True
                    break
                try:
                    one = self._balance(i)
                except CheckError as error:
                    problems.append((i, str(error)))
                    continue
                left[i] = one.left_out
                if not np.isfinite(total[i]):
                    continue
                size = float(np.linalg.norm(exact_lines(one, self.chain.seen, self.phases, self.chain).rms()))
                off = abs(float(total[i]) - size) / size if size else 0.0
                checks.append(Check(i, one.left_out, off))
                hold = max(hold, one.hold, key=lambda w: float(np.abs(w).max()))
        except KeyboardInterrupt:
            interrupted = True
        lines = self._drop_tabled(own)
        return self._result(
            lines,
            "first order",
            left,
            np.full((S, 3), np.nan),
            tuple(checks),
            hold,
            (1,) * S,
            tuple(problems),
            interrupted,
        )

    def linear_lines(self) -> Lines:
        """First orders of all flywheels to first order in unbalance, at all speeds."""
        chain, plant = self.chain, self.chain.plant
        omega, wrench = plant.unbalance(self.speeds, self.phases)
        still = omega == 0.0
        positive = np.where(still, 1.0, omega)
        motion = chain.by_unbalance(self.speeds, positive, wrench)
        a = chain.seen.linear(motion)[..., 0]
        if chain.one_way:
            mounts = chain.mounts(self.speeds, positive, motion.pose[..., 0])
            each = np.arange(wrench.shape[1])
            mounts[:, each, each] += wrench
            a += chain.driven_amplitudes(self.speeds, positive, mounts)
        a[still] = 0.0
        names = tuple(LineName(s.name, 1.0) for s in self.scene.stand.flywheels)
        return Lines(names, omega / (2.0 * np.pi), a).join(self._constant())

    def _constant(self) -> Lines:
        """The constant part at all speeds: a load has one without any motion."""
        S, seen = len(self.value), self.chain.seen
        if not isinstance(seen, LoadView):
            return Lines((), np.zeros((S, 0)), np.zeros((S, 0, 3), dtype=np.complex128))
        found = [constant_load(self.scene, seen, each, self.phases) for each in self.speeds]
        return Lines((CONSTANT,), np.zeros((S, 1)), np.array(found, dtype=np.complex128)[:, None])

    def _result(
        self,
        lines: Lines,
        method: str,
        left: Array,
        remainder: Array,
        checks: tuple[Check, ...],
        hold: Array,
        order: tuple[int, ...],
        problems: tuple[tuple[int, str], ...],
        interrupted: bool = False,
    ) -> Jitter:
        S = len(lines.frequency)
        if S:
            lines = lines.join(self.chain.table_lines(self.speeds[:S]))
            problems = tuple(sorted((*problems, *self._resonances(lines, {i for i, _ in problems}))))
            lines = lines.clear(np.flatnonzero(~lines.is_finite).tolist())
            if not lines.is_finite.any():
                raise CheckError(problems[0][1])
        noise = broadband(self.chain, self.speeds[_largest(lines)]) if S else None
        return Jitter(
            self.scene.stand, self.asked, self.chain.seen, self.chain, self.speeds[:S], self.value[:S], self.phases,
            lines, noise, method, left, remainder, checks, hold, order, problems, interrupted or len(self.value) > S,
        )  # fmt: skip


def _together(found: list[Lines | None]) -> Lines:
    """Lines of single speeds as one table; NaN where a speed has no steady state, 0 where the line is missing."""
    names: dict[LineName, int] = {}
    for each in found:
        for name in each.names if each is not None else ():
            names.setdefault(name, len(names))
    frequency = np.zeros((len(found), len(names)))
    amplitude = np.zeros((len(found), len(names), 3), dtype=np.complex128)
    for i, each in enumerate(found):
        if each is None:
            amplitude[i] = np.nan
            frequency[i] = np.nan
            continue
        at = [names[name] for name in each.names]
        frequency[i, at], amplitude[i, at] = each.frequency[0], each.amplitude[0]
    return Lines(tuple(names), frequency, amplitude)
