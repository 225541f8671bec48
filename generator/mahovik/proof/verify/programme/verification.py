"""All that a returned programme must pass (planning.md), in order."""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.programme import Angles, Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.verify.programme import floquet, identity, limits, residual, runup, simulation, table
from mahovik.proof.verify.programme.finding import Finding, Tolerance, tolerance_for
from mahovik.proof.verify.programme.scale import scale_of

FINER_ANGLES = 8
"""Times the grid of the residual: angles cost nothing."""


def verify_programme(
    stand: Stand, motion: RequiredMotion, programme: Programme, *, tolerance: float | None = None
) -> tuple[Finding, ...]:
    """Findings, one an item; the programme is right where all have passed. Of a carrier that does not follow the
    motion, stability along it and run-ups into it are not asked.

    `tolerance`: of the residual, a share; default 1e-6, with damping of V|V| 1e-5. What is of another
    stand's flywheels or another motion's kind or period is not tried: only that is said.
    """
    with np.errstate(all="ignore"):  # what overflows is not finite, and fails
        return _findings(stand, motion, programme, tolerance_for(stand, tolerance))


def _findings(stand: Stand, motion: RequiredMotion, programme: Programme, limit: Tolerance) -> tuple[Finding, ...]:
    whose = [identity.stand_finding(stand, programme), identity.motion_finding(motion, programme)]
    same_span = programme.periodic == motion.periodic and abs(programme.span / motion.span - 1) < 1e-9
    if not identity.same_flywheels(stand, programme) or not same_span:
        return tuple(each for each in whose if not each.passed)
    found = [*whose, *limits.winding_finding(motion, programme), *table.findings(programme, limit.table)]
    found += limits.bias_findings(motion, programme)
    try:
        scale = scale_of(stand, motion, programme)
        along = residual.along(stand, motion, programme, scale)
    except StateError as error:
        return (*found, Finding("residual", np.inf, limit.residual, False, str(error)))
    found.append(residual.finding(along, limit.residual))
    found.append(simulation.finding(stand, motion, programme, scale, limit.error))
    M = FINER_ANGLES * len(along.t)
    t = programme.span * np.arange(M + (not motion.periodic)) / M
    angles = Angles(*programme.at(t))
    rocking = limits.rocking_of(programme, t, angles.phi)
    found += limits.bound_findings(motion.bounds, programme.flywheels, angles, along.tau, rocking)
    found += limits.slowest_finding(motion.bounds, programme.flywheels, angles.phi_dot)
    if motion.periodic and all(each.passed for each in found if each.name in ("residual", "simulation")):
        found.append(floquet.finding(stand, motion, programme, limit.multiplier))
        found += runup.findings(stand, motion, programme, scale, limit)
    else:
        found += limits.start_findings(motion, programme, limit.joint)
    return tuple(found)
