"""Wrenches of (7) by hand and by energy, rotations by SciPy; what both derivations refuse at a state."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.stand.law import Velocity
from mahovik.core.stand.model import MountingAngles, MountingAxes, Sequence, Stand, rest_state
from mahovik.core.stand.model import Sequence as AngleSequence
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.errors import StateError
from mahovik.laws.damping.law import Damping, DampingTerm
from mahovik.laws.damping.reference import damping_terms, linear_damping, quadratic_damping
from mahovik.laws.leg.law import Leg, Legs, legs_of
from mahovik.proof import reference
from mahovik.proof.reference import pieces
from mahovik.proof.reference.algebra import C1, attitude, carrier_rotation, flywheel_mounting, rotation_vector
from physics.general import draw, rows, suspension_of
from physics.motions import SEQUENCES, rotation
from second.agreement import evaluate

SEEDS = range(6)
ROUNDING = 1e-12
OF_ROTATIONS = 1e-14  # products of three rotations


def test_damping_by_hand() -> None:
    V_r = np.array([1.0, -2.0, 3.0, -0.5, 0.0, 2.0])
    matrix = np.arange(36.0).reshape(6, 6)
    terms = (
        DampingTerm(1, (Velocity(0, False), Velocity(5, False)), -3.1),  # Y += -3.1 u r
        DampingTerm(5, (Velocity(5, False), Velocity(1, True)), -4.2),  # N += -4.2 r |v|
        DampingTerm(5, (Velocity(1, True), Velocity(1, True)), 0.5),  # N += 0.5 |v| |v|
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


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_attitude_is_scipys_rotation_about_moving_axes(sequence: Sequence) -> None:
    for angles in np.random.default_rng(1).uniform(-3, 3, (20, 3)):
        expected = Rotation.from_euler(SEQUENCES[sequence], angles).as_matrix()
        np.testing.assert_allclose(attitude(sequence, *angles), expected, rtol=0, atol=OF_ROTATIONS)


def test_quaternion_and_its_negative_are_one_attitude_w_first() -> None:
    stand, state = draw(1, 1)
    q = np.array([0.5, -0.1, 0.7, 0.3])
    q /= np.linalg.norm(q)
    for sign in (1, -1):
        turned = replace(state, angles=None, quaternion=tuple(sign * q))
        expected = Rotation.from_quat([*q[1:], q[0]]).as_matrix()
        np.testing.assert_allclose(carrier_rotation(stand, turned), expected, rtol=0, atol=OF_ROTATIONS)


@pytest.mark.parametrize("length", [0.0, 1e-200, 1e-12, 1e-5, 1.0, 3.0, math.pi - 1e-9])
def test_rotation_vector_is_the_one_it_was_made_of(length: float) -> None:
    for axis in np.random.default_rng(2).normal(size=(10, 3)):
        vector = length * axis / np.linalg.norm(axis)
        recovered = rotation_vector(Rotation.from_rotvec(vector).as_matrix())
        np.testing.assert_allclose(recovered, vector, rtol=0, atol=1e-15 + 4 * OF_ROTATIONS * length)


def test_mounting_by_axes_equals_mounting_by_the_angles_of_those_axes() -> None:
    stand, _ = draw(1, 1)
    by_angles = replace(stand.flywheels[0], mounting=MountingAngles(0.3, -0.8, 1.1))
    C = Rotation.from_euler("ZYX", [0.3, -0.8, 1.1]).as_matrix()
    axis, zero = 3.0 * C[:, 0], 0.2 * C[:, 1] - 5.0 * C[:, 0]  # any length; only the part across counts
    by_axes = replace(stand.flywheels[0], mounting=MountingAxes(tuple(axis), tuple(zero)))
    for phi in (0.0, 0.9, -2.0):
        expected = Rotation.from_euler("ZYX", [0.3, -0.8, 1.1 + phi]).as_matrix()
        np.testing.assert_allclose(flywheel_mounting(by_angles) @ C1(phi), expected, rtol=0, atol=OF_ROTATIONS)
        # zero is 25 times longer along the axis than across: 25 roundings
        np.testing.assert_allclose(flywheel_mounting(by_axes) @ C1(phi), expected, rtol=0, atol=25 * OF_ROTATIONS)


# -- refusals ----------------------------------------------------------------------------------------------------------

FAST = (1e200, 0.0, 0.0, 1e200, 1e200, 0.0)
TURNED = {"angles": None, "quaternion": (1.0, 0.0, 0.0, 0.0)}
REFUSED: list[tuple[dict[str, Any], list[str], str]] = [
    ({}, [], "empty"),
    ({}, ["forwards"], r"forwards"),
    ({}, ["forward", "coupled"], "both give V_dot"),
    (TURNED, ["generalized"], "needs `angles`"),
    *(({"V": FAST}, [want], "not finite") for want in ("momentum", "forward", "torque", "coupled", "points")),
]


@pytest.fixture(params=["reference", "second"])
def derivation(request: pytest.FixtureRequest) -> Any:
    """`evaluate(stand, state, want)` of a derivation."""
    return reference.evaluate if request.param == "reference" else evaluate


@pytest.mark.parametrize(("change", "want", "words"), REFUSED)
def test_refused(change: dict[str, Any], want: list[str], words: str, derivation: Any) -> None:
    stand, state = draw(1, 2)
    with pytest.raises(StateError, match=words):
        derivation(stand, replace(state, **change), want)


@pytest.mark.parametrize(
    ("change", "want", "words"),
    [
        ({}, "mounts", "second derivation .* has no 'mounts'"),
        ({}, "inverse", "second derivation .* has no 'inverse'"),
    ],
)
def test_refused_by_the_second_derivation(change: dict[str, Any], want: str, words: str) -> None:
    stand, state = draw(1, 2)
    with pytest.raises(StateError, match=words):
        evaluate(stand, replace(state, **change), [want])


@pytest.mark.parametrize(("angles", "theta"), [("ship", np.pi / 2), ("aircraft", -np.pi / 2), ("euler", np.pi)])
def test_singular_attitudes_are_refused_for_generalized_alone(
    angles: AngleSequence, theta: float, derivation: Any
) -> None:
    stand, state = draw(1, 2)
    stand = replace(stand, angles=angles)
    at, beside = (replace(state, angles=(0.1, theta + off, 0.2)) for off in (1e-7, 2e-6))
    with pytest.raises(StateError, match="singular attitude of the"):
        derivation(stand, at, ["generalized"])
    assert np.isfinite(derivation(stand, at, ["forward"])["V_dot"]).all()
    assert np.isfinite(derivation(stand, beside, ["generalized"])["q_ddot"]).all()


def test_left_out_angles_are_zero(derivation: Any) -> None:
    stand, state = draw(1, 2)
    stated, left_out = replace(state, angles=(0.0, 0.0, 0.0)), replace(state, angles=None)
    for angles in ("ship", "aircraft"):
        same = replace(stand, angles=angles)
        expected = derivation(same, stated, ["generalized"])["q_ddot"]
        np.testing.assert_array_equal(derivation(same, left_out, ["generalized"])["q_ddot"], expected)
    with pytest.raises(StateError, match="singular attitude"):
        derivation(replace(stand, angles="euler"), left_out, ["generalized"])


def leg_of(stand: Stand, length: float) -> Stand:
    """The stand with a leg of this length where the carrier is at (1, 2, 3)."""
    leg: Leg = replace(legs_of(stand)[0], ground=(1.0, 2.0, 3.0 + length), carrier=(0.0, 0.0, 0.0))
    return stand.with_laws(Legs((legs_of(stand)[1], leg)))


@pytest.mark.parametrize("want", ["forward", "torque", "coupled"])
def test_a_leg_without_length_is_refused(want: str, derivation: Any) -> None:
    stand, state = draw(1, 2)
    state = replace(state, position=(1.0, 2.0, 3.0))
    with pytest.raises(StateError, match="leg"):
        derivation(leg_of(stand, 5e-10), state, [want])
    assert derivation(leg_of(stand, 5e-9), state, [want])


def test_a_stand_without_mass_has_no_mass_centre(derivation: Any) -> None:
    stand, state = draw(1, 0, instruments=0)
    weightless = replace(stand, carrier=replace(stand.carrier, mass=0.0, inertia_about="origin"))
    with pytest.raises(StateError, match=r"center_of_mass|no body of the stand has a mass"):
        derivation(weightless, state, ["momentum"])
    assert np.isfinite(derivation(weightless, state, ["forward"])["V_dot"]).all()


def test_a_stand_without_points_has_none(derivation: Any) -> None:
    stand = replace(random_stand(np.random.default_rng(1), 1, EVERYTHING), instruments=(), points=())
    stand = replace(stand, flywheels=tuple(replace(s, mount="carrier") for s in stand.flywheels))
    assert derivation(stand, rest_state(stand), ["points"]) == {"points": {}}
