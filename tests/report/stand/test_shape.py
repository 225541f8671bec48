"""Equivalent solids have the mass properties of their bodies, and stand where these stand."""

import math

import numpy as np
from hypothesis import assume, given, settings
from pytest import approx

from mahovik.core.stand import load
from mahovik.core.stand.inertia import inertia_about_center
from mahovik.core.stand.model import Stand
from mahovik.out.report.stand.shape import ellipsoid, shape_of
from mahovik.stands import path
from strategies import stands


@settings(max_examples=30)
@given(stands(max_flywheels=3))
def test_an_ellipsoid_has_the_inertia_of_its_body(stand: Stand) -> None:
    """J = m/5 (|A|^2 E - A A^T) of a homogeneous ellipsoid with semi-axes in the columns of A."""
    for body in stand.bodies:
        A = ellipsoid(body)
        J = body.mass / 5 * (np.sum(A**2) * np.eye(3) - A @ A.T)
        expected = inertia_about_center(body)
        assert approx(expected, rel=1e-9, abs=1e-9 * np.abs(expected).max()) == J


@settings(max_examples=30)
@given(stands(min_flywheels=1, max_flywheels=4))
def test_a_disc_has_the_spin_inertia_of_its_flywheel(stand: Stand) -> None:
    """m R^2/2 along the axis; across it m (3 R^2 + h^2)/12, where a cylinder can have as little."""
    for disc, body in zip(shape_of(stand).flywheels, stand.flywheels, strict=True):
        J = inertia_about_center(body)
        assert body.mass * disc.radius**2 / 2 == approx(J[0, 0], rel=1e-9)
        assume(disc.thickness > 0.0)
        assert body.mass * (3 * disc.radius**2 + disc.thickness**2) / 12 == approx((J[1, 1] + J[2, 2]) / 2, rel=1e-9)


def test_discs_stand_where_the_file_says() -> None:
    """w1 of bench8 turns about x at (0, 0.2, 0.06); its unbalance is that of the file."""
    w1 = shape_of(load(path("bench8"))).flywheels[0]
    assert w1.C[:, 0] == approx([1.0, 0.0, 0.0])
    assert w1.center == approx([0.0005, 0.2, 0.06])
    assert w1.static == approx([0.8 * 0.006, -0.8 * 0.0008])
    assert math.hypot(*w1.dynamic) == approx(math.hypot(-3e-5 - 0.8 * 0.0005 * 0.006, 0.8 * 0.0005 * 0.0008))


def test_a_body_on_an_instrument_is_placed_through_it() -> None:
    """The centre of a flywheel of remus6's nose, by the rotations of the reference."""
    from mahovik.proof.reference.rotation import fixed_rotation, flywheel_mounting

    stand = load(path("remus6"))
    nose, w6 = stand.instruments[0], stand.flywheels[-1]
    assert w6.mount == nose.name
    C = fixed_rotation(*nose.angles)
    disc = shape_of(stand).flywheels[-1]
    assert approx(C @ flywheel_mounting(w6), abs=1e-12) == disc.C
    along = w6.center_of_mass[0] * disc.C[:, 0]
    assert disc.center == approx(np.array(nose.position) + C @ np.array(w6.position) + along, abs=1e-12)
