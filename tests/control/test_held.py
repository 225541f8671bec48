"""Held carriers follow programmes: errors along the freedoms, coordinates of poses, both plants, refusals."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik.core.motion.functions import Fourier
from mahovik.core.motion.motion_file import read_motion
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import read_servo
from mahovik.core.stand import Stand
from mahovik.use.control.loop import Case, coordinates, starting_state
from mahovik.use.control.servo import lightness
from mahovik.use.control.trim import ReferenceMotion
from mahovik.use.numeric.frame import Frame
from plan.held_stands import HOLDS, stand, wheel

SERVO = """
schema = 1
sample_period = "2 ms"
latency = "100 us"
bandwidth = "20 Hz"
"""

SWING, PERIOD, INERTIA = 0.1, 0.5, 0.03 + 2.5 * 0.12**2 + 0.01
WEIGHT, OMEGA = 2.5 * 9.81 * 0.12, 2.0 * math.pi / PERIOD


def pendulum(more: str = "") -> Stand:
    """A wheel on O1, 120 mm below the axle."""
    return stand('freedoms = ["pitch"]\npivot = [0, 0, "120 mm"]', wheel(1, [0, 1, 0]), more)


def swinging(stand: Stand) -> tuple[RequiredMotion, Programme]:
    """theta = SWING cos(OMEGA t): J theta'' + m g l sin theta = -J_w phi'', with Bessel's harmonics."""
    from scipy.special import jv

    document = {"schema": 1, "type": "periodic", "period": PERIOD, "harmonics": [{"k": 1, "cos": [SWING]}]}
    required = read_motion(json.dumps(document), stand, "m.json")
    k = np.arange(1, 6)
    moment = np.array([2.0 * WEIGHT * (-1.0) ** ((n - 1) // 2) * jv(n, SWING) if n % 2 else 0.0 for n in k])
    moment[0] -= INERTIA * SWING * OMEGA**2
    cos = (moment / 0.01 / (OMEGA * k) ** 2)[:, None]
    programme = Programme.of(
        stand, required.name, required.span, np.zeros(1), (0,), Fourier(np.zeros(1), cos, np.zeros_like(cos)), {}
    )
    return required, programme


def followed(stand: Stand, text: str = SERVO, **options: Any) -> Any:
    required, programme = swinging(stand)
    arguments: dict[str, Any] = {
        "motion": required,
        "programme": programme,
        "servo": read_servo(text, stand),
        "periods": 11,
    }
    return mahovik.simulate(stand, **(arguments | options))


def test_mismatch_swings_the_pendulum_by_the_linear_formula() -> None:
    """A pivot 1 % further away, small swing: theta = J_w phi'' / (m g l - J w^2) of the real pendulum."""
    stand = pendulum()
    assert stand.hold is not None
    real = replace(stand, carrier=replace(stand.carrier, mass=stand.carrier.mass * 1.02))
    required, programme = swinging(stand)
    case = Case(ReferenceMotion.of(stand, required, programme, None), real, read_servo(SERVO, stand), 11)
    y = starting_state(case)
    mass = 2.04 + 0.5
    inertia, weight = 0.03 + mass * 0.12**2 + 0.01, mass * 9.81 * 0.12
    assert isinstance(programme.course, Fourier)
    driven = 0.01 * float(programme.course.cos[0, 0]) * OMEGA**2  # J_w phi'' = -driven cos
    expected = driven / (weight - inertia * OMEGA**2)
    q = coordinates(stand, np.array([y.position]), np.array([y.quaternion]), np.zeros((1, 1)))[0, 0]
    assert q == pytest.approx(expected, rel=2e-2)
    assert abs(q - SWING) > 3 * abs(q - expected)


@pytest.mark.parametrize("hold", HOLDS)
def test_coordinates_are_found_again_from_the_pose(hold: str) -> None:
    held = stand(hold, wheel(1, [0, 0, 1]))
    assert held.hold is not None
    q = np.random.default_rng(5).uniform(-1.2, 1.2, (6, len(held.hold.freedoms)))
    from scipy.spatial.transform import Rotation

    C, O1 = Frame.of(held).pose(q)
    attitude = Rotation.from_matrix(C).as_quat()[:, [3, 0, 1, 2]]
    near = q + np.random.default_rng(6).uniform(-0.5, 0.5, q.shape)
    assert np.abs(coordinates(held, O1, attitude, near) - q).max() < 1e-12


def test_rotors_feel_the_freedoms_alone() -> None:
    """A wheel along the axle is lighter by J (J - J^2 / K)^-1 = K / (K - J); one across it is not."""
    along, across = (stand('freedoms = ["yaw"]', wheel(1, axis)) for axis in ([0, 0, 1], [0, 1, 0]))
    inertia = 0.01 + 0.01
    assert lightness(along) == pytest.approx(inertia / (inertia - 0.01), rel=1e-12)
    assert lightness(across) == 1.0


@pytest.mark.slow
def test_a_trim_takes_back_what_the_programme_leaves_out() -> None:
    """Friction of the axle, which this programme does not make up for, and numbers that are wrong by 2 %."""
    stand = pendulum("[[hold.friction]]\nviscous = 0.05\n")
    trim = "[trim]\nharmonics = 1\nsettling = 6\ngain = 1\n"
    plain = followed(stand, mismatch=0.02)
    run = followed(stand, SERVO + trim, mismatch=0.02, periods=32)
    assert plain["error"] > 0.05
    assert run["coordinates"]["rms"][0] < 0.02 * plain["coordinates"]["rms"][0]
