"""States made, written, read by name and stepped; results of held carriers; tasks and the torques for them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import mahovik
from api.models import model
from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import State
from mahovik.core.stand.random import random_state
from mahovik.core.stand.stand_file import loads
from mahovik.errors import InputError
from mahovik.out.api.stands import Stand
from mahovik.proof import reference
from mahovik.proof.reference import evaluate
from mahovik.proof.reference.coordinates import pose_of
from mahovik.proof.verify.draw import quaternion_of
from toolchain.quick import quick
from verify.holds import PENDULUM


def test_arrays_are_views() -> None:
    x = model("bench8").states(3)
    x.V[1, 2] = 4.0
    x["phi_dot", "w8"] = [1.0, 2.0, 3.0]
    x.phi = np.arange(8.0)
    assert x.array[1, 9] == 4.0 and x.array[:, 28].tolist() == [1.0, 2.0, 3.0]
    assert np.array_equal(x.phi[2], np.arange(8.0)) and np.array_equal(x["phi", "w3"], [2.0, 2.0, 2.0])
    y = x.copy()
    y.V[:] = 0
    assert x.V[1, 2] == 4.0


def test_a_single_state_has_no_batch_axis() -> None:
    x = model("bench8").state(position=[1, 2, 3], phi_dot={"w2": 5})
    assert x.batch is None and x.position.tolist() == [1, 2, 3] and x.array.shape == (29,)
    x.phi[3] = 1.5
    assert x.array[16] == 1.5 and x["phi_dot", "w2"] == 5
    with pytest.raises(mahovik.InputError, match="no length"):
        len(x)


def test_angles_are_those_of_the_sequence() -> None:
    x = model("bench8").state(angles=[np.pi / 2, 0, 0])
    np.testing.assert_allclose(x.attitude, [np.sqrt(0.5), 0, 0, np.sqrt(0.5)], atol=1e-15)
    many = model("bench8").states(angles=[[0.0, 0.0, 0.0], [np.pi / 2, 0.0, 0.0]])
    assert np.array_equal(many.attitude[1], x.attitude)


def test_numbers_by_name_are_the_states_that_they_make() -> None:
    m = model("bench8")
    twist = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
    assert np.array_equal(m.momentum({}).Z, m.momentum(m.state()).Z)
    assert np.array_equal(m.momentum({"V": twist}).Z, m.momentum(m.state(V=twist)).Z)
    assert np.array_equal(m.momentum(dict(m.states(2, V=twist))).Z, m.momentum(m.states(2, V=twist)).Z)
    with pytest.raises(mahovik.InputError, match="unknown V u, did you mean"):
        m.momentum({"V u": 1.0})


def test_quaternions_are_made_unit_within_the_promised_bound() -> None:
    m = model("bench8")
    assert np.linalg.norm(m.state(attitude=[1.0005, 0, 0, 0]).attitude) == 1.0
    unit = np.array([0.5, 0.5, 0.5, 0.5])
    assert np.array_equal(m.state(attitude=unit).attitude, unit)
    with pytest.raises(mahovik.InputError, match=r"attitude of state 1: length 2, expected 1 within 0\.001"):
        m.states(attitude=[[1, 0, 0, 0], [2, 0, 0, 0]])


def test_no_states_at_all() -> None:
    m = model("bench8")
    result = m.forward(m.states(0), np.zeros((0, 8)))
    assert result.V_dot.shape == (0, 6) and result.status.shape == (0,)
    assert m.matrices(m.states(0)).I.shape == (0, 6, 8)
    assert m.mounts(m.states(0)).mount_wrench.shape == (0, 8, 6)


@pytest.mark.parametrize("name", ["bench8", "pendulum"])
def test_commands_take_a_state_its_arrays_or_its_keys(name: str) -> None:
    """A state, a mapping of its arrays, the keys of `eval`, numbers for all, by name and with units are one state."""
    stand = mahovik.example(name) if name == "bench8" else Stand.of(loads(PENDULUM))
    m, angle = mahovik.build(stand), [0.0, 0.1, 0.0]
    moving: dict[str, Any] = {"u": [0.5]} if stand.hold is not None else {"V": [0.1, 0.0, 0.0, 0.0, 0.2, 0.0]}
    x = m.state(angles=angle, phi_dot={m.flywheels[0]: "600 rpm"}, **moving)
    keys = {"angles": angle, **moving, "phi_dot": x.phi_dot.tolist()}
    named = keys | {"phi_dot": {m.flywheels[0]: "600 rpm"}, "phi": "0 rad"}
    starts: tuple[Any, ...] = (x, dict(x), keys, named)
    for start in starts:
        run = mahovik.simulate(stand, until="2 ms", start=start)
        reached = [run[f"phi_dot {m.flywheels[0]}"][0], run["x"][0], *(run[f"omega_{a}"][0] for a in "xyz")]
        assert reached == pytest.approx([x.phi_dot[0], x.position[0], *x.V[3:]], abs=1e-15)
        assert mahovik.modes(stand, start=start).text() == mahovik.modes(stand, start=keys).text()
        for named_attitude in (start, {k.replace("attitude", "quaternion"): v for k, v in dict(start).items()}):
            assert m.forward(named_attitude)["V_dot"] == pytest.approx(m.forward(x)["V_dot"], abs=1e-12)
            assert m.simulate("2 ms", start=named_attitude)["V"][0] == pytest.approx(x.V, abs=1e-15)
    answers = mahovik.eval(stand, [dict(start) | {"want": ["forward"]} for start in starts])["answers"]
    assert all(np.allclose(answer["V_dot"], m.forward(x)["V_dot"], atol=1e-12) for answer in answers)
    for several in (m.states(2), model("general").state()):
        with pytest.raises(mahovik.InputError, match=r"2 states given, expected one|states of another stand"):
            mahovik.simulate(stand, until=1e-3, start=several)
    with pytest.raises(mahovik.InputError, match=r"start: found the text 'start\.json', expected states"):
        m.simulate("2 ms", start="start.json")
    with pytest.raises(mahovik.InputError, match="unknown tau, expected some of position"):
        m.forward({"tau": 1.0})
    x.V[1] = 1.0
    if stand.hold is not None:
        with pytest.raises(mahovik.InputError, match=r"start: V: moves along y, which \[hold\] blocks"):
            m.simulate("2 ms", start=x)


def test_a_state_that_cannot_be_is_an_answer_with_its_error() -> None:
    """One mapping or one line is one state; arrays that do not fit are told in the place of the answer."""
    one: dict[str, Any] = {"id": 7, "phi_dot": np.ones(4), "want": ["forward"]}
    good = mahovik.eval(mahovik.example("sat4"), one)
    assert good["answers"][0]["id"] == 7 and len(good["answers"]) == 1
    assert mahovik.eval(mahovik.example("sat4"), '{"want": ["forward"]}').ok
    bad: list[Any] = [one | {"phi_dot": np.ones(3)}, one | {"phi": object()}, 3, one]
    result = mahovik.eval(mahovik.example("sat4"), bad)
    words = [answer.get("error", "") for answer in result["answers"]]
    assert not result.ok and [bool(text) for text in words] == [True, True, True, False]
    assert "phi_dot: expected shape (4,)" in words[0] and result["answers"][0]["id"] == 7


DT, SPEED, TORQUE = 1e-4, 100.0, 1e-4


def started(m: mahovik.Model) -> mahovik.States:
    """sat4 far from the origin, moving slowly, its wheels turning fast."""
    return m.state(
        position=(200.0, 0.0, 0.0), V=(5e-3, 0, 0, 1e-3, 0, 0), phi=(-1.0, -1 / 3, 1 / 3, 1.0), phi_dot=SPEED
    )


def driven(m: mahovik.Model, steps: int, carried: bool) -> Any:
    x, carry = started(m), m.carry() if carried else None
    for _ in range(steps):
        x = m.step(x, DT, TORQUE, carry=carry)
    return x


@pytest.mark.parametrize("steps", [1_000, pytest.param(200_000, marks=pytest.mark.slow)])
def test_short_steps_in_float_stay_right_with_a_carry_only(steps: int) -> None:
    exact, single = driven(model("sat4"), steps, False), model("sat4", "float")
    plain, carried = (driven(single, steps, with_carry) for with_carry in (False, True))

    def errors(x: Any) -> tuple[float, float]:
        position = np.linalg.norm(np.asarray(x.position, dtype=np.float64) - exact.position)
        speeds = np.abs(np.asarray(x.phi_dot, dtype=np.float64) - exact.phi_dot)
        return float(position), float(speeds.max())

    moved = 5e-3 * DT * steps
    assert errors(plain)[0] > 0.1 * moved  # less than half a unit in the last place is lost at once
    for error, unit in zip(errors(carried), (200.0, SPEED), strict=True):
        assert error <= 4 * 2.0**-24 * unit


def test_a_refused_state_leaves_its_carry() -> None:
    m = model("sat4", "float")
    x = m.states(2, position=200.0, phi_dot=SPEED)
    carry = m.carry(2)
    x = m.step(x, DT, TORQUE, carry=carry)
    before = carry.copy()
    wrong = x.array.copy()
    wrong[1, 7] = np.nan
    after = m.step(wrong, DT, TORQUE, carry=carry, on_error="nan")
    assert np.isnan(after.array[1]).all() and np.isfinite(after.array[0]).all()
    assert np.array_equal(carry[1], before[1]) and not np.array_equal(carry[0], before[0])


@pytest.mark.parametrize(
    "carry", [np.zeros(21), np.zeros(20, np.float32), np.zeros((1, 21), np.float32), [0.0] * 21, 0.0]
)
def test_another_carry_is_refused(carry: Any) -> None:
    m = model("sat4", "float")
    with pytest.raises(InputError, match=r"carry: expected float32 \(21,\), found .*: model.carry\(\) makes one"):
        m.step(started(m), DT, carry=carry)


def test_what_is_of_the_freedoms_has_their_names() -> None:
    model = mahovik.build(Stand.of(loads(PENDULUM)))
    x = model.state(angles=[0, 0.3, 0], V=[0.2 * 0.4, 0, 0, 0, 0.4, 0])  # u = 0.4 rad/s about the pivot
    moved = model.forward(x, phi_ddot=3.0)
    assert moved["u_dot", "pitch"] == moved["V_dot", "q"] != 0
    answer = model.inverse(x, V_dot=moved.V_dot)
    assert {one.name: one.axes for one in answer.columns}["residual"][0].labels == ("pitch",)
    heads = {one.head for result in (moved, answer, model.generalized(x)) for one in result.flat()}
    assert {"u_dot pitch, rad/s2", "residual pitch, N m", "q pitch, rad", "q_dot pitch, rad/s"} <= heads
    assert abs(answer["residual", "pitch"]) < 1e-9 and abs(answer["phi_ddot", "w1"] - 3.0) < 1e-9


def test_the_reaction_of_arrays_of_motions_is_that_of_each() -> None:
    stand = Stand.of(loads(PENDULUM))
    model = mahovik.build(stand)
    rates = np.linspace(-1.0, 1.0, 4)
    V = np.outer(rates, [0.2, 0, 0, 0, 1, 0])
    x = model.states(angles=[0, 0.3, 0], V=V, phi_dot=100.0 * rates[:, None])
    answer = model.reaction(x, V_dot=2.0 * V, phi_ddot=5.0)
    assert answer.reaction.shape == (4, 6)
    for k, u in enumerate(rates.tolist()):
        state = State(
            (0.0,) * 3, (0.0, 0.3, 0.0), None, (0.0,) * 6, (0.0,), (100.0 * u,), (5.0,), (0.0,) * 6, (0.0,),
            u=(u,), u_dot=(2.0 * u,),
        )  # fmt: skip
        expected = reference.evaluate(stand, state, ["reaction"])["reaction"]
        assert np.allclose(answer.reaction[k], expected, rtol=1e-12, atol=1e-12)
        assert answer["reaction", "Z"][k] == answer.reaction[k, 2]


TURNED = PENDULUM.replace(
    "pivot = [0, 0, -0.2]", "pivot = [0, 0.1, -0.2]\nposition = [1, 2, 3]\nangles = [0.3, -0.2, 0.5]"
)


def model_of(freedoms: str, text: str = TURNED) -> Any:
    return mahovik.build(Stand.of(loads(text.replace('freedoms = ["pitch"]', freedoms))))


@pytest.mark.parametrize(
    ("freedoms", "q", "q_dot"),
    quick(
        2,
        [
            ('freedoms = ["pitch"]', [0.7], [1.5]),
            ("axis = [0, 1, 1]", [-2.5], [0.4]),
            ('freedoms = ["yaw", "x", "y"]', [0.7, 0.2, -0.3], [1.5, 0.1, 0.2]),
            ('freedoms = ["x", "roll", "pitch", "yaw", "z", "y"]', [0.2, -0.4, 0.1], [0.1, 1.0, -0.5, 0.7, 0.2, 0.3]),
        ],
    ),
)
def test_poses_that_the_coordinates_reach_are_allowed_and_have_them(
    freedoms: str, q: list[float], q_dot: list[float]
) -> None:
    model = model_of(freedoms)
    orientation = np.array([0.8, 0.0, 0.36, -0.48]) if "roll" in freedoms else None
    hold = model.stand.hold
    there = pose_of(hold, model.stand.angles, np.array(q), orientation, np.array(q_dot), np.zeros(len(q_dot)))
    x = model.state(position=there.position, attitude=quaternion_of(there.C), V=there.V)
    back = model.generalized(x)
    assert back.q == pytest.approx(q, rel=1e-12) and back.q_dot == pytest.approx(q_dot, rel=1e-12)
    if "x" not in freedoms:  # where nothing slides the hold has the carrier at one place
        turned = model.state(attitude=x.attitude, V=there.V)
        assert np.allclose(turned.position, there.position, rtol=0, atol=1e-14)


def test_a_state_without_a_pose_is_at_home_and_u_is_the_speed_of_the_freedoms() -> None:
    model = model_of('freedoms = ["pitch"]')
    x = model.state(u=[2.0])
    assert np.array_equal(x.V, 2.0 * twists(model.stand.hold)[:, 0])
    assert x.position == pytest.approx([1, 2, 3], abs=1e-15)
    assert model.states(u={"pitch": [1.0, 2.0]}).V[1] == pytest.approx(x.V)


PITCH, CLAMPED = 'freedoms = ["pitch"]', "freedoms = []"
REFUSED: list[tuple[str, Callable[[Any], Any], str]] = [
    ("", lambda m: m.reaction(m.state()), "reaction: the stand has no [hold]"),
    ("", lambda m: m.state(u=[1.0]), "u: the stand has no [hold], expected V"),
    (PITCH, lambda m: m.reaction(m.state()), "V_dot is missing, expected that of the motion; forward"),
    (PITCH, lambda m: m.generalized(m.state(), [0, 0.3, 0]), "angles: given, expected none, the carrier is held"),
    (PITCH, lambda m: m.state(V=[0, 0, 0, 0, 0.4, 0]), "V: moves along x, which [hold] blocks; expected S u of the"),
    (PITCH, lambda m: m.states(angles=[0.2, 0, 0]), "off by 0.2 rad along yaw, which [hold] blocks"),
    (PITCH, lambda m: m.states(position=[0.1, 0, 0]), "off by 0.1 m along x"),
    (PITCH, lambda m: m.states(position=[[0, 0, 0], [0, 0, 0.2]]), "attitude of state 1: off by 0.2 m along z"),
    (PITCH, lambda m: m.states(u=[1.0], V=[0.2, 0, 0, 0, 1, 0]), "V, u: both given"),
    (PITCH, lambda m: m.tables({"hold.axis": np.ones((2, 3))}), "hold.axis: decides how the carrier can move"),
    (PITCH, lambda m: m.states(u={"yaw": 1.0}), 'u: no freedom "yaw"'),
    (CLAMPED, lambda m: m.states(position=[0.1, 0, 0]), "expected the home pose, as clamped"),
    (CLAMPED, lambda m: m.inverse(m.states(2), 0.0), 'no "inverse" of a hold that clamps the carrier, ask for forward'),
]


@pytest.mark.parametrize(("freedoms", "call", "message"), REFUSED, ids=[words for *_, words in REFUSED])
def test_what_a_hold_does_not_allow_is_refused_in_words(
    freedoms: str, call: Callable[[Any], Any], message: str
) -> None:
    text = PENDULUM if freedoms != CLAMPED else PENDULUM.replace("pivot = [0, 0, -0.2]\n", "")
    model = model_of(freedoms, text) if freedoms else mahovik.build(mahovik.example("demo3"))
    with pytest.raises(mahovik.MahovikError) as refused:
        call(model)
    assert message in str(refused.value)


SAT = mahovik.example("sat4").replace({"task.sight.rows": [{"point": "acc1", "rows": ["wy", "vz"]}, "wz"]})
MODEL = mahovik.build(SAT)


def some_states(count: int) -> list[State]:
    rng = np.random.default_rng(5)
    return [replace(random_state(SAT, rng), angles=None, quaternion=None) for _ in range(count)]


def states(batch: list[State]) -> Any:
    x = MODEL.states(len(batch))
    for name in ("position", "V", "phi", "phi_dot"):
        x[name][:] = [getattr(state, name) for state in batch]
    return x


def test_many_states_of_a_task() -> None:
    drawn = some_states(5)
    demand = np.random.default_rng(1).normal(size=(5, 3)) * 1e-3
    answer = MODEL.inverse(states(drawn), task="sight", demand=demand)
    for j, state in enumerate(drawn):
        due = evaluate(SAT, replace(state, task="sight", demand=tuple(demand[j])), ["inverse"])
        for name in ("phi_ddot", "V_dot", "residual", "sigma"):
            np.testing.assert_allclose(
                answer[name][j], due[name], rtol=1e-9, atol=1e-9 * np.abs(due[name]).max() + 1e-12
            )
        assert mahovik.status_words(answer.status)[j] == due["status"]
    assert answer["residual", "acc1.wy"].shape == (5,)
    assert "residual acc1.wy, rad/s2" in {one.head for one in answer.flat()}


def test_rows_are_freed_by_name() -> None:
    x = states(some_states(1))
    one = MODEL.inverse(x, task="pointing", demand=[1e-3, 2e-3, 0.0], rows=["wx", "wy"])
    np.testing.assert_allclose(one.V_dot[0, 3:5], [1e-3, 2e-3], rtol=1e-9)
    assert abs(one.V_dot[0, 5]) > 1e-9 and one.residual[0, 2] == 0.0 and one.rank[0] == 2
    none = MODEL.inverse(x, task="pointing", demand=[1.0, 1.0, 1.0], rows=[])
    assert none.rank[0] == 0 and not none.phi_ddot.any()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"task": "sigth", "demand": [0, 0, 0]}, 'task: unknown "sigth", did you mean "sight"'),
        ({"task": "sight"}, "demand: missing, expected one number for each of acc1.wy, acc1.vz, wz"),
        ({"task": "sight", "demand": [1, 2]}, r"demand: expected shape \(3,\) or \(n, 3\)"),
        ({"task": "sight", "demand": [1, 2, 3], "V_dot": np.zeros(6)}, "V_dot, task: both given"),
        ({"demand": [1, 2, 3]}, "demand: needs a task"),
        ({}, "V_dot: missing; give V_dot, or a task and its demand"),
        ({"task": "sight", "demand": [1, 2, 3], "rows": ["wy"]}, 'rows: the task sight has no "wy", did you mean'),
    ],
)
def test_wrong_calls_are_refused(arguments: dict[str, Any], words: str) -> None:
    with pytest.raises(mahovik.InputError, match=words):
        MODEL.inverse(MODEL.states(), **arguments)


def test_a_refused_state_is_explained() -> None:
    with pytest.raises(mahovik.RefusedError, match=r"inverse_sight: RANGE: demand acc1.vz is 2e\+09|demand\[1\]"):
        MODEL.inverse(MODEL.states(), task="sight", demand=[0.0, 2e9, 0.0])


RATES = np.array([120.0, -80.0, 60.0, -150.0])


def state(speed: Any = RATES) -> Any:
    x = MODEL.states()
    x["phi_dot"][:] = speed
    return x


def test_inside_the_limits_it_is_the_inverse_problem_with_its_torques() -> None:
    answer = MODEL.torque_for(state(), "pointing", [0.02, -0.01, 0.015])
    np.testing.assert_allclose(answer.V_dot[3:], [0.02, -0.01, 0.015], rtol=1e-12)
    np.testing.assert_allclose(MODEL.torque(state(), answer.V_dot, answer.phi_ddot).tau, answer.tau, rtol=1e-12)
    assert answer.share == 1.0 and not answer.limited.any() and mahovik.status_words(answer.status) == "OK"


def test_a_demand_out_of_reach_is_made_smaller_and_not_turned() -> None:
    demand = np.array([0.6, 0.35, -0.1])
    answer = MODEL.torque_for(state(), "pointing", demand, keep_direction=True)
    assert 0.0 < answer.share < 1.0
    np.testing.assert_allclose(answer.V_dot[3:], answer.share * demand, rtol=1e-9)
    assert mahovik.status_words(answer.status) == "LIMITED|UNREACHABLE"
    least = MODEL.torque_for(state(), "pointing", demand)
    assert np.linalg.norm(least.residual) < np.linalg.norm(answer.residual)
    for tau in (answer.tau, least.tau):
        assert np.all(np.abs(tau) <= 0.2)


def test_wanted_speeds_are_approached_without_a_change_of_the_motion() -> None:
    target = np.array([100.0, -100.0, 100.0, -100.0])  # a null space of the pyramid
    demand = [0.01, 0.0, 0.0]
    moved = MODEL.torque_for(state(-target), "pointing", demand, target_speed=target, target_rate=0.02)
    plain = MODEL.torque_for(state(-target), "pointing", demand)
    np.testing.assert_allclose(moved.V_dot[3:], plain.V_dot[3:], rtol=1e-10, atol=1e-14)
    along = (moved.phi_ddot - plain.phi_ddot) @ target / np.linalg.norm(target)
    assert along == pytest.approx(0.02 * 2 * np.linalg.norm(target), rel=1e-2)


def test_power_and_speed_bound_what_drives_and_not_what_brakes() -> None:
    demand = [0.0, 0.0, 5.0]
    x = state(np.full(4, 300.0))
    down = MODEL.torque_for(x, "pointing", demand, motor_power=15.0).tau
    up = MODEL.torque_for(x, "pointing", [-5.0 * (d > 0) for d in demand], motor_power=15.0).tau
    braking, driving = (down, up) if down.sum() < 0 else (up, down)
    np.testing.assert_allclose(braking, -0.2)
    np.testing.assert_allclose(driving, 15.0 / 300.0)
