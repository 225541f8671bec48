"""Drawing from one generator: numbers of a random stand, and errors of measurement; vocabulary of bodies and laws."""

from __future__ import annotations

import math
from typing import cast

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.fields import Mat6, Vec3

Array = NDArray[np.float64]

_LENGTH = 0.3  # m, makes 6x6 matrices of the right units out of numbers of one size


class Draw:
    """Pieces of a stand, drawn from one generator in a fixed order."""

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng = rng

    def flag(self, given: bool | None) -> bool:
        drawn = bool(self.rng.random() < 0.5)  # drawn always, so that one option does not shift the others
        return drawn if given is None else given

    def count(self, given: int | None, most: int) -> int:
        drawn = int(self.rng.integers(most + 1))
        return drawn if given is None else given

    def uniform(self, low: float, high: float) -> float:
        return float(self.rng.uniform(low, high))

    def vec3(self, size: float) -> Vec3:
        x, y, z = self.rng.normal(size=3) * size
        return (float(x), float(y), float(z))

    def definite6(self, size: float) -> Mat6:
        """A symmetric positive definite 6x6 whose units are `size`, times m, times m2; not block diagonal."""
        factor = self.rng.normal(size=(6, 6)) * 0.3 + np.eye(6)
        scale = np.array([1.0] * 3 + [_LENGTH] * 3)
        matrix = size * (factor @ factor.T) * scale[:, None] * scale[None, :]
        return cast(Mat6, rows((matrix + matrix.T) / 2))


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


def rows(matrix: Array) -> tuple[tuple[float, ...], ...]:
    """A matrix as rows of floats."""
    return tuple(tuple(float(x) for x in row) for row in matrix)
