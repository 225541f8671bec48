"""The harness as a whole: generated C, C that lies in a folder, and what it says of broken ones."""

from __future__ import annotations

import json
import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from cli.run import DEMO3, refused, run
from mahovik.contract.functions import CHOSEN, WANTS
from mahovik.core.emit.generate import generate
from mahovik.core.lower.limits import THRESHOLDS
from mahovik.core.program.types import FLOAT as SINGLE
from mahovik.core.stand import Stand, State, load, rest_state
from mahovik.errors import CheckError, ToolchainError, UsageError
from mahovik.out.commands.verify import report_result
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.c_backend import InterpreterBackend
from mahovik.proof.verify.check import Check, Report, as_junit, conclusion, difference, worst_lines
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import judge, verify_c
from mahovik.proof.verify.scales import Scales
from mahovik.proof.verify.states import read_line
from mahovik.stands import path
from verify.build import everything

DEMO = load(path("demo3"))


class Wrong(NumpyBackend):
    """The reference with one result changed, or withheld."""

    def __init__(self, stand: Stand, change: Any) -> None:
        super().__init__(stand)
        self._change = change

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        changed: dict[str, Any] = self._change(super().evaluate(state, want))
        return changed


def rows_of(change: Any, wants: Sequence[str] = ("forward", "momentum")) -> dict[str, Check]:
    return {row.quantity: row for row in judge(DEMO, Wrong(DEMO, change), draw(DEMO, 1, 9), wants)}


def nudged(name: str, by: float) -> Any:
    return lambda answers: answers | ({name: np.asarray(answers[name]) * (1 + by)} if name in answers else {})


def test_a_stand_without_flywheels_passes() -> None:
    """The whole demand is the residual, since nothing can meet it."""
    report = verify_c(replace(DEMO, flywheels=()), count=10)
    assert report.passed, report.failures
    compared = {row.quantity for row in report.rows if row.verdict == "ok"}
    assert {"residual", "hardest"} <= compared


def test_a_difference_of_ten_tolerances_fails_and_of_a_tenth_does_not() -> None:
    rows = rows_of(nudged("energy", 1e-11))
    assert [row.quantity for row in rows.values() if row.failed] == ["energy"]
    assert 1e-12 < rows["energy"].value <= 1.001e-11  # the scale is at least the energy
    assert not any(row.failed for row in rows_of(nudged("energy", 1e-13)).values())


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (None, "missing"),
        ([1.0] * 5, "shape [5], expected [6]"),
        ([math.nan] * 6, "not finite"),
        ("fast", "no array of numbers"),
        ([[1.0], [1.0, 2.0]], "no array of numbers"),
        ({"x": 1}, "no array of numbers"),
        ([10**400] * 6, "no array of numbers"),
    ],
)
def test_what_is_no_result_fails_with_a_reason(value: Any, words: str) -> None:
    row = rows_of(lambda answers: answers | {"V_dot": value} if "V_dot" in answers else answers)["V_dot"]
    assert row.failed
    assert row.value == math.inf
    assert row.words == words


def test_statuses_and_nested_results_are_compared() -> None:
    assert difference("OK", "OK", None) == (0.0, "")
    assert difference(5, 6, None) == (math.inf, "5 where the reference has 6")
    nested = {"gyro": {"position": np.ones(3)}}
    scale = {"gyro": {"position": np.full(3, 10.0)}}
    off, where = difference({"gyro": {"position": [1.0, 1.0, 1.1]}}, nested, scale)
    assert off == pytest.approx(0.01)
    assert where == "gyro: position"[: len(where)]
    assert difference({"gyro": {}}, nested, scale)[0] == math.inf
    assert difference([], nested, scale) == (math.inf, "no object")
    assert difference([], np.zeros((0,)), np.zeros(0)) == (0.0, "")


def written(folder: Path, stand: Stand, change: Any = lambda name, text: text) -> Path:
    for name, text in generate(stand).items():
        (folder / name).write_text(change(name, text), encoding="ascii")
    return folder


def test_a_term_broken_in_the_emitted_c_is_caught(tmp_path: Path) -> None:
    """The sign of a rate of the first moment is changed."""
    old, new = "sum->mu_dot[1] += ", "sum->mu_dot[1] -= "
    stand = load(path("bench8"))

    def change(file: str, text: str) -> str:
        if file.endswith(".h"):
            return text
        assert old in text
        return text.replace(old, new, 1)

    report = verify_c(stand, count=6, against=written(tmp_path, stand, change))
    assert not report.passed
    assert {"K_dot"} <= {row.quantity for row in report.failures}
    assert any(row.verdict == "not compared" for row in report.rows)
    assert "; text differs from this version's, of another version or edited by hand" in conclusion(report)
    lines = worst_lines(report).splitlines()
    assert lines
    assert {read_line(stand, line).want[0] for line in lines} <= set(WANTS)


def test_c_of_another_stand_or_none_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"demo3\.h: no such file"):
        verify_c(DEMO, against=tmp_path)
    written(tmp_path, DEMO)
    heavier = replace(DEMO, carrier=replace(DEMO.carrier, mass=DEMO.carrier.mass + 1))
    with pytest.raises(CheckError, match="physics"):
        verify_c(heavier, against=tmp_path)


def test_c_of_another_version_is_refused(tmp_path: Path) -> None:
    """Another version of mahovik gave a struct of the same stand another member."""
    with pytest.raises(CheckError, match=r"demo3\.h: demo3_row: member root, expected spin_root_inv: made by another"):
        verify_c(DEMO, against=written(tmp_path, DEMO, lambda _, text: text.replace("spin_root_inv", "root")))


def test_a_warning_of_the_compiler_is_an_error(tmp_path: Path) -> None:
    def change(file: str, text: str) -> str:
        return text if file.endswith(".h") else text + "\nstatic int unused_function(int x) { return x; }\n"

    with pytest.raises(ToolchainError, match="unused"):
        verify_c(DEMO, against=written(tmp_path, DEMO, change))


def test_bits_that_differ_from_the_interpreter_are_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    original = InterpreterBackend.evaluate

    def evaluate_wrongly(self: InterpreterBackend, state: State, want: Sequence[str]) -> dict[str, Any]:
        answers = original(self, state, want)
        if "V_dot" in answers:
            answers["V_dot"][2] = float(np.nextafter(answers["V_dot"][2], np.inf))
        return answers

    monkeypatch.setattr(InterpreterBackend, "evaluate", evaluate_wrongly)
    answers = verify_c(DEMO, count=4)
    (row,) = answers.failures
    assert row.quantity == "interpreter = C, bit for bit"
    assert row.words == "forward differs"
    assert read_line(DEMO, worst_lines(answers)).state == rest_state(DEMO)


def test_a_fresh_copy_is_judged_with_all_its_functions() -> None:
    """Those of `--only all` too, at the ordinary states, of which the row says the number."""
    report = verify_c(DEMO, count=12)
    compared = {row.judged: row.states for row in report.rows if row.verdict == "ok"}
    assert {*CHOSEN} < compared.keys()
    assert not [row for row in report.rows if row.judged and row.verdict == "not compared"]
    assert re.search(r"\n regressor +8 ", report_result(report).text(100))


def test_reports_as_json_and_junit() -> None:
    report = verify_c(DEMO, count=4)
    table = json.loads(report_result(report).to_json(), parse_constant=pytest.fail)
    assert table["passed"] is True
    assert table["stand"] == "demo3"
    assert [row["quantity"] for row in table["rows"]] == [row.quantity for row in report.rows]
    suite = ET.fromstring(as_junit(report))
    assert suite.get("tests") == str(len(report.rows))
    assert suite.get("failures") == suite.get("errors") == "0"

    bad = Check("forward", "V_dot", 1e-12)
    bad.note(math.inf, "random 1", "\x00\x1b & <missing>")
    broken = replace(report, rows=(bad,))
    (row,) = json.loads(report_result(broken).to_json(), parse_constant=pytest.fail)["rows"]
    assert row["value"] is None
    (case,) = ET.fromstring(as_junit(broken)).iter("failure")
    assert "; ?? & <missing>" in str(case.get("message"))
    assert conclusion(broken) == "FAILED: forward V_dot"
    for every in (False, True):  # no row of a long table that failed is left out
        text = report_result(replace(report, rows=(bad,) * 50), everything=every).text()
        assert text.count("& <missing>") == 50

    empty = replace(report, rows=())
    assert not empty.passed
    assert ET.fromstring(as_junit(empty)).get("errors") == "1"


# ---- float ----


def test_states_are_those_that_float_takes() -> None:
    for _, state in draw(everything(), 3, 40, "float"):
        numbers = [*state.position, *state.V, *state.phi, *state.phi_dot, *state.tau, *(state.angles or ())]
        assert all(float(np.float32(x)) == x for x in numbers)
        assert max(map(abs, (*state.phi, *(state.angles or ()))), default=0.0) <= SINGLE.max_phase


def test_rank_is_decided_by_the_thresholds_of_float() -> None:
    stand = load(path("bench8"))
    scales = Scales(stand, "float")
    cuts = scales.cuts
    assert (cuts.rank, cuts.reached) == (THRESHOLDS["float"].rank, THRESHOLDS["float"].unreachable)
    drawn = [state for _, state in draw(stand, 1, 30, "float")]
    kept = [scale for state in drawn if (scale := scales.want(state, "inverse")) is not None and not scale.undecided]
    assert len(kept) >= 0.9 * len(drawn)


def test_the_conclusion_says_the_worst_of_what_has_the_limit_of_the_report() -> None:
    rows = (Check("forward", "V_dot", 1e-6, 3e-7, "ok"), Check("step", "state at the end", 1e-4, 2e-5, "ok"))
    report = Report("demo3", "", "", "C", 1, 1, 1e-6, rows)
    assert conclusion(report) == "passed: worst 3.0e-07 of the natural scale, 1e-06 accepted"


def test_c_of_the_other_element_type_is_refused(tmp_path: Path) -> None:
    run("generate", DEMO3, "--real", "float", "-o", str(tmp_path))
    said = refused("verify", DEMO3, str(tmp_path), "--real", "double")
    assert said == f"error: --real double: the C of {tmp_path / 'demo3.h'} is float\n"
