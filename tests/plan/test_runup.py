"""Run-up and run-down of free and held carriers: ends by SciPy and by formula, time, Ctrl-C, refusals."""

from __future__ import annotations

import cmath
import json
import math
import signal
import time
from dataclasses import replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.integrate import DOP853, solve_ivp

from mahovik.core.motion.functions import Course, Fourier
from mahovik.core.motion.motion_file import read_motion
from mahovik.core.motion.programme import Programme, RunUpTable
from mahovik.core.motion.required import Bounds, Deviation, RequiredMotion
from mahovik.core.stand import Stand
from mahovik.errors import MahovikError
from mahovik.proof.reference.motion import rates
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.programme.mechanics import (
    displacement,
    free_acceleration,
    moment,
    rest_near,
    scale_of,
    twist,
)
from mahovik.proof.verify.programme.verification import ProgrammeCase, as_item, verify_programme
from mahovik.use.numeric.course import Chart, equilibrium
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import drive
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan import runup as runups
from mahovik.use.plan.outcome import Budget, PlanOptions, drop_refused_tables, failed_items
from mahovik.use.plan.planner import plan_motion
from mahovik.use.plan.runup import shortcomings, with_runup
from plan.held_stands import HOLDS, stand, wheel
from plan.problems import example
from plan.test_finite import move
from toolchain.quick import quick

LASTS = 0.12
NONE = Bounds()


def spinning(bounds: Bounds = NONE) -> tuple[Stand, RequiredMotion, Programme]:
    """Two wheels at constant speed against each other: the one amplitude that needs no search."""
    stand, motion = example("shaker2", "shaker2_spin")
    motion = replace(motion, runup=LASTS, bounds=bounds)
    none = np.zeros((0, 2))
    course = Fourier(np.array([-1.5822788629852351, 4.723871516575028]), none, none)
    return (
        stand,
        motion,
        Programme.of(stand, motion.name, motion.span, np.array([0, 0, -6.463e-11, 0, 0, 0]), (1, -1), course, {}),
    )


@cache
def planned() -> Programme:
    """The spinning programme with its run-up and run-down."""
    return with_runup(*spinning())


def simulated(table: RunUpTable, start: Array, stand: Stand) -> Array:
    """(q, q') (M, 12) at the rows: DOP853 on the reference, never over a row, where phi''' jumps."""

    def rates(t: float, y: Array) -> Array:
        angles = table.at(np.array([t]))
        return np.concatenate([y[6:], free_acceleration(stand, y[:6], y[6:], *(row[0] for row in angles))])

    states, rows = [start], table.samples.t
    for begin, end in pairwise(rows):
        solver = DOP853(rates, begin, states[-1], end, rtol=1e-11, atol=1e-14, first_step=end - begin)
        while solver.status == "running":
            solver.step()
        assert solver.status == "finished"
        states.append(solver.y)
    return np.array(states)


@pytest.mark.parametrize("up", quick(1, [True, False]))
def test_the_carrier_ends_where_it_shall_and_strays_as_is_told(up: bool) -> None:
    """From equilibrium into the required state, or back, to 1e-6 of the amplitude; deviation as in the report."""
    stand, motion, programme = spinning()
    made = planned()
    table = made.runup if up else made.rundown
    assert table is not None and table.duration == LASTS
    scale, mean = scale_of(stand, motion, programme), motion.mean + programme.bias
    course = motion.at(np.zeros(1), programme.bias)
    joint = np.concatenate([course.q[0], course.q_dot[0]])
    equilibrium, _ = rest_near(stand, table.samples.phi[0 if up else -1], mean, scale.K0)
    rest = np.concatenate([equilibrium, np.zeros(6)])
    y = simulated(table, rest if up else joint, stand)
    apart = y[-1] - (joint if up else rest)
    assert scale.displacement_share(apart[:6]) <= 1e-6
    assert scale.twist_share(apart[6:]) <= 1e-6
    told = made.report["runup" if up else "rundown"]
    away = np.linalg.norm(y[:, :3] - mean[:3], axis=1)
    assert told["deviation"]["linear"]["largest"] == pytest.approx(away.max(), rel=1e-3)
    assert told["deviation"]["linear"]["t"] == pytest.approx(table.samples.t[away.argmax()], abs=motion.span / 16)
    assert told["terminal_error"] <= 1e-6
    assert told["deviation"]["angular"]["largest"] <= 1e-9


@pytest.mark.slow
def test_momentum_that_nothing_takes_up_is_told() -> None:
    """A free stand at rest has none, its programme has: no run-up exists, the programme stays."""
    stand, motion = example("demo3")
    motion = replace(motion, runup=0.1)
    course = Fourier(np.zeros(3), np.zeros((0, 3)), np.zeros((0, 3)))
    programme = Programme.of(stand, motion.name, motion.span, np.zeros(6), (2, -3, 1), course, {"kind": "spin"})
    made = with_runup(stand, motion, programme)
    assert made.runup is None and made.rundown is None
    assert all("cannot absorb the momentum" in line for line in shortcomings(made))
    assert made.report["kind"] == "spin" and len(shortcomings(made)) == 2


@pytest.mark.slow
def test_a_general_stand_is_run_up_and_verified() -> None:
    """Eight unequal wheels run up in 10 turns, and every item of both tables is verified."""
    stand, motion = example("bench8")
    asked = replace(motion, runup=1.0, winding="spin")
    plan = plan_motion(stand, asked, PlanOptions(verify=False))
    assert plan.status == "OK", plan.words
    items = verify_programme(stand, asked, plan.programmes[0])
    assert [item for item in items if item.failed] == []
    assert {"run-up end", "run-down end"} <= {item.quantity for item in items}


def test_what_is_refused_is_left_out_and_nothing_else() -> None:
    """A run-down with a wrong end or that cannot be followed is left out; the items of the programme stay."""
    items = [
        Check.of("residual", 1e-8, 1e-6, "of (12)"),
        Check.of("run-up end", 1e-7, 1e-5, "carrier"),
        Check.of("run-up bound speed", 1.2, 1.0, "left"),
        Check.of("run-down rest", 0.0, 1e-6, "flywheels"),
        Check.of("run-down end", np.inf, 1e-5, "no equilibrium to start from"),
    ]
    made = planned()
    report = {**made.report, "verified": False, "verification": [as_item(item) for item in items]}
    left = drop_refused_tables(replace(made, report=report))
    assert left.runup is made.runup and left.rundown is None
    reason = "refused by the verification: run-down end not finite, at most 1e-05, no equilibrium to start from"
    assert left.report["rundown"] == {"reason": f"run-down: found, but {reason}"}
    assert [check["name"] for check in left.report["verification"]] == ["residual", "run-up end", "run-up bound speed"]
    assert left.report["verified"] is False and left.report["runup"] == made.report["runup"]
    assert failed_items(left) == ""


WISHES = PlanOptions(verify=False)


def test_time_that_is_over_leaves_out_both_tables() -> None:
    """No attempt is begun, and both say so; the programme stays."""
    stand, motion, programme = spinning()
    begun = time.process_time()
    made = with_runup(stand, motion, programme, budget=Budget(0, 0.0))
    assert time.process_time() - begun < 0.2
    assert (made.runup, made.rundown) == (None, None)
    assert shortcomings(made) == tuple(
        f"{name}: cut by time after 0 of 5 attempts, none was found" for name in ("run-up", "run-down")
    )


def test_ctrl_c_in_a_run_up_keeps_the_programme(monkeypatch: pytest.MonkeyPatch) -> None:
    """The programme is returned as interrupted, and the run-down is not begun."""

    solve = runups.solve

    def first(*arguments: Any, up: bool, **more: Any) -> Any:
        if up:
            raise KeyboardInterrupt
        return solve(*arguments, up=up, **more)

    monkeypatch.setattr(runups, "solve", first)
    stand, motion = example("shaker2", "shaker2_spin")
    plan = plan_motion(stand, replace(motion, winding=(1, -1), runup=0.12, bounds=Bounds()), WISHES)
    assert plan.interrupted and plan.status == "OK_LIMIT"
    assert plan.words == (
        "run-up: interrupted",
        "run-down: interrupted after 0 of 5 attempts, none was found",
    )
    assert len(plan.programmes) == 1


def pressing(times: int) -> Any:
    """A verification during which Ctrl-C is pressed; it accepts everything."""

    def certified(stand: Stand, motion: RequiredMotion, programme: Programme) -> Programme:
        for _ in range(times):
            signal.raise_signal(signal.SIGINT)
        return replace(programme, report={**programme.report, "verified": True})

    return certified


@pytest.mark.parametrize("periodic", [True, False])
def test_ctrl_c_in_the_verification_waits_for_its_end(periodic: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """The programme is given, as interrupted; a second Ctrl-C does not wait."""
    stand, motion = example("shaker2", "shaker2_spin") if periodic else move()
    place = "mahovik.use.plan.planner.certify"
    monkeypatch.setattr(place, pressing(1))
    plan = plan_motion(stand, motion)
    assert plan.interrupted and plan.programmes[0].report["verified"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    monkeypatch.setattr(place, pressing(2))
    with pytest.raises(KeyboardInterrupt):
        plan_motion(stand, motion)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


MASS, MU, STIFFNESS, DAMPING = 3.0, 0.04, 20000.0, 20.0
PERIOD, HELD_LASTS = 0.05, 0.3
OMEGA = 2.0 * math.pi / PERIOD
"""rad/s; the natural frequency is 81.6 rad/s, so that the run-up passes through it."""


def shaker(freedom: str = "z") -> Stand:
    """Two exciters that turn against each other, on a rail with a spring and a damper."""
    return stand(
        f'freedoms = ["{freedom}"]',
        wheel(1, [1, 0, 0], 1e3 * MU, (0, -0.1, 0)) + wheel(2, [-1, 0, 0], 1e3 * MU, (0, 0.1, 0)),
        f"[suspension]\nstiffness = [0, 0, {STIFFNESS}, 0, 0, 0]\ndamping = [0, 0, {DAMPING}, 0, 0, 0]",
    )


def shaken(bounds: Bounds, apart: float = 0.0) -> tuple[Stand, RequiredMotion, Programme]:
    """(k - m w^2 + i c w) Z = mu w^2 (e^ia + e^ib): wheels `apart` from each other (rad) at constant speed."""
    stand = shaker()
    response = STIFFNESS - MASS * OMEGA**2 + 1j * DAMPING * OMEGA
    size = 2.0 * MU * OMEGA**2 * math.cos(apart / 2) / abs(response)
    document = {"schema": 1, "type": "periodic", "period": PERIOD, "harmonics": [{"k": 1, "cos": [size]}]}
    required = replace(read_motion(json.dumps(document), stand, "m.json"), runup=HELD_LASTS, bounds=bounds)
    mean = cmath.phase(response) + apart / 2 * np.array([1.0, -1.0])
    course = Fourier(mean, np.zeros((0, 2)), np.zeros((0, 2)))
    programme = Programme.of(
        stand, required.name, required.span, np.array([-MASS * 9.81 / STIFFNESS]), (1, 1), course, {}
    )
    return stand, required, programme


@cache
def made() -> Programme:
    return with_runup(*shaken(Bounds()))


def sway(table: RunUpTable, start: Array) -> Array:
    """z, z' at the end by m z'' + c z' + k z + m g = mu sum (phi'' sin phi + phi'^2 cos phi)."""

    def rates(t: float, y: Array) -> Array:
        phi, phi_dot, phi_ddot = (samples[0] for samples in table.at(np.array([t])))
        shaking = MU * float(np.sum(phi_ddot * np.sin(phi) + phi_dot**2 * np.cos(phi)))
        return np.array([y[1], (shaking - DAMPING * y[1] - STIFFNESS * y[0]) / MASS - 9.81])

    step = table.duration / 500
    return np.asarray(solve_ivp(rates, (0, table.duration), start, "DOP853", rtol=1e-10, atol=1e-12, max_step=step).y.T)


@pytest.mark.parametrize("up", [True, False])
def test_a_shaker_goes_through_its_resonance_by_the_closed_formula(up: bool) -> None:
    _, required, programme = shaken(Bounds())
    table = made().runup if up else made().rundown
    assert table is not None and table.duration == HELD_LASTS
    course = required.at(np.zeros(1), programme.bias)
    joint, rest = np.array([course.q[0, 0], course.q_dot[0, 0]]), np.array([programme.bias[0], 0.0])
    y = sway(table, rest if up else joint)
    size = required.at(np.zeros(1)).q[0, 0]
    assert np.abs((y[-1] - (joint if up else rest)) / [size, OMEGA * size]).max() < 2e-6
    report = made().report["runup" if up else "rundown"]
    assert report["terminal_error"] < 1e-6 and report["deviation"]["angular"]["largest"] == 0.0
    assert report["deviation"]["linear"]["largest"] == pytest.approx(np.abs(y[:, 0] - rest[0]).max(), rel=1e-3)


@pytest.mark.slow
def test_the_verification_takes_the_tables_and_refuses_wrong_ones() -> None:
    stand, required, _ = shaken(Bounds(torque=(1e3, 1e3), deviation=Deviation(0.2)))
    checks = ProgrammeCase.of(stand, required, made()).runups()
    assert not any(item.failed for item in checks)
    names = {item.quantity for item in checks}
    assert {"run-up end", "run-down end", "run-up bound deviation", "run-up bound torque"} <= names
    table = made().runup
    assert table is not None
    turned = replace(table.samples, phi=table.samples.phi + np.array([2e-3, 0.0]))
    turned_table = replace(made(), runup=replace(table, samples=turned))
    wrong = ProgrammeCase.of(stand, required, turned_table).runups()
    assert "run-up end" in {item.quantity for item in wrong if item.failed}


@pytest.mark.parametrize("hold", HOLDS)
def test_equations_along_the_freedoms_are_those_of_the_reference(hold: str) -> None:
    """u* agrees with multipliers of the hold, coordinates and their changes with differences."""
    held = stand(hold, wheel(1, [0, 1, 1], 3, (0.1, 0, 0)) + wheel(2, [1, 0, 0], 2))
    assert held.hold is not None
    rng, m = np.random.default_rng(8), len(held.hold.freedoms)
    q0, y = rng.normal(size=m) * 0.3, rng.normal(size=(3, 2 * m)) * 0.4
    phi, phi_dot, phi_ddot = rng.normal(size=(3, 3, 2)) * 3
    chart = Chart.at(Mechanics.of(held), q0)
    drives = drive(chart.mechanics, phi, phi_dot, phi_ddot)
    rate, S = chart.rate(drives, y), chart.mechanics.freedoms
    for i in range(3):
        q, u = q0 + y[i, :m], y[i, m:]
        assert np.abs(twist(held, q, rate[i, :m]) - S @ u).max() < 1e-12
        at = moment(held, q, rate[i, :m], phi[i], phi_dot[i]).at
        expected = rates(at, np.zeros(2), phi_ddot[i], np.full(2, False))[0]
        assert np.abs(rate[i, m:] - expected).max() < 1e-10 * max(1.0, np.abs(expected).max())
    still = Course(y[:, :m] + q0, rate[:, :m], np.zeros((3, m)))
    assert np.abs(chart.of(still) - y).max() < 1e-12
    away = chart.displacement(y)
    for i in range(3):
        told = displacement(held, q0 + y[i, :m], q0)
        assert [np.linalg.norm(away[i, :3]), np.linalg.norm(away[i, 3:])] == pytest.approx(told, abs=1e-12)
    moved = rng.normal(size=(3, 2 * m, 1))
    changes = chart.displacement_change(y, moved)[:, :, 0].reshape(3, 2, 3)
    e = 1e-6
    ends = [chart.displacement(y + side * moved[:, :, 0]).reshape(3, 2, 3) for side in (e, -e)]
    by_difference = (np.linalg.norm(ends[0], axis=2) - np.linalg.norm(ends[1], axis=2)) / (2 * e)
    directions = away.reshape(3, 2, 3)
    size = np.maximum(np.linalg.norm(directions, axis=2), 1e-300)
    assert np.abs(np.einsum("ijk,ijk->ij", directions, changes) / size - by_difference).max() < 1e-7


def test_what_nothing_holds_along_a_freedom_is_told() -> None:
    held = stand('freedoms = ["z"]', wheel(1, [0, 1, 0]))
    with pytest.raises(MahovikError, match=r"accelerates by 9\.81 m/s2; nothing holds it there"):
        equilibrium(Chart.at(Mechanics.of(held), np.zeros(1)), np.zeros(1))
