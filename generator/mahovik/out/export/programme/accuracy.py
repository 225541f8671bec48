"""Differences of tables, as the emitted C evaluates them, from their programme."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.lower.programme.play import Player
from mahovik.core.lower.programme.program import Course
from mahovik.core.motion.programme import Angles
from mahovik.core.program.types import Precision
from mahovik.out.export.programme.carrier import Array, Prescribed
from mahovik.out.export.programme.tables import Table

POINTS = 1024
"""Times at which a table is compared, spread by the golden ratio, so that they fall everywhere between nodes."""

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
    def judged(self) -> float:
        """The error that is compared with the limit."""
        return self.relative if self.added is None else self.added


def errors(player: Player, course: Course, table: Table, precision: Precision, prescribed: Prescribed | None) -> Errors:
    """Errors of one table; the wrench is evaluated for the programme only, whose carrier moves as prescribed."""
    spread = np.sort((np.arange(1.0, POINTS + 1.0) * (np.sqrt(5.0) - 1.0) / 2.0) % 1.0)
    phases = np.array([float(precision.scalar(x)) for x in spread])
    t = phases * table.span
    found = player.many(course, list(phases))
    truth = table.at(t)
    angle = found["phi"] - truth.phi
    angle -= 2 * np.pi * np.round(angle / (2 * np.pi))
    speed, acceleration = found["phi_dot"] - truth.phi_dot, found["phi_ddot"] - truth.phi_ddot
    force = np.hypot(truth.phi_ddot, truth.phi_dot**2)
    wrong = np.abs(acceleration) + 2 * np.abs(truth.phi_dot * speed) + force * np.abs(angle)
    largest, fastest, hardest = (float(np.max(np.abs(each))) for each in (angle, speed, acceleration))
    relative = float(np.max(wrong)) / max(float(np.max(force)), np.finfo(np.float64).tiny)
    if table.torques is None:
        return Errors(largest, fastest, hardest, relative)
    some = np.linspace(0, POINTS - 1, WRENCHES).astype(int)
    tau = table.torques(t[some])
    wrong_tau, peak = float(np.max(np.abs(found["tau"][some] - tau))), float(np.max(np.abs(tau)))
    if prescribed is None:
        return Errors(largest, fastest, hardest, relative, wrong_tau, peak)
    exact = Angles(*(each[some] for each in truth))
    R = prescribed.residual(t[some], exact)
    tabled = prescribed.residual(t[some], _angles(found, some))
    return Errors(
        largest,
        fastest,
        hardest,
        relative,
        wrong_tau,
        peak,
        given=prescribed.relative(R),
        added=prescribed.relative(tabled - R),
    )


def _angles(found: dict[str, Array], some: Array) -> Angles:
    return Angles(*(found[name][some] for name in ("phi", "phi_dot", "phi_ddot")))
