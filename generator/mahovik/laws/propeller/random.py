"""Random propellers, for verification and tests."""

from __future__ import annotations

from mahovik.core.stand.draw import Draw
from mahovik.core.stand.model import Body, Flywheel
from mahovik.laws.propeller.data import Propeller, Propellers


def random_flow(draw: Draw, body: Body) -> Propellers | None:
    """One or two propellers; a flywheel has none."""
    if isinstance(body, Flywheel):
        return None
    count = int(draw.rng.integers(1, 3))
    return Propellers(tuple(_random_propeller(draw, f"propeller{k + 1}_{body.name}") for k in range(count)))


def _random_propeller(draw: Draw, name: str) -> Propeller:
    """A small one, at rest in one of five cases."""
    rng = draw.rng
    k0, k1, k2 = (float(size) for size in rng.uniform([0.1, -0.5, -0.2], [0.5, 0.0, 0.1]))
    q0, q1, q2 = (0.15 * float(size) for size in rng.uniform([0.1, -0.5, -0.2], [0.5, 0.0, 0.1]))
    whole, left, still = (bool(flag) for flag in rng.random(3) < (0.5, 0.5, 0.2))
    return Propeller(
        name,
        draw.vec3(0.3),
        draw.vec3(1.0),
        1000.0,
        float(rng.uniform(0.05, 0.15)),
        (k0, k1, k2),
        (q0, q1, q2),
        0.0 if still else float(rng.uniform(-200.0, 200.0)),
        float(rng.uniform(0.0, 0.3)),
        float(rng.uniform(0.0, 0.2)),
        whole,
        left,
    )
