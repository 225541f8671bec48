"""The same stand and state described in another frame E1: another origin, other axes."""

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Flywheel, Mat6, MountingAxes, Stand, State, Vec3
from mahovik.laws.buoyancy.law import Buoyancy
from mahovik.laws.damping.law import Damping
from mahovik.laws.leg.law import Legs, legs_of
from mahovik.proof.reference.algebra import Array, flywheel_mounting
from physics.general import rows
from physics.motions import cross, rotation, vec, with_rotation


def transfer(d: Array, R: Array) -> Array:
    """L (6x6) from the new E1 (origin d, axes R, both in the old one) to the old."""
    return np.block([[R, np.zeros((3, 3))], [cross(d) @ R, R]])


def fixed_angles(C: Array) -> Vec3:
    """Angles of an instrument with the axes C."""
    angles: Vec3 = vec(Rotation.from_matrix(C).as_euler("ZYX"))
    return angles


def redescribed(stand: Stand, d: Array, R: Array) -> Stand:
    """The same stand described in an E1 with origin d and axes R; of laws tied to axes, only linear damping.

    Points stay as they are: the motion does not depend on them.
    """
    L = transfer(d, R)
    back = np.linalg.inv(L)

    def place(position: Vec3) -> Vec3:
        value: Vec3 = vec(R.T @ (np.array(position) - d))
        return value

    def symmetric(matrix: Array) -> Mat6:
        value: Mat6 = rows((matrix + matrix.T) / 2)
        return value

    def carried(matrix: Mat6 | None) -> Mat6 | None:
        return None if matrix is None else symmetric(back @ np.array(matrix) @ back.T)

    c = stand.carrier
    buoyancy, damping = c.law(Buoyancy), c.law(Damping)
    assert buoyancy is not None
    assert damping is not None
    rc = np.array(c.center_of_mass)
    Jc = np.array(c.inertia)
    if c.inertia_about == "origin":
        Jc = Jc + c.mass * cross(rc) @ cross(rc)
    turned_J = R.T @ Jc @ R
    carrier = replace(
        c,
        center_of_mass=place(c.center_of_mass),
        inertia=rows((turned_J + turned_J.T) / 2),
        inertia_about="center_of_mass",
        added_mass=carried(c.added_mass),
        laws=(replace(buoyancy, center=place(buoyancy.center)), Damping(carried(damping.linear), None, ())),
    )
    instruments = tuple(
        replace(
            p,
            position=place(p.position),
            angles=fixed_angles(R.T @ Rotation.from_euler("ZYX", p.angles).as_matrix()),
            added_mass=carried(p.added_mass),
        )
        for p in stand.instruments
    )

    def remounted(s: Flywheel) -> Flywheel:
        C_s = R.T @ flywheel_mounting(s)
        return replace(s, position=place(s.position), mounting=MountingAxes(vec(C_s[:, 0]), vec(C_s[:, 1])))

    flywheels = tuple(remounted(s) if s.mount == "carrier" else s for s in stand.flywheels)
    legs = tuple(replace(leg, carrier=place(leg.carrier)) for leg in legs_of(stand))

    return replace(stand, carrier=carrier, instruments=instruments, flywheels=flywheels).with_laws(Legs(legs))


def redescribed_state(stand: Stand, state: State, d: Array, R: Array) -> State:
    """The state of the redescribed stand at the same moment."""
    L, C = transfer(d, R), rotation(stand, state)
    moved = replace(
        state,
        position=vec(np.array(state.position) + C @ d),
        V=vec(L.T @ np.array(state.V)),
        V_dot=vec(L.T @ np.array(state.V_dot)),
        wrench={**state.wrench, "carrier": vec(np.linalg.solve(L, state.wrench["carrier"]))},
    )
    return with_rotation(moved, C @ R)
