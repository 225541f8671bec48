"""Held examples (docs/held) under their regimes move as closed formulas say."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.special import ellipk

import mahovik

HELD = Path(__file__).parents[2] / "docs" / "held"


def run(name: str, until: float, dt: float, every: float, angles: list[float] | None = None) -> mahovik.Result:
    """A run of an example under its own regime."""
    start: dict[str, Any] = {} if angles is None else {"start": {"angles": angles}}
    regime = HELD / "regimes" / f"{name}.toml"
    return mahovik.simulate(HELD / f"{name}.toml", regime=regime, until=until, dt=dt, every=every, **start)


def rising_zeros(t: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Times at which y rises through zero."""
    k = np.flatnonzero((y[:-1] < 0) & (y[1:] >= 0))
    return np.asarray(t[k] - y[k] * (t[k + 1] - t[k]) / (y[k + 1] - y[k]))


def test_a_large_swing_has_the_period_of_the_elliptic_integral() -> None:
    """The pivot pulls most when the stick passes below it."""
    moved = run("pendulum", 5, 1e-3, 5e-3, [0, math.radians(30), 0])
    weight = 9.81 * (0.300 * 0.060 + 0.250 * 0.120)  # N m a radian
    inertia = 6e-4 + 0.300 * 0.060**2 + 4e-4 + 0.250 * 0.120**2  # about the pivot, with the braked wheel
    small = 2 * math.pi * math.sqrt(inertia / weight)
    large = small * 2 / math.pi * ellipk(math.sin(math.radians(150) / 2) ** 2)
    assert np.diff(rising_zeros(moved["t"], moved["omega_y"])) == pytest.approx(large, rel=1e-5)
    fastest = 2 * weight / inertia * (1 + math.cos(math.radians(30)))  # rad2/s2, by its energy
    pull = 0.550 * 9.81 + (0.300 * 0.060 + 0.250 * 0.120) * fastest
    assert np.abs(moved["hold.reaction.z"]).max() == pytest.approx(pull, rel=1e-4)


def test_a_cube_precesses_and_nods_at_the_roots_of_a_top() -> None:
    """Its two frequencies follow from the momentum of the wheels and the inertia across the diagonal."""
    moved = run("cube", 8, 2e-4, 1e-2, [0, -0.5631198311105574, 0.7853981633974483])
    t, (w, x, y, z) = moved["t"], (moved[name] for name in ("qw", "qx", "qy", "qz"))
    C = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        ]
    )
    axis = np.einsum("ijt,j->it", C, np.ones(3) / math.sqrt(3))  # horizontal part of the diagonal, in E0
    tilt = np.degrees(np.arcsin(np.linalg.norm(axis, axis=0)))
    assert tilt[0] == pytest.approx(3, abs=1e-9) and tilt.max() < 6  # it does not fall

    wheels = [0.200 * (np.dot(c, c) * np.eye(3) - np.outer(c, c)) for c in 0.075 - 0.060 * np.eye(3)]
    spins = np.diag([5e-4 + 2 * 2.6e-4] * 3)  # of the three wheels, about the axis and across
    cube = np.diag([3.6e-3, 3.7e-3, 3.5e-3]) + 0.770 * 0.075**2 * (3 * np.eye(3) - np.ones((3, 3)))
    J = sum(wheels) + spins + cube  # about the corner
    across = (np.trace(J) - np.ones(3) @ J @ np.ones(3) / 3) / 2
    momentum = math.sqrt(3) * 5e-4 * 8000 * 2 * math.pi / 60
    weight = 9.81 * math.sqrt(3) * (0.770 * 0.075 + 0.200 * (0.015 + 0.075 + 0.075))
    precession, nutation = sorted(abs(np.roots([across, -momentum, weight])) / 2 / math.pi)

    spectrum = np.abs(np.fft.fft(np.hanning(len(t)) * (axis[0] + 1j * axis[1]), 64 * len(t)))
    frequency = np.fft.fftfreq(64 * len(t), t[1])
    assert abs(frequency[np.argmax(spectrum)]) == pytest.approx(precession, rel=0.005)
    fast = frequency[np.argmax(np.where(np.abs(frequency) > 1, spectrum, 0))]
    assert abs(fast) == pytest.approx(nutation, rel=0.002)


def test_periods_of_an_air_table_say_where_its_centre_of_mass_is() -> None:
    moved = run("air_table", 80, 5e-3, 0.05, [0, math.radians(1), math.radians(2)])
    depth = 48 * 0.6e-3  # kg m: mass times depth of the centre below the pivot
    arm = 1.5 * 0.250**2  # kg m2: a wheel at the end of its arm
    about_x = 2.1 + 2.4e-3 + 2 * 1.4e-3 + arm  # the wheel on y is off the axis
    about_y = 2.3 + 2.4e-3 + 2 * 1.4e-3 + 2 * arm
    for name, inertia in (("omega_x", about_x), ("omega_y", about_y)):
        measured = np.diff(rising_zeros(moved["t"], moved[name])).mean()
        assert measured == pytest.approx(2 * math.pi * math.sqrt(inertia / (9.81 * depth)), rel=1e-3)


def test_a_force_table_reads_what_turns_with_the_wheel() -> None:
    moved = run("force_table", 8, 5e-4, 1e-3)
    inside = slice(1, -1)
    speed = moved["phi_dot wheel"][inside]
    tangential = 72e-6 * 3000 * 2 * math.pi / 60 / 8  # m e times the angular acceleration
    force = np.hypot(moved["hold.reaction.x"], moved["hold.reaction.y"])[inside]
    assert force == pytest.approx(np.hypot(72e-6 * speed**2, tangential), abs=1e-9)
    moment = np.hypot(moved["hold.reaction.k"], moved["hold.reaction.m"])[inside]
    assert moment == pytest.approx(0.100 * force, abs=1e-9 + 72e-6 * 9.81)  # and its weight, off the axis
    assert moved["hold.reaction.z"] == pytest.approx(14 * 9.81, abs=1e-9)
    assert moved["hold.reaction.n"][inside] == pytest.approx(4e-3 * tangential / 72e-6, abs=1e-9)


def test_a_shaker_passes_its_resonance_and_swings_as_an_oscillator() -> None:
    moved = run("linear_shaker", 12, 5e-4, 2e-3)
    thrust = 2 * 0.160  # kg m, of both
    speed = 600 * 2 * math.pi / 60
    formula = thrust * speed**2 / abs(40e3 - 76 * speed**2 + 300j * speed)
    late = moved["t"] > 10
    phi = moved["phi left"][late]
    waves = np.stack([np.ones(phi.size), np.cos(phi), np.sin(phi)], axis=1)
    rest, a, b = np.linalg.lstsq(waves, moved["z"][late], rcond=None)[0]
    assert math.hypot(a, b) == pytest.approx(formula, rel=1e-5)
    assert rest == pytest.approx(-76 * 9.81 / 40e3, abs=1e-6)
    assert np.abs(moved["hold.reaction.y"]).max() < 1e-9 * thrust * speed**2
    assert 2 < np.abs(moved["z"] - rest).max() / formula < 6  # resonance
    assert np.abs(moved["phi left"] - moved["phi right"]).max() == 0
