"""Jitter of a point at constant speeds of the flywheels: one set by harmonic balance, a sweep to first order.

A sweep solves the linear equations about the mean motion at every speed, with each flywheel's first order, and compares
with the full equations at some of the speeds; `exact` solves the full equations at all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError, UsageError
from mahovik.use.plan.array import Array
from mahovik.use.study.jitter.balance import Balance, balance
from mahovik.use.study.jitter.exact import exact_lines
from mahovik.use.study.jitter.lines import LineName, Lines
from mahovik.use.study.jitter.plant import Plant
from mahovik.use.study.jitter.quantity import Quantity, by_pose, find_quantity
from mahovik.use.study.linear.model import Place, places
from mahovik.use.study.response.scene import Scene
from mahovik.use.study.response.speeds import SpeedPlan

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

    speeds     (S, N; rad/s); value (S): the swept speed; phases (N, rad) at t = 0
    lines      L lines at S speeds
    method     "harmonic balance" or "first order"
    left_out   (S): largest remaining acceleration of the full equations, relative; NaN where not evaluated
    checks     full equations at some speeds of a sweep to first order
    hold       (6): constant wrench that keeps the mean place of a stand that is free to drift, largest over speeds
    order      largest sum of |k_s| of the harmonic balance, by speed
    problems   speeds without a steady state, and why
    """

    stand: Stand
    asked: SpeedPlan
    point: str
    quantity: str
    speeds: Array
    value: Array
    phases: Array
    lines: Lines
    method: str
    left_out: Array
    checks: tuple[Check, ...]
    hold: Array
    order: tuple[int, ...]
    problems: tuple[tuple[int, str], ...]
    interrupted: bool = False

    @property
    def measure(self) -> Quantity:
        """Unit and kind of the quantity."""
        return find_quantity(self.quantity)

    @property
    def swept(self) -> bool:
        """Whether a speed is swept."""
        return self.asked.sweep is not None

    @property
    def mean(self) -> Array:
        """(S, 3): constant part of the quantity."""
        constant = self.lines.frequency[:, :, None] == 0.0
        return np.asarray(np.where(constant, self.lines.amplitude.real, 0.0).sum(axis=1))


def jitter(
    stand: Stand,
    asked: SpeedPlan,
    steps: int,
    point: str,
    *,
    quantity: str = "angle",
    phases: Sequence[float] | None = None,
    order: int | None = None,
    exact: bool = False,
    go_on: Callable[[int], bool] = lambda done: True,
) -> Jitter:
    """Jitter at `steps` speeds (one without a sweep). `go_on` (speeds done) is called before each exact one.

    order    of the harmonic balance, the largest sum of |k_s|; None: raised until at most 1e-6 is left out
    exact    solve the full equations at every speed of a sweep

    Raises UsageError: unknown point or quantity. CheckError: no equilibrium, or no speed has a steady state.
    """
    find_quantity(quantity)
    place = places(stand, [point])[0]
    if order is not None and order < 1:
        raise UsageError(f"order {order}: expected a whole number of at least 1")
    value = np.array(asked.values(steps))
    speeds = np.array([asked.speeds(x) for x in value])
    start = np.zeros(speeds.shape[1]) if phases is None else np.array(phases, dtype=np.float64)
    study = _Study(Scene.of(stand), asked, place, quantity, speeds, value, start, order)
    if len(value) == 1 or exact:
        return study.exact(go_on)
    return study.first_order(go_on)


@dataclass(frozen=True, eq=False)
class _Study:
    scene: Scene
    asked: SpeedPlan
    place: Place
    quantity: str
    speeds: Array
    value: Array
    phases: Array
    order: int | None

    def _balance(self, i: int) -> Balance:
        return balance(self.scene, self.speeds[i].tolist(), self.phases.tolist(), self.order)

    def exact(self, go_on: Callable[[int], bool]) -> Jitter:
        """The full equations at every speed. Raises CheckError if there is a steady state at none."""
        found: list[tuple[Balance, Lines] | None] = []
        problems: list[tuple[int, str]] = []
        try:
            for i in range(len(self.value)):
                if not go_on(i):
                    break
                try:
                    one = self._balance(i)
                    found.append((one, exact_lines(one, self.place, self.quantity, self.phases)))
                except CheckError as error:
                    problems.append((i, str(error)))
                    found.append(None)
        except KeyboardInterrupt:
            pass
        good = [each for each in found if each is not None]
        if found and not good:
            raise CheckError(problems[0][1])
        left = np.array([np.nan if each is None else each[0].left_out for each in found])
        hold = max((b.hold for b, _ in good), key=lambda w: float(np.abs(w).max()), default=np.zeros(6))
        orders = tuple(0 if each is None else each[0].order for each in found)
        lines = _together([None if each is None else each[1] for each in found])
        return self._result(lines, "harmonic balance", left, (), hold, orders, tuple(problems))

    def first_order(self, go_on: Callable[[int], bool]) -> Jitter:
        """The linear equations at every speed, compared with the full ones at some."""
        lines = self.linear_lines()
        total = np.linalg.norm(lines.rms(), axis=1)
        S = len(self.value)
        worst = int(np.nanargmax(np.where(np.isfinite(total), total, -1.0)))
        chosen = sorted({worst, *np.linspace(0, S - 1, CHECKED).astype(int).tolist()})
        left, checks, hold = np.full(S, np.nan), [], np.zeros(6)
        problems, interrupted = [], False
        try:
            for n, i in enumerate(chosen):
                if not go_on(n):
                    interrupted = True
                    break
                try:
                    one = self._balance(i)
                except CheckError as error:
                    problems.append((i, str(error)))
                    continue
                left[i] = one.left_out
                size = float(np.linalg.norm(exact_lines(one, self.place, self.quantity, self.phases).rms()))
                off = abs(float(total[i]) - size) / size if size else 0.0
                checks.append(Check(i, one.left_out, off))
                hold = max(hold, one.hold, key=lambda w: float(np.abs(w).max()))
        except KeyboardInterrupt:
            interrupted = True
        return self._result(lines, "first order", left, tuple(checks), hold, (1,) * S, tuple(problems), interrupted)

    def linear_lines(self) -> Lines:
        """First orders of all flywheels to first order in unbalance, at all speeds."""
        plant = Plant.of(self.scene)
        omega, wrench = plant.unbalance(self.speeds, self.phases)
        still = omega == 0.0
        pose = plant.pose(self.speeds, np.where(still, 1.0, omega), wrench[..., None])[..., 0]
        pose[still] = 0.0
        names = tuple(LineName(s.name, 1.0) for s in self.scene.stand.flywheels)
        return Lines(names, omega / (2.0 * np.pi), by_pose(self.place, self.quantity, pose, omega))

    def _result(
        self,
        lines: Lines,
        method: str,
        left: Array,
        checks: tuple[Check, ...],
        hold: Array,
        order: tuple[int, ...],
        problems: tuple[tuple[int, str], ...],
        interrupted: bool = False,
    ) -> Jitter:
        S = len(lines.frequency)
        return Jitter(
            self.scene.stand, self.asked, self.place.name, self.quantity, self.speeds[:S], self.value[:S], self.phases,
            lines, method, left, checks, hold, order, problems, interrupted or len(self.value) > S,
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
