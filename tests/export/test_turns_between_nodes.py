"""Finite tables in C whose flywheels turn many times from node to node: the speeds at the nodes say how often."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.motion.programme import Programme, Samples
from mahovik.core.stand import load
from mahovik.core.stand.identity import identities
from mahovik.out.export.programme.files import export_programme

SPAN = 10.0


def even_programme(speed: float, gained: float) -> Programme:
    """Flywheels of sat4 at `speed` (rad/s) that gain up to `gained` by a fifth-order polynomial."""
    stand = load(stands.path("sat4"))
    x = np.linspace(0.0, 1.0, 41)
    law = np.polynomial.Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])
    share = np.array([1.0, -1.0, 0.5, 0.0])
    columns = [
        np.outer(SPAN * law.integ()(x), share) * gained + speed * np.outer(SPAN * x, np.sign(share)),
        np.outer(law(x), share) * gained + speed * np.sign(share),
        np.outer(law.deriv()(x) / SPAN, share) * gained,
    ]
    whose = identities(stand)
    return Programme(
        stand.name, whose.structure, whose.physics, "even", tuple(each.name for each in stand.flywheels), False, SPAN,
        np.zeros(6), (0, 0, 0, 0), Samples(x * SPAN, *columns),
    )  # fmt: skip


@pytest.mark.parametrize(("real", "angle"), [("double", 1e-9), ("float", 2e-4)])
@pytest.mark.parametrize("speed", [3.0, 500.0])
def test_no_turn_is_lost(real: str, angle: float, speed: float) -> None:
    """At 500 rad/s fifteen turns to an interval of 0.2 s."""
    made = export_programme(
        load(stands.path("sat4")), even_programme(speed, 30.0), nodes=64, real=real, limit=0.1
    )  # fmt: skip
    assert made.errors[0].phi < angle
    assert made.errors[0].phi_dot < angle * (speed + 30.0)
