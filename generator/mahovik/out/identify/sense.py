"""Flywheels whose measured phase runs the other way: each is turned round, and the data fitted again, linearly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.functions import Motion
from mahovik.core.motion.laws import SpeedLaw
from mahovik.errors import StandError, StateError
from mahovik.out.identify.arrangement import BETTER, GOOD, Look, wrong_axes
from mahovik.out.identify.estimate import Fit
from mahovik.out.identify.free import Free
from mahovik.out.identify.jacobian import slopes
from mahovik.out.identify.phases import speeds
from mahovik.out.identify.predict import Predictor
from mahovik.out.identify.run import Run

Array = NDArray[np.float64]

TURNING = 1e-3
"""A flywheel that is never faster than this, rad/s, stands still."""


@dataclass(frozen=True, eq=False)
class Reversed(SpeedLaw):
    """A law of a speed, turned round."""

    law: SpeedLaw

    breaks: tuple[float, ...] = ()

    def motion(self, t: Array) -> Motion:
        """Motion at the times t (s)."""
        phi, phi_dot, phi_ddot = self.law.motion(t)
        return -phi, -phi_dot, -phi_ddot


def wrong_ways(free: Free, fit: Fit, runs: Sequence[Run]) -> list[str]:
    """One line for each sensor with wrong axes, or each flywheel with a wrong sense: what mends the fit better."""
    found: dict[str, str] = {}
    for r, run in enumerate(runs):
        look = Look(fit, r, run)
        if not look.enough or not look.alive:
            continue
        sensors, least = wrong_axes(look)
        phase = _wrong_sense(free, fit, r, look, least) if look.bad else None
        if phase is not None:
            found.setdefault(*phase)
        else:
            for each in sensors:
                found.setdefault(f"{each.point}.{each.kind} {each.taken}", each.line)
    return list(found.values())


def _wrong_sense(free: Free, fit: Fit, r: int, look: Look, least: float) -> tuple[str, str] | None:
    """Flywheels and line of those which, turned round, leave less than `least`."""
    n = len(look.run.channels)
    places, signs = list(range(n)), [1.0] * n
    given = look.grams(look.predicted, look.by).remains(places, signs)
    bound = min(BETTER * float(look.excess(given, places).sum()), GOOD * len(look.alive), least)
    low, high = speeds(look.run.predictor._case.regime, look.run.duration)
    turning = [i for i in range(len(low)) if max(abs(low[i]), abs(high[i])) > TURNING]
    sets = [[i] for i in turning] + ([turning] if len(turning) > 1 else [])
    best: tuple[float, list[int], Array] | None = None
    for own in sets:
        try:
            left = _turned_round(free, fit, r, look, own).remains(places, signs)
        except (StandError, StateError):
            continue
        cost = float(look.excess(left, places).sum())
        if cost < bound and (best is None or cost < BETTER * best[0]):
            best = cost, own, left
    if best is None:
        return None
    names = ", ".join(free.stand.flywheels[i].name for i in best[1])
    before, after = (look.percent(each, places, look.alive) for each in (given, best[2]))
    many = len(best[1]) > 1
    return names, (
        f"{names}: the {'phases evidently run' if many else 'phase evidently runs'} the other way: turned round, the "
        f"fit leaves {after:.3g} % of the data in place of {before:.3g} %; change the sign of the "
        f"{'columns' if many else 'column'}"
    )


def _turned_round(free: Free, fit: Fit, r: int, look: Look, own: Sequence[int]) -> Any:
    """Products of the channels with some flywheels turned round. Raises StandError, StateError."""
    run, old = look.run, look.run.predictor
    regime = old._case.regime
    wheels = tuple(
        replace(each, law=Reversed(cast(SpeedLaw, each.law)), phase=-(each.phase or 0.0)) if i in own else each
        for i, each in enumerate(regime.flywheels)
    )
    predictor = Predictor(old.stand, replace(regime, flywheels=wheels), old.channels, 0.0, old.every, old.count)
    at = slopes(predictor, free, fit.theta, fit.starts[r])
    predicted = run.at_samples(at.values[:, :, None])[look.there, :, 0]
    by = np.concatenate([run.at_samples(each)[look.there] for each in (at.by_theta, at.by_start)], axis=2)
    return look.grams(predicted, by)
