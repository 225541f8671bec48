"""Inverse problem of a task: flywheel accelerations for chosen components a = S V* + s of the carrier's motion.

What no row names is free: V* = K^-1 (b - I phi'') - d with b = F - M V_r - J phi' and d = (omega x C^T u, 0), so that
S K^-1 I phi'' = S (K^-1 b - d) + s - a.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import COMPONENTS, Stand, Task
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, Values, solve_symmetric, vector
from mahovik.proof.reference.excess import motor_shares, with_excess
from mahovik.proof.reference.forward import bias, forward
from mahovik.proof.reference.inverse import CUTS, Cuts, inverse_root, status_names
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.points import point_transfers
from mahovik.proof.reference.screw import cross


@dataclass(frozen=True, eq=False)
class TaskRows:
    """a = S V* + s: S (mx6) constant, s (m) at one state; m/s2 and rad/s2."""

    S: Array
    s: Array

    def acceleration(self, V_dot: Array) -> Array:
        """a (m) of a motion V_dot (6)."""
        return self.S @ V_dot + self.s


@dataclass(frozen=True, eq=False)
class TaskInverse:
    """Answer of a task.

    phi_ddot (N, rad/s2), V_dot (6) that results, residual (m): demand minus reached, sigma (min(m, N)), rank; status:
    names joined by |, EXCESSIVE not among them.
    """

    phi_ddot: Array
    V_dot: Array
    residual: Array
    sigma: Array
    rank: int
    status: str


def task_of(stand: Stand, name: str) -> Task:
    """The task of a name. Raises StateError."""
    for task in stand.tasks:
        if task.name == name:
            return task
    raise StateError(f'task: unknown "{name}", the stand has {", ".join(task.name for task in stand.tasks) or "none"}')


def task_rows(at: Pieces, stand: Stand, task: Task) -> TaskRows:
    """Rows of a task: of O1 the components of V*, of a point those of its acceleration relative to E0, in its axes.

    With L of the point, V_p* = L^T V* are the derivatives of the components of its twist V_p = L^T V = (v, omega), and
    its acceleration is (V_p* + omega x v): hence s.
    """
    transfers: Mapping[str, Array] = dict(point_transfers(stand))
    S, s = np.zeros((len(task.rows), 6)), np.zeros(len(task.rows))
    for i, row in enumerate(task.rows):
        k = COMPONENTS.index(row.component)
        if not row.of:
            S[i, k] = 1.0
            continue
        L = transfers[row.of]
        S[i] = L[:, k]
        if k < 3:
            V_p = L.T @ at.V
            s[i] = (cross(V_p[3:]) @ V_p[:3])[k]
    return TaskRows(S, s)


@dataclass(frozen=True, eq=False)
class TaskDemand:
    """The task's equation A phi'' = c, A = S K^-1 I (mxN), c (m), in the norm of G^-1, G = S K^-1 S^T (mxm).

    G_root (mxm) is G^-1/2: R^-T of K^-1/2 S^T = Q R, which loses no digits to the squares in G.
    """

    rows: TaskRows
    A: Array
    c: Array
    G: Array
    G_root: Array


def task_demand(at: Pieces, rows: TaskRows, demand: Array) -> TaskDemand:
    """S K^-1 I phi'' = S (K^-1 b - d) + s - a for the demand a (m)."""
    b = at.F - bias(at)
    d = at.stream_rate()
    to_motion = np.array([solve_symmetric(at.K, row) for row in rows.S])  # S K^-1
    c = to_motion @ b - rows.S @ d + rows.s - demand
    R = np.asarray(np.linalg.qr(inverse_root(at.K) @ rows.S.T, mode="r"), dtype=np.float64)
    return TaskDemand(rows, to_motion @ at.I, c, to_motion @ rows.S.T, np.asarray(np.linalg.inv(R.T), dtype=np.float64))


def task_inverse(at: Pieces, rows: TaskRows, demand: Array, cuts: Cuts = CUTS, rank: int | None = None) -> TaskInverse:
    """Least error of the demand a (m) in the norm of G^-1, then least phi'' in the norm of Theta_ff.

    By the singular values of G^-1/2 S K^-1 I Theta_ff^-1/2. `rank`: how many of them count, where that is given.
    """
    asked = task_demand(at, rows, demand)
    G_root, Theta_root = asked.G_root, inverse_root(at.Theta_ff)
    U, sigma, Vt = np.linalg.svd(G_root @ asked.A @ Theta_root.T, full_matrices=False)
    if rank is None:
        rank = int(np.sum(sigma > cuts.rank * sigma[0])) if sigma.size else 0
    phi_ddot = Theta_root.T @ (Vt[:rank].T @ ((U[:, :rank].T @ G_root @ asked.c) / sigma[:rank]))
    V_dot = forward(at, phi_ddot)
    residual = demand - rows.acceleration(V_dot)
    least = min(len(demand), len(at.flywheels))
    names = status_names(G_root @ asked.c, G_root @ residual, sigma, rank, least, cuts)
    return TaskInverse(phi_ddot, V_dot, residual, sigma, rank, names)


def answer(at: Pieces, stand: Stand, state: State, cuts: Cuts = CUTS) -> Values:
    """phi_ddot (N), V_dot (6), residual (m), sigma (min(m, N)), rank, status of the state's task. Raises StateError."""
    task = task_of(stand, state.task)
    if len(state.demand) != len(task.rows):
        raise StateError(f"demand: expected {len(task.rows)} numbers, found {len(state.demand)}")
    found = task_inverse(at, task_rows(at, stand, task), vector(state.demand), cuts)
    needed = motor_shares(stand, at, found.V_dot, found.phi_ddot)
    return dict(vars(found)) | {"status": with_excess(found.status, needed)}
