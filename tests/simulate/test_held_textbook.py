"""Friction, stops and a basis against formulas of textbooks, written here once more, and SciPy's integrator."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import mahovik

MASS, ARM, INERTIA, GRAVITY = 1.7, 0.23, 0.011, 9.81
"""kg, m, kg m2 about the centre of mass, m/s2."""


def pendulum(**tables: Any) -> mahovik.Stand:
    """A rigid pendulum about y, its centre of mass 230 mm below the pivot, which is O1."""
    return mahovik.Stand.from_dict(
        {
            "schema": 1, "name": "pendulum", "gravity": [0, 0, -GRAVITY],
            "carrier": {"mass": MASS, "center_of_mass": [0, 0, -ARM], "inertia": [INERTIA] * 3,
                        "inertia_about": "center_of_mass"},
            "hold": {"freedoms": ["pitch"], **tables},
        }
    )  # fmt: skip


def angles(run: Any) -> Any:
    return 2.0 * np.arctan2(run["qy"], run["qw"])


def hess_and_soom(speed: float, coulomb: float, breakaway: float, stribeck: float, smoothing: float) -> float:
    """Friction with the Stribeck curve of Hess and Soom (1990), whose sign is smoothed."""
    curve = coulomb + (breakaway - coulomb) / (1.0 + (speed / stribeck) ** 2)
    return curve * speed / math.hypot(speed, smoothing)


def test_a_pendulum_with_stribeck_friction_swings_as_its_equation() -> None:
    """(J + m a^2) q'' = -m g a sin q - friction(q'), from a large angle until friction has damped it."""
    viscous, law = 0.004, {"coulomb": 0.03, "breakaway": 0.05, "stribeck": 0.4, "smoothing": 0.05}
    whole = INERTIA + MASS * ARM**2

    def equation(t: float, y: Any) -> list[float]:
        friction = viscous * y[1] + hess_and_soom(float(y[1]), **law)
        return [y[1], (-MASS * GRAVITY * ARM * math.sin(y[0]) - friction) / whole]

    times = np.linspace(0.0, 4.0, 41)
    expected = solve_ivp(equation, (0.0, 4.0), [2.0, 0.0], method="DOP853", rtol=1e-12, atol=1e-12, t_eval=times).y
    keys = {"viscous": viscous, **law}
    keys["stribeck_speed"] = keys.pop("stribeck")
    run = mahovik.simulate(pendulum(friction=[keys]), 4.0, start={"angles": [0.0, 2.0, 0.0]}, every=0.1, dt=2.5e-4)
    assert np.abs(angles(run) - expected[0]).max() < 1e-9
    assert np.abs(expected[0][-10:]).max() < 0.85 * 2.0  # the friction matters


def test_a_stop_gives_back_the_speed_of_hunt_and_crossley() -> None:
    """m x'' = -x (k + d x'): in and out speeds satisfy one equation, whatever the depth; published for n = 1."""
    stiffness, damping, speed, mass = 2.0e4, 4.0e4, 0.3, 2.0
    cart = mahovik.Stand.from_dict(
        {
            "schema": 1, "name": "cart", "carrier": {"mass": mass, "inertia": [0.02] * 3},
            "hold": {"freedoms": ["x"], "stop": [{"at": 0.1, "stiffness": stiffness, "damping": damping}]},
        }
    )  # fmt: skip

    def integral(v: float) -> float:
        """Integral of v / (k + d v), which is equal at both speeds."""
        return v / damping - stiffness / damping**2 * math.log1p(damping * v / stiffness)

    expected = brentq(lambda out: integral(-out) - integral(speed), 1e-9, stiffness / damping * (1 - 1e-12))
    run = mahovik.simulate(cart, 0.8, start={"u": [speed]}, dt=2e-5, every=0.01)
    assert run["v_x"][-1] == pytest.approx(-expected, rel=1e-7)
    assert expected < 0.8 * speed


def test_a_knife_edge_is_the_sleigh_of_chaplygin() -> None:
    """A blade at O1, the mass centre ahead of it: v = V tanh(k t), omega = w sech(k t), and the force of the blade.

    V^2 = v^2 + I w^2 / m and k = m a V / I, I about the blade: the carrier ends in a straight line.
    """
    ahead, whole = 0.15, INERTIA + MASS * 0.15**2
    sleigh = mahovik.Stand.from_dict(
        {
            "schema": 1, "name": "sleigh",
            "carrier": {"mass": MASS, "center_of_mass": [ahead, 0, 0], "inertia": [INERTIA] * 3,
                        "inertia_about": "center_of_mass"},
            "hold": {"basis": [[1, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1]]},
        }
    )  # fmt: skip
    spin = 3.0
    fast = spin * math.sqrt(whole / MASS)
    rate = MASS * ahead * fast / whole
    run = mahovik.simulate(sleigh, 0.6, start={"u": [0.0, spin]}, dt=2e-4, every=0.02)
    t = run["t"]
    v, omega = fast * np.tanh(rate * t), spin / np.cosh(rate * t)
    assert run["v_x"] == pytest.approx(v, abs=1e-9)
    assert run["omega_z"] == pytest.approx(omega, abs=1e-9)
    assert run["hold.reaction.y"] == pytest.approx(MASS * INERTIA / whole * v * omega, abs=1e-8)
    heading = np.arctan2(np.sinh(rate * t), 1.0) * spin / rate  # of E1, from the integral of sech
    assert 2.0 * np.arctan2(run["qz"], run["qw"])[-1] == pytest.approx(heading[-1], abs=1e-9)
