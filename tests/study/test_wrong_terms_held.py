"""Wrong terms of held carriers: planted in the literal equations, and found along the freedoms."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import load
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

Change = Callable[[Any, Any, Pieces], None]
"""Spoils K (6x6) and the right-hand side (6) of K V* = ... about O1 in place."""

EXAMPLES = Path(__file__).parents[2] / "docs" / "held"
MORE = {"arm": ("pendulum", 'freedoms = ["pitch"]', 'freedoms = ["pitch"]\npivot = [0, 0, "-50 mm"]')}
MORE |= {"skew": ("pendulum", 'freedoms = ["pitch"]', "axis = [0, 1, 1]")}
MORE |= {"plane": ("pendulum", 'freedoms = ["pitch"]', 'freedoms = ["pitch", "x", "z"]\npivot = [0, 0, "-50 mm"]')}
MORE |= {"stream": ("pendulum", "gravity =", "stream = [0.3, 0.2, 0.1]\ngravity =")}
MORE |= {"clamped": ("linear_shaker", 'freedoms = ["z"]', "freedoms = []")}


@cache
def stand_of(name: str) -> Stand:
    example, old, new = MORE.get(name, (name, "", ""))
    text = (EXAMPLES / f"{example}.toml").read_text(encoding="utf-8")
    assert old in text
    with TemporaryDirectory() as folder:
        file = Path(folder) / f"{example}.toml"
        file.write_text(text.replace(old, new) if old else text, encoding="utf-8")
        return load(str(file))


@cache
def search(name: str, want: str) -> TermSearch:
    return TermSearch(stand_of(name), wants=(want,))


def found(name: str, change: Change, want: str = "forward", reaction: bool = True) -> TermSearchResult:
    """The result for a program with these wrong equations, which solves them along the freedoms."""
    stand = stand_of(name)
    assert stand.hold is not None
    S = twists(stand.hold)

    def answers(request: Request) -> Mapping[str, Any]:
        state = held_state(stand, request.state)
        at = reference.pieces(stand, state)
        K, right, phi_ddot = at.K.copy(), at.F - bias(at), np.array(state.phi_ddot)
        change(K, right, at)
        right = right - K @ at.stream_rate()  # V_r* is V* and this
        if want == "reaction":
            return {"reaction": (K @ np.array(state.V_dot) - right + at.I @ phi_ddot).tolist()}
        if want == "forward":
            u_dot = np.linalg.solve(S.T @ K @ S, S.T @ (right - at.I @ phi_ddot))
        else:
            tau = np.array(state.tau) - torque(at, np.zeros(6), 0.0 * phi_ddot)
            I = S.T @ at.I
            system = np.block([[S.T @ K @ S, I], [I.T, at.Theta_ff]])
            u_dot, phi_ddot = np.split(np.linalg.solve(system, np.concatenate([S.T @ right, tau])), [S.shape[1]])
        held = {"reaction": (K @ S @ u_dot + at.I @ phi_ddot - right).tolist()} if reaction else {}
        return {"u_dot": u_dot.tolist(), "phi_ddot": phi_ddot.tolist()} | held

    return search(name, want).find(answers)


def named(result: TermSearchResult) -> set[tuple[str, str, float, float | None, str]]:
    assert result.whole
    return {
        (x.component, x.term, round(x.multiple.factor, 6), x.multiple.expected, x.multiple.coefficient)
        for x in result.terms
    }


def whole_moment(name: str) -> float:
    """First moment m z_G of the whole stand about O1, kg m; of stands whose flywheels have theirs on the axis."""
    stand = stand_of(name)
    wheels = sum(wheel.mass * wheel.position[2] for wheel in stand.flywheels)
    return stand.carrier.mass * stand.carrier.center_of_mass[2] + wheels


def total_mass(name: str) -> float:
    return sum(body.mass for body in stand_of(name).bodies)


@pytest.mark.parametrize(("name", "want"), [("pendulum", "forward"), ("pendulum", "coupled"), ("cube", "forward")])
def test_a_weight_with_another_arm(name: str, want: str) -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[4] -= 0.2 * whole_moment(name) * at.gravity[0]

    # moment of the weight about pitch: z_G times its force along x
    assert named(found(name, change, want)) == {("M", "g_x", 0.8, 1.0, "W z_G")}


@pytest.mark.parametrize("want", ["forward", "coupled", "reaction"])
def test_the_sign_of_a_centrifugal_force_along_the_rail(want: str) -> None:
    """0.16 kg m of unbalance of the left exciter: its force along z is with its speed squared and its phase."""

    def change(_: Any, right: Any, at: Pieces) -> None:
        right[2] -= 2 * 0.16 * at.phi_dot[0] ** 2 * np.cos(at.flywheels[0].phi)

    ((component, term, factor, expected, _),) = named(found("linear_shaker", change, want))
    assert (component, term, factor) == ("Z", "left.speed left.speed cos left", -0.16)
    assert expected == pytest.approx(0.16)


def test_a_missing_gyroscopic_term() -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[4] += at.Theta_ff[0, 0] * at.V_r[5] * at.phi_dot[0]

    # omega x (J11 wx'): -J11 r wx' about pitch
    assert named(found("cube", change)) == {("M", "r wx.speed", 0.0, -1.0, "J11(wx)")}


def test_a_gyroscopic_term_of_another_wheel() -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[4] += at.Theta_ff[0, 0] * at.V_r[5] * (at.phi_dot[0] - at.phi_dot[1])

    assert named(found("cube", change)) == {
        ("M", "r wx.speed", 0.0, -1.0, "J11(wx)"),
        ("M", "r wy.speed", -1.0, 0.0, "J11(wx) or J11(wy) or J11(wz)"),
    }


def test_a_wrong_inertia_and_a_flywheel_with_the_wrong_sign() -> None:
    def inertia(K: Any, _: Any, at: Pieces) -> None:
        K[4, 4] *= 0.9

    assert named(found("pendulum", inertia)) == {("M", "q_dot", -0.9, -1.0, "I_yy")}

    def damping(_: Any, right: Any, at: Pieces) -> None:
        right[4] -= 0.02 * at.V[4]

    assert named(found("pendulum", damping)) == {("M", "q", -0.02, 0.0, "")}


def test_moments_are_about_the_pivot() -> None:
    """A pivot 50 mm below O1: the arm of the weight is longer, and a force along z is none of what is free."""
    lever = whole_moment("arm") + 0.05 * total_mass("arm")

    def arm(_: Any, right: Any, at: Pieces) -> None:
        right[4] -= 0.2 * lever * at.gravity[0]

    result = found("arm", arm)
    assert named(result) == {("M", "g_x", 0.8, 1.0, "W z_G")}
    assert result.about == "the pivot"
    assert result.freedoms == "equations of what is free: M along pitch; speeds: q"

    def force(_: Any, right: Any, at: Pieces) -> None:
        right[0] -= 0.2 * total_mass("arm") * at.gravity[0]

    # at O1, 50 mm above the pivot: a force on the hold, and a moment along what is free
    by_component = {component: factor for component, _, factor, _, _ in named(found("arm", force))}
    assert by_component == pytest.approx({"X": 0.8, "M": 1 - 0.2 * 0.05 * total_mass("arm") / lever}, rel=1e-5)


def test_several_freedoms_have_letters_of_sname() -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[2] -= 2 * total_mass("plane") * at.V[0] * at.V[4]  # of O1: u there is u + 0.05 q of the pivot

    assert {(component, term) for component, term, *_ in named(found("plane", change))} == {("Z", "u q"), ("Z", "q q")}


def test_a_freedom_without_a_name_goes_by_its_number() -> None:
    axis = np.array([0, 1, 1]) / np.sqrt(2)

    def change(_: Any, right: Any, at: Pieces) -> None:
        right[3:] -= 0.02 * (axis @ at.V[3:]) * axis

    result = found("skew", change, reaction=False)
    assert named(result) == {("1", "u_1", -0.02, 0.0, "")}
    assert "1 along 1 (turning about (0, 0.707107, 0.707107)); speeds: u_1" in result.freedoms


def test_speeds_are_relative_to_the_stream() -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[4] -= 0.02 * at.V_r[4] * at.V_r[0]

    (term,) = found("stream", change, reaction=False).terms
    assert (term.component, term.term, round(term.error, 9)) == ("M", "u q", -0.02)


def test_what_the_hold_bears_is_told_by_the_reaction() -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[0] -= 2 * 0.16 * at.phi_dot[0] ** 2

    (term,) = found("linear_shaker", change).terms
    assert (term.component, term.term, round(term.error, 9)) == ("X", "left.speed left.speed", -0.32)
    assert found("linear_shaker", change, reaction=False).terms == ()  # nothing of it is in the motion


@pytest.mark.parametrize("want", ["forward", "reaction"])
def test_a_force_table_has_its_reaction_alone(want: str) -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[2] -= 2 * 0.16 * at.phi_dot[0] ** 2 * np.cos(at.flywheels[0].phi)

    ((component, term, factor, *_),) = named(found("clamped", change, want))
    assert (component, term, factor) == ("Z", "left.speed left.speed cos left", -0.16)


@pytest.mark.parametrize("name", ["pendulum", "arm", "skew", "linear_shaker", "clamped"])
@pytest.mark.parametrize("want", ["forward", "reaction"])
def test_nothing_is_named_for_a_right_program(name: str, want: str) -> None:
    assert found(name, lambda *_: None, want).terms == ()


def test_nothing_is_named_for_what_is_no_product() -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[4] += np.exp(at.V[4])

    assert not found("pendulum", change).whole


def test_words_and_data() -> None:
    def arm(_: Any, right: Any, at: Pieces) -> None:
        right[4] -= 0.2 * (whole_moment("arm") + 0.05 * total_mass("arm")) * at.gravity[0]

    diagnosis = Diagnosis("unknown").with_terms(found("arm", arm))
    page = (EXAMPLES.parent / "diagnosis.md").read_text(encoding="utf-8")
    assert "\n".join(sentences(diagnosis)) in page
    (row,) = as_object(diagnosis)["found"]
    assert (row["want"], row["component"], row["term"], row["coefficient"]) == ("forward", "M", "g_x", "W z_G")


def test_a_term_takes_the_place_of_two_faults_but_not_of_one() -> None:
    def arm(_: Any, right: Any, at: Pieces) -> None:
        right[4] -= 0.2 * whole_moment("pendulum") * at.gravity[0]

    result = found("pendulum", arm)
    one, other = (Part(fault) for fault in DICTIONARY[:2])
    two = Diagnosis("named", (Cause((one, other), 0.0),))
    assert two.of_two and not Diagnosis("named", (Cause((one,), 0.0),)).of_two
    assert (two.with_terms(result).outcome, two.with_terms(result).causes) == ("terms", ())
    assert two.with_terms(found("pendulum", lambda *_: None)) == two

    def three_terms(_: Any, right: Any, at: Pieces) -> None:
        arm(_, right, at)
        right[4] -= 0.02 * at.V[4] + 0.01 * at.V[4] ** 2

    assert two.with_terms(found("pendulum", three_terms)) == two  # no shorter than two faults


def test_an_error_of_coupled_alone_is_looked_for_where_it_alone_differs() -> None:
    """-0.3 q in u_dot of coupled, not in its accelerations of the wheel: damping of 0.3 of the locked inertia."""
    stand = stand_of("pendulum")
    wants = ("forward", "torque", "coupled")
    assert TermSearch(stand, wants=wants, wrong=("forward", "coupled")).wants == ("forward", "torque")
    search = TermSearch(stand, wants=wants, wrong=("coupled",))
    assert search.wants == wants

    def answers(request: Request) -> Mapping[str, Any]:
        state = held_state(stand, request.state)
        right = dict(reference.evaluate(stand, state, request.want))
        if request.want == ("coupled",):
            right["u_dot"] = right["u_dot"] - 0.3 * state.V[4]
        return right

    result = search.find(answers)
    assert result.whole
    (term,) = result.terms
    K = reference.pieces(stand, held_state(stand, search.requests[0].state)).K
    assert (term.want, term.component, term.term) == ("coupled", "M", "q")
    assert term.error == pytest.approx(-0.3 * K[4, 4])


def test_a_constant_has_a_unit_and_that_of_a_reaction_its_own_sign() -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[2] -= 0.5

    lines = sentences(Diagnosis("unknown").with_terms(found("pendulum", change, "reaction")))
    constant = "a constant of the reaction of 0.5 N (-0.5 on the right-hand side), which should not be there"
    assert f"  reaction, Z: {constant}; 100% of the error" in lines

    def moment(_: Any, right: Any, at: Pieces) -> None:
        right[4] += 0.2

    lines = sentences(Diagnosis("unknown").with_terms(found("pendulum", moment)))
    assert "  forward, M: a constant of 0.2 N m, which should not be there; 100% of the error" in lines


def test_the_signs_of_accelerations_are_explained() -> None:
    def inertia(K: Any, _: Any, at: Pieces) -> None:
        K[4, 4] *= 0.9

    def arm(_: Any, right: Any, at: Pieces) -> None:
        right[4] -= 0.2 * whole_moment("pendulum") * at.gravity[0]

    line = "  accelerations stand on the left; the signs of their factors are those on the right, -K"
    assert line in sentences(Diagnosis("unknown").with_terms(found("pendulum", inertia)))
    assert line not in sentences(Diagnosis("unknown").with_terms(found("pendulum", arm)))
