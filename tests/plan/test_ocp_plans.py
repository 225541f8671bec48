"""mahovik plan --method ocp-partition|ocp as a whole: solved, singular, finite, cut and interrupted."""

from __future__ import annotations

import os
import signal
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mahovik.use.plan import Plan, PlanOptions, plan_motion
from mahovik.use.plan.ocp.transcription import RunRecord
from plan.examples import example

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from plan_stands import campaign_move, campaign_stand


def rocking(method: Any, tell: Any = None, **options: Any) -> Plan:
    """bench8, rocking."""
    return plan_motion(*example("bench8"), PlanOptions(winding="rock", method=method, **options), tell)


@pytest.mark.slow
def test_the_partition_solves_bench8_where_it_is_regular() -> None:
    """Verified, no worse than its start, and det I+ != 0 all along; the raw solution was not exact between nodes."""
    lines: list[str] = []
    found = rocking("ocp-partition", lambda state: lines.append(state.words))
    assert found.status == "OK"
    report: Any = found.programmes[0].report
    own = report["ocp"]
    assert report["verified"] and report["method"] == "ocp-partition"
    assert own["objective"] <= own["objective_of_start"] * (1.0 + 1e-6)
    assert report["residual"] < 1e-6 < own["raw_residual"]
    assert len(own["partition"]["plus"]) == 6 and len(own["partition"]["minus"]) == 2
    assert own["partition"]["regular"] and own["partition"]["least_singular_value"] > 1e-3
    assert sum(line.startswith("IPOPT: iteration") for line in lines) >= own["iterations"]


@pytest.mark.slow
def test_both_formulations_find_one_programme() -> None:
    """J by the partition and by (12) as constraints is one number, without bounds as well."""
    both = [rocking(method, verify=False).programmes[0].report["ocp"] for method in ("ocp-partition", "ocp")]
    np.testing.assert_allclose(both[0]["objective"], both[1]["objective"], rtol=1e-5)


@pytest.mark.slow
def test_a_singular_partition_is_told_with_its_times() -> None:
    """Spinning flywheels: no programme by the partition, the reason its own; `ocp` does not ask for det I+ != 0."""
    stand, motion = example("bench8")
    options = PlanOptions(winding="spin", method="ocp-partition", verify=False)
    found = plan_motion(stand, motion, options)
    assert (found.status, found.reason) == ("NO_PROGRAM", "SINGULAR_PARTITION")
    assert "det I+ = 0 at t = " in found.words[0]
    other = plan_motion(stand, motion, replace(options, method="ocp"))
    assert other.status == "OK" and not other.programmes[0].report["ocp"]["partition"]["regular"]


@pytest.mark.slow
def test_ctrl_c_gives_the_best_so_far() -> None:
    """At IPOPT's second iteration: a verified programme, and it is said."""

    def tell(state: Any) -> None:
        if isinstance(state, RunRecord) and state.iterations == 1:
            os.kill(os.getpid(), signal.SIGINT)

    found = rocking("ocp", tell)
    assert found.interrupted and found.programmes[0].report["verified"]
    assert found.programmes[0].report["ocp"]["iterations"] <= 4


@pytest.mark.slow
@pytest.mark.parametrize("method", ["ocp-partition", "ocp"])
def test_a_finite_motion_starts_in_x_of_t0(method: Any) -> None:
    """From rest, verified, and no worse than its start."""
    stand, motion = campaign_stand(1, 8), campaign_move(1, 8)
    found = plan_motion(stand, motion, PlanOptions(method=method))
    if method == "ocp-partition" and found.reason == "SINGULAR_PARTITION":
        assert "det I+ = 0" in found.words[0]
        return
    assert found.status == "OK"
    programme = found.programmes[0]
    own: Any = programme.report["ocp"]
    assert programme.report["verified"]
    assert own["objective"] <= own["objective_of_start"] * (1.0 + 1e-6)
    np.testing.assert_allclose(programme.at(np.zeros(1)).phi_dot, 0.0, atol=1e-9)
