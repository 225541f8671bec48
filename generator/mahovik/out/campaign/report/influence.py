"""Influence of the drawn numbers on a quantity, from rows of any design: shares of its variance, and straight lines.

The share of a parameter is the first Sobol' index, estimated from rows as they are: the variance of the means of the
quantity in bins of equal counts of the parameter, less what scatter within the bins adds to it. Saltelli et al.,
Global Sensitivity Analysis, 2008, 1.2.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BINS = 20
"""Bins of a parameter."""

LEAST = 4 * BINS
"""Rows without which nothing is said."""


@dataclass(frozen=True)
class Influence:
    """Influence of a parameter on a quantity.

    share        of the variance, by the parameter alone, 0..1
    change       of the quantity while the parameter rises by its standard deviation, by linear regression on all
                 parameters, in standard deviations of the quantity
    rank         rank correlation of Spearman
    """

    parameter: str
    share: float
    change: float
    rank: float


def influences(parameters: Mapping[str, Array], values: Array) -> tuple[list[Influence], float]:
    """Influence of every parameter, the largest share first, and the part of the variance that straight lines explain.

    parameters, values: (n,) each. Nothing where there are few rows, or all are equal.
    """
    varying = {name: column for name, column in parameters.items() if np.ptp(column) > 0.0}
    if len(values) < max(LEAST, 3 * len(varying)) or np.ptp(values) == 0.0 or not varying:
        return [], 0.0
    y = (values - values.mean()) / values.std()
    x = np.column_stack([(column - column.mean()) / column.std() for column in varying.values()])
    slopes = np.linalg.lstsq(x, y, rcond=None)[0]
    explained = 1.0 - float(np.mean((y - x @ slopes) ** 2))
    order = _ranks(y)
    found = [
        Influence(name, binned_share(column, y), float(slope), float(np.corrcoef(_ranks(column), order)[0, 1]))
        for (name, column), slope in zip(varying.items(), slopes, strict=True)
    ]
    return sorted(found, key=lambda each: -each.share), explained


def binned_share(column: Array, values: Array, bins: int = BINS) -> float:
    """Share of the variance of the values that the means in bins of the column have, without bias; 0 at least."""
    total = float(np.var(values))
    parts = [values[each] for each in np.array_split(np.argsort(column, kind="stable"), bins)]
    counts = np.array([len(part) for part in parts])
    means = np.array([part.mean() for part in parts])
    between = float(np.average((means - values.mean()) ** 2, weights=counts))
    within = total - between
    unbiased = between - within * (bins - 1) / max(len(values) - bins, 1)
    return float(np.clip(unbiased / total, 0.0, 1.0)) if total > 0.0 else 0.0


def bin_means(column: Array, values: Array, bins: int = BINS) -> tuple[Array, Array]:
    """Means of column and values in bins of equal counts of the column."""
    parts = np.array_split(np.argsort(column, kind="stable"), bins)
    return np.array([column[each].mean() for each in parts]), np.array([values[each].mean() for each in parts])


def _ranks(values: Array) -> Array:
    """Ranks, equal values in the order of the rows."""
    found = np.empty(len(values))
    found[np.argsort(values, kind="stable")] = np.arange(len(values))
    return found
