"""Slews of unbalanced wheels at working speeds: planned on the mean stand, with what unbalance adds said beside."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.programme import Programme, programme_text, read_programme
from mahovik.core.motion.required.slew_file import motion_of_slew
from mahovik.core.stand.mean import mean_stand
from mahovik.core.stand.whole import mass_properties
from mahovik.proof.verify.programme import verify_programme
from mahovik.proof.verify.programme.mechanics import residuals, scale_of
from mahovik.proof.verify.programme.simulation import simulate
from mahovik.use.plan.outcome import Plan
from mahovik.use.plan.slew import plan_slew
from mahovik.use.plan.unbalance import twist_at_rest, unbalance_effect
from plan.slew.stands import ATTITUDE, about, sat4, slew

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


@pytest.mark.parametrize(
    "keys",
    [
        pytest.param({"end": about_z(5), "duration": 10, "start": against(500)}, marks=SLOW),
        pytest.param({"end": about_z(30), "duration": 20, "start": against(100)}, marks=SLOW),
        pytest.param({"end": about_z(10), "duration": 10, "start": against(60)}, marks=SLOW),
        pytest.param({"end": about_z(30), "duration": 60, "start": against(100)}, marks=SLOW),
        pytest.param({"end": about_z(30), "start": against(314)}, marks=SLOW),
        pytest.param({"end": about_z(30), "start": against(500)}, marks=SLOW),
        pytest.param({"end": about_z(90), "start": {"phi_dot": 500}}, marks=SLOW),
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


def test_the_carrier_begins_with_the_momentum_of_the_mean_stand() -> None:
    """So it does not drift: over ten seconds the shift of O1 stays what it is in one turn of the wheels."""
    figures = quick().report["unbalance"]
    assert figures["shift"]["largest"] < 3.0 * figures["shift"]["rms"]
    stand, speeds = mean_stand(sat4()), np.array([314.0, -314.0, 314.0, -314.0])
    assert twist_at_rest(stand, np.zeros(6), np.zeros(4), speeds) == pytest.approx(np.zeros(6), abs=1e-15)


def test_without_unbalance_nothing_is_added() -> None:
    stand = mean_stand(sat4())
    wanted = slew(stand, end=about_z(5), duration=10, start=against(50))
    figures = plan_slew(stand, wanted, verify=False).programmes[0].report["unbalance"]
    assert figures["angle"]["largest"] < 1e-9 and figures["shift"]["largest"] < 1e-9


@pytest.mark.slow
def test_the_programme_says_so_and_is_not_taken_for_a_resisted_one() -> None:
    stand, programme = sat4(), quick()
    again = read_programme(programme_text(programme))
    assert again.unbalance == "averaged"
    assert programme_text(again) == programme_text(programme)
    keys: dict[str, Any] = {"end": about_z(5), "duration": 10, "start": against(314)}
    other = slew(stand, unbalance="resisted", **keys)
    findings = verify_programme(stand, motion_of_slew(other, replace(programme, unbalance="resisted")), programme)
    assert {each.name for each in findings if not each.passed} == {"motion"}
    motion = motion_of_slew(other, replace(programme, unbalance="resisted"))
    for held, error in ((mean_stand(stand), (0.0, 1e-6)), (stand, (1e-2, np.inf))):
        found = residuals(held, motion, programme, scale_of(held, motion, programme), times=50).residual.max()
        assert error[0] <= found <= error[1]


def test_near_rest_unbalance_can_be_resisted() -> None:
    """The flywheels' ripple is in the programme, and nothing is added; wheels from rest do not pass zero speed."""
    found = planned(end=about_z(3), duration=5, unbalance="resisted", verify=True)
    assert found.status == "OK", found.words
    programme = found.programmes[0]
    assert "unbalance" not in programme.report
    assert '"unbalance"' not in programme_text(programme)
    assert programme.report["through_zero"] == []


def test_a_wheel_that_reverses_passes_zero_speed() -> None:
    found = planned(end=about_z(30), duration=20, start={"phi_dot": [0.5, -0.5, 0.5, -0.5]})
    names = found.programmes[0].report["through_zero"]
    peaks = np.sign(found.programmes[0].at(np.linspace(0, 20, 41)).phi_dot)
    reversing = [wheel.name for wheel, signs in zip(sat4().flywheels, peaks.T, strict=True) if len(set(signs)) > 1]
    assert names == reversing != []


@SLOW
def test_torque_of_the_motor_is_within_its_limit_where_friction_brakes_too() -> None:
    """The drive torque tau, friction included, may be more than the motor's own while it brakes."""
    found = planned(end=about_z(20), bounds={"torque": 0.1}, verify=True)
    report = found.programmes[0].report
    assert report["peak_torque"].max() > 0.1 >= report["peak_motor_torque"].max() > 0.099
    assert report["verified"], report["verification"]  # the bound of the file is one of the motor


def test_a_pitch_of_90_degrees_is_refused_without_a_warning(recwarn: pytest.WarningsRecorder) -> None:
    found = planned(end={"angles": [0, "90 deg", 0]}, duration=20)
    assert found.status == "SINGULAR_ATTITUDE"
    assert [str(each.message) for each in recwarn] == []


def accelerometer(*rows: str) -> list[Any]:
    return [{"point": "acc1", "rows": list(rows)}]


def test_a_point_at_rest_on_the_mean_needs_nothing() -> None:
    found = planned(rows=accelerometer("vx", "vy", "vz"), start=against(100), duration=1, verify=True)
    assert found.status == "OK", found.words
    assert found.programmes[0].report["peak_acceleration"].max() < 1e-9


def test_a_point_that_unbalance_alone_would_hold_is_refused_by_its_direction() -> None:
    """Along the line through the centre of mass no moment accelerates it."""
    found = planned(rows=accelerometer("vx", "vy", "vz"), start=against(100), duration=1, unbalance="resisted")
    words = found.words[0]
    assert found.reason == "SPAN" and "they give no acceleration of acc1 along (" in words
    direction = np.array([float(x) for x in words.split("(")[1].split(")")[0].split(",")])
    line = np.array(sat4().points[0].position) - mass_properties(sat4()).center_of_mass
    assert np.linalg.norm(np.cross(direction, line / np.linalg.norm(line))) < 2e-3


def test_a_row_within_reach_is_held_against_unbalance() -> None:
    found = planned(rows=accelerometer("vx"), start=against(10), duration=1, unbalance="resisted")
    assert found.status == "OK", found.words


@pytest.mark.slow
@pytest.mark.parametrize("aside", [False, True])
def test_a_point_stays_at_rest_while_the_carrier_turns_about_the_line_through_it(aside: bool) -> None:
    """Six rows: about the line through the centre of mass the wheels do it; about another they have no force."""
    stand = sat4()
    line = np.array(stand.points[0].position) - mass_properties(mean_stand(stand)).center_of_mass
    axis = line + np.array([0.1, 0.0, 0.0]) * aside
    rows = [*ATTITUDE, *accelerometer("vx", "vy", "vz")]
    found = planned(rows=rows, start=against(200), end=about(axis, 0.4), duration=20, verify=True)
    if aside:
        assert found.reason == "SPAN" and "no force along" in found.words[0]
        return
    assert found.status == "OK", found.words
    carrier = found.programmes[0].carrier
    assert carrier is not None and np.abs(carrier.q[:, :3]).max() > 1e-3  # O1 goes round the line
