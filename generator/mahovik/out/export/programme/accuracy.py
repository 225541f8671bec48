"""Drive torques of a programme, and how far its tables, as the emitted C evaluates them, are from it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.lower.programme import Course
from mahovik.core.lower.programme_play import Player
from mahovik.core.motion.functions import Angles
from mahovik.core.motion.programme import RunUpTable
from mahovik.core.program.types import Precision
from mahovik.out.export.programme.tables import Array, Table
from mahovik.proof.verify.programme.compiled import spread_phases
from mahovik.proof.verify.programme.mechanics import torques_along
from mahovik.proof.verify.programme.verification import ProgrammeCase

STEP_ERROR = 1e-7
"""Error per step of the simulated run-up, in amplitudes: enough for feedforward torques."""


def free_torques(case: ProgrammeCase, table: RunUpTable, up: bool, t: Array) -> Array:
    """Drive torques (M, N; N m) of a run-up, or run-down, at rising times t (M, s).

    The carrier is free: (8) from rest at its equilibrium, or from the required state at t = 0. StateError: there is
    no equilibrium, or the simulation stops.
    """
    times = np.unique(np.concatenate([[0.0], t]))
    y = case.run_up("run-up" if up else "run-down", times, 8, STEP_ERROR)
    return torques_along(case.stand, y[np.searchsorted(times, t)], table.at(t))


POINTS = 1024
"""Times at which a table is compared."""

WRENCHES = 100
"""Times among them at which the reference is evaluated."""


@dataclass(frozen=True)
class Errors:
    """Largest differences between a table and its programme.

    phi, phi_dot, phi_ddot   rad, s
    relative   of phi'' + phi'^2, the force of an unbalance, with the angle's error turning this force; relative to its
               largest value
    tau, tau_peak   of the drive torques, and the largest torque, N m; None without torques
    given, added    relative residual of the programme, and the part added by the table; None for a run-up, or without a
                    motion
    """

    phi: float
    phi_dot: float
    phi_ddot: float
    relative: float
    tau: float | None = None
    tau_peak: float | None = None
    given: float | None = None
    added: float | None = None

    @property
    def decisive(self) -> float:
        """The error that is compared with the limit."""
        return self.relative if self.added is None else self.added


def errors(
    player: Player, course: Course, table: Table, precision: Precision, prescribed: ProgrammeCase | None
) -> Errors:
    """Errors of one table; the wrench is evaluated for the programme only, whose carrier moves as prescribed."""
    phases = np.array([float(precision.scalar(x)) for x in spread_phases(POINTS)])
    t = phases * table.span
    played = player.many(course, list(phases))
    truth = table.at(t)
    angle = played["phi"] - truth.phi
    angle -= 2 * np.pi * np.round(angle / (2 * np.pi))
    speed, acceleration = played["phi_dot"] - truth.phi_dot, played["phi_ddot"] - truth.phi_ddot
    force = np.hypot(truth.phi_ddot, truth.phi_dot**2)
    wrong = np.abs(acceleration) + 2 * np.abs(truth.phi_dot * speed) + force * np.abs(angle)
    largest, fastest, hardest = (float(np.max(np.abs(array))) for array in (angle, speed, acceleration))
    relative = float(np.max(wrong)) / max(float(np.max(force)), np.finfo(np.float64).tiny)
    if table.torques is None:
        return Errors(largest, fastest, hardest, relative)
    some = np.linspace(0, POINTS - 1, WRENCHES).astype(int)
    tau = table.torques(t[some])
    wrong_tau, peak = float(np.max(np.abs(played["tau"][some] - tau))), float(np.max(np.abs(tau)))
    if prescribed is None:
        return Errors(largest, fastest, hardest, relative, wrong_tau, peak)
    exact = Angles(*(array[some] for array in truth))
    R, _ = prescribed.equations(t[some], exact)
    tabled, _ = prescribed.equations(t[some], _angles(played, some))
    return Errors(
        largest,
        fastest,
        hardest,
        relative,
        wrong_tau,
        peak,
        given=float(np.max(prescribed.scale.wrench_share(R))),
        added=float(np.max(prescribed.scale.wrench_share(tabled - R))),
    )


def _angles(angles: dict[str, Array], some: Array) -> Angles:
    return Angles(*(angles[name][some] for name in ("phi", "phi_dot", "phi_ddot")))
