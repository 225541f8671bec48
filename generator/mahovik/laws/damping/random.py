"""Random damping, for verification and tests."""

from __future__ import annotations

from typing import cast

from mahovik.core.stand.draw import Draw, rows
from mahovik.core.stand.model import Mat6
from mahovik.laws.damping.data import Damping, DampingTerm, Factor


def random_data(draw: Draw, mean: float, mass: float, size: float) -> Damping:
    """Damping by matrices and terms for a body of the mean mass `mean` (kg)."""
    rng = draw.rng
    linear, quadratic = draw.definite6(0.8 * mean), draw.definite6(0.6 * mean)
    terms = tuple(
        DampingTerm(
            int(rng.integers(6)),
            (
                Factor(int(rng.integers(6)), bool(rng.random() < 0.3)),
                Factor(int(rng.integers(6)), bool(rng.random() < 0.5)),
            ),
            float(rng.normal() * 0.2 * mean),
        )
        for _ in range(int(rng.integers(4)))
    )
    with_linear, with_quadratic = rng.random(2) < 0.7
    return Damping(
        cast(Mat6, rows(linear)) if with_linear or not (with_quadratic or terms) else None,
        cast(Mat6, rows(quadratic)) if with_quadratic else None,
        terms,
    )
