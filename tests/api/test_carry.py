"""Steps with a carry in Python: the bits of the C, and sums in float that stay right over many short steps."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import mahovik
from api.models import backend, model, stand
from mahovik.core.stand.state import rest_state
from mahovik.errors import InputError
from mahovik.proof.verify.functions.carries import end_of_steps

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


@pytest.mark.parametrize("steps", [3_000, pytest.param(200_000, marks=pytest.mark.slow)])
def test_short_steps_in_float_stay_right_with_a_carry_only(steps: int) -> None:
    exact, single = driven(model("sat4"), steps, False), model("sat4", "float")
    plain, carried = (driven(single, steps, with_carry) for with_carry in (False, True))

    def errors(x: Any) -> tuple[float, float]:
        position = np.linalg.norm(np.asarray(x.position, dtype=np.float64) - exact.position)
        speeds = np.abs(np.asarray(x.phi_dot, dtype=np.float64) - exact.phi_dot)
        return float(position), float(speeds.max())

    moved = 5e-3 * DT * steps
    assert errors(plain)[0] > 0.1 * moved  # less than half a unit in the last place is lost at once
    for found, unit in zip(errors(carried), (200.0, SPEED), strict=True):
        assert found <= 4 * 2.0**-24 * unit


def test_the_carry_is_that_of_the_c() -> None:
    """Ten steps by the C of the harness, which calls it for one state, end in the same bits."""
    of = rest_state(stand("sat4"))
    state = replace(
        of,
        position=(200.0, 0.0, 0.0),
        V=(5e-3, 0.0, 0.0, 1e-3, 0.0, 0.0),
        phi=(-1.0, -1 / 3, 1 / 3, 1.0),
        phi_dot=(SPEED,) * 4,
        tau=(TORQUE,) * 4,
    )
    end = end_of_steps(backend("sat4"), "step_carried", state, 10 * DT, 10, 4)
    found = driven(model("sat4"), 10, True)
    for name, value in end.items():
        assert np.array_equal(getattr(found, name), value), name


def test_many_states_have_a_carry_each() -> None:
    m = model("sat4", "float")
    x = m.states(3, position=np.diag([200.0, 100.0, 50.0]), V=1e-3, phi_dot=SPEED)
    carry = m.carry(3)
    ones = [(m.states_of(row), m.carry()) for row in x.array]
    for _ in range(5):
        x = m.step_driven(x, DT, 0.5, carry=carry)
        ones = [(m.step_driven(one, DT, 0.5, carry=own), own) for one, own in ones]
    assert np.array_equal(x.array, [one.array for one, _ in ones])
    assert np.array_equal(carry, [own for _, own in ones])
    assert carry.any()


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
