"""The vectorised residual of (12) against the literal reference, and its derivatives against differences."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand.random import BARE, EVERYTHING, SEQUENCES, Features
from mahovik.use.plan.forward import Chart, drive
from mahovik.use.plan.residual import linear, prescribe, residual, torques
from mahovik.use.plan.residual.by_carrier import by_carrier, slopes_of_residual
from mahovik.use.plan.residual.spatial import attitude
from plan.courses import literal, random_course

KINDS = [replace(EVERYTHING, angles=s) for s in SEQUENCES] + [BARE, Features(), Features()]


@pytest.mark.parametrize("number", range(12))
def test_residual_and_torque_are_those_of_the_reference(number: int) -> None:
    """(12) and the drive torque, on stands of all kinds, to rounding of what they are sums of."""
    stand, mechanics, motion = random_course(40 + number, 1 + number % 7, KINDS[number % len(KINDS)])
    at = prescribe(mechanics, motion.course)
    R = residual(at, *motion[3:])
    tau = torques(at, *motion[3:])
    for m in range(len(R)):
        expected, torque, size, largest = literal(stand, motion, m)
        assert abs(R[m] - expected).max() <= 1e-11 * size
        assert abs(tau[m] - torque).max() <= 1e-11 * max(largest, size)


@pytest.mark.parametrize("number", range(6))
def test_derivatives_are_those_of_differences(number: int) -> None:
    """Derivatives by angle, speed and acceleration are central differences up to rounding and the third derivative."""
    _, mechanics, motion = random_course(70 + number, 3, KINDS[number])
    at = prescribe(mechanics, motion.course)
    found = linear(at, *motion[3:])
    assert abs(found.R - residual(at, *motion[3:])).max() <= 1e-12 * abs(found.R).max()
    sizes = (1e-5, 1e-3, 1e-1)
    by = ("by_phi", "by_phi_dot", "by_phi_ddot")
    for argument, (step, name) in enumerate(zip(sizes, by, strict=True)):
        exact, exact_tau = getattr(found, name), getattr(found, "tau_" + name)
        for s in range(3):
            around = []
            for sign in (1.0, -1.0):
                moved = [x.copy() for x in motion[3:]]
                moved[argument][:, s] += sign * step
                around.append((residual(at, *moved), torques(at, *moved)))
            difference, difference_tau = ((a - b) / (2 * step) for a, b in zip(*around, strict=True))
            assert abs(exact[:, :, s] - difference).max() <= 1e-6 * max(abs(difference).max(), 1e-9)
            assert abs(exact_tau[:, s] - difference_tau[:, s]).max() <= 1e-6 * max(abs(exact_tau).max(), 1e-3)
            others = [k for k in range(3) if k != s]
            assert abs(difference_tau[:, others]).max() == 0.0


def test_bias_shifts_the_carrier() -> None:
    """A bias is added to q, one for all times or one each."""
    _, mechanics, motion = random_course(90, 2, EVERYTHING)
    bias = np.array([0.01, -0.02, 0.03, 0.1, -0.2, 0.05])
    shifted = motion._replace(q=motion.q + bias)
    expected = residual(prescribe(mechanics, shifted.course), *motion[3:])
    for given in (bias, np.tile(bias, (len(motion.q), 1))):
        assert np.array_equal(residual(prescribe(mechanics, motion.course, given), *motion[3:]), expected)


@pytest.mark.parametrize("number", range(6))
def test_slopes_by_the_carrier_from_sums_are_those_flywheel_by_flywheel(number: int) -> None:
    """With damping of flywheels, laws, a stream and gravity: to rounding of what they are sums of."""
    stand, mechanics, _ = random_course(110 + number, 1 + number, KINDS[number])
    rng = np.random.default_rng(number)
    y, V_dot = rng.normal(size=(3, 12)) * 0.3, rng.normal(size=(3, 6))
    phi, phi_dot = rng.normal(size=(3, 1 + number)), rng.normal(size=(3, 1 + number)) * 20
    chart = Chart(mechanics, rng.normal(size=3), attitude(stand.angles, rng.normal(size=3)))
    at = chart.twists(y)
    at = at._replace(V_r_dot=at.V_r_dot + V_dot)
    each = by_carrier(mechanics, at, phi, phi_dot)
    whole = slopes_of_residual(mechanics, at, drive(mechanics, phi, phi_dot, np.zeros_like(phi)))
    for found, expected in ((whole.by_pose, each.by_pose), (whole.by_twist, each.by_twist)):
        assert np.abs(found - expected).max() <= 1e-12 * np.abs(expected).max()
