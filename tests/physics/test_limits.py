"""Limits in which the equations become others that are known."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Instrument, MountingAngles, Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import evaluate, pieces
from physics.general import draw, isolated, rows, without_added_mass, without_wrench
from physics.motions import cross, rotation, vec

SEEDS = range(6)
ROUNDING = 1e-11  # some hundred operations, condition of K below 1e3


def balanced(stand: Stand):
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


def about_center_of_mass(stand: Stand, state: State):
    """The stand with its carrier's centre of mass moved so that O1 is the centre of mass of the whole system."""
    m = sum(body.mass for body in stand.bodies)
    rc = np.array(evaluate(stand, state, ["momentum"])["center_of_mass"])
    moved = np.array(stand.carrier.center_of_mass) - m * rc / stand.carrier.mass
    carrier = replace(stand.carrier, center_of_mass=vec(moved), inertia_about="center_of_mass")
    return replace(stand, carrier=carrier)


@pytest.mark.parametrize("seed", SEEDS)
def test_gyrostat_splits_into_translation_and_eulers_equation(seed: int) -> None:
    stand, state = draw(seed, 4)
    stand = balanced(without_added_mass(isolated(stand)))
    stand = about_center_of_mass(stand, state)
    V_dot = evaluate(stand, state, ["forward"])["V_dot"]
    at = pieces(stand, state)
    force, moment = at.F[:3], at.F[3:]  # of run-time wrenches
    v, omega = at.V[:3], at.V[3:]
    m = sum(body.mass for body in stand.bodies)
    np.testing.assert_allclose(m * (V_dot[:3] + np.cross(omega, v)), force, rtol=0, atol=ROUNDING * 1e2)

    # J omega' + a h' + omega x (J omega + a h) = moment, h = J11 phi' along the spin axes a
    J = at.K[3:, 3:]
    h, h_dot = np.zeros(3), np.zeros(3)
    for s, phi_dot, phi_ddot in zip(stand.flywheels, state.phi_dot, state.phi_ddot, strict=True):
        axis = Rotation.from_euler("ZY", [s.mounting.psi, s.mounting.theta]).apply([1, 0, 0])
        h += s.inertia[0][0] * phi_dot * axis
        h_dot += s.inertia[0][0] * phi_ddot * axis
    euler = J @ V_dot[3:] + h_dot + np.cross(omega, J @ omega + h)
    np.testing.assert_allclose(euler, moment, rtol=0, atol=ROUNDING * 1e2)


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
def test_locked_flywheel_is_one_more_rigid_body(seed: int) -> None:
    stand, state = draw(seed, 4)
    *others, last = stand.flywheels
    last = replace(last, mount="carrier", mounting=MountingAngles(0.7, -0.3, 0.4))
    stand = replace(stand, flywheels=(*others, last))
    N = len(others)
    state = replace(state, phi_dot=(*state.phi_dot[:N], 0.0), phi_ddot=(*state.phi_ddot[:N], 0.0))

    fields = ("name", "mass", "center_of_mass", "inertia", "inertia_about", "buoyancy", "damping", "wrench_input")
    body = Instrument(
        **{name: getattr(last, name) for name in fields},
        position=last.position,
        angles=(0.7, -0.3, 0.4 + state.phi[-1]),
        added_mass=None,
    )
    rigid = replace(stand, instruments=(*stand.instruments, body), flywheels=tuple(others))
    kept = {name: getattr(state, name)[:N] for name in ("phi", "phi_dot", "phi_ddot", "tau")}
    want = ["momentum", "forward"]
    expected, found = evaluate(rigid, replace(state, **kept), want), evaluate(stand, state, want)
    for name, value in expected.items():
        np.testing.assert_allclose(found[name], value, rtol=1e-12, atol=ROUNDING * np.abs(value).max())


@pytest.mark.parametrize("seed", SEEDS)
def test_added_mass_of_a_rigid_body_acts_as_a_weightless_body(seed: int) -> None:
    """About O1 in E1, for an instrument's added mass as well; K, motion, momentum and torque are those of the body."""
    stand, state = draw(seed, 4)
    stand = without_added_mass(stand)
    mass, rc, O = 1.3, np.array([0.1, -0.2, 0.05]), np.array([0.3, 0.1, -0.2])
    J = np.diag([0.05, 0.06, 0.07]) - mass * cross(rc) @ cross(rc)
    C = Rotation.from_euler("ZYX", [0.4, -0.9, 0.3]).as_matrix()
    # the same body about O1 in E1
    r = O + C @ rc
    J1 = C @ np.diag([0.05, 0.06, 0.07]) @ C.T - mass * cross(r) @ cross(r)
    Lambda = np.block([[mass * np.eye(3), -mass * cross(r)], [mass * cross(r), J1]])
    fluid = replace(stand, instruments=(replace(stand.instruments[0], added_mass=rows(Lambda)), *stand.instruments[1:]))
    weightless = Instrument(
        name="fluid",
        mass=mass,
        center_of_mass=vec(rc),
        inertia=rows(J),
        inertia_about="origin",
        buoyancy=None,
        damping=None,
        wrench_input=True,
        position=vec(O),
        angles=(0.4, -0.9, 0.3),
        added_mass=None,
    )
    body = replace(stand, instruments=(*stand.instruments, weightless))
    cancel = -mass * (C.T @ rotation(stand, state).T @ np.array(stand.gravity))
    lifted = replace(state, wrench={**state.wrench, "fluid": vec([*cancel, *np.cross(rc, cancel)])})
    for want in ("matrices", "forward", "torque", "coupled"):
        expected, found = evaluate(body, lifted, [want]), evaluate(fluid, state, [want])
        for name, value in expected.items():
            np.testing.assert_allclose(found[name], value, rtol=1e-11, atol=ROUNDING * np.abs(value).max())
    expected, found = (evaluate(*case, ["momentum"]) for case in ((body, lifted), (fluid, state)))
    for name in ("Z", "Z0", "energy"):
        np.testing.assert_allclose(found[name], expected[name], rtol=1e-11, atol=1e-11)
    assert np.abs(found["center_of_mass"] - expected["center_of_mass"]).max() > 1e-3  # fluid is no body


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
