"""Mismatch: what is drawn is near, the same for the same seed, and still a stand."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mahovik import stands as examples
from mahovik.core.stand import Stand, load
from mahovik.core.stand.inertia import inertia_about_center
from mahovik.errors import UsageError
from mahovik.laws.suspension.data import Suspension
from mahovik.use.control.mismatch import with_mismatch
from mahovik.use.plan.residual.spatial import mount_axes
from strategies import stands

SHARE = 0.01
BENCH8 = load(examples.path("bench8"))


@settings(max_examples=15)
@given(stands(max_flywheels=4), st.integers(0, 99))
def test_any_stand_stays_one_and_near(stand: Stand, seed: int) -> None:
    """The checks of the stand file hold inside `with_mismatch`; masses and positions are within the share."""
    found = with_mismatch(stand, SHARE, seed)
    for own, other in zip(stand.bodies, found.bodies, strict=True):
        assert abs(other.mass / own.mass - 1.0) <= SHARE
        c = np.array(own.center_of_mass)
        assert np.linalg.norm(np.array(other.center_of_mass) - c) <= SHARE * np.linalg.norm(c) * (1 + 1e-12)
        moment = np.trace(inertia_about_center(own))
        assert abs(np.trace(inertia_about_center(other)) / moment - 1.0) <= SHARE + 1e-12


def test_the_same_seed_gives_the_same_stand() -> None:
    assert with_mismatch(BENCH8, SHARE, 3) == with_mismatch(BENCH8, SHARE, 3)
    assert with_mismatch(BENCH8, SHARE, 3) != with_mismatch(BENCH8, SHARE, 4)
    assert with_mismatch(BENCH8, 0.0, 3) == BENCH8


def test_every_number_that_is_measured_is_wrong() -> None:
    """No flywheel keeps mass, centre, inertia, place or axis, nor the suspension its stiffness."""
    found = with_mismatch(BENCH8, SHARE, 1)
    for own, other in zip(BENCH8.flywheels, found.flywheels, strict=True):
        assert own.mass != other.mass
        assert own.center_of_mass != other.center_of_mass
        assert np.abs(inertia_about_center(own) - inertia_about_center(other)).diagonal().min() > 0.0
        assert own.position != other.position
        turned = mount_axes(own).T @ mount_axes(other)
        angle = np.arccos(np.clip((np.trace(turned) - 1.0) / 2.0, -1.0, 1.0))
        assert 0.0 < angle <= SHARE
        assert (own.motor, own.encoder, own.name) == (other.motor, other.encoder, other.name)
    hung, moved = BENCH8.law(Suspension), found.law(Suspension)
    assert hung is not None
    assert moved is not None
    assert hung.stiffness != moved.stiffness
    assert (BENCH8.gravity, BENCH8.name) == (found.gravity, found.name)


@pytest.mark.parametrize("share", [-0.01, 0.5, float("nan")])
def test_a_share_out_of_range_is_refused(share: float) -> None:
    with pytest.raises(UsageError, match="--mismatch"):
        with_mismatch(BENCH8, share, 1)
