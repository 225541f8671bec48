"""Derivatives of R of (12) and of drive torques by design, against differences of stands built with changed data."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from mahovik.core.stand.model import Flywheel, MountingAxes, Stand
from mahovik.core.stand.random import BARE, EVERYTHING, SEQUENCES, Features
from mahovik.use.plan.residual import PARAMETERS, Mechanics, by_design, prescribe, residual, torques
from mahovik.use.plan.residual.spatial import mount_axes
from plan.courses import RandomCourse, random_course
from toolchain.quick import quick

Array = NDArray[np.float64]
KINDS = [replace(EVERYTHING, angles=s) for s in SEQUENCES] + [BARE, Features(), Features()]
ENTRIES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def shifted(x: Any, i: int, by: float) -> Any:
    """A vector with one element changed."""
    return tuple(value + by * (k == i) for k, value in enumerate(x))


def tilted(wheel: Flywheel, i: int, angle: float) -> Flywheel:
    """Turned about its own axis i, by Rodrigues' formula."""
    e = np.eye(3)[i]
    S = np.cross(e, np.eye(3)).T
    C = mount_axes(wheel) @ (np.eye(3) + np.sin(angle) * S + (1 - np.cos(angle)) * S @ S)
    return replace(wheel, mounting=MountingAxes(tuple(C[:, 0]), tuple(C[:, 1])))


def heavier(wheel: Flywheel, i: int, by: float) -> Flywheel:
    """With an entry of its tensor changed, and its mirror."""
    J = np.array(wheel.inertia)
    row, column = ENTRIES[i]
    J[row, column] += by
    J[column, row] = J[row, column]
    (a, b, c), (d, e, f), (g, h, i_) = J.tolist()
    return replace(wheel, inertia=((a, b, c), (d, e, f), (g, h, i_)))


def changed(wheel: Flywheel, k: int, by: float) -> Flywheel:
    """The flywheel with parameter k changed, as a builder would."""
    kinds: tuple[tuple[int, Callable[[int], Flywheel]], ...] = (
        (0, lambda i: replace(wheel, position=shifted(wheel.position, i, by))),
        (3, lambda i: tilted(wheel, i, by)),
        (6, lambda i: replace(wheel, mass=wheel.mass + by)),
        (7, lambda i: replace(wheel, center_of_mass=shifted(wheel.center_of_mass, i, by))),
        (10, lambda i: heavier(wheel, i, by)),
    )
    first, change = [each for each in kinds if each[0] <= k][-1]
    return change(k - first)


def answers(stand: Stand, motion: RandomCourse) -> tuple[Array, Array]:
    """R (M, 6) and tau (M, N) of a stand built with changed data."""
    at = prescribe(Mechanics.of(stand), motion.course)
    return residual(at, *motion[3:]), torques(at, *motion[3:])


@pytest.mark.parametrize("number", quick(4, range(8)))
def test_derivatives_by_design_are_those_of_differences(number: int) -> None:
    """All parameters of all flywheels of stands of all kinds: central differences of the rebuilt stand."""
    stand, mechanics, motion = random_course(300 + number, 2, KINDS[number % len(KINDS)], M=3)
    found = by_design(prescribe(mechanics, motion.course), motion.course, 0.0, *motion[3:])
    assert found.R.shape == (3, 6, 2, len(PARAMETERS))
    step = 1e-4  # the residual is at most quadratic in all but the turns
    for s, wheel in enumerate(stand.flywheels):
        for k, name in enumerate(PARAMETERS):
            around = []
            for sign in (1.0, -1.0):
                wheels = list(stand.flywheels)
                wheels[s] = changed(wheel, k, sign * step)
                around.append(answers(replace(stand, flywheels=tuple(wheels)), motion))
            by_R, by_tau = ((a - b) / (2 * step) for a, b in zip(*around, strict=True))
            size = max(abs(by_R).max(), abs(answers(stand, motion)[0]).max())
            assert abs(found.R[:, :, s, k] - by_R).max() <= 1e-7 * size, name
            assert abs(found.tau[:, s, k] - by_tau[:, s]).max() <= 1e-7 * size, name
            assert abs(np.delete(by_tau, s, axis=1)).max() <= 1e-7 * size, name
