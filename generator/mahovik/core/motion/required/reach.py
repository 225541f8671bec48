"""Whether a motion stays where coordinates and numbers mean something: attitude, ranges."""

from __future__ import annotations

import numpy as np

from mahovik.contract.quantities import BOUNDS
from mahovik.core.motion.course import Array
from mahovik.core.motion.required.model import RequiredMotion
from mahovik.core.stand.coordinates import Coordinates, coordinates_of
from mahovik.core.stand.model import Stand
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import ANGLE

SINGULAR = 1e-3
"""|cos theta| (Euler: |sin theta|) that a motion may come down to; `generalized` stops at 1e-6."""

MOST = (
    ((BOUNDS["MAX_POSITION"].value, "m"), (BOUNDS["MAX_PHASE"].at("float"), "rad")),
    ((BOUNDS["MAX_VELOCITY"].value, "m/s"), (BOUNDS["MAX_SPEED"].value, "rad/s")),
    ((BOUNDS["MAX_ACCELERATION"].value, "m/s2"), (BOUNDS["MAX_ACCELERATION"].value, "rad/s2")),
)
"""Largest magnitudes of q, q', q'': of the linear and of the angular components; angles that float takes as well."""


def check(motion: RequiredMotion, stand: Stand, problems: Problems) -> None:
    """Note a singular attitude on the way, and what is out of range."""
    highest = max(motion.harmonics, default=1)
    t = motion.span * np.arange(M := 32 * min(highest, 1000) + 256) / M
    course, coordinates = motion.at(t), coordinates_of(stand)
    angular = np.array([each == ANGLE for each in coordinates.dimensions])
    for values, most, words in zip(course, MOST, ("q", "q'", "q''"), strict=True):
        for own, (limit, unit) in zip((np.logical_not(angular), angular), most, strict=True):
            peak = float(np.abs(values[:, own]).max(initial=0.0))
            if not peak <= limit:
                problems.add(f"{words} reaches {peak:.3g} {unit}, out of range, at most {limit:g} {unit} in magnitude")
    slides = not coordinates.held or not angular.any()  # elsewhere turning moves O1 as well
    if motion.bounds.deviation is not None and slides:
        least, bound = float(np.linalg.norm((course.q - motion.mean)[:, :3], axis=1).max()), motion.bounds.deviation[0]
        if bound < least:
            excess = f"{bound:g} m is below the deviation of the motion itself, {least:g} m"
            problems.add("bounds", "deviation", f"linear: {excess}")
    if coordinates.held:
        _check_turns(course.q, t, coordinates, problems)
        return
    theta = course.q[:, 4]
    name, value = ("sin", np.sin(theta)) if stand.angles == "euler" else ("cos", np.cos(theta))
    i = int(np.argmin(np.abs(value)))
    crossed = np.flatnonzero(np.diff(np.sign(value)))
    if abs(value[i]) < SINGULAR or len(crossed):
        i = int(crossed[0]) if len(crossed) else i
        problems.add(
            f"singular attitude of the {stand.angles} sequence at t = {t[i]:.4g} s, theta = {theta[i]:.6g} rad: "
            f"{name} theta reaches 0; choose another sequence (`angles` of the stand) or mean"
        )


def _check_turns(q: Array, t: Array, coordinates: Coordinates, problems: Problems) -> None:
    """Note where the second of three turns of a held carrier brings the axes of the first and the third together."""
    turns = [k for k in coordinates.order if coordinates.dimensions[k] == ANGLE]
    if len(turns) < 3:
        return
    value = np.cos(q[:, turns[1]])
    i = int(np.argmin(value))
    if value[i] < SINGULAR:
        problems.add(
            f"singular attitude of the freedoms at t = {t[i]:.4g} s: cos of {coordinates.names[turns[1]]} reaches 0; "
            "expected a motion that stays nearer to the home pose"
        )
