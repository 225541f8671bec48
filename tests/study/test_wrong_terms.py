"""Wrong terms of programs, of free and of held carriers: planted in the literal equations, found by a sparse fit."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.stand.model import Carrier, Mat6, Stand, rest_state
from mahovik.core.stand.stand_file import load, loads
from mahovik.errors import CheckError
from mahovik.laws.buoyancy.law import Buoyancy
from mahovik.laws.cross_flow.law import CrossFlow
from mahovik.laws.damping.law import Damping
from mahovik.laws.fading.law import FadingDamping
from mahovik.laws.fin.law import Fins
from mahovik.laws.propeller.law import Propeller, Propellers
from mahovik.proof import reference
from mahovik.proof.diagnose.diagnosis import Diagnosis, as_object, sentences
from mahovik.proof.diagnose.search import TermSearch, TermSearchResult
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.algebra import twists
from mahovik.proof.reference.evaluate import body_wrenches, held_state
from mahovik.proof.reference.motion import torque
from mahovik.proof.reference.pieces import LawParts, body_wrench
from mahovik.proof.verify.backends import CasadiBackend, NumpyBackend
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import with_drawn_actuators
from mahovik.proof.verify.foreign import Program
from mahovik.proof.verify.states import Request, stand_at
from mahovik.stands import path

UNKNOWN = Diagnosis("unnamed", unexplained=1.0, wrong=("forward: V_dot",))
"""The diagnosis of an error before the search for wrong terms."""

EXAMPLES = Path(__file__).parents[2] / "docs" / "held"
CHANGED = {
    "arm": ("pendulum", 'freedoms = ["pitch"]', 'freedoms = ["pitch"]\npivot = [0, 0, "-50 mm"]'),
    "skew": ("pendulum", 'freedoms = ["pitch"]', "axis = [0, 1, 1]"),
    "clamped": ("linear_shaker", 'freedoms = ["z"]', "freedoms = []"),
}

Change = Callable[[Any, Any, Pieces], None]
"""Spoils K (6x6) and the right-hand side (6) of K V* = ... about O1 in place."""


def approx(x: float) -> float:
    """A number with the digits that `named` has."""
    return float(f"{x:.6g}")


@cache
def stand_of(name: str) -> Stand:
    """An example; `hull`: remus6 without its flywheels, which has far fewer products; a held stand."""
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


def answer_with(stand: Stand, change: Change, request: Request) -> Mapping[str, Any]:
    """Answer of a program with these wrong equations; one of a held carrier solves them along the freedoms."""
    held = stand.hold is not None
    S = np.eye(6) if stand.hold is None else twists(stand.hold)
    state = held_state(stand, request.state) if held else request.state
    at = reference.pieces(stand, state)
    K, right, phi_ddot = at.K.copy(), at.F - at.bias, np.array(state.phi_ddot)
    change(K, right, at)
    right = right - (K - at.K) @ at.stream_rate  # V_r* is V* and this
    if request.want == ("reaction",):
        return {"reaction": (K @ np.array(state.V_dot) - right + at.I @ phi_ddot).tolist()}
    I = S.T @ at.I
    if request.want == ("forward",):
        u_dot = np.linalg.solve(S.T @ K @ S, S.T @ right - I @ phi_ddot)
    else:
        tau = np.array(state.tau) - torque(at, np.zeros(6), 0.0 * phi_ddot)
        system = np.block([[S.T @ K @ S, I], [I.T, at.Theta_ff]])
        u_dot, phi_ddot = np.split(np.linalg.solve(system, np.concatenate([S.T @ right, tau])), [S.shape[1]])
    if not held:
        return {"V_dot": u_dot.tolist(), "phi_ddot": phi_ddot.tolist()}
    reaction = K @ S @ u_dot + at.I @ phi_ddot - right
    return {"u_dot": u_dot.tolist(), "phi_ddot": phi_ddot.tolist(), "reaction": reaction.tolist()}


def search_terms(name: str, change: Change, want: str = "forward") -> TermSearchResult:
    return search(name, want).find(lambda request: answer_with(stand_of(name), change, request))


def named(result: TermSearchResult) -> set[tuple[str, str, float, str]]:
    assert result.whole
    return {
        (x.component, x.term, approx(x.factor / (x.expected or 1.0)) + 0.0, x.coefficient)
        for x in result.terms
        if x.expected is not None
    }


def weight_over_net() -> float:
    """Weight of the hull over what is left of it in water."""
    law = stand_of("hull").carrier.law(Buoyancy)
    assert law is not None
    return total_mass("hull") / (total_mass("hull") - law.displaced_mass)


def wrong_index(_: Any, right: Any, at: Pieces) -> None:
    right[2] += total_mass("demo3") * at.V_r[0] * (at.V_r[5] - at.V_r[4])


def wrong_mass(K: Any, _: Any, __: Pieces) -> None:
    """The same motion as with other factors of w q and v r, which are two terms."""
    K[0, 0] -= 0.2 * total_mass("demo3")


def wrong_drag_and_weight(_: Any, right: Any, at: Pieces) -> None:
    right[1] -= 2 * law_of(stand_of("hull"), Damping).terms[1].value * np.abs(at.V_r[1]) * at.V_r[1]
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


UNBALANCE = ("Z", "left.speed left.speed cos left", -1.0, "left.unbalance.static")
PLANTED: list[tuple[str, str, Change, set[tuple[Any, ...]]]] = [
    ("demo3", "forward", wrong_index, {("Z", "u q", 0.0, ""), ("Z", "u r", approx(total_mass("demo3")), "")}),
    ("demo3", "forward", wrong_mass, {("X", "u_dot", 0.8, "")}),
    ("hull", "forward", wrong_drag_and_weight, {("Y", "|v| v", -1.0, "carrier.damping.terms[1].value"),
                                                ("Z", "g_z", approx(1.0 - weight_over_net()), "")}),
    ("pendulum", "forward", wrong_arm("pendulum"), {("M", "g_x", 0.8, "")}),
    ("pendulum", "coupled", wrong_arm("pendulum"), {("M", "g_x", 0.8, "")}),
    ("arm", "forward", wrong_arm("arm", pivot=0.05), {("M", "g_x", 0.8, "")}),
    ("linear_shaker", "reaction", wrong_sign_of_unbalance, {UNBALANCE}),
    ("clamped", "forward", wrong_sign_of_unbalance, {UNBALANCE}),
    ("cube", "forward", missing_gyroscopic, {("M", "r wx.speed", 0.0, "wx.inertia.J11")}),
    ("pendulum", "forward", wrong_inertia, {("M", "q_dot", 0.9, "")}),
]  # fmt: skip
"""Stand, want, fault; component, product, factor over the right one (SI where this is zero), its path."""


@pytest.mark.parametrize(("name", "want", "change", "expected"), PLANTED)
def test_what_is_planted_is_named(name: str, want: str, change: Change, expected: set[tuple[Any, ...]]) -> None:
    assert named(search_terms(name, change, want)) == expected


@pytest.mark.parametrize(("name", "want"), [("pendulum", "forward"), ("arm", "reaction"), ("clamped", "forward")])
def test_nothing_is_named_for_a_right_program(name: str, want: str) -> None:
    assert search_terms(name, lambda *_: None, want).terms == ()


def test_moments_are_about_the_pivot() -> None:
    result = search_terms("arm", wrong_arm("arm"))
    assert result.about == "the pivot"
    assert result.freedoms == "equations of what is free: M along pitch; speeds: q"
    result = search_terms("skew", damping_about_a_skew_axis)
    assert "1 along 1 (turning about (0, 0.707107, 0.707107)); speeds: u_1" in result.freedoms


def test_terms_of_torques() -> None:
    """A term that a program adds to one torque is named with its flywheel."""
    stand = stand_of("demo3")

    def answers(request: Request) -> Mapping[str, Any]:
        tau = np.array(reference.evaluate(stand, request.state, ("torque",))["tau"])
        tau[1] += 0.5 * request.state.V[3] * request.state.V[4]
        return {"tau": tau.tolist()}

    result = search("demo3", "torque").find(answers)
    assert result.whole
    assert {(x.want, x.component, x.term) for x in result.terms} == {("torque", "w2", "p q")}


def test_laws_whose_columns_are_one_are_named_together_with_their_sum() -> None:
    """Else a suspension without damping reads as wrong damping of the carrier, of the wrong sign where it has half."""
    stand = loads("""schema = 1
name = "raft"
gravity = [0, 0, -9.81]
carrier = { mass = 2, inertia = [0.1, 0.2, 0.3], damping = { linear = [1, 1, 1, 0.1, 0.3, 0.3] } }
suspension = { stiffness = [9, 9, 9, 1, 1, 1], damping = [1, 1, 1, 0.5, 0.6, 0.77] }
""")

    def undamped(_: Any, right: Any, at: Pieces) -> None:
        right[4:] += (0.6, 0.77) * at.V[4:]

    result = TermSearch(stand, wants=("forward",)).find(lambda request: answer_with(stand, undamped, request))
    told = {(x.component, x.term, approx(x.factor), approx(x.expected or 0.0), x.coefficient) for x in result.terms}
    names = [f"carrier.damping.linear[{i}][{i}] or suspension.damping[{i}][{i}]" for i in (4, 5)]
    assert told == {("M", "q", -0.3, -0.9, names[0]), ("N", "r", -0.3, -1.07, names[1])}


def test_more_terms_than_are_of_use_are_not_looked_for() -> None:
    hull = TermSearch(stand_of("hull"), wants=("forward",), most=1)
    result = hull.find(lambda request: answer_with(stand_of("hull"), wrong_drag_and_weight, request))
    assert not result.exact and result.terms == ()


def test_a_program_without_answers_is_refused() -> None:
    with pytest.raises(CheckError, match=r"forward: 0 of \d+ states have an answer; expected at least \d+"):
        search("demo3", "forward").find(lambda _: {"V_dot": [float("nan")] * 6})


def test_a_momentum_without_a_name_hinders_no_other() -> None:
    stand = stand_of("hull")

    def answers(request: Request) -> Mapping[str, Any]:
        at = reference.pieces(stand, request.state)
        if request.want == ("momentum",):
            return {"Z": (np.exp(at.V_r) + at.V_r).tolist()}
        right = at.F - at.bias
        right[2] -= 2 * total_mass("hull") * at.V_r[0] * at.V_r[4]
        return {"V_dot": np.linalg.solve(at.K, right).tolist()}

    result = TermSearch(stand, wants=("forward", "momentum")).find(answers)
    assert stand.carrier.added_mass is not None
    mass = total_mass("hull")
    assert named(result) == {("Z", "u q", approx(1.0 - 2.0 * mass / (mass + stand.carrier.added_mass[0][0])), "")}
    diagnosis = UNKNOWN.with_terms(result)
    text = sentences(diagnosis)
    assert diagnosis.verdict == "approximate"
    assert "the error of momentum is not a few terms: nothing of it is named" in text
    assert not any("nothing is left" in line for line in text)


def test_nothing_is_named_beside_an_error_that_is_no_few_terms() -> None:
    """Nor is it looked for: of each number that a factor may be of, all right equations would be made again."""
    stand = stand_of("demo3")

    def answers(request: Request) -> Mapping[str, Any]:
        tau, V = np.array(reference.evaluate(stand, request.state, ("torque",))["tau"]), request.state.V
        tau[0] += V[3] ** 3
        tau[1] += 0.5 * V[3] * V[4]
        return {"tau": tau.tolist()}

    result = search("demo3", "torque").find(answers)
    assert not result.exact and result.terms == ()


def test_a_constant_is_named() -> None:
    def moment(_: Any, right: Any, __: Pieces) -> None:
        right[4] += 0.2

    lines = sentences(UNKNOWN.with_terms(search_terms("pendulum", moment)))
    assert "  forward, M: a constant has the factor 0.2, and should not be there; 100% of the error" in lines


def test_what_terms_explain_is_said_of_the_quantities_that_were_looked_at() -> None:
    result = search_terms("pendulum", wrong_inertia)
    alone = sentences(UNKNOWN.with_terms(result))
    assert alone[-1] == "without it nothing is left of the error beyond rounding"
    diagnosis = replace(UNKNOWN, wrong=("forward: V_dot", "points: points.twist")).with_terms(result)
    assert diagnosis.verdict == "approximate"
    more = sentences(diagnosis)
    assert more[-2:] == [
        "without it the equations of forward are right",
        "not known: whether it explains all of points: points.twist",
    ]


def test_a_diagnosis_by_terms_as_data() -> None:
    diagnosis = UNKNOWN.with_terms(search_terms("pendulum", wrong_arm("pendulum")))
    data = as_object(diagnosis)
    assert (data["verdict"], data["found"][0]["term"], data["found"][0]["component"]) == ("named", "g_x", "M")
    assert data["unexplained"] == 0.0


VEHICLES = Path(__file__).parents[2] / "docs" / "vehicles"


@cache
def vehicle() -> Stand:
    """REMUS 100, of which Y_vdot = Z_wdot, with planes, a propeller, strips and fading damping; actuators at zero."""
    hull = load(VEHICLES / "remus100.toml")
    linear = tuple(tuple(1.0 + i if i == j else 0.1 * (i + j) for j in range(6)) for i in range(6))
    table = (0.1, 0.2, 0.1)
    return replace(
        hull,
        carrier=hull.carrier.with_laws(
            Propellers((Propeller("screw", (-0.7, 0.0, 0.01), (1.0, 0.0, 0.0), 1000.0, 0.14, (0.3, -0.2, -0.1),
                                  (0.03, -0.02, -0.01), 0.0, 0.1, 0.05, False, False),)),
            CrossFlow(1000.0, (-0.6, 0.1, 0.7), table, table, (0.9, 1.0, 1.1), (0.7, 0.8, 0.6), 2, True),
            FadingDamping(cast(Mat6, linear), 1.5),
        ),
    )  # fmt: skip


@cache
def law_search() -> TermSearch:
    return TermSearch(vehicle(), wants=("forward",), program=Program("", (), actuators=True))


def search_law_terms(wrong: Callable[[Stand], Stand], rows: Sequence[int] = range(6)) -> TermSearchResult:
    """Search in a program that has another law in some components of the wrench."""

    def answers(request: Request) -> Mapping[str, Any]:
        right_stand = stand_at(vehicle(), request.state)
        at, other = (reference.pieces(x, request.state) for x in (right_stand, wrong(right_stand)))
        right = at.F - at.bias
        change = body_wrench(other.terms["carrier"]) - body_wrench(at.terms["carrier"])
        right[list(rows)] += change[list(rows)]
        return {"V_dot": np.linalg.solve(at.K, right).tolist()}

    return law_search().find(answers)


def with_fin(share: float) -> Callable[[Stand], Stand]:
    """A share of the lift slope of the first fin."""

    def change(stand: Stand) -> Stand:
        first, *rest = law_of(stand, Fins).fins
        return with_law(stand, Fins((replace(first, lift_slope=share * first.lift_slope), *rest)))

    return change


def law_of(stand: Stand, kind: Any) -> Any:
    law = stand.carrier.law(kind)
    assert law is not None
    return law


def with_law(stand: Stand, law: Any) -> Stand:
    carrier: Carrier = stand.carrier.with_laws(law)
    return replace(stand, carrier=carrier)


def with_fading_element(stand: Stand) -> Stand:
    rows = [list(row) for row in law_of(stand, FadingDamping).linear]
    rows[2][4] *= -1
    return with_law(stand, replace(law_of(stand, FadingDamping), linear=tuple(map(tuple, rows))))


@pytest.mark.parametrize(
    ("wrong", "rows", "expected"),
    [
        (with_fin(-1.0), range(6), {(c, "rudder.lift_slope", -1.0, "rudder.lift_slope") for c in "YN"}),
        (
            with_fading_element,
            range(6),
            {("Z", "carrier.fading_damping.linear[2][4]", -1.0, "carrier.fading_damping.linear[2][4]")},
        ),
    ],
)
def test_a_wrong_coefficient_is_named(
    wrong: Callable[[Stand], Stand], rows: Sequence[int], expected: set[tuple[Any, ...]]
) -> None:
    assert named(search_law_terms(wrong, rows)) == expected


def test_parts_of_a_law_add_up_to_it() -> None:
    """The sum of the parts of each detail is the wrench, at states with deflections and speeds of their own."""
    rng = np.random.default_rng(4)
    states = [with_drawn_actuators(vehicle(), rest_state(vehicle()), rng) for _ in range(4)]
    V = rng.normal(size=(4, 6))
    bodies = [stand_at(vehicle(), state).carrier for state in states]
    kinds = [body_wrenches(b, np.zeros(3), x) for b, x in zip(bodies, V, strict=True)]
    (law,) = parts("faults", LawParts, BODY_LAWS)
    terms = list(law.terms(bodies, V))
    expected = [wrenches["cross-flow drag"] for wrenches in kinds]
    for detail in {term.detail for term in terms}:
        total = sum(term.value * term.wrench for term in terms if term.detail == detail)
        np.testing.assert_allclose(total, expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max())


def test_backends_take_the_actuators_of_a_state() -> None:
    stand, rng = load(VEHICLES / "nps_auv2.toml"), np.random.default_rng(2)
    still = replace(rest_state(stand), V=(1.0, 0.2, -0.1, 0.3, 0.2, -0.4))
    moved = with_drawn_actuators(stand, still, rng)
    backends = (NumpyBackend(stand), CasadiBackend(stand), CBackend(stand))
    literal, second, c = (backend.evaluate(moved, ("forward",))["V_dot"] for backend in backends)
    np.testing.assert_allclose([second, c], [literal, literal], rtol=1e-11)
    assert not np.allclose(literal, backends[0].evaluate(still, ("forward",))["V_dot"], rtol=1e-3)
