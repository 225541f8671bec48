"""Whether a step in float adds what it should: the increment of a flywheel's speed beside the rounding of the sum.

`step` adds an increment to a speed, and float rounds the sum by up to half a unit of its last place. Under a
constant torque the rounding is the same in step after step, so that its part of the increment is the part of the motion
that is lost; an increment below half a unit is lost whole. A carry keeps what is lost.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.masses import inertia_about_origin
from mahovik.core.stand.model import Stand

PART = 1e-3
"""Part of an increment that may be lost without a warning."""

USUAL_STEP = 1e-4
"""s: a step that is looked at where no other is asked for."""

RUN_UP = 10.0
"""s: time in which a motor without a known torque reaches its speed."""


@dataclass(frozen=True)
class LostIncrement:
    """A flywheel whose speed loses increments in float steps of `dt`.

    dt           s
    speed        rad/s
    increment    of the speed in a step, rad/s, by the torque of its motor or, without one, a run-up in RUN_UP
    rounding     largest of the sum, rad/s
    lost_torque  N m; torques below it change nothing at all
    """

    flywheel: str
    dt: float
    speed: float
    increment: float
    rounding: float
    lost_torque: float

    @property
    def part(self) -> float:
        """The largest part of an increment that is lost."""
        return min(1.0, self.rounding / self.increment)

    def __str__(self) -> str:
        return (
            f"float: a step of {self.dt:g} s adds {self.increment:.1e} rad/s to {self.flywheel} and rounds its speed "
            f"at {self.speed * 30 / math.pi:.5g} rpm by up to {self.rounding:.1e} rad/s: up to {100 * self.part:.2g} % "
            f"is lost, and all of a torque below {self.lost_torque:.2g} N m: give step a carry, or take double"
        )


def lost_increments(stand: Stand, speeds: Sequence[float], dt: float) -> list[LostIncrement]:
    """Flywheels that lose more than PART of an increment in float steps of `dt` (s) at these speeds (rad/s).

    None of a held carrier, which has no steps yet.
    """
    if stand.hold is not None:
        return []
    result = []
    for flywheel, speed in zip(stand.flywheels, speeds, strict=True):
        J, motor = float(inertia_about_origin(flywheel)[0, 0]), flywheel.motor
        acceleration = motor.peak / J if motor and motor.peak else speed / RUN_UP
        rounding = 0.5 * float(np.spacing(np.float32(speed)))
        if speed > 0.0 and rounding > PART * acceleration * dt:
            lost = LostIncrement(flywheel.name, dt, speed, acceleration * dt, rounding, rounding / dt * J)
            result.append(lost)
    return result


def lost_increments_line(lost: Sequence[LostIncrement]) -> str:
    """One line on all flywheels that lose increments in steps of one length; empty without any."""
    if not lost:
        return ""
    worst = max(lost, key=lambda increment: increment.part)
    more = f" (and {len(lost) - 1} more)" if len(lost) > 1 else ""
    return (
        f"float: steps of {worst.dt:g} s lose up to {100 * worst.part:.2g} % of what they add to the speed of "
        f"{worst.flywheel}{more}: give step a carry, or take double; check --dt TIME for another step"
    )
