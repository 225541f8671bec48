"""The carrier's course under given flywheel motions by collocation, solved by Newton's method for all times at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.errors import StateError
from mahovik.use.plan.array import Array
from mahovik.use.plan.forward.chart import Chart
from mahovik.use.plan.forward.collocation import Eliminated, integrate, split_blocks
from mahovik.use.plan.forward.drive import Drive
from mahovik.use.plan.residual import Linear, linear
from mahovik.use.plan.residual.prescribed import prescribed_at

_STEPS = np.array([1e-6] * 6 + [1e-5] * 6)
"""Steps of central differences: m, rad, m/s, rad/s."""
_MOST = 24
"""Most corrections; a few are usual."""
_SLOW = 0.3
"""If a correction leaves more than this part of the error, the equations are linearised again."""
_TOO_FAR = 2.0
"""rad: a carrier that turns further is lost, near the edge of its chart."""


@dataclass(frozen=True, eq=False)
class Course:
    """y (M, 12) at uniform nodes, and the linear equations near it."""

    y: Array
    near: Eliminated


def course(chart: Chart, given: Drive, spacing: float, start: Array, guess: Array, near: Eliminated | None) -> Course:
    """The course from `start` (12) under the flywheels' motion at 4 B + 1 nodes `spacing` (s) apart.

    guess   (M, 12): a nearby course; `near`: its linear equations. The collocation equations are solved to rounding.
    Raises StateError if the carrier moves so violently that no course is found.
    """
    y = guess.copy()
    before = np.inf
    for _ in range(_MOST):
        if not np.all(np.isfinite(y)) or np.abs(y[:, 3:6]).max() > _TOO_FAR:
            break
        if near is None:
            near = linearise(chart, given, spacing, y)
        at = split_blocks(y)
        defects = at[:, :1] - at[:, 1:] + integrate(chart.rate(given, y), spacing)
        step = near.solve(defects[..., None], (start - y[0])[:, None])[:, :, 0]
        y = y + step
        size = float(np.abs(step).max() / np.abs(y).max())
        if size < 1e-11:
            return Course(y, near)
        if size > _SLOW * before and size > 1e-10:
            near, before = None, np.inf
        else:
            before = size
    raise StateError("the carrier moves too violently: its course cannot be computed")


def linearise(chart: Chart, given: Drive, spacing: float, y: Array) -> Eliminated:
    """Linear equations near a course y (M, 12), by central differences at all nodes."""
    columns = []
    for i, step in enumerate(_STEPS):
        aside = np.zeros(12)
        aside[i] = step
        columns.append((chart.rate(given, y + aside) - chart.rate(given, y - aside)) / (2.0 * step))
    return Eliminated.of(np.stack(columns, axis=2), spacing)


def linearise_along(chart: Chart, given: Drive, y: Array, phi_ddot: Array) -> Linear:
    """R = 0, tau and their exact derivatives by phi, phi', phi'' along states y (M, 12); phi'' (M, N)."""
    at = chart.twists(y)
    V_r_dot = at.V_r_dot + chart.acceleration(given, y)
    moving = prescribed_at(chart.mechanics, at._replace(V_r_dot=V_r_dot))
    return linear(moving, given.phi, given.phi_dot, phi_ddot)


def acceleration_rates(given: Drive, found: Linear) -> tuple[Array, Array, Array]:
    """Change of V* by phi, phi', phi'' of each flywheel (M, 6, N each), with the carrier's state fixed."""
    return given.inverse @ found.by_phi, given.inverse @ found.by_phi_dot, given.inverse @ found.by_phi_ddot
