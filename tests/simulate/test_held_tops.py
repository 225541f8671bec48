"""Tops and gyroscopes on a spherical joint: published figures, closed solutions, and the joint of other programs."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.special import ellipj

import mahovik
from simulate.runs import columns
from toolchain.quick import quick

MASS, ARM, ACROSS, ALONG, GRAVITY = 15.0, 1.0, 0.234375, 0.46875, 9.81
SPIN, TURN = 150.0, -4.61538
"""The heavy top of Bruls, Cardona and Arnold (2012): kg, m, kg m2 about the mass centre, m/s2; rad/s about y and z."""

TOP: dict[str, Any] = {
    "schema": 1,
    "name": "top",
    "gravity": [0, 0, -GRAVITY],
    "carrier": {
        "mass": MASS,
        "center_of_mass": [0, ARM, 0],
        "inertia": [ACROSS, ALONG, ACROSS],
        "inertia_about": "center_of_mass",
    },
    "hold": {"freedoms": ["roll", "pitch", "yaw"]},
}
FRAME, ROTOR = 3.0, 12.0
GYROSCOPE: dict[str, Any] = {
    **TOP,
    "name": "gyroscope",
    "carrier": {
        "mass": FRAME,
        "center_of_mass": [0, ARM, 0],
        "inertia": [0.1, 0.15, 0.1],
        "inertia_about": "center_of_mass",
    },
    "flywheel": [
        {
            "name": "rotor",
            "position": [0, ARM, 0],
            "axis": [0, 1, 0],
            "zero": [0, 0, 1],
            "mass": ROTOR,
            "spin_inertia": 0.4,
            "transverse_inertia": 0.2,
        }
    ],
}
"""A frame with a rotor at one metre from a spherical joint, axis along y of E1."""


@cache
def swing() -> Any:
    return columns(mahovik.Stand.from_dict(TOP), 2.0, start={"u": [0.0, SPIN, TURN]}, every=0.02, dt=2.5e-5)


def axis(run: Any) -> Any:
    """Direction (3 x times) of y of E1, in E0."""
    w, x, y, z = (run[name] for name in ("qw", "qx", "qy", "qz"))
    return np.stack([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)])


def test_the_heavy_top_is_where_others_have_computed_it() -> None:
    """Mass centre and attitude after two seconds, as kept by Kynema for the program of Bruls, Cardona and Arnold.

    Their method of second order, with steps h = 2e-6 s, has the phase error (SPIN h)^2 / 12 of 300 rad: 2e-6.
    """
    run = swing()
    moved = ARM * axis(run)[:, -1] - [0.0, ARM, 0.0]
    assert moved == pytest.approx([-0.150416985652933, -1.724164450779749, -0.673023460701136], abs=2e-6)
    attitude = np.array([run[name][-1] for name in ("qw", "qx", "qy", "qz")])
    published = np.array([0.122947275600560, -0.491079359219981, 0.350430794926147, -0.787986857972906])
    assert attitude * np.sign(attitude[0]) == pytest.approx(published, abs=2e-6)


def test_the_heavy_top_nods_by_the_elliptic_function_of_lagrange() -> None:
    """Height z of the axis: z'^2 = 2 (e - w z) (1 - z^2) - (a - b z)^2, solved by low + (high - low) sn^2."""
    across = ACROSS + MASS * ARM**2
    w, a, b = MASS * GRAVITY * ARM / across, TURN, ALONG * SPIN / across
    e = TURN**2 / 2  # of turning across the axis, which starts level: z = 0, z' = 0
    low, high, beyond = np.sort(np.roots([2 * w, -(2 * e + b**2), -2 * w + 2 * a * b, 2 * e - a**2]).real)
    assert abs(high) < 1e-12 and low > -1 and beyond > 1
    run = swing()
    _, cn, dn, _ = ellipj(math.sqrt(w * (beyond - low) / 2) * run["t [s]"], (high - low) / (beyond - low))
    height = axis(run)[2]
    assert np.ptp(height) > 0.5
    assert np.abs(height - (low + (high - low) * (cn / dn) ** 2)).max() < 1e-9
    assert np.abs(run["omega_y [rad/s]"] - SPIN).max() < 1e-11 * SPIN  # a constant of the motion


def steady(tilt: float, precession: float) -> tuple[mahovik.Stand, dict[str, Any], float]:
    """The gyroscope, a start in which its axis goes round the vertical at one height, and the rate of its rotor.

    J precession^2 cos(tilt) - H precession + m g l = 0: H is the momentum along the axis, J that across it.
    """
    across = 0.1 + 0.2 + (FRAME + ROTOR) * ARM**2
    momentum = (across * precession**2 * math.cos(tilt) + (FRAME + ROTOR) * GRAVITY * ARM) / precession
    along = precession * math.cos(tilt)  # the frame turns with the axis, and not about it
    rate = (momentum - (0.15 + 0.4) * along) / 0.4
    lean = math.pi / 2 - tilt
    start = {"angles": [0.0, 0.0, lean], "u": [0.0, along, precession * math.sin(tilt)], "phi_dot": [rate]}
    return mahovik.Stand.from_dict(GYROSCOPE), start, rate


@pytest.mark.parametrize(("tilt", "precession"), quick(1, [(1.1, 2.0), (2.3, -1.5)]))
def test_a_gyroscope_on_a_spherical_joint_precesses_by_its_closed_formula(tilt: float, precession: float) -> None:
    """Neither height nor rate of the axis change, and the joint bears weight and centripetal force."""
    stand, start, rate = steady(tilt, precession)
    run = columns(stand, 1.0, start=start, every=0.05, dt=2e-4)
    directions, t = axis(run), run["t [s]"]
    assert np.abs(directions[2] - math.cos(tilt)).max() < 1e-11
    going_round = math.sin(tilt) * np.exp(1j * (precession * t + math.pi / 2))
    assert np.abs(directions[0] + 1j * directions[1] - going_round).max() < 1e-11
    assert np.abs(run["phi_dot rotor [rad/s]"] - rate).max() < 1e-11 * abs(rate)
    force = np.linalg.norm([run[f"hold.reaction.{name} [N]"] for name in "xyz"], axis=0)
    mass = FRAME + ROTOR
    expected = math.hypot(mass * GRAVITY, mass * ARM * math.sin(tilt) * precession**2)
    assert np.abs(force / expected - 1).max() < 1e-11
