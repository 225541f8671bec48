"""A slew: from rest to rest by demanded rows alone, the attitude, or a line of sight; what no row names is free."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.required.bounds import Bounds
from mahovik.core.stand.mean import Unbalance
from mahovik.core.stand.model import COMPONENTS, Stand, Task, Vec3
from mahovik.core.stand.task import places_of, row_vector

Array = NDArray[np.float64]
Kind = Literal["attitude", "sight", "still"]
Goal = Literal["fastest", "quietest"]


@dataclass(frozen=True, eq=False)
class Slew:
    """A turn of the carrier from rest to rest, demanded by the rows of a task.

    task      its rows; angular rows are turned along the path, linear ones have no acceleration
    kind      attitude: three angular rows; sight: two of one frame, whose third axis is the line of sight; still: none
    start     C (3, 3) of E1 in E0 at t = 0, at rest, O1 at `position` (m, in E0)
    axis      (3): about which E1 turns, constant in E1 (attitude), or the line of sight, in E1 (sight)
    normal    (3): of the plane in which the line of sight turns, in E0; of a slew of the attitude `start axis`
    angle     of the turn, rad, at most pi; 0 of kind still
    goal      fastest: free duration; quietest: of the given `duration` (s)
    phi, phi_dot   N: angles and speeds of the flywheels at t = 0, rad, rad/s
    bounds    speed, acceleration, torque of the flywheels; the motors' limits hold besides
    unbalance averaged: planned on the mean stand; resisted: the flywheels move so that unbalance does not move the rows
    doubts    warnings on numbers of the file, a line each
    """

    name: str
    task: Task
    kind: Kind
    start: Array
    position: Vec3
    axis: Array
    normal: Array
    angle: float
    goal: Goal
    duration: float | None
    phi: tuple[float, ...]
    phi_dot: tuple[float, ...]
    bounds: Bounds
    unbalance: Unbalance = "averaged"
    doubts: tuple[str, ...] = ()

    @property
    def periodic(self) -> bool:
        """A slew is finite."""
        return False

    def path(self, sigma: Array) -> Array:
        """Rotations (M, 3, 3) in E0 that turn what is demanded by sigma (M, rad) from the start."""
        from scipy.spatial.transform import Rotation

        return np.asarray(Rotation.from_rotvec(sigma[:, None] * self.normal).as_matrix())


def rows_of(stand: Stand, task: Task) -> Array:
    """S (m, 6) of a task: what its rows take of V*."""
    places = places_of(stand.instruments, stand.points)
    return np.array([row_vector(row, places) for row in task.rows])


def kind_of(task: Task, S: Array) -> Kind | str:
    """The kind of slew of a task's rows, S (m, 6); words where they make none."""
    angular = [row for row in task.rows if row.component.startswith("w")]
    if not angular:
        return "still"
    turned = S[[row.component.startswith("w") for row in task.rows], 3:]
    if len(angular) == 3:
        return "attitude"
    if len(angular) == 2 and angular[0].of == angular[1].of:
        return "sight"
    if len(angular) == 2:
        return "two angular rows of different frames have no line of sight: give both of one frame, or three"
    assert len(turned) == 1
    return "one angular row alone has no end: give three, or two of one frame, whose third axis is the line of sight"


def sight_of(task: Task, stand: Stand) -> Array:
    """The line of sight in E1 (3): the axis that no angular row of the frame names."""
    angular = [row for row in task.rows if row.component.startswith("w")]
    named = {COMPONENTS.index(row.component) - 3 for row in angular}
    (left,) = {0, 1, 2} - named
    axes = places_of(stand.instruments, stand.points)[angular[0].of][1] if angular[0].of else np.eye(3)
    return np.asarray(axes[:, left])
