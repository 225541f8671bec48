"""Panels of a programme: the carrier's required and achieved motion, speeds, torques, residual; run-up, run-down."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.core.motion.functions import Angles
from mahovik.core.motion.programme import Programme
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.out.report.plot.panel import Array, Panel, family, limit
from mahovik.proof.verify.programme.mechanics import simulate
from mahovik.proof.verify.programme.verification import ProgrammeCase

if TYPE_CHECKING:
    from mahovik.core.motion.required import Each, RequiredMotion
    from mahovik.core.stand.model import Stand

POINTS = 400
"""Along each line of a programme."""

OF_TURN = 24
"""Points in a turn or a period of the fastest part, along the way of a carrier that runs up."""

ROUNDING = 1e-6
"""mm, mrad: less is not looked at closely."""

NEAR = 0.3
"""A bound is drawn where the lines reach this share of it."""


def panels(
    programme: Programme, stand: Stand | None = None, motion: RequiredMotion | None = None, times: int | None = None
) -> list[Panel]:
    """All that can be shown: motion, torques and residual need the stand and the motion. Raises StateError.

    `times` of the residual and the torques; None: 20 a node of the programme.
    """
    t = np.linspace(0.0, programme.span, POINTS + 1)
    found = programme.at(t)
    if stand is None or motion is None:
        return [*_wheels(programme, t, found, None), *_transients(programme)]
    case = ProgrammeCase.of(stand, motion, programme)
    seen = case.residuals(times)
    residual = family(("of (12), relative",), seen.t, np.maximum(seen.residual, 1e-17)[:, None])
    level = case.limit.residual
    return [
        *_carrier(case, t),
        *_wheels(programme, t, found, motion),
        _flywheel_panel("drive torque, N m", programme, seen.t, seen.tau, motion.bounds.torque),
        Panel("residual", (*residual, limit(f"accepted: {level:g}", seen.t, level)), log=True),
        *_transients(programme),
        *(_carrier_on_the_way(case) if stand.hold is not None else ()),
    ]


def _carrier(case: ProgrammeCase, t: Array) -> list[Panel]:
    """The carrier by (8) from the required state at t = 0, beside what is required; each less its mean."""
    stand, programme = case.stand, case.programme
    course = case.motion.at(t, programme.bias)
    y = simulate(stand, programme.at, case.start, t, case.scale, programme.span / 16)
    mean = course.q[:-1].mean(axis=0)
    required, achieved = 1e3 * (course.q - mean), 1e3 * (y[:, : len(mean)] - mean)
    own, found = coordinates_of(stand), []
    for group in own.groups:
        part, unit = list(group), own.unit_names[group[0]]
        words = (
            {"m": "O1, mm", "rad": "attitude, mrad"}[unit]
            if not own.held
            else f"carrier, {f'm{unit}' if unit else '1e-3'}"
        )
        lines = family([own.names[k] for k in group], t, achieved[:, part])
        wanted = family([""] * len(group), t, required[:, part], dashed=True)
        found.append(Panel(f"{words}, about the mean; dashed: required", (*lines, *wanted), least=ROUNDING))
    return found


def _wheels(programme: Programme, t: Array, angles: Angles, motion: RequiredMotion | None) -> list[Panel]:
    bounds = motion.bounds if motion is not None else None
    speed = bounds.speed if bounds is not None else None
    acceleration = bounds.acceleration if bounds is not None else None
    return [
        _flywheel_panel("speed, rpm", programme, t, RPM * angles.phi_dot, speed, RPM),
        _flywheel_panel("acceleration, rad/s2", programme, t, angles.phi_ddot, acceleration),
    ]


def _flywheel_panel(
    quantity: str, programme: Programme, t: Array, columns: Array, bound: Each, unit: float = 1.0
) -> Panel:
    """One line per flywheel; the bound, where it is the same for all."""
    lines = family(programme.flywheels, t, columns)
    if bound is None or len(set(bound)) > 1:
        return Panel(quantity, lines)
    level = unit * bound[0]
    found = [limit("", t, sign * level) for sign in (1, -1) if (sign * columns).max(initial=0.0) > NEAR * level]
    return Panel(quantity, (*lines, *found), note=f"bound: {level:.6g}")


def _transients(programme: Programme) -> list[Panel]:
    """Speeds from rest, and back to it."""
    found = []
    for name, table in (("run-up", programme.runup), ("run-down", programme.rundown)):
        if table is not None:
            t = np.linspace(0.0, table.duration, POINTS + 1)
            found.append(Panel(f"{name}: speed, rpm", family(programme.flywheels, t, RPM * table.at(t).phi_dot)))
    return found


def _carrier_on_the_way(case: ProgrammeCase) -> list[Panel]:
    """A held carrier along its freedoms by (8) on run-up and run-down, from the mean pose. Raises StateError."""
    found: list[Panel] = []
    motion, programme, own = case.motion, case.programme, coordinates_of(case.stand)
    mean = motion.mean + programme.bias
    fastest = max([1, *motion.harmonics, *map(abs, programme.winding)])
    for name, table in (("run-up", programme.runup), ("run-down", programme.rundown)):
        if table is None:
            continue
        count = max(POINTS, round(OF_TURN * fastest * table.duration / programme.span))
        t = np.linspace(0.0, table.duration, count + 1)
        y = case.run_up(name, t, 16)
        for group in own.groups:
            part, unit = list(group), own.unit_names[group[0]]
            words = f"{name}: carrier, {f'm{unit}' if unit else '1e-3'}, from the mean pose"
            away = 1e3 * (y[:, part] - mean[part])
            found.append(Panel(words, family([own.names[k] for k in part], t, away), least=ROUNDING))
    return found
