"""A judge that knows no matrix of the model: bodies are clouds of point masses, and Newton's law holds for each.

A cloud is moved through E0 by SciPy's rotations along a motion with V* of (8); accelerations of its points are
second differences of their positions. Sums of m r'' must be sums of the forces on the points.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Flywheel, MountingAxes, Stand, State, Vec3
from mahovik.proof.reference import evaluate
from mahovik.proof.reference.algebra import Array
from physics.general import AnyBody, draw, rows, without_added_mass
from physics.motions import motion, rotation, second_rate, vec

Clouds = dict[str, tuple[Array, Array]]
"""Masses (N) and places (Nx3) of the points of each body, by its name."""

Frame = tuple[Array, Array]
"""Origin (3) and axes (3x3) of a frame."""

SEEDS = range(6)
POINTS = 7  # enough for a general tensor of inertia
STEP = 5e-3  # times 20 rad/s is 0.1: 0.1^8 / 3150 and 1e-16 / STEP^2 are both below 1e-11
DIFFERENCES = 1e-9  # of the largest force: some ten points, largest m r'' 1e2


def clouds(stand: Stand, seed: int) -> tuple[Stand, Clouds]:
    """The stand with each body's mass data made of a cloud of points; the clouds by body name: masses, places."""
    rng = np.random.default_rng(seed)
    made: Clouds = {}
    stand = without_added_mass(stand)

    def body(b: AnyBody, size: float) -> AnyBody:
        m, x = rng.uniform(0.05, 0.2, POINTS), rng.normal(size=(POINTS, 3)) * size
        made[b.name] = (m, x)
        J = sum(mi * (xi @ xi * np.eye(3) - np.outer(xi, xi)) for mi, xi in zip(m, x, strict=True))
        return replace(
            b,
            mass=float(m.sum()),
            center_of_mass=vec(m @ x / m.sum()),
            inertia=rows(J),
            inertia_about="origin",
            laws=(),
        )

    stand = replace(
        stand,
        carrier=body(stand.carrier, 0.5),
        instruments=tuple(body(p, 0.2) for p in stand.instruments),
        flywheels=tuple(body(s, 0.1) for s in stand.flywheels),
    )
    return stand, made


def frame_in(stand: Stand, name: str, position: Vec3, matrix: Array) -> Frame:
    """A frame given in its mount (name), carried to E1: origin, axes."""
    if name == "carrier":
        return np.array(position), matrix
    p = next(p for p in stand.instruments if p.name == name)
    C = Rotation.from_euler("ZYX", p.angles).as_matrix()
    return np.array(p.position) + C @ np.array(position), C @ matrix


def flywheel_frame(stand: Stand, s: Flywheel, phi: float) -> Frame:
    """Origin and axes of a flywheel in E1, by SciPy."""
    m = s.mounting
    if isinstance(m, MountingAxes):
        basis, _ = np.linalg.qr(np.column_stack([m.axis, m.zero]))
        basis = basis * np.sign(np.sum(basis * np.column_stack([m.axis, m.zero]), axis=0))
        C = np.column_stack([basis, np.cross(basis[:, 0], basis[:, 1])])
        C = C @ Rotation.from_euler("X", phi).as_matrix()
    else:
        C = Rotation.from_euler("ZYX", [m.psi, m.theta, m.zero + phi]).as_matrix()
    return frame_in(stand, s.mount, s.position, C)


def frames_in_E0(stand: Stand, state: State) -> dict[str, Frame]:
    """Origin and axes in E0 of every body by name."""
    C, O1 = rotation(stand, state), np.array(state.position)
    frames = {"carrier": (np.zeros(3), np.eye(3))}
    for p in stand.instruments:
        frames[p.name] = frame_in(stand, p.name, (0.0, 0.0, 0.0), np.eye(3))
    for s, phi in zip(stand.flywheels, state.phi, strict=True):
        frames[s.name] = flywheel_frame(stand, s, phi)
    return {name: (O1 + C @ O, C @ R) for name, (O, R) in frames.items()}


def places(stand: Stand, made: Clouds, state: State) -> dict[str, Array]:
    """All points in E0 by body name, Nx3."""
    return {name: O + made[name][1] @ R.T for name, (O, R) in frames_in_E0(stand, state).items()}


def newton(stand: Stand, made: Clouds, state: State, step: float = STEP) -> dict[str, Array]:
    """m r'' - m g of every point in E0, Nx3 by body name: the force that all else must exert on it."""
    at = motion(stand, state)
    accelerations = {}
    for name, (m, _) in made.items():

        def cloud(t: float, name: str = name) -> Array:
            return places(stand, made, at(t))[name]

        accelerations[name] = m[:, None] * (second_rate(cloud, step) - np.array(stand.gravity))
    return accelerations


def random_clouds(seed: int) -> tuple[Stand, Clouds, State]:
    """A stand of clouds, the clouds, and a state with V* by (8)."""
    stand, state = draw(seed, 3, instruments=1)
    stand, made = clouds(stand.without_laws(), seed)
    state = replace(state, V_dot=vec(evaluate(stand, state, ["forward"])["V_dot"]))
    return stand, made, state


@pytest.mark.parametrize("seed", SEEDS)
def test_forward_gives_every_point_its_newtonian_acceleration(seed: int) -> None:
    """Force and moment about the origin of E0, all points, against the run-time wrenches carried there by hand."""
    stand, made, state = random_clouds(seed)
    r, needed = places(stand, made, state), newton(stand, made, state)
    force, moment = np.zeros(3), np.zeros(3)
    for name, (O, R) in frames_in_E0(stand, state).items():
        wrench = np.array(state.wrench[name])
        force += R @ wrench[:3]
        moment += R @ wrench[3:] + np.cross(O, R @ wrench[:3])
    needed_force = sum(f.sum(axis=0) for f in needed.values())
    needed_moment = sum(np.cross(r[name], f).sum(axis=0) for name, f in needed.items())
    scale = max(np.abs(f).sum() for f in needed.values())
    np.testing.assert_allclose(needed_force, force, rtol=0, atol=DIFFERENCES * scale)
    np.testing.assert_allclose(needed_moment, moment, rtol=0, atol=DIFFERENCES * scale)


@pytest.mark.parametrize("seed", SEEDS)
def test_mount_wrench_and_torque_are_what_the_points_of_a_flywheel_need(seed: int) -> None:
    """It is about Os, in the flywheel's axes at phi_s = 0; the run-time wrench turns with phi_s."""
    stand, made, state = random_clouds(seed)
    r, needed, frames = places(stand, made, state), newton(stand, made, state), frames_in_E0(stand, state)
    at_zero = frames_in_E0(stand, replace(state, phi=(0.0,) * len(state.phi)))
    values = evaluate(stand, state, ["mounts", "torque"])
    scale = max(np.abs(f).sum() for f in needed.values())
    for row, s in enumerate(stand.flywheels):
        (O, R), (_, R0) = frames[s.name], at_zero[s.name]
        wrench = np.array(state.wrench[s.name])
        force = needed[s.name].sum(axis=0) - R @ wrench[:3]
        moment = np.cross(r[s.name] - O, needed[s.name]).sum(axis=0) - R @ wrench[3:]
        expected = np.concatenate([R0.T @ force, R0.T @ moment])
        np.testing.assert_allclose(values["mount_wrench"][row], expected, rtol=0, atol=DIFFERENCES * scale)
        assert values["tau"][row] == pytest.approx(expected[3], abs=DIFFERENCES * scale)
