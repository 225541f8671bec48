"""The C of a held carrier against the literal reference and the second derivation; its self-test, its bad input."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cli.test_eval_held import TEXT
from mahovik.contract.functions import FUNCTIONS
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand.hold import FREEDOMS, twist_of
from mahovik.core.stand.model import Freedom, Hold, Stand
from mahovik.core.stand.random import BARE, EVERYTHING, Features, random_stand, random_state
from mahovik.core.stand.read import loads
from mahovik.core.stand.state import State, rest_state
from mahovik.errors import StateError
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.c_backend import CBackend, InterpreterBackend
from mahovik.proof.verify.program_backend import with_all_inputs
from toolchain.quick import quick
from verify.test_held_judges import worst

PIVOT = (0.3, -0.2, 0.15)
HOLDS: dict[str, tuple[Freedom, ...]] = {
    "clamped": (),
    "hinge": (Freedom("turn", (1.0, -2.0, 0.5)),),
    "knife edge": (Freedom("twist", twist=(1.0, 0.2, 0.0, 0.0, 0.0, 0.3)), FREEDOMS["yaw"]),
    "ball joint": (FREEDOMS["roll"], FREEDOMS["pitch"], FREEDOMS["yaw"]),
    "all but one": tuple(FREEDOMS[name] for name in ("z", "x", "y", "pitch", "roll")),
    "free": tuple(FREEDOMS.values()),
}
DRY = replace(BARE, gravity=True, instruments=1, points=1, wrench_inputs=True)
WET = replace(EVERYTHING, tasks=0)
WANTS = ("forward", "coupled", "torque", "mounts", "points", "reaction", "momentum", "matrices")


def stand_of(name: str, seed: int, features: Features = DRY, flywheels: int = 3) -> Stand:
    stand = random_stand(np.random.default_rng(seed), flywheels, features)
    return replace(stand, hold=Hold(HOLDS[name], PIVOT, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)))


def state_of(stand: Stand, seed: int) -> State:
    assert stand.hold is not None
    rng = np.random.default_rng(seed)
    u, u_dot = (tuple(rng.normal(size=len(stand.hold.freedoms)).tolist()) for _ in range(2))
    state = replace(random_state(stand, rng, phase_limit=3.0), u=u, u_dot=u_dot)
    return replace(state, V=twist_of(stand.hold, u), V_dot=twist_of(stand.hold, u_dot))


def agree(stand: Stand, state: State, own: Any, judge: Any, want: str, most: float) -> None:
    """Both answers to a want are equal; a reaction by what it balances, which may be far larger: K V*."""
    found, other = own.evaluate(state, [want]), judge.evaluate(state, [want])
    assert found.keys() == other.keys()
    for name, reading in found.pop("points", {}).items():
        assert worst(reading, other["points"][name]) < most
    if "reaction" in found:
        K = NumpyBackend(stand).evaluate(state, ["matrices"])["K"]
        left = found.pop("reaction") - np.array(other.pop("reaction"))
        for half in (slice(0, 3), slice(3, 6)):
            scale = float(np.abs(K[half]) @ np.abs(other.get("V_dot", state.V_dot)) @ np.ones(3))
            assert np.abs(left[half]).max() <= most * max(scale, 1.0), (want, "reaction")
    assert not found or worst(found, other) < most, want


@pytest.mark.slow
@pytest.mark.parametrize(("name", "features"), quick(3, [(name, (DRY, WET)[k % 2]) for k, name in enumerate(HOLDS)]))
def test_the_program_agrees_with_both_derivations(name: str, features: Features) -> None:
    stand = stand_of(name, 3, features)
    own = InterpreterBackend(generate_all(stand))
    for seed in range(2):
        state = state_of(stand, seed)
        for want in WANTS:
            agree(stand, state, own, NumpyBackend(stand), want, 1e-11)
    for want in ("forward", "coupled", "reaction"):
        given = replace(state, wrench={})
        agree(stand, given, own, Second(stand), want, 1e-10)


@pytest.mark.parametrize("name", ["clamped", "hinge"])
@pytest.mark.parametrize("flywheels", [0, 1])
def test_few_unknowns_have_an_answer_of_both_derivations(name: str, flywheels: int) -> None:
    """Without a freedom, with one flywheel or none: the second derivation answers, and likewise."""
    stand = stand_of(name, 3, DRY, flywheels)
    state = replace(state_of(stand, 0), wrench={})
    for want in ("forward", "coupled", "reaction"):
        agree(stand, state, NumpyBackend(stand), Second(stand), want, 1e-10)


def test_a_blocked_direction_moves_nothing_and_the_reaction_bears_it() -> None:
    """A weight on a hinge: turned about the vertical it does not fall, and the hinge bears weight and its moment."""
    text = TEXT.replace('freedoms = ["pitch"]', 'freedoms = ["yaw"]')
    stand = loads(text)
    found = InterpreterBackend(generate_all(stand)).evaluate(rest_state(stand), ["forward"])
    assert found["u_dot"] == [0.0]
    assert found["reaction"] == pytest.approx([0, 0, 2.5 * 9.81, 0, 0, 0], rel=1e-14)


def test_what_the_c_has_not_is_an_error_line_and_no_function() -> None:
    stand = loads(TEXT)
    knife_edge = stand_of("knife edge", 3)
    with pytest.raises(StateError, match='no "generalized" of a hold whose freedoms have no coordinates'):
        InterpreterBackend(generate_all(knife_edge)).evaluate(rest_state(knife_edge), ["generalized"])
    clamped = replace(stand, hold=Hold((), PIVOT, (0.0,) * 3, (0.0,) * 3))
    for lacking, why in (
        (clamped, "of a hold that clamps the carrier"),
        (replace(stand, flywheels=()), "of a held carrier without flywheels"),
    ):
        for backend in (InterpreterBackend(generate_all(lacking)), NumpyBackend(lacking)):
            with pytest.raises(StateError, match=rf'^want: no "inverse" {why}, ask for forward$'):
                backend.evaluate(rest_state(lacking), ["inverse"])
    own = generate_all(clamped).program
    assert {"inverse", "inverse_fast"}.isdisjoint(f.name for f in own.functions)


@pytest.mark.parametrize(
    ("name", "flywheels"), quick(2, [("all but one", 6), ("hinge", 1), ("hinge", 3), ("ball joint", 2)])
)
def test_inverse_has_a_row_for_each_freedom(name: str, flywheels: int) -> None:
    stand = stand_of(name, 11, DRY if flywheels == 3 else WET, flywheels)
    own, judge = InterpreterBackend(generate_all(stand)), NumpyBackend(stand)
    for seed in range(2):
        state = replace(state_of(stand, seed), wrench={})
        found, other = (backend.evaluate(state, ["inverse"]) for backend in (own, judge))
        assert (found.pop("status"), found.pop("rank")) == (other.pop("status"), other.pop("rank"))
        left, rest = np.array(found.pop("residual")), np.array(other.pop("residual"))
        at = judge.evaluate(replace(state, V_dot=(0.0,) * 6), ["matrices"])
        assert np.abs(left - rest).max() <= 1e-10 * max(np.abs(at["K"]).max() * np.abs(state.V_dot).max(), 1.0)
        assert worst(found, other) < 1e-10


def test_one_freedom_takes_no_solve_of_six() -> None:
    names = {f.name for f in generate_all(loads(TEXT)).program.functions}
    assert "solve_freedoms" in names
    assert names.isdisjoint({"factor3", "solve3", "factor_carrier", "solve_carrier", "factor_schur", "solve_schur"})


@pytest.mark.parametrize("name", ["clamped", "knife edge"])
def test_a_lock_leaves_a_flywheel_as_part_of_the_carrier(name: str) -> None:
    """phi'' of a locked flywheel is zero, and the others and the carrier move as for this given acceleration."""
    stand = stand_of(name, 6, WET)
    own, state = InterpreterBackend(generate_all(stand)), replace(state_of(stand, 2), wrench={})
    inputs = own.arguments(state)
    _, found = own.call("coupled", {**inputs, "locked": [0, 1, 0]})
    assert found["phi_ddot"][1] == 0.0 and all(found["phi_ddot"][i] for i in (0, 2))
    _, given = own.call("forward", {**inputs, "phi_ddot": found["phi_ddot"]})
    assert np.allclose(given["V_dot"], found["V_dot"], rtol=0, atol=1e-11 * np.abs(found["V_dot"]).max())
    _, torque = own.call("torque", {**inputs, "V_dot": found["V_dot"], "phi_ddot": found["phi_ddot"]})
    assert np.array(torque["tau"])[[0, 2]] == pytest.approx(np.array(state.tau)[[0, 2]], rel=1e-9)


@pytest.mark.slow
def test_compiled_c_gives_the_bits_of_the_interpreter_and_float_its_digits() -> None:
    stand = stand_of("knife edge", 8, DRY)
    state, made = replace(state_of(stand, 3), wrench={}), generate_all(stand)
    found, same = (
        backend.evaluate(state, ["forward"]) for backend in (CBackend(stand, generated=made), InterpreterBackend(made))
    )
    assert found == same
    agree(stand, state, CBackend(stand, "float"), NumpyBackend(stand), "forward", 1e-4)


def run_steps(stand: Stand, x: dict[str, Any], dt: float, count: int, order: int = 4) -> dict[str, Any]:
    """The state after steps without drive torque."""
    own = InterpreterBackend(generate_all(stand))
    inputs = own.arguments(rest_state(stand))
    for _ in range(count):
        status, found = own.call("step", {**inputs, "x": x, "dt": dt, "order": order})
        assert status == 0
        x = found["next"]
    return x


def test_steps_swing_as_the_pendulum_does_about_a_pivot_that_stays() -> None:
    """The physical pendulum with a wheel that turns freely about its axis, by its own equation in the angle."""
    stand, angle = loads(TEXT), 2.0
    x = {"position": [-0.1, 0.2, 0.3], "attitude": [np.cos(1.0), 0, np.sin(1.0), 0], "V": [0.0] * 6}
    found = run_steps(stand, {**x, "phi": [0.0], "phi_dot": [0.0]}, 1e-3, 400)
    inertia, weight = 0.02 + 2.5 * 0.2**2, 2.5 * 9.81 * 0.2

    def fall(_: float, y: Any) -> list[float]:
        return [y[1], weight * np.sin(y[0]) / inertia]

    swung = solve_ivp(fall, (0.0, 0.4), [angle, 0.0], method="DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    w, _, y, _ = found["attitude"]
    assert 2 * np.arctan2(y, w) == pytest.approx(swung[0], abs=1e-9)
    assert found["V"] == pytest.approx([-0.2 * -swung[1], 0, 0, 0, swung[1], 0], abs=1e-8)
    arm = [np.array([np.sin(a), 0, np.cos(a)]) * -0.2 for a in (angle, 2 * np.arctan2(y, w))]
    assert np.array(found["position"]) + arm[1] == pytest.approx(np.array(x["position"]) + arm[0], abs=1e-14)


def test_a_plane_lets_the_pivot_slide_in_it_alone() -> None:
    stand = replace(
        loads(TEXT), hold=Hold(tuple(FREEDOMS[n] for n in ("x", "z", "pitch")), PIVOT, (0.0,) * 3, (0.0,) * 3)
    )
    assert stand.hold is not None
    V = twist_of(stand.hold, (0.5, -0.3, 2.0))
    x = {"position": [0.0] * 3, "attitude": [1.0, 0, 0, 0], "V": V, "phi": [0.0], "phi_dot": [50.0]}
    found = run_steps(stand, x, 1e-3, 100)
    assert found["position"][1] == 0.0 and found["attitude"][1] == found["attitude"][3] == 0.0
    # the mass centre is at O1 and falls freely
    start = np.array(V[:3])
    assert found["position"] == pytest.approx(start * 0.1 - np.array([0, 0, 9.81 * 0.01 / 2]), abs=1e-12)


def test_the_functions_have_the_rows_of_the_contract() -> None:
    stand = replace(with_all_inputs(loads(TEXT)), phase_input="sincos")
    functions = [f for f in generate_all(stand).program.functions if f.public]
    for f in functions:
        taken = [a.name for a in f.arguments if a.direction != "out"]
        assert [name for name in FUNCTIONS[f.name].takes if name in taken] == taken, f.name
    assert {"forward_at", "coupled_at", "torque_at", "step", "inverse"} <= {f.name for f in functions}
