"""The judges of torques for tasks: satisfied with what is generated, with SciPy on many demands, and with no fault."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.case import Case, ordinary
from mahovik.proof.verify.functions.registry import rows_of
from mahovik.proof.verify.refusals import check_refusals, good_inputs, raw_call
from toolchain.quick import quick
from verify.test_functions import case_of, planted
from verify.test_task_faults import stand

FUNCTIONS = ("torque_for_sight", "torque_for_pointing")

FAULTS = {
    "braking limited as driving": (
        "torque_for_pointing",
        r"most\[s\] = \(speed > 0\.0\) \? driving : whole",
        "most[s] = driving",
    ),
    "no bias in the torques": ("torque_demand_turning", r" \+ drive\.bias", ""),
    "the whole demand in the place of the share": (
        "torque_for_pointing",
        r"start\[i\] = r\[i\] - towards\[i\]",
        "start[i] = r[i]",
    ),
    "a rate in the place of the rest of it": (
        "torque_for_pointing",
        r"options->target_rate \* \(target - speed\)",
        "options->target_rate * target",
    ),
    "a bound stops nobody": ("bounded_least_squares_3", r"part < length", "part < 0.0"),
    "the pivot's row is not divided": (
        "largest_share_3",
        r"tableau\[leave\]\[j\] / unit",
        "tableau[leave][j] / (2.0 * unit)",
    ),
}


def test_the_judges_are_satisfied() -> None:
    case = case_of("sat4", stand=stand())
    rows = [row for name in FUNCTIONS for row in rows_of(case, name)]
    assert [(row.want, row.quantity, row.worst, row.reason) for row in rows if row.failed] == []
    assert {row.verdict for row in rows if row.want == "torque_for_pointing"} == {"ok"}


def test_one_wrong_input_at_a_time_is_refused() -> None:
    case = case_of("sat4", stand=stand())
    found = check_refusals(case.backend.program, good_inputs(case.backend, case.states), raw_call(case.backend))
    assert found.verdict == "ok", (found.reason, found.state)


@pytest.mark.parametrize("fault", quick(2, FAULTS))
def test_a_planted_fault_is_noticed(fault: str, tmp_path: Path) -> None:
    place, pattern, wrong = FAULTS[fault]
    folder = planted("sat4", tmp_path, place, pattern, wrong, stand())
    case = case_of("sat4", folder, stand=stand())
    case = replace(case, states=ordinary(draw(case.stand, 3, 60), case.backend.inputs, 12))
    rows = [row for name in FUNCTIONS for row in rows_of(case, name)]
    assert any(row.verdict == "FAILED" for row in rows)


@pytest.mark.slow
def test_a_thousand_demands_within_bounds_are_those_of_scipy() -> None:
    """Least error by `lsq_linear`, the share by `linprog`; half of the demands keep wanted speeds."""
    case = case_of("sat4", stand=stand())
    case = replace(case, states=ordinary(draw(case.stand, 11, 1600, wrenches=False), case.backend.inputs, 1000))
    assert len(case.states) == 1000
    rows = rows_of(case, "torque_for_pointing")
    assert [(row.quantity, row.worst, row.state, row.reason) for row in rows if row.failed] == []


@pytest.mark.parametrize(
    ("seed", "real"),
    [
        (1, "double"),
        pytest.param(2, "float", marks=pytest.mark.slow),
        *(pytest.param(k, "double", marks=pytest.mark.slow) for k in range(3, 20)),
    ],
)
@pytest.mark.slow
def test_random_stands(seed: int, real: str) -> None:
    rng = np.random.default_rng(900 + seed)
    given = random_stand(rng, int(rng.integers(1, 9)), EVERYTHING)
    backend = CBackend(given, real)
    states = ordinary(draw(given, seed, 40, real, wrenches=False), backend.inputs, 6)
    case = Case(given, backend, states, BOUNDS[real], Second(given), seed)
    rows = [row for task in given.tasks for row in rows_of(case, f"torque_for_{task.name}")]
    assert rows
    assert [(row.want, row.quantity, row.worst, row.reason) for row in rows if row.failed] == []
