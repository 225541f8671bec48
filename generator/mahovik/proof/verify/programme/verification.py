"""Verification of a programme: all items that it must pass (docs/programmes.md), in order."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.core.motion.programme import Programme, Samples
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.programme.compiled import compiled_checks
from mahovik.proof.verify.programme.items import (
    Tolerance,
    as_item,
    bias_checks,
    bound_checks,
    check,
    motion_check,
    rocking_of,
    slowest_checks,
    stand_check,
    start_checks,
    table_checks,
    tolerance_for,
    winding_checks,
)
from mahovik.proof.verify.programme.mechanics import Residuals, Scale, multipliers, residuals, scale_of, simulate, twist
from mahovik.proof.verify.programme.transitions import motor_checks, motor_torques, runup_checks, slew_checks

FINER_ANGLES = 8
"""Ratio of the grid for angles to that of the residual: angles are cheap."""

STEPS_OF_SPAN = 32
"""Least number of steps in a span: the error estimate of a step misses jumps of phi's third derivative at rows."""

FURTHEST = 100.0
"""Largest distance from the required motion, in amplitudes, at which the simulation goes on."""


@dataclass
class Stability(Check):
    """The item Floquet: `value` is the largest modulus of the multipliers, which are all there, the largest first."""

    multipliers: tuple[complex, ...] = ()


def verify_programme(
    stand: Stand,
    motion: RequiredMotion,
    programme: Programme,
    *,
    tolerance: float | None = None,
    against: Path | None = None,
    name: str = "programme",
) -> tuple[Check, ...]:
    """Checks, one an item; the programme is right where none has failed. If the carrier does not follow the
    motion, stability and run-ups are not examined.

    `tolerance`: of the residual, a share; default 1e-6, with damping of V|V| 1e-5. What is of another
    stand's flywheels or another motion's kind or period is not verified further: only that is reported.
    `against`: a folder whose C of this programme, of the `name` in C, is compiled and judged too.

    Raises UsageError, ToolchainError: the folder has no such C, or it does not compile.
    """
    limit = tolerance_for(stand, tolerance)
    owner = [stand_check(stand, programme), motion_check(motion, programme)]
    same_span = programme.periodic == motion.periodic and abs(programme.span / motion.span - 1) < 1e-9
    same_size = len(programme.bias) == coordinates_of(stand).count
    if not same_span or not same_size or programme.flywheels != tuple(s.name for s in stand.flywheels):
        return tuple(item for item in owner if item.failed)
    with np.errstate(all="ignore"):  # what overflows is not finite, and fails
        planned_for = programme.planned_for(stand)
        items = [*owner, *winding_checks(motion, programme), *table_checks(programme, limit.table)]
        items += bias_checks(motion, programme)
        try:
            scale = scale_of(planned_for, motion, programme)
            course = residuals(planned_for, motion, programme, scale)
        except StateError as error:
            return (*items, check("residual", np.inf, limit.residual, str(error)))
        items += _mechanics(planned_for, motion, programme, scale, course, limit)
        if against is not None:
            items += compiled_checks(stand, motion, programme, scale, limit.residual, against, name)
    return tuple(items)


def _mechanics(
    stand: Stand, motion: RequiredMotion, programme: Programme, scale: Scale, course: Residuals, limit: Tolerance
) -> list[Check]:
    """Items that need the equations: residual, simulation, bounds, stability and run-ups, or start and slew."""
    items = [residual_check(course, limit.residual), simulation_check(stand, motion, programme, scale, limit.error)]
    follows = not any(item.failed for item in items)
    M = FINER_ANGLES * len(course.t)
    t = programme.span * np.arange(M + (not motion.periodic)) / M
    angles, speeds, tau = programme.at(t), programme.at(course.t).phi_dot, course.tau
    if motion.slew is not None:
        tau = motor_torques(stand, speeds, tau)[0]
    items += bound_checks(motion.bounds, programme.flywheels, angles, tau, rocking_of(programme, t, angles.phi))
    items += slowest_checks(motion.bounds, programme.flywheels, angles.phi_dot)
    if motion.periodic and follows:
        items.append(stability_check(stand, motion, programme, limit.multiplier))
        items += runup_checks(stand, motion, programme, scale, limit)
    else:
        items += start_checks(motion, programme, limit.joint)
    if motion.slew is not None:
        items += [*slew_checks(stand, motion, programme), *motor_checks(stand, speeds, course.tau)]
    return items


def residual_check(course: Residuals, limit: float) -> Check:
    """The largest residual of (12), relative."""
    i = int(np.argmax(course.residual))
    value = float(course.residual[i])
    words = f"of (12), at {len(course.t)} times; largest at t = {course.t[i]:.6g} s"
    if course.mean > 0.5 * value and value > 0.1 * limit:
        words += f"; mean {course.mean:.2g}, which nothing balances: the carrier drifts"
    return check("residual", value, limit, words)


def simulation_check(stand: Stand, motion: RequiredMotion, programme: Programme, scale: Scale, limit: float) -> Check:
    """The carrier's distance from the required motion over one span, from the required state at t = 0."""
    t, rows = np.linspace(0.0, programme.span, 16 * max([*motion.harmonics, 12]) + 1), False
    if motion.slew is not None and isinstance(programme.course, Samples):
        t, rows = programme.course.t, True  # its torques bend within a hundredth of the time
    course = motion.at(t, programme.bias)
    start, longest = np.concatenate([course.q[0], course.q_dot[0]]), programme.span / STEPS_OF_SPAN
    furthest = np.inf if rows else FURTHEST
    try:
        y = simulate(stand, programme.at, start, t, scale, longest, furthest=furthest, rows=rows)
    except StateError as error:
        return check("simulation", np.inf, limit, str(error))
    apart = np.hsplit(y, 2)[0] - course.q
    shares = [scale.displacement_share(twist(stand, q, x)) for q, x in zip(course.q, apart, strict=True)]
    i, coordinates = int(np.argmax(shares)), coordinates_of(stand)
    if stand.hold is None:
        away = f"O1 {1e3 * np.linalg.norm(apart[i, :3]):.2g} mm, angles {1e3 * np.linalg.norm(apart[i, 3:]):.2g} mrad"
    else:
        parts = zip(coordinates.names, np.abs(apart[i]), coordinates.unit_names, strict=True)
        away = ", ".join(f"{name} {1e3 * x:.2g}{f' m{unit}' if unit else 'e-3'}" for name, x, unit in parts)
    words = f"of (8) from the required state: largest at t = {t[i]:.6g} s, {away} away"
    return check("simulation", float(shares[i]), limit, words)


def stability_check(stand: Stand, motion: RequiredMotion, programme: Programme, limit: float) -> Check:
    """The largest multiplier. Above 1 the motion is right, but something must hold it: a warning, no failure."""
    try:
        found = multipliers(stand, motion, programme)
    except StateError as error:
        return check("Floquet", np.inf, limit, str(error))
    value = abs(found[0])
    if value > limit:
        words = "largest multiplier: the motion is right, but not stable without feedback"
    elif value > 2 - limit:
        # of modulus 1, one that is 1 itself keeps a displacement, any other one turns it on
        kept = [abs(z - 1) <= limit - 1 for z in found if abs(z) > 2 - limit]
        fates = [*(["is free to drift"] if any(kept) else []), *([] if all(kept) else ["swings undamped"])]
        words = f"largest multiplier: neutral, the carrier {' and '.join(fates)}"
    else:
        words = f"largest multiplier: stable, disturbances decay by {value:.3g} a period"
    return Stability("", "Floquet", limit, value, "ok" if np.isfinite(value) else "FAILED", words, 1, multipliers=found)


def floquet_multipliers(items: Sequence[Check]) -> list[list[float]] | None:
    """The Floquet multipliers among checks, real and imaginary part each; None: they have none."""
    found = [[z.real, z.imag] for item in items if isinstance(item, Stability) for z in item.multipliers]
    return found or None


def checks_object(stand: str, motion: str, items: Sequence[Check]) -> dict[str, Any]:
    """All checks for JSON; `floquet` is null if there are no multipliers."""
    return {
        "stand": stand,
        "motion": motion,
        "passed": not any(item.failed for item in items),
        "findings": [as_item(item) for item in items],
        "floquet": floquet_multipliers(items),
    }
