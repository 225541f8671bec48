"""Run-up into spinning programmes of general stands, end to end: slow."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.motion.required import Bounds
from mahovik.proof.verify.programme import verify_programme
from mahovik.use.plan import PlanOptions, plan_motion
from mahovik.use.plan.runup import shortcomings, with_runup
from plan.examples import example

pytestmark = pytest.mark.slow


def test_a_general_stand_is_run_up_and_verified() -> None:
    """Eight unequal wheels that spin, 10 turns: the independent verification passes every item of both tables."""
    stand, motion = example("bench8")
    asked = replace(motion, runup=1.0, winding="spin")
    found = plan_motion(stand, asked, PlanOptions(verify=False))
    assert found.status == "OK", found.words
    findings = verify_programme(stand, asked, found.programmes[0])
    assert [each for each in findings if not each.passed] == []
    assert {"run-up end", "run-down end"} <= {each.name for each in findings}


def test_a_bound_on_the_deviation_is_kept() -> None:
    """A quarter less than the plain run-up strays: kept by both, terminal error as before."""
    stand, motion = example("bench8")
    asked = replace(motion, runup=1.0, winding="spin", bounds=Bounds())
    programme = plan_motion(stand, replace(asked, runup=None), PlanOptions(verify=False)).programmes[0]
    plain = with_runup(stand, asked, programme)
    strayed = [plain.report[key]["deviation"]["angular"]["largest"] for key in ("runup", "rundown")]
    limit = 0.75 * min(strayed)
    bounded = replace(asked, bounds=Bounds(deviation=(np.inf, limit)))
    kept = with_runup(stand, bounded, programme)
    assert shortcomings(kept) == ()
    for key in ("runup", "rundown"):
        assert kept.report[key]["deviation"]["angular"]["largest"] <= limit
        assert kept.report[key]["terminal_error"] <= 1e-6


@pytest.mark.parametrize("up", ["runup", "rundown"])
def test_rocking_underwater(up: str) -> None:
    """Added mass, quadratic damping, free in yaw: the carrier hardly moves more than in the programme."""
    stand, motion = example("auv6")
    found = plan_motion(stand, replace(motion, runup=1.0), PlanOptions(verify=False))
    assert found.status == "OK", found.words
    told = found.programmes[0].report[up]
    assert told["terminal_error"] <= 1e-6
    assert told["deviation"]["angular"]["largest"] <= 1.2e-3
