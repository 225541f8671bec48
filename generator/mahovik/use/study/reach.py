"""What small demands on the carrier need of the flywheels: of (12) as a whole, and of the tasks of a stand.

Far more than any motor has means that (12) is singular in practice; a direction that no flywheel moves is out of reach.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.stand.model import COMPONENTS, Stand, Task
from mahovik.core.stand.state import State, rest_state
from mahovik.core.stand.task import row_name
from mahovik.proof.reference import pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Bodies, bodies_of
from mahovik.proof.reference.inverse import CUTS, inverse_root, least_error, shares_of
from mahovik.proof.reference.motion import forward, torque
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.tasks import TaskRows, scaled_task, task_rows

_NEGLIGIBLE = 1e-3
"""Parts of a direction below this are not named."""

SMALL = 1e-3
"""m/s2, rad/s2: what is demanded of one component, of the others zero."""

POSITIONS = 5
"""Positions of the flywheels, at rest, over which the median is taken."""

_SEED, _TASK_SEED = 12, 20


@dataclass(frozen=True)
class Excess:
    """The component whose small demand needs most: median over positions of the flywheels.

    component  of V*: vx vy vz wx wy wz
    flywheel   that needs most
    share      of what it has: 8.1e4 is eighty-one thousand times
    phi_ddot   its acceleration, rad/s2
    """

    component: str
    flywheel: str
    share: float
    phi_ddot: float

    def __str__(self) -> str:
        unit = "m/s2" if self.component.startswith("v") else "rad/s2"
        return (
            f"(12) is singular in practice: {SMALL:g} {unit} of {self.component} alone, all else at rest, needs "
            f"{self.phi_ddot:.3g} rad/s2 of {self.flywheel}, {self.share:.3g} times what it has (EXCESSIVE); name the "
            'rows that you need, [task.pointing] rows = ["wx", "wy", "wz"], and ask the task'
        )


def excess(stand: Stand) -> Excess | None:
    """What (12) needs at most for a small demand, if this is more than there is in most positions; else None.

    None of a held carrier, which (12) does not ask for all six components, nor of a stand whose tasks name what is
    asked.
    """
    if not stand.flywheels or stand.hold is not None or stand.tasks:
        return None
    bodies = bodies_of(stand)
    rng = np.random.default_rng(_SEED)
    still = rest_state(stand)
    needs = np.zeros((POSITIONS, 6, len(stand.flywheels), 2))
    for k in range(POSITIONS):
        at = pieces(stand, replace(still, phi=tuple(rng.uniform(-np.pi, np.pi, len(stand.flywheels)))), bodies)
        shares, by_demand = shares_by(stand, at), _inverse_matrix(at)
        for i in range(6):
            # what gravity alone asks is no part of the demand
            phi_ddot = -SMALL * by_demand @ at.K[:, i]
            needs[k, i, :, 0] = shares(phi_ddot)
            needs[k, i, :, 1] = np.abs(phi_ddot)
    needed = np.sort(needs, axis=0)[POSITIONS // 2]  # np.median would import numpy.ma
    i, s = divmod(int(np.argmax(needed[:, :, 0])), len(stand.flywheels))
    share, phi_ddot = needed[i, s]
    if not share > 1.0:
        return None
    return Excess(COMPONENTS[i], stand.flywheels[s].name, float(share), float(phi_ddot))


def _inverse_matrix(at: Pieces) -> Array:
    """phi'' of (12) by its right-hand side (N, 6): least residual, then least phi'', as `inverse` has them."""
    K_root, root = inverse_root(at.K), 1.0 / np.sqrt(np.diag(at.Theta_ff))
    return np.asarray(root[:, None] * np.linalg.pinv(K_root @ at.I * root, rcond=CUTS.rank) @ K_root)


def shares_by(stand: Stand, at: Pieces) -> Callable[[Array], Array]:
    """Need of each flywheel over what it has (N), as `shares_of`, by phi'' (N) with the motion that it makes.

    The drive torques are linear in both: tau = tau_0 + I^T V* + Theta_ff phi''.
    """
    still = torque(at, np.zeros(6), np.zeros(len(stand.flywheels)))

    def shares(phi_ddot: Array) -> Array:
        tau = still + at.I.T @ forward(at, phi_ddot) + np.diag(at.Theta_ff) * phi_ddot
        return shares_of(stand, at, tau, phi_ddot)

    return shares


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
    bodies, rng = bodies_of(stand), np.random.default_rng(_TASK_SEED)
    still, n = rest_state(stand), len(stand.flywheels)
    states = [replace(still, phi=tuple(rng.uniform(-np.pi, np.pi, n))) for _ in range(POSITIONS)]
    result = (_shortfall(stand, task, states, bodies) for task in stand.tasks)
    return [shortfall for shortfall in result if shortfall is not None]


def _shortfall(stand: Stand, task: Task, states: list[State], bodies: Bodies) -> Shortfall | None:
    places = [pieces(stand, state, bodies) for state in states]
    rows = [task_rows(at, stand, task) for at in places]
    missing = [_missing(at, row) for at, row in zip(places, rows, strict=True)]
    names = tuple(map(row_name, task.rows))
    if all(vector is not None for vector in missing):
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
    needed_share = [least_error(scaled_task(at, rows, rows.s + SMALL * unit)).phi_ddot - still for unit in np.eye(m)]
    shares = shares_by(stand, at)
    return np.array([shares(phi_ddot) for phi_ddot in needed_share])
