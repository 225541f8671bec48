"""Starts of a search: winding numbers to try, and many starts at once, scored, given harmonics and improved.

Windings decide whether there is a programme, the main choice of planning. Flywheels turn with the common period of the
motion (`spin`, +-1), rock about a mean angle (`rock`, 0), or some turn and some rock (`mixed`). They never turn with
the highest of several harmonics: unbalance forces grow with the speed squared, and the surplus must cancel among the
wheels. A motion is planned over its shortest period: harmonics with a common divisor repeat themselves within the
given one.

Mean angles are random, at constant speed. The linear model of (12) in a few harmonics shows how near a programme is:
the least sum of squared residual and damped amplitude. Rocking starts differ by the amplitude alone, spinning ones by
both.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.functions import Angles, Harmonics
from mahovik.core.motion.required import RequiredMotion
from mahovik.use.numeric.residual import Linear, linear, prescribe
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.outcome import Budget
from mahovik.use.plan.problem import FlywheelMotion, Problem

Kind = Literal["spin", "rock", "mixed", "given", "finite", "followed"]
"""Kinds of starts: windings of a periodic motion; of a finite one drawn angles, or motions that follow (12) in time."""

_SLOW = 4
"""Periods of the lowest harmonic in the motion's period from which on rocking is tried first."""


def unit_turns(motion: RequiredMotion) -> int:
    """Turns per period that count as one: the greatest common divisor of the motion's harmonics."""
    return math.gcd(*motion.harmonics) or 1


def kinds_in_order(motion: RequiredMotion, N: int, rows: int = 6) -> tuple[Kind, ...]:
    """Kinds of winding, in the order to try them. Seven or fewer spinning flywheels mostly cross det I = 0: rock first.

    Seven is one more than the rows of (12); a held carrier has a row for each freedom.

    Rocking is also first if the lowest harmonic is high.

    A kind that the bounds of speed forbid for all flywheels is left out.
    """
    if isinstance(motion.winding, tuple):
        return ("given",)
    if motion.winding != "any":
        return (motion.winding,)
    slow = min(motion.harmonics, default=1) >= _SLOW * unit_turns(motion)  # turning once per period would be very slow
    kinds: tuple[Kind, ...] = ("spin", "rock", "mixed") if N - rows >= 2 and not slow else ("rock", "spin", "mixed")
    able = [allowed_windings("mixed", motion, s) for s in range(N)]
    if all(0 not in turns for turns in able):
        return ("spin",)
    if all(turns == (0,) for turns in able):
        return ("rock",)
    return kinds


def allowed_windings(kind: Kind, motion: RequiredMotion, s: int) -> tuple[int, ...]:
    """Windings that flywheel s may have in a kind, inside the bounds of speed; another kind's if it may have none.

    The mean speed lies between least and greatest speed; a flywheel that must not stop does not rock.
    """
    bounds, turn = motion.bounds, unit_turns(motion)
    least = bounds.speed_min[s] if bounds.speed_min is not None else 0.0
    turn *= max(1, math.ceil(least * motion.span / (2.0 * math.pi * turn) - 1e-9))
    fast = bounds.speed is not None and 2.0 * math.pi * turn / motion.span > bounds.speed[s]
    rock: tuple[int, ...] = (0,) if least == 0.0 else ()
    spin: tuple[int, ...] = (-turn, turn) if not fast or not rock else ()
    if kind == "mixed":
        return (spin[:1] + rock + spin[1:]) if spin else rock
    return (rock or spin) if kind == "rock" else (spin or rock)


def draw_windings(kind: Kind, motion: RequiredMotion, N: int, K: int, rng: np.random.Generator) -> Array:
    """Random winding numbers (K, N) of K starts."""
    if kind == "given":
        return np.tile(np.array(motion.winding, dtype=np.float64), (K, 1))
    choices = [np.array(allowed_windings(kind, motion, s), dtype=np.float64) for s in range(N)]
    return np.stack([rng.choice(choice, size=K) for choice in choices], axis=1) if N else np.zeros((K, 0))


def with_shortest_period(motion: RequiredMotion) -> RequiredMotion:
    """The motion with its shortest period; unchanged if the windings do not repeat with it."""
    course, times = motion.course, unit_turns(motion)
    if not motion.periodic or not isinstance(course, Harmonics) or times == 1:
        return motion
    winding = motion.winding
    if isinstance(winding, tuple):
        if any(n % times for n in winding):
            return motion
        winding = tuple(n // times for n in winding)
    span = motion.span / times
    there = [row for row, k in enumerate(course.k) if k % times == 0]  # other harmonics have no amplitude
    k = tuple(course.k[row] // times for row in there)
    short = Harmonics(span, k, course.cos[there], course.sin[there])
    return replace(motion, span=span, winding=winding, course=short)


def repeat_motion(motion: FlywheelMotion, times: int) -> FlywheelMotion:
    """The same flywheel motion over a period `times` as long."""
    k, waves = np.arange(1, motion.H + 1), np.zeros((motion.N, 2 * motion.H * times + 1))
    waves[:, 0] = motion.mean
    for sine in (0, 1):
        waves[:, 2 * k * times - 1 + sine] = motion.waves[:, 2 * k - 1 + sine]
    return replace(motion, span=motion.span * times, winding=motion.winding * times, waves=waves)


Numbers = NDArray[np.intp]

_AMPLITUDE = 1e-2
"""Squared residual that a wave of 1 rad is worth in the score."""
_TURN = 1.0  # rad: limit of the change of an angle in a step
_PARTS = ("by_phi", "by_phi_dot", "by_phi_ddot")


class StartBatch:
    """K motions at the same M times and with the same bias.

    windings (K, N), waves (K, N, n) as in `FlywheelMotion`, lam (K): damping of each motion.
    """

    def __init__(self, problem: Problem, windings: Array, waves: Array, bias: Array) -> None:
        self.problem, self.bias = problem, bias
        self.windings, self.waves = windings.astype(np.float64), waves
        self.K, self.N, n = waves.shape
        highest = max(problem.highest, int(np.abs(windings).max(initial=0)))
        self.M = 2 * (2 * highest + (n // 2 if problem.motion.periodic else n - 1)) + 4
        self.grid = problem.grid(self.M, n)
        self.lam = np.full(self.K, 1e-2)
        self.at = prescribe(problem.mechanics, self.grid.course, bias).repeat(self.K)
        self.now = self.linear(self.waves)

    def angles(self, waves: Array) -> Angles:
        """Angles of all motions (K M, N)."""
        rate = 2.0 * np.pi / self.problem.motion.span * self.windings[:, None, :]
        turned = self.grid.t[None, :, None] * rate
        phi, phi_dot, phi_ddot = (B @ np.swapaxes(waves, 1, 2) for B in self.grid.basis.matrices)
        return Angles(*(x.reshape(-1, self.N) for x in (phi + turned, phi_dot + rate, phi_ddot)))

    def linear(self, waves: Array) -> Linear:
        """(12) with its derivatives, for all motions."""
        return linear(self.at, *self.angles(waves))

    def rows(self, linear: Linear) -> Array:
        """Scaled residual (K, 6 M); the sum of its squares is the mean over the times."""
        return np.asarray(self.problem.norm.dimensionless(linear.R).reshape(self.K, -1) / np.sqrt(self.M))

    def jacobian(self, linear: Linear) -> Array:
        """Derivatives (K, 6 M, N n) of the rows by the waves."""
        root = self.problem.norm.root / (self.problem.norm.demand * np.sqrt(self.M))
        local = np.stack([root @ getattr(linear, name) for name in _PARTS], axis=-1)
        rows = self.problem.rows_count
        J = local.reshape(self.K, self.M, rows * self.N, 3) @ np.stack(self.grid.basis.matrices, axis=1)
        return np.asarray(J.reshape(self.K, rows * self.M, -1))

    def improve(self, steps: int, budget: Budget) -> None:
        """Levenberg-Marquardt on all motions, each with its own damping, lambda (1 + k^2)."""
        rows = self.rows(self.now)
        weight = np.tile(1.0 + self.grid.basis.orders**2, self.N)
        n = len(weight)
        for _ in range(steps):
            if not budget.step():
                return
            J = self.jacobian(self.now)
            A = np.swapaxes(J, 1, 2) @ J
            A[:, np.arange(n), np.arange(n)] += self.lam[:, None] * weight
            step = -np.linalg.solve(A, np.swapaxes(J, 1, 2) @ rows[:, :, None]).reshape(self.waves.shape)
            moves = np.abs(self.grid.basis.value @ np.swapaxes(step, 1, 2)).max(axis=(1, 2))
            step *= (_TURN / np.maximum(moves, _TURN))[:, None, None]
            there = self.linear(self.waves + step)
            rows_there = self.rows(there)
            better = (rows_there**2).sum(axis=1) < (rows**2).sum(axis=1)
            self.waves = np.where(better[:, None, None], self.waves + step, self.waves)
            rows = np.where(better[:, None], rows_there, rows)
            self.lam = np.where(better, np.maximum(self.lam * 0.2, 1e-9), self.lam * 6.0)
            self.now = self.now.where(np.repeat(better, self.M), there)

    def scores(self) -> Array:
        """Minimum of the damped linear model (K)."""
        rows, J = self.rows(self.now), self.jacobian(self.now)
        A = np.swapaxes(J, 1, 2) @ J
        n = A.shape[1]
        A[:, np.arange(n), np.arange(n)] += _AMPLITUDE * np.tile(1.0 + self.grid.basis.orders**2, self.N)
        g = np.swapaxes(J, 1, 2) @ rows[:, :, None]
        return np.asarray((rows**2).sum(axis=1) - (g * np.linalg.solve(A, g)).sum(axis=(1, 2)))

    def residuals(self) -> Array:
        """Root mean square of the scaled residual (K)."""
        return np.asarray(np.linalg.norm(self.rows(self.now), axis=1))

    def with_waves(self, which: Numbers, n: int) -> StartBatch:
        """The motions with the numbers `which`, with n functions."""
        motions = [self.motion(int(k)).with_waves(n).waves for k in which]
        return StartBatch(self.problem, self.windings[which], np.array(motions), self.bias)

    def motion(self, k: int) -> FlywheelMotion:
        """One of the motions."""
        return FlywheelMotion(self.problem.motion.span, self.windings[k], self.waves[k], self.bias)
