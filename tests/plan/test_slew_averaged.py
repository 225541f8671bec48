"""Slews of unbalanced wheels at working speeds: planned on the mean stand, with what unbalance adds said beside."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.programme import Programme, programme_text
from mahovik.core.motion.required.slew_file import motion_of_slew
from mahovik.proof.verify.programme.mechanics import scale_of
from mahovik.proof.verify.programme.simulation import simulate
from mahovik.use.plan.outcome import Plan
from mahovik.use.plan.slew import plan_slew
from mahovik.use.plan.unbalance import twist_at_rest, unbalance_effect
from plan.slew_stands import sat4, slew

SLOW = pytest.mark.slow
ARCSEC = np.pi / 648000.0
MOST = 0.5 * ARCSEC
"""rad: accepted distance from the end on the stand itself."""


def about_z(degrees: float) -> dict[str, Any]:
    return {"angles": [f"{degrees} deg", 0, 0]}


def against(speed: float) -> dict[str, Any]:
    """Wheels whose momenta cancel."""
    return {"phi_dot": [speed, -speed, speed, -speed]}


def planned(verify: bool = False, **keys: Any) -> Plan:
    return plan_slew(sat4(), slew(sat4(), **keys), verify=verify)


@cache
def quick() -> Programme:
    return planned(end=about_z(5), duration=10, start=against(314)).programmes[0]


@pytest.mark.slow
@pytest.mark.parametrize(
    "keys",
    [
        {"end": about_z(30), "duration": 60, "start": against(100)},
        {"end": about_z(30), "start": against(500)},
        {"end": about_z(90), "start": {"phi_dot": 500}},
    ],
)
def test_wheels_at_working_speeds_slew(keys: dict[str, Any]) -> None:
    """Some hundred rows do at any speed; the stand itself ends where demanded but for what unbalance shakes."""
    found = planned(verify=True, **keys)
    assert found.status == "OK", found.words
    programme = found.programmes[0]
    assert programme.unbalance == "averaged"
    assert len(programme.course.t) < 1000  # type: ignore[union-attr]
    assert all(each["passed"] for each in programme.report["verification"])
    angle = programme.report["unbalance"]["angle"]
    assert 0.0 < angle["end"] <= angle["largest"] < MOST
    assert angle["rms"] < angle["largest"]


@pytest.mark.slow
def test_what_unbalance_adds_is_what_the_reference_simulates() -> None:
    """The literal reference over the first turns of the wheels, by another method in other coordinates."""
    stand, programme = sat4(), quick()
    motion = motion_of_slew(slew(stand, end=about_z(5), duration=10, start=against(314)), programme)
    found = unbalance_effect(stand, motion, programme)
    assert found is not None
    k = int(np.searchsorted(found.t, 0.05))
    start = programme.at(np.zeros(1))
    V = twist_at_rest(stand, np.zeros(6), start.phi[0], start.phi_dot[0])
    t = found.t[: k + 1 : 8]
    scale = replace(scale_of(stand, motion, programme), amplitude=1e-3)
    y = simulate(stand, programme.at, np.concatenate([np.zeros(6), V]), t, scale, 1e-3)
    aside = y[:, :6] - motion.at(t, programme.bias).q
    assert aside[:, :3] == pytest.approx(found.shift[: k + 1 : 8], abs=1e-4 * float(np.abs(found.shift).max()))
    yaw_pitch_roll = found.turn[: k + 1 : 8, ::-1]  # near the attitude of E0 they are the small angles, in reverse
    assert aside[:, 3:] == pytest.approx(yaw_pitch_roll, abs=2e-3 * float(np.abs(found.turn).max()))


def test_near_rest_unbalance_can_be_resisted() -> None:
    """The flywheels' ripple is in the programme, and nothing is added; wheels from rest do not pass zero speed."""
    found = planned(end=about_z(3), duration=5, unbalance="resisted", verify=True)
    assert found.status == "OK", found.words
    programme = found.programmes[0]
    assert "unbalance" not in programme.report
    assert '"unbalance"' not in programme_text(programme)
    assert programme.report["through_zero"] == []


@SLOW
def test_torque_of_the_motor_is_within_its_limit_where_friction_brakes_too() -> None:
    """The drive torque tau, friction included, may be more than the motor's own while it brakes."""
    found = planned(end=about_z(20), bounds={"torque": 0.1}, verify=True)
    report = found.programmes[0].report
    assert report["peak_torque"].max() > 0.1 >= report["peak_motor_torque"].max() > 0.099
    assert report["verified"], report["verification"]  # the bound of the file is one of the motor
