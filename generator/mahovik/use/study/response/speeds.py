"""The common period of flywheels that turn at constant speeds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from mahovik.errors import UsageError

MOST_TURNS = 1000
"""Most turns of the fastest flywheel in a common period; longer periods count as none."""

EXACT = 1e-9
"""Largest deviation of a speed from a whole ratio, as a part of the fastest speed: rounding of typed digits."""


@dataclass(frozen=True)
class Turning:
    """Constant speeds as whole turns: speed s is turns[s] * base (rad/s). All at rest: base 0."""

    base: float
    turns: tuple[int, ...]

    @property
    def period(self) -> float:
        """Period, s; infinite if all are at rest."""
        return 2.0 * math.pi / self.base if self.base else math.inf

    @property
    def speeds(self) -> tuple[float, ...]:
        """Speeds, rad/s."""
        return tuple(self.base * n for n in self.turns)


def common_period(speeds: Sequence[float]) -> Turning:
    """The shortest common period of speeds (rad/s) within MOST_TURNS of the fastest. Raises UsageError: there is none.

    Speeds without one make no periodic motion. The carrier's motion is not the sum of responses to single flywheels,
    so there is no substitute.
    """
    fastest = max((abs(x) for x in speeds), default=0.0)
    if fastest == 0.0:
        return Turning(0.0, (0,) * len(speeds))
    ratios = [Fraction(x / fastest).limit_denominator(MOST_TURNS) for x in speeds]
    whole = math.lcm(*(ratio.denominator for ratio in ratios))
    off = max(abs(float(ratio) - x / fastest) for ratio, x in zip(ratios, speeds, strict=True))
    if off > EXACT or whole > MOST_TURNS:
        given = ", ".join(f"{x:.9g}" for x in speeds)
        raise UsageError(
            f"speeds {given} rad/s: no common period within {MOST_TURNS} turns of the fastest, so there is no periodic "
            "steady state; give speeds in whole ratios"
        )
    turns = [int(ratio * whole) for ratio in ratios]
    shared = math.gcd(*turns)
    return Turning(fastest * shared / whole, tuple(n // shared for n in turns))
