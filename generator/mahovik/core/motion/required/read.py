"""Motion file (JSON) -> RequiredMotion. All problems of the keys are found before any is reported."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from mahovik.core.motion.document import document_of, text_of, validate_table
from mahovik.core.motion.fields import (
    NOT_NULL,
    Times,
    context_validator,
    integers,
    per_flywheel,
    rows,
    short_integer,
)
from mahovik.core.motion.required import limits, reach, samples
from mahovik.core.motion.required.course import Harmonics, SampledCourse
from mahovik.core.motion.required.model import Bounds, Objective, RequiredMotion, Winding
from mahovik.core.motion.required.rows import Rows, flags, magnitudes, row
from mahovik.core.motion.required.slew import Slew
from mahovik.core.motion.required.slew_file import motion_of_slew, read_slew
from mahovik.core.stand.content import TABLE
from mahovik.core.stand.coordinates import SixRows, coordinates_of
from mahovik.core.stand.echoes import echo
from mahovik.core.stand.fields import Table, Text, require_bounds, scalar, validator
from mahovik.core.stand.model import Stand
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import (
    ANGLE,
    LENGTH,
    PLAIN,
    SPEED,
    TIME,
    TORQUE,
    Dimension,
    QuantityError,
    factor,
    number,
    show,
)
from mahovik.errors import MotionError
from mahovik.nearest import suggestion

if TYPE_CHECKING:
    from mahovik.core.motion.programme import Programme

ANGULAR_ACCELERATION = Dimension("an angular acceleration", "rad/s^2")
WINDINGS = ("any", "spin", "rock")
HIGHEST = 1000
"""Highest harmonic of a file."""


def _unit(dimension: Dimension, example: str) -> Any:
    def read(raw: Any) -> str:
        if not isinstance(raw, str):
            raise QuantityError(f"expected a unit such as {show(example)}, found {show(raw)}")
        factor(raw, dimension)
        return raw

    return validator(read)


def _span(raw: Any) -> float:
    found = require_bounds(number(raw, TIME), "s", above=0.0, raw=raw)
    if not 1e-6 <= found <= 1e6:
        raise QuantityError(f"{found:g} s is out of range, expected 1e-06 to 1e+06 s")
    return found


def _order(raw: Any) -> int:
    k = short_integer(raw)
    if not 1 <= k <= HIGHEST:
        raise QuantityError(f"expected 1 to {HIGHEST}, found {k}" + ("; a constant is `mean`" if k == 0 else ""))
    return k


def _type(raw: Any) -> str:
    if raw not in ("periodic", "finite"):
        raise QuantityError(f'expected "periodic", "finite" or "slew", found {show(raw)}')
    return str(raw)


def _winding(raw: Any, context: dict[str, Any]) -> Any:
    N = context["flywheels"]
    if isinstance(raw, str):
        if raw not in WINDINGS:
            raise QuantityError(f"unknown {show(raw)}{suggestion(raw, WINDINGS)}")
        return raw
    if not isinstance(raw, list) or len(raw) != N:
        found = f"{len(raw)} numbers" if isinstance(raw, list) else show(raw)
        raise QuantityError(f'expected {N} whole numbers (one per flywheel), "any", "spin" or "rock", found {found}')
    return integers(raw)


def _magnitude(dimension: Dimension, zero: bool = False) -> Any:
    def check(value: float, raw: Any) -> None:
        if value < 0.0 or (value == 0.0 and not zero):
            raise QuantityError(
                f"{echo(raw, value, dimension.si) or f'{value:g}'} is not above 0: a bound is a magnitude"
            )

    return per_flywheel(dimension, check)


def _weight(value: float, raw: Any) -> None:
    if value < 0.0:
        raise QuantityError(f"{value:g} is negative, expected a weight")


Each = tuple[float, ...] | None
Row = Annotated[
    tuple[float, ...] | None, context_validator(lambda raw, context: row(raw, context["coordinates"], context["units"]))
]
Weights = Annotated[Each, per_flywheel(PLAIN, _weight)]


class UnitsTable(Table):
    """`units` of the coordinates."""

    linear: Annotated[str | None, _unit(LENGTH, "mm")] = None
    angular: Annotated[str | None, _unit(ANGLE, "mrad")] = None


class HarmonicTable(Table):
    """One of `harmonics`."""

    k: Annotated[int, validator(_order)]
    cos: Row = None
    sin: Row = None


class SamplesTable(Table):
    """`samples`."""

    t: Times
    q: Annotated[
        tuple[tuple[float, ...], ...],
        context_validator(
            lambda raw, context: rows(raw, lambda one: row(one, context["coordinates"], context["units"]))
        ),
    ]


class StartTable(Table):
    """`bounds.start` of a finite motion."""

    phi: Annotated[Each, per_flywheel(ANGLE)] = None
    phi_dot: Annotated[Each, per_flywheel(SPEED)] = None


class DeviationTable(Table):
    """`bounds.deviation` of the carrier during run-up and run-down."""

    linear: Annotated[float, scalar(LENGTH, above=0.0)] = math.inf
    angular: Annotated[float, scalar(ANGLE, above=0.0)] = math.inf


class BoundsTable(Table):
    """`bounds`."""

    speed: Annotated[Each, _magnitude(SPEED)] = None
    speed_min: Annotated[Each, _magnitude(SPEED, zero=True)] = None
    acceleration: Annotated[Each, _magnitude(ANGULAR_ACCELERATION)] = None
    torque: Annotated[Each, _magnitude(TORQUE)] = None
    angle: Annotated[Each, _magnitude(ANGLE)] = None
    bias: Annotated[Each, context_validator(lambda raw, context: magnitudes(raw, context["coordinates"]))] = None
    deviation: Annotated[DeviationTable | None, NOT_NULL] = None
    start: Annotated[StartTable | None, NOT_NULL] = None

    def bounds(self, along: Rows) -> Bounds:
        """The bounds as data; `along`: the coordinates of the bias."""
        own = {key: getattr(self, key) for key in ("speed", "speed_min", "acceleration", "torque", "angle")}
        own["bias"] = along.magnitudes(self.bias)
        start = self.start or StartTable()
        deviation = None if self.deviation is None else (self.deviation.linear, self.deviation.angular)
        return Bounds(**own, deviation=deviation, start_phi=start.phi, start_phi_dot=start.phi_dot)


class ObjectiveTable(Table):
    """`objective`: a weight left out is 0; without any, the weight of acceleration is 1."""

    acceleration: Weights = None
    torque: Weights = None
    speed_variation: Weights = None
    power: Weights = None

    def objective(self, N: int) -> Objective:
        """The weights of N flywheels."""
        given = {key: value or (0.0,) * N for key, value in self}
        return Objective(**given if self.model_fields_set else given | {"acceleration": (1.0,) * N})


class MotionTable(Table):
    """A motion file."""

    name: Text = ""
    note: Text = ""
    type: Annotated[Literal["periodic", "finite"], validator(_type)]
    period: Annotated[float | None, validator(_span)] = None
    duration: Annotated[float | None, validator(_span)] = None
    units: UnitsTable = UnitsTable()
    mean: Row = None
    free_mean: Annotated[
        tuple[bool, ...] | None, context_validator(lambda raw, context: flags(raw, context["coordinates"]))
    ] = None
    harmonics: Annotated[list[HarmonicTable] | None, NOT_NULL] = None
    samples: Annotated[SamplesTable | None, NOT_NULL] = None
    winding: Annotated[Winding, context_validator(_winding)] = "any"
    runup: Annotated[float | None, scalar(TIME, above=0.0)] = None
    bounds: BoundsTable = BoundsTable()
    objective: ObjectiveTable = ObjectiveTable()


_ONLY = {
    "period": ("periodic", "which has `duration`"),
    "duration": ("finite", "which has `period`"),
    "harmonics": ("periodic", "which has `samples`"),
    "winding": ("periodic", "winding is turns per period"),
    "runup": ("periodic", "which starts from rest itself"),
}
"""Keys of one type of motion: the type, and what to say of the other."""


NO_SLEW = (
    "a slew is planned by the momentum that a free carrier keeps and a hold takes, found a held carrier; expected "
    '"finite", with the turn as `samples` of the coordinates'
)
"""Why a held carrier has no slew, and what to give instead."""


def load_motion(path: str | Path, stand: Stand, programme: Programme | None = None) -> RequiredMotion:
    """Read and check the motion file at `path` for `stand`. Raises MotionError with every problem.

    `programme`: one for this motion, which has the course of the carrier where the file is a slew.
    """
    path = Path(path)
    return read_motion(text_of(path, TABLE, MotionError), stand, path.name, programme)


def read_motion(text: str, stand: Stand, source: str = "motion", programme: Programme | None = None) -> RequiredMotion:
    """Read and check a motion given as text; `source` names it in messages. Raises MotionError."""
    found = read_motion_or_slew(text, stand, source)
    if isinstance(found, RequiredMotion):
        return found
    if programme is None:
        raise MotionError([f"{source}: is a slew, whose course `mahovik plan` finds: give its programme as well"])
    motion = motion_of_slew(found, programme)
    problems = Problems(source)
    reach.check(motion, stand, problems)
    if problems.lines:
        raise MotionError(problems.lines)
    return motion


def load_motion_or_slew(path: str | Path, stand: Stand) -> RequiredMotion | Slew:
    """The motion file at `path`, whose course is known or, of a slew, to be found. Raises MotionError."""
    path = Path(path)
    return read_motion_or_slew(text_of(path, TABLE, MotionError), stand, path.name)


def read_motion_or_slew(text: str, stand: Stand, source: str = "motion") -> RequiredMotion | Slew:
    """The motion that a text describes, whose course is known or, of a slew, to be found. Raises MotionError."""
    document = document_of(text, source, MotionError)
    if "stand" in document and "flywheels" in document:
        raise MotionError([f"{source}: is a programme file; expected a motion file here: were the two swapped?"])
    if document.get("type") == "slew":
        if stand.hold is not None:
            raise MotionError([f"{source}: type: {NO_SLEW}"])
        name = document.get("name") or Path(source).stem.removesuffix(".motion")
        return read_slew(document, stand, str(name), Problems(source))
    return _read_course(document, stand, source)


def _read_course(document: dict[str, Any], stand: Stand, source: str) -> RequiredMotion:
    """A periodic or a finite motion."""
    problems, N = Problems(source), len(stand.flywheels)
    units = validate_table(UnitsTable, document.get("units", {}), Problems(source)) or UnitsTable()
    coordinates = coordinates_of(stand)
    along = Rows(coordinates, None if stand.hold is None else SixRows.of(stand), source)
    context: dict[str, Any] = {"flywheels": N, "units": (units.linear, units.angular), "coordinates": coordinates}
    table = validate_table(MotionTable, document, problems, **context)
    kind = document.get("type", "periodic")
    for key, (own, other) in _ONLY.items():
        if key in document and kind in ("periodic", "finite") and kind != own:
            problems.add(key, f'not allowed with type "{kind}", {other}')
    if kind in ("periodic", "finite") and (key := "period" if kind == "periodic" else "duration") not in document:
        problems.add(key, "required, but missing")
    given = [key for key in ("harmonics", "samples") if key in document]
    if len(given) != 1:
        problems.add(f"expected one of harmonics, samples, found {' and '.join(given) or 'none'}")
    if table is None:
        raise MotionError(problems.lines)
    along.refuse_blocked(_rows_of(table))
    _compare(table, stand, problems)
    bounds = table.bounds.bounds(along)
    periodic = table.type == "periodic"
    span = table.period if periodic else table.duration
    if span is not None:
        limits.contradictions(problems, bounds, table.winding, span if periodic else None)
    course = None if span is None else _course(table, periodic, span, along, problems)
    if problems.lines or span is None or course is None:
        raise MotionError(problems.lines)
    motion = RequiredMotion(
        table.name or Path(source).stem.removesuffix(".motion"), periodic, span,
        np.array(along.of(table.mean or (0.0,) * coordinates.count)), course,
        along.flags(table.free_mean or (True,) * coordinates.count),
        table.winding, bounds, table.objective.objective(N), table.runup,
    )  # fmt: skip
    reach.check(motion, stand, problems)
    if problems.lines:
        raise MotionError(problems.lines)
    return motion


def _compare(table: MotionTable, stand: Stand, problems: Problems) -> None:
    """Note keys that contradict each other or the stand."""
    if table.type == "periodic" and table.bounds.start is not None:
        problems.add("bounds", "start", 'not allowed with type "periodic", which begins where it ends')
    if (deviation := table.bounds.deviation) is not None:
        if table.runup is None:
            words = "needs `runup`: it bounds the carrier on the way there and back"
            problems.add("bounds", "deviation", words)
        if not deviation.model_fields_set:
            problems.add("bounds", "deviation", "expected linear, angular, or both")
    missing = [
        f'"{s.name}"'
        for s, weight in zip(stand.flywheels, table.objective.power or (), strict=False)
        if weight > 0.0 and (s.motor is None or not s.motor.constant or s.motor.resistance is None)
    ]
    if missing:
        which = f"flywheel {missing[0]} has" if len(missing) == 1 else f"flywheels {', '.join(missing)} have"
        problems.add(
            "objective",
            "power",
            f"{which} no motor with `constant` and `resistance`: give them in the stand file, or weight 0",
        )


def _rows_of(table: MotionTable) -> list[tuple[float, ...]]:
    """Rows that say where the carrier is to be."""
    found = [table.mean, *(table.samples.q if table.samples is not None else ())]
    for one in table.harmonics or ():
        found += [one.cos, one.sin]
    return [each for each in found if each is not None]


def _course(
    table: MotionTable, periodic: bool, span: float, along: Rows, problems: Problems
) -> Harmonics | SampledCourse | None:
    none = (0.0,) * along.coordinates.count
    if table.samples is not None:
        t, q = np.array(table.samples.t), along.matrix(table.samples.q)
        if len(t) != len(q):
            problems.add("samples", "q", f"{len(q)} rows, but t has {len(t)} numbers")
            return None
        found = SampledCourse(span, periodic, t, q, along.coordinates.groups)
        reason = samples.problem(found)
        if reason is not None:
            problems.add("samples", *reason)
            return None
        return found
    given = table.harmonics or []
    ks = tuple(one.k for one in given)
    for i, k in enumerate(ks):
        if k in ks[:i]:
            problems.add(f"harmonics[{i}]", "k", f"{k} appears twice")
    cos, sin = (along.matrix(getattr(one, key) or none for one in given) for key in ("cos", "sin"))
    return Harmonics(span, ks, cos, sin)
