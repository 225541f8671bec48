"""Servo file (TOML) -> Servo. All problems of the keys are found before any is reported."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Any, Literal

from mahovik.core.motion.document import document_of, text_of, validate_table
from mahovik.core.motion.fields import (
    angular_speed,
    choice,
    context_validator,
    per_flywheel,
    positions,
    table_or_false,
    whole_number,
)
from mahovik.core.motion.ranges import MAX_WRENCH
from mahovik.core.motion.servo.model import COORDINATES, Servo, Trim
from mahovik.core.stand.content import TEXT
from mahovik.core.stand.fields import Flag, Table, Text, require_bounds, scalar, validator
from mahovik.core.stand.hold import freedom_labels, freedom_names, has_coordinates, numbered_freedoms
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import ANGLE, PLAIN, TIME, TORQUE, Dimension, QuantityError, show
from mahovik.errors import ServoError

TORQUE_RATE = Dimension("a torque rate", "N m/s")
LEAST_PERIOD, MOST_PERIOD, MOST_LATENCY = 1e-6, 1.0, 16
"""Shortest and longest sample period, s; longest latency in sample periods."""
MOST_HARMONICS = 16
"""Most harmonics of a trim: its matrix has (2 harmonics + 1)^2 numbers for each coordinate and flywheel."""


def _coordinates(raw: Any, context: dict[str, Any]) -> tuple[int, ...]:
    known = context["coordinates"]
    if not isinstance(raw, list) or not raw:
        raise QuantityError(f"expected names among {', '.join(known)}, found {show(raw)}")
    return tuple(sorted(positions(raw, known)))


def _speed_or_false(raw: Any) -> float | None:
    return None if raw is False else angular_speed(raw)


def _limits(dimension: Dimension) -> Any:
    """A validator of limits above 0, one for all flywheels or one for each."""
    return per_flywheel(
        dimension, lambda value, raw: require_bounds(value, dimension.si, above=0.0, most=MAX_WRENCH, raw=raw)
    )


class TrimTable(Table):
    """`[trim]`."""

    harmonics: Annotated[int, whole_number(1, MOST_HARMONICS)] = 1
    gain: Annotated[float, scalar(PLAIN, above=0.0, most=1.0)] = 0.5
    coordinates: Annotated[tuple[int, ...] | None, context_validator(_coordinates)] = None
    settling: Annotated[int, whole_number(0, 10**6)] = 20
    averaging: Annotated[int, whole_number(1, 10**6)] = 1
    limit: Annotated[float, scalar(ANGLE, above=0.0)] = 0.5


class ServoTable(Table):
    """A servo file."""

    name: Text = ""
    sample_period: Annotated[float, scalar(TIME, least=LEAST_PERIOD, most=MOST_PERIOD)]
    latency: Annotated[float, scalar(TIME, least=0.0)] = 0.0
    bandwidth: Annotated[float, validator(angular_speed)]
    damping_ratio: Annotated[float, scalar(PLAIN, above=0.0, most=5.0)] = 0.8
    integral: Annotated[float | None, validator(_speed_or_false)] = None
    speed_filter: Annotated[float | None, validator(_speed_or_false)] = None
    feedforward: Flag = True
    friction: Flag = True
    torque_limit: Annotated[tuple[float, ...] | None, _limits(TORQUE)] = None
    torque_rate: Annotated[tuple[float, ...] | None, _limits(TORQUE_RATE)] = None
    encoder: Annotated[Literal["ideal", "stand"], choice("ideal", "stand")] = "ideal"
    trim: Annotated[TrimTable | None, table_or_false(TrimTable.model_fields)] = None


def load_servo(path: str | Path, stand: Stand) -> Servo:
    """Read and check the servo file at `path` for a stand. Raises ServoError with every problem."""
    path = Path(path)
    return read_servo(text_of(path, TEXT, ServoError), stand, path.name)


def read_servo(text: str, stand: Stand, source: str = "servo") -> Servo:
    """Read and check a servo given as text; `source` names it in messages. Raises ServoError with every problem."""
    problems, N = Problems(source), len(stand.flywheels)
    known = COORDINATES if stand.hold is None else tuple(freedom_names(stand.hold))
    document = document_of(text, source, ServoError, is_json=False)
    table = validate_table(ServoTable, document, problems, flywheels=N, coordinates=known)
    if not N:
        problems.add(f'the stand "{stand.name}" has no flywheels: there is nothing to drive')
    if table is not None:
        _compare(table, stand, problems)
    if table is None or problems.lines:
        raise ServoError(problems.lines)
    motors = [s.motor for s in stand.flywheels]
    given = dict(table)
    return Servo(
        **{key: given[key] for key in Servo.__dataclass_fields__ if key in given}
        | {
            "name": table.name or Path(source).stem,
            "period": table.sample_period,
            "torque_limit": table.torque_limit
            or tuple(math.inf if m is None or m.torque is None else m.torque for m in motors),
            "torque_rate": table.torque_rate or (math.inf,) * N,
            "trim": None if table.trim is None else _trim(table.trim, len(known)),
        }
    )


def _trim(table: TrimTable, count: int) -> Trim:
    """The trim of its table; without `coordinates` all of them are measured."""
    chosen = tuple(range(count)) if table.coordinates is None else table.coordinates
    return Trim(**dict(table) | {"coordinates": chosen})


def _compare(table: ServoTable, stand: Stand, problems: Problems) -> None:
    """Note keys that contradict each other or the stand."""
    period, latency = table.sample_period, table.latency
    if latency > MOST_LATENCY * period:
        problems.add("latency", f"{latency:g} s is more than {MOST_LATENCY} sample periods of {period:g} s")
    if table.integral is not None and table.integral > table.bandwidth:
        problems.add("integral", f"{table.integral:g} rad/s is above the bandwidth, {table.bandwidth:g} rad/s")
    if table.trim is not None and stand.hold is not None and not _has_numbers(stand.hold):
        found = freedom_labels(stand.hold) or ["a clamped carrier"]
        problems.add(
            "trim",
            f"found {', '.join(found)} in [hold] of the stand file, expected freedoms that each have a number in "
            "`generalized` of the C, as an axis, a rail or a plane has: remove [trim]",
        )
    without = [s.name for s in stand.flywheels if s.encoder is None]
    if table.encoder == "stand" and without:
        problems.add("encoder", f'"stand", but the stand file has none for {", ".join(without)}')


def _has_numbers(hold: Hold) -> bool:
    """Whether each freedom has a number among the coordinates that `generalized` of the C answers."""
    return has_coordinates(hold) and len(numbered_freedoms(hold)) == len(hold.freedoms)
