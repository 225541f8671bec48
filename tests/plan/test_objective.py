"""J(x, u) and the bounds of (13): rows by their definition, and what is said of a programme that exceeds a bound."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.functions import Angles, Course
from mahovik.core.motion.required import Bounds
from mahovik.core.stand.random import EVERYTHING
from mahovik.use.numeric.residual import PrescribedMotion, linear, prescribe
from mahovik.use.plan.objective import (
    KINDS,
    Cost,
    Rows,
    bound_uses,
    exceeded_bounds,
    utilisation,
)
from plan.problems import RandomCourse, random_course, required

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
    (rows,) = cost.rows(angles, mean_speed, Rows.torque(linear(at, *angles))).values()
    return rows


@pytest.mark.parametrize("kind", KINDS)
def test_rows_are_what_they_say(kind: str) -> None:
    """Each row is its definition times the square root of its weight, so that J is linear in the weights."""
    cost, motion, at = setting(kind)
    angles = Angles(*motion[3:])
    values = rows_at(cost, at, angles).value / np.sqrt(WEIGHTS)
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
    assert values == pytest.approx(expected, rel=1e-12)


ALL = Bounds(
    speed=(50.0, 40.0, 30.0),
    speed_min=(10.0, 0.0, 5.0),
    acceleration=(500.0,) * N,
    torque=(0.5,) * N,
    angle=(1.0,) * N,
)


def bounded_setting() -> tuple[Any, RandomCourse, Any]:
    """A stand and drawn motions, which exceed every bound somewhere and keep it elsewhere."""
    stand, mechanics, motion = random_course(33, N, EVERYTHING, M=12)
    return stand, motion, prescribe(mechanics, motion.course)


def test_what_is_exceeded_is_told_by_flywheel_value_and_time() -> None:
    """The worst excess of each flywheel and kind is listed, the worst first."""
    stand, motion, at = bounded_setting()
    t = np.linspace(0.0, 1.1, 12)
    angles, tau = Angles(*motion[3:]), linear(at, *motion[3:]).tau
    excesses = exceeded_bounds(ALL, stand, t, angles, motion.phi, tau, np.zeros(6))
    assert [excess.ratio for excess in excesses] == sorted((excess.ratio for excess in excesses), reverse=True)
    by = {(excess.kind, excess.of): excess for excess in excesses}
    names = [s.name for s in stand.flywheels]
    for s in range(N):
        worst = int(np.argmax(abs(motion.phi_ddot[:, s])))
        excess = by.pop(("acceleration", names[s]))
        assert excess.value == abs(motion.phi_ddot[worst, s]) and excess.time == t[worst] and excess.limit == 500.0
        assert f"{excess.value:.6g} rad/s^2" in excess.words and names[s] in excess.words
    assert ("speed_min", names[1]) not in by
    wide = Bounds(speed=(1e9,) * N, acceleration=(1e9,) * N, torque=(1e9,) * N)
    assert exceeded_bounds(wide, stand, t, angles, motion.phi, tau, np.zeros(6)) == ()
    (one,) = exceeded_bounds(
        Bounds(bias=(1e-3,) * 6), stand, t, angles, motion.phi, tau, np.array([0, 0, 2e-3, 0, 0, 0])
    )
    assert (one.kind, one.of, one.time) == ("bias", "z", None) and one.ratio == pytest.approx(2.0)


def test_utilisation_is_one_at_the_limit() -> None:
    """It is the largest of all bounds, and above one where a least speed is missed."""
    flat = np.ones((4, N))
    angles = Angles(flat, 20.0 * flat, 100.0 * flat)
    none, turns = np.zeros((4, N)), np.ones(N)

    def used(bounds: Bounds, turns: np.ndarray = turns, bias: float = 0.0) -> float:
        return utilisation(bounds, bound_uses(bounds, angles, none, Rows.of(none), turns), np.full(6, bias))

    assert used(Bounds()) == 0.0
    assert used(Bounds(acceleration=(100.0, 400.0, 400.0))) == 1.0
    assert used(Bounds(speed_min=(20.0, 0.0, 10.0))) == 1.0
    assert used(Bounds(speed_min=(20.0, 0.0, 10.0)), -turns) > 2.0
    assert used(Bounds(bias=(0.1,) * 6), bias=0.25) == 2.5
