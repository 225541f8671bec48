"""Run-up and run-down: ends by SciPy on the reference, bounds, time, Ctrl-C, refusals."""

from __future__ import annotations

import signal
import time
from dataclasses import replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.integrate import DOP853

from mahovik.core.motion.programme import Fourier, Programme, RunUpTable
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.proof.verify.programme import Finding, verify_programme
from mahovik.proof.verify.programme.mechanics import scale_of
from mahovik.proof.verify.programme.simulation import rate, rest_near
from mahovik.use.plan import PlanOptions, plan_motion
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.certificate import drop_refused_tables, failed_items, make_programme
from mahovik.use.plan.runup import shortcomings, with_runup
from mahovik.use.plan.runup import solve as runups
from plan.examples import example
from toolchain.quick import quick

Array = np.ndarray
LASTS = 0.12
NONE = Bounds()


def spinning(bounds: Bounds = NONE) -> tuple[Stand, RequiredMotion, Programme]:
    """Two wheels at constant speed against each other: the one amplitude that needs no search."""
    stand, motion = example("shaker2", "shaker2_spin")
    motion = replace(motion, runup=LASTS, bounds=bounds)
    none = np.zeros((0, 2))
    course = Fourier(np.array([-1.5822788629852351, 4.723871516575028]), none, none)
    return stand, motion, make_programme(stand, motion, np.array([0, 0, -6.463e-11, 0, 0, 0]), (1, -1), course, {})


@cache
def planned() -> Programme:
    """The spinning programme with its run-up and run-down."""
    return with_runup(*spinning())


def simulated(table: RunUpTable, start: Array, stand: Stand) -> Array:
    """(q, V) (M, 12) at the rows: DOP853 on the reference, never over a row, where phi''' jumps."""

    def rates(t: float, y: Array) -> Array:
        angles = table.at(np.array([t]))
        return rate(stand, y, angles.phi[0], angles.phi_dot[0], angles.phi_ddot[0])

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
    joint = np.concatenate([course.q[0], course.q_dot[0]])  # without attitude V is q'
    rest = np.concatenate([rest_near(stand, table.samples.phi[0 if up else -1], mean, scale.K0).q, np.zeros(6)])
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
def test_a_bound_that_cannot_be_kept_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """The programme's own speed is above it: of which flywheel, by what; the tables are given."""
    monkeypatch.setattr(runups, "RICHER", ())
    made = with_runup(*spinning(Bounds(deviation=(1.0, np.inf), speed=(100.0, 1000.0))))
    assert made.runup is not None and made.rundown is not None
    words = shortcomings(made)
    assert [line.split(" ")[0] for line in words] == ["run-up:", "run-down:"]
    assert all("speed of left" in line and "100 rad/s" in line for line in words)


@pytest.mark.slow
def test_momentum_that_nothing_takes_up_is_told() -> None:
    """A free stand at rest has none, its programme has: no run-up exists, the programme stays."""
    stand, motion = example("demo3")
    motion = replace(motion, runup=0.1)
    course = Fourier(np.zeros(3), np.zeros((0, 3)), np.zeros((0, 3)))
    programme = make_programme(stand, motion, np.zeros(6), (2, -3, 1), course, {"kind": "spin"})
    made = with_runup(stand, motion, programme)
    assert made.runup is None and made.rundown is None
    assert all("cannot absorb the momentum" in line for line in shortcomings(made))
    assert made.report["kind"] == "spin" and len(shortcomings(made)) == 2


@pytest.mark.slow
def test_a_general_stand_is_run_up_and_verified() -> None:
    """Eight unequal wheels that spin, 10 turns: the independent verification passes every item of both tables."""
    stand, motion = example("bench8")
    asked = replace(motion, runup=1.0, winding="spin")
    found = plan_motion(stand, asked, PlanOptions(verify=False))
    assert found.status == "OK", found.words
    findings = verify_programme(stand, asked, found.programmes[0])
    assert [each for each in findings if not each.passed] == []
    assert {"run-up end", "run-down end"} <= {each.name for each in findings}


def test_what_is_refused_is_left_out_and_nothing_else() -> None:
    """A run-down that ends elsewhere, or that cannot be followed; bounds are no refusal; the programme's items stay."""
    items = [
        Finding("residual", 1e-8, 1e-6, True, "of (12)"),
        Finding("run-up end", 1e-7, 1e-5, True, "carrier"),
        Finding("run-up bound speed", 1.2, 1.0, False, "left"),
        Finding("run-down rest", 0.0, 1e-6, True, "flywheels"),
        Finding("run-down end", np.inf, 1e-5, False, "no equilibrium to start from"),
    ]
    made = planned()
    report = {**made.report, "verified": False, "verification": [each.as_item() for each in items]}
    left = drop_refused_tables(replace(made, report=report))
    assert left.runup is made.runup and left.rundown is None
    reason = "refused by the verification: run-down end not finite, at most 1e-05, no equilibrium to start from"
    assert left.report["rundown"] == {"reason": f"run-down: found, but {reason}"}
    assert [each["name"] for each in left.report["verification"]] == ["residual", "run-up end", "run-up bound speed"]
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
    """Interrupted, with the programme; the run-down is not begun."""

    solve = runups.solve

    def first(*given: Any, up: bool, **more: Any) -> Any:
        if up:
            raise KeyboardInterrupt
        return solve(*given, up=up, **more)

    monkeypatch.setattr(runups, "solve", first)
    stand, motion = example("shaker2", "shaker2_spin")
    found = plan_motion(stand, replace(motion, winding=(1, -1), runup=0.12, bounds=Bounds()), WISHES)
    assert found.interrupted and found.status == "OK_LIMIT"
    assert found.words == (
        "run-up: interrupted",
        "run-down: interrupted after 0 of 5 attempts, none was found",
    )
    assert len(found.programmes) == 1


def pressing(times: int) -> Any:
    """A verification during which Ctrl-C is pressed; it accepts everything."""

    def certified(stand: Stand, motion: RequiredMotion, programme: Programme) -> Programme:
        for _ in range(times):
            signal.raise_signal(signal.SIGINT)
        return replace(programme, report={**programme.report, "verified": True})

    return certified


def test_ctrl_c_in_the_verification_waits_for_its_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """The programme is given, as interrupted; a second Ctrl-C does not wait."""
    stand, motion = example("shaker2", "shaker2_spin")
    place = "mahovik.use.plan.planner.certify"
    monkeypatch.setattr(place, pressing(1))
    found = plan_motion(stand, motion)
    assert found.interrupted and found.programmes[0].report["verified"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    monkeypatch.setattr(place, pressing(2))
    with pytest.raises(KeyboardInterrupt):
        plan_motion(stand, motion)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
