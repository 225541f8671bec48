"""Rows of `verify`: errors are seen, rounding is not, absences are told; of three that answer the odd one is named."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest

from laws.held_stands import HOLDS, held_stand
from mahovik.contract.functions import wants_of
from mahovik.contract.limits import DOUBLE
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import Stand, State, load, loads
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.inverse import least_pivot
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import CasadiBackend, NumpyBackend
from mahovik.proof.verify.c_backend import CBackend, InterpreterBackend
from mahovik.proof.verify.check import Check, report
from mahovik.proof.verify.compare import Case, Rows, ordinary
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.table import checks_of
from mahovik.proof.verify.harness import applicable, judge
from mahovik.proof.verify.judges import PROGRAMS, verify_judges
from mahovik.proof.verify.scales import Scales
from mahovik.proof.verify.states import Request
from mahovik.stands import path
from verify.holds import random_held_stand

AIR_TABLE = Path(__file__).parents[2] / "docs" / "held" / "air_table.toml"

STILL = """
schema = 1
name = "still"
carrier = { mass = 1, inertia = [1, 1, 1] }
hold = { freedoms = ["yaw"] }
"""
LEG = """
[[leg]]
ground = [0, 0, -1]
carrier = [0, 0, 0]
length = 0.9
stiffness = 100
"""
WHEEL = """
[[flywheel]]
name = "w"
position = [0.1, 0, 0]
axis = [0, 1, 0]
zero = [0, 0, 1]
mass = 0.2
spin_inertia = 1e-4
transverse_inertia = 6e-5
"""
PULLED = LEG.replace("carrier = [0, 0, 0]", "carrier = [0.1, 0, 0]")


def judged(stand: Stand, wants: tuple[str, ...], error: float = 0.0) -> dict[tuple[str, str], float]:
    """Worst difference of any pair over its bound, of the reference as the judged program; `error` added to u_dot."""
    scales, second = Scales(stand), CasadiBackend(stand, Second(stand))
    judges = {want: Rows(DOUBLE, scales, want, second=second) for want in wants}
    for name, state in draw(stand, 1, 6):
        for want, of_want in judges.items():
            answer = reference.evaluate(stand, state, [want])
            if "u_dot" in answer:
                answer["u_dot"] = answer["u_dot"] + error
            of_want.compare_want(Request(name, state, (want,)), answer)
    return {(row.judged, row.quantity): row.share for of_want in judges.values() for row in of_want.checks()}


@pytest.mark.parametrize("tables", ["", LEG, LEG + WHEEL, PULLED, WHEEL])
def test_rounding_passes_where_nothing_acts_along_the_freedom_and_an_error_does_not(tables: str) -> None:
    """A billionth of a rad/s2 along a freedom without forces is no rounding of what the states have."""
    stand = loads(STILL + tables)
    assert max(judged(stand, ("forward", "coupled", "generalized")).values()) <= 1.0
    assert judged(stand, ("forward",), 1e-9)["forward", "u_dot"] > 1.0


def test_a_refusal_where_no_flywheel_acts_along_the_freedom_is_right() -> None:
    stand = loads(STILL + WHEEL)
    backend = cast(CBackend, InterpreterBackend(generate_all(stand)))
    states = ordinary(draw(stand, 1, 3), 2)
    rows = checks_of(Case(stand, backend, states, DOUBLE, Second(stand), Scales(stand), 1), "inverse_fast")
    assert {row.verdict for row in rows if row.states} == {"ok"}


@pytest.mark.parametrize("quantity", ["u_dot", "V_dot", "reaction"])
def test_an_error_of_a_digit_is_seen(quantity: str) -> None:
    """A relative error of 1e-9 in the answer of the program fails, at ordinary states."""
    stand = random_held_stand("hinge", 4)
    scales = Scales(stand)
    judge = Rows(DOUBLE, scales, "forward")
    for name, state in draw(stand, 1, 6):
        measured = scales.want(state, "forward")
        assert measured is not None
        expected = measured.values
        if quantity in expected:
            wrong = {**expected, quantity: np.array(expected[quantity]) * (1 + 1e-9)}
            judge.compare_want(Request(name, state, ("forward",)), wrong)
    verdicts = {row.quantity: row.verdict for row in judge.checks()}
    assert verdicts.pop(quantity) == "FAILED" and set(verdicts.values()) == {"ok"}


FLYWHEELS = """
[[flywheel]]
name = "w1"
mass = 1
position = [0.2, 0, 0]
spin_inertia = 0.002
transverse_inertia = 0.0011
[[flywheel]]
name = "w2"
mass = 1
position = [0, 0.2, 0]
spin_inertia = 0.002
transverse_inertia = 0.0011
"""
ONE_WHEEL = FLYWHEELS.rpartition("[[flywheel]]")[0]
POINT = loads(f'schema = 1\nname = "point"\n[carrier]\nmass = 5\ninertia = [0, 0, 0]\n{FLYWHEELS}')
"""A carrier that is a point: without its flywheels nothing resists a turn."""

HELD = loads(
    f'schema = 1\nname = "held"\n[carrier]\nmass = 0\ninertia = [0, 0, 0]\nadded_mass = [1, 1, 1, 1, 1, 1]\n{ONE_WHEEL}'
)
"""One wheel, and else added mass alone: without fluid its mass matrix is singular."""


def test_reactions_on_a_carrier_without_inertia_are_skipped_with_the_reason() -> None:
    states = [(name, replace(state, wrench={})) for name, state in draw(POINT, 1, 6)]
    case = Case(POINT, CBackend(POINT), states[:3], DOUBLE, Second(POINT), Scales(POINT), 1)
    torque, motion = checks_of(case, "mounts")
    assert (torque.verdict, torque.states) == ("ok", 3)
    assert motion.verdict == "not compared" and not motion.failed
    assert motion.words == (
        "its judge refused: the mass matrix of the stand without flywheels is not positive definite"
    )


def test_a_stand_that_is_none_without_fluid_is_skipped_with_the_reason() -> None:
    """Every judge says so; nothing is compared, which is no pass."""
    report = verify_judges(HELD, count=2)
    assert [row.judged for row in report.rows] == list(PROGRAMS)
    for row in report.rows:
        assert (row.verdict, row.states) == ("not compared", 0)
        assert row.words.startswith("the stand without carrier: added_mass has no positive definite mass matrix")
    assert not report.passed


def pairs(answer: Any, natural: Any) -> list[tuple[str, Any, Any]]:
    flat = []
    for name, value in answer.items():
        if isinstance(value, dict):
            flat += [(f"{name} {n}", v, s) for n, v, s in pairs(value, natural[name])]
        elif natural[name] is not None:
            flat.append((name, np.asarray(value), np.asarray(natural[name])))
    return flat


def check_bounds(stand: Stand, want: str, seed: int) -> int:
    checked, scales = 0, Scales(stand)
    for _, state in draw(stand, seed, 8):
        measured = scales.want(state, want) if applicable(state, want) else None
        if measured is None:
            continue
        assert set(measured.scales) == set(measured.values)
        for name, value, scale in pairs(measured.values, measured.scales):
            assert value.shape == scale.shape, name
            assert np.all(np.abs(value) <= scale), name
            checked += 1
    return checked


OF_FREE = [want for want in wants_of("reference") if want != "reaction"]


@pytest.mark.parametrize("want", OF_FREE)
def test_a_quantity_is_never_larger_than_its_scale(want: str) -> None:
    assert sum(
        check_bounds(random_stand(np.random.default_rng(seed), 1 + seed, EVERYTHING), want, seed) for seed in range(7)
    )


@pytest.mark.parametrize("tables", HOLDS)
def test_a_reaction_is_never_larger_than_its_scale(tables: str) -> None:
    assert check_bounds(held_stand(tables), "reaction", 3)


def test_a_judge_that_refuses_some_cases_only_fails() -> None:
    row = Check("mounts", "something", 1e-12)
    row.compare(np.ones(2), np.ones(2), np.ones(2), "random 1")
    row.skip("its judge refused: no such sum", "random 2")
    assert (row.verdict, row.state) == ("FAILED", "random 2")
    assert row.words == "1 of 2 states left out: its judge refused: no such sum"


def test_the_least_pivot_is_not_lost_among_small_ones() -> None:
    """Rows that differ by little and by much: their pivots are squares of what each has beside those before it."""
    W = np.array([[1.0, 0.0, 0.0], [1e-3, 1e-9, 0.0], [1.0, 1e-6, 3e-7]])
    assert least_pivot(W @ W.T) == pytest.approx(9e-14, rel=0.1)


def test_a_quaternion_may_have_either_sign_at_half_a_turn_alone() -> None:
    stand = load(AIR_TABLE)
    states = dict(draw(stand, 2, 13))
    for name, verdict in (("half_turn 12", "ok"), ("random 1", "FAILED")):
        answers = NumpyBackend(stand).evaluate(states[name], ("generalized",))
        judge = Rows(DOUBLE, Scales(stand), "generalized")
        judge.compare_want(Request(name, states[name], ("generalized",)), answers | {
            "orientation": -np.asarray(answers["orientation"])
        })  # fmt: skip
        assert {row.verdict for row in judge.checks() if row.quantity == "orientation"} == {verdict}


# -- three ways --------------------------------------------------------------------------------------------------------

DEMO = load(path("demo3"))


def wrong_by(values: dict[str, Any], by: float) -> dict[str, Any]:
    """V_dot wrong by a part."""
    return values | ({"V_dot": np.asarray(values["V_dot"]) * (1 + by)} if "V_dot" in values else {})


class Judged(NumpyBackend):
    """The reference as what is judged, wrong by a part of V_dot, or refusing."""

    def __init__(self, by: float = 0.0) -> None:
        super().__init__(DEMO)
        self._real, self._by = reference.evaluate, by

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        if math.isnan(self._by):
            raise StateError("too fast")
        return wrong_by(self._real(DEMO, state, want), self._by)


class Other(Second):
    """The second derivation, likewise."""

    def __init__(self, by: float = 0.0, refuses_after: int = 0) -> None:
        super().__init__(DEMO)
        self._by, self._answers = by, refuses_after

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        self._answers -= 1
        if math.isnan(self._by):
            if self._answers < 0:
                raise StateError("no such sum")
            return super().evaluate(state, want)
        return wrong_by(super().evaluate(state, want), self._by)


def rows(judged: float = 0.0, second: float = 0.0, refuses_after: int = 0) -> dict[str, Check]:
    other = Other(second, refuses_after)
    report = judge(DEMO, Judged(judged), draw(DEMO, 1, 9), ("forward", "momentum", "mounts"), second=other)
    return {row.quantity: row for row in report}


REFUSES = math.nan
ALONE = {
    "nobody": ({}, "ok", "", ""),
    "judged": ({"judged": 1e-6}, "FAILED", "reference and second agree, C differs", ""),
    "second": ({"second": 1e-6}, "FAILED", "C and reference agree, second differs", ""),
    "all": ({"judged": 1e-6, "second": -1e-6}, "FAILED", "no two agree", ""),
    "judged refuses": ({"judged": REFUSES}, "FAILED", "reference and second agree, C differs", "refused: too fast"),
    "second refuses some": (
        {"second": REFUSES, "refuses_after": 3}, "FAILED", "C and reference agree, second differs",
        "second derivation refused: no such sum",
    ),
    "both refuse": (
        {"judged": REFUSES, "second": REFUSES}, "FAILED", "C and second agree, reference differs", "no such sum"
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", ALONE)
def test_the_one_that_differs_is_named(name: str) -> None:
    case, verdict, disagreement, reason = ALONE[name]
    table = rows(**case)  # type: ignore[arg-type]
    row = table["V_dot"]
    assert row.verdict == verdict
    assert row.words.startswith(disagreement) and reason in row.words
    if not any(map(math.isnan, case.values())):
        assert not table["energy"].failed
    assert table["mount_wrench"].second is None  # the second derivation has no such want


def test_reference_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    backend, right = Judged(), reference.evaluate
    monkeypatch.setattr(reference, "evaluate", lambda *arguments: wrong_by(right(*arguments), 1e-6))
    (row,) = judge(DEMO, backend, draw(DEMO, 1, 9), ("forward",), second=Second(DEMO))
    assert row.failed
    assert row.words == "C and second agree, reference differs"


def test_a_stand_that_the_second_derivation_refuses_is_compared_without_it() -> None:
    judged = judge(DEMO, Judged(), draw(DEMO, 1, 9), ("forward", "mounts"), second=Other(math.nan))
    (skipped,) = (row for row in judged if row.verdict == "not compared")
    assert (skipped.judged, skipped.quantity) == ("forward", "second derivation")
    assert skipped.words == "second derivation refused: no such sum; so at every state"
    compared = next(row for row in judged if row.quantity == "V_dot")
    assert (compared.verdict, compared.states, compared.second) == ("ok", 9, None)
    assert report(DEMO, "generated C", 1, 9, 1e-12, judged).passed
    wrong = judge(DEMO, Judged(1e-6), draw(DEMO, 1, 9), ("forward",), second=Other(math.nan))
    assert [row.quantity for row in wrong if row.failed] == ["V_dot"]
