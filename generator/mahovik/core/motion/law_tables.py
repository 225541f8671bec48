"""Laws of a flywheel as a regime file gives them: their keys, units and ranges."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

from pydantic import Field

from mahovik.core.motion import ranges
from mahovik.core.motion.fields import FREQUENCY, choice, table_with
from mahovik.core.motion.laws import Constant, Harmonic, Law, LogSweep, Ramp, RunUp, Torque
from mahovik.core.stand.fields import Table, refuse, scalar, validator
from mahovik.core.stand.units import ANGLE, SPEED, TIME, TORQUE, Dimension, QuantityError, number, show


def _sweep_speed(raw: Any) -> float:
    """A speed, rad/s, also given as turns per second, in Hz."""
    try:
        return number(raw, SPEED)
    except QuantityError as error:
        try:
            return 2 * math.pi * number(raw, FREQUENCY)
        except QuantityError:
            raise QuantityError(str(error).partition(", a frequency")[0]) from None


def _hold(raw: Any) -> bool:
    if raw is not True:
        raise QuantityError(f"expected true, found {show(raw)}")
    return True


def _file(raw: Any) -> str:
    if not isinstance(raw, str):
        raise QuantityError(f"expected the name of a CSV file, found {show(raw)}")
    return raw


def _bounded_number(dimension: Dimension, most: float) -> Any:
    def read(raw: Any) -> float:
        found = number(raw, dimension)
        if (out := ranges.out_of_range(dimension.words, found, most, dimension.si)) is not None:
            raise QuantityError(out)
        return found

    return validator(read)


Duration = Annotated[float, scalar(TIME, above=0.0)]
Start = Annotated[float, scalar(TIME, least=0.0)]
SweepSpeed = Annotated[float, validator(_sweep_speed)]


class RampTable(Table):
    """`ramp`: a speed that changes linearly."""

    from_: Annotated[float, scalar(SPEED)] = Field(0.0, alias="from")
    to: Annotated[float, scalar(SPEED)]
    duration: Duration
    start: Start = 0.0

    def law(self) -> Law:
        """The law."""
        return Ramp(self.from_, self.to, self.start, self.duration)


class SweepTable(Table):
    """`sweep`: a speed that changes linearly or logarithmically."""

    from_: SweepSpeed = Field(alias="from")
    to: SweepSpeed
    duration: Duration
    start: Start = 0.0
    scale: Annotated[Literal["linear", "log"], choice("linear", "log")] = "linear"

    def law(self) -> Law:
        """The law. Raises PydanticCustomError for a log sweep through zero."""
        if self.scale == "linear":
            return Ramp(self.from_, self.to, self.start, self.duration)
        if self.from_ * self.to <= 0.0:
            raise refuse("a log sweep goes between two speeds of one sign, neither of them zero")
        return LogSweep(self.from_, self.to, self.start, self.duration)


class HarmonicTable(Table):
    """`harmonic`: a speed that oscillates about a mean."""

    mean: Annotated[float, scalar(SPEED)] = 0.0
    amplitude: Annotated[float, scalar(SPEED)]
    frequency: Annotated[float, scalar(FREQUENCY, above=0.0)]
    phase: Annotated[float, scalar(ANGLE)] = 0.0

    def law(self) -> Law:
        """The law."""
        return Harmonic(self.mean, self.amplitude, self.frequency, self.phase)


class RunUpTable(Table):
    """`run_up`: a torque towards a speed, whose sign gives the direction."""

    torque: Annotated[float, scalar(TORQUE, above=0.0)]
    to: Annotated[float, scalar(SPEED)]
    band: Annotated[float, scalar(SPEED, least=0.0)] = 0.0

    def law(self) -> Law:
        """The law; without a band, 1 % of the speed and at least 0.1 rad/s."""
        return RunUp(self.torque, self.to, self.band or max(0.01 * abs(self.to), 0.1))


class DrivenTable(Table):
    """What drives one flywheel: exactly one law, and where it starts."""

    speed: Annotated[float | None, scalar(SPEED)] = None
    hold: Annotated[bool, validator(_hold)] = False
    ramp: Annotated[RampTable | None, table_with(RampTable)] = None
    sweep: Annotated[SweepTable | None, table_with(SweepTable)] = None
    harmonic: Annotated[HarmonicTable | None, table_with(HarmonicTable)] = None
    torque: Annotated[float | None, scalar(TORQUE)] = None
    run_up: Annotated[RunUpTable | None, table_with(RunUpTable)] = None
    table: Annotated[str, validator(_file)] = ""
    phase: Annotated[float | None, _bounded_number(ANGLE, ranges.MAX_PHASE)] = None
    initial_speed: Annotated[float | None, _bounded_number(SPEED, ranges.MAX_SPEED)] = None

    def law(self) -> Law | None:
        """The law; None if it is a table in a file. Raises PydanticCustomError."""
        if self.speed is not None:
            return Constant(self.speed)
        if self.torque is not None:
            return Torque(self.torque)
        moving = self.ramp or self.sweep or self.harmonic or self.run_up
        return moving.law() if moving is not None else Constant(0.0) if self.hold else None


LAWS = tuple(key for key in DrivenTable.model_fields if key not in ("phase", "initial_speed"))
"""Keys that name a law."""
