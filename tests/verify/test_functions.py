"""Every public function has a judge, and the judges notice faults that are planted in the C."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from mahovik import stands
from mahovik.contract.functions import row_of
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.compare import Row
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.allocation import inverse_rows
from mahovik.proof.verify.functions.case import Case, Comparison, ordinary
from mahovik.proof.verify.functions.registry import JUDGES, function_rows, rows_of
from mahovik.proof.verify.refusals import check_refusals, good_inputs, raw_call, wrong_values
from toolchain.quick import quick

STATES = 6


@cache
def example(name: str) -> Stand:
    return load(stands.path(name))


def case_of(name: str, folder: Path | None = None, real: str = "double", stand: Stand | None = None) -> Case:
    """The C of an example, or what lies in a folder in its place, with a few states; or of a stand of its name."""
    stand = stand or example(name)
    backend = CBackend(stand, real, folder)
    states = ordinary(draw(stand, 3, 40, real), backend.inputs, STATES)
    return Case(stand, backend, states, BOUNDS[real], Second(stand), 3)


def planted(name: str, folder: Path, function: str, pattern: str, wrong: str, stand: Stand | None = None) -> Path:
    """The C of an example with one fault in a function: exactly one place of the text changes."""
    files = dict(generate_all(stand or example(name)).files)
    text = files[f"{name}.c"]
    start = re.search(rf"^(static )?[\w ]*\b{name}_{function}\([^;]*?\)\n\{{", text, re.DOTALL | re.MULTILINE)
    assert start is not None, f"no function {function}"
    end = text.index("\n}\n", start.end())
    body, count = re.subn(pattern, wrong, text[start.start() : end], count=1)
    assert count == 1, f"{function}: no {pattern}"
    files[f"{name}.c"] = text[: start.start()] + body + text[end:]
    for file, content in files.items():
        (folder / file).write_text(content, encoding="ascii", newline="\n")
    return folder


@pytest.mark.parametrize("name", quick(1, ["demo3", "bench8"]))
def test_every_function_of_the_program_gets_a_row_that_compares_something(name: str) -> None:
    case = case_of(name)
    rows = list(function_rows(case))
    assert [f"{row.want}: {row.quantity}: {row.reason}" for row in rows if row.failed] == []
    public = {function.name for function in case.backend.program.functions if function.public}
    compared = {row.want for row in rows if row.verdict == "ok"}
    assert compared | {f for f in public if row_of(f).want} == public


def test_a_function_without_a_judge_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(JUDGES, "wrap")
    monkeypatch.setattr("mahovik.proof.verify.functions.registry.JUDGES", {})
    rows = [row for row in function_rows(case_of("demo3")) if row.want == "wrap"]
    assert [row.verdict for row in rows] == ["FAILED"]


@pytest.mark.slow
def test_what_regularisation_leaves_in_float_is_no_fault_of_inverse() -> None:
    """remus6 has states whose demand lies in directions that its wheels, some at their limits, hardly reach."""
    case = case_of("remus6", real="float")
    states = ordinary(draw(case.stand, 3, 24, "float"), case.backend.inputs, 12)
    assert [row.quantity for row in inverse_rows(replace(case, states=states)) if row.failed] == []


FAULTS = [
    ("step", "rate", r"C\[1\] \* x->V\[1\]", "-C[1] * x->V[1]"),
    ("step_driven", "rate_driven", r"\+ 0\.5 \* x->V\[5\] \* x->attitude\[2\]", "- 0.5 * x->V[5] * x->attitude[2]"),
    ("step", "stages", r"total->phi\[i\] \+= 2\.0", "total->phi[i] += 1.9"),
    ("step_carried", "advance_carried", r"start - \(sum - sum_b\)", "start - (sum + sum_b)"),
    ("step_driven_carried", "finish_carried", r"1\.0 - square", "square - 1.0"),
    ("coupled", "solve_coupled", r"locked\[s\] == 0", "locked[s] <= 1"),
    ("forward_jacobian", "row_slope", r"row->mu_s\[1\] \* weight\[1\]", "row->mu_s[1] * weight[0]"),
    ("inverse", "inverse", r"\(square / \(square \+ lambda \* lambda\)\)", "(square / (square + lambda))"),
    ("inverse", "allocate", r"1\.0 / options->weight\[s\]", "1.0"),
    ("inverse_fast", "inverse_fast", r"options->damping \* options->damping \* trace", "options->damping * trace"),
    ("inverse", "inverse", r"out->hardest\[i\] = 0\.0", "out->hardest[i] = 1.0"),
    ("inverse", "inverse", r"flags \| \w+_UNREACHABLE", "flags"),
    ("inverse", "inverse", r"flags \| \w+_NEAR_SINGULAR", "flags"),
    ("inverse", "inverse", r"flags \| \w+_DAMPED", "flags"),
    ("step", "step", r"return \w+_COARSE", "return 0"),
    ("step_driven", "step_driven", r"most \* most", "most"),
    ("step_carried", "step_carried", r"dt \* dt \* fastest", "dt * fastest"),
    ("step_driven_carried", "step_driven_carried", r"x->V\[5\] \* x->V\[5\]", "0.0"),
    ("quaternion", "quaternion", r"\+ s_phi \* s_psi", "- s_phi * s_psi"),
    ("state_from_coordinates", "state_from_coordinates", r"- v\[2\] \* omega\[1\]", "+ v[2] * omega[1]"),
    ("wrap", "wrap", r"k \+ 1\.0 : k - 1\.0", "k - 1.0 : k + 1.0"),
    ("phase_of_counts", "phase_of_counts", r"\(demo3_real\)rest - zero", "(demo3_real)rest + zero"),
    ("speed_of_counts", "speed_of_counts", r"6\.283185307179586", "3.141592653589793"),
    ("accumulate", "accumulate", r"-1 - \(int\)down", "-(int)down"),
    ("prepare", "prepare", r"Jh\[1\] = -parameters", "Jh[1] = parameters"),
    ("prepare_mounts", "prepare_mounts", r"inertia\[4\];", "inertia[3];"),
]
"""Judged function, function of the text with the fault, what is replaced there, and by what."""


UNBALANCED, NEEDS_UNBALANCE = "bench8", {("forward_jacobian", "row_slope"), ("inverse", "allocate")}
"""The flywheels of demo3 are balanced, and three have no weights to choose by: these faults need another stand."""

QUICK = 1
"""Faults that are planted in every run of the tests; the others in the slow ones."""


@pytest.mark.parametrize(
    ("function", "place", "pattern", "wrong"),
    [
        pytest.param(*fault, id=f"{fault[0]}-{fault[1]}", marks=[pytest.mark.slow] * (n >= QUICK))
        for n, fault in enumerate(FAULTS)
    ],
)
def test_a_planted_fault_is_noticed(function: str, place: str, pattern: str, wrong: str, tmp_path: Path) -> None:
    name = UNBALANCED if (function, place) in NEEDS_UNBALANCE else "demo3"
    case = case_of(name, planted(name, tmp_path, place, pattern, wrong))
    rows: list[Row] = list(JUDGES[function](case))
    assert any(row.verdict == "FAILED" for row in rows), [(row.quantity, row.worst) for row in rows]


def nearly_balanced(folder: Path) -> Stand:
    """sat4 with unbalances a thousandth of its own: the condition of W is 1e5 and more."""
    text = stands.path("sat4").read_text(encoding="utf-8")
    for old, new in (("0.15 g cm", "0.05 g mm"), ("2.2 g cm^2", "1 g mm^2")):
        assert text.count(f'"{old}"') == 4
        text = text.replace(f'"{old}"', f'"{new}"')
    (folder / "sat4.toml").write_text(text, encoding="utf-8")
    return load(folder / "sat4.toml")


ILL_CONDITIONED = [
    ("inverse", r"out->rank = rank;", "out->rank = rank;\nif (damping > 0.0) { out->phi_ddot[1] *= 2.0; }"),
    (
        "inverse_fast",
        r"answer\[s\] = z\[s\] \* work.scale\[s\];",
        "answer[s] = z[s] * work.scale[s] * (options->damping > 0.0 ? 1.0 : 2.0);",
    ),
    ("inverse_fast", r"> least\)", "> 1.0e30 * least)"),
]
"""Function, and what is replaced there by what: answers of bad condition that are wrong."""


@pytest.mark.parametrize(
    ("function", "pattern", "wrong"), quick(1, ILL_CONDITIONED), ids=["damped", "undamped", "refused"]
)
def test_a_wrong_answer_of_bad_condition_is_noticed(function: str, pattern: str, wrong: str, tmp_path: Path) -> None:
    stand = nearly_balanced(tmp_path)
    right = rows_of(case_of("sat4", stand=stand), function)
    assert [row.quantity for row in right if row.failed] == []
    case = case_of("sat4", planted("sat4", tmp_path, function, pattern, wrong, stand), stand=stand)
    assert any(row.verdict == "FAILED" for row in rows_of(case, function))


def test_a_function_of_which_no_state_is_compared_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(JUDGES, "wrap", lambda case: [Comparison("wrap", "nothing", 1.0).with_verdict()])
    assert [row.verdict for row in rows_of(case_of("demo3"), "wrap")] == ["not compared", "FAILED"]


CHECKS = [
    ("step", r"!\(dt > 0\.0\)", "!(dt >= 0.0)"),
    ("accumulate", r"bits <= 32", "bits <= 33"),
    ("check_body", r"status != DEMO3_OK", "status == DEMO3_NOT_FINITE"),
]
"""Function of the text, the check that is weakened there, and how. Without a check of null the call would crash."""


@pytest.mark.slow
@pytest.mark.parametrize(("place", "pattern", "wrong"), CHECKS, ids=[place for place, _, _ in CHECKS])
def test_a_check_that_is_missing_is_noticed(place: str, pattern: str, wrong: str, tmp_path: Path) -> None:
    backend = CBackend(example("demo3"), folder=planted("demo3", tmp_path, place, pattern, wrong))
    states = draw(example("demo3"), 3, 4)
    row = check_refusals(backend.program, good_inputs(backend, states), raw_call(backend))
    assert row.verdict == "FAILED"


def test_every_argument_of_every_function_is_tried() -> None:
    """Each argument that is read has a wrong value, but integers of which every value is good."""
    backend = CBackend(example("bench8"))
    good = good_inputs(backend, draw(example("bench8"), 3, 4))
    untried = [
        f"{function.name}: {a.name}"
        for function in backend.program.functions
        if function.public
        for a in function.arguments
        if a.name not in {str(wrong.path[0]) for wrong in wrong_values(function, good, "double")}
    ]
    assert {each.split(": ")[1] for each in untried} <= {"count", "moved", "counter", "locked"}  # it may be null


@pytest.mark.slow
def test_the_second_derivation_misses_a_moment_of_buoyancy_in_the_mounts(tmp_path: Path) -> None:
    """A moment that literal reference and C would leave out together shows in the motion of the carrier."""
    stand = random_stand(np.random.default_rng(7), 7, EVERYTHING, name="afloat")
    files = dict(generate_all(stand).files)
    pattern = r"mount->first_moment\[0\] - mount->displaced_moment\[0\]"
    files["afloat.c"], count = re.subn(pattern, "mount->first_moment[0]", files["afloat.c"])
    assert count == 1
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="ascii", newline="\n")
    verdicts = []
    for folder in (None, tmp_path):
        backend = CBackend(stand, folder=folder)
        states = ordinary(draw(stand, 3, 40), backend.inputs, STATES)
        case = Case(stand, backend, states, BOUNDS["double"], Second(stand), 3)
        verdicts.append({row.quantity: row.verdict for row in JUDGES["mounts"](case)})
    right, wrong = verdicts
    assert set(right.values()) == {"ok"}
    assert wrong["V_dot under the reactions"] == "FAILED"


def test_inverse_in_float_never_exceeds_a_limit_by_a_rounding() -> None:
    stand = example("sat4")
    backend = CBackend(stand, "float")
    largest, N = float(backend.layout.precision.largest), len(stand.flywheels)
    drawn = draw(stand, 3, 12, "float", wrenches=False)
    rng = np.random.default_rng(1)
    for state in [state for name, state in drawn if name.startswith("random")]:
        given = backend.arguments(state)
        options: dict[str, object] = {**given["options"], "limit": [largest] * N, "near_singular": 0.0}
        _, free = backend.call("inverse", given | {"options": options})
        most = float(np.abs(free["out"]["phi_ddot"]).max())
        for part in rng.uniform(0.2, 0.95, 12):
            limit = float(np.float32(most * part))
            _, found = backend.call("inverse", given | {"options": {**options, "limit": [limit] * N}})
            assert np.all(np.abs(found["out"]["phi_ddot"]) <= limit)
