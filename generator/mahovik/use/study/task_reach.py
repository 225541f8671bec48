"""Do the flywheels reach the tasks of a stand? Directions of a demand out of reach, or beyond what the motors have."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.stand.model import Stand, Task
from mahovik.core.stand.state import State, rest_state
from mahovik.core.stand.task import row_name
from mahovik.proof.reference import pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Bodies, bodies_of
from mahovik.proof.reference.inverse import CUTS, least_error
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.tasks import TaskRows, scaled_task, task_rows
from mahovik.use.study.excess import POSITIONS, SMALL, shares_by

_SEED = 20
_NEGLIGIBLE = 1e-3
"""Parts of a direction below this are not named."""


@dataclass(frozen=True)
class Shortfall:
    """A direction of a task's demand that the flywheels cannot give, or not with what they have.

    task       its name
    rows       names of its rows
    direction  of the demand (m, unit length): m/s2 and rad/s2
    flywheel   that needs most; "" where no flywheel helps
    share      of what it has, for a demand of SMALL; infinite where no flywheel helps
    """

    task: str
    rows: tuple[str, ...]
    direction: tuple[float, ...]
    flywheel: str
    share: float

    def __str__(self) -> str:
        parts = [(x, row) for x, row in zip(self.direction, self.rows, strict=True) if abs(x) > _NEGLIGIBLE]
        words = parts[0][1] if len(parts) == 1 else " ".join(f"{x:+.3g} {row}" for x, row in parts)
        if not self.flywheel:
            return (
                f"task {self.task}: no flywheel moves the carrier along {words} (UNREACHABLE); remove a row, "
                "or add or turn a flywheel"
            )
        return (
            f"task {self.task}: {SMALL:g} m/s2 or rad/s2 along {words} alone needs {self.share:.3g} times what "
            f"{self.flywheel} has (EXCESSIVE); remove the row, or add or turn a flywheel"
        )


def task_shortfalls(stand: Stand) -> list[Shortfall]:
    """At most one of each task: a direction out of reach at all tried positions, else the row that needs most.

    At rest, at seeded positions of the flywheels; a row needs too much if it does in most of them.
    """
    if not stand.tasks:
        return []
    bodies, rng = bodies_of(stand), np.random.default_rng(_SEED)
    still, n = rest_state(stand), len(stand.flywheels)
    states = [replace(still, phi=tuple(rng.uniform(-np.pi, np.pi, n))) for _ in range(POSITIONS)]
    found = (_shortfall(stand, task, states, bodies) for task in stand.tasks)
    return [each for each in found if each is not None]


def _shortfall(stand: Stand, task: Task, states: list[State], bodies: Bodies) -> Shortfall | None:
    places = [pieces(stand, state, bodies) for state in states]
    rows = [task_rows(at, stand, task) for at in places]
    missing = [_missing(at, row) for at, row in zip(places, rows, strict=True)]
    names = tuple(map(row_name, task.rows))
    if all(each is not None for each in missing):
        assert missing[0] is not None
        return Shortfall(task.name, names, tuple(map(float, missing[0])), "", np.inf)
    needed = np.median([_needed_share(stand, at, row) for at, row in zip(places, rows, strict=True)], axis=0)
    i, s = divmod(int(np.argmax(needed)), len(stand.flywheels))
    if not needed[i, s] > 1.0:
        return None
    direction = tuple(float(i == k) for k in range(len(names)))
    return Shortfall(task.name, names, direction, stand.flywheels[s].name, float(needed[i, s]))


def _missing(at: Pieces, rows: TaskRows) -> Array | None:
    """The demand (m, unit length, largest part positive) that is least reached, if it is not reached at all."""
    m = len(rows.S)
    asked = scaled_task(at, rows, np.zeros(m))
    U, sigma, _ = np.linalg.svd(asked.W)
    if len(sigma) == m and sigma[-1] > CUTS.rank:  # sigma is a ratio of energies: 1 would be all of a flywheel's
        return None
    direction = np.linalg.solve(asked.root, U[:, -1])
    largest = direction[np.argmax(np.abs(direction))]
    return np.asarray(np.sign(largest) * direction / np.linalg.norm(direction), dtype=np.float64)


def _needed_share(stand: Stand, at: Pieces, rows: TaskRows) -> Array:
    """Share (m x N) of what each flywheel has, for SMALL of each row, beyond what no demand needs."""
    m = len(rows.S)
    still = least_error(scaled_task(at, rows, rows.s)).phi_ddot
    found = [least_error(scaled_task(at, rows, rows.s + SMALL * unit)).phi_ddot - still for unit in np.eye(m)]
    shares = shares_by(stand, at)
    return np.array([shares(phi_ddot) for phi_ddot in found])
