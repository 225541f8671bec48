"""The program of a held carrier against both other derivations and motions known in closed form."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from export.held_servos import ARM, MASS, SPIN, WHOLE, pendulum
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand.model import Hold, MountingAxes, Stand, rest_state
from mahovik.core.stand.stand_file import loads
from mahovik.errors import StateError
from mahovik.proof.verify.backends import NumpyBackend, turns
from mahovik.proof.verify.c_backend import InterpreterBackend
from toolchain.quick import quick
from verify.holds import DRY, PENDULUM, PIVOT, WET, random_held_stand, state_of


def test_a_blocked_direction_moves_nothing_and_the_reaction_bears_it() -> None:
    """A weight on a hinge: turned about the vertical it does not fall, and the hinge bears weight and its moment."""
    text = PENDULUM.replace('freedoms = ["pitch"]', 'freedoms = ["yaw"]')
    stand = loads(text)
    output = InterpreterBackend(generate_all(stand)).evaluate(rest_state(stand), ["forward"])
    assert output["u_dot"] == [0.0]
    assert output["reaction"] == pytest.approx([0, 0, 2.5 * 9.81, 0, 0, 0], rel=1e-14)


def test_what_the_c_has_not_is_an_error_line_and_no_function() -> None:
    stand = loads(PENDULUM)
    knife_edge = random_held_stand("knife edge", 3, DRY, 1)
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
    program = generate_all(clamped).program
    assert {"inverse", "inverse_fast"}.isdisjoint(f.name for f in program.functions)


@pytest.mark.parametrize("name", quick(1, ["clamped", "knife edge"]))
def test_a_lock_leaves_a_flywheel_as_part_of_the_carrier(name: str) -> None:
    """phi'' of a locked flywheel is zero, and the others and the carrier move as for this given acceleration."""
    stand = random_held_stand(name, 6, WET)
    backend, state = InterpreterBackend(generate_all(stand)), replace(state_of(stand, 2), wrench={})
    inputs = backend.arguments(state)
    _, coupled = backend.call("coupled", {**inputs, "locked": [0, 1, 0]})
    assert coupled["phi_ddot"][1] == 0.0 and all(coupled["phi_ddot"][i] for i in (0, 2))
    _, forward = backend.call("forward", {**inputs, "phi_ddot": coupled["phi_ddot"]})
    assert np.allclose(forward["V_dot"], coupled["V_dot"], rtol=0, atol=1e-11 * np.abs(coupled["V_dot"]).max())
    _, torque = backend.call("torque", {**inputs, "V_dot": coupled["V_dot"], "phi_ddot": coupled["phi_ddot"]})
    assert np.array(torque["tau"])[[0, 2]] == pytest.approx(np.array(state.tau)[[0, 2]], rel=1e-9)


def answer(
    backend: InterpreterBackend, stand: Stand, state: Any, function: str, sines: bool = False, **options: Any
) -> tuple[int, np.ndarray]:
    """Status without EXCESSIVE, and phi''; `sines`: of given sines and cosines."""
    inputs = backend.arguments(state) | (turns(state) if sines else {})
    status, output = backend.call(function, {**inputs, "options": {**inputs["options"], **options}})
    phi_ddot = output.get("out", output).get("phi_ddot", np.full(len(stand.flywheels), np.nan))
    return status & ~STATUS_VALUES["EXCESSIVE"] if status > 0 else status, np.array(phi_ddot)


def test_inverse_fast_of_a_wheel_on_a_hinge_by_the_closed_formula() -> None:
    """WHOLE theta'' + SPIN phi'' = -MASS g ARM sin theta."""
    stand, theta, wanted = pendulum(), 0.7, 3.0
    state = replace(
        rest_state(stand), quaternion=(np.cos(theta / 2), 0.0, np.sin(theta / 2), 0.0),
        u=(0.4,), V=(0, 0, 0, 0, 0.4, 0),
        u_dot=(wanted,), V_dot=(0, 0, 0, 0, wanted, 0), phi_dot=(90.0,),
    )  # fmt: skip
    status, phi_ddot = answer(InterpreterBackend(generate_all(stand)), stand, state, "inverse_fast")
    assert status == 0
    expected = -(WHOLE * wanted + MASS * 9.81 * ARM * np.sin(theta)) / SPIN
    assert phi_ddot == pytest.approx([expected], rel=1e-14)


@pytest.mark.parametrize(("name", "flywheels"), quick(2, [("ball joint", 2), ("hinge", 3), ("all but one", 7)]))
def test_inverse_fast_is_the_answer_of_inverse_with_weights(name: str, flywheels: int) -> None:
    """With fewer flywheels than freedoms the least residual, in the norm of (S^T K S)^-1, else the least phi''."""
    stand = replace(random_held_stand(name, 12, DRY, flywheels), phase_input="sincos")
    backend = InterpreterBackend(generate_all(stand))
    weight = [float(w) for w in np.linspace(1.0, 4.0, flywheels)]
    state = replace(state_of(stand, 0), wrench={})
    _, expected = answer(backend, stand, state, "inverse", weight=weight)
    status, phi_ddot = answer(backend, stand, state, "inverse_fast", weight=weight)
    assert status == 0
    assert np.abs(phi_ddot - expected).max() <= 1e-9 * np.abs(expected).max()
    same_status, same = answer(backend, stand, state, "inverse_fast", True, weight=weight)
    assert (same_status, same.tolist()) == (status, phi_ddot.tolist())


def test_a_freedom_that_no_flywheel_drives_is_refused_without_damping() -> None:
    """A balanced wheel across the hinge has no moment along it."""
    hinge = pendulum()
    wheel = replace(hinge.flywheels[0], mounting=MountingAxes((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
    stand = replace(hinge, flywheels=(wheel,))
    backend, state = InterpreterBackend(generate_all(stand)), replace(rest_state(stand), V_dot=(0, 0, 0, 0, 1.0, 0))
    assert answer(backend, stand, state, "inverse_fast")[0] == STATUS_VALUES["NOT_POSITIVE_DEFINITE"]
