"""(8) forward in time against the literal reference: acceleration, course, rest, and their derivatives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from mahovik.core.motion.required import Course
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import BARE, EVERYTHING, SEQUENCES, Features, random_stand
from mahovik.core.stand.state import State
from mahovik.errors import CheckError, StateError
from mahovik.proof.reference import pieces
from mahovik.proof.reference.forward import forward
from mahovik.use.plan.array import Array
from mahovik.use.plan.forward import (
    BlockElimination,
    Chart,
    acceleration_rates,
    course,
    drive,
    equilibrium,
    integrate,
    linearise,
    linearise_along,
    split_blocks,
)
from mahovik.use.plan.residual import Mechanics

KINDS = [replace(EVERYTHING, angles=s) for s in SEQUENCES] + [BARE, Features(), Features()]
HELD = replace(EVERYTHING, laws={"suspension": 1, "leg": 0}, stream=False)


def chart_of(stand: Stand, rng: np.random.Generator) -> Chart:
    """About a random pose."""
    zero = np.zeros((1, 6))
    return Chart.at_pose(Mechanics.of(stand), Course(rng.normal(size=(1, 6)) * 0.3, zero, zero))


def literal(chart: Chart, y: Array, phi: Array, phi_dot: Array, phi_ddot: Array) -> Array:
    """V* (6) by the reference at one state y (12)."""
    C = chart.C @ Rotation.from_rotvec(y[3:6]).as_matrix()
    a, b, c, w = Rotation.from_matrix(C).as_quat()
    zeros = (0.0,) * len(phi)
    state = State(
        tuple(chart.O1 + chart.C @ y[:3]), None, (w, a, b, c), tuple(y[6:]), tuple(phi), tuple(phi_dot), zeros,
        (0.0,) * 6, zeros,
    )  # fmt: skip
    return forward(pieces(chart.mechanics.stand, state), phi_ddot)


@pytest.mark.parametrize("number", range(12))
def test_acceleration_is_that_of_the_reference(number: int) -> None:
    """On stands of all kinds, several states at once."""
    rng = np.random.default_rng(200 + number)
    stand = random_stand(rng, 1 + number % 6, KINDS[number % len(KINDS)])
    N, M = len(stand.flywheels), 3
    chart, y = chart_of(stand, rng), rng.normal(size=(M, 12)) * ([0.1] * 3 + [0.8] * 3 + [1.0] * 6)
    phi, phi_dot, phi_ddot = (rng.normal(size=(M, N)) * size for size in (3.0, 60.0, 900.0))
    found = chart.acceleration(drive(chart.mechanics, phi, phi_dot, phi_ddot), y)
    for m in range(M):
        expected = literal(chart, y[m], phi[m], phi_dot[m], phi_ddot[m])
        assert abs(found[m] - expected).max() <= 1e-10 * abs(expected).max()


def test_rate_of_the_pose_is_that_of_a_small_motion() -> None:
    """O1 + C v dt and C exp<omega dt>, put back into the chart, near and far from its pose."""
    rng = np.random.default_rng(3)
    chart = chart_of(random_stand(rng, 1, BARE), rng)
    zero = np.zeros((1, 1))
    given = drive(chart.mechanics, zero, zero, zero)
    for size in (1e-3, 1.0, 2.5):
        y = rng.normal(size=12)
        y[3:6] *= size / np.linalg.norm(y[3:6])
        turn, dt = Rotation.from_rotvec(y[3:6]), 1e-6
        around = [
            np.concatenate(
                [y[:3] + turn.apply(y[6:9]) * sign * dt, (turn * Rotation.from_rotvec(sign * dt * y[9:])).as_rotvec()]
            )
            for sign in (1.0, -1.0)
        ]
        assert chart.rate(given, y[None])[0, :6] == pytest.approx((around[0] - around[1]) / (2 * dt), abs=1e-8)


def test_twist_and_pose_of_coordinates() -> None:
    """The chart of prescribed coordinates holds the same attitude, place and V."""
    rng = np.random.default_rng(4)
    chart = chart_of(random_stand(rng, 1, EVERYTHING), rng)
    course_of = Course(*(rng.normal(size=(2, 6)) * 0.4 for _ in range(3)))
    from mahovik.use.plan.residual.kinematics import twists

    expected, found = twists(chart.mechanics.stand, course_of), chart.twists(chart.of(course_of))
    for name in ("C", "O1", "V", "V_r"):
        assert getattr(found, name) == pytest.approx(getattr(expected, name), abs=1e-12)


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
    given = drive(chart.mechanics, *wave(t, chart.mechanics.N, shift))
    return course(chart, given, t[1], start, np.tile(start, (len(t), 1)), None).y


def test_course_is_that_of_an_adaptive_integration() -> None:
    """Every kind of wrench, 0.04 s: against SciPy's on the reference, with quaternions."""
    rng = np.random.default_rng(5)
    stand = random_stand(rng, 3, EVERYTHING)
    chart = chart_of(stand, rng)
    y = rng.normal(size=12) * ([0.1] * 3 + [0.8] * 3 + [1.0] * 6)
    until = 0.04
    found = followed(chart, y, until, 80)[-1]

    def rate(at: float, z: Array) -> Array:
        turn = Rotation.from_quat(z[3:7])
        here = np.concatenate([z[:3], turn.as_rotvec(), z[7:]])
        V_dot = literal(chart, here, *(x[0] for x in wave(np.array([at]), 3)))
        a, b, c, w = z[3:7]
        p, q, r = z[10:]
        turning = [w * p + b * r - c * q, w * q + c * p - a * r, w * r + a * q - b * p, -a * p - b * q - c * r]
        return np.concatenate([turn.apply(z[7:10]), 0.5 * np.array(turning), V_dot])

    z0 = np.concatenate([y[:3], Rotation.from_rotvec(y[3:6]).as_quat(), y[6:]])
    end = solve_ivp(rate, (0.0, until), z0, method="DOP853", rtol=1e-10, atol=1e-12).y[:, -1]
    expected = np.concatenate([end[:3], Rotation.from_quat(end[3:7]).as_rotvec(), end[7:]])
    assert abs(found - expected).max() <= 1e-8


def test_collocation_is_of_order_six() -> None:
    """Twice as many nodes: an error 64 times smaller, on an equation with a known solution."""
    errors = []
    for B in (6, 12):
        t = np.linspace(0.0, 3.0, 4 * B + 1)
        A = np.tile(np.array([[0.0, 1.0], [-1.0, 0.0]]), (len(t), 1, 1))
        push = np.stack([np.zeros_like(t), 3.0 * np.sin(2.0 * t)], axis=1)[:, :, None]
        x = BlockElimination.of(A, t[1]).solve(integrate(push, t[1]), np.array([[0.0], [-2.0]]))
        errors.append(abs(x[:, 0, 0] + np.sin(2.0 * t)).max())
        assert split_blocks(t).shape == (B, 5)
    assert 40.0 < errors[0] / errors[1] < 90.0


def test_derivatives_of_a_course_are_those_of_differences() -> None:
    """Derivatives at the end by the start and by the flywheels' motion."""
    rng = np.random.default_rng(9)
    chart = chart_of(random_stand(rng, 2, EVERYTHING), rng)
    start, until, nodes = rng.normal(size=12) * 0.3, 0.1, 40
    t = np.linspace(0.0, until, nodes + 1)
    motion, y = wave(t, 2), followed(chart, start, until, nodes)
    given = drive(chart.mechanics, *motion)
    added = [after - before for before, after in zip(motion, wave(t, 2, 1.0), strict=True)]
    rates = np.zeros((nodes + 1, 12, 13))
    for B, d in zip(acceleration_rates(given, linearise_along(chart, given, y, motion[2])), added, strict=True):
        rates[:, 6:, 12] += B[:, :, 0] * d[:, :1]
    x0 = np.hstack([np.eye(12), np.zeros((12, 1))])
    exact = linearise(chart, given, t[1], y).solve(integrate(rates, t[1]), x0)[-1]
    for column in range(13):
        step = 1e-5 * x0[:, column]
        shift = 1e-5 if column == 12 else 0.0
        ends = [followed(chart, start + sign * step, until, nodes, sign * shift)[-1] for sign in (1.0, -1.0)]
        difference = (ends[0] - ends[1]) / 2e-5
        assert abs(exact[:, column] - difference).max() <= 1e-5 * abs(difference).max()


def test_a_carrier_thrown_about_is_said_so() -> None:
    """A course that leaves the chart is not followed."""
    rng = np.random.default_rng(6)
    chart = chart_of(random_stand(rng, 2, BARE), rng)
    with pytest.raises(StateError, match="too violently"):
        followed(chart, np.array([0.0] * 9 + [40.0, 0.0, 0.0]), 0.2, 40)


@pytest.mark.parametrize("seed", range(3))
def test_rest_is_rest_and_moves_with_the_angles(seed: int) -> None:
    """Nothing accelerates there by the reference; its derivative is that of differences."""
    rng = np.random.default_rng(seed)
    chart = chart_of(random_stand(rng, 3, HELD), rng)
    phi = rng.normal(size=3)
    found = equilibrium(chart, phi)
    zero = np.zeros(3)
    assert abs(literal(chart, found.y, phi, zero, zero)).max() <= 1e-8
    for s in range(3):
        step = 1e-5 * np.eye(3)[s]
        ahead, behind = (equilibrium(chart, phi + d, found.y).y for d in (step, -step))
        difference = (ahead - behind) / 2e-5
        assert abs(found.by_phi[:, s] - difference).max() <= 1e-5 * abs(difference).max()


def test_a_stand_that_falls_has_no_rest() -> None:
    """Weight and nothing that carries it: said in one line."""
    rng = np.random.default_rng(1)
    chart = chart_of(random_stand(rng, 2, replace(BARE, gravity=True)), rng)
    with pytest.raises(CheckError, match="nothing holds it"):
        equilibrium(chart, np.zeros(2))


def test_what_floats_rests_where_it_is() -> None:
    """Without any wrench every pose is rest, and the chart's own is taken."""
    rng = np.random.default_rng(2)
    chart = chart_of(random_stand(rng, 2, BARE), rng)
    found = equilibrium(chart, np.ones(2))
    assert not found.y.any() and not found.by_phi.any()
