"""Servos that make the flywheels follow a programme: what their file (TOML) requires of them, in SI.

Gains are computed from it (use/control/servo.py). All problems of the keys are found before any is reported.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Literal

from mahovik.core.motion.functions import per_flywheel
from mahovik.core.motion.laws import MAX_WRENCH
from mahovik.core.stand.coordinates import FREE
from mahovik.core.stand.fields import (
    Flag,
    Text,
    angular_speed,
    choice,
    positions,
    require_bounds,
    scalar,
    validator,
    whole_number,
)
from mahovik.core.stand.files import KINDS, TEXT, document_of, text_of
from mahovik.core.stand.hold import freedom_labels, freedom_names, has_coordinates, numbered_freedoms
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.motor import UNLIMITED
from mahovik.core.stand.tables import Alias, Context, Data, Default, Problems, QuantityValidator, keys_of
from mahovik.core.stand.units import ANGLE, PLAIN, TIME, TORQUE, Dimension, QuantityError, show
from mahovik.errors import ServoError

TORQUE_RATE = Dimension("a torque rate", "N m/s")
LEAST_PERIOD, MOST_PERIOD, MOST_LATENCY = 1e-6, 1.0, 16
"""Shortest and longest sample period, s; longest latency in sample periods."""
MOST_HARMONICS = 16
"""Most harmonics of a trim: its matrix has (2 harmonics + 1)^2 numbers for each coordinate and flywheel."""


def _coordinates(raw: Any, context: Context) -> tuple[int, ...]:
    known = context["coordinates"]
    if not isinstance(raw, list) or not raw:
        raise QuantityError(f"expected names among {', '.join(known)}, found {show(raw)}")
    return tuple(sorted(positions(raw, known)))


def _limits(dimension: Dimension) -> Any:
    """A validator of limits above 0, one for all flywheels or one for each."""
    return per_flywheel(
        dimension, lambda value, raw: require_bounds(value, dimension.si, above=0.0, most=MAX_WRENCH, raw=raw)
    )


_CORNER = validator(lambda raw: None if raw is False else angular_speed(raw))


@dataclass(frozen=True)
class Trim(Data):
    """Slow correction of the programme by measured motion of the carrier, harmonic by harmonic.

    harmonics     the mean and harmonics 1..harmonics are corrected; of a programme's period
    gain          part of the measured error that one correction removes, above 0, at most 1
    coordinates   which are measured, rising: numbers of those of a free carrier, of a held one of its freedoms
    settling      periods that the carrier has to settle after a correction
    averaging     periods over which is measured
    limit         largest magnitude of each corrected coefficient, rad
    """

    harmonics: Annotated[int, whole_number(1, MOST_HARMONICS)] = 1
    gain: Annotated[float, scalar(PLAIN, above=0.0, most=1.0)] = 0.5
    coordinates: Annotated[tuple[int, ...], QuantityValidator(_coordinates)] = ()
    settling: Annotated[int, whole_number(0, 10**6)] = 20
    averaging: Annotated[int, whole_number(1, 10**6)] = 1
    limit: Annotated[float, scalar(ANGLE, above=0.0)] = 0.5


@dataclass(frozen=True)
class Servo(Data):
    """A servo on each rotor: PI or P on the angle, P on the speed, with torques of the programme as feedforward.

    period         between samples, s
    latency        from a sample until its torque acts, s
    bandwidth      natural frequency of the loop's pair of poles, rad/s
    damping_ratio  of this pair
    integral       speed at which a steady error goes away, rad/s; None: no integral
    speed_filter   corner of a low-pass on the measured speed error, rad/s; None: none
    feedforward    are the drive torques of the programme added?
    friction       is the friction that the stand file tells made up for?
    torque_limit   of each flywheel, N m; infinite where there is none
    torque_rate    largest change of each torque in time, N m/s; infinite where there is none
    encoder        "stand": angles and speeds come from the encoders of the stand file; "ideal": they are exact
    trim           None: off
    """

    name: Annotated[Text, Default("")]
    period: Annotated[float, scalar(TIME, least=LEAST_PERIOD, most=MOST_PERIOD), Alias("sample_period")]
    latency: Annotated[float, scalar(TIME, least=0.0), Default(0.0)]
    bandwidth: Annotated[float, validator(angular_speed)]
    damping_ratio: Annotated[float, scalar(PLAIN, above=0.0, most=5.0)] = 0.8
    integral: Annotated[float | None, _CORNER] = None
    speed_filter: Annotated[float | None, _CORNER] = None
    feedforward: Flag = True
    friction: Flag = True
    torque_limit: Annotated[tuple[float, ...], _limits(TORQUE)] = ()
    torque_rate: Annotated[tuple[float, ...], _limits(TORQUE_RATE)] = ()
    encoder: Annotated[Literal["ideal", "stand"], choice("ideal", "stand")] = "ideal"
    trim: Trim | None = None


def load_servo(path: str | Path, stand: Stand) -> Servo:
    """Read and check the servo file at `path` for a stand. Raises ServoError with every problem."""
    path = Path(path)
    return read_servo(text_of(path, KINDS["servo"], TEXT, ServoError), stand, path.name)


def read_servo(text: str, stand: Stand, source: str = "servo") -> Servo:
    """Read and check a servo given as text; `source` names it in messages. Raises ServoError with every problem."""
    problems, N = Problems(source), len(stand.flywheels)
    known = FREE if stand.hold is None else tuple(freedom_names(stand.hold))
    document = document_of(text, source, ServoError, "servo", is_json=False)
    if not isinstance(off := document.get("trim", {}), dict):
        if off is not False:
            problems.add("trim", f"expected a table with {', '.join(keys_of(Trim))}, or false, found {show(off)}")
        del document["trim"]
    servo = problems.valid(Servo, document, flywheels=N, coordinates=known)
    if not N:
        problems.add(f'the stand "{stand.name}" has no flywheels: there is nothing to drive')
    if servo is not None:
        _compare(servo, stand, problems)
    if servo is None or problems.lines:
        raise ServoError(problems.lines)
    motors = [wheel.motor or UNLIMITED for wheel in stand.flywheels]
    trim = servo.trim
    return replace(
        servo,
        name=servo.name or Path(source).stem,
        torque_limit=servo.torque_limit or tuple(math.inf if m.peak is None else m.peak for m in motors),
        torque_rate=servo.torque_rate or (math.inf,) * N,
        trim=trim and replace(trim, coordinates=trim.coordinates or tuple(range(len(known)))),
    )


def _compare(servo: Servo, stand: Stand, problems: Problems) -> None:
    """Note keys that contradict each other or the stand."""
    if servo.latency > MOST_LATENCY * servo.period:
        problems.add("latency", f"{servo.latency:g} s is more than {MOST_LATENCY} sample periods of {servo.period:g} s")
    if servo.integral is not None and servo.integral > servo.bandwidth:
        problems.add("integral", f"{servo.integral:g} rad/s is above the bandwidth, {servo.bandwidth:g} rad/s")
    if servo.trim is not None and stand.hold is not None and not _has_numbers(stand.hold):
        freedoms = ", ".join(freedom_labels(stand.hold) or ["a clamped carrier"])
        problems.add(
            "trim",
            f"found {freedoms} in [hold] of the stand file, expected freedoms that each have a number in "
            "`generalized` of the C, as an axis, a rail or a plane has: remove [trim]",
        )
    without = [wheel.name for wheel in stand.flywheels if wheel.encoder is None]
    if servo.encoder == "stand" and without:
        problems.add("encoder", f'"stand", but the stand file has none for {", ".join(without)}')


def _has_numbers(hold: Hold) -> bool:
    """Whether each freedom has a number among the coordinates that `generalized` of the C answers."""
    return has_coordinates(hold) and len(numbered_freedoms(hold)) == len(hold.freedoms)
