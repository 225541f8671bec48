"""Unknowns of a design: the stand as it is, ties, bounds; rows against differences."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.required import Bounds
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.errors import DesignError
from mahovik.use.design.freedom import PARTS, WIDTH, Freedom, Limits, Mask, Tie
from mahovik.use.design.space import Space, flywheel_numbers
from mahovik.use.design.task import Design, Task, Weighing
from mahovik.use.plan.problem import Periodic
from mahovik.use.plan.residual import Mechanics
from mahovik.use.plan.residual.spatial import mount_axes
from plan.problems import required


def all_free(stand: Stand, **more: Any) -> Freedom:
    """Everything of every flywheel, within wide bounds."""
    now = np.array([flywheel_numbers(s) for s in stand.flywheels])
    span = np.array([0.3] * 3 + [np.inf] * 2 + [1.0, np.inf, 1.0, 0.5])
    least, most = now - span, now + span
    least[:, 5:] = np.maximum(least[:, 5:], [0.0, -np.inf, 1e-2, 0.5])
    free: Mask = np.ones((len(now), WIDTH), dtype=bool)
    return replace(Freedom(least, most, free), **more)


@pytest.mark.parametrize("seed", range(4))
def test_the_stand_as_it_is_has_a_place_among_the_designs(seed: int) -> None:
    """Angles or axes, on carrier or instrument, inertia about any point: the same tables."""
    stand = random_stand(np.random.default_rng(seed), 3, EVERYTHING)
    space = Space.of(stand, all_free(stand))
    assert space.P == 3 * WIDTH
    built = space.stand_of(space.start)
    for ours, given in zip(built.flywheels, stand.flywheels, strict=True):
        assert abs(mount_axes(ours) - mount_axes(given)).max() <= 1e-14
    found, known = Mechanics.of(built).tables, Mechanics.of(stand).tables
    assert abs(found.Theta - known.Theta).max() <= 1e-13 * abs(known.Theta).max()
    assert abs(found.weight - known.weight).max() <= 1e-13 * abs(known.weight).max()


def test_ties_make_flywheels_alike() -> None:
    """Mirrored through each plane; equal in mass; a third that hangs on the second."""
    stand = random_stand(np.random.default_rng(8), 3)
    for axis, name in enumerate("xyz"):
        ties = (Tie((0, 1), ("unbalance", "mass"), name), Tie((1, 2), ("mass",), None))
        loose = all_free(stand, ties=ties)
        loose.least[:], loose.most[:] = loose.least.min(axis=0), loose.most.max(axis=0)
        loose.least[:, :3], loose.most[:, :3] = -0.3, 0.3
        space = Space.of(stand, loose)
        assert space.P == 3 * WIDTH - 5 - 3
        first, second, third = space.stand_of(space.random(np.random.default_rng(axis))).flywheels
        mirror = np.where(np.arange(3) == axis, -1.0, 1.0)
        assert np.allclose(second.position, mirror * first.position, atol=1e-15)
        assert np.allclose(mount_axes(second)[:, 0], mirror * mount_axes(first)[:, 0], atol=1e-15)
        assert first.mass == pytest.approx(second.mass) == pytest.approx(third.mass)


def test_ties_against_bounds_are_refused() -> None:
    """Mirrored places of which one is held somewhere else."""
    stand = random_stand(np.random.default_rng(3), 2)
    free = all_free(stand)
    free.least[1, PARTS["position"]] = free.most[1, PARTS["position"]] = (5.0, 5.0, 5.0)
    with pytest.raises(DesignError, match="x must be equal"):
        Space.of(stand, replace(free, ties=(Tie((0, 1), (), "x"),)))


@pytest.mark.parametrize("seed", [0, 1])
def test_rows_have_the_derivatives_of_differences(seed: int) -> None:
    """Residual, limits of the whole, bounds of the motion, cost: by every unknown."""
    stand = random_stand(np.random.default_rng(20 + seed), 2)
    bounds = Bounds(speed=(30.0,) * 2, torque=(1e-3,) * 2, acceleration=(1.0,) * 2, angle=(0.01,) * 2)
    motion = required(2, seed=seed, bounds=bounds)
    mass = sum(s.mass for s in stand.flywheels)
    ties = (Tie((0, 1), ("unbalance",), None),)
    free = all_free(stand, limits=Limits(10.0, 0.1 * mass, 1e-4), ties=ties)
    task = Task.of(stand, motion, free)
    rng = np.random.default_rng(seed)
    course = Periodic(motion.span, np.array([1.0, -1.0]), rng.normal(size=(2, 3)), np.zeros(6))
    design = Design(task.space.random(rng), course)
    weighing = Weighing(1.0, 0.7, 0.3)
    J, z = task.jacobian(design, weighing), task.pack(design)
    for k in range(len(z) - int(task.start.free.sum())):  # by the bias, rows of torque are left out: it is small
        e = 1e-6 * np.eye(len(z))[k]
        around = [task.rows(task.unpack(z + sign * e, course), weighing) for sign in (1.0, -1.0)]
        D = (around[0] - around[1]) / 2e-6
        rounding = 1e-9 * abs(around[0]).max()  # of differences of the largest rows, divided by the step
        assert abs(J[:, k] - D).max() <= 2e-5 * max(abs(D).max(), 1e-3) + rounding, k
