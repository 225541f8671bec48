"""A slew's own items see what is wrong with a programme or its course, and whose motors cannot do it."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import Slew
from mahovik.core.motion.required.slew_file import motion_of_slew
from mahovik.core.stand import Stand
from mahovik.proof.verify.programme import verify_programme
from mahovik.use.plan.slew import plan_slew
from plan.slew_stands import PYRAMID, about, satellite, slew


@cache
def case() -> tuple[Stand, Slew, Programme]:
    stand = satellite(PYRAMID)
    wanted = slew(stand, end=about((1, 2, 0), 0.4), duration=6, start={"phi_dot": [20, 0, 5, 0]})
    return stand, wanted, plan_slew(stand, wanted, verify=False).programmes[0]


def failed(stand: Stand, wanted: Slew, programme: Programme) -> set[str]:
    return {
        each.name for each in verify_programme(stand, motion_of_slew(wanted, programme), programme) if not each.passed
    }


def moved(programme: Programme, **changed: Any) -> Programme:
    assert programme.carrier is not None
    return replace(programme, carrier=replace(programme.carrier, **changed))


def grown(programme: Programme) -> Programme:
    """A course that the wheels do not make."""
    own = programme.carrier
    assert own is not None
    return moved(programme, q=1.001 * own.q, q_dot=1.001 * own.q_dot, q_ddot=1.001 * own.q_ddot)


def drifting(programme: Programme) -> Programme:
    """A course that does not begin at rest."""
    assert programme.carrier is not None
    return moved(programme, q_dot=programme.carrier.q_dot + np.array([1e-3, 0, 0, 0, 0, 0]))


@pytest.mark.slow
def test_a_slew_passes_and_what_is_wrong_with_it_is_named() -> None:
    """Another end by 2 arcsec, another start of the wheels, other courses; weaker or slower motors on another stand."""
    stand, wanted, programme = case()
    assert failed(stand, wanted, programme) == set()
    assert failed(stand, replace(wanted, angle=wanted.angle + np.radians(2 / 3600)), programme) == {"slew end"}
    assert failed(stand, replace(wanted, phi_dot=(21.0, 0.0, 5.0, 0.0)), programme) == {"start phi_dot"}
    assert {"residual", "simulation", "slew end"} <= failed(stand, wanted, grown(programme))
    assert "slew start" in failed(stand, wanted, drifting(programme))
    for motor, name in (("{ torque = 0.01 }", "motor torque"), ('{ torque = 0.2, speed = "150 rpm" }', "motor speed")):
        assert failed(satellite(PYRAMID, motor), wanted, programme) >= {"stand", name}
