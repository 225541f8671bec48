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

from mahovik.motion.required import RequiredMotion
from mahovik.plan.array import Array

Kind = Literal["spin", "rock", "mixed", "given"]


def unit(motion: RequiredMotion) -> int:
    """Turns a period that count as one: the greatest common divisor of the motion's harmonics."""
    return math.gcd(*motion.harmonics) or 1


def order(motion: RequiredMotion, N: int) -> tuple[Kind, ...]:
    """Kinds to try in turn. With seven flywheels or fewer, spinning sets mostly cross det I = 0: they rock first."""
    if isinstance(motion.winding, tuple):
        return ("given",)
    if motion.winding == "spin":
        return ("spin",)
    if motion.winding == "rock":
        return ("rock",)
    return ("spin", "rock", "mixed") if N >= 8 else ("rock", "spin", "mixed")


def rounds(motion: RequiredMotion, N: int) -> Iterator[Kind]:
    """The kinds of all rounds, without end."""
    return cycle(order(motion, N))


def drawn(kind: Kind, motion: RequiredMotion, N: int, K: int, rng: np.random.Generator) -> Array:
    """Winding numbers (K, N) of K starts."""
    turn = unit(motion)
    if kind == "given":
        return np.tile(np.array(motion.winding, dtype=np.float64), (K, 1))
    if kind == "rock":
        return np.zeros((K, N))
    choice = (-turn, turn) if kind == "spin" else (-turn, 0, turn)
    return rng.choice(np.array(choice, dtype=np.float64), size=(K, N))
