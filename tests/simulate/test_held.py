"""Simulation of held carriers: C against SciPy, formulas of textbooks, starts that the hold does not allow."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import mahovik
from cli.run import refused
from cli.test_eval import pendulum_file
from mahovik.core.motion.regime import loads_regime
from mahovik.core.stand.hold import twist_of
from mahovik.core.stand.model import Hold, Stand, rest_state
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.core.stand.stand_file import loads
from mahovik.errors import UsageError
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.held import allowed_start, home
from mahovik.use.simulate.run import simulate
from simulate.runs import columns
from simulate.test_agreement import LAWS, MIXED, TORQUES
from toolchain.quick import quick
from verify.holds import HOLDS
from verify.holds import PENDULUM as TEXT

PENDULUM: dict[str, Any] = {
    "schema": 1,
    "name": "pendulum",
    "gravity": [0, 0, -9.81],
    "carrier": {"mass": 2, "center_of_mass": [0, 0, -0.2], "inertia": [0.02, 0.02, 0.01],
                "inertia_about": "center_of_mass"},
    "flywheel": [{"name": "w1", "axis": [0, 1, 0], "zero": [0, 0, 1], "position": [0, 0, -0.2], "mass": 0.5,
                  "spin_inertia": 1e-3, "transverse_inertia": 6e-4}],
}  # fmt: skip


@cache
def busy(name: str) -> Stand:
    """Three flywheels with motors, every kind of wrench, held."""
    stand = random_stand(np.random.default_rng(5), 3, replace(EVERYTHING, tasks=0), name="busy")
    return replace(stand, hold=Hold(HOLDS[name], (0.1, -0.05, 0.2), (0.0,) * 3, (0.0,) * 3))


def case(stand: Stand, text: str, until: float = 0.03, **more: Any) -> Case:
    assert stand.hold is not None
    u = (0.3, -0.2, 0.4, 0.1, 0.2, -0.1)[: len(stand.hold.freedoms)]
    start = replace(rest_state(stand), angles=(0.2, 0.4, -0.3), u=u, V=twist_of(stand.hold, u), phi=(0.1, 0.2, 0.3))
    return Case(stand, loads_regime(text, stand, until), start, until, **{"every": 0.01, **more})


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "text"), quick(1, [("hinge", MIXED), ("knife edge", LAWS), ("ball joint", TORQUES), ("clamped", TORQUES)])
)
def test_the_c_and_the_literal_reference_move_alike(name: str, text: str) -> None:
    chosen = case(busy(name), text, dt=2e-5)
    run, other = simulate(chosen, "c"), simulate(chosen, "scipy")
    assert [*run.columns] == [*other.columns] and run.stopped is None and other.stopped is None
    for head, column in other.columns.items():
        assert np.abs(run[head] - column).max() <= 1e-5 * max(1e-3, float(np.abs(column).max())), head


def test_spring_of_the_axle_swings_by_its_closed_formula() -> None:
    """J a'' + c a' + k (a - a_0) = 0 holds wherever the axle is, however far it turns from the zero of the spring."""
    friction, spring, zero, apart, pivot = 0.08, 3.0, 0.4, 2.0, 0.3
    suspension = {"stiffness": np.diag([0, 0, 0, 0, spring, 0]).tolist(),
                  "damping": np.diag([0, 0, 0, 0, friction, 0]).tolist(), "angles": [0, zero, 0]}  # fmt: skip
    document = {**PENDULUM, "name": "spring", "gravity": [0, 0, 0], "suspension": suspension,
                "hold": {"freedoms": ["pitch"], "pivot": [0, 0, pivot]}}  # fmt: skip
    start = {"angles": [0, zero + apart, 0]}
    run = columns(mahovik.Stand.from_dict(document), 2.0, start=start, dt=1e-3, every=0.1)
    inertia = 0.02 + 2.5 * (0.2 + pivot) ** 2 + 0.001
    decay = friction / (2 * inertia)
    circular = np.sqrt(spring / inertia - decay**2)
    t = np.arange(len(run["qy"])) * 0.1
    swing = np.exp(-decay * t) * (np.cos(circular * t) + decay / circular * np.sin(circular * t))
    assert 2 * np.arctan2(run["qy"], run["qw"]) == pytest.approx(zero + apart * swing, abs=1e-8)


@pytest.mark.parametrize(
    ("start", "reason"),
    [
        ({"V": [0, 0, 0, 0, 1, 0]}, "V: the carrier is held, expected u, 1 number"),
        ({"u": [1, 2]}, "u: expected 1 number, found 2"),
        ({"angles": [0, 0.2, 0.1]}, "rad along roll, which [hold] blocks; expected what the freedoms (pitch) reach"),
        ({"angles": [0, 0.2, 0], "position": [0, 0, 0]}, "m along x, which [hold] blocks"),
        ({"position": [0, 0.01, 0]}, "0.01 m along y, which [hold] blocks"),
        ({"position": [0, 0, 1e-3]}, "along z, which [hold] blocks"),
    ],
)
def test_a_start_that_the_hold_does_not_allow_is_refused(start: dict[str, Any], reason: str, tmp_path: Path) -> None:
    file = pendulum_file(tmp_path)
    (tmp_path / "start.json").write_text(json.dumps(start))
    output = tmp_path / "run.csv"
    message = refused("simulate", file, "--until", "0.1", "--start", str(tmp_path / "start.json"), "-o", str(output))
    assert reason in message and len(message.strip().splitlines()) == 1
    assert not output.exists()


def test_a_speed_off_the_freedoms_is_refused() -> None:
    stand = loads(TEXT)
    with pytest.raises(UsageError, match=r"V moves along yaw, which \[hold\] blocks"):
        allowed_start(stand, replace(home(stand), u=(), V=(0.0, 0.0, 0.0, 0.0, 0.0, 1.0)))


def test_a_run_has_the_coordinates_of_the_freedoms_and_counts_whole_turns() -> None:
    """A carrier that spins on a hinge through several turns: its angle and its speed, and no column of what is held."""
    document = {**PENDULUM, "gravity": [0, 0, 0], "hold": {"freedoms": ["pitch"], "angles": [0, 0.5, 0]}}
    start = {"u": [40.0]}
    run = columns(mahovik.Stand.from_dict(document), 0.5, start=start, dt=1e-3, every=0.05)
    assert [name for name in run if name.startswith("q")][4:] == ["q pitch [rad]", "q_dot pitch [rad/s]"]
    error = 500 * 0.04**5 / 120 / 2**4  # of a quaternion, at half the speed, by Runge-Kutta of fourth order
    assert run["q pitch [rad]"] == pytest.approx(40.0 * run["t [s]"], abs=error)
    assert run["q_dot pitch [rad/s]"] == pytest.approx(np.full(11, 40.0), abs=1e-9)


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
    start = {"angles": [0.0, 2.0, 0.0]}
    run = mahovik.simulate(pendulum(friction=[keys]), until=4.0, start=start, every=0.1, dt=2.5e-4)
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
    run = mahovik.simulate(cart, until=0.8, start={"u": [speed]}, dt=2e-5, every=0.01)
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
    run = mahovik.simulate(sleigh, until=0.6, start={"u": [0.0, spin]}, dt=2e-4, every=0.02)
    t = run["t"]
    v, omega = fast * np.tanh(rate * t), spin / np.cosh(rate * t)
    assert run["v_x"] == pytest.approx(v, abs=1e-9)
    assert run["omega_z"] == pytest.approx(omega, abs=1e-9)
    assert run["hold.reaction.y"] == pytest.approx(MASS * INERTIA / whole * v * omega, abs=1e-8)
    heading = np.arctan2(np.sinh(rate * t), 1.0) * spin / rate  # of E1, from the integral of sech
    assert 2.0 * np.arctan2(run["qz"], run["qw"])[-1] == pytest.approx(heading[-1], abs=1e-9)
