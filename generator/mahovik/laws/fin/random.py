"""Random fins, for verification and tests."""

from __future__ import annotations

from mahovik.core.stand.draw import Draw
from mahovik.core.stand.model import Body, Flywheel
from mahovik.laws.fin.data import SPEEDS, Fin, Fins


def random_flow(draw: Draw, body: Body) -> Fins | None:
    """One or two fins; a flywheel has none. Those that feel the angle of the flow stall: else lift jumps astern."""
    if isinstance(body, Flywheel):
        return None
    return Fins(tuple(_random_fin(draw, f"fin{k + 1}_{body.name}") for k in range(int(draw.rng.integers(1, 3)))))


def _random_fin(draw: Draw, name: str) -> Fin:
    rng = draw.rng
    incidence = bool(rng.random() < 0.7)
    stall = float(rng.uniform(0.2, 0.6)) if incidence or rng.random() < 0.5 else None
    return Fin(
        name,
        draw.vec3(0.3),
        draw.vec3(1.0),
        draw.vec3(1.0),
        1000.0,
        float(rng.uniform(0.002, 0.03)),
        float(rng.uniform(1.0, 5.0)),
        float(rng.uniform(0.0, 0.1)),
        float(rng.uniform(0.0, 0.3)),
        stall,
        float(rng.uniform(-0.5, 0.5)),
        SPEEDS[int(rng.integers(3))],
        incidence,
    )
