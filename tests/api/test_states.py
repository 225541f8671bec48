"""States: made, written and read by name; arrays are views of the memory that the C reads."""

import pickle

import numpy as np
import pytest

import mahovik
from api.models import model
from mahovik.contract.status import STATUS_VALUES


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


def test_some_of_many() -> None:
    x = model("bench8").states(phi=np.arange(40.0).reshape(5, 8))
    assert x.take(2).batch is None and np.array_equal(x.take(2).phi, x.phi[2])
    assert np.array_equal(x.take([4, 0]).phi, x.phi[[4, 0]])
    assert np.array_equal(x.take(x.phi[:, 0] > 10).phi, x.phi[2:])
    assert np.array_equal(x.take(slice(1, 3)).array, x.array[1:3])
    with pytest.raises(mahovik.InputError, match="out of bounds"):
        x.take(5)


def test_no_states_at_all() -> None:
    m = model("bench8")
    result = m.forward(m.states(0), np.zeros((0, 8)))
    assert result.V_dot.shape == (0, 6) and result.status.shape == (0,)
    assert m.matrices(m.states(0)).I.shape == (0, 6, 8)
    assert m.mounts(m.states(0)).mount_wrench.shape == (0, 8, 6)


@pytest.mark.slow
def test_a_rigid_body_has_no_flywheels() -> None:
    m = model("rigid")
    x = m.states(2, V=[1, 2, 3, 4, 5, 6])
    assert x.phi.shape == (2, 0) and x.array.shape == (2, 13)
    assert m.forward(x).V_dot.shape == (2, 6) and m.matrices(x).I.shape == (2, 6, 0)
    with pytest.raises(mahovik.InputError, match='phi_ddot: no flywheel "w1": there is none'):
        m.forward(x, {"w1": 1.0})


@pytest.mark.slow
def test_inverse_of_a_rigid_body_says_what_wrench_is_missing() -> None:
    m = model("rigid")
    x = m.states(2, V=[1, 2, 3, 4, 5, 6])
    free = m.forward(x).V_dot
    more = np.array([0.5, 0.0, 0.0, 0.0, 0.25, 0.0])
    found = m.inverse(x, free + more)
    K = m.matrices(x).K[0]
    np.testing.assert_allclose(found.residual, -np.tile(K @ more, (2, 1)), rtol=1e-9, atol=1e-12)
    assert found.phi_ddot.shape == found.sigma.shape == found.limited.shape == (2, 0)
    assert list(found.status) == [STATUS_VALUES["UNREACHABLE"]] * 2 and list(found.rank) == [0, 0]
    np.testing.assert_allclose(found.hardest[0] @ np.linalg.solve(K, found.hardest[0]), 1.0, rtol=1e-12)
    with pytest.raises(mahovik.InputError, match="weight"):
        m.inverse(x, free, weight={"w1": 2.0})


def test_states_and_results_can_be_pickled() -> None:
    m = model("bench8")
    x = m.states(2, V=np.eye(6)[:2])
    y = pickle.loads(pickle.dumps(x))
    assert np.array_equal(m.forward(y).V_dot, m.forward(x).V_dot)
    result = pickle.loads(pickle.dumps(m.forward(x)))
    assert np.array_equal(result["V_dot", "w"], m.forward(x).V_dot[:, 2])
