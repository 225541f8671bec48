"""What small demands on the carrier need of the flywheels: of (12) as a whole, and of the tasks of a stand.

Far more than any motor has means that (12) is singular in practice; a direction that no flywheel moves is out of reach.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.stand.coordinates import row_name
from mahovik.core.stand.model import COMPONENTS, Stand, Task, TaskRow, rest_state
from mahovik.proof.reference import pieces
from mahovik.proof.reference.algebra import Array
from mahovik.proof.reference.inverse import CUTS, TaskRows, least_error, scaled_task, shares_of, task_rows
from mahovik.proof.reference.motion import forward, torque
from mahovik.proof.reference.pieces import Pieces, bodies_of

WHOLE = Task("", tuple(TaskRow("", component) for component in COMPONENTS))
"""(12) as a whole, a task of all six components of V*."""

_NEGLIGIBLE = 1e-3
"""Parts of a direction below this are not named."""

SMALL = 1e-3
"""m/s2, rad/s2: what is demanded of one row, of the others zero."""

POSITIONS = 5
"""Positions of the flywheels, at rest, over which the median is taken."""

_SEED = 20


@dataclass(frozen=True)
class Shortfall:
    """A direction of a demand that the flywheels cannot give, or not with what they have.

    task       its name; "" of (12) as a whole
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
        needs = f"{SMALL:g} m/s2 or rad/s2 along {words} alone needs {self.share:.3g} times what {self.flywheel} has"
        if self.task:
            return f"task {self.task}: {needs} (EXCESSIVE); remove the row, or add or turn a flywheel"
        return (
            f"(12) is singular in practice: {needs} (EXCESSIVE); name the rows that you need, "
            '[task.pointing] rows = ["wx", "wy", "wz"], and ask the task'
        )


def excess(stand: Stand) -> Shortfall | None:
    """What (12) needs most for a small demand, if this is more than there is in most positions; else None.

    None of a held carrier, which (12) does not ask for all six components, nor of a stand whose tasks name what is
    asked.
    """
    if not stand.flywheels or stand.hold is not None or stand.tasks:
        return None
    return next(_shortfalls(stand, [WHOLE]), None)


def task_shortfalls(stand: Stand) -> list[Shortfall]:
    """At most one of each task: a direction out of reach at all tried positions, else the row that needs most.

    At rest, at seeded positions of the flywheels; a row needs too much if it does in most of them.
    """
    return list(_shortfalls(stand, stand.tasks))


def _shortfalls(stand: Stand, tasks: Sequence[Task]) -> Iterator[Shortfall]:
    """Those of some tasks; of (12) as a whole without directions out of reach, which few flywheels always leave."""
    bodies, rng, still, n = bodies_of(stand), np.random.default_rng(_SEED), rest_state(stand), len(stand.flywheels)
    phases = [tuple(rng.uniform(-np.pi, np.pi, n)) for _ in range(POSITIONS)]
    places = [pieces(stand, replace(still, phi=phi), bodies) for phi in phases] if tasks else []
    for task in tasks:
        rows, names = [task_rows(at, stand, task) for at in places], tuple(map(row_name, task.rows))
        missing = [_missing(at, row) for at, row in zip(places, rows, strict=True)] if task.name else [None]
        if missing[0] is not None and all(vector is not None for vector in missing):
            yield Shortfall(task.name, names, tuple(map(float, missing[0])), "", np.inf)
            continue
        needs = [_needed_share(stand, at, row) for at, row in zip(places, rows, strict=True)]
        needed = np.sort(needs, axis=0)[POSITIONS // 2]  # np.median would import numpy.ma
        i, s = divmod(int(np.argmax(needed)), n)
        if needed[i, s] > 1.0:
            direction = tuple(float(i == k) for k in range(len(names)))
            yield Shortfall(task.name, names, direction, stand.flywheels[s].name, float(needed[i, s]))


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
    """Share (m x N) of what each flywheel has, for SMALL of each row, beyond what no demand needs.

    The drive torques are linear in the motion that a flywheel makes: tau = tau_0 + I^T V* + Theta_ff phi''.
    """
    m, none = len(rows.S), np.zeros(len(stand.flywheels))
    still, at_rest = least_error(scaled_task(at, rows, rows.s)).phi_ddot, torque(at, np.zeros(6), none)

    def shares(demand: Array) -> Array:
        phi_ddot = least_error(scaled_task(at, rows, rows.s + demand)).phi_ddot - still
        tau = at_rest + at.I.T @ forward(at, phi_ddot) + np.diag(at.Theta_ff) * phi_ddot
        return shares_of(stand, at, tau, phi_ddot)

    return np.array([shares(SMALL * unit) for unit in np.eye(m)])
