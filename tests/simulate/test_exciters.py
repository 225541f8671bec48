"""Two exciters with motor curves on a table: the motion is that of Lagrange's equations by SciPy; they synchronise."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import mahovik
from docs.pages import ROOT, blocks
from mahovik.core.stand import loads
from mahovik.stands import servo_and_regime

FILES = {block.file: block.text for block in blocks(ROOT / "docs/studies.md") if block.file}
REGIME = servo_and_regime("two_exciters")["regime"]
TWO_PI = 2 * np.pi
Array = NDArray[np.float64]


def lagrange(inertia: float, curves: list[Any], until: float, times: Array) -> Array:
    """x, z, pitch, phi a, phi b and their rates at some times: kinetic energy of points, springs by hand."""
    points = [np.array(curve) * [np.pi / 30, 1.0] for curve in curves]
    m, u, J, weight = 2.0, 0.04, 0.012, 9.81
    e = u / m
    K = np.array([16e3, 24e3, 24e3 * 0.25])
    cx, cz = (2 * 2 * 0.1 * np.sqrt(k * 32) for k in (8e3, 12e3))
    D = np.array([cx, cz, cz * 0.25])
    raised = 64 * weight / 24e3

    def matrices(q: Array) -> tuple[Array, list[Array]]:
        """Mass matrix, and the Jacobians (2, 5) of the points of the unbalances."""
        theta = q[2]
        M = np.diag([60.0, 60.0, inertia, 0.0, 0.0])
        jacobians = []
        for s, side in enumerate((-0.4, 0.4)):
            psi = theta + q[3 + s]
            J2 = np.zeros((2, 5))
            J2[0, 0] = J2[1, 1] = 1.0
            J2[:, 2] = [-side * np.sin(theta) - e * np.sin(psi), -side * np.cos(theta) - e * np.cos(psi)]
            J2[:, 3 + s] = [-e * np.sin(psi), -e * np.cos(psi)]
            jacobians.append(J2)
            turn = np.zeros(5)
            turn[[2, 3 + s]] = 1.0
            M += m * J2.T @ J2 + (J - m * e * e) * np.outer(turn, turn)
        return M, jacobians

    def rate(t: float, y: Array) -> Array:
        q, v = y[:5], y[5:]
        M, jacobians = matrices(q)
        force = np.zeros(5)
        for s, side in enumerate((-0.4, 0.4)):
            theta, psi = q[2], q[2] + q[3 + s]
            w, W = v[2], v[2] + v[3 + s]
            centripetal = -side * w * w * np.array([np.cos(theta), -np.sin(theta)])
            centripetal -= e * W * W * np.array([np.cos(psi), -np.sin(psi)])
            force -= m * jacobians[s].T @ (centripetal + np.array([0.0, weight]))
            force[3 + s] += np.interp(abs(v[3 + s]), *points[s].T) - 0.002 * v[3 + s]
        c, s_ = np.cos(q[2]), np.sin(q[2])
        C = np.array([[c, s_], [-s_, c]])  # axes of E1 as columns, in x and z
        along = C.T @ (q[:2] - [0.0, raised])
        springs = C @ (-K[:2] * along - D[:2] * (C.T @ v[:2]))
        force[:2] += springs - [0.0, 60 * weight]
        force[2] += -K[2] * q[2] - D[2] * v[2]
        return np.concatenate([v, np.linalg.solve(M, force)])

    start = np.zeros(10)
    start[4] = 2.0
    solution = solve_ivp(rate, (0.0, until), start, "DOP853", times, rtol=1e-10, atol=1e-11)
    return np.asarray(solution.y.T)


@lru_cache
def run(inertia: tuple[float, ...]) -> Any:
    stand = mahovik.example("two_exciters").replace({"carrier.inertia": inertia})
    at_home = [0, 0, 0, 1, *[0] * 10, 2, 0, 0]
    return mahovik.build(stand).simulate(8.0, regime=str(REGIME), start=at_home, dt=5e-4, every=0.01)


LIGHT, HEAVY = (2.0, 2.5, 3.0), (6.0, 10.0, 6.0)


def test_the_motion_is_that_of_lagranges_equations() -> None:
    motion = run(LIGHT)
    wheels = mahovik.example("two_exciters").to_dict()["flywheel"]
    curves = [[[float(x) for x in point] for point in wheel["motor"]["torque_speed"]["value"]] for wheel in wheels]
    until = 1.5
    times = motion["t"][motion["t"] <= until + 1e-9]
    y = lagrange(2.5, curves, until, times)
    n = len(times)
    assert motion["position"][:n, [0, 2]] == pytest.approx(y[:, :2], abs=2e-6)
    assert motion["phi"][:n] == pytest.approx(y[:, 3:5], abs=2e-4)
    assert motion["phi_dot"][:n] == pytest.approx(y[:, 8:], abs=1e-2)


@pytest.mark.parametrize(("inertia", "in_phase"), [(LIGHT, True), (HEAVY, False)])
def test_exciters_fall_into_step_by_the_known_condition(inertia: tuple[float, ...], in_phase: bool) -> None:
    motion = run(inertia)
    total = inertia[1] + 2 * (2 * 0.16 + 0.012)
    assert (64 * 0.16 / total > 2) == in_phase
    apart = motion["phi"][-200:, 0] - motion["phi"][-200:, 1]
    assert np.ptp(apart) < 0.05
    off = (apart - (0.0 if in_phase else np.pi) + np.pi) % TWO_PI - np.pi
    assert np.abs(off).max() < 0.5


def test_a_motor_of_the_file_hangs_as_one_that_delivers_its_line() -> None:
    """The limit of the file, commanded beyond, and the same line as what is delivered: one motion while it drives."""
    curve = [[0, 0.35], ["1500 rpm", 0]]
    stand = mahovik.Stand.of(loads(FILES["rail.toml"])).replace({"ex.motor": {"torque_speed": curve}})
    model = mahovik.build(stand)
    laws = ({"torque": 0.5}, {"torque_speed": curve})
    limited, delivered = (
        model.simulate(5.0, regime={"flywheel": {"ex": law}}, dt=1e-3, every=0.1)["phi"] for law in laws
    )
    np.testing.assert_allclose(limited, delivered, rtol=0, atol=1e-9)


@pytest.mark.parametrize(("torque", "speed"), [(0.35, 60.81), (4.0, 140.0)])
def test_a_weak_motor_hangs_at_the_resonance(torque: float, speed: float) -> None:
    """Where the power of the motor is that of the vibration: 60.81 rad/s, a little below sqrt(k / m) = 62.83 rad/s."""
    model = mahovik.build(mahovik.Stand.of(loads(FILES["rail.toml"])))
    curve = [[0, torque], [50 * np.pi, 0]]
    motion = model.simulate(20.0, regime={"flywheel": {"ex": {"torque_speed": curve}}}, dt=1e-3, every=0.01)
    mean_speed = motion["phi_dot"][-500:, 0].mean()
    assert mean_speed == pytest.approx(speed, abs=0.05) if torque < 1.0 else mean_speed > speed
