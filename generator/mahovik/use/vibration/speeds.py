"""Constant speeds of flywheels: their common period, and speeds as they are asked for: swept, constant or geared."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from numbers import Real
from typing import Any

import numpy as np

from mahovik.contract.quantities import BOUNDS
from mahovik.core.stand.model import Stand
from mahovik.core.stand.numbers import in_si
from mahovik.core.stand.units import ANGLE, SPEED, Dimension, QuantityError
from mahovik.errors import UsageError, whole_number
from mahovik.nearest import suggestion
from mahovik.use.numeric.se3 import Array

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
    def speeds(self) -> tuple[float, ...]:
        """Speeds, rad/s."""
        return tuple(self.base * n for n in self.turns)


def common_period(speeds: Sequence[float]) -> Turning | None:
    """The shortest common period of speeds (rad/s) within MOST_TURNS of the fastest; None: there is none."""
    fastest = max((abs(x) for x in speeds), default=0.0)
    if fastest == 0.0:
        return Turning(0.0, (0,) * len(speeds))
    ratios = [Fraction(x / fastest).limit_denominator(MOST_TURNS) for x in speeds]
    whole = math.lcm(*(ratio.denominator for ratio in ratios))
    off = max(abs(float(ratio) - x / fastest) for ratio, x in zip(ratios, speeds, strict=True))
    if off > EXACT or whole > MOST_TURNS:
        return None
    turns = [int(ratio * whole) for ratio in ratios]
    shared = math.gcd(*turns)
    return Turning(fastest * shared / whole, tuple(n // shared for n in turns))


ALL = "all"
"""Name that stands for every flywheel."""

Speed = float | str | Sequence[float | str]
"""A speed, LOW..HIGH or both ends, or [FACTOR*]OTHER."""
Asked = Mapping[str, Speed] | Sequence[Speed] | float | str
"""Speeds by flywheel, one for each, or one for all."""


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

    @property
    def words(self) -> str:
        """What the swept speed is of: flywheels by name, or all."""
        names = [name for name, k in zip(self.names, self.factor, strict=True) if k == 1.0]
        return "common speed" if len(names) == len(self.names) > 1 else f"speed of {', '.join(names)}"

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

    @staticmethod
    def constants(stand: Stand, speeds: Sequence[float]) -> SpeedPlan:
        """Constant speeds (N, rad/s)."""
        N, turning = len(speeds), np.flatnonzero(speeds)
        names = tuple(s.name for s in stand.flywheels)
        return SpeedPlan(names, tuple(map(float, speeds)), (0.0,) * N, None, int(turning[0]) if len(turning) else None)

    def values(self, steps: int) -> tuple[float, ...]:
        """Values of the swept speed, evenly spaced; without a sweep only that of `swept`. Raises UsageError."""
        if self.sweep is None:
            return (0.0 if self.swept is None else self.constant[self.swept],)
        whole_number("steps", steps, 2, 100_000)
        return tuple(float(x) for x in np.linspace(*self.sweep, steps))


_GEAR = re.compile(r"(-|[-+\d.eE]+\*)?(?!(?i:nan|inf)\b)([A-Za-z_]\w*)")


def read_speeds(stand: Stand, asked: Asked) -> SpeedPlan:
    """Speeds of flywheels: SPEED, LOW..HIGH, or [FACTOR*]OTHER, by name; one that is not named stands still.

    The name `all` is every flywheel; one named beside it has its own speed. A list may hold texts NAME=SPEED. Numbers
    are rad/s. Raises UsageError: an unknown name, no speed, two sweeps, a name twice, gears in a circle.
    """
    names = [s.name for s in stand.flywheels]
    if not names:
        raise UsageError(f"speed: {stand.name} has no flywheel")
    speeds = by_name("speed", stand, asked, f"NAME=SPEED or NAME=LOW..HIGH, as {names[0]}=0..6000rpm")
    if not speeds:
        raise UsageError("speed: is empty, expected that of a flywheel, as w1=6000rpm, or of all")
    texts = {name: text.strip() if isinstance(text, str) else text for name, text in speeds.items()}
    constant, factor = dict.fromkeys(names, 0.0), dict.fromkeys(names, 0.0)
    sweep: tuple[float, float] | None = None
    swept: str | None = None
    geared: dict[str, tuple[float, str]] = {}
    for name, text in texts.items():
        if _is_range(text):
            interval = _range(f"speed {name}=", text)
            if sweep not in (None, interval):
                raise UsageError(f"speed {name}={text}: one can be swept; gear this one to it, as {name}=1.5*{swept}")
            sweep, swept, factor[name] = interval, swept or name, 1.0
        elif isinstance(text, str) and (gear := _GEAR.fullmatch(text)):
            if gear[2] not in names:
                raise UsageError(f'speed {name}={text}: unknown flywheel "{gear[2]}"{suggestion(gear[2], names)}')
            geared[name] = (-1.0 if gear[1] == "-" else _number(name, (gear[1] or "1*")[:-1]), gear[2])
        else:
            constant[name] = _speed(f"speed {name}=", text)
    for name in geared:
        ratio, other, passed = 1.0, name, list[str]()
        while other in geared:
            passed.append(other)
            ratio, other = ratio * geared[other][0], geared[other][1]
            if other in passed:
                follow = "follow one another; give one of them" if len(passed) > 1 else "follows itself; give it"
                raise UsageError(f"speed: {' and '.join(passed)} {follow} a speed")
        constant[name], factor[name] = ratio * constant[other], ratio * factor[other]
    swept = swept or next((name for name in names if constant[name]), None)
    leader = None if swept is None else names.index(swept)
    plan = SpeedPlan(tuple(names), tuple(constant.values()), tuple(factor.values()), sweep, leader)
    for value in sweep or (0.0,):
        for name, speed in zip(names, plan.speeds(value), strict=True):
            if not abs(speed) <= (most := BOUNDS["MAX_SPEED"].value):
                raise UsageError(f"speed: {name} would turn at {speed:.9g} rad/s, at most {most:g} is possible")
    return plan


def by_name(argument: str, stand: Stand, asked: Any, expected: str = "NAME=VALUE, or one for each") -> dict[str, Any]:
    """What is asked of flywheels: one for all, one for each, or by name, as a mapping or texts NAME=VALUE.

    The name `all` is every flywheel; one named beside it has its own. Raises UsageError.
    """
    names = [s.name for s in stand.flywheels]
    if isinstance(asked, Real) or (isinstance(asked, str) and not ("=" in asked or _GEAR.fullmatch(asked))):
        return dict.fromkeys(names, asked)
    listed = [asked] if isinstance(asked, str) else list(asked)
    alone = [entry for entry in listed if not (isinstance(entry, str) and "=" in entry)]
    if isinstance(asked, Mapping):
        pairs = list(asked.items())
    elif not alone:
        pairs = [(name.strip(), text) for name, _, text in (str(entry).partition("=") for entry in listed)]
    elif len(alone) == len(listed) == len(names):
        pairs = list(zip(names, listed, strict=True))
    else:
        several = f": {len(listed)} {argument}s, but the stand has {len(names)} flywheels;"
        where = several if len(alone) == len(listed) > 1 else f" {alone[0]}:"
        raise UsageError(f"{argument}{where} expected {expected}")
    result: dict[str, Any] = {}
    for name, text in sorted(pairs, key=lambda pair: pair[0] != ALL):
        where = f"{argument} {name}={_asked_text(text)}"
        if name != ALL and name not in names:
            raise UsageError(f'{where}: unknown flywheel "{name}"{suggestion(name, [*names, ALL])}')
        if [known for known, _ in pairs].count(name) > 1:
            raise UsageError(f'{where}: flywheel "{name}" has a {argument} already')
        result |= dict.fromkeys(names if name == ALL else [name], text)
    return result


def read_phases(argument: str, stand: Stand, asked: Any) -> list[float]:
    """Phases of the flywheels, rad, as they are asked for; of those without one 0. Raises UsageError."""
    phases = {} if asked is None else by_name(argument, stand, asked)
    where = f"{argument} " + "{}=" * (not isinstance(asked, str) or "=" in asked)
    return [_si(where.format(s.name), phases.get(s.name, 0.0), ANGLE, "90 deg") for s in stand.flywheels]


def read_limits(limit: Speed | None) -> tuple[float | None, float | None]:
    """Lowest and highest speed, rad/s, of LOW..HIGH or of the highest alone; None: not given. Raises UsageError."""
    if limit is None:
        return None, None
    low, high = _range("limit ", limit) if _is_range(limit) else (None, _speed("limit ", limit))
    if high < (low or 0.0) or (low or 0.0) < 0.0:
        raise UsageError(f"limit {_asked_text(limit)}: expected a speed, or a range of them, from zero up")
    return low, high


def _is_range(asked: Any) -> bool:
    return ".." in asked if isinstance(asked, str) else not isinstance(asked, Real)


def _range(where: str, asked: Any) -> tuple[float, float]:
    """The ends of LOW..HIGH, of which the first may leave its unit to the second, or of a pair."""
    ends = asked.split("..", 1) if isinstance(asked, str) else list(asked)
    if len(ends) != 2:
        raise UsageError(f"{where.rstrip(' =')}: {len(ends)} numbers, expected one speed, or two of a range")
    if isinstance(asked, str) and re.fullmatch(r"\s*[-+\d.eE]+\s*", ends[0]):
        ends[0] += re.sub(r"^\s*[-+]?[\d.]+([eE][-+]?\d+)?", "", ends[1])
    high, low = (_speed(where, end) for end in reversed(ends))
    if not low < high:
        raise UsageError(f"{where}{asked}: expected a range from the lower speed to the higher")
    return low, high


def _asked_text(asked: Any) -> str:
    return f"{asked:g}" if isinstance(asked, Real) else str(asked)


def _speed(where: str, text: Any) -> float:
    return _si(where, text, SPEED, "1000 rpm")


def _si(where: str, text: Any, dimension: Dimension, example: str) -> float:
    """A finite number in SI of a text that stands behind `where` in messages."""
    try:
        number = in_si(text, dimension)
    except QuantityError as error:
        raise UsageError(f"{where}{text}: {error}") from None
    if not math.isfinite(number):
        words = f"{dimension.words.partition(' ')[2]}, as {where.partition(' ')[2]}{example}"
        raise UsageError(f"{where}{text}: expected a finite {words}")
    return number


def _number(name: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise UsageError(f"speed {name}: {text!r} is not a number") from None
