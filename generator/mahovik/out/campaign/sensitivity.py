"""Factors that a quantity depends on: Sobol' indices, and the elementary effects of Morris, by SALib."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.errors import UsageError
from mahovik.out.campaign.designs import LEVELS, Design, Morris, Saltelli, problem

Array = NDArray[np.float64]

SEED = 1
"""Seed of the resampling for confidence intervals: the same rows give the same figures."""


@dataclass(frozen=True)
class Sensitivity:
    """Figures by factor, each (factors,).

    Sobol' indices: `S1` and `ST`, shares of the variance, alone and with all that the factor does together with others.
    Morris: `mu_star` and `sigma`, mean size and spread of the change between the lowest and the highest level.
    `S1_conf`, `ST_conf`, `mu_star_conf`: halves of 95 % confidence intervals.
    """

    factors: tuple[str, ...]
    figures: Mapping[str, Array]
    used: int
    left_out: int


def sensitivity(design: Design, values: Array) -> Sensitivity:
    """Figures of a quantity, (n,) values of the first samples of the design in order; blocks with a NaN are left out.

    Raises UsageError for a design that has none, and for too few values.
    """
    if not isinstance(design, Saltelli | Morris):
        raise UsageError('sensitivity: expected a campaign of design "saltelli" or "morris"')
    whole = len(values) // design.block
    blocks = values[: whole * design.block].reshape(whole, design.block)
    good = ~np.isnan(blocks).any(axis=1)
    if good.sum() < 2:
        raise UsageError(f"sensitivity: expected two blocks of {design.block} samples or more, found {good.sum()}")
    used = blocks[good].ravel()
    factors, left_out = design.factors, len(values) - used.size
    names = ("S1", "S1_conf", "ST", "ST_conf") if isinstance(design, Saltelli) else ("mu_star", "mu_star_conf", "sigma")
    found: Mapping[str, Any] = dict.fromkeys(names, np.zeros(len(factors)))
    if np.ptp(used) == 0.0:
        pass  # nothing depends on anything
    elif isinstance(design, Saltelli):
        from SALib.analyze.sobol import analyze

        found = analyze(problem(factors), used, calc_second_order=False, seed=SEED)
    else:
        from SALib.analyze.morris import analyze as effects

        levels = design.levels[: whole * design.block].reshape(whole, design.block, len(factors))[good]
        found = effects(problem(factors), levels.reshape(used.size, len(factors)), used, num_levels=LEVELS, seed=SEED)
    return Sensitivity(factors, {name: np.asarray(found[name], dtype=float) for name in names}, used.size, left_out)
