"""Limits in which the equations become others that are known."""

from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Flywheel, Instrument, MountingAngles, Stand, State
from mahovik.proof.reference import evaluate, pieces
from mahovik.proof.reference.algebra import Array
from physics.general import isolated, rows, without_added_mass
from physics.motions import cross, rotation, vec
from physics.properties import PROPERTY, assert_near, cases, scale, value


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


@PROPERTY
@given(case=cases(stream=False))
def test_gyrostat_splits_into_translation_and_eulers_equation(case: tuple[Stand, State]) -> None:
    """Flywheels are balanced and symmetric, O1 is at the centre of mass, nothing is added; run-time wrenches act."""
    stand, state = case
    stand = about_center_of_mass(balanced(without_added_mass(isolated(stand))), state)
    at, V_dot = pieces(stand, state), value(stand, state, "forward", "V_dot")
    size = np.abs(at.K) @ scale(stand, state, "forward")["V_dot"]
    v, omega = np.split(at.V, 2)
    m = sum(body.mass for body in stand.bodies)
    assert_near(m * (V_dot[:3] + np.cross(omega, v)), at.F[:3], size[:3])

    # J omega' + h' + omega x (J omega + h) = moment, h = sum of J11 phi' along the spin axes
    h, h_dot = np.zeros(3), np.zeros(3)
    for s, phi_dot, phi_ddot in zip(stand.flywheels, state.phi_dot, state.phi_ddot, strict=True):
        axis = spin_axis(s)
        h, h_dot = h + s.inertia[0][0] * phi_dot * axis, h_dot + s.inertia[0][0] * phi_ddot * axis
    J = at.K[3:, 3:]
    assert_near(J @ V_dot[3:] + h_dot + np.cross(omega, J @ omega + h), at.F[3:], size[3:])


def solid(seed: int) -> tuple[Instrument, Array]:
    """A weightless rigid body, and its spatial inertia about O1 in E1."""
    rng = np.random.default_rng(seed)
    m, rc, O, angles = rng.uniform(0.2, 2.0), *rng.uniform(-0.3, 0.3, (2, 3)), rng.uniform(-1.2, 1.2, 3)
    a, b, c = rng.uniform(0.01, 0.1, 3)
    central, C = np.diag([b + c, a + c, a + b]), Rotation.from_euler("ZYX", angles).as_matrix()
    r = O + C @ rc
    J1 = C @ central @ C.T - m * cross(r) @ cross(r)
    Lambda = np.block([[m * np.eye(3), -m * cross(r)], [m * cross(r), J1]])
    body = Instrument(
        name="fluid",
        mass=float(m),
        center_of_mass=vec(rc),
        inertia=rows(central),
        inertia_about="center_of_mass",
        wrench_input=True,
        position=vec(O),
        angles=vec(angles),
        added_mass=None,
    )
    return body, (Lambda + Lambda.T) / 2


@PROPERTY
@given(case=cases(stream=False), seed=st.integers(0, 2**16), on_instrument=st.booleans())
def test_added_mass_of_the_form_of_a_body_acts_as_that_body(
    case: tuple[Stand, State], seed: int, on_instrument: bool
) -> None:
    """A wrench cancels the body's weight. An instrument's added mass is about O1 in E1 as well."""
    stand, state = case
    stand = without_added_mass(stand)
    body, Lambda = solid(seed)
    if on_instrument and stand.instruments:
        first, *rest = stand.instruments
        fluid = replace(stand, instruments=(replace(first, added_mass=rows(Lambda)), *rest))
    else:
        fluid = replace(stand, carrier=replace(stand.carrier, added_mass=rows(Lambda)))
    solid_stand = replace(stand, instruments=(*stand.instruments, body))
    weight = body.mass * (rotation(stand, state) @ Rotation.from_euler("ZYX", body.angles).as_matrix()).T
    cancel = -weight @ np.array(stand.gravity)
    lift = {"fluid": vec([*cancel, *np.cross(body.center_of_mass, cancel)])}
    lifted = replace(state, wrench={**state.wrench, **lift})
    for want in ("matrices", "forward", "torque", "coupled"):
        size, expected = scale(solid_stand, lifted, want), evaluate(solid_stand, lifted, [want])
        for name, actual in evaluate(fluid, state, [want]).items():
            assert_near(actual, expected[name], size[name])
    for name in ("Z", "Z0", "energy"):
        expected = value(solid_stand, lifted, "momentum", name)
        assert_near(value(fluid, state, "momentum", name), expected, scale(solid_stand, lifted, "momentum")[name])
    centers = [value(*case, "momentum", "center_of_mass") for case in ((solid_stand, lifted), (fluid, state))]
    assert np.abs(centers[0] - centers[1]).max() > 1e-6  # the fluid is no body
