"""How well a predicted error is the error that was found, and how surely."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.proof.reference.array import Array

ABSENT = 0.1
"""Weight of quantities that a fault would spoil and that are right: a program may have it in one function only."""


@dataclass(frozen=True)
class Match:
    """Likeness of a predicted error p and the error e that was found.

    score   0: p is e to rounding; 1: it explains nothing of it
    rest    the same over the quantities that are wrong, without what is right and should not be
    absent  indices of the quantities that p would spoil and that are right
    """

    score: float
    rest: float
    absent: tuple[int, ...]


def match(e: Array, p: Array, noise: Array, block: NDArray[np.int64]) -> Match:
    """Number by number, so that a small term counts as much as a large one; the mean of each quantity, then of all.

    What neither says is beyond `noise` counts nothing. A p that is no number explains nothing.
    """
    wrong, predicted = np.abs(e) > noise, ~(np.abs(p) <= noise)
    count = int(block.max()) + 1 if block.size else 0
    with np.errstate(all="ignore"):
        off = (np.abs(e - p) - noise) / np.maximum(np.abs(e), np.abs(p))
    off = np.clip(np.nan_to_num(off, nan=1.0, posinf=1.0), 0.0, 1.0)
    active = wrong | predicted
    of_block = np.bincount(block[active], minlength=count)
    mean = np.bincount(block[active], weights=off[active], minlength=count) / np.maximum(of_block, 1)
    spoiled = np.bincount(block[wrong], minlength=count) > 0
    absent = (of_block > 0) & ~spoiled
    if not spoiled.any():
        return Match(1.0, 1.0, tuple(np.flatnonzero(absent)))
    rest = float(mean[spoiled].mean())
    missing = float(absent.sum() / (absent.sum() + spoiled.sum()))
    return Match(rest + ABSENT * missing, rest, tuple(int(i) for i in np.flatnonzero(absent)))


def share(e: Array, p: Array, noise: Array) -> float:
    """a of e = a p: least squares of each number over its size, without what is far from the middle; 0 where p is."""
    seen = np.isfinite(p) & (np.abs(p) > 10 * noise)
    if not seen.any():
        return 0.0
    ratios = e[seen] / p[seen]
    a = float(np.median(ratios))
    near = np.abs(ratios - a) <= 0.5 * abs(a)
    if not near.any():
        return a
    weight = 1.0 / np.maximum(np.abs(e[seen][near]), np.abs(p[seen][near])) ** 2
    product = float(np.sum(weight * e[seen][near] * p[seen][near]))
    return product / float(np.sum(weight * p[seen][near] ** 2))
