"""States: made, written and read by name, as views of the memory that the C reads; steps with a carry."""

from typing import Any

import numpy as np
import pytest

import mahovik
from api.models import model
from mahovik.errors import InputError


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
