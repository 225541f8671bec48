"""Bounds of a motion that no programme can keep together."""

from __future__ import annotations

import math
from dataclasses import replace

from mahovik.core.motion.required.model import Bounds, RequiredMotion, Winding
from mahovik.core.stand.problems import Problems
from mahovik.errors import MotionError


def contradictions(problems: Problems, given: Bounds, winding: Winding, period: float | None) -> None:
    """Note bounds that exclude each other, or the winding; `period` (s) of a periodic motion. A key, a line."""
    said: set[str] = set()

    def refuse(key: str, words: str) -> None:
        if key not in said:
            problems.add("bounds", key, words)
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
            problems.add(
                "bounds", "start", f"phi_dot[{s}]: {speed:g} rad/s is outside speed_min, speed: {least:g} to {most:g}"
            )
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
    contradictions(problems, motion.bounds, winding, motion.span if motion.periodic else None)
    if problems.lines:
        raise MotionError(problems.lines)
    return replace(motion, winding=winding)
