"""Modes of stands whose modes are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand import load, loads
from mahovik.core.stand.model import MountingAxes, Stand
from mahovik.core.stand.state import rest_state
from mahovik.stands import path
from mahovik.use.study.linear import linear_model, modes
from mahovik.use.study.rest import rest

SPRUNG = """
schema = 1
name = "sprung"
[carrier]
mass = 2.0
inertia = [[0.5, 0, 0], [0, 0.3, 0], [0, 0, 0.2]]
[suspension]
stiffness = [800, 450, 200, 32, 12, 7.2]
damping = [8, 0, 100, 0.8, 0, 0]
"""


def sprung() -> Stand:
    def diagonal(line: str) -> list[list[float]]:
        numbers = line.split("[")[1].rstrip("]").split(",")
        return [[float(numbers[i]) if i == j else 0.0 for j in range(6)] for i in range(6)]

    lines = [
        f"{line.split(' ')[0]} = {diagonal(line)}" if line.startswith(("stiffness", "damping =")) else line
        for line in SPRUNG.splitlines()
    ]
    return loads("\n".join(lines), "sprung.toml")


def test_a_mass_on_springs() -> None:
    """Every direction for itself: frequency sqrt(k/m), ratio c / 2 sqrt(k m); one is overdamped."""
    stand = sprung()
    found = modes(linear_model(stand, rest_state(stand)))
    k, m = np.array([800, 450, 200, 32, 12, 7.2]), np.array([2, 2, 2, 0.5, 0.3, 0.2])
    c = np.array([8, 0, 100, 0.8, 0, 0])
    swinging = [mode for mode in found.modes if mode.kind == "oscillation"]
    expected = sorted((np.sqrt(k[i] / m[i]) / 2 / np.pi, c[i] / 2 / np.sqrt(k[i] * m[i])) for i in (0, 1, 3, 4, 5))
    assert np.allclose(sorted((mode.frequency, mode.damping) for mode in swinging), expected, rtol=1e-12, atol=1e-12)
    decays = sorted(mode.eigenvalue.real for mode in found.modes if mode.kind == "decay")
    assert np.allclose(decays, np.sort(np.roots([2, 100, 200])), rtol=1e-12)
    assert found.zeros == 0
    assert not found.unstable
    slowest = min(swinging, key=lambda mode: mode.frequency)
    assert slowest.damped_frequency == pytest.approx(slowest.frequency)
    assert [str(x) for x in found.coordinates][:2] == ["x [m]", "y [m]"]


def test_a_floating_stand_is_free_in_all_directions() -> None:
    stand = load(path("sat4"))
    found = modes(linear_model(stand, rest_state(stand), locked=True))
    assert [mode.kind for mode in found.modes] == ["free"] * 6
    assert found.zeros == 12
    assert np.array_equal([mode.shape.real for mode in found.modes], np.eye(6))
    assert len(modes(linear_model(stand, rest_state(stand))).modes) == 10


def test_a_spinning_flywheel_makes_it_nod() -> None:
    """Nutation of a gyrostat about its principal axes: H / sqrt(J2 J3), H of a flywheel along the first."""
    stand = load(path("sat4"))
    wheel = replace(stand.flywheels[0], position=(0.0, 0.0, 0.0))
    wheel = replace(wheel, mounting=MountingAxes((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
    wheel = replace(
        wheel,
        mass=0.0,
        center_of_mass=(0.0, 0.0, 0.0),
        inertia=((0.02, 0, 0), (0, 1e-9, 0), (0, 0, 1e-9)),
        inertia_about="origin",
    )
    body = replace(stand.carrier, center_of_mass=(0.0,) * 3, inertia=((2.0, 0, 0), (0, 3.0, 0), (0, 0, 4.0)))
    plain = replace(stand, carrier=body, flywheels=(wheel,))
    state = replace(rest_state(plain), phi_dot=(600.0,))
    found = modes(linear_model(plain, state, locked=True))
    (nod,) = [mode for mode in found.modes if mode.kind == "oscillation"]
    assert nod.frequency == pytest.approx(0.02 * 600 / np.sqrt(12) / 2 / np.pi, rel=1e-8)
    assert nod.damping == 0.0


def test_free_flywheels_hang_like_pendulums() -> None:
    """shaker2: unbalance that hangs swings by sqrt(m g c / J), unbalance that stands falls; locked, neither."""
    stand = load(path("shaker2"))
    J = 0.0009 + 0.5 * 0.004**2
    expected = np.sqrt(0.5 * 9.81 * 0.004 / J) / 2 / np.pi
    for quarter, unstable in ((3, False), (1, True)):
        state = rest(stand, [quarter * np.pi / 2] * 2).state
        found = modes(linear_model(stand, state))
        assert found.unstable == unstable
        assert found.modes[0].frequency == pytest.approx(expected, rel=1e-3)  # the carrier gives way a little
        assert found.modes[0].kind == ("growth" if unstable else "oscillation")
        assert not modes(linear_model(stand, state, locked=True)).unstable
