"""Wrong terms of programs, of free and of held carriers: planted in the literal equations, found by a sparse fit."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import load, loads
from mahovik.errors import CheckError
from mahovik.laws.damping.faults import coefficients
from mahovik.proof import reference
from mahovik.proof.diagnose.diagnosis import Cause, Diagnosis
from mahovik.proof.diagnose.faults import DICTIONARY
from mahovik.proof.diagnose.predict import Part
from mahovik.proof.diagnose.terms.search import TermSearch, TermSearchResult
from mahovik.proof.diagnose.words import as_object, sentences
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.forward import bias
from mahovik.proof.reference.hold import held_state, twists
from mahovik.proof.reference.torque import torque
from mahovik.proof.verify.states import Request
from mahovik.stands import path

BODY = """
schema = 1
name = "body"
gravity = [0, 0, -9.81]
[carrier]
mass = 2.0
inertia = [0.02, 0.03, 0.04]
[suspension]
damping = [1.0, 1.5, 2.0, 0.1, 0.1, 0.1]
"""
BODIES = {"damped": BODY, "sprung": BODY + "stiffness = [9, 9, 9, 3, 3, 3]\n"}
EXAMPLES = Path(__file__).parents[2] / "docs" / "held"
CHANGED = {
    "arm": ("pendulum", 'freedoms = ["pitch"]', 'freedoms = ["pitch"]\npivot = [0, 0, "-50 mm"]'),
    "skew": ("pendulum", 'freedoms = ["pitch"]', "axis = [0, 1, 1]"),
    "clamped": ("linear_shaker", 'freedoms = ["z"]', "freedoms = []"),
}

Change = Callable[[Any, Any, Pieces], None]
"""Spoils K (6x6) and the right-hand side (6) of K V* = ... about O1 in place."""


@cache
def stand_of(name: str) -> Stand:
    """An example; `hull`: remus6 without its flywheels, which has far fewer products; a sprung body; a held stand."""
    if name in BODIES:
        return loads(BODIES[name])
    if name == "hull":
        return replace(load(path("remus6")), flywheels=())
    example, old, new = CHANGED.get(name, (name, "", ""))
    file = EXAMPLES / f"{example}.toml"
    return loads(file.read_text(encoding="utf-8").replace(old, new)) if file.exists() else load(path(name))


@cache
def search(name: str, want: str) -> TermSearch:
    return TermSearch(stand_of(name), wants=(want,))


def total_mass(name: str) -> float:
    return sum(body.mass for body in stand_of(name).bodies)


def first_moment(name: str) -> float:
    """m z_G of the whole stand about O1, kg m; of stands whose flywheels have theirs on the axis."""
    stand = stand_of(name)
    wheels = sum(wheel.mass * wheel.position[2] for wheel in stand.flywheels)
    return stand.carrier.mass * stand.carrier.center_of_mass[2] + wheels


def answer_with(stand: Stand, change: Change, request: Request, tau_change: Any = 0.0) -> Mapping[str, Any]:
    """What a program with these wrong equations answers; one of a held carrier solves them along the freedoms."""
    held = stand.hold is not None
    S = np.eye(6) if stand.hold is None else twists(stand.hold)
    state = held_state(stand, request.state) if held else request.state
    at = reference.pieces(stand, state)
    K, right, phi_ddot = at.K.copy(), at.F - bias(at), np.array(state.phi_ddot)
    change(K, right, at)
    right = right - K @ at.stream_rate()  # V_r* is V* and this
    if request.want == ("reaction",):
        return {"reaction": (K @ np.array(state.V_dot) - right + at.I @ phi_ddot).tolist()}
    I = S.T @ at.I
    if request.want == ("forward",):
        u_dot = np.linalg.solve(S.T @ K @ S, S.T @ right - I @ phi_ddot)
    else:
        tau = np.array(state.tau) - torque(at, np.zeros(6), 0.0 * phi_ddot) + tau_change
        system = np.block([[S.T @ K @ S, I], [I.T, at.Theta_ff]])
        u_dot, phi_ddot = np.split(np.linalg.solve(system, np.concatenate([S.T @ right, tau])), [S.shape[1]])
    if not held:
        return {"V_dot": u_dot.tolist(), "phi_ddot": phi_ddot.tolist()}
    reaction = K @ S @ u_dot + at.I @ phi_ddot - right
    return {"u_dot": u_dot.tolist(), "phi_ddot": phi_ddot.tolist(), "reaction": reaction.tolist()}


def terms_found(name: str, change: Change, want: str = "forward") -> TermSearchResult:
    return search(name, want).find(lambda request: answer_with(stand_of(name), change, request))


def named(result: TermSearchResult) -> set[tuple[str, str, float, float, str]]:
    assert result.whole
    return {
        (x.component, x.term, round(x.multiple.factor, 6), round(x.multiple.expected, 9), x.multiple.coefficient)
        for x in result.terms
        if x.multiple.expected is not None
    }


def wrong_index(_: Any, right: Any, at: Pieces) -> None:
    right[2] += total_mass("demo3") * at.V_r[0] * (at.V_r[5] - at.V_r[4])


def wrong_mass(K: Any, _: Any, __: Pieces) -> None:
    """The same motion as with other factors of w q and v r, which are two terms."""
    K[0, 0] -= 0.2 * total_mass("demo3")


def wrong_drag_and_weight(_: Any, right: Any, at: Pieces) -> None:
    right[1] -= 2 * coefficients(stand_of("hull").carrier, 0.0)["Y_v|v|"] * np.abs(at.V_r[1]) * at.V_r[1]
    right[2] -= total_mass("hull") * at.gravity[2]


def wrong_arm(name: str, share: float = 0.2, pivot: float = 0.0) -> Change:
    """The moment of the weight about pitch is z_G times its force along x."""

    def change(_: Any, right: Any, at: Pieces) -> None:
        right[4] -= share * (first_moment(name) + pivot * total_mass(name)) * at.gravity[0]

    return change


def wrong_sign_of_unbalance(_: Any, right: Any, at: Pieces) -> None:
    """0.16 kg m of the left exciter: its force along z is with its speed squared and its phase."""
    right[2] -= 2 * 0.16 * at.phi_dot[0] ** 2 * np.cos(at.flywheels[0].phi)


def missing_gyroscopic(_: Any, right: Any, at: Pieces) -> None:
    """omega x (J11 wx'): -J11 r wx' about pitch."""
    right[4] += at.Theta_ff[0, 0] * at.V_r[5] * at.phi_dot[0]


def damping_about_a_skew_axis(_: Any, right: Any, at: Pieces) -> None:
    axis = np.array([0, 1, 1]) / np.sqrt(2)
    right[3:] -= 0.02 * (axis @ at.V[3:]) * axis


def wrong_inertia(K: Any, _: Any, __: Pieces) -> None:
    K[4, 4] *= 0.9


UNBALANCE = ("Z", "left.speed left.speed cos left", -0.16, 0.16, "")
PLANTED: list[tuple[str, str, Change, set[tuple[Any, ...]]]] = [
    ("demo3", "forward", wrong_index, {("Z", "u q", 0.0, 1.0, "m"), ("Z", "u r", 1.0, 0.0, "m")}),
    ("demo3", "forward", wrong_mass, {("X", "u_dot", -0.8, -1.0, "m")}),
    ("hull", "forward", wrong_drag_and_weight, {("Y", "|v| v", -1.0, 1.0, "Y_v|v|"), ("Z", "g_z", 0.0, 1.0, "W")}),
    ("pendulum", "forward", wrong_arm("pendulum"), {("M", "g_x", 0.8, 1.0, "W z_G")}),
    ("pendulum", "coupled", wrong_arm("pendulum"), {("M", "g_x", 0.8, 1.0, "W z_G")}),
    ("arm", "forward", wrong_arm("arm", pivot=0.05), {("M", "g_x", 0.8, 1.0, "W z_G")}),
    ("linear_shaker", "reaction", wrong_sign_of_unbalance, {UNBALANCE}),
    ("clamped", "forward", wrong_sign_of_unbalance, {UNBALANCE}),
    ("cube", "forward", missing_gyroscopic, {("M", "r wx.speed", 0.0, -1.0, "J11(wx)")}),
    ("pendulum", "forward", wrong_inertia, {("M", "q_dot", -0.9, -1.0, "I_yy")}),
]


@pytest.mark.parametrize(("name", "want", "change", "expected"), PLANTED)
def test_what_is_planted_is_named(name: str, want: str, change: Change, expected: set[tuple[Any, ...]]) -> None:
    assert named(terms_found(name, change, want)) == expected


@pytest.mark.parametrize(("name", "want"), [("pendulum", "forward"), ("arm", "reaction"), ("clamped", "forward")])
def test_nothing_is_named_for_a_right_program(name: str, want: str) -> None:
    assert terms_found(name, lambda *_: None, want).terms == ()


def test_moments_are_about_the_pivot() -> None:
    result = terms_found("arm", wrong_arm("arm"))
    assert result.about == "the pivot"
    assert result.freedoms == "equations of what is free: M along pitch; speeds: q"
    result = terms_found("skew", damping_about_a_skew_axis)
    assert "1 along 1 (turning about (0, 0.707107, 0.707107)); speeds: u_1" in result.freedoms


@pytest.mark.parametrize(("name", "factor", "expected"), [("damped", -1.65, -1.5), ("sprung", -0.15, None)])
def test_a_term_of_a_suspension_is_not_one_that_should_not_be_there(
    name: str, factor: float, expected: float | None
) -> None:
    """Where the rest of a suspension is no sum of products, only the error of a factor is known."""

    def change(_: Any, right: Any, at: Pieces) -> None:
        right[1] -= 0.15 * at.V_r[1]

    result = terms_found(name, change)
    (term,) = result.terms
    assert (term.component, term.term, term.multiple.coefficient) == ("Y", "v", "")
    assert (term.multiple.factor, term.multiple.expected) == pytest.approx((factor, expected), abs=1e-9)
    assert "should not be there" not in " ".join(sentences(Diagnosis("unknown").with_terms(result)))


def test_terms_of_torques() -> None:
    """Of phases in the motion are those of the table above."""
    stand = stand_of("demo3")

    def answers(request: Request) -> Mapping[str, Any]:
        tau = np.array(reference.evaluate(stand, request.state, ("torque",))["tau"])
        tau[1] += 0.5 * request.state.V[3] * request.state.V[4]
        return {"tau": tau.tolist()}

    result = search("demo3", "torque").find(answers)
    assert result.whole
    assert {(x.want, x.component, x.term) for x in result.terms} == {("torque", "w2", "p q")}


@pytest.mark.slow
def test_terms_of_coupled_equations() -> None:
    """A wrong drive torque and a wrong force at once, in a program that is asked for the motion under torques."""
    stand, mass = stand_of("shaker2"), total_mass("shaker2")

    def force(_: Any, right: Any, at: Pieces) -> None:
        right[2] -= 2 * mass * at.V_r[0] * at.V_r[4]

    result = search("shaker2", "coupled").find(
        lambda request: answer_with(stand, force, request, [0.0, -0.02 * request.state.phi_dot[1]])
    )
    assert result.whole
    wheel = stand.flywheels[1].name
    terms = {(x.want, x.component, x.term, round(x.error, 9)) for x in result.terms}
    assert terms == {("coupled", "Z", "u q", -2 * mass), ("coupled", wheel, f"{wheel}.speed", 0.02)}


def test_programs_that_cannot_be_searched_are_refused() -> None:
    """Answers by chance, none at all, and those to the state before."""
    stand, rng = stand_of("demo3"), np.random.default_rng(1)

    def by_chance(_: Any, right: Any, __: Pieces) -> None:
        right[0] += rng.normal()

    with pytest.raises(CheckError, match="not deterministic"):
        terms_found("demo3", by_chance)
    with pytest.raises(CheckError, match=r"forward: 0 of \d+ states have an answer; expected at least \d+"):
        search("demo3", "forward").find(lambda _: {"V_dot": [float("nan")] * 6})
    before: list[Mapping[str, Any]] = [{}]
    late: dict[str, Mapping[str, Any]] = {}
    for request in search("demo3", "forward").requests:
        late[request.id] = before[-1]
        before.append(reference.evaluate(stand, request.state, request.want))
    with pytest.raises(CheckError, match="it answers another state's result: that to 'term 2, forward' is right for"):
        search("demo3", "forward").find(lambda request: late[request.id.removesuffix(", again")])


def test_an_equation_that_is_left_out_as_a_whole_has_no_name() -> None:
    """The error of any program is its K V* less the right-hand side: all terms of a short equation are no answer."""
    body = replace(stand_of("demo3"), flywheels=(), gravity=(0.0, 0.0, 0.0))

    def answers(request: Request) -> Mapping[str, Any]:
        V_dot = list(reference.evaluate(body, request.state, request.want).get("V_dot", ()))
        if V_dot:
            V_dot[0] = np.sin(3.0 * request.state.V[0])
        return {"V_dot": V_dot}

    result = TermSearch(body, wants=("forward",)).find(answers)
    assert (result.whole, result.terms) == (False, ())


def test_a_term_takes_the_place_of_two_faults_but_not_of_one() -> None:
    result = terms_found("pendulum", wrong_arm("pendulum"))
    one, other = (Part(fault) for fault in DICTIONARY[:2])
    two = Diagnosis("named", (Cause((one, other), 0.0),))
    assert two.of_two and not Diagnosis("named", (Cause((one,), 0.0),)).of_two
    assert (two.with_terms(result).outcome, two.with_terms(result).causes) == ("terms", ())
    assert two.with_terms(terms_found("pendulum", lambda *_: None)) == two


def test_a_diagnosis_by_terms_as_data() -> None:
    diagnosis = Diagnosis("unknown").with_terms(terms_found("pendulum", wrong_arm("pendulum")))
    data = as_object(diagnosis)
    assert (data["verdict"], data["found"][0]["term"], data["found"][0]["coefficient"]) == ("named", "g_x", "W z_G")
    assert (data["outcome"], data["confidence"]) == ("terms", None)
    assert data["unexplained"] < 1e-9
    assert as_object(Diagnosis("unknown"))["verdict"] == "unnamed"
    assert as_object(Diagnosis("equal"))["verdict"] == "none"
