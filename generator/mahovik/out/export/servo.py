"""C of a programme's tables and the servos that follow it: computed gains, a checked sampled loop, an example."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.emit.generate import PRECISIONS
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.servo import ServoPrinter, ServoTables
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.servo import ServoForm, TrimForm, lower_servo
from mahovik.core.lower.servo_golden import golden
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Servo
from mahovik.core.program.function import Program
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure
from mahovik.errors import UsageError
from mahovik.out.export.programme import ProgrammeExport, check_belongs, export_programme
from mahovik.use.control.servo import Margins, check_margins, delay, gains, rotor_inertia, samples
from mahovik.use.control.trim import TrimDesign, design_trim, trim_members
from mahovik.use.numeric.frame import Frame
from mahovik.use.numeric.se3 import Array
from mahovik.use.simulate.held import home

PERIODS = 10
"""Periods of the example's run."""


@dataclass(frozen=True)
class ExportedServo:
    """Files of the servo and of its programme by name; messages, one line each; program, form, numbers."""

    servo: dict[str, str]
    programme: ProgrammeExport
    lines: tuple[str, ...]
    program: Program
    form: ServoForm
    tables: ServoTables
    margins: Margins


def export_servo(
    stand: Stand,
    programme: Programme,
    motion: RequiredMotion | None,
    servo: Servo,
    real: str = "double",
    kind: str = "quintic",
    sources: tuple[str, str] = ("programme", "servo"),
    called: str = "programme",
) -> ExportedServo:
    """C of a programme and of the servos that follow it.

    `sources` name programme and servo in messages; `called` names the programme in C, and so its servo.

    CheckError: the sampled loop is not stable with enough margin, the programme is not accurate enough, or stand,
    programme and motion do not belong together. UsageError: torques or a trim without the motion.
    """
    if motion is None and (servo.feedforward or servo.trim is not None):
        what = "feedforward" if servo.feedforward else "trim"
        raise UsageError(
            f"{sources[1]}: {what}: needs the motion of the programme: give motion=MOTION.json, or {what} = false"
        )
    check_belongs(stand, programme, motion, sources[0])
    margins = check_margins(stand, servo, sources[1])
    ticks, periods = samples(servo, programme.span, sources[1])
    layout = Layout(structure(stand), PRECISIONS[real])
    trim, design, lines = None, None, servo_messages(stand, servo, margins, ticks, periods)
    if servo.trim is not None and motion is not None:
        made = design_trim(stand, motion, programme, servo.trim)
        trim = TrimForm(servo.trim.coordinates, servo.trim.harmonics, stand.hold is not None)
        design = trim_members(made, motion, programme, servo.period)
        lines = (*lines, trim_message(made, stand))
    tabled = export_programme(stand, programme, motion, kind, real=real, source=sources[0], called=called)
    form = ServoForm(layout.count, trim)
    program = lower_servo(layout, form)
    values = gains(stand, servo, programme.span)
    tables = ServoTables(
        values, design, servo.period, ticks, periods, lines, _loop(stand, layout, programme, motion, servo)
    )
    answers = golden(program, form, values, design)
    files = ServoPrinter(stand, program, form, tables).files(answers, servo.name, called)
    return ExportedServo(files, tabled, lines, program, form, tables, margins)


def servo_messages(stand: Stand, servo: Servo, margins: Margins, ticks: int, periods: int) -> tuple[str, ...]:
    """Messages about the computed servo, one line each."""
    J, late = rotor_inertia(stand), delay(stand, servo)
    parts = [f"bandwidth {_hertz(servo.bandwidth)}, damping ratio {servo.damping_ratio:g}"]
    parts += [] if servo.integral is None else [f"integral {_hertz(servo.integral)}"]
    parts += [] if servo.speed_filter is None else [f"speed filter {_hertz(servo.speed_filter)}"]
    less = "" if math.isinf(margins.less) else f" up, {margins.less:.1f} down"
    lines = [
        f"servo: {', '.join(parts)}; rotors of {J.min():.4g} to {J.max():.4g} kg m2",
        f"servo: {servo.period * 1e3:g} ms per sample, {late * 1e3:g} ms of delay; {ticks} samples are {periods} "
        f"period{'s' if periods > 1 else ''}",
        f"servo: stable, largest pole {margins.radius:.4f}; gain margin {margins.gain:.1f}{less}, phase margin "
        f"{margins.phase:.0f} deg, {margins.delay * 1e3:.2f} ms of further delay; on this carrier rotors are up to "
        f"{margins.lightness:.3f} times as light",
    ]
    return tuple(lines)


def trim_message(made: TrimDesign, stand: Stand) -> str:
    """Message: the trim's corrections, and their speed."""
    trim = made.trim
    names = ", ".join(coordinates_of(stand).in_words[i] for i in trim.coordinates)
    alone = ""
    if stand.hold is not None and made.undamped:
        alone = "; warning: no friction or damping settles the carrier, and the corrections alone take its swing away"
    return (
        f"trim: {trim.harmonics} harmonic{'s' * (trim.harmonics > 1)} of {names}, {made.rank} directions; a round of "
        f"{trim.settling + trim.averaging} periods leaves {made.radius:.3f} of an error, by the nominal model{alone}"
    )


def _loop(
    stand: Stand, layout: Layout, programme: Programme, motion: RequiredMotion | None, servo: Servo
) -> dict[str, Any]:
    """Data of the example besides tables: initial state of the carrier, delays, duration."""

    def literals(values: Any) -> str:
        return ", ".join(real_literal(float(v), layout.precision) for v in values)

    begun = _begin_held(stand, programme, motion) if stand.hold is not None else _begin_free(programme, motion)
    wait = math.floor(servo.latency / servo.period + 1e-9)
    part = max(0.0, servo.latency - wait * servo.period)
    part = part if part > 1e-9 * servo.period else 0.0
    count = math.floor(programme.span / servo.period * (PERIODS if programme.periodic else 1))
    last = math.floor(programme.span / servo.period * (PERIODS - 1 if programme.periodic else 0.9))
    return {
        "motion": programme.motion,
        "cyclic": programme.periodic,
        "torque": motion is not None,
        "feedforward": servo.feedforward,
        "wait": wait,
        "before": real_literal(part, layout.precision) if part else "",
        "after": real_literal(servo.period - part, layout.precision),
        "held": stand.hold is not None,
        **{name: literals(values) for name, values in begun.items()},
        "measured": "" if servo.trim is None else ", ".join(map(str, servo.trim.coordinates)),
        "wrench": 6 * len(layout.inputs),
        "samples": count,
        "last": last,
    }


def _begin_free(programme: Programme, motion: RequiredMotion | None) -> dict[str, Array]:
    """q, q_dot (6 each; m, rad) of a free carrier at phase 0; zero where the motion is unknown."""
    if motion is None:
        return {"q": np.zeros(6), "q_dot": np.zeros(6)}
    course = motion.at(np.zeros(1), programme.bias)
    return {"q": course.q[0], "q_dot": course.q_dot[0]}


def _begin_held(stand: Stand, programme: Programme, motion: RequiredMotion | None) -> dict[str, Array]:
    """position (3, m), attitude (4), V (6) of a held carrier at phase 0; at rest at home without the motion."""
    if motion is None:
        at = home(stand)
        return {"position": np.array(at.position), "attitude": np.array(at.quaternion), "V": np.zeros(6)}
    course = motion.at(np.zeros(1), programme.bias)
    C, O1, V, *_ = Frame.of(stand).twists(course)
    return {"position": O1[0], "attitude": Rotation.from_matrix(C[0]).as_quat(scalar_first=True), "V": V[0]}


def _hertz(omega: float) -> str:
    return f"{omega / (2 * math.pi):.4g} Hz"
