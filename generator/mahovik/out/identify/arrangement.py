"""Sensors with a wrong sign or exchanged axes: every arrangement of a sensor's axes is fitted, linearly."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import permutations, product

import numpy as np
from numpy.typing import NDArray

from mahovik.out.identify.channels import AXES
from mahovik.out.identify.estimate import Fit
from mahovik.out.identify.run import Run

Array = NDArray[np.float64]

BETTER = 0.5
"""An arrangement that leaves less than this share of the squares of residuals is reported."""

AMISS = 0.05
"""Arrangements are tried only where residuals have at least this share of the squares of the data."""


def wrong_axes(fit: Fit, runs: Sequence[Run]) -> list[str]:
    """One line for each sensor whose data would fit far better with other signs or axes.

    The model is taken as linear about the estimate; each channel counts by its spread in the data.
    """
    found: list[str] = []
    for r, run in enumerate(runs):
        found += _of_run(fit, r, run)
    return list(dict.fromkeys(found))


def _of_run(fit: Fit, r: int, run: Run) -> list[str]:
    there = np.isfinite(run.measured).all(axis=1)
    if np.count_nonzero(there) < 2 * run.measured.shape[1]:
        return []
    measured = run.measured[there] - run.measured[there].mean(axis=0)
    left = fit.residuals[r][there]
    left = left - left.mean(axis=0)
    predicted = measured - left
    spread = np.sqrt(np.mean(measured**2, axis=0)) + 1e-300
    if float(np.mean((left / spread) ** 2)) < AMISS:
        return []
    J = np.concatenate([fit.by_theta[r][there], fit.by_start[r][there]], axis=2)
    J = J - J.mean(axis=0)
    J = J / (np.sqrt(np.mean(J**2, axis=(0, 1))) + 1e-300)
    groups: dict[tuple[str, str], list[int]] = {}
    for c, channel in enumerate(run.channels):
        groups.setdefault((channel.point, channel.kind), []).append(c)
    grams = _Grams(measured, predicted, J, spread)
    n = len(run.channels)
    as_given = grams.misfit(list(range(n)), [1.0] * n)
    lines = []
    for (point, kind), own in groups.items():
        best = (as_given, tuple(own), (1.0,) * len(own))
        for order in permutations(own):
            for signs in product((1.0, -1.0), repeat=len(own)):
                places, whole = list(range(n)), [1.0] * n
                for c, taken, sign in zip(own, order, signs, strict=True):
                    places[c], whole[c] = taken, sign
                cost = grams.misfit(places, whole)
                if cost < best[0] * (1.0 - 1e-9):
                    best = (cost, order, signs)
        if best[0] < BETTER * as_given:
            axes = [AXES[run.channels[c].axis] for c in own]
            taken_as = ", ".join(
                f"{axis} = {'-' if sign < 0 else ''}{AXES[run.channels[c].axis]}"
                for axis, c, sign in zip(axes, best[1], best[2], strict=True)
                if sign < 0 or AXES[run.channels[c].axis] != axis
            )
            before, after = (100.0 * float(np.sqrt(x / n)) for x in (as_given, best[0]))
            lines.append(
                f"{point}.{kind}: signs or axes are evidently wrong: with {taken_as} the fit leaves {after:.3g} % of "
                f"the data in place of {before:.3g} %; correct the columns or the angles of {point}"
            )
    return lines


class _Grams:
    """Products of all channels, from which the residual of any arrangement follows by a small linear system."""

    def __init__(self, measured: Array, predicted: Array, J: Array, spread: Array) -> None:
        T = len(measured)
        self.spread = spread
        self.JJ = np.einsum("tcp,tcq->cpq", J, J) / T
        self.JP = np.einsum("tcp,tc->cp", J, predicted) / T
        self.JM = np.einsum("tcp,td->cdp", J, measured) / T
        self.PP = np.mean(predicted**2, axis=0)
        self.PM = predicted.T @ measured / T
        self.MM = np.mean(measured**2, axis=0)

    def misfit(self, places: list[int], signs: list[float]) -> float:
        """Least sum over the channels of mean squares of residuals, each of the spread squared."""
        weights = 1.0 / self.spread[places] ** 2
        H = np.tensordot(weights, self.JJ, 1)
        g = np.zeros(H.shape[0])
        rest = 0.0
        for c, (d, sign) in enumerate(zip(places, signs, strict=True)):
            w = float(weights[c])
            g += w * (sign * self.JM[c, d] - self.JP[c])
            rest += w * float(self.MM[d] - 2.0 * sign * self.PM[c, d] + self.PP[c])
        step = np.linalg.lstsq(H, g, rcond=1e-12)[0]
        return max(rest - float(g @ step), 0.0)
