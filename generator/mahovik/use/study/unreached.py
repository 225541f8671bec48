"""Tasks that the flywheels cannot do: the direction in which they give nothing, at any of their positions."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand, Task
from mahovik.core.stand.state import rest_state
from mahovik.proof.reference import pieces
from mahovik.proof.reference.array import solve_symmetric
from mahovik.proof.reference.bodies import bodies_of
from mahovik.proof.reference.inverse import inverse_root
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.task import demanded, task_demand
from mahovik.use.plan.slew.missing import missing_words

Array = NDArray[np.float64]

POSITIONS = 3
"""Positions of the flywheels, at rest: what is out of reach by chance is not out of reach."""

_RANK = 1e-9
_SEED = 13


@dataclass(frozen=True)
class Unreached:
    """A task and a twist (6, in E1, the largest part 1) that it may demand and on which the flywheels do no work."""

    task: str
    twist: tuple[float, ...]

    def __str__(self) -> str:
        return (
            f"the flywheels do not reach the task {self.task}: {missing_words(np.array(self.twist))}; "
            "add or turn a flywheel, or leave rows out"
        )


def unreached(stand: Stand) -> list[Unreached]:
    """The tasks of a stand whose rows the flywheels cannot all have at once."""
    bodies, still = bodies_of(stand), rest_state(stand)
    rng = np.random.default_rng(_SEED)
    positions = [tuple(rng.uniform(-np.pi, np.pi, len(stand.flywheels))) for _ in range(POSITIONS)]
    at = [pieces(stand, replace(still, phi=phi), bodies) for phi in positions]
    found = []
    for task in stand.tasks:
        twists = [_missing(each, stand, task) for each in at]
        if all(twist is not None for twist in twists) and twists[0] is not None:
            found.append(Unreached(task.name, tuple(float(x) for x in twists[0] / np.abs(twists[0]).max())))
    return found


def _missing(at: Pieces, stand: Stand, task: Task) -> Array | None:
    """The twist K^-1 S^T w of the rows' combination w with w^T S K^-1 I = 0; None: the flywheels reach all rows."""
    rows = demanded(at, stand, task)
    asked = task_demand(at, rows, np.zeros(len(rows.S)))
    scaled = asked.G_root @ asked.A @ inverse_root(at.Theta_ff).T if len(at.flywheels) else np.zeros((len(rows.S), 0))
    U, sigma, _ = np.linalg.svd(scaled)
    if len(sigma) == len(rows.S) and sigma[-1] > _RANK * sigma[0]:
        return None
    return np.asarray(solve_symmetric(at.K, rows.S.T @ (asked.G_root.T @ U[:, -1])))
