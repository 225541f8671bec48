"""J(x, u) of (13): each kind of rows against its definition and its derivatives against differences."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.programme import Angles
from mahovik.core.motion.required import Course
from mahovik.core.stand.random import EVERYTHING
from mahovik.errors import MotionError
from mahovik.use.plan.objective import KINDS, Cost, Rows
from mahovik.use.plan.residual import PrescribedMotion, linear, prescribe
from plan.courses import RandomCourse, random_course
from plan.problems import required

OMEGA = 30.0
N = 3
WEIGHTS = (0.5, 2.0, 1.0)


def setting(kind: str) -> tuple[Cost, RandomCourse, PrescribedMotion]:
    """A cost with one kind weighted, on a stand with motors, and a drawn motion."""
    _, mechanics, motion = random_course(21, N, replace(EVERYTHING, motors=True))
    weights: dict[str, Any] = {kind: WEIGHTS}
    cost = Cost.of(mechanics, required(N, **weights).objective, OMEGA)
    return cost, motion, prescribe(mechanics, Course(*motion[:3]))


def rows_at(cost: Cost, at: PrescribedMotion, angles: Angles) -> Rows:
    """The one kind of rows, without derivatives by the bias."""
    mean_speed = np.array([OMEGA, -OMEGA, 0.0])
    (found,) = cost.rows(angles, mean_speed, Rows.torque(linear(at, *angles))).values()
    return found


@pytest.mark.parametrize("kind", KINDS)
def test_rows_are_what_they_say(kind: str) -> None:
    """Each is its definition, times the square root of its weight: J is linear in the weights."""
    cost, motion, at = setting(kind)
    angles = Angles(*motion[3:])
    found = rows_at(cost, at, angles).value / np.sqrt(WEIGHTS)
    tau = linear(at, *angles).tau
    J = cost.spin_inertia
    motors = [s.motor for s in at.mechanics.stand.flywheels if s.motor is not None]
    speed = motion.phi_dot
    friction = np.array(
        [
            [m.viscous * w + m.coulomb * np.tanh(w / m.coulomb_speed) for m, w in zip(motors, row, strict=True)]
            for row in speed
        ]
    )
    current = (tau + friction) / [m.constant for m in motors]
    power = current**2 * [m.resistance for m in motors] + (tau + friction) * speed
    expected = {
        "acceleration": motion.phi_ddot / OMEGA**2,
        "torque": tau / (J * OMEGA**2),
        "speed_variation": (speed - [OMEGA, -OMEGA, 0.0]) / OMEGA,
        "power": power / (J * OMEGA**3),
    }[kind]
    assert found == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_derivatives_are_those_of_differences(kind: str) -> None:
    """Derivatives by angle, speed and acceleration of the flywheel itself."""
    cost, motion, at = setting(kind)
    found = rows_at(cost, at, Angles(*motion[3:]))
    exact = (found.by_phi, found.by_phi_dot, found.by_phi_ddot)
    for argument, step in enumerate((1e-6, 1e-5, 1e-3)):
        ahead, behind = [list(motion[3:]) for _ in range(2)]
        ahead[argument], behind[argument] = motion[3 + argument] + step, motion[3 + argument] - step
        difference = (rows_at(cost, at, Angles(*ahead)).value - rows_at(cost, at, Angles(*behind)).value) / (2 * step)
        assert abs(exact[argument] - difference).max() <= 1e-6 * max(abs(difference).max(), 1e-6)


def test_value_is_the_sum_of_weighted_mean_squares() -> None:
    """Constant accelerations cost weight times square, summed over flywheels."""
    cost, motion, at = setting("acceleration")
    angles = Angles(motion.phi, motion.phi_dot, np.full_like(motion.phi, 2.0 * OMEGA**2))
    torque = Rows.torque(linear(at, *angles))
    assert cost.value(angles, np.zeros(N), torque) == pytest.approx({"acceleration": 4.0 * sum(WEIGHTS)}, rel=1e-12)


def test_power_without_motor_constants_is_refused() -> None:
    """One line names all flywheels that have a weight, and none without."""
    _, mechanics, _ = random_course(21, N, replace(EVERYTHING, motors=False))
    with pytest.raises(MotionError) as refused:
        Cost.of(mechanics, required(N, power=(1.0, 0.0, 2.0)).objective, OMEGA)
    (words,) = refused.value.problems
    first, _, third = (s.name for s in mechanics.stand.flywheels)
    assert f'flywheels "{first}", "{third}" have no motor with `constant`' in words
