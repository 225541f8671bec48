"""Drawing numbers of a random stand from one generator: vocabulary of bodies and laws."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Vec3

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

    def vec3(self, size: float) -> Vec3:
        x, y, z = self.rng.normal(size=3) * size
        return (float(x), float(y), float(z))

    def definite6(self, size: float) -> Array:
        """A symmetric positive definite 6x6 whose units are `size`, times m, times m2; not block diagonal."""
        factor = self.rng.normal(size=(6, 6)) * 0.3 + np.eye(6)
        scale = np.array([1.0] * 3 + [_LENGTH] * 3)
        matrix = size * (factor @ factor.T) * scale[:, None] * scale[None, :]
        return np.asarray((matrix + matrix.T) / 2)


def rows(matrix: Array) -> tuple[tuple[float, ...], ...]:
    """A matrix as rows of floats."""
    return tuple(tuple(float(x) for x in row) for row in matrix)
