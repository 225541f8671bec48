"""Which winding numbers are tried, in which order: they decide whether there is a programme, planning's chief choice.

Flywheels turn with the common period of the motion (`spin`, +-1), rock about a mean angle (`rock`, 0), or some do this
and some that (`mixed`). Never with the highest of several harmonics: unbalance forces grow with the speed squared,
and the surplus must cancel among the wheels.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import cycle
from typing import Literal

import numpy as np

from mahovik.core.motion.required import RequiredMotion
from mahovik.use.plan.array import Array

Kind = Literal["spin", "rock", "mixed", "given"]

_SLOW = 4
"""Periods of the lowest harmonic in that of the motion from which flywheels rock first."""


def unit(motion: RequiredMotion) -> int:
    """Turns a period that count as one: the greatest common divisor of the motion's harmonics."""
    return math.gcd(*motion.harmonics) or 1


def order(motion: RequiredMotion, N: int) -> tuple[Kind, ...]:
    """Kinds to try in turn. With seven flywheels or fewer, spinning sets mostly cross det I = 0: they rock first.

    So do all where the lowest harmonic is high.

    A kind that the bounds of speed forbid for all flywheels is left out.
    """
    if isinstance(motion.winding, tuple):
        return ("given",)
    if motion.winding != "any":
        return (motion.winding,)
    slow = min(motion.harmonics, default=1) >= _SLOW * unit(motion)  # turning with the period is hardly turning
    kinds: tuple[Kind, ...] = ("spin", "rock", "mixed") if N >= 8 and not slow else ("rock", "spin", "mixed")
    able = [allowed("mixed", motion, s) for s in range(N)]
    if all(0 not in turns for turns in able):
        return ("spin",)
    if all(turns == (0,) for turns in able):
        return ("rock",)
    return kinds


def rounds(motion: RequiredMotion, N: int) -> Iterator[Kind]:
    """The kinds of all rounds, without end."""
    return cycle(order(motion, N))


def allowed(kind: Kind, motion: RequiredMotion, s: int) -> tuple[int, ...]:
    """Windings that flywheel s may have in a kind, inside the bounds of speed; another kind's where it may have none.

    Its mean speed lies between least and greatest speed; one that must not stop does not rock.
    """
    bounds, turn = motion.bounds, unit(motion)
    least = bounds.speed_min[s] if bounds.speed_min is not None else 0.0
    turn *= max(1, math.ceil(least * motion.span / (2.0 * math.pi * turn) - 1e-9))
    fast = bounds.speed is not None and 2.0 * math.pi * turn / motion.span > bounds.speed[s]
    rock: tuple[int, ...] = (0,) if least == 0.0 else ()
    spin: tuple[int, ...] = (-turn, turn) if not fast or not rock else ()
    if kind == "mixed":
        return (spin[:1] + rock + spin[1:]) if spin else rock
    return (rock or spin) if kind == "rock" else (spin or rock)


def drawn(kind: Kind, motion: RequiredMotion, N: int, K: int, rng: np.random.Generator) -> Array:
    """Winding numbers (K, N) of K starts."""
    if kind == "given":
        return np.tile(np.array(motion.winding, dtype=np.float64), (K, 1))
    choices = [np.array(allowed(kind, motion, s), dtype=np.float64) for s in range(N)]
    return np.stack([rng.choice(each, size=K) for each in choices], axis=1) if N else np.zeros((K, 0))
