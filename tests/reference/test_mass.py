"""Transfers, inertias and the matrices of (2)-(9) against clouds of points and derivatives along a motion."""

import numpy as np
import pytest

from mahovik.proof.reference import evaluate, pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.screw import Phi, f, spin
from physics.general import draw
from physics.motions import motion, rate

SEEDS = range(6)
STEP = 1e-3  # speeds of 20 rad/s
FROM_DIFFERENCES = 1e-10  # of the largest value: 1e-16 over the step, some hundred operations
ROUNDING = 1e-12


@pytest.mark.parametrize("seed", SEEDS)
def test_rates_of_transfer_K_and_momentum_are_derivatives_along_the_motion(seed: int) -> None:
    stand, state = draw(seed, 4)
    along, at = motion(stand, state), pieces(stand, state)

    def close(found: Array, expected: Array) -> None:
        np.testing.assert_allclose(found, expected, rtol=0, atol=FROM_DIFFERENCES * np.abs(expected).max())

    transfer_rates = rate(lambda t: np.array([s.L for s in pieces(stand, along(t)).flywheels]), STEP)
    for s, L_dot in zip(at.flywheels, transfer_rates, strict=True):  # Ls* = Ls [<e>] phi_s'
        close(s.L @ spin * s.phi_dot, L_dot)
    close(at.K_dot, rate(lambda t: pieces(stand, along(t)).K, STEP))  # (6)

    # (5), and J of (9) as what remains of Z* + Phi Z
    Z_dot = rate(lambda t: evaluate(stand, along(t), ["momentum"])["Z"], STEP)
    Z, V_dot, phi_ddot = evaluate(stand, state, ["momentum"])["Z"], np.array(state.V_dot), np.array(state.phi_ddot)
    squares = sum(s.L @ spin @ s.Theta @ f * s.phi_dot**2 for s in at.flywheels)
    close(at.K @ V_dot + at.K_dot @ at.V + at.I @ phi_ddot + squares, Z_dot)
    left = at.K @ V_dot + at.M @ at.V + at.I @ phi_ddot + at.J @ at.phi_dot
    close(left, Z_dot + Phi(at.V) @ Z)
