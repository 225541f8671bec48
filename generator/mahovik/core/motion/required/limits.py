"""Bounds and objective of a motion file, and bounds that no programme can keep together."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from mahovik.core.motion.document import Section
from mahovik.core.motion.required.model import Bounds, Each, Objective, RequiredMotion, Winding
from mahovik.core.stand.model import Stand
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import ANGLE, LENGTH, PLAIN, SPEED, TORQUE, Dimension, QuantityError, number, show
from mahovik.errors import MotionError

ANGULAR_ACCELERATION = Dimension("an angular acceleration", "rad/s^2")
BOUNDS = {
    "speed": SPEED, "speed_min": SPEED, "acceleration": ANGULAR_ACCELERATION, "torque": TORQUE, "angle": ANGLE,
}  # fmt: skip
WEIGHTS = ("acceleration", "torque", "speed_variation", "power")


def bounds(top: Section, N: int, periodic: bool) -> Bounds:
    """What stands under `bounds`, in SI."""
    section = top.section("bounds")
    if section is None:
        return Bounds()
    section.only((*BOUNDS, "bias", "deviation", "start"))
    found = {key: _each(section, key, N, dimension) for key, dimension in BOUNDS.items()}
    for key, values in found.items():
        for value in values or ():
            if value < 0.0 or (value == 0.0 and key != "speed_min"):
                section.refuse(key, f"{value:g} is not above 0: a bound is a magnitude")
                break
    start = Section(section.problems, {})
    if "start" in section:
        start = section.section("start") or start
        start.only(("phi", "phi_dot"))
        if periodic:
            section.refuse("start", 'goes not with type "periodic", which begins where it ends')
    return Bounds(
        **found,
        bias=_bias(section),
        deviation=_deviation(section, top),
        start_phi=_each(start, "phi", N, ANGLE),
        start_phi_dot=_each(start, "phi_dot", N, SPEED),
    )


def objective(top: Section, stand: Stand) -> Objective:
    """What stands under `objective`: a weight left out is 0, without any the weight of acceleration is 1."""
    N = len(stand.flywheels)
    section = top.section("objective")
    if section is None or not section.given:
        return Objective((1.0,) * N, (0.0,) * N, (0.0,) * N, (0.0,) * N)
    section.only(WEIGHTS)
    found = {}
    for key in WEIGHTS:
        found[key] = _each(section, key, N, PLAIN) or (0.0,) * N
        if min(found[key], default=0.0) < 0.0:
            section.refuse(key, f"{min(found[key]):g} is negative, expected a weight")
    missing = [
        f'"{s.name}"'
        for s, weight in zip(stand.flywheels, found["power"], strict=True)
        if weight > 0.0 and (s.motor is None or not s.motor.constant or s.motor.resistance is None)
    ]
    if missing:
        which = f"flywheel {missing[0]} has" if len(missing) == 1 else f"flywheels {', '.join(missing)} have"
        section.refuse(
            "power", f"{which} no motor with `constant` and `resistance`: give them in the stand file, or weight 0"
        )
    return Objective(**found)


def contradictions(top: Section, given: Bounds, winding: Winding, period: float | None) -> None:
    """Note bounds that exclude each other, or the winding; `period` (s) of a periodic motion. A key, a line."""
    section = Section(top.problems, {}, ("bounds",))
    said: set[str] = set()

    def refuse(key: str, words: str) -> None:
        if key not in said:
            section.refuse(key, words)
        said.add(key)

    N = len(given.speed or given.speed_min or given.start_phi_dot or ())
    turns: tuple[int | None, ...] = (None,) * N
    if period is not None and winding != "any":
        turns = winding if isinstance(winding, tuple) else ((1,) if winding == "spin" else (0,)) * N
    for s in range(N):
        most = given.speed[s] if given.speed else math.inf
        least = given.speed_min[s] if given.speed_min else 0.0
        if most <= 0.0:  # noted already
            continue
        if least > most:
            refuse("speed_min", f"[{s}]: {least:g} rad/s is above speed, {most:g} rad/s")
            continue
        if given.start_phi_dot and not least <= abs(given.start_phi_dot[s]) <= most:
            speed = given.start_phi_dot[s]
            section.refuse("start", f"phi_dot[{s}]: {speed:g} rad/s is outside speed_min, speed: {least:g} to {most:g}")
        n = turns[s]
        if n is None or period is None:
            continue
        mean = 2 * math.pi * abs(n) / period
        if mean > most:
            refuse("speed", f"[{s}]: {most:g} rad/s is below the mean speed of winding {n}, {mean:.6g} rad/s")
        if n == 0 and least > 0.0:
            refuse("speed_min", f"[{s}]: {least:g} rad/s, but with winding 0 a flywheel turns back")
        elif mean < least and winding != "spin":  # which may be more than a turn a period
            refuse("speed_min", f"[{s}]: {least:g} rad/s is above the mean speed of winding {n}, {mean:.6g} rad/s")


def with_winding(motion: RequiredMotion, winding: Winding) -> RequiredMotion:
    """The motion with another winding than its file's. Raises MotionError: the bounds exclude it."""
    shown = winding if isinstance(winding, str) else ",".join(str(n) for n in winding)
    problems = Problems(f"{motion.name}, winding {shown}")
    contradictions(Section(problems, {}), motion.bounds, winding, motion.span if motion.periodic else None)
    if problems.lines:
        raise MotionError(problems.lines)
    return replace(motion, winding=winding)


def _each(section: Section, key: str, N: int, dimension: Dimension) -> Each:
    """A number for all or one a flywheel, in SI; None where there is none, or with a problem noted."""
    if key not in section:
        return None
    raw: Any = section.given[key]
    if isinstance(raw, list) or (isinstance(raw, dict) and isinstance(raw.get("value"), list)):
        return section.numbers(key, raw, N, dimension)
    value = section.number(key, dimension)
    return None if value is None else (value,) * N


def _bias(section: Section) -> Each:
    """Six magnitudes, m and rad."""
    if "bias" not in section:
        return None
    raw = section.given["bias"]
    if not isinstance(raw, list) or len(raw) != 6:
        section.refuse("bias", f"expected 6 numbers (m, rad), found {len(raw) if isinstance(raw, list) else show(raw)}")
        return None
    values = []
    for i, each in enumerate(raw):
        try:
            values.append(number(each, LENGTH if i < 3 else ANGLE))
        except QuantityError as error:
            section.refuse("bias", f"[{i}]: {error}")
            continue
        if values[-1] < 0.0:
            section.refuse("bias", f"[{i}]: {values[-1]:g} is negative: a bound is a magnitude")
    return tuple(values) if len(values) == 6 else None


def _deviation(section: Section, top: Section) -> tuple[float, float] | None:
    """Linear, m, and angular, rad; infinite where it is left out."""
    if "deviation" not in section:
        return None
    if "runup" not in top:
        section.refuse("deviation", "goes with `runup`: it bounds the carrier on the way there and back")
    inner = section.section("deviation")
    if inner is None:
        return None
    inner.only(("linear", "angular"))
    if not inner.given:
        section.refuse("deviation", "expected linear, angular, or both")
    linear, angular = (
        inner.above_zero(key, dimension) if key in inner else math.inf
        for key, dimension in (("linear", LENGTH), ("angular", ANGLE))
    )
    return None if linear is None or angular is None else (linear, angular)
