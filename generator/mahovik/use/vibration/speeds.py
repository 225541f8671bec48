"""Constant speeds of flywheels: their common period, and speeds from a command line, swept, constant or geared."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
from fractions import Fraction

import numpy as np

from mahovik.core.motion.laws import MAX_SPEED
from mahovik.core.stand.model import Stand
from mahovik.core.stand.units import SPEED, QuantityError, number
from mahovik.errors import UsageError, whole_number
from mahovik.nearest import suggestion
from mahovik.use.numeric import Array

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


ALL = "all"
"""Name that stands for every flywheel."""


@dataclass(frozen=True)
class SpeedPlan:
    """Speeds of all flywheels: constant + factor * swept speed (N each; rad/s, 1).

    names     of the flywheels
    sweep     first and last value of the swept speed, rad/s; None: nothing is swept
    swept     the flywheel with the swept speed; without a sweep the first that turns, None: none turns
    """

    names: tuple[str, ...]
    constant: tuple[float, ...]
    factor: tuple[float, ...]
    sweep: tuple[float, float] | None
    swept: int | None

    def speeds(self, value: float) -> tuple[float, ...]:
        """Speeds (N, rad/s) for a value of the swept speed."""
        return tuple(c + k * value for c, k in zip(self.constant, self.factor, strict=True))

    def rows(self, values: Array) -> Array:
        """Speeds (S, N; rad/s) for values (S) of the swept speed."""
        return np.asarray(np.array(self.constant) + values[:, None] * np.array(self.factor))

    @staticmethod
    def common(stand: Stand, sweep: tuple[float, float]) -> SpeedPlan:
        """All flywheels at one speed, swept (rad/s)."""
        N = len(stand.flywheels)
        return SpeedPlan(tuple(s.name for s in stand.flywheels), (0.0,) * N, (1.0,) * N, sweep, 0)

    def values(self, steps: int) -> tuple[float, ...]:
        """Values of the swept speed, evenly spaced; without a sweep only that of `swept`. Raises UsageError."""
        if self.sweep is None:
            return (0.0 if self.swept is None else self.constant[self.swept],)
        whole_number("steps", steps, 2, 100_000)
        return tuple(float(x) for x in np.linspace(*self.sweep, steps))


def read_speeds(stand: Stand, given: Sequence[str]) -> SpeedPlan:
    """Speeds from texts NAME=SPEED, NAME=FROM..TO, NAME=[FACTOR*]OTHER; a flywheel that is not named stands still.

    NAME may be `all`; a name after it replaces the speed that `all` gave. Raises UsageError: an unknown name, no speed,
    two sweeps, a name twice, gears in a circle.
    """
    names = [s.name for s in stand.flywheels]
    if not names:
        raise UsageError(f"--speed: {stand.name} has no flywheel")
    texts: dict[str, tuple[str, str]] = {}
    by_all: set[str] = set()
    for each in given:
        name, separator, text = each.partition("=")
        if not separator:
            raise UsageError(f"--speed {each}: expected NAME=SPEED or NAME=FROM..TO, as w1=0..6000rpm")
        _refuse_unknown(name, names, each)
        for one in names if name == ALL else [name]:
            if one in texts and (name == ALL or one not in by_all):
                raise UsageError(f'--speed {each}: flywheel "{one}" has a speed already')
            texts[one] = (each, text.strip())
        by_all = set(names) if name == ALL else by_all - {name}
    return _plan_speeds(names, texts)


def _refuse_unknown(name: str, names: list[str], each: str) -> None:
    if name != ALL and name not in names:
        raise UsageError(f'--speed {each}: unknown flywheel "{name}"{suggestion(name, [*names, ALL])}')


def _plan_speeds(names: list[str], texts: dict[str, tuple[str, str]]) -> SpeedPlan:
    constant, factor = dict.fromkeys(names, 0.0), dict.fromkeys(names, 0.0)
    sweep, swept, geared = None, None, {}
    for name, (each, text) in texts.items():
        if ".." in text:
            found = _range(each, text)
            if sweep not in (None, found):
                raise UsageError(f"--speed {each}: one speed can be swept; gear this one to it, as {name}=1.5*{swept}")
            sweep, swept, factor[name] = found, swept or name, 1.0
        elif text.lower().lstrip("+-") in ("nan", "inf", "infinity"):
            raise UsageError(f"--speed {each}: expected a finite speed, as {name}=1000 rpm")
        elif gear := _GEAR.fullmatch(text):
            _refuse_unknown(gear[2], names, each)
            geared[name] = (each, _factor(each, gear[1]), gear[2])
        else:
            constant[name] = _speed(each, text)
    for name in geared:
        constant[name], factor[name] = _gear_ratio(name, geared, constant, factor)
    if swept is None:
        swept = next((name for name in names if constant[name]), None)
    leader = None if swept is None else names.index(swept)
    asked = SpeedPlan(tuple(names), tuple(constant.values()), tuple(factor.values()), sweep, leader)
    for value in sweep or (0.0,):
        for name, speed in zip(names, asked.speeds(value), strict=True):
            if not abs(speed) <= MAX_SPEED:
                raise UsageError(f"--speed: {name} would turn at {speed:.9g} rad/s, at most {MAX_SPEED:g} is possible")
    return asked


_GEAR = re.compile(r"(-|[-+\d.eE]+\*)?([A-Za-z_]\w*)")


def _factor(each: str, text: str | None) -> float:
    if text in (None, "-"):
        return -1.0 if text else 1.0
    try:
        return float(text.removesuffix("*"))
    except ValueError:
        raise UsageError(f"--speed {each}: {text.removesuffix('*')!r} is not a number") from None


def _gear_ratio(
    name: str, geared: dict[str, tuple[str, float, str]], constant: dict[str, float], factor: dict[str, float]
) -> tuple[float, float]:
    """Constant and factor of a flywheel that is geared, possibly through others."""
    ratio, here, passed = 1.0, name, []
    while here in geared:
        each, own, other = geared[here]
        passed.append(here)
        if other in passed:
            raise UsageError(f"--speed {each}: {' and '.join(passed)} follow one another; give one of them a speed")
        ratio, here = ratio * own, other
    return ratio * constant[here], ratio * factor[here]


def _range(each: str, text: str) -> tuple[float, float]:
    first, _, last = text.partition("..")
    high = _speed(each, last)
    plain = re.fullmatch(r"\s*[-+\d.eE]+\s*", first)
    unit = re.sub(r"^\s*[-+]?[\d.]+([eE][-+]?\d+)?", "", last)
    low = _speed(each, first + unit if plain else first)
    if low == high:
        raise UsageError(f"--speed {each}: the range is empty, give one speed")
    return low, high


def _speed(each: str, text: str) -> float:
    try:
        plain: Decimal | str = Decimal(text.strip())
    except InvalidOperation:
        plain = text
    try:
        return number(plain, SPEED)
    except QuantityError as error:
        raise UsageError(f"--speed {each}: {error}") from None
