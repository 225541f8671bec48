"""E_x and E_u of (13): hinge rows, and what is said of a programme that exceeds a bound."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.programme import Angles
from mahovik.core.motion.required import Bounds
from mahovik.core.stand.random import EVERYTHING
from mahovik.use.plan.objective import (
    KNEE,
    RHO,
    Rows,
    bias_hinges,
    exceeded_bounds,
    gauss_newton_sums,
    hinge_rows,
    utilisation,
)
from mahovik.use.plan.problem import Basis, uniform
from mahovik.use.plan.residual import linear, prescribe
from plan.courses import RandomCourse, random_course
from plan.problems import PERIOD, wheels

N = 3
ALL = Bounds(
    speed=(50.0, 40.0, 30.0), speed_min=(10.0, 0.0, 5.0), acceleration=(500.0,) * N, torque=(0.5,) * N, angle=(1.0,) * N
)
WINDING = np.array([1.0, -1.0, -2.0])


def setting() -> tuple[Any, RandomCourse, Any]:
    """A stand and drawn motions, which exceed every bound somewhere and keep it elsewhere."""
    stand, mechanics, motion = random_course(33, N, EVERYTHING, M=12)
    return stand, motion, prescribe(mechanics, motion.course)


def rows_at(at: Any, angles: tuple[Any, ...], wider: float = 1.0) -> dict[str, Rows]:
    return hinge_rows(ALL, Angles(*angles), angles[0], Rows.torque(linear(at, *angles)), WINDING, wider)


def test_hinges_are_zero_inside_and_rise_outside() -> None:
    """RHO (|y|/L - KNEE) above the knee, exactly; of least speeds along the winding; limits as wide as asked."""
    _, motion, at = setting()
    for wider in (1.0, 1.7):
        found = rows_at(at, motion[3:], wider)
        for kind, y in (("speed", motion.phi_dot), ("acceleration", motion.phi_ddot), ("angle", motion.phi)):
            over = abs(y) / (wider * np.array(getattr(ALL, kind))) - KNEE
            assert (over > 0).any() and (over < 0).any()
            assert found[kind].value == pytest.approx(np.maximum(0.0, RHO * over), rel=1e-12)
        slow = found["speed_min"].value
        assert not slow[:, 1].any()
        assert slow[:, 2] == pytest.approx(np.maximum(0.0, RHO * (2 - KNEE + motion.phi_dot[:, 2] * wider / 5.0)))


@pytest.mark.parametrize("kind", ["speed", "speed_min", "acceleration", "torque", "angle"])
def test_derivatives_are_those_of_differences(kind: str) -> None:
    """Derivatives by angle, speed and acceleration; no row is at the knee in this draw."""
    _, motion, at = setting()
    found = rows_at(at, motion[3:])[kind]
    assert found.value.any()
    exact = (found.by_phi, found.by_phi_dot, found.by_phi_ddot)
    for argument, step in enumerate((1e-7, 1e-6, 1e-4)):
        around = []
        for sign in (1.0, -1.0):
            angles = list(motion[3:])
            angles[argument] = angles[argument] + sign * step
            around.append(rows_at(at, tuple(angles))[kind].value)
        difference = (around[0] - around[1]) / (2 * step)
        assert abs(exact[argument] - difference).max() <= 1e-5 * max(abs(difference).max(), 1e-6)


def test_a_step_of_the_mean_does_not_move_the_rocking_range() -> None:
    """The angle counts less its mean, so the gradient by the mean is zero, and that by a cosine is not."""
    motion, basis = wheels(N, 4), Basis.of(PERIOD, 4, uniform(PERIOD, 40))
    angles = motion.at(basis)
    swing = basis.value[:, 1:] @ motion.waves[:, 1:].T
    flat = Rows.of(np.zeros_like(swing))
    rows = hinge_rows(Bounds(angle=(0.4,) * N), angles, swing, flat, motion.winding)["angle"]
    gradient = gauss_newton_sums([rows], basis, N, np.zeros(6, dtype=bool)).gradient.reshape(N, -1)
    assert not gradient[:, 0].any()
    assert abs(gradient[:, 1]).min() > 0.0


def test_hinges_of_the_bias() -> None:
    """Six rows of their own; a limit of zero makes the component no unknown, so it has no row."""
    bounds = Bounds(bias=(1e-3, 1e-3, 0.0, 0.1, 0.1, 0.1))
    rows, slopes = bias_hinges(bounds, np.array([2e-3, -2e-3, 5.0, 0.05, -0.1, 0.0]))
    assert rows == pytest.approx([RHO * (2 - KNEE)] * 2 + [0, 0, RHO * (1 - KNEE), 0])
    assert slopes == pytest.approx([RHO / 1e-3, -RHO / 1e-3, 0, 0, -RHO / 0.1, 0])


def test_what_is_exceeded_is_told_by_flywheel_value_and_time() -> None:
    """The worst of each flywheel and kind, the worst first; nothing else."""
    stand, motion, at = setting()
    t = np.linspace(0.0, 1.1, 12)
    angles, tau = Angles(*motion[3:]), linear(at, *motion[3:]).tau
    found = exceeded_bounds(ALL, stand, t, angles, motion.phi, tau, np.zeros(6))
    assert [each.ratio for each in found] == sorted((each.ratio for each in found), reverse=True)
    by = {(each.kind, each.of): each for each in found}
    names = [s.name for s in stand.flywheels]
    for s in range(N):
        worst = int(np.argmax(abs(motion.phi_ddot[:, s])))
        each = by.pop(("acceleration", names[s]))
        assert each.value == abs(motion.phi_ddot[worst, s]) and each.time == t[worst] and each.limit == 500.0
        assert f"{each.value:.6g} rad/s^2" in each.words and names[s] in each.words
    assert ("speed_min", names[1]) not in by
    wide = Bounds(speed=(1e9,) * N, acceleration=(1e9,) * N, torque=(1e9,) * N)
    assert exceeded_bounds(wide, stand, t, angles, motion.phi, tau, np.zeros(6)) == ()
    (one,) = exceeded_bounds(
        Bounds(bias=(1e-3,) * 6), stand, t, angles, motion.phi, tau, np.array([0, 0, 2e-3, 0, 0, 0])
    )
    assert (one.kind, one.of, one.time) == ("bias", "z", None) and one.ratio == pytest.approx(2.0)


def test_a_flywheel_that_turns_back_has_stood_still() -> None:
    """A least speed is missed between the samples where the sign changes."""
    stand, *_ = setting()
    speed = np.tile([20.0, 20.0, 20.0], (4, 1))
    speed[2:, 1] *= -1.0
    angles = Angles(speed * 0, speed, speed * 0)
    (one,) = exceeded_bounds(Bounds(speed_min=(5.0,) * N), stand, np.arange(4.0), angles, speed, speed, np.zeros(6))
    assert (one.of, one.value, one.time) == (stand.flywheels[1].name, 0.0, 1.0)


def test_utilisation_is_one_at_the_limit() -> None:
    """The largest of all; of a least speed above one where it is missed."""
    flat = np.ones((4, N))
    angles = Angles(flat, 20.0 * flat, 100.0 * flat)
    none, zero, turns = np.zeros((4, N)), np.zeros(6), np.ones(N)
    assert utilisation(Bounds(), angles, none, none, zero, turns) == 0.0
    assert utilisation(Bounds(acceleration=(100.0, 400.0, 400.0)), angles, none, none, zero, turns) == 1.0
    assert utilisation(Bounds(speed_min=(20.0, 0.0, 10.0)), angles, none, none, zero, turns) == 1.0
    assert utilisation(Bounds(speed_min=(20.0, 0.0, 10.0)), angles, none, none, zero, -turns) > 2.0
