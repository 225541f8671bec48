"""Names that become C identifiers, and rotations as a stand file writes them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.stand.names import name_problem
from mahovik.out.foreign.merge import combine_masses, move_mass
from mahovik.out.foreign.model import Place, RigidMass, angles_of, rotation_from_rpy
from mahovik.out.foreign.naming import Names


def test_every_name_is_an_identifier_of_its_own() -> None:
    names = Names()
    given = [
        "wheel 1",
        "wheel_1",
        "wheel/1",
        "1st",
        "",
        "колесо",
        "int",
        "carrier",
        "a" * 300,
        "a" * 301,
        "x_",
        "class",
    ]
    found = [names.name(each, "flywheel") for each in given]
    assert found[:5] == ["wheel_1", "wheel_1_2", "wheel_1_3", "_1st", "flywheel"]
    assert len(set(found)) == len(found)
    assert [name_problem(each) for each in found] == [None] * len(found)
    assert "carrier" not in found


def test_angles_of_any_axes() -> None:
    """At the singularity of the angles as well, where either of two may be anything."""
    rng = np.random.default_rng(3)
    for _ in range(500):
        psi, theta, phi = rng.uniform(-3, 3, 3)
        if rng.random() < 0.6:
            theta = rng.choice([-1, 1]) * (np.pi / 2 + 10.0 ** rng.uniform(-17, -1) * rng.choice([-1, 0, 1]))
        axes = np.asarray(Rotation.from_euler("ZYX", [psi, theta, phi]).as_matrix())
        again = Rotation.from_euler("ZYX", angles_of(axes)).as_matrix()
        assert np.abs(again - axes).max() < 1e-15 * 4


def test_bodies_that_are_merged_keep_momentum_and_energy() -> None:
    """Two points of a body are a body: mass, first moment, inertia about any point are sums."""
    rng = np.random.default_rng(5)
    points = rng.normal(size=(7, 3))
    masses = rng.uniform(1, 2, 7)
    whole = combine_masses([RigidMass(float(m), p, np.zeros((3, 3))) for m, p in zip(masses, points, strict=True)])
    assert whole.mass == pytest.approx(masses.sum())
    assert whole.center == pytest.approx(masses @ points / masses.sum())
    arms = points - whole.center
    expected = sum(m * (a @ a * np.eye(3) - np.outer(a, a)) for m, a in zip(masses, arms, strict=True))
    assert whole.inertia == pytest.approx(expected)
    place = Place(rng.normal(size=3), rotation_from_rpy(*rng.normal(size=3)))
    back = move_mass(move_mass(whole, place), place.inverse)
    assert back.center == pytest.approx(whole.center)
    assert back.inertia == pytest.approx(whole.inertia)
    alone = RigidMass(0.1, np.array([0.1, 0.2, 0.3]), np.diag([0.1, 0.2, 0.3]))
    assert combine_masses([alone]) is alone
