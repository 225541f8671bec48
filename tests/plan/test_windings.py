"""Windings inside the bounds of speed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.motion.required import Bounds, RequiredMotion, Winding
from mahovik.use.plan.windings import Kind, allowed_windings, draw_windings, kinds_in_order
from plan.problems import PERIOD, required

ONE = 2 * np.pi / PERIOD
"""rad/s: a turn a period."""


def motion(bounds: Bounds, winding: Winding = "any") -> RequiredMotion:
    return replace(required(3, bounds=bounds), winding=winding)


@pytest.mark.parametrize(
    "least, most, spin, rock",
    [
        (0.0, 9.0, (-1, 1), (0,)),
        (0.0, 0.9, (0,), (0,)),
        (0.4, 9.0, (-1, 1), (-1, 1)),
        (1.0, 9.0, (-1, 1), (-1, 1)),
        (1.1, 9.0, (-2, 2), (-2, 2)),
    ],
)
def test_mean_speeds_lie_inside_the_bounds(
    least: float, most: float, spin: tuple[int, ...], rock: tuple[int, ...]
) -> None:
    """Bounds in turns per period: too slow a bound stops the spinning, a least speed the rocking."""
    own = motion(Bounds(speed=(most * ONE,) * 3, speed_min=(least * ONE,) * 3))
    assert allowed_windings("spin", own, 1) == spin
    assert allowed_windings("rock", own, 1) == rock
    assert set(allowed_windings("mixed", own, 1)) == set(spin) | (set(rock) if least == 0.0 else set())


def test_kinds_that_no_flywheel_can_have_are_not_tried() -> None:
    """Unless the motion asks for them."""
    assert kinds_in_order(motion(Bounds()), 3) == ("rock", "spin", "mixed")
    assert kinds_in_order(motion(Bounds(speed=(0.5 * ONE,) * 3)), 3) == ("rock",)
    assert kinds_in_order(motion(Bounds(speed_min=(0.5 * ONE,) * 3)), 3) == ("spin",)
    assert kinds_in_order(motion(Bounds(speed_min=(0.5 * ONE, 0.0, 0.0))), 3) == ("rock", "spin", "mixed")
    assert kinds_in_order(motion(Bounds(), winding="spin"), 3) == ("spin",)


@pytest.mark.parametrize("kind, values", [("spin", {-1, 1}), ("rock", {0}), ("mixed", {-1, 0, 1})])
def test_drawn_windings_are_those_of_their_kind(kind: Kind, values: set[int]) -> None:
    """All of them come up; of a flywheel with a least speed only its own."""
    found = draw_windings(kind, motion(Bounds()), 3, 200, np.random.default_rng(0))
    assert found.shape == (200, 3) and set(found.ravel()) == values
    bound = motion(Bounds(speed_min=(0.0, 1.5 * ONE, 0.0)))
    assert set(draw_windings(kind, bound, 3, 200, np.random.default_rng(0))[:, 1]) == {-2, 2}
