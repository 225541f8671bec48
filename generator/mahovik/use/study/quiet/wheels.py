"""Momentum of a set of flywheels: speeds that hold it, speeds that hold none, and the limits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import rest_state
from mahovik.errors import CheckError, UsageError
from mahovik.proof.reference import pieces
from mahovik.proof.reference.screw import f
from mahovik.use.study.quiet.options import QuietOptions

Array = NDArray[np.float64]
RANK = 1e-9
"""Part of the largest singular value below which one is zero."""


@dataclass(frozen=True, eq=False)
class Wheels:
    """axes (3 x N): mean angular momentum in E1 of unit speeds, spin inertia by spin axis, kg m2.

    nullspace (N x d): orthonormal; speeds without momentum. momentum (3, N m s): the required one.
    start (N, rad/s): speeds that hold it, nearest to the given ones.
    moved (rad/s): distance of `start` from the given speeds.
    """

    names: tuple[str, ...]
    axes: Array
    nullspace: Array
    momentum: Array
    start: Array
    moved: float
    limit: Array

    @staticmethod
    def of(stand: Stand, options: QuietOptions) -> Wheels:
        """Wheels of a stand for some options. Raises UsageError: too few flywheels, momentum out of their axes' span.

        CheckError: the momentum needs more than the limits.
        """
        N = len(stand.flywheels)
        axes = momentum_axes(stand)
        left, sizes, right = np.linalg.svd(axes)
        rank = int(np.sum(sizes > RANK * sizes[0])) if N else 0
        if rank >= N or N < 2:
            raise UsageError(
                f"{stand.name}: {N} flywheels with spin axes of rank {rank} leave no speeds free; "
                f"expected {rank + 1} or more"
            )
        nullspace = right[rank:].T
        given = None if options.speeds is None else np.array(options.speeds)
        momentum = axes @ given if options.momentum is None and given is not None else np.array(options.momentum)
        outside = float(np.linalg.norm(left[:, rank:].T @ momentum))
        if outside > 1e-9 * max(float(np.linalg.norm(momentum)), 1e-30):
            raise UsageError(
                f"{stand.name}: --momentum: {outside:.4g} N m s of it are across all spin axes (rank {rank}): "
                f"no speeds hold it"
            )
        begin = np.zeros(N) if given is None else given
        start = begin + np.linalg.pinv(axes, rcond=RANK) @ (momentum - axes @ begin)
        moved = 0.0 if given is None else float(np.abs(start - given).max())
        names = tuple(s.name for s in stand.flywheels)
        found = Wheels(names, axes, nullspace, momentum, start, moved, limits(stand, options))
        found.check_reach()
        return found

    def check_reach(self) -> None:
        """Check that some speeds within the limits hold the momentum. Raises CheckError."""
        least, speeds = self.least_load()
        if least > 1.0 + 1e-9:
            worst = int(np.argmax(np.abs(speeds) / self.limit))
            raise CheckError(
                f"momentum out of reach: it needs {least:.4g} times the speed limits, at best {self.names[worst]} at "
                f"{rpm(abs(speeds[worst])):.5g} rpm (limit {rpm(self.limit[worst]):.5g} rpm)"
            )

    def least_load(self) -> tuple[float, Array]:
        """The least t for which speeds |phi'_s| <= t limit_s hold the momentum, and those speeds."""
        finite = np.isfinite(self.limit)
        if not finite.any():
            return 0.0, self.start
        N = len(self.start)
        bound = np.where(finite, self.limit, 0.0)[finite]
        rows = np.eye(N)[finite]
        cost = np.append(np.zeros(N), 1.0)
        upper = np.vstack([np.column_stack([rows, -bound]), np.column_stack([-rows, -bound])])
        scale = float(np.abs(self.axes).max())
        equal, right = np.column_stack([self.axes / scale, np.zeros(3)]), self.momentum / scale
        free: Any = [(None, None)] * N + [(0.0, None)]
        found = linprog(cost, upper, np.zeros(len(upper)), equal, right, free, method="highs")
        if found.x is None:  # rank below 3: some rows depend on others, up to rounding
            return float((np.abs(self.start[finite]) / bound).max()), self.start
        return float(found.x[-1]), np.asarray(found.x[:N])


def momentum_axes(stand: Stand) -> Array:
    """3 x N: spin inertia along the spin axis, in E1. The mean of I_s over phase, its angular part."""
    bodies = pieces(stand, rest_state(stand)).flywheels
    columns = [s.L[3:, 3:] @ f[3:] * float(f @ s.Theta @ f) for s in bodies]
    return np.column_stack(columns) if columns else np.zeros((3, 0))


def limits(stand: Stand, options: QuietOptions) -> Array:
    """Speed limits (N, rad/s): the given limit, else the no-load speed of the motor, else none."""
    speeds = [np.inf if s.motor is None or s.motor.speed is None else s.motor.speed for s in stand.flywheels]
    own = np.array(speeds, dtype=np.float64)
    return own if options.limit is None else np.minimum(own, options.limit)


def rpm(speed: float) -> float:
    """Revolutions per minute, from rad/s."""
    return float(speed * 30.0 / np.pi)
