"""Random control derivatives, for verification and tests."""

from __future__ import annotations

from mahovik.core.stand.draw import Draw
from mahovik.core.stand.model import Body, Flywheel
from mahovik.laws.control.data import Control, ControlDerivative, ControlDerivatives, Factor, Input, Velocity


def random_steering(draw: Draw, body: Body) -> ControlDerivatives | None:
    """A few products of the velocities and of the inputs that a body has; a flywheel has none."""
    if isinstance(body, Flywheel):
        return None
    rng, known = draw.rng, _factors_of_inputs(body)
    terms = []
    for _ in range(int(rng.integers(3, 7))):
        of: list[Factor] = [Velocity(int(rng.integers(6)), bool(rng.random() < 0.3))]
        of += [known[int(rng.integers(len(known)))] for _ in range(int(rng.integers(3))) if known]
        if rng.random() < 0.5:
            of.append(Velocity(int(rng.integers(6)), False))
        size = float(rng.uniform(-1.0, 1.0)) * body.mass
        for factor in of:
            size /= 100.0 if isinstance(factor, Control) and factor.what == "speed" else 1.0
        terms.append(ControlDerivative(int(rng.integers(6)), tuple(of), size))
    races = any(isinstance(f, Control) and f.what == "race" for term in terms for f in term.of)
    return ControlDerivatives(tuple(terms), float(rng.uniform(1e-5, 1e-3)) if races else 0.0)


def _factors_of_inputs(body: Body) -> list[Factor]:
    """Every input, bare and by its magnitude, and the race of every propeller."""
    found: list[Factor] = []
    for name in body.inputs:
        of, _, member = name.rpartition(".")
        what: tuple[Input, ...] = ("speed", "race") if member == "speed" else ("deflection",)
        found += [Control(of, each, absolute) for each in what for absolute in (False, True)]
    return found
