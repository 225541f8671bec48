"""The residual of (12) and (8) forward in time against the literal reference, and their derivatives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Stand, State
from mahovik.core.stand.random import BARE, EVERYTHING, SEQUENCES, Features, random_stand
from mahovik.errors import StateError
from mahovik.proof.reference import pieces
from mahovik.proof.reference.motion import forward
from mahovik.use.numeric.course import Chart, course, equilibrium
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import drive, linear, prescribe, residual, torques
from mahovik.use.numeric.se3 import Array
from plan.problems import literal, random_course

KINDS = [replace(EVERYTHING, angles=s) for s in SEQUENCES] + [BARE, Features(), Features()]


@pytest.mark.parametrize("number", range(12))
def test_residual_and_torque_are_those_of_the_reference(number: int) -> None:
    """(12) and the drive torque, on stands of all kinds, to rounding of what they are sums of."""
    stand, mechanics, motion = random_course(40 + number, 1 + number % 7, KINDS[number % len(KINDS)])
    at = prescribe(mechanics, motion.course)
    R = residual(at, *motion[3:])
    tau = torques(at, *motion[3:])
    for m in range(len(R)):
        expected, torque, size, largest = literal(stand, motion, m)
        assert abs(R[m] - expected).max() <= 1e-11 * size
        assert abs(tau[m] - torque).max() <= 1e-11 * max(largest, size)


@pytest.mark.parametrize("number", range(6))
def test_derivatives_are_those_of_differences(number: int) -> None:
    """Derivatives by angle, speed and acceleration are central differences up to rounding and the third derivative."""
    _, mechanics, motion = random_course(70 + number, 3, KINDS[number])
    at = prescribe(mechanics, motion.course)
    value = linear(at, *motion[3:])
    assert abs(value.R - residual(at, *motion[3:])).max() <= 1e-12 * abs(value.R).max()
    sizes = (1e-5, 1e-3, 1e-1)
    by = ("by_phi", "by_phi_dot", "by_phi_ddot")
    for argument, (step, name) in enumerate(zip(sizes, by, strict=True)):
        exact, exact_tau = getattr(value, name), getattr(value, "tau_" + name)
        for s in range(3):
            around = []
            for sign in (1.0, -1.0):
                moved = [x.copy() for x in motion[3:]]
                moved[argument][:, s] += sign * step
                around.append((residual(at, *moved), torques(at, *moved)))
            difference, difference_tau = ((a - b) / (2 * step) for a, b in zip(*around, strict=True))
            assert abs(exact[:, :, s] - difference).max() <= 1e-6 * max(abs(difference).max(), 1e-9)
            assert abs(exact_tau[:, s] - difference_tau[:, s]).max() <= 1e-6 * max(abs(exact_tau).max(), 1e-3)
            rest = [k for k in range(3) if k != s]
            assert abs(difference_tau[:, rest]).max() == 0.0


HELD = replace(EVERYTHING, laws={"suspension": 1, "leg": 0}, stream=False)


def chart_of(stand: Stand, rng: np.random.Generator) -> Chart:
    """About a random pose."""
    return Chart.at(Mechanics.of(stand), rng.normal(size=6) * 0.3)


def turn_of(y: Array) -> Rotation:
    """The turn from the chart's pose: roll, pitch, yaw are coordinates 3 to 5, the last of them moves first."""
    return Rotation.from_euler("ZYX", y[5:2:-1])


def literal_acceleration(chart: Chart, y: Array, phi: Array, phi_dot: Array, phi_ddot: Array) -> Array:
    """V* (6) by the reference at one state y (12)."""
    C = chart.frame.C @ turn_of(y).as_matrix()
    a, b, c, w = Rotation.from_matrix(C).as_quat()
    zeros = (0.0,) * len(phi)
    O1 = chart.frame.O1 + chart.frame.C @ y[:3]
    state = State(
        tuple(O1), None, (w, a, b, c), tuple(y[6:]), tuple(phi), tuple(phi_dot), zeros,
        (0.0,) * 6, zeros,
    )  # fmt: skip
    return forward(pieces(chart.mechanics.stand, state), phi_ddot)


@pytest.mark.parametrize("number", range(12))
def test_acceleration_is_that_of_the_reference(number: int) -> None:
    """They agree on stands of all kinds, several states at once."""
    rng = np.random.default_rng(200 + number)
    stand = random_stand(rng, 1 + number % 6, KINDS[number % len(KINDS)])
    N, M = len(stand.flywheels), 3
    chart, y = chart_of(stand, rng), rng.normal(size=(M, 12)) * ([0.1] * 3 + [0.8] * 3 + [1.0] * 6)
    phi, phi_dot, phi_ddot = (rng.normal(size=(M, N)) * size for size in (3.0, 60.0, 900.0))
    acceleration = chart.acceleration(drive(chart.mechanics, phi, phi_dot, phi_ddot), y)
    for m in range(M):
        expected = literal_acceleration(chart, y[m], phi[m], phi_dot[m], phi_ddot[m])
        assert abs(acceleration[m] - expected).max() <= 1e-10 * abs(expected).max()


@pytest.mark.parametrize("number", range(6))
def test_linear_equations_of_a_chart_are_those_of_differences(number: int) -> None:
    """Carriers are free, with every kind of wrench; held ones are in `tests/verify/programme`."""
    rng = np.random.default_rng(300 + number)
    stand = random_stand(rng, 2, KINDS[number])
    chart, y = chart_of(stand, rng), rng.normal(size=(2, 12)) * ([0.1] * 3 + [0.8] * 3 + [1.0] * 6)
    drives = drive(chart.mechanics, *(rng.normal(size=(2, 2)) * size for size in (3.0, 60.0, 900.0)))
    jacobian = chart.jacobian(drives, y)
    for k in range(12):
        d = 1e-6 * np.eye(12)[k]
        difference = (chart.rate(drives, y + d) - chart.rate(drives, y - d)) / 2e-6
        assert abs(jacobian[:, :, k] - difference).max() <= 1e-5 * max(abs(difference).max(), 1.0)


def wave(t: Array, N: int, shift: float = 0.0) -> tuple[Array, Array, Array]:
    """A smooth motion of N flywheels (M, N each); `shift`: of the first, along 1 + t + t^2."""
    k = 5.0 + np.arange(N)
    first = np.zeros(N)
    first[0] = shift
    angle, t = np.outer(t, k), t[:, None]
    return (
        np.sin(angle) + first * (1 + t + t**2),
        k * np.cos(angle) + first * (1 + 2 * t),
        -(k**2) * np.sin(angle) + 2 * first,
    )


def followed(chart: Chart, start: Array, until: float, nodes: int, shift: float = 0.0) -> Array:
    """States (M, 12) by collocation."""
    t = np.linspace(0.0, until, nodes + 1)
    drives = drive(chart.mechanics, *wave(t, chart.mechanics.N, shift))
    return course(chart, drives, t[1], start, np.tile(start, (len(t), 1)), None).y


def test_course_is_that_of_an_adaptive_integration() -> None:
    """With every kind of wrench it ends after 0.04 s where SciPy's on the reference, with quaternions, does."""
    rng = np.random.default_rng(5)
    stand = random_stand(rng, 3, EVERYTHING)
    chart = chart_of(stand, rng)
    y = rng.normal(size=12) * ([0.1] * 3 + [0.8] * 3 + [1.0] * 6)
    until = 0.04
    course = followed(chart, y, until, 80)[-1]

    def rate(at: float, z: Array) -> Array:
        turn = Rotation.from_quat(z[3:7])
        final = np.concatenate([z[:3], turn.as_euler("ZYX")[::-1], z[7:]])
        V_dot = literal_acceleration(chart, final, *(x[0] for x in wave(np.array([at]), 3)))
        a, b, c, w = z[3:7]
        p, q, r = z[10:]
        turning = [w * p + b * r - c * q, w * q + c * p - a * r, w * r + a * q - b * p, -a * p - b * q - c * r]
        return np.concatenate([turn.apply(z[7:10]), 0.5 * np.array(turning), V_dot])

    z0 = np.concatenate([y[:3], turn_of(y).as_quat(), y[6:]])
    end = solve_ivp(rate, (0.0, until), z0, method="DOP853", rtol=1e-11, atol=1e-13).y[:, -1]
    expected = np.concatenate([end[:3], Rotation.from_quat(end[3:7]).as_euler("ZYX")[::-1], end[7:]])
    assert abs(course - expected).max() <= 1e-8


def test_a_carrier_thrown_about_is_said_so() -> None:
    """A course that leaves the chart is not followed."""
    rng = np.random.default_rng(6)
    chart = chart_of(random_stand(rng, 2, BARE), rng)
    with pytest.raises(StateError, match="too violently"):
        followed(chart, np.array([0.0] * 10 + [40.0, 0.0]), 0.2, 40)


@pytest.mark.parametrize("seed", range(3))
def test_rest_is_rest_and_moves_with_the_angles(seed: int) -> None:
    """Nothing accelerates there by the reference; its derivative is that of differences."""
    rng = np.random.default_rng(seed)
    chart = chart_of(random_stand(rng, 3, HELD), rng)
    phi = rng.normal(size=3)
    rest = equilibrium(chart, phi)
    zero = np.zeros(3)
    assert abs(literal_acceleration(chart, rest.y, phi, zero, zero)).max() <= 1e-8
    for s in range(3):
        step = 1e-5 * np.eye(3)[s]
        ahead, behind = (equilibrium(chart, phi + d, rest.y).y for d in (step, -step))
        difference = (ahead - behind) / 2e-5
        assert abs(rest.by_phi[:, s] - difference).max() <= 1e-5 * abs(difference).max()
