"""Sensors with a wrong sign or exchanged axes: every arrangement of a sensor's axes is fitted, linearly.

Also channels of which a fit leaves much, whatever the reason. Channels with noise alone have no say.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import permutations, product

import numpy as np
from numpy.typing import NDArray

from mahovik.out.identify.channels import REACTION
from mahovik.out.identify.estimate import Fit
from mahovik.out.identify.run import HEARD, Run, has_signal, noise_beside

Array = NDArray[np.float64]
Taken = dict[int, tuple[int, float]]

BETTER = 0.5
"""An arrangement is reported that leaves less than this share of the squares of residuals, of its own or all."""

AMISS = 0.05
"""Arrangements are tried only where residuals of a channel have at least this share of the squares of its data."""

GOOD = 0.25
"""An arrangement is reported that leaves less than this share of the squares of its data; other faults leave more."""

NEAR = 0.01
"""The arrangement with the fewest changes is taken of those that gain as much, to this share."""

MUCH, ABOVE = 1.0 / 3.0, 5.0
"""A fit is bad where it leaves more than this share of a channel's data, and this many times its noise."""


def bad_fits(fit: Fit, runs: Sequence[Run]) -> list[str]:
    """One line for each run of whose channels the stand leaves much more than noise."""
    lines = []
    for r, run in enumerate(runs):
        left, spread = np.sqrt(np.nanmean(fit.residuals[r] ** 2, axis=0)), np.nanstd(run.measured, axis=0)
        own = np.flatnonzero(_is_bad(run, fit.residuals[r])).tolist()
        if own:
            names = ", ".join(run.channels[c].name for c in own)
            shares = ", ".join(f"{100.0 * float(left[c] / spread[c]):.3g} %" for c in own)
            source = f"{run.source}: " if len(runs) > 1 else ""
            lines.append(
                f"{source}{names}: the stand leaves {shares} of the data: a sign, an axis, a phase, a unit, or a "
                "number that is not free?"
            )
    return lines


def _is_bad(run: Run, residuals: Array) -> NDArray[np.bool_]:
    left, spread = np.sqrt(np.nanmean(residuals**2, axis=0)), np.nanstd(run.measured, axis=0)
    much = (left > MUCH * spread) & (left > ABOVE * noise_beside(run, residuals))
    return np.asarray(much & has_signal(run, residuals))


@dataclass(frozen=True)
class Finding:
    """A sensor with wrong axes: channels and signs that its changed channels should have; the excess then left."""

    point: str
    kind: str
    taken: Taken
    cost: float
    line: str


class Look:
    """One run about the estimate: its samples that all channels have, and the channels that tell something."""

    def __init__(self, fit: Fit, r: int, run: Run) -> None:
        self.run, self.residuals = run, fit.residuals[r]
        self.there = np.isfinite(run.measured).all(axis=1)
        self.enough = np.count_nonzero(self.there) >= 2 * run.measured.shape[1]
        measured = run.measured[self.there]
        self.measured = measured - (measured.mean(axis=0) if self.enough else 0.0)
        left = self.residuals[self.there]
        self.predicted = self.measured - left + (left.mean(axis=0) if self.enough else 0.0)
        self.by = np.concatenate([fit.by_theta[r][self.there], fit.by_start[r][self.there]], axis=2)
        self.noise = noise_beside(run, self.residuals)
        self.heard = has_signal(run, self.residuals)
        expected = np.sqrt(np.mean(self.predicted**2, axis=0)) > HEARD * self.noise if self.enough else self.heard
        self.alive: list[int] = np.flatnonzero(self.heard | expected).tolist()
        self.spread = np.nanstd(run.measured, axis=0)
        self.units = np.where(self.heard, self.spread, self.noise)

    @property
    def bad(self) -> bool:
        """Whether much more than noise is left of a channel."""
        return bool(_is_bad(self.run, self.residuals).any())

    def grams(self, predicted: Array, by: Array) -> Grams:
        """Products for predictions (T, C) and derivatives (T, C, p) at the samples."""
        return Grams(self.measured, predicted - predicted.mean(axis=0), by - by.mean(axis=0), self.units, self.alive)

    def excess(self, left: Array, places: Sequence[int]) -> Array:
        """Squares of residuals beyond noise, as a share of those of the data (C); zero of channels of noise."""
        found = np.zeros(len(left))
        for c in self.alive:
            d = places[c]
            found[c] = max(float(left[c] - self.noise[d] ** 2), 0.0) / float(self.units[d]) ** 2
        return found

    def percent(self, left: Array, places: Sequence[int], own: Sequence[int]) -> float:
        """Rms of what is left of channels, % of the data."""
        shares = [float(left[c] / self.spread[places[c]] ** 2) for c in own if self.heard[places[c]]]
        return 100.0 * float(np.sqrt(np.mean(shares))) if shares else 100.0


def wrong_axes(look: Look) -> tuple[list[Finding], float]:
    """Sensors whose data would fit far better with other signs or axes, and the excess left with all of them mended.

    The model is taken as linear about the estimate; each channel counts by its spread in the data. Of several sensors
    the one that mends most is mended before the next is looked for.
    """
    n = len(look.run.channels)
    grams = look.grams(look.predicted, look.by)
    groups: dict[tuple[str, str, int], list[int]] = {}  # forces and moments of a hold apart
    for c in look.alive:
        channel = look.run.channels[c]
        groups.setdefault((channel.point, channel.kind, channel.axis // 3), []).append(c)
    found: list[Finding] = []
    while True:
        mended = {c: each for finding in found for c, each in finding.taken.items()}
        places, signs = _arrange(n, mended)
        given = grams.remains(places, signs)
        excess = look.excess(given, places)
        if excess.max() < AMISS:
            break
        every = {key: _of_sensor(look, grams, own, mended, given, excess) for key, own in groups.items()}
        ones = {key: one for key, one in every.items() if one is not None}
        if not ones:
            break
        least = min(one.cost for one in ones.values())
        enough = least + NEAR * (float(excess.sum()) - least)
        good = [key for key, one in ones.items() if one.cost <= enough]
        best = min(good, key=lambda key: (len(ones[key].taken), ones[key].cost))
        found.append(ones[best])
        del groups[best]
    return found, float(excess.sum())


def _of_sensor(look: Look, grams: Grams, own: list[int], mended: Taken, given: Array, excess: Array) -> Finding | None:
    """What mends a sensor of the channels `own`, with other sensors as `mended`."""
    n, channels = len(look.run.channels), look.run.channels
    tried: list[tuple[float, Taken]] = []
    for order in permutations(own):
        for signs in product((1.0, -1.0), repeat=len(own)):
            taken = dict(zip(own, zip(order, signs, strict=True), strict=True))
            places, whole = _arrange(n, mended | taken)
            cost = float(look.excess(grams.remains(places, whole), places).sum())
            tried.append((cost, {c: each for c, each in taken.items() if each != (c, 1.0)}))
    least = min(cost for cost, _ in tried)
    enough = least + NEAR * (float(excess.sum()) - least)
    cost, changed = min((each for each in tried if each[0] <= enough), key=lambda each: (len(each[1]), each[0]))
    if not changed:
        return None
    places, whole = _arrange(n, mended | changed)
    left = grams.remains(places, whole)
    rows = list(changed)
    after, before = float(look.excess(left, places)[rows].sum()), float(excess[rows].sum())
    better = AMISS * len(rows) <= before and after < BETTER * before
    if not (better or cost < BETTER * float(excess.sum())) or after >= GOOD * len(rows):
        return None
    taken_as = ", ".join(
        f"{channels[c].letter} = {'-' if sign < 0 else ''}{channels[d].letter}" for c, (d, sign) in changed.items()
    )
    point, kind = channels[own[0]].point, channels[own[0]].kind
    advice = "" if kind == REACTION else f" or the angles of {point}"
    line = (
        f"{point}.{kind}: signs or axes are evidently wrong: with {taken_as} the fit leaves "
        f"{look.percent(left, places, rows):.3g} % of the data in place of "
        f"{look.percent(given, list(range(n)), rows):.3g} %; correct the columns{advice}"
    )
    return Finding(point, kind, changed, cost, line)


def _arrange(n: int, taken: Taken) -> tuple[list[int], list[float]]:
    """Channels and signs of the data at each of n channels."""
    whole = [taken.get(c, (c, 1.0)) for c in range(n)]
    return [d for d, _ in whole], [sign for _, sign in whole]


class Grams:
    """Products of channels, from which the residual of any arrangement follows by a small linear system."""

    def __init__(self, measured: Array, predicted: Array, by: Array, units: Array, alive: Sequence[int]) -> None:
        T = len(measured)
        J = by / (np.sqrt(np.mean((by / units[:, None]) ** 2, axis=(0, 1))) + 1e-300)
        self._units, self._alive = units, list(alive)
        self._JJ = np.matmul(J.transpose(1, 2, 0), J.transpose(1, 0, 2)) / T
        self._JP = np.einsum("tcp,tc->cp", J, predicted) / T
        self._JM = np.einsum("tcp,td->cdp", J, measured) / T
        self._PP = np.mean(predicted**2, axis=0)
        self._PM = predicted.T @ measured / T
        self._MM = np.mean(measured**2, axis=0)

    def remains(self, places: Sequence[int], signs: Sequence[float]) -> Array:
        """Mean squares of what the linear fit leaves of the data `places` with `signs`, taken as the channels (C)."""
        own = self._alive
        data, sign = np.array(places, dtype=int)[own], np.array(signs)[own]
        weights = 1.0 / self._units[data] ** 2
        slopes = sign[:, None] * self._JM[own, data] - self._JP[own]
        rest = self._MM[data] - 2.0 * sign * self._PM[own, data] + self._PP[own]
        step = np.linalg.lstsq(np.tensordot(weights, self._JJ[own], 1), weights @ slopes, rcond=1e-12)[0]
        found = np.zeros(len(places))
        found[own] = np.maximum(rest - 2.0 * slopes @ step + np.einsum("p,cpq,q->c", step, self._JJ[own], step), 0.0)
        return found
