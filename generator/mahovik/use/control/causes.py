"""Causes of following errors: the same run with causes switched off, and with one cause alone."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from mahovik.core.stand.model import Flywheel, Stand
from mahovik.errors import MahovikError
from mahovik.use.control.finite import errors_of
from mahovik.use.control.loop import Case, close_loop
from mahovik.use.control.reference_motion import ReferenceMotion

FASTER = 4
"""Sampling is switched off by this many samples in place of one, without latency."""

SETTLING, MEASURED = 10, 10
"""Periods of each run before the error is measured, and during the measurement."""


@dataclass(frozen=True)
class Cause:
    """`without`: the case with this cause switched off; None if the case does not have it."""

    name: str
    words: str
    without: Callable[[Case], Case | None]


@dataclass(frozen=True)
class Contribution:
    """Relative error of the run with a cause alone, and of the run without it; None: the run failed."""

    cause: Cause
    alone: float | None
    without: float | None


def contributions(case: Case, tell: Callable[[str], None] | None = None) -> list[Contribution]:
    """Contributions of all causes present, largest first. The trim is off, since it would hide them.

    Runs start from the settled motion; those of a finite programme as the case does. `tell` receives the name of each
    cause before its runs.
    """
    own = replace(case.servo, trim=None)
    base = replace(case, design=None, servo=own)
    if case.reference.programme.periodic:
        base = replace(base, periods=SETTLING + MEASURED, start="settled")
    there = [cause for cause in CAUSES if cause.without(base) is not None]
    found = []
    for cause in there:
        if tell is not None:
            tell(cause.name)
        others = [each for each in there if each is not cause]
        found.append(Contribution(cause, _error(_switch_off(base, others)), _error(_switch_off(base, [cause]))))
    return sorted(found, key=lambda each: -math.inf if each.alone is None else -each.alone)


def _switch_off(case: Case, causes: list[Cause]) -> Case:
    for cause in causes:
        changed = cause.without(case)
        case = case if changed is None else changed
    return case


def _error(case: Case) -> float | None:
    try:
        record = close_loop(case)
        if record.interrupted:
            raise KeyboardInterrupt
        return None if record.stopped is not None else errors_of(record, MEASURED).share
    except MahovikError:
        return None


def _no_mismatch(case: Case) -> Case | None:
    nominal = _with_wheels(case.reference.stand, case.real)
    return None if case.real == nominal else replace(case, real=nominal)


def _no_sampling(case: Case) -> Case | None:
    return replace(case, servo=replace(case.servo, period=case.servo.period / FASTER, latency=0.0))


def _no_encoder(case: Case) -> Case | None:
    there = case.servo.encoder == "stand" and any(s.encoder is not None for s in case.real.flywheels)
    return replace(case, servo=replace(case.servo, encoder="ideal")) if there else None


def _no_friction(case: Case) -> Case | None:
    there = any(s.motor is not None and (s.motor.viscous or s.motor.coulomb) for s in case.real.flywheels)
    if not there:
        return None

    def smooth(s: Flywheel) -> Flywheel:
        return s if s.motor is None else replace(s, motor=replace(s.motor, viscous=0.0, coulomb=0.0))

    real = replace(case.real, flywheels=tuple(map(smooth, case.real.flywheels)))
    return replace(case, real=real, servo=replace(case.servo, friction=False))


def _no_limits(case: Case) -> Case | None:
    servo = case.servo
    finite = any(map(math.isfinite, (*servo.torque_limit, *servo.torque_rate)))
    if not finite and all(s.motor is None or s.motor.torque is None for s in case.real.flywheels):
        return None

    def strong(s: Flywheel) -> Flywheel:
        return s if s.motor is None else replace(s, motor=replace(s.motor, torque=None, speed=None))

    endless = (math.inf,) * len(servo.torque_limit)
    real = replace(case.real, flywheels=tuple(map(strong, case.real.flywheels)))
    return replace(case, real=real, servo=replace(servo, torque_limit=endless, torque_rate=endless))


def _no_table(case: Case) -> Case | None:
    wanted = case.reference
    if wanted.programme is wanted.exact:
        return None
    return replace(case, reference=ReferenceMotion(wanted.stand, wanted.motion, wanted.exact, wanted.exact))


def _with_wheels(stand: Stand, real: Stand) -> Stand:
    """The stand of the file with the motors of the real one, which other causes may have changed."""
    pairs = zip(stand.flywheels, real.flywheels, strict=True)
    return replace(stand, flywheels=tuple(replace(a, motor=b.motor) for a, b in pairs))


CAUSES = (
    Cause("mismatch", "the stand differs a little from its file", _no_mismatch),
    Cause("sampling", "torques are held over a sample, and late", _no_sampling),
    Cause("encoders", "counts, and their latency", _no_encoder),
    Cause("friction", "of the motors, including what is compensated", _no_friction),
    Cause("limits", "of torques, by motors and servo", _no_limits),
    Cause("table", "the programme between its nodes", _no_table),
)
