"""The literal equations of held carriers in balls, and the error of their C by them."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from flint import ctx
from hypothesis import given, settings
from hypothesis import strategies as st

from cli.test_eval_held import TEXT
from mahovik.core.stand.hold import twist_of
from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import loads
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof import rigorous
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.rounding.measure import ExactProgram
from rigorous.balls import flat, middles
from rigorous.test_enclosures import SEEDS, check_agreement
from strategies import held_stands
from verify.build import generated
from verify.holds import WET, random_held_stand
from verify.test_rounding import Changed, measured


@settings(max_examples=20, deadline=None)
@given(st.data(), held_stands())
def test_balls_of_random_held_stands_are_where_the_reference_is(data: st.DataObject, stand: Stand) -> None:
    (_, state), *_ = draw(stand, data.draw(SEEDS), 12)[data.draw(st.integers(0, 11)) :]
    check_agreement(stand, state)


def motion_of(stand: Stand, state: State, want: str) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Middles of the balls of a motion, and S."""
    balls = rigorous.evaluate(rigorous.pieces_at(stand, state), state, want)
    m = len(state.u)
    S = np.array([twist_of_unit(stand, k, m) for k in range(m)]).T if m else np.zeros((6, 0))
    return {key: middles(value) for key, value in balls.items()}, S


def twist_of_unit(stand: Stand, k: int, m: int) -> tuple[float, ...]:
    assert stand.hold is not None
    return twist_of(stand.hold, [float(i == k) for i in range(m)])


@pytest.mark.parametrize("want", ["forward", "coupled"])
def test_the_reaction_has_no_power_and_makes_the_free_carrier_move_so(want: str) -> None:
    """S^T R = 0; the carrier without hold, with R as a wrench on it, moves as the held one does."""
    stand = random_held_stand("all but one", 4, WET)
    free = replace(stand, hold=None)
    for _, state in draw(stand, 2, 6):
        found, S = motion_of(stand, state, want)
        R = found["reaction"]
        assert np.abs(S.T @ R).max() <= 1e-13 * np.abs(R).max()
        given_ = np.array(state.wrench.get("carrier", (0.0,) * 6)) + R
        pushed = replace(state, wrench={**state.wrench, "carrier": tuple(given_.tolist())}, u=(), u_dot=())
        alone = middles(rigorous.evaluate(rigorous.pieces_at(free, pushed), pushed, want)["V_dot"])
        assert np.abs(alone - found["V_dot"]).max() <= 1e-9 * np.abs(found["V_dot"]).max()


@pytest.mark.slow
def test_the_program_along_the_freedoms_is_the_literal_equations_to_sixty_digits() -> None:
    """One freedom through a pivot whose coordinates, like u, are small binary fractions: V = S u is exact."""
    stand = loads(TEXT.replace("[0, 0, -0.2]", "[0.25, 0.5, -0.125]"))
    made = generated(stand)
    assert made.layout.along
    state = next(state for name, state in draw(stand, 4, 8) if name.startswith("random"))
    assert stand.hold is not None
    for u in ((0.75,), (-3.5,)):
        state = replace(state, u=u, V=twist_of(stand.hold, u))
        with ctx.workprec(320):
            unprepared = ExactProgram(made.layout, made.program, made.values.table, made.values.mounting)
            parameters = made.values.parameters
            _, found = unprepared.call("prepare", {"parameters": parameters, "table": made.values.table})
            program = ExactProgram(made.layout, made.program, found["table"], made.values.mounting)
            at = rigorous.pieces_at(stand, state, 320)
            for want in ("forward", "coupled", "torque"):
                exact, answer = rigorous.evaluate(at, state, want, 320), program.evaluate(state, (want,))
                for key, balls in exact.items():
                    pairs = list(zip(flat(balls), flat(answer[key]), strict=True))
                    size = max(float(abs(ball).upper()) for ball, _ in pairs)
                    assert all(float((mine - its).abs_upper()) <= 1e-60 * size for mine, its in pairs), (want, key)


@cache
def pendulum() -> CBackend:
    return CBackend(loads(TEXT))


@pytest.mark.parametrize("quantity", ["u_dot", "reaction"])
def test_an_error_of_1e_12_in_what_a_hold_gives_is_caught(quantity: str) -> None:
    found = measured(loads(TEXT), Changed(pendulum(), quantity, 1 + 9e-13), 6)
    assert {row.quantity for row in found.report.failures} == {quantity}
    wants = {"forward", "coupled"} | ({"reaction"} if quantity == "reaction" else set())
    assert {row.want for row in found.report.failures} == wants


def test_a_free_carrier_has_no_reaction_to_enclose() -> None:
    free = replace(loads(TEXT), hold=None)
    _, state = draw(free, 1, 1)[0]
    with pytest.raises(StateError, match="the carrier is free, expected a held one"):
        rigorous.evaluate(rigorous.pieces_at(free, state), state, "reaction")
