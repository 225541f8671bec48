"""Every public function has a judge, and the judges notice faults that are planted in the C."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from mahovik import stands
from mahovik.contract.limits import LIMITS
from mahovik.contract.status import BITS
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import load, loads
from mahovik.core.stand.model import Stand
from mahovik.proof.second import Second
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import Case, ordinary
from mahovik.proof.verify.draw import draw, draw_decided
from mahovik.proof.verify.functions.table import JUDGES, FunctionJudge, checks_of, function_checks
from mahovik.proof.verify.harness import judge
from mahovik.proof.verify.refusals import check_refusals, good_inputs, raw_call, wrong_values
from mahovik.proof.verify.scales import Scales
from toolchain.quick import quick

STATES = 6


@cache
def example(name: str) -> Stand:
    return load(stands.path(name))


def case_of(name: str, folder: Path | None = None, real: str = "double", stand: Stand | None = None) -> Case:
    """The C of an example, or what lies in a folder in its place, with a few states; or of a stand of its name."""
    stand = stand or example(name)
    backend = CBackend(stand, real, folder)
    states = ordinary(draw(stand, 3, 40, real), STATES)
    return Case(stand, backend, states, LIMITS[real], Second(stand), Scales(stand, real), 3)


def planted(
    name: str, folder: Path, function: str, pattern: str, wrong: str, stand: Stand | None = None, real: str = "double"
) -> Path:
    """The C of an example with one fault in a function: exactly one place of the text changes."""
    files = dict(generate_all(stand or example(name), real).files)
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


def test_a_function_without_a_judge_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mahovik.proof.verify.functions.table.JUDGES", {})
    rows = [row for row in function_checks(case_of("demo3")) if row.judged == "wrap"]
    assert [row.verdict for row in rows] == ["FAILED"]


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
    right = checks_of(case_of("sat4", stand=stand), function)
    assert [row.quantity for row in right if row.failed] == []
    case = case_of("sat4", planted("sat4", tmp_path, function, pattern, wrong, stand), stand=stand)
    assert any(row.verdict == "FAILED" for row in checks_of(case, function))


def test_a_function_of_which_no_state_is_compared_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(JUDGES, "wrap", FunctionJudge("exact", lambda _, rows: rows.add(Check("wrap", "nothing"))))
    assert [row.verdict for row in checks_of(case_of("demo3"), "wrap")] == ["not compared", "FAILED"]


def test_each_bit_is_drawn_on_both_sides_of_its_bound() -> None:
    states = {row.quantity: row.states for row in checks_of(case_of("demo3"), "inverse")}
    assert {bit for bit in BITS if states.get(f"{bit} at its bound", 0) >= 2} == {*BITS} - {"COARSE"}


DECISIONS = {
    "tolerance twice as large": r"left > 4 * \1 * wanted",
    "tolerance half as large": r"4 * left > \1 * wanted",
    "comparison reversed": r"left < \1 * wanted",
}


@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("fault", DECISIONS)
def test_a_wrong_decision_of_what_is_out_of_reach_is_noticed(fault: str, real: str, tmp_path: Path) -> None:
    folder = planted("demo3", tmp_path, "inverse", r"left > (\S+) \* wanted", DECISIONS[fault], real=real)
    failed = {row.quantity for row in checks_of(case_of("demo3", folder, real), "inverse") if row.failed}
    assert "UNREACHABLE at its bound" in failed
    assert ("UNREACHABLE" in failed) == (fault == "comparison reversed")


@pytest.mark.parametrize(("name", "seed", "by_residual"), [("remus6", 3, 1), ("auv6", 1, 0)])
def test_a_bit_that_rounding_decides_is_judged_by_the_residual(name: str, seed: int, by_residual: int) -> None:
    """In float terms of a residual may be so far above the demand that their rounding is out of reach by itself."""
    stand, scales, backend = example(name), Scales(example(name), "float", seed), CBackend(example(name), "float")
    states = draw_decided(stand, scales, seed, 60, "float")
    rows = {row.quantity: row for row in judge(stand, backend, states, ("inverse",), LIMITS["float"], scales=scales)}
    status = rows["status"]
    assert not any(row.failed for row in rows.values()) and (status.states, status.skipped) == (60, 0)
    words = f"rounding decides UNREACHABLE at {by_residual} of the states"
    assert status.words == (words if by_residual else "")


def test_what_cancels_for_any_numbers_is_part_of_a_scale() -> None:
    """The scale of `v x m v` counts its products, which cancel, so that no perturbation shows their rounding."""
    stand, seed = example("eye4"), 4
    scales, backend = Scales(stand, "float", seed), CBackend(stand, "float")
    states = draw_decided(stand, scales, seed, 8, "float")[7:]
    rows = judge(stand, backend, states, ("forward", "coupled"), LIMITS["float"], scales=scales)
    assert not any(row.failed for row in rows)


def test_no_state_is_left_out_where_rounding_would_decide_a_refusal() -> None:
    """Two wheels on one axis have no pivot for `inverse_fast`; at some states its rounding is as large as the bound."""
    page = (Path(__file__).parents[2] / "docs" / "tutorial.md").read_text(encoding="utf-8")
    stand = loads(page.split("```toml", 1)[1].split("\n", 1)[1].split("```", 1)[0])
    scales = Scales(stand, "double", 3)
    some = ordinary(draw_decided(stand, scales, 3, 200), 18)
    case = Case(stand, CBackend(stand), some, LIMITS["double"], Second(stand), scales, 3)
    refusal = {row.quantity: row for row in checks_of(case, "inverse_fast")}["refusal"]
    assert (refusal.verdict, refusal.skipped) == ("ok", 0)


SMALL = [
    ("prepare", "check_inertia", r"-J\[5\] - ", "-J[5] + ", "impossible bodies"),
    ("prepare", "frame_of_axes", r"across2 > \S+ \* zero2", "across2 > 0.0", "impossible bodies"),
    (
        "state_from_coordinates",
        "state_from_coordinates",
        "< DEMO3_EPS_ATTITUDE",
        "< 1.0e-5",
        "SINGULAR_ATTITUDE at its bound",
    ),
    ("state_from_coordinates", "generalized", "< DEMO3_EPS_ATTITUDE", "< 1.0e-7", "SINGULAR_ATTITUDE at its bound"),
    ("inverse", "excessive", r"> options->most\[s\]", "> 1.0001 * options->most[s]", "EXCESSIVE at its bound"),
    ("inverse", "excessive", r" \|\| options->motor_speed\[s\] < DEMO3_LARGEST", "", "EXCESSIVE at its bound"),
    ("inverse", "motor_lacks", r"ratio > 3.0\) \? 3.0", "ratio > 2.0) ? 2.0", "EXCESSIVE at its bound"),
    ("inverse_fast", "inverse_fast", r"DEMO3_EPS_PIVOT", "1.0e-9", "NOT_POSITIVE_DEFINITE at its bound"),
    ("prepare", "check_parameters", r"DEMO3_MAX_INERTIA", "1.0e40", "impossible bodies"),
    ("step", "finish", r"(x->attitude\[3\] =.*) \* inverse;", r"\1;", "attitude of unit length"),
    (
        "inverse",
        "inverse",
        r"out->rank = rank;",
        "out->rank = rank;\nif (rank < 3) { out->phi_ddot[1] *= 2.0; }",
        "of deficient rank",
    ),
]
"""Function, text that is changed, by what, and the row that shows it: faults that ordinary answers do not have."""


@pytest.mark.parametrize(("function", "place", "pattern", "wrong", "row"), SMALL, ids=[place for _, place, *_ in SMALL])
def test_a_fault_at_a_bound_is_noticed(
    function: str, place: str, pattern: str, wrong: str, row: str, tmp_path: Path
) -> None:
    case = case_of("demo3", planted("demo3", tmp_path, place, pattern, wrong))
    assert row in {check.quantity for check in checks_of(case, function) if check.failed}


CHECKS = [
    ("demo3", "step", r"!\(dt > 0\.0\)", "!(dt >= 0.0)"),
    ("demo3", "check_body", r"status != DEMO3_OK", "status == DEMO3_NOT_FINITE"),
    ("demo3", "inverse", r"DEMO3_MIN_WEIGHT", "1.0e-5"),
    ("demo3", "check_numbers", r"DEMO3_MAX_NORM2", "1.004001"),
    ("auv6", "check_body", r"if \(body->displaced_mass < 0\.0\)", "if (0)"),
]
"""Stand, function of its text, the check that is changed there, and how. Without a check of null a call would crash."""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "place", "pattern", "wrong"), CHECKS, ids=[f"{name} {place}" for name, place, *_ in CHECKS]
)
def test_a_check_that_is_missing_or_moved_is_noticed(
    name: str, place: str, pattern: str, wrong: str, tmp_path: Path
) -> None:
    backend = CBackend(example(name), folder=planted(name, tmp_path, place, pattern, wrong))
    states = draw(example(name), 3, 4)
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
    assert {message.split(": ")[1] for message in untried} <= {"count", "moved", "counter", "locked"}  # it may be null
    checked = raw_call(backend)
    for call, reason in (
        (lambda *_: (0, True), "status OK, expected "),
        (lambda *arguments: (checked(*arguments)[0], False), "refused, but outputs were written"),
    ):
        row = check_refusals(backend.program, good, call)
        assert (row.verdict, row.words[: len(reason)]) == ("FAILED", reason) and " = " in row.state
