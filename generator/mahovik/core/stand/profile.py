"""Ranges of the numbers of `[stream_profile]`: velocities and shears that the C takes."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from mahovik.contract.quantities import BOUNDS
from mahovik.core.stand.model import Vec3
from mahovik.core.stand.problems import Problems


def check_profile(problems: Problems, depth: Sequence[float], velocity: Sequence[Vec3], stream: Vec3) -> None:
    """Note velocities (m/s), alone and with `stream`, and shears (1/s) beyond the ranges of the C."""
    fastest, steepest = BOUNDS["MAX_VELOCITY"].value, BOUNDS["MAX_SPEED"].value
    for k, each in enumerate(velocity):
        alone, whole = (max(map(abs, v)) for v in (each, [a + b for a, b in zip(each, stream, strict=True)]))
        if max(alone, whole) > fastest:
            what = f"{alone:g} m/s" if alone > fastest else f"{whole:g} m/s with `stream`"
            problems.add(
                "stream_profile", f"velocity[{k}]", f"expected components of at most {fastest:g} m/s, found {what}"
            )
    stations = zip(pairwise(depth), pairwise(velocity), strict=True)
    for k, ((top, bottom), (above, below)) in enumerate(stations):
        change = max(abs(b - a) for a, b in zip(above, below, strict=True))
        if change > steepest * (bottom - top):
            found = f"found {change:g} m/s in {bottom - top:g} m"
            problems.add("stream_profile", f"velocity[{k + 1}]", f"expected at most {steepest:g} (m/s)/m, {found}")
