"""A right programme passes, its run-up and run-down too; of a slew, and of these, what is wrong is named."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.motion.functions import Fourier, Harmonics, Samples
from mahovik.core.motion.motion_file import motion_of_slew, read_motion
from mahovik.core.motion.programme import Programme, RunUpTable
from mahovik.core.motion.required import Bounds, Deviation, Slew, Start
from mahovik.core.stand import Stand, load
from mahovik.core.stand.model import Sequence
from mahovik.core.stand.random import SEQUENCES
from mahovik.errors import StateError
from mahovik.laws.suspension.law import Suspension
from mahovik.proof.reference.algebra import Array, attitude, cross
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.programme.mechanics import (
    carrier_at,
    displacement,
    free_acceleration,
    moment,
    rest_near,
    twist,
)
from mahovik.proof.verify.programme.verification import ProgrammeCase, verify_programme
from mahovik.use.plan.slew import plan_slew
from plan.slew_stands import PYRAMID, about, satellite, slew
from verify.programme.programmes import Case, failed, item, shaker, tabled, twins, twins_run_up


@cache
def right() -> tuple[Check, ...]:
    return verify_programme(*shaker())


def test_a_right_programme_passes() -> None:
    checks = right()
    assert failed(checks) == set()
    assert item(checks, "residual").value < 1e-11
    assert item(checks, "simulation").value < 1e-8
    assert [check.quantity for check in checks] == [
        "stand", "motion", "winding", "table", "periodicity", "bias", "residual", "simulation",
    ]  # fmt: skip


def test_the_same_as_a_table_passes() -> None:
    stand, motion, programme = shaker()
    assert failed(verify_programme(stand, motion, programme.with_course(tabled()))) == set()


def test_a_carrier_that_is_held_still() -> None:
    stand, motion, programme = twins()
    assert failed(verify_programme(stand, motion, programme)) == set()
    one_way = programme.with_course(Fourier(np.zeros(2), np.array([[0.01, 0.0]]), np.zeros((1, 2))))
    assert failed(verify_programme(stand, motion, one_way)) == {"residual", "simulation"}


def still_from_rest() -> Case:
    """The carrier of `twins` held still while its wheels run up: a finite motion."""
    stand, _, programme = twins()
    table = twins_run_up()
    samples = {"t": np.linspace(0.0, table.duration, 12).tolist(), "q": [[0.0] * 6] * 12}
    document = {"schema": 1, "name": "hold", "type": "finite", "duration": table.duration, "samples": samples}
    motion = read_motion(json.dumps(document), stand)
    return stand, motion, Programme.of(stand, "hold", table.duration, programme.bias, None, table.samples)


@pytest.mark.slow
def test_a_finite_programme() -> None:
    stand, motion, programme = still_from_rest()
    phi = programme.at(np.zeros(1)).phi[0]
    wanted = replace(motion, bounds=Bounds(start=Start(tuple(phi), (0.0, 0.0))))
    checks = verify_programme(stand, wanted, programme)
    assert failed(checks) == set()
    assert {"start phi", "start phi_dot", "table", "simulation"} <= {check.quantity for check in checks}
    elsewhere = replace(motion, bounds=Bounds(start=Start((phi[0] + 0.1, phi[1]), (0.0, 0.5))))
    assert failed(ProgrammeCase.of(stand, elsewhere, programme).beginning()) == {
        "start phi",
        "start phi_dot",
    }


STAND = load(stands.path("demo3"))


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_twist_and_its_rate_along_a_motion(sequence: Sequence) -> None:
    stand = replace(STAND, angles=sequence)
    rng = np.random.default_rng(5)
    course = Harmonics(1.0, (1, 2), 0.2 * rng.normal(size=(2, 6)), 0.2 * rng.normal(size=(2, 6)))
    h = 1e-5
    for t in (0.1, 0.45, 0.8):
        q, q_dot, q_ddot = course.at(np.array([t - h, t, t + h]))
        q = q + np.array([0.0, 0.0, 0.0, 0.3, 0.9, -0.5])  # far from the singular attitudes
        before, now, after = (twist(stand, *row) for row in zip(q, q_dot, strict=True))
        carrier = carrier_at(stand, q[1], q_dot[1])
        rate = carrier.A @ q_ddot[1] + carrier.drift
        assert rate == pytest.approx((after - before) / (2 * h), abs=1e-5)
        C0, C, C1 = (attitude(sequence, *row[3:]) for row in q)
        assert C @ now[:3] == pytest.approx(q_dot[1, :3], abs=1e-12)
        assert C.T @ (C1 - C0) / (2 * h) == pytest.approx(cross(now[3:]), abs=1e-6)


@cache
def case() -> tuple[Stand, Slew, Programme]:
    stand = satellite(PYRAMID)
    wanted = slew(stand, end=about((1, 2, 0), 0.4), duration=6, start={"phi_dot": [20, 0, 5, 0]})
    return stand, wanted, plan_slew(stand, wanted, verify=False).programmes[0]


def failures_of_slew(stand: Stand, wanted: Slew, programme: Programme) -> set[str]:
    return failed(verify_programme(stand, motion_of_slew(wanted, programme), programme))


def moved(programme: Programme, **changed: Any) -> Programme:
    assert programme.carrier is not None
    return replace(programme, carrier=replace(programme.carrier, **changed))


def grown(programme: Programme) -> Programme:
    """A course that the wheels do not make."""
    carrier = programme.carrier
    assert carrier is not None
    return moved(programme, q=1.001 * carrier.q, q_dot=1.001 * carrier.q_dot, q_ddot=1.001 * carrier.q_ddot)


def drifting(programme: Programme) -> Programme:
    """A course that does not begin at rest."""
    assert programme.carrier is not None
    return moved(programme, q_dot=programme.carrier.q_dot + np.array([1e-3, 0, 0, 0, 0, 0]))


@pytest.mark.slow
def test_a_slew_passes_and_what_is_wrong_with_it_is_named() -> None:
    """Another end by 2 arcsec, another start of the wheels, other courses; weaker or slower motors on another stand."""
    stand, wanted, programme = case()
    assert failures_of_slew(stand, wanted, programme) == set()
    assert failures_of_slew(stand, replace(wanted, angle=wanted.angle + np.radians(2 / 3600)), programme) == {
        "slew end"
    }
    assert failures_of_slew(stand, replace(wanted, phi_dot=(21.0, 0.0, 5.0, 0.0)), programme) == {"start phi_dot"}
    assert {"residual", "simulation", "slew end"} <= failures_of_slew(stand, wanted, grown(programme))
    assert "slew start" in failures_of_slew(stand, wanted, drifting(programme))
    for motor, name in (("{ torque = 0.01 }", "motor torque"), ('{ torque = 0.2, speed = "150 rpm" }', "motor speed")):
        assert failures_of_slew(satellite(PYRAMID, motor), wanted, programme) >= {"stand", name}


# -- run-up and run-down -----------------------------------------------------------------------------------------------


def checks(bounds: Bounds | None = None, **tables: Any) -> dict[str, Check]:
    """Checks of run-up and run-down alone, by their names, with other tables in the programme."""
    stand, motion, programme = twins()
    required = replace(motion, bounds=bounds or Bounds())
    verdicts = ProgrammeCase.of(stand, required, replace(programme, **tables)).runups()
    return {item.quantity: item for item in verdicts}


def refused(**changes: Any) -> set[str]:
    """Names of the checks that fail."""
    return {name for name, item in checks(**changes).items() if item.failed}


def test_a_run_up_that_ends_on_the_programme_passes() -> None:
    findings = checks(runup=twins_run_up())
    assert not any(item.failed for item in findings.values())
    assert {"run-up table", "run-up joint", "run-up rest", "run-up end"} <= set(findings)


def lagging(rows: Samples) -> dict[str, Array]:
    """One wheel lags a little on the way: the carrier is turned, and swings on."""
    x, T, lag = rows.t / rows.t[-1], rows.t[-1], 0.5 * np.array([1.0, 0.0])
    bump, slope = x**3 * (1 - x) ** 3, 3 * x**2 * (1 - x) ** 2 * (1 - 2 * x)
    curve = 6 * x * (1 - x) * (1 - 5 * x + 5 * x**2)
    ways = zip((rows.phi, rows.phi_dot, rows.phi_ddot), (bump, slope / T, curve / T**2), strict=True)
    return dict(zip(("phi", "phi_dot", "phi_ddot"), (old + np.outer(new, lag) for old, new in ways), strict=True))


FAULTS: dict[str, Callable[[Samples], dict[str, Array]]] = {
    "run-up joint": lambda rows: {"phi": rows.phi + np.array([1e-3, 0.0])},
    "run-up rest": lambda rows: {"phi_dot": rows.phi_dot + np.outer(rows.t == 0.0, [0.1, -0.1])},
    "run-up table": lambda rows: {"phi_ddot": rows.phi_ddot * np.where(rows.t == rows.t[10], 1.2, 1.0)[:, None]},
    "run-up end": lagging,
}


@pytest.mark.parametrize("name", FAULTS)
def test_what_is_wrong_with_a_run_up_is_named(name: str) -> None:
    table = twins_run_up()
    wrong = refused(runup=replace(table, samples=replace(table.samples, **FAULTS[name](table.samples))))
    assert name in wrong
    assert wrong == {name} or name in ("run-up rest", "run-up table")  # which change the carrier's way, too


@pytest.mark.parametrize(
    ("bounds", "offends"),
    [
        (Bounds(acceleration=(1150.0, 1150.0)), {"run-up bound acceleration"}),
        (Bounds(acceleration=(1200.0, 1200.0), speed=(63.0, 63.0)), set()),
        (Bounds(torque=(0.8, 0.8)), {"run-up bound torque"}),
    ],
)
def test_bounds_hold_on_the_way(bounds: Bounds, offends: set[str]) -> None:
    assert refused(runup=twins_run_up(), bounds=bounds) == offends


def test_a_run_down_is_the_run_up_reversed() -> None:
    up = twins_run_up().samples
    joint = up.phi[-1]
    down = Samples(up.t, 2 * joint - up.phi[::-1], up.phi_dot[::-1], -up.phi_ddot[::-1])
    assert refused(rundown=RunUpTable(up.t[-1], down)) == set()
    early = Samples(up.t, down.phi + 0.01, down.phi_dot, down.phi_ddot)
    assert refused(rundown=RunUpTable(up.t[-1], early)) == {"run-down joint"}


def test_deviation_is_a_distance_and_an_angle() -> None:
    """From a mean pose that is turned: the angle between attitudes, not that of coordinates."""
    mean = np.array([1.0, 2.0, 3.0, 0.5, 1.2, -0.3])
    moved = mean + np.array([3e-3, -4e-3, 0.0, 0.2, 0.0, 0.0])  # turned about the vertical, whatever the pose
    assert displacement(twins()[0], moved, mean) == pytest.approx((5e-3, 0.2))


def rest_of(stand: Stand, phi: Array, q: Array) -> tuple[Array, Array, Array]:
    """Pose, free directions and K there."""
    K0 = moment(stand, q, np.zeros(6), phi, np.zeros(len(phi))).at.K
    return *rest_near(stand, phi, q, K0), K0


@pytest.mark.parametrize(("name", "free"), [("bench8", 0), ("auv6", 4), ("demo3", 6)])
def test_nothing_accelerates_there(name: str, free: int) -> None:
    stand = load(stands.path(name))
    phi = np.linspace(0.3, 2.0, len(stand.flywheels))
    q, directions, K0 = rest_of(stand, phi, np.array([0.01, 0.0, 0.0, 0.1, 0.05, -0.1]))
    still = np.zeros(len(phi))
    assert np.abs(free_acceleration(stand, q, np.zeros(6), phi, still, still)).max() < 1e-8
    assert directions.shape == (6, free)
    assert directions.T @ K0 @ directions == pytest.approx(np.eye(free), abs=1e-9)


def test_a_bound_on_the_deviation() -> None:
    """The twins' carrier is held still and strays by nothing."""
    findings = checks(runup=twins_run_up(), bounds=Bounds(deviation=Deviation(1e-3)))
    assert not findings["run-up bound deviation"].failed and findings["run-up bound deviation"].value < 1e-6


def test_a_carrier_that_falls_has_no_rest() -> None:
    stand = load(stands.path("bench8")).without_laws(Suspension)
    with pytest.raises(StateError, match="no equilibrium to start from"):
        rest_of(stand, np.zeros(8), np.zeros(6))
