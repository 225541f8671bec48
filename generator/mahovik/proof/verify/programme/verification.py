"""Verification of a programme: all items that it must pass (docs/programmes.md), in order."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mahovik.core.motion.programme import Angles, Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.verify.programme.finding import (
    Finding,
    Tolerance,
    motion_finding,
    same_flywheels,
    stand_finding,
    tolerance_for,
)
from mahovik.proof.verify.programme.mechanics import residual_finding, residuals, scale_of
from mahovik.proof.verify.programme.programme_c import compiled_findings
from mahovik.proof.verify.programme.runup import runup_findings
from mahovik.proof.verify.programme.simulation import floquet_finding, simulation_finding
from mahovik.proof.verify.programme.slew import motor_findings, motor_torques, slew_findings
from mahovik.proof.verify.programme.table import (
    bias_findings,
    bound_findings,
    rocking_of,
    slowest_finding,
    start_findings,
    table_findings,
    winding_finding,
)

FINER_ANGLES = 8
"""Ratio of the grid for angles to that of the residual: angles are cheap."""


def verify_programme(
    stand: Stand,
    motion: RequiredMotion,
    programme: Programme,
    *,
    tolerance: float | None = None,
    against: Path | None = None,
    name: str = "programme",
) -> tuple[Finding, ...]:
    """Findings, one an item; the programme is right where all have passed. If the carrier does not follow the
    motion, stability and run-ups are not examined.

    `tolerance`: of the residual, a share; default 1e-6, with damping of V|V| 1e-5. What is of another
    stand's flywheels or another motion's kind or period is not verified further: only that is reported.
    `against`: a folder whose C of this programme, of the `name` in C, is compiled and judged too.

    Raises UsageError, ToolchainError: the folder has no such C, or it does not compile.
    """
    with np.errstate(all="ignore"):  # what overflows is not finite, and fails
        return _findings(stand, motion, programme, tolerance_for(stand, tolerance), against, name)


def _findings(
    stand: Stand, motion: RequiredMotion, programme: Programme, limit: Tolerance, against: Path | None, name: str
) -> tuple[Finding, ...]:
    whose = [stand_finding(stand, programme), motion_finding(motion, programme)]
    same_span = programme.periodic == motion.periodic and abs(programme.span / motion.span - 1) < 1e-9
    if not same_flywheels(stand, programme) or not same_span:
        return tuple(each for each in whose if not each.passed)
    real, stand = stand, programme.planned_for(stand)
    found = [*whose, *winding_finding(motion, programme), *table_findings(programme, limit.table)]
    found += bias_findings(motion, programme)
    try:
        scale = scale_of(stand, motion, programme)
        course = residuals(stand, motion, programme, scale)
    except StateError as error:
        return (*found, Finding("residual", np.inf, limit.residual, False, str(error)))
    found.append(residual_finding(course, limit.residual))
    found.append(simulation_finding(stand, motion, programme, scale, limit.error))
    M = FINER_ANGLES * len(course.t)
    t = programme.span * np.arange(M + (not motion.periodic)) / M
    angles = Angles(*programme.at(t))
    rocking = rocking_of(programme, t, angles.phi)
    tau = course.tau if motion.slew is None else motor_torques(stand, Angles(*programme.at(course.t)), course.tau)
    found += bound_findings(motion.bounds, programme.flywheels, angles, tau, rocking)
    found += slowest_finding(motion.bounds, programme.flywheels, angles.phi_dot)
    if motion.periodic and all(each.passed for each in found if each.name in ("residual", "simulation")):
        found.append(floquet_finding(stand, motion, programme, limit.multiplier))
        found += runup_findings(stand, motion, programme, scale, limit)
    else:
        found += start_findings(motion, programme, limit.joint)
    if motion.slew is not None:
        found += slew_findings(stand, motion, programme)
        found += motor_findings(stand, course.t, Angles(*programme.at(course.t)), course.tau)
    if against is not None:
        found += compiled_findings(real, motion, programme, scale, limit.residual, against, name)
    return tuple(found)
