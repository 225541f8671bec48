"""Raw data of the cross-flow drag of one body, as the stand file gives them, in SI."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mahovik.core.stand.model import LawData


@dataclass(frozen=True)
class Strip:
    """A strip at x (m): force over the square of its velocity along y and along z (N s2/m2)."""

    x: float
    y: float
    z: float


@dataclass(frozen=True)
class CrossFlow(LawData):
    """Drag of the motion across the first axis of a body: -(density/2) integral (C_y h |v| v, C_z b |w| w) dx.

    v, w        velocity of the place x of the axis relative to the fluid, along y and z of the body
    x           stations, m, rising; between them all tables are linear
    height      h (m) of the body along z at the stations, which meets v; `breadth`: b along y, which meets w
    drag_y      C_y at the stations, and `drag_z` C_z
    points      points of Gauss and Legendre between two stations
    together    the drag is along the whole velocity across: (C_y h v^2 + C_z b w^2) (v, w)/sqrt(v^2 + w^2)
    """

    density: float
    x: tuple[float, ...]
    height: tuple[float, ...]
    breadth: tuple[float, ...]
    drag_y: tuple[float, ...]
    drag_z: tuple[float, ...]
    points: int
    together: bool

    @property
    def nonlinear(self) -> bool:
        """True: it is quadratic."""
        return True

    @property
    def has_kinks(self) -> bool:
        """True: it depends on magnitudes."""
        return True

    @property
    def count(self) -> int:
        """Number of strips."""
        return self.points * (len(self.x) - 1)

    @property
    def strips(self) -> tuple[Strip, ...]:
        """The strips of the quadrature, from the first station on."""
        nodes, weights = np.polynomial.legendre.leggauss(self.points)
        found = []
        for a, b in pairwise(self.x):
            half = 0.5 * (b - a)
            for node, weight in zip(nodes.tolist(), weights.tolist(), strict=True):
                x = a + half * (1.0 + node)
                height, breadth, drag_y, drag_z = (
                    float(np.interp(x, self.x, table))
                    for table in (self.height, self.breadth, self.drag_y, self.drag_z)
                )
                scale = 0.5 * self.density * half * weight
                found.append(Strip(x, scale * drag_y * height, scale * drag_z * breadth))
        return tuple(found)
