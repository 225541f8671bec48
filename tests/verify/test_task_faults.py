"""The judges of tasks: satisfied with what is generated, and with no planted fault."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik.core.stand.model import COMPONENTS, Stand, Task, TaskRow
from mahovik.core.stand.random import EVERYTHING, Features, random_stand
from mahovik.proof.reference import pieces
from mahovik.proof.reference.task import TaskRows, task_rows
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.case import Case, ordinary
from mahovik.proof.verify.functions.registry import rows_of
from mahovik.proof.verify.refusals import check_refusals, good_inputs, raw_call
from toolchain.quick import quick
from verify.test_functions import case_of, planted

SIGHT = [{"point": "acc1", "rows": ["vy", "wx"]}, "wz"]
POINT = {"name": "foot", "position": [0.3, -0.2, 0.1], "angles": [0.4, 0.9, -0.3]}


def stand() -> Stand:
    sat = mahovik.example("sat4")
    return sat.replace({"point": [*sat.to_dict()["point"], POINT], "task.sight.rows": SIGHT})


FUNCTIONS = ("inverse_sight", "inverse_fast_sight", "inverse_pointing", "inverse_fast_pointing")

FAULTS = {
    "sign of s": (
        "project_sight",
        r"velocity_0\[2\] \* x->V\[4\] - velocity_0",
        "-velocity_0[2] * x->V[4] + velocity_0",
    ),
    "axes transposed": (
        "project_sight",
        r"Y\[1\]\[4\] = table->sensor\[0\]\.axes\[3\]",
        "Y[1][4] = table->sensor[0].axes[1]",
    ),
    "axes of another point": ("project_sight", r"Y\[0\]\[0\] = table->sensor\[0\]", "Y[0][0] = table->sensor[1]"),
    "norm of the unit matrix": ("project_sight", r"Y\[j\]\[k\] / L\[j\]\[j\]", "Y[j][k]"),
    "demand of another row": ("project_sight", r"- demand\[1\]", "- demand[2]"),
    "a free row demanded": ("project_sight", r"\(use\[j\] > 0\) \? known\[j\] : 0\.0", "known[j]"),
    "the mass centre left out": ("demand_turning", r"S\[0\] = [^;]*;", "S[0] = sum.J[0];"),
    "sign of the inertia's factor": (
        "inverse_fast_pointing",
        r"\+ work\.G\[1\]\[0\] \* turn_2",
        "- work.G[1][0] * turn_2",
    ),
    "EXCESSIVE at half the torque": (
        "motor_lacks",
        r"options->motor_torque\[number\] \* share",
        "0.5 * options->motor_torque[number] * share",
    ),
    "friction helps the motor": (
        "motor_lacks",
        r"tau \+ options->motor_viscous",
        "tau - options->motor_viscous",
    ),
    "no dry friction": (
        "motor_lacks",
        r"options->motor_coulomb\[number\] > 0\.0",
        "options->motor_coulomb[number] > 1e9",
    ),
    "EXCESSIVE of the fast function by half the torque": (
        "inverse_fast_pointing",
        r"needed <= has",
        "needed <= 3.0 * has",
    ),
}


def test_the_judges_are_satisfied() -> None:
    case = case_of("sat4", stand=stand())
    rows = [row for name in FUNCTIONS for row in rows_of(case, name)]
    assert [(row.want, row.quantity, row.worst, row.reason) for row in rows if row.failed] == []


@pytest.mark.parametrize("fault", quick(1, FAULTS))
def test_a_planted_fault_is_noticed(fault: str, tmp_path: Path) -> None:
    place, pattern, wrong = FAULTS[fault]
    folder = planted("sat4", tmp_path, place, pattern, wrong, stand())
    case = case_of("sat4", folder, stand=stand())
    rows = [row for name in FUNCTIONS for row in rows_of(case, name)]
    assert any(row.verdict == "FAILED" for row in rows)


@pytest.mark.parametrize("function", ["inverse_sight", "torque_for_sight"])
def test_a_sign_of_s_that_C_and_reference_have_alike_is_noticed(
    function: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """omega x v of a point with the wrong sign wherever the C and the literal reference have it."""
    folder = planted("sat4", tmp_path, "project_sight", "velocity_0", "velocity_0", stand())
    source = folder / "sat4.c"
    text, changed = re.subn(
        r"(turned_0\[\d\]) = (velocity_0\S+ \* \S+) - (velocity_0\S+ \* \S+);", r"\1 = \3 - \2;", source.read_text()
    )
    assert changed == 9
    source.write_text(text)

    def wrong(*given: Any) -> TaskRows:
        rows = task_rows(*given)
        return TaskRows(rows.S, -rows.s)

    monkeypatch.setattr("mahovik.proof.verify.functions.allocation.task_rows", wrong)
    rows = rows_of(case_of("sat4", folder, stand=stand()), function)
    assert {row.quantity for row in rows if row.verdict == "FAILED"} == {"residual, by points of the second"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("seed", "real"),
    quick(1, [(1, "double"), (2, "float"), *((k, "double") for k in range(3, 30))]),
)
def test_tasks_of_random_stands(seed: int, real: str) -> None:
    """All kinds of bodies, rows of all kinds: reference and C agree within the bounds; wrong inputs are refused."""
    rng = np.random.default_rng(700 + seed)
    given = random_stand(rng, int(rng.integers(1, 9)), EVERYTHING)
    backend = CBackend(given, real)
    states = draw(given, seed, 40, real, wrenches=False)
    case = Case(given, backend, ordinary(states, backend.inputs, 6), BOUNDS[real], Second(given), seed)
    names = [f.name for f in backend.program.functions if f.public and f.name.startswith("inverse")]
    assert len(names) == 6
    rows = [row for name in names for row in rows_of(case, name)]
    assert [(row.want, row.quantity, row.worst, row.reason) for row in rows if row.failed] == []
    if real == "double":
        assert check_refusals(backend.program, good_inputs(backend, states), raw_call(backend)).verdict == "ok"


@pytest.mark.slow
@pytest.mark.parametrize("flywheels", [4, 8])
def test_all_six_rows_of_o1_are_the_inverse_problem(flywheels: int) -> None:
    """phi'', sigma and rank those of (12), its residual -K times the task's; also with weights."""
    given = random_stand(np.random.default_rng(flywheels), flywheels, Features(motors=False, tasks=0), "six")
    given = replace(given, tasks=(Task("six", tuple(TaskRow("", name) for name in COMPONENTS)),))
    backend = CBackend(given)
    for _, state in ordinary(draw(given, 5, 30, wrenches=False), backend.inputs, 5):
        inputs = backend.arguments(replace(state, task="six", demand=state.V_dot))
        inputs["options"] = inputs["options"] | {"weight": list(np.linspace(1, 4, flywheels))}
        status, six = backend.call("inverse", inputs)
        same, task = backend.call("inverse_six", inputs)
        assert status == same >= 0
        six, task = six["out"], task["out"]
        size = np.abs(six["phi_ddot"]).max()
        np.testing.assert_allclose(task["phi_ddot"], six["phi_ddot"], rtol=0, atol=1e-9 * size)
        np.testing.assert_allclose(task["sigma"], six["sigma"], rtol=1e-10)
        assert task["rank"] == six["rank"]
        K = pieces(given, state).K
        wrench = float((np.abs(K) @ np.abs(np.array(state.V_dot))).max())
        np.testing.assert_allclose(-K @ task["residual"], six["residual"], rtol=0, atol=1e-9 * wrench)
        fast = [backend.call(name, inputs)[1]["phi_ddot"] for name in ("inverse_fast", "inverse_fast_six")]
        np.testing.assert_allclose(fast[0], fast[1], rtol=0, atol=1e-5 * size)
