"""Limits in which the equations become others that are known."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Flywheel, MountingAngles, Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import evaluate
from mahovik.proof.reference.array import Array
from physics.general import draw, isolated, rows, without_added_mass, without_wrench
from physics.motions import cross, vec

SEEDS = range(6)
ROUNDING = 1e-11  # some hundred operations, condition of K below 1e3


def balanced(stand: Stand) -> Stand:
    """Every flywheel on the carrier, centre of mass at its origin, J22 = J33, no products; angles, not axes."""
    flywheels = []
    for number, s in enumerate(stand.flywheels):
        J = (0.004 + 0.001 * number, 0.003, 0.003)
        flywheels.append(
            replace(
                s,
                mount="carrier",
                center_of_mass=(0.0, 0.0, 0.0),
                inertia=rows(np.diag(J)),
                inertia_about="origin",
                mounting=MountingAngles(0.3 + number, -0.4 * number, 0.2),
            )
        )
    return replace(stand, flywheels=tuple(flywheels))


def spin_axis(flywheel: Flywheel) -> Array:
    """Direction of the spin axis (3) of a flywheel mounted by angles, in its mount."""
    assert isinstance(flywheel.mounting, MountingAngles)
    return np.asarray(Rotation.from_euler("ZY", [flywheel.mounting.psi, flywheel.mounting.theta]).apply([1, 0, 0]))


def about_center_of_mass(stand: Stand, state: State) -> Stand:
    """The stand with its carrier's centre of mass moved so that O1 is the centre of mass of the whole system."""
    m = sum(body.mass for body in stand.bodies)
    rc = np.array(evaluate(stand, state, ["momentum"])["center_of_mass"])
    moved = np.array(stand.carrier.center_of_mass) - m * rc / stand.carrier.mass
    carrier = replace(stand.carrier, center_of_mass=vec(moved), inertia_about="center_of_mass")
    return replace(stand, carrier=carrier)


@pytest.mark.parametrize("seed", SEEDS)
def test_unbalance_couples_translation_and_rotation(seed: int) -> None:
    stand, state = draw(seed, 4)
    stand = about_center_of_mass(balanced(without_added_mass(isolated(stand))), state)
    tilted = replace(stand.flywheels[0], center_of_mass=(0.0, 0.01, 0.0))
    unbalanced = replace(stand, flywheels=(tilted, *stand.flywheels[1:]))
    K, I = (evaluate(unbalanced, state, ["matrices"])[name] for name in "KI")
    assert np.abs(K[:3, 3:]).max() > 1e-4
    assert np.abs(I[:3, 0]).max() > 1e-3
    assert np.abs(I[:3, 1:]).max() < ROUNDING


@pytest.mark.parametrize("seed", SEEDS)
def test_stand_without_flywheels_is_a_rigid_body(seed: int) -> None:
    stand, state = draw(seed, 0, instruments=0, added=False)
    state = without_wrench(state)
    stand = isolated(stand)
    V_dot = evaluate(stand, state, ["forward"])["V_dot"]
    body, (v, omega) = stand.carrier, np.split(np.array(state.V), 2)
    rc, J = np.array(body.center_of_mass), np.array(body.inertia)
    if body.inertia_about == "origin":
        J = J + body.mass * cross(rc) @ cross(rc)
    # free rigid body: the centre of mass goes straight, J omega' + omega x J omega = 0 about it
    omega_dot = -np.linalg.solve(J, np.cross(omega, J @ omega))
    v_dot = -np.cross(omega, v) - np.cross(omega_dot, rc) - np.cross(omega, np.cross(omega, rc))
    np.testing.assert_allclose(V_dot, [*v_dot, *omega_dot], rtol=0, atol=ROUNDING * np.abs(V_dot).max())
