"""Winding numbers to try, and their order: they decide whether there is a programme, the main choice of planning.

Flywheels turn with the common period of the motion (`spin`, +-1), rock about a mean angle (`rock`, 0), or some turn and
some rock (`mixed`). They never turn with the highest of several harmonics: unbalance forces grow with the speed
squared, and the surplus must cancel among the wheels. A motion is planned over its shortest period: harmonics with a
common divisor repeat themselves within the given one.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal

import numpy as np

from mahovik.core.motion.functions import Harmonics
from mahovik.core.motion.required import RequiredMotion
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.problem import Periodic

Kind = Literal["spin", "rock", "mixed", "given"]

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


def repeat_motion(motion: Periodic, times: int) -> Periodic:
    """The same flywheel motion over a period `times` as long."""
    H = motion.H
    waves = np.zeros((motion.N, 2 * H * times + 1))
    waves[:, 0] = motion.waves[:, 0]
    k = np.arange(1, H + 1)
    waves[:, k * times] = motion.waves[:, k]
    waves[:, H * times + k * times] = motion.waves[:, H + k]
    return replace(motion, period=motion.period * times, winding=motion.winding * times, waves=waves)
