"""Run-up and run-down tables: where the carrier rests before, joint, rows, where it ends, bounds on the way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.motion.functions import Samples
from mahovik.core.motion.programme import RunUpTable
from mahovik.core.motion.required import Bounds, Deviation
from mahovik.core.stand import Stand, load
from mahovik.errors import StateError
from mahovik.laws.suspension.law import Suspension
from mahovik.proof.reference.algebra import Array
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.programme.mechanics import displacement, free_acceleration, moment, rest_near
from mahovik.proof.verify.programme.verification import ProgrammeCase
from verify.programme.programmes import twins, twins_run_up


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
