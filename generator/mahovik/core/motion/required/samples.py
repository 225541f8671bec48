"""Whether samples are a motion: times that rise over the span, no jump between them, rest at the ends."""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.course import Array
from mahovik.core.motion.required.course import SampledCourse, quintic

FEWEST = 12
"""Samples: every second one must still make a quintic spline."""

JUMP = 0.2
"""Largest distance of the other samples from a spline through every second one, as a part of the coordinate's range.

A harmonic sampled 8 times a period misses by 0.03, 6 times by 0.2; a step misses by about half.
"""

MOVING = 0.02
"""Largest speed (acceleration) that counts as rest at the ends of a finite motion, as a part of the greatest."""

GAP = 3.0
"""Longest steps that a periodic table may leave to the end of its period."""

_SMALL = 1e-6
"""Smallest range of a moving coordinate, as a part of the largest range of its kind: less is noise."""


def problem(given: SampledCourse) -> tuple[str, str] | None:
    """Key and reason why the samples are refused, or None."""
    return _times(given) or _smooth(given) or (None if given.periodic else _rest(given))


def _times(given: SampledCourse) -> tuple[str, str] | None:
    t, q = given.t, given.q
    if len(t) < FEWEST:
        return "t", f"{len(t)} samples, expected at least {FEWEST}"
    steps = np.diff(t)
    if np.any(steps <= 0.0):
        i = int(np.argmax(steps <= 0.0)) + 1
        jump = (
            ", but q differs: the motion must be continuous" if steps[i - 1] == 0.0 and np.any(q[i] != q[i - 1]) else ""
        )
        return f"t[{i}]", f"{t[i]:.9g} s is not after {t[i - 1]:.9g} s{jump}"
    if given.periodic:
        if t[0] < 0.0:
            return "t[0]", f"{t[0]:.9g} s is before 0"
        if t[-1] - t[0] > given.span * (1 - 1e-9):
            last = f"t[{len(t) - 1}]"
            return last, f"{t[-1]:.9g} s is a period of {given.span:g} s after the first or more; t = T is left out"
        open_, longest = t[0] + given.span - t[-1], float(steps.max())
        if open_ > GAP * longest:
            return "t", (
                f"covers {t[0]:.9g} to {t[-1]:.9g} s, without samples in the last {open_:.3g} s of the period, "
                f"{given.span:g} s: is it the period of these samples?"
            )
        return None
    if t[0] != 0.0 or abs(t[-1] - given.span) > 1e-9 * given.span:
        return "t", f"covers {t[0]:.9g} to {t[-1]:.9g} s, expected 0 to the duration, {given.span:g} s"
    return None


def _moving(given: SampledCourse) -> tuple[Array, Array]:
    """Ranges of the coordinates, and which of them move."""
    ranges = np.ptp(given.q, axis=0)
    kinds = np.empty_like(ranges)
    for group in given.groups:
        kinds[list(group)] = ranges[list(group)].max()
    return ranges, ranges > _SMALL * kinds


def _smooth(given: SampledCourse) -> tuple[str, str] | None:
    """Largest distance of the other samples from a spline through every second one."""
    t, q = given.t, given.q
    kept = np.arange(len(t)) % 2 == 0
    if not given.periodic:
        kept[-1] = True
    coarse = quintic(t[kept], q[kept], given.span if given.periodic else None)
    ranges, moving = _moving(given)
    missed = np.where(moving, np.abs(coarse(t[~kept]) - q[~kept]) / np.where(moving, ranges, 1.0), 0.0)
    row, column = np.unravel_index(int(np.argmax(missed)), missed.shape)
    if missed[row, column] <= JUMP:
        return None
    i = int(np.flatnonzero(~kept)[row])
    return (
        f"q[{i}][{column}]",
        "a jump: a spline through every second sample misses this one by "
        f"{100 * missed[row, column]:.0f} % of the range; a motion is continuous and sampled at least 8 times "
        "a period of its highest harmonic",
    )


def _rest(given: SampledCourse) -> tuple[str, str] | None:
    """Speeds and accelerations at the ends, by a spline without end conditions."""
    from scipy.interpolate import make_interp_spline

    free = make_interp_spline(given.t, given.q, k=5)
    fine = np.linspace(0.0, given.t[-1], 8 * len(given.t))
    _, moving = _moving(given)
    for order, words in ((1, "speed"), (2, "acceleration")):
        values = np.abs(free.derivative(order)(fine))
        most = values.max(axis=0)
        for at, index in (("start", 0), ("end", -1)):
            share = np.where(moving, values[index] / np.where(moving, most, 1.0), 0.0)
            column = int(np.argmax(share))
            if share[column] > MOVING:
                return "q", (
                    f"component {column}: {words} at the {at} is {100 * share[column]:.0f} % of the greatest; "
                    "a finite motion starts and ends at rest, q' = q'' = 0; if it does, more samples will show it"
                )
    return None
