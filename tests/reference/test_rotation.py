"""Rotations against SciPy and against derivatives along a motion."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import MountingAngles, MountingAxes, Sequence
from mahovik.proof.reference.rotation import (
    C1,
    attitude,
    carrier_rotation,
    flywheel_mounting,
    rotation_vector,
)
from physics.general import draw
from physics.motions import SEQUENCES

ROUNDING = 1e-14  # products of three rotations
STEP = 1e-2  # rates near 1 rad/s
FROM_DIFFERENCES = 1e-12  # 1e-16 over the step; 0.01^8 is less


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_attitude_is_scipys_rotation_about_moving_axes(sequence: Sequence) -> None:
    for angles in np.random.default_rng(1).uniform(-3, 3, (20, 3)):
        expected = Rotation.from_euler(SEQUENCES[sequence], angles).as_matrix()
        np.testing.assert_allclose(attitude(sequence, *angles), expected, rtol=0, atol=ROUNDING)


def test_quaternion_and_its_negative_are_one_attitude_w_first() -> None:
    stand, state = draw(1, 1)
    q = np.array([0.5, -0.1, 0.7, 0.3])
    q /= np.linalg.norm(q)
    for sign in (1, -1):
        turned = replace(state, angles=None, quaternion=tuple(sign * q))
        expected = Rotation.from_quat([*q[1:], q[0]]).as_matrix()
        np.testing.assert_allclose(carrier_rotation(stand, turned), expected, rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("length", [0.0, 1e-200, 1e-12, 1e-5, 1.0, 3.0, math.pi - 1e-9])
def test_rotation_vector_is_the_one_it_was_made_of(length: float) -> None:
    for axis in np.random.default_rng(2).normal(size=(10, 3)):
        vector = length * axis / np.linalg.norm(axis)
        found = rotation_vector(Rotation.from_rotvec(vector).as_matrix())
        np.testing.assert_allclose(found, vector, rtol=0, atol=1e-15 + 4 * ROUNDING * length)


def test_mounting_by_axes_equals_mounting_by_the_angles_of_those_axes() -> None:
    stand, _ = draw(1, 1)
    by_angles = replace(stand.flywheels[0], mounting=MountingAngles(0.3, -0.8, 1.1))
    C = Rotation.from_euler("ZYX", [0.3, -0.8, 1.1]).as_matrix()
    axis, zero = 3.0 * C[:, 0], 0.2 * C[:, 1] - 5.0 * C[:, 0]  # any length; only the part across counts
    by_axes = replace(stand.flywheels[0], mounting=MountingAxes(tuple(axis), tuple(zero)))
    for phi in (0.0, 0.9, -2.0):
        expected = Rotation.from_euler("ZYX", [0.3, -0.8, 1.1 + phi]).as_matrix()
        np.testing.assert_allclose(flywheel_mounting(by_angles) @ C1(phi), expected, rtol=0, atol=ROUNDING)
        # zero is 25 times longer along the axis than across: 25 roundings
        np.testing.assert_allclose(flywheel_mounting(by_axes) @ C1(phi), expected, rtol=0, atol=25 * ROUNDING)
