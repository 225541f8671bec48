"""mahovik plan --method ocp as a whole: solved, finite, cut and interrupted."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mahovik.use.plan import Plan, PlanOptions, plan_motion
from mahovik.use.plan.ocp.transcription import RunRecord
from plan.examples import example

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from plan_stands import campaign_move, campaign_stand


def rocking(tell: Any = None) -> Plan:
    """bench8, rocking."""
    return plan_motion(*example("bench8"), PlanOptions(winding="rock", method="ocp"), tell)


@pytest.mark.slow
def test_bench8_is_solved() -> None:
    """Verified, and no worse than its start; the raw solution was not exact between nodes."""
    lines: list[str] = []
    found = rocking(lambda state: lines.append(state.words))
    assert found.status == "OK"
    report: Any = found.programmes[0].report
    own = report["ocp"]
    assert report["verified"] and report["method"] == "ocp"
    assert own["objective"] <= own["objective_of_start"] * (1.0 + 1e-6)
    assert report["residual"] < 1e-6 < own["raw_residual"]
    assert sum(line.startswith("IPOPT: iteration") for line in lines) >= own["iterations"]


@pytest.mark.slow
def test_ctrl_c_gives_the_best_so_far() -> None:
    """At IPOPT's second iteration: a verified programme, and it is said."""

    def tell(state: Any) -> None:
        if isinstance(state, RunRecord) and state.iterations == 1:
            os.kill(os.getpid(), signal.SIGINT)

    found = rocking(tell)
    assert found.interrupted and found.programmes[0].report["verified"]
    assert found.programmes[0].report["ocp"]["iterations"] <= 4


@pytest.mark.slow
def test_a_finite_motion_starts_in_x_of_t0() -> None:
    """From rest, verified, and no worse than its start."""
    stand, motion = campaign_stand(1, 8), campaign_move(1, 8)
    found = plan_motion(stand, motion, PlanOptions(method="ocp"))
    assert found.status == "OK"
    programme = found.programmes[0]
    own: Any = programme.report["ocp"]
    assert programme.report["verified"]
    assert own["objective"] <= own["objective_of_start"] * (1.0 + 1e-6)
    np.testing.assert_allclose(programme.at(np.zeros(1)).phi_dot, 0.0, atol=1e-9)
