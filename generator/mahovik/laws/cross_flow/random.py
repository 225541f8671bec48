"""Random cross-flow drag, for verification and tests."""

from __future__ import annotations

from mahovik.core.stand.draw import Draw
from mahovik.core.stand.model import Body
from mahovik.laws.cross_flow.data import CrossFlow


def random_flow(draw: Draw, body: Body) -> CrossFlow:
    """Two or three pieces of a slender body of any kind, 0.4 m long or so."""
    rng = draw.rng
    n = int(rng.integers(3, 5))
    x = tuple(sorted(float(x) for x in rng.uniform(-0.3, 0.3, n)))

    def table(most: float) -> tuple[float, ...]:
        return tuple(float(size) for size in rng.uniform(0.1 * most, most, n))

    height, breadth, drag_y, drag_z = table(0.3), table(0.3), table(1.2), table(1.2)
    points, together = int(rng.integers(1, 4)), bool(rng.random() < 0.5)
    return CrossFlow(100.0 * body.mass, x, height, breadth, drag_y, drag_z, points, together)
