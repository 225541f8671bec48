"""A run-up that the verification refuses is left out; the programme stays."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.proof.verify.programme import Finding
from mahovik.use.plan import PlanOptions, plan_motion, planner
from mahovik.use.plan.certificate import drop_refused_tables, failed_items
from plan.examples import example
from plan.test_runup import planned


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


@pytest.mark.slow
def test_the_programme_stays_and_the_reason_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """A run-up that misses the programme's angles: OK_LIMIT, why, and the run-down is given all the same."""

    def missing(stand: Stand, motion: RequiredMotion, programme: Programme, *more: object) -> Programme:
        made = planned()
        assert made.runup is not None and made.rundown is not None
        ends = programme.at(np.zeros(1)).phi[0]
        up, down = made.runup.samples, made.rundown.samples
        late = replace(made.runup, samples=replace(up, phi=up.phi + ends - up.phi[-1] + 1e-3))
        meets = replace(made.rundown, samples=replace(down, phi=down.phi + ends - down.phi[0]))
        told = {key: made.report[key] for key in ("runup", "rundown")}
        return replace(programme, runup=late, rundown=meets, report={**programme.report, **told})

    stand, motion = example("shaker2", "shaker2_spin")
    monkeypatch.setattr(planner, "with_runup", missing)
    found = plan_motion(stand, replace(motion, winding=(1, -1), runup=0.12, bounds=Bounds()), PlanOptions())
    assert found.status == "OK_LIMIT"
    (words,) = found.words
    assert words.startswith("run-up: found, but refused by the verification: run-up joint 0.001, at most 1e-06")
    (programme,) = found.programmes
    assert programme.runup is None and programme.report["runup"] == {"reason": words}
    assert programme.rundown is not None and programme.report["rundown"]["terminal_error"] <= 1e-6
    assert programme.report["verified"] is True
    items = {each["name"] for each in programme.report["verification"]}
    assert "run-down end" in items and not any(name.startswith("run-up") for name in items)
