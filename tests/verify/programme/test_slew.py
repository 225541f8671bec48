"""A slew's own items see what is wrong with a programme or its course, and whose motors cannot do it."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.course import PlannedCourse
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


@pytest.mark.slow
def test_the_programme_passes() -> None:
    assert failed(*case()) == set()


@pytest.mark.slow
def test_another_end_is_seen() -> None:
    """2 arcsec beside what the programme was made for."""
    stand, wanted, programme = case()
    other = replace(wanted, angle=wanted.angle + np.radians(2 / 3600))
    assert failed(stand, other, programme) == {"slew end"}


@pytest.mark.slow
def test_a_course_that_the_wheels_do_not_make_is_seen() -> None:
    stand, wanted, programme = case()
    assert programme.carrier is not None
    own: PlannedCourse = programme.carrier
    grown = moved(programme, q=1.001 * own.q, q_dot=1.001 * own.q_dot, q_ddot=1.001 * own.q_ddot)
    assert {"residual", "simulation", "slew end"} <= failed(stand, wanted, grown)
    drifting = moved(programme, q_dot=own.q_dot + np.array([1e-3, 0, 0, 0, 0, 0]))
    assert "slew start" in failed(stand, wanted, drifting)


@pytest.mark.slow
def test_another_start_of_the_wheels_is_seen() -> None:
    stand, wanted, programme = case()
    assert failed(stand, replace(wanted, phi_dot=(21.0, 0.0, 5.0, 0.0)), programme) == {"start phi_dot"}


@pytest.mark.slow
def test_weaker_motors_are_seen() -> None:
    """The same programme on motors of a twentieth of its torque, or of less speed; the identity fails besides."""
    _, wanted, programme = case()
    for motor, name in (("{ torque = 0.01 }", "motor torque"), ('{ torque = 0.2, speed = "150 rpm" }', "motor speed")):
        assert failed(satellite(PYRAMID, motor), wanted, programme) >= {"stand", name}
