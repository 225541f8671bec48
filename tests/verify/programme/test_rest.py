"""Where a carrier rests before a run-up: nothing accelerates there, and free directions are known as such."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.stand import Stand, load
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.programme.mechanics import pieces_at
from mahovik.proof.verify.programme.simulation import rate, rest_near
from mahovik.use.study.rest import rest


def rest_of(stand: Stand, phi: Array, q: Array) -> tuple[Array, Array, Array]:
    """Pose, free directions and K there."""
    K0 = pieces_at(stand, q, np.zeros(6), phi, np.zeros(len(phi))).K
    at = rest_near(stand, phi, q, K0)
    return at.q, at.free, K0


@pytest.mark.parametrize(("name", "free"), [("bench8", 0), ("auv6", 4), ("demo3", 6)])
def test_nothing_accelerates_there(name: str, free: int) -> None:
    stand = load(stands.path(name))
    phi = np.linspace(0.3, 2.0, len(stand.flywheels))
    q, directions, K0 = rest_of(stand, phi, np.array([0.01, 0.0, 0.0, 0.1, 0.05, -0.1]))
    still = np.zeros(len(phi))
    V_dot = rate(stand, np.concatenate([q, np.zeros(6)]), phi, still, still)[6:]
    assert np.abs(V_dot).max() < 1e-8
    assert directions.shape == (6, free)
    assert directions.T @ K0 @ directions == pytest.approx(np.eye(free), abs=1e-9)


def test_it_is_the_pose_that_another_search_finds() -> None:
    stand = load(stands.path("bench8"))
    phi = np.linspace(0.0, 3.0, 8)
    q, _, _ = rest_of(stand, phi, np.zeros(6))
    assert q[:3] == pytest.approx(rest(stand, phi.tolist()).state.position, abs=1e-9)
