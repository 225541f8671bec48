"""Names that become C identifiers, and rotations as a stand file writes them."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.names import name_problem
from mahovik.out.foreign.model import angles_of
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
