"""The judges of tasks and of torques for them: satisfied with what is generated, and with no planted fault."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik.contract.limits import LIMITS
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.proof.reference.inverse import TaskRows, task_rows
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import Case, ordinary
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.table import checks_of
from mahovik.proof.verify.refusals import check_refusals, good_inputs, raw_call
from mahovik.proof.verify.scales import Scales
from mahovik.proof.verify.states import Backend, evaluate_lines, read_line, split_lines, state_line
from toolchain.quick import quick
from verify.test_functions import case_of, planted

SIGHT = [{"point": "acc1", "rows": ["vy", "wx"]}, "wz"]
POINT = {"name": "foot", "position": [0.3, -0.2, 0.1], "angles": [0.4, 0.9, -0.3]}


def stand() -> Stand:
    sat = mahovik.example("sat4")
    return sat.replace({"point": [*sat.to_dict()["point"], POINT], "task.sight.rows": SIGHT})


def curved() -> Stand:
    """Motors with a curve beside one without: mirrored, and one that is not the same both ways."""
    sat = mahovik.example("sat4")
    return sat.replace(
        {
            "point": [*sat.to_dict()["point"], POINT],
            "task.sight.rows": SIGHT,
            "rw1.motor": {"torque_speed": [[0, 0.2], ["3000 rpm", 0.15], ["6000 rpm", 0]], "coulomb": 5e-4},
            "rw2.motor": {"torque_speed": [[-300, 0.05], [0, 0.3], [100, 0.1], [250, 0.2]]},
        }
    )


INVERSE = ("inverse_sight", "inverse_fast_sight", "inverse_pointing", "inverse_fast_pointing")
TORQUE = ("torque_for_sight", "torque_for_pointing")

FAULTS = {
    "sign of s": (
        "project_sight",
        r"x->V\[4\] \* velocity_0\[2\] - x->V",
        "-x->V[4] * velocity_0[2] + x->V",
    ),
    "axes transposed": (
        "project_sight",
        r"Y\[1\]\[4\] = table->sensor\[0\]\.axes\[3\]",
        "Y[1][4] = table->sensor[0].axes[1]",
    ),
    "norm of the unit matrix": ("project_sight", r"Y\[j\]\[k\] / work->G\[j\]\[j\]", "Y[j][k]"),
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
    "a bound stops nobody": ("bounded_least_squares_3", r"part < length", "part < 0.0"),
}


def rows_about(case: Case) -> list[Check]:
    """Rows of all functions of tasks."""
    return [row for name in (*INVERSE, *TORQUE) for row in checks_of(case, name)]


def failed(rows: list[Check]) -> list[tuple[str, str, float, str, str]]:
    """Function, quantity, value, state and words of the rows that failed."""
    return [(row.judged, row.quantity, row.value, row.state, row.words) for row in rows if row.failed]


@pytest.mark.parametrize("of", [stand, curved])
def test_the_judges_are_satisfied_and_wrong_inputs_refused(of: Callable[[], Stand]) -> None:
    case = case_of("sat4", stand=of())
    rows = rows_about(case)
    assert failed(rows) == []
    assert {row.verdict for row in rows if row.judged == "torque_for_pointing"} == {"ok"}
    refusals = check_refusals(case.backend.program, good_inputs(case.backend, case.states), raw_call(case.backend))
    assert refusals.verdict == "ok", (refusals.words, refusals.state)


@pytest.mark.parametrize("fault", quick(1, FAULTS))
def test_a_planted_fault_is_noticed(fault: str, tmp_path: Path) -> None:
    place, pattern, wrong = FAULTS[fault]
    folder = planted("sat4", tmp_path, place, pattern, wrong, stand())
    case = case_of("sat4", folder, stand=stand())
    case = replace(case, states=ordinary(draw(case.stand, 3, 60), 12))
    assert any(row.verdict == "FAILED" for row in rows_about(case))


CURVE_FAULTS = {
    "the mirror image of a curve": ("motor_curve", r"(?s)\{\n    int k", "{\n    speed = -speed;\n    int k"),
    "a corner late": ("motor_curve", r"k = i \+ 1", "k = i"),
    "a curve for what drives alone": ("motor_lacks", r"> (\w+_motor_curve\()", r"* (needed * speed > 0.0) > \1"),
    "no curve in the torques": ("torque_for_pointing", r"\(limit < asked\)", "(limit < 0.0)"),
}


@pytest.mark.parametrize("fault", CURVE_FAULTS)
def test_a_planted_fault_of_a_curve_is_noticed(fault: str, tmp_path: Path) -> None:
    place, pattern, wrong = CURVE_FAULTS[fault]
    folder = planted("sat4", tmp_path, place, pattern, wrong, curved())
    case = case_of("sat4", folder, stand=curved())
    case = replace(case, states=ordinary(draw(case.stand, 3, 60), 12))
    assert any(row.verdict == "FAILED" for name in ("inverse", *TORQUE) for row in checks_of(case, name))


@pytest.mark.slow
def test_a_thousand_demands_within_bounds_are_those_of_scipy() -> None:
    """Least error by `lsq_linear`, the share by `linprog`; half of the demands keep wanted speeds."""
    case = case_of("sat4", stand=stand())
    case = replace(case, states=ordinary(draw(case.stand, 11, 1600), 1000))
    assert len(case.states) == 1000
    assert failed(checks_of(case, "torque_for_pointing")) == []


@pytest.mark.parametrize("function", ["inverse_sight", "torque_for_sight"])
def test_a_sign_of_s_that_C_and_reference_have_alike_is_noticed(
    function: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """omega x v of a point has the wrong sign in the C and in the literal reference."""
    folder = planted("sat4", tmp_path, "project_sight", "velocity_0", "velocity_0", stand())
    source = folder / "sat4.c"
    text, changed = re.subn(
        r"(turned_0\[\d\]) = (\S+ \* velocity_0\S+) - (\S+ \* velocity_0\S+);", r"\1 = \3 - \2;", source.read_text()
    )
    assert changed == 9
    source.write_text(text)

    def wrong(*arguments: Any) -> TaskRows:
        rows = task_rows(*arguments)
        return TaskRows(rows.S, -rows.s)

    monkeypatch.setattr("mahovik.proof.verify.functions.optimality.task_rows", wrong)
    rows = checks_of(case_of("sat4", folder, stand=stand()), function)
    assert {row.quantity for row in rows if row.verdict == "FAILED"} == {"residual, by points of the second"}


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "real"), [(1, "double"), (2, "float"), *((k, "double") for k in range(3, 20))])
def test_tasks_of_random_stands(seed: int, real: str) -> None:
    """All kinds of bodies, rows of all kinds: reference and C agree within the bounds; wrong inputs are refused."""
    rng = np.random.default_rng(700 + seed)
    drawn = random_stand(rng, int(rng.integers(1, 9)), EVERYTHING)
    backend = CBackend(drawn, real)
    states = draw(drawn, seed, 40, real)
    case = Case(drawn, backend, ordinary(states, 6), LIMITS[real], Second(drawn), Scales(drawn, real), seed)
    names = [f.name for f in backend.program.functions if f.public and f.name.startswith("inverse")]
    assert len(names) == 6
    names += [f"torque_for_{task.name}" for task in drawn.tasks]
    assert failed([row for name in names for row in checks_of(case, name)]) == []
    if real == "double":
        assert check_refusals(backend.program, good_inputs(backend, states), raw_call(backend)).verdict == "ok"


# ---- lines of `eval` ----

SAT: Stand = mahovik.example("sat4")
STATE = {"V": [0, 0, 0, 0.01, -0.02, 0.03], "phi": [0.1, 0.2, 0.3, 0.4], "phi_dot": [100, 120, -90, 80]}
TASK = {"task": "pointing", "demand": [1e-3, -2e-3, 0.5e-3]}


def answers(backend: Backend, *lines: dict[str, Any]) -> list[dict[str, Any]]:
    stream = io.BytesIO("\n".join(json.dumps(line) for line in lines).encode())
    return [json.loads(text) for text, _ in evaluate_lines(SAT, backend, split_lines(stream))]


def test_both_backends_answer_a_task_alike_and_the_second_derivation_confirms_them() -> None:
    """Whole demands agree, and torques within the motors for demands within reach and beyond it."""
    needed = ("inverse_pointing", "torque_for_pointing", "inverse", "torque", "points", "mounts", "prepare_mounts")
    c, literal, second = CBackend(SAT, generated=generate_all(SAT, only=needed)), NumpyBackend(SAT), Second(SAT)
    wants = ["torque", "points", "mounts"]
    asked = {**STATE, **TASK, "want": ["inverse", *wants]}
    (one,), (other,) = (answers(backend, asked) for backend in (c, literal))
    assert one.keys() == other.keys() and one["status"] == other["status"] == "OK" and one["rank"] == 3
    for name in ("phi_ddot", "V_dot", "sigma", "tau", "mount_wrench"):
        np.testing.assert_allclose(one[name], other[name], rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(one["V_dot"][3:], np.array(TASK["demand"]), rtol=1e-9)
    moved = {**STATE, "phi_ddot": one["phi_ddot"], "want": ["forward"]}
    np.testing.assert_allclose(answers(second, moved)[0]["V_dot"], one["V_dot"], rtol=1e-9)
    unasked = {**STATE, "V_dot": [0, 0, 0, *TASK["demand"]], "want": ["inverse"]}
    assert all("EXCESSIVE" in answers(backend, unasked)[0]["status"] for backend in (c, literal))

    statuses = []
    for demand in (TASK["demand"], [1.0, -0.7, 0.4]):
        asked = {**STATE, "task": "pointing", "demand": demand, "want": ["torque_for", *wants[1:]]}
        (one,), (other,) = (answers(backend, asked) for backend in (c, literal))
        assert one.keys() == other.keys() and one["status"] == other["status"] and one["limited"] == other["limited"]
        for name in ("tau", "phi_ddot", "V_dot", "residual", "mount_wrench"):
            np.testing.assert_allclose(one[name], other[name], rtol=1e-9, atol=1e-12)
        assert np.abs(one["tau"]).max() <= 0.2  # of the motors
        coupled = {**STATE, "tau": one["tau"], "want": ["coupled"]}
        np.testing.assert_allclose(answers(second, coupled)[0]["V_dot"], one["V_dot"], rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(np.array(demand) - one["V_dot"][3:], one["residual"], atol=1e-12)
        statuses.append(one["status"])
    assert statuses == ["OK", "LIMITED|UNREACHABLE"]


def test_weights_of_the_file_decide_which_flywheels_turn_in_both_backends() -> None:
    """Equal flywheels on one axis share a demand as the inverses of their weights, by either want."""
    flywheel = {"mass": 0.2, "spin_inertia": 2e-4, "transverse_inertia": 1e-4}
    wheels = [{"name": "a", "inverse_weight": 9.0, **flywheel}, {"name": "b", **flywheel}]
    carrier = {"mass": 3.0, "inertia": [0.1, 0.2, 0.25]}
    turn = {"rows": ["wx"]}
    of = mahovik.Stand.from_dict(
        {"schema": 1, "name": "ww", "carrier": carrier, "flywheel": wheels, "task": {"turn": turn}}
    )
    task = {"task": "turn", "demand": [1.0]}
    for backend in (CBackend(of), NumpyBackend(of)):
        lines = [{**task, "want": ["inverse"]}, {"V_dot": [0, 0, 0, 1.0, 0, 0], "want": ["inverse"]}]
        stream = io.BytesIO("\n".join(map(json.dumps, [*lines, {**task, "want": ["torque_for"]}])).encode())
        answered = [json.loads(text) for text, _ in evaluate_lines(of, backend, split_lines(stream))]
        for answer, name in zip(answered, ("phi_ddot", "phi_ddot", "tau"), strict=True):
            assert answer[name][1] == pytest.approx(9.0 * answer[name][0], rel=1e-12)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ({"task": "pointin", "demand": [0, 0, 0]}, 'task: unknown "pointin", did you mean "pointing"?'),
        ({"task": "pointing"}, "demand: missing, expected 3 numbers"),
        ({"demand": [1, 2, 3]}, 'demand: needs a task, {"task": NAME, "demand": [...]}'),
        ({"task": "pointing", "demand": [1, 2]}, "demand: expected 3 numbers, found 2"),
        ({"task": "pointing", "demand": [1, 2, 3e9]}, "demand[2]: 3e+09 is out of range, at most 1e+09 in magnitude"),
        ({"task": 3, "demand": [1, 2, 3]}, "task: expected the name of a task, found 3"),
        ({**TASK, "V_dot": [0, 0, 0, 0, 0, 0]}, "V_dot, task: both given, expected one of them"),
        ({**TASK, "want": ["forward"]}, 'want: "forward" and the task both give V_dot, ask for them in two states'),
        ({"want": ["torque_for"]}, 'want: "torque_for" needs a task, {"task": NAME, "demand": [...]}'),
        (
            {**TASK, "want": ["torque_for", "inverse"]},
            'want: "inverse" and "torque_for" both give phi_ddot, ask for them in two states',
        ),
        (
            {**TASK, "want": ["torque", "torque_for"]},
            'want: "torque" and "torque_for" both give tau, ask for them in two states',
        ),
        ({**TASK, "want": ["coupled"]}, 'want: "coupled" and the task both give V_dot, ask for them in two states'),
    ],
)
def test_error_lines_of_tasks(line: dict[str, Any], words: str) -> None:
    assert answers(NumpyBackend(SAT), {"want": ["inverse"], **line}) == [{"id": None, "error": words}]


def test_a_line_of_a_task_reads_back_and_the_second_derivation_has_no_tasks() -> None:
    request = read_line(SAT, json.dumps({"id": 1, **STATE, **TASK, "want": ["inverse"]}))
    assert read_line(SAT, state_line(request)) == request
    (answer,) = answers(Second(SAT), {**TASK, "want": ["torque"]})
    assert answer["error"].startswith("task: the second derivation has no tasks")
