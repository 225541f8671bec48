"""Errors of measurement, drawn one after the other: vocabulary of bodies and laws."""

from __future__ import annotations

import math
from typing import cast

import numpy as np

from mahovik.core.stand.model import Mat6, Vec3
from mahovik.use.plan.array import Array


class Errors:
    """Errors of at most `share`, drawn one after the other."""

    def __init__(self, rng: np.random.Generator, share: float) -> None:
        self.rng, self.share = rng, share

    def errors(self, count: int) -> Array:
        return self.rng.uniform(-self.share, self.share, count)

    def times(self, value: float) -> float:
        return value * (1.0 + float(self.errors(1)[0]))

    def vector(self, value: Vec3) -> Vec3:
        size = float(np.linalg.norm(value)) / math.sqrt(3.0)
        return cast(Vec3, tuple((np.array(value) + size * self.errors(3)).tolist()))

    def direction(self) -> Array:
        return self.errors(3) / math.sqrt(3.0)

    def matrix(self, value: Mat6 | None) -> Mat6 | None:
        if value is None:
            return None
        S = np.sqrt(1.0 + self.errors(6))
        return cast(Mat6, tuple(map(tuple, (S[:, None] * np.array(value) * S).tolist())))
