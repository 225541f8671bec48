"""Wrenches of (7): by hand, and by the potentials that some of them have."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.laws.damping.data import Damping, DampingTerm, Factor
from mahovik.laws.damping.reference import damping_terms, linear_damping, quadratic_damping
from mahovik.laws.leg.data import legs_of
from mahovik.proof.reference import pieces
from mahovik.proof.reference.array import Array
from physics.general import draw, rows, suspension_of
from physics.motions import motion, rate, rotation

SEEDS = range(6)
STEP = 1e-3  # speeds of 20 rad/s
FROM_DIFFERENCES = 1e-10  # of the largest value: 1e-16 over the step
ROUNDING = 1e-12


def test_damping_by_hand() -> None:
    V_r = np.array([1.0, -2.0, 3.0, -0.5, 0.0, 2.0])
    matrix = np.arange(36.0).reshape(6, 6)
    terms = (
        DampingTerm(1, (Factor(0, False), Factor(5, False)), -3.1),  # Y += -3.1 u r
        DampingTerm(5, (Factor(5, False), Factor(1, True)), -4.2),  # N += -4.2 r |v|
        DampingTerm(5, (Factor(1, True), Factor(1, True)), 0.5),  # N += 0.5 |v| |v|
    )
    damping = Damping(rows(matrix), rows(matrix.T), terms)
    np.testing.assert_allclose(linear_damping(damping, V_r), -matrix @ V_r, rtol=ROUNDING)
    squares = np.array([1.0, -4.0, 9.0, -0.25, 0.0, 4.0])
    np.testing.assert_allclose(quadratic_damping(damping, V_r), -matrix.T @ squares, rtol=ROUNDING)
    expected = [0, -3.1 * 1.0 * 2.0, 0, 0, 0, -4.2 * 2.0 * 2.0 + 0.5 * 4.0]
    np.testing.assert_allclose(damping_terms(damping, V_r), expected, rtol=ROUNDING)


@pytest.mark.parametrize("seed", SEEDS)
def test_suspension_by_hand(seed: int) -> None:
    stand, state = draw(seed, 1, stream=True)
    suspension = suspension_of(stand)
    C = rotation(stand, state)
    C_eq = rotation(stand, replace(state, angles=suspension.angles, quaternion=None))
    shift = C.T @ (np.array(state.position) - np.array(suspension.position))
    x = [*shift, *Rotation.from_matrix(C_eq.T @ C).as_rotvec()]
    expected = -np.array(suspension.stiffness) @ x - np.array(suspension.damping) @ np.array(state.V)  # not V_r
    np.testing.assert_allclose(pieces(stand, state).terms["carrier"]["suspension"], expected, rtol=0, atol=1e-11)


@pytest.mark.parametrize("seed", SEEDS)
def test_legs_store_energy_in_springs_and_lose_it_along_themselves(seed: int) -> None:
    stand, state = draw(seed, 1, stream=True)  # legs stand in E0: they feel V, not V_r

    def lengths(t: float) -> Array:
        now = motion(stand, state)(t)
        ends = [np.array(now.position) + rotation(stand, now) @ np.array(leg.carrier) for leg in legs_of(stand)]
        return np.array([np.linalg.norm(e - leg.ground) for e, leg in zip(ends, legs_of(stand), strict=True)])

    at, length_rates = pieces(stand, state), rate(lengths, STEP)
    for number, leg in enumerate(legs_of(stand)):
        P = at.terms["carrier"][f"leg {number}"]
        tension = leg.stiffness * (lengths(0.0)[number] - leg.length) + leg.damping * length_rates[number]
        assert np.linalg.norm(P[:3]) == pytest.approx(abs(tension), rel=1e-9)  # rate by differences
        assert pytest.approx(-tension * length_rates[number], rel=1e-9) == P @ at.V
        assert P[3:] @ P[:3] == pytest.approx(0.0, abs=1e-10)  # a pure force
