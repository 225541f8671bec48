"""Whether growth in the mean over a turn is that of a steady motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.errors import CheckError, UsageError
from mahovik.use.vibration.campbell import Campbell
from mahovik.use.vibration.periodic import Periodic, periodic_response
from mahovik.use.vibration.scene import Scene

TRIED = 4
"""Speeds at which steady motions are found, besides that of the largest growth."""


@dataclass(frozen=True)
class Growth:
    """Growth in the means of a Campbell diagram, compared with steady motions at some of the speeds that have it.

    The means are about rest, which is no steady motion where flywheels turn: a small growth shows nothing by itself.

    first       lowest speed at which the mean grows, rad/s
    largest     its largest growth, 1/s
    found       number of speeds at which a steady motion was found
    multiplier  largest multiplier of deviations from these over a turn; NaN without any
    unstable    lowest of these speeds at which the motion is unstable, rad/s; None where all are stable
    """

    first: float
    largest: float
    found: int
    multiplier: float
    unstable: float | None


def compare_growth(scene: Scene, diagram: Campbell) -> Growth | None:
    """Growth in the means of `diagram`, compared with steady motions; None where nothing grows."""
    growing = np.flatnonzero(diagram.growth)
    if not len(growing):
        return None
    places = np.linspace(0, len(growing) - 1, TRIED).astype(int)
    tried = sorted({*growing[places].tolist(), int(diagram.growth.argmax())})
    found = [(i, each) for i in tried if (each := _steady(scene, float(diagram.speed[i]))) is not None]
    stable = [i for i, each in found if each.stable]
    first = next((i for i, each in found if not each.stable), None)
    low = max((i for i in stable if first is not None and i < first), default=-1)
    while first is not None and low >= 0 and first - low > 1:  # the lowest unstable speed between two that were tried
        middle = (low + first) // 2
        steady = _steady(scene, float(diagram.speed[middle]))
        low, first = (middle, first) if steady is None or steady.stable else (low, middle)
    multiplier = max((each.multiplier for _, each in found), default=np.nan)
    unstable = None if first is None else float(diagram.speed[first])
    return Growth(float(diagram.speed[growing[0]]), float(diagram.growth.max()), len(found), multiplier, unstable)


def _steady(scene: Scene, speed: float) -> Periodic | None:
    """The steady motion at a common speed of all flywheels; None where none is found."""
    try:
        return periodic_response(scene, [speed] * scene.chart.mechanics.N, [])
    except (CheckError, UsageError):
        return None
