"""Plan a motion over its shortest period: harmonics with a common divisor repeat themselves within the given one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.required.course import Harmonics
from mahovik.use.plan.fourier import Periodic
from mahovik.use.plan.windings import unit_turns


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
