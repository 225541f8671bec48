"""Progress of planning, and how planning ends early: time and Ctrl-C in run-ups."""

from __future__ import annotations

import signal
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.use.plan import PlanOptions, plan_motion, planner
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.outcome import Progress
from mahovik.use.plan.runup import shortcomings, with_runup
from mahovik.use.plan.runup import solve as runups
from mahovik.use.plan.search import Candidate, Search
from plan.examples import example
from plan.test_runup import spinning

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from plan_stands import campaign_move, campaign_stand

from toolchain.quick import quick

WISHES = PlanOptions(verify=False)


def test_the_line_says_what_is_done_in_this_order() -> None:
    """Search, then the two tables; the numbers are those of the search."""
    stand, motion = example("shaker2", "shaker2_spin")
    told: list[tuple[str, int, float]] = []

    def tell(state: Progress) -> None:
        assert isinstance(state, Search)
        told.append((state.doing, state.starts, state.best))

    asked = replace(motion, winding=(1, -1), runup=0.12, bounds=Bounds())
    assert plan_motion(stand, asked, WISHES, tell).status == "OK"
    assert list(dict.fromkeys(doing for doing, _, _ in told)) == ["searching", "improving", "run-up", "run-down"]
    assert told[0][1:] == (0, np.inf)
    assert told[-1][1] > 0 and told[-1][2] < 1e-3


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


@pytest.mark.parametrize(("runup", "share"), [(None, 1.0), (0.12, 0.5)])
def test_half_of_the_time_is_the_searchs_where_run_ups_follow(
    runup: float | None, share: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without run-ups all of it."""
    given: list[Any] = []

    def cut(*asked: Any, on_progress: object) -> Search[Candidate]:
        given.extend(each.seconds for each in asked if isinstance(each, Budget))
        return Search(cut=True)

    monkeypatch.setattr(planner, "search", cut)
    stand, motion = example("shaker2", "shaker2_spin")
    found = plan_motion(stand, replace(motion, runup=runup), replace(WISHES, seconds=30.0))
    assert found.effort["cut_by_time"]
    assert given == [pytest.approx(30.0 * share, rel=1e-2)]


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


@pytest.mark.parametrize("where", quick(1, ["finite", "periodic"]))
def test_ctrl_c_in_the_verification_waits_for_its_end(where: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The programme is given, as interrupted; a second Ctrl-C does not wait."""
    stand, motion = example("shaker2", "shaker2_spin")
    place = "mahovik.use.plan.planner.certify"
    if where == "finite":
        stand, motion = campaign_stand(5000, 8), campaign_move(5000, 8)
    monkeypatch.setattr(place, pressing(1))
    found = plan_motion(stand, motion)
    assert found.interrupted and found.programmes[0].report["verified"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    monkeypatch.setattr(place, pressing(2))
    with pytest.raises(KeyboardInterrupt):
        plan_motion(stand, motion)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
