"""Random fading damping, for verification and tests."""

from __future__ import annotations

from typing import cast

from mahovik.core.stand.draw import Draw, rows
from mahovik.core.stand.model import Body, Mat6
from mahovik.laws.fading.data import FadingDamping


def random_flow(draw: Draw, body: Body) -> FadingDamping:
    """Fading damping of a body of any kind, of the size of its mass."""
    return FadingDamping(cast(Mat6, rows(draw.definite6(2.0 * body.mass))), float(draw.rng.uniform(0.2, 3.0)))
