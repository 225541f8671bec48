"""Harmonic balance of the carrier's motion over the phases of all flywheels, at any constant speeds: (8) in full.

The state about rest is a function on a torus, y(theta), one phase theta_s per flywheel that turns. It obeys

    sum_s phi_s' dy/dtheta_s = y'(theta, y),

so that coefficient k obeys i k . phi' y_k = [y'(theta, y)]_k. Newton's method; its linear equations are solved by
GMRES, preconditioned by their mean over all phases. Kept are all k up to an order. Where nothing outside acts, momentum
takes the place of (8), see `conserved`. What the others would add is measured twice: the accelerations that the literal
reference (8) finds along the motion at random phases differ by `left_out`; and `missing` is the motion, to first order,
by the lines that the equations still have up to MORE higher orders.

Directions without a restoring force are kept from drifting: of all motions the one is found whose mean pose is that of
rest and whose mean rotation is zero, for any phases. Where momentum is conserved nothing is needed for that.

The coordinates are those of the freedoms, see `scene`. A clamped carrier has no motion, and its reaction is all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError
from mahovik.use.numeric.residual import Drive
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.conserved import Conserved, conserves, solve
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.torus import Linearised, Torus, Whole
from mahovik.use.vibration.torus_motion import ROUNDING, Balance, left_out, rounding_rates

__all__ = ["Balance", "balance"]

STEPS = 20
SETTLED = 1e-11
"""Relative size of a last step of Newton's method."""

SMALL = 0.01
"""Part of a settled step that its linear equations may be off: more accuracy changes nothing."""

SAME = 0.1
"""The linear equations serve for further steps as long as each step is at most this part of the one before."""

LARGEST = 2.0
"""rad: limit near the edge of the chart."""

SLOW = 1e-9
"""Part of the fastest speed below which a combination k . phi' is a constant, as of two flywheels of one speed."""

ENOUGH = 1e-6
"""Accelerations left out, relative, at which no higher order is tried."""

ENOUGH_POSE = 1e-4
"""Pose left out, relative, likewise: slow beats of higher orders move far with small accelerations."""

MORE = 2
"""Orders above the kept ones whose remaining lines are found."""

FIRST, HIGHEST = 2, 8
"""Orders tried without a given one."""


def balance(
    stand: Stand | Scene,
    speeds: Sequence[float],
    phases: Sequence[float] | None = None,
    order: int | None = None,
) -> Balance:
    """The motion at constant `speeds` (N, rad/s), for all phases of the flywheels that turn.

    stand    or its Scene, for many speeds
    phases   (N, rad): only of those at rest
    order    largest sum of |k_s|; None: raised until at most ENOUGH is left out or it no longer helps

    Raises CheckError: no equilibrium, or no motion is found.
    """
    scene = Scene.of(stand) if isinstance(stand, Stand) else stand
    N = len(scene.stand.flywheels)
    start = np.zeros(N) if phases is None else np.array(phases, dtype=np.float64)
    search = _Search(scene, np.array(speeds, dtype=np.float64), start)
    if order is not None:
        return search.at(order)
    result = search.at(FIRST)
    for higher in range(FIRST + 1, HIGHEST + 1):
        if result.left_out <= ENOUGH and result.pose_left_out <= ENOUGH_POSE:
            return result
        try:
            result = search.at(higher)
        except CheckError as error:
            return replace(result, short=str(error))
    return result


class Solved(NamedTuple):
    """States c (n, 2 m) and constant numbers h (n, f) on a torus, and the last linear equations."""

    c: Complex
    h: Complex
    linear: Linearised


def newton(
    scene: Scene, torus: Torus, drive: Drive, w: Array, slow: Whole, start: Complex, rounding: Array, fastest: float
) -> Solved | None:
    """The motion at frequencies w (n; rad/s), constant at `slow`, from states `start` (n, 2 m); None: not found.

    drive      sums of the flywheels at the nodes; rounding (m): rates of the speeds in a state that count as none
    fastest    speed of a flywheel, rad/s
    """
    f, m = scene.free.shape[1], scene.count
    push = scene.effect_of_wrench(drive)
    c, h = start, np.zeros((len(torus.k), f), dtype=np.complex128)
    size = np.repeat([1.0, fastest], m)
    least = (ROUNDING + scene.noise) / fastest**2
    linear, before = None, np.inf
    if not m:  # clamped
        return Solved(c, h, Linearised(torus, np.zeros((torus.M, 0, 0)), push, scene.free_displacement, w, slow, size))
    for _ in range(STEPS):
        y = torus.values(c)
        if not np.all(np.isfinite(y)) or np.abs(scene.whole(y)[:, 3:6]).max() > LARGEST:
            return None
        rate = scene.chart.rate(drive, y) + (push @ torus.values(h)[:, :, None])[:, :, 0]
        left = torus.coefficients(rate) - 1j * w[:, None] * c
        if linear is not None and np.all(np.abs(left[:, m:]) <= rounding):
            return Solved(c, h, linear)
        if linear is None:
            linear = Linearised(torus, scene.chart.jacobian(drive, y), push, scene.free_displacement, w, slow, size)
        settled = SETTLED * np.abs(c / size).max() + least
        step = linear.solve(left, c, SMALL * settled)
        if step is None:
            return None
        c, h = c + step[0], h + step[1]
        change = np.abs(step[0] / size).max()
        if change <= SETTLED * np.abs(c / size).max() + least:
            return Solved(c, h, linear)
        if change > SAME * before:  # the linear equations of an earlier step help little here
            linear = None
        before = change
    return None


class _Search:
    """Newton's method at one order after the other, each from the last."""

    def __init__(self, scene: Scene, speeds: Array, phases: Array) -> None:
        self.scene, self.speeds, self.phases = scene, speeds, phases
        self.turning = tuple(int(s) for s in np.flatnonzero(speeds))
        self.fastest = float(np.abs(speeds).max(initial=0.0)) or 1.0
        self.before: tuple[Torus, Complex] | None = None
        self.conserves = scene.stand.hold is None and conserves(scene)
        self.rounding = rounding_rates(scene, speeds)

    def at(self, order: int) -> Balance:
        """The motion at an order. Raises CheckError."""
        torus = Torus.of(len(self.turning), order)
        w, slow = self._frequencies(torus)
        if self.conserves:
            return self._by_momentum(order, torus, w, slow)
        drive = self._drive(torus.nodes)
        solved = newton(self.scene, torus, drive, w, slow, self._start(torus), self.rounding, self.fastest)
        if solved is None:
            raise self._failure(order)
        self.before = torus, solved.c
        return self._with_missing(self._result(order, torus, solved.c, solved.h), solved.linear, solved.h)

    def _by_momentum(self, order: int, torus: Torus, w: Array, slow: Whole) -> Balance:
        """The motion of a stand that keeps its momentum. Raises CheckError."""
        conserved = Conserved.of(torus, self._drive(torus.nodes))
        motion = solve(conserved, w, slow, self._start(torus)[:, 3:6])
        if motion is None:
            raise self._failure(order)
        x, c = conserved.state(motion.r, motion.L, slow)
        self.before = torus, c
        result = self._result(order, torus, c, np.zeros((len(w), 6), dtype=np.complex128))
        larger = self._larger(order)
        if larger is None:
            return result
        w, slow = self._frequencies(larger)
        beyond = Conserved.of(larger, self._drive(larger.nodes))
        missing = beyond.remainder(motion.r, motion.L, x, w, slow, motion.near)
        velocities = 1j * w[:, None] * missing
        return _with(result, np.concatenate([missing, velocities], axis=1), w, slow, order + MORE)

    def _with_missing(self, balance: Balance, linear: Linearised, h: Complex) -> Balance:
        """A motion with what it leaves out of (8)."""
        larger = self._larger(balance.order)
        if larger is None:
            return balance
        w, slow = self._frequencies(larger)
        inverse = linear.inverse(w, slow)
        if inverse is None:
            return balance
        c, held, m = larger.pad(balance.c), larger.pad(h), self.scene.count
        drive = self._drive(larger.nodes)
        rate = self.scene.chart.rate(drive, larger.values(c))
        rate += (self.scene.effect_of_wrench(drive) @ larger.values(held)[:, :, None])[:, :, 0]
        left = larger.coefficients(rate) - 1j * w[:, None] * c
        missing = (inverse[:, : 2 * m, : 2 * m] @ left[:, :, None])[:, :, 0]
        return _with(balance, missing, w, slow, balance.order + MORE)

    def _larger(self, order: int) -> Torus | None:
        """The torus of the orders whose remaining lines are found; None: too many nodes."""
        try:
            return Torus.of(len(self.turning), order + MORE)
        except CheckError:
            return None

    def _frequencies(self, torus: Torus) -> tuple[Array, Whole]:
        """k . phi' (n; rad/s) and the places of those that are constant."""
        w = torus.frequencies(self.speeds[list(self.turning)])
        return w, np.flatnonzero(np.abs(w) <= SLOW * self.fastest)

    def _failure(self, order: int) -> CheckError:
        given_text = ", ".join(f"{x:.6g}" for x in self.speeds)
        return CheckError(
            f"{self.scene.stand.name} at speeds {given_text} rad/s: no steady motion found to order {order}: an "
            "undamped resonance, a carrier that moves too violently, or a beat too slow to be resolved"
        )

    def _start(self, torus: Torus) -> Complex:
        c = np.zeros((len(torus.k), 2 * self.scene.count), dtype=np.complex128)
        if self.before is not None:
            c[: len(self.before[1])] = self.before[1]  # indices are sorted by size
        return c

    def _drive(self, theta: Array) -> Drive:
        phi = np.tile(self.phases, (len(theta), 1))
        phi[:, list(self.turning)] = theta
        return self.scene.drive(phi, np.tile(self.speeds, (len(theta), 1)))

    def _result(self, order: int, torus: Torus, c: Complex, h: Complex) -> Balance:
        hold = self.scene.wrench @ h[0].real
        balance = Balance(self.scene, torus, order, self.speeds, self.phases, self.turning, c, h, hold, 0.0)
        pose, speeds = np.split(c, 2, axis=1)
        moving = (torus.k != 0).any(axis=1)
        rates = np.maximum(np.abs(balance.frequencies[:, None] * pose), np.abs(speeds))[moving]
        if np.all(rates <= self.rounding / self.fastest):  # nothing moves the carrier
            balance = replace(balance, c=np.where(moving[:, None], 0.0, c))
        return replace(balance, left_out=left_out(balance))


def _with(balance: Balance, missing: Complex, w: Array, slow: Whole, order: int) -> Balance:
    m, w = balance.scene.count, w.copy()
    w[slow] = 0.0
    if not balance.c[
        (balance.torus.k != 0).any(axis=1)
    ].any():  # the flywheels' wrenches have no orders above those kept
        missing = np.zeros_like(missing)
    pose = missing[:, :m] @ balance.scene.twist(np.eye(m))
    return replace(balance, missing=pose, missing_c=missing, missing_w=w, missing_order=order)
