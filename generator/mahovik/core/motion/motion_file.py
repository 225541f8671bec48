"""Motion file (JSON) -> RequiredMotion, or Slew where its type is "slew".

All problems of the keys are found before any is reported. A row is a number for each coordinate of the carrier's pose.
A held carrier has the coordinates of its freedoms.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

import numpy as np

from mahovik.core.motion.functions import (
    Array,
    Harmonics,
    SampledCourse,
    quintic_spline,
    times,
)
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import (
    Bounds,
    Deviation,
    FlywheelBounds,
    Goal,
    Kind,
    Objective,
    RequiredMotion,
    Slew,
    Start,
    Winding,
    numbers_of_pose,
    sight_of,
)  # fmt: skip
from mahovik.core.stand.coordinates import Coordinates, check_tasks, coordinates_of
from mahovik.core.stand.fields import (
    Length3,
    Text,
    beyond_a_turn,
    choice,
    direction,
    require_bounds,
    rows,
    scalar,
    short_integer,
    validator,
    vector,
    vector3,
)
from mahovik.core.stand.files import KINDS, TABLE, document_of, text_of
from mahovik.core.stand.masses import turn
from mahovik.core.stand.model import Stand, Task, Vec3
from mahovik.core.stand.tables import NOTHING, Context, Data, Problems, QuantityValidator, Table
from mahovik.core.stand.units import ANGLE, LENGTH, PLAIN, TIME, Dimension, QuantityError, factor, number, show
from mahovik.errors import MotionError
from mahovik.nearest import suggestion

WINDINGS = ("any", "spin", "rock")
HIGHEST = 1000
"""Highest harmonic of a file."""

NO_SLEW = (
    "a slew is planned by the momentum that a free carrier keeps and a hold takes, found a held carrier; expected "
    '"finite", with the turn as `samples` of the coordinates'
)
"""Why a held carrier has no slew, and what to give instead."""


# -- rows ------------------------------------------------------------------------------------------------------------


def _poses(raw: Any, context: Context) -> tuple[tuple[float, ...], ...]:
    """Rows in SI. Raises QuantityError."""
    return rows(raw, lambda row: numbers_of_pose(row, context))


def _flags(raw: Any, context: Context) -> tuple[bool, ...]:
    """A row of true and false. Raises QuantityError."""
    coordinates = context["coordinates"]
    if not isinstance(raw, list) or len(raw) != coordinates.count or not all(isinstance(item, bool) for item in raw):
        raise QuantityError(f"expected {coordinates.count} of true, false, found {show(raw)}")
    return tuple(raw)


# -- tables ----------------------------------------------------------------------------------------------------------


def _unit(dimension: Dimension, example: str) -> Any:
    def read(raw: Any) -> str:
        if not isinstance(raw, str):
            raise QuantityError(f"expected a unit such as {show(example)}, found {show(raw)}")
        factor(raw, dimension)
        return raw

    return validator(read)


def _span(raw: Any) -> float:
    span = require_bounds(number(raw, TIME), "s", above=0.0, raw=raw)
    if not 1e-6 <= span <= 1e6:
        raise QuantityError(f"{span:g} s is out of range, expected 1e-06 to 1e+06 s")
    return span


def _order(raw: Any) -> int:
    k = short_integer(raw)
    if not 1 <= k <= HIGHEST:
        raise QuantityError(f"expected 1 to {HIGHEST}, found {k}" + ("; a constant is `mean`" if k == 0 else ""))
    return k


def _type(raw: Any) -> str:
    if raw not in ("periodic", "finite"):
        raise QuantityError(f'expected "periodic", "finite" or "slew", found {show(raw)}')
    return str(raw)


def _winding(raw: Any, context: Context) -> Any:
    N = context["flywheels"]
    if isinstance(raw, str):
        if raw not in WINDINGS:
            raise QuantityError(f"unknown {show(raw)}{suggestion(raw, WINDINGS)}")
        return raw
    if not isinstance(raw, list) or len(raw) != N:
        there = f"{len(raw)} numbers" if isinstance(raw, list) else show(raw)
        raise QuantityError(f'expected {N} whole numbers (one per flywheel), "any", "spin" or "rock", found {there}')
    return rows(raw, short_integer)


def _intervals(raw: Any) -> dict[str, Any]:
    """Bounds by path; their units are those of the numbers there, which the planner knows. Raises QuantityError."""
    pairs = raw if isinstance(raw, dict) else {}
    if not isinstance(raw, dict) or not all(isinstance(pair, list) and len(pair) == 2 for pair in pairs.values()):
        raise QuantityError(f"expected {{path: [low, high], ..}}, found {show(raw)}")
    return pairs


def _path_lists(raw: Any) -> tuple[tuple[str, ...], ...]:
    """Lists of paths. Raises QuantityError."""
    lists = raw if isinstance(raw, list) else [None]
    if not all(isinstance(paths, list) and all(isinstance(path, str) for path in paths) for paths in lists):
        raise QuantityError(f"expected [[path, path, ..], ..], found {show(raw)}")
    return tuple(map(tuple, lists))


Row = Annotated[tuple[float, ...] | None, QuantityValidator(numbers_of_pose)]
Span = Annotated[float | None, validator(_span, TIME, least=1e-6, most=1e6)]


@dataclass(frozen=True)
class UnitsTable(Data):
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

    t: Annotated[Any, times()]
    q: Annotated[tuple[tuple[float, ...], ...], QuantityValidator(_poses)]


class MotionTable(Table):
    """A motion file of another type than "slew".

    name       name, to which programmes refer; without it that of the file
    note       free text
    type       a motion that repeats, or one from rest to rest
    period     of a periodic motion
    duration   of a finite one
    units      `linear`, `angular`: of `mean`, `harmonics`, `samples`; m and rad without it
    mean       of a held carrier one number for each freedom, as in all rows below; without it zero
    free_mean  where the programme's `bias` may shift the mean pose; without it everywhere
    harmonics  of a periodic motion: `k` (1 to 1000), `cos`, `sin` (a row each, or left out)
    samples    in place of `harmonics`: `t` (12 numbers or more) and `q` (a row a time), joined by a quintic spline;
               periodic ones leave out `t = T`
    winding    `"spin"`, `"rock"`, `"any"`, or whole turns a period for each flywheel
    runup      duration of a run-up from rest, and of the run-down
    bounds     one number or one a flywheel: `speed`, `speed_min`, `acceleration`, `torque`, `angle` (from winding and
               mean); `bias`, six numbers; `deviation` (`linear`, `angular`) of the carrier during `runup`; `start`,
               `phi` and `phi_dot` of a finite motion at `t = 0`
    objective  weights of the objective; without it acceleration has 1
    free       numbers of the stand that `plan --free` moves, with bounds: `{path: [low, high]}`
    same       lists of paths whose numbers stay equal
    """

    name: Text = ""
    note: Text = ""
    type: Annotated[Literal["periodic", "finite"], validator(_type)]
    period: Span = None
    duration: Span = None
    units: UnitsTable = UnitsTable()
    mean: Row = None
    free_mean: Annotated[tuple[bool, ...] | None, QuantityValidator(_flags)] = None
    harmonics: list[HarmonicTable] | None = None
    samples: SamplesTable | None = None
    winding: Annotated[Winding, QuantityValidator(_winding)] = "any"
    runup: Annotated[float | None, scalar(TIME, above=0.0)] = None
    bounds: Bounds = Bounds()
    objective: Objective = Objective()
    free: Annotated[Mapping[str, Any], validator(_intervals)] = NOTHING
    same: Annotated[tuple[tuple[str, ...], ...], validator(_path_lists)] = ()

    instead: ClassVar[Mapping[str, str]] = {
        "frequency": "a motion has `period` = 1 / frequency, in seconds",
        "amplitude": "a motion has `harmonics`: rows `cos` and `sin` at the order `k`",
    }


_ONLY = {
    "period": ("periodic", "which has `duration`"),
    "duration": ("finite", "which has `period`"),
    "harmonics": ("periodic", "which has `samples`"),
    "winding": ("periodic", "winding is turns per period"),
    "runup": ("periodic", "which starts from rest itself"),
}
"""Keys of one type of motion: the type, and what to say of the other."""


# -- reading ---------------------------------------------------------------------------------------------------------


def load_motion(path: str | Path, stand: Stand, programme: Programme | None = None) -> RequiredMotion:
    """Read and check the motion file at `path` for `stand`. Raises MotionError with every problem.

    `programme`: one for this motion, which has the course of the carrier where the file is a slew.
    """
    path = Path(path)
    return read_motion(text_of(path, KINDS["motion"], TABLE, MotionError), stand, path.name, programme)


def read_motion(text: str, stand: Stand, source: str = "motion", programme: Programme | None = None) -> RequiredMotion:
    """Read and check a motion given as text; `source` names it in messages. Raises MotionError."""
    motion = read_motion_or_slew(text, stand, source)
    if isinstance(motion, RequiredMotion):
        return motion
    if programme is None:
        raise MotionError([f"{source}: is a slew, whose course `mahovik plan` finds: give its programme as well"])
    return _checked(motion_of_slew(motion, programme), stand, Problems(source))


def load_motion_or_slew(path: str | Path, stand: Stand) -> RequiredMotion | Slew:
    """The motion file at `path`, whose course is known or, of a slew, to be found. Raises MotionError."""
    path = Path(path)
    return read_motion_or_slew(text_of(path, KINDS["motion"], TABLE, MotionError), stand, path.name)


def read_motion_or_slew(text: str, stand: Stand, source: str = "motion") -> RequiredMotion | Slew:
    """The motion that a text describes, whose course is known or, of a slew, to be found. Raises MotionError."""
    document = document_of(text, source, MotionError, "motion")
    name, problems = Path(source).stem.removesuffix(".motion"), Problems(source)
    if document.get("type") != "slew":
        return _read_course(document, stand, name, problems)
    if stand.hold is not None:
        raise MotionError([f"{source}: type: {NO_SLEW}"])
    return _read_slew(document, stand, name, problems)


def _checked(motion: RequiredMotion, stand: Stand, problems: Problems) -> RequiredMotion:
    """The motion itself. Raises MotionError where it leaves what can be computed."""
    motion.check(stand, problems)
    if problems.lines:
        raise MotionError(problems.lines)
    return motion


def _read_course(document: dict[str, Any], stand: Stand, name: str, problems: Problems) -> RequiredMotion:
    """A periodic or a finite motion."""
    N, coordinates = len(stand.flywheels), coordinates_of(stand)
    units = Problems(problems.source).valid(UnitsTable, document.get("units", {})) or UnitsTable()
    context: dict[str, Any] = {"units": {LENGTH: units.linear, ANGLE: units.angular}, "coordinates": coordinates}
    table = problems.valid(MotionTable, document, flywheels=N, **context)
    kind = document.get("type", "periodic")
    for key, (of, words) in _ONLY.items():
        if key in document and kind in ("periodic", "finite") and kind != of:
            problems.add(key, f'not allowed with type "{kind}", {words}')
    if kind in ("periodic", "finite") and (key := "period" if kind == "periodic" else "duration") not in document:
        problems.add(key, "required, but missing")
    there = [key for key in ("harmonics", "samples") if key in document]
    if len(there) != 1:
        problems.add(f"expected one of harmonics, samples, found {' and '.join(there) or 'none'}")
    if table is None:
        raise MotionError(problems.lines)
    _compare(table, "start" in document.get("bounds", {}), stand, problems)
    bounds, periodic = table.bounds, table.type == "periodic"
    span = table.period if periodic else table.duration
    if span is not None:
        bounds.contradictions(problems, table.winding, span if periodic else None)
    course = None if span is None else _course(table, periodic, span, coordinates, problems)
    if problems.lines or span is None or course is None:
        raise MotionError(problems.lines)
    motion = RequiredMotion(
        table.name or name, periodic, span, np.array(table.mean or (0.0,) * coordinates.count), course,
        table.free_mean or (True,) * coordinates.count, table.winding, bounds, table.objective.complete(N), table.runup,
        free=table.free, same=table.same,
    )  # fmt: skip
    return _checked(motion, stand, problems)


def _compare(table: MotionTable, has_start: bool, stand: Stand, problems: Problems) -> None:
    """Note keys that contradict each other or the stand."""
    if table.type == "periodic" and has_start:
        problems.add("bounds", "start", 'not allowed with type "periodic", which begins where it ends')
    if (deviation := table.bounds.deviation) is not None:
        if table.runup is None:
            problems.add("bounds", "deviation", "needs `runup`: it bounds the carrier on the way there and back")
        if deviation.limits == Deviation().limits:
            problems.add("bounds", "deviation", "expected linear, angular, or both")
    missing = [
        f'"{s.name}"'
        for s, weight in zip(stand.flywheels, table.objective.power, strict=False)
        if weight > 0.0 and (s.motor is None or not s.motor.constant or s.motor.resistance is None)
    ]
    if missing:
        which = f"flywheel {missing[0]} has" if len(missing) == 1 else f"flywheels {', '.join(missing)} have"
        words = "no motor with `constant` and `resistance`: give them in the stand file, or weight 0"
        problems.add("objective", "power", f"{which} {words}")


def _course(
    table: MotionTable, periodic: bool, span: float, coordinates: Coordinates, problems: Problems
) -> Harmonics | SampledCourse | None:
    if table.samples is not None:
        t, q = table.samples.t, np.array(table.samples.q).reshape(-1, coordinates.count)
        if len(t) != len(q):
            problems.add("samples", "q", f"{len(q)} rows, but t has {len(t)} numbers")
            return None
        course = SampledCourse(span, periodic, t, q, coordinates.groups)
        problem = _problem_of_times(course) or _problem_of_steps(course) or _problem_at_ends(course)
        if problem is not None:
            problems.add("samples", *problem)
            return None
        return course
    terms, none = table.harmonics or [], (0.0,) * coordinates.count
    ks = tuple(term.k for term in terms)
    for i, k in enumerate(ks):
        if k in ks[:i]:
            problems.add(f"harmonics[{i}]", "k", f"{k} appears twice")
    rows = (np.array([getattr(term, key) or none for term in terms]) for key in ("cos", "sin"))
    return Harmonics(span, ks, *(row.reshape(-1, coordinates.count) for row in rows))


# -- whether samples are a motion ------------------------------------------------------------------------------------

FEWEST = 12
"""Samples: every second one must still make a quintic spline."""

JUMP = 0.2
"""Largest distance of the other samples from a spline through every second one, as a part of the coordinate's range.

A harmonic sampled 8 times a period misses by 0.03, 6 times by 0.2; a step misses by about half.
"""

MOVING = 0.02
"""Largest speed (acceleration) that counts as rest at the ends of a finite motion, as a part of the greatest."""

GAP = 3.0
"""Longest steps that a periodic table may leave to the end of its period."""

_SMALL = 1e-6
"""Smallest range of a moving coordinate, as a part of the largest range of its kind: less is noise."""

Problem = tuple[str, str] | None
"""Key and reason why samples are refused, or None."""


def _problem_of_times(course: SampledCourse) -> Problem:
    """Times that do not rise over the span."""
    t, q = course.t, course.q
    if len(t) < FEWEST:
        return "t", f"{len(t)} samples, expected at least {FEWEST}"
    steps = np.diff(t)
    if np.any(steps <= 0.0):
        i = int(np.argmax(steps <= 0.0)) + 1
        jumps = steps[i - 1] == 0.0 and np.any(q[i] != q[i - 1])
        jump = ", but q differs: the motion must be continuous" if jumps else ""
        return f"t[{i}]", f"{t[i]:.9g} s is not after {t[i - 1]:.9g} s{jump}"
    covers = f"covers {t[0]:.9g} to {t[-1]:.9g} s"
    if not course.periodic:
        if t[0] != 0.0 or abs(t[-1] - course.span) > 1e-9 * course.span:
            return "t", f"{covers}, expected 0 to the duration, {course.span:g} s"
        return None
    if t[0] < 0.0:
        return "t[0]", f"{t[0]:.9g} s is before 0"
    if t[-1] - t[0] > course.span * (1 - 1e-9):
        after = f"{t[-1]:.9g} s is a period of {course.span:g} s after the first or more"
        return f"t[{len(t) - 1}]", f"{after}; t = T is left out"
    without = t[0] + course.span - t[-1]
    if without > GAP * float(steps.max()):
        gap = f"without samples in the last {without:.3g} s of the period, {course.span:g} s"
        return "t", f"{covers}, {gap}: is it the period of these samples?"
    return None


def _moving(course: SampledCourse) -> tuple[Array, Array]:
    """Ranges of the coordinates, 1 of those that stand still, and which of them move."""
    ranges = np.ptp(course.q, axis=0)
    kinds = np.empty_like(ranges)
    for group in course.groups:
        kinds[list(group)] = ranges[list(group)].max()
    moving = ranges > _SMALL * kinds
    return np.where(moving, ranges, 1.0), moving


def _problem_of_steps(course: SampledCourse) -> Problem:
    """The largest distance of a sample from a spline through every second one of the others, if it is too large."""
    t, q = course.t, course.q
    kept = np.arange(len(t)) % 2 == 0
    if not course.periodic:
        kept[-1] = True
    coarse = quintic_spline(t[kept], q[kept], course.span if course.periodic else None)
    ranges, moving = _moving(course)
    missed = np.where(moving, np.abs(coarse(t[~kept]) - q[~kept]) / ranges, 0.0)
    row, column = np.unravel_index(int(np.argmax(missed)), missed.shape)
    if missed[row, column] <= JUMP:
        return None
    return f"q[{int(np.flatnonzero(~kept)[row])}][{column}]", (
        "a jump: a spline through every second sample misses this one by "
        f"{100 * missed[row, column]:.0f} % of the range; a motion is continuous and sampled at least 8 times "
        "a period of its highest harmonic"
    )


def _problem_at_ends(course: SampledCourse) -> Problem:
    """Speeds and accelerations at the ends of a finite motion, by a spline without end conditions."""
    if course.periodic:
        return None
    from scipy.interpolate import make_interp_spline

    free = make_interp_spline(course.t, course.q, k=5)
    fine = np.linspace(0.0, course.t[-1], 8 * len(course.t))
    _, moving = _moving(course)
    for order, words in ((1, "speed"), (2, "acceleration")):
        values = np.abs(free.derivative(order)(fine))
        most = np.where(moving, values.max(axis=0), 1.0)
        for at, index in (("start", 0), ("end", -1)):
            share = np.where(moving, values[index] / most, 0.0)
            column = int(np.argmax(share))
            if share[column] > MOVING:
                return "q", (
                    f"component {column}: {words} at the {at} is {100 * share[column]:.0f} % of the greatest; "
                    "a finite motion starts and ends at rest, q' = q'' = 0; if it does, more samples will show it"
                )
    return None


# -- slews -----------------------------------------------------------------------------------------------------------

_SEQUENCE = {"ship": (2, 1, 0), "aircraft": (1, 2, 0), "euler": (2, 0, 2)}
_UNIT = 1e-3
_SAME = 1e-9
"""rad: a smaller turn is none."""


def _quaternion(raw: Any) -> tuple[float, ...]:
    parts = vector(raw, (4,), PLAIN)
    if abs(math.hypot(*parts) - 1.0) > _UNIT:
        raise QuantityError(f"length {math.hypot(*parts):.6g}, expected 1 within {_UNIT:g}")
    return parts


@dataclass(frozen=True)
class Attitude(Data):
    """An attitude by angles or by a quaternion."""

    angles: Annotated[Vec3 | None, vector3(ANGLE)] = None
    quaternion: Annotated[tuple[float, ...] | None, validator(_quaternion)] = None

    def matrix(self, stand: Stand, problems: Problems, key: str) -> Array:
        """C of the angles in the stand's sequence or of the quaternion w, x, y, z; aligned with E0 without either."""
        if self.angles is not None and self.quaternion is not None:
            problems.add(key, "expected angles or quaternion, found both")
        if self.quaternion is not None:
            from scipy.spatial.transform import Rotation  # no other motion needs SciPy

            return np.asarray(Rotation.from_quat(self.quaternion, scalar_first=True).as_matrix())
        C = np.eye(3)
        for axis, value in zip(_SEQUENCE[stand.angles], self.angles or (0.0, 0.0, 0.0), strict=True):
            C = C @ turn(axis, value)
        return C


@dataclass(frozen=True)
class SlewStart(Attitude, Start):
    """`start`: at rest."""

    position: Length3 = (0.0, 0.0, 0.0)


Towards = Annotated[Vec3 | None, validator(direction)]


@dataclass(frozen=True)
class SlewEnd(Attitude):
    """`end`: an attitude, or a direction of the line of sight in E0."""

    direction: Towards = None


class SlewTable(Table):
    """A motion file of type "slew".

    name       name, to which programmes refer; without it that of the file
    note       free text
    type       that of a slew
    task       a task of the stand; or `rows`
    rows       rows as in a task. Three angular rows: attitude. Two of one frame: a line of sight, its third axis. None:
               a point at rest. Linear rows have no acceleration
    start      at rest: `position` (m), `angles` or `quaternion` (w first), `phi`, `phi_dot` of the flywheels; zero
               without
    end        `angles` or `quaternion` of the carrier, or `direction` in `E0` of a line of sight; required if rows turn
    goal       `"quietest"`: in a `duration`, the least mean square of the third derivative, and of the flywheels the
               least `phi''`; without it by whether there is a `duration`
    duration   of the turn
    bounds     `speed`, `acceleration`, `torque` (of the motor), besides the motors' limits; without a motor
               `inverse_most` holds
    """

    name: Text = ""
    note: Text = ""
    type: Annotated[str, choice("slew")]
    task: Text | None = None
    rows: Any = None
    start: SlewStart = SlewStart()
    end: SlewEnd = SlewEnd()
    goal: Annotated[Goal | None, choice("fastest", "quietest")] = None
    duration: Annotated[float | None, scalar(TIME, above=1e-3, most=1e6)] = None
    bounds: FlywheelBounds = FlywheelBounds()


def _read_slew(document: dict[str, Any], stand: Stand, name: str, problems: Problems) -> Slew:
    """The slew of a document. Raises MotionError with every problem."""
    N = len(stand.flywheels)
    table = problems.valid(SlewTable, document, flywheels=N)
    if table is None:
        raise MotionError(problems.lines)
    task = _task(table, stand, problems)
    goal: Goal = table.goal or ("fastest" if table.duration is None else "quietest")
    if goal == "quietest" and table.duration is None:
        problems.add("duration", "required with the goal quietest: the slower, the quieter")
    if goal == "fastest" and table.duration is not None:
        problems.add("duration", "not allowed with the goal fastest, whose duration is found")
    if task is None or problems.lines:
        raise MotionError(problems.lines)
    kind = _kind_of(task, problems.source)
    start = table.start.matrix(stand, problems, "start")
    axis, normal, angle = _turn(kind, table.end, stand, task, start, problems)
    if kind == "still" and table.duration is None:
        problems.add("duration", "required: no row turns, so that nothing else says how long it lasts")
    if problems.lines:
        raise MotionError(problems.lines)
    ends = ((key, (document.get(key) or {}).get("angles", 0)) for key in ("start", "end"))
    doubts = tuple(line for key, raw in ends for line in beyond_a_turn(f"{key}.angles", raw))
    none = (0.0,) * N
    return Slew(
        table.name or name, task, kind, start, table.start.position, axis, normal, angle, goal, table.duration,
        table.start.phi or none, table.start.phi_dot or none, table.bounds, doubts,
    )  # fmt: skip


def _task(table: SlewTable, stand: Stand, problems: Problems) -> Task | None:
    if (table.task is None) == (table.rows is None):
        problems.add("expected one of task, rows, found " + ("none" if table.task is None else "task and rows"))
        return None
    if table.task is not None:
        tasks = {task.name: task for task in stand.tasks}
        if table.task not in tasks:
            problems.add("task", f"unknown {show(table.task)}{suggestion(table.task, tasks, 'the stand has none')}")
        return tasks.get(table.task)
    valid = problems.valid(Task.table(), {"rows": table.rows})
    if valid is None:
        return None
    task = Task.of_table(valid, name="rows")
    check_tasks(problems, (task,), stand.instruments, stand.points)
    return task


def _kind_of(task: Task, source: str) -> Kind:
    """The kind of slew of a task's rows. Raises MotionError where they make none."""
    frames = [row.of for row in task.rows if row.component.startswith("w")]
    if not frames:
        return "still"
    if len(frames) == 3:
        return "attitude"
    if len(frames) == 2 and frames[0] == frames[1]:
        return "sight"
    reason = "two angular rows of different frames have no line of sight: give both of one frame, or three"
    if len(frames) == 1:
        reason = (
            "one angular row alone has no end: give three, or two of one frame, whose third axis is the line of sight"
        )
    raise MotionError([f"{source}: rows: {reason}"])


def _turn(
    kind: Kind, end: SlewEnd, stand: Stand, task: Task, start: Array, problems: Problems
) -> tuple[Array, Array, float]:
    """Axis, normal and angle of the shortest turn from start to end."""
    none = np.array([1.0, 0.0, 0.0]), start @ np.array([1.0, 0.0, 0.0]), 0.0
    there = [key for key in ("angles", "quaternion", "direction") if getattr(end, key) is not None]
    if kind == "still":
        if there:
            problems.add("end", f"{there[0]}: not allowed without angular rows: nothing turns there")
        return none
    if kind == "attitude":
        if there not in (["angles"], ["quaternion"]):
            problems.add("end", f"expected angles or quaternion, found {', '.join(there) or 'none'}")
            return none
        from scipy.spatial.transform import Rotation  # no other motion needs SciPy

        turned = Rotation.from_matrix(start.T @ end.matrix(stand, problems, "end")).as_rotvec()
        angle = float(np.linalg.norm(turned))
        if angle < _SAME:
            problems.add("end", "is the attitude of the start: there is nothing to turn")
            return none
        return turned / angle, start @ (turned / angle), angle
    if there != ["direction"]:
        problems.add("end", f"expected direction of the line of sight in E0, found {', '.join(there) or 'none'}")
        return none
    sight = sight_of(task, stand)
    first, last = start @ sight, np.array(end.direction) / np.linalg.norm(end.direction or (1.0, 0.0, 0.0))
    normal = np.cross(first, last)
    size = float(np.linalg.norm(normal))
    angle = math.atan2(size, float(first @ last))
    if size < _SAME:
        words = "is that of the start" if angle < 1.0 else "is opposite to that of the start: any plane leads there"
        problems.add("end", f"direction: {words}")
        return none
    return sight, normal / size, angle


def motion_of_slew(slew: Slew, programme: Programme) -> RequiredMotion:
    """The motion of a slew: the course of the carrier that its programme keeps. Raises MotionError: it keeps none."""
    if programme.carrier is None:
        raise MotionError([f"{slew.name}: is a slew, but the programme keeps no course of the carrier: plan it again"])
    none = (0.0,) * len(slew.phi)
    return RequiredMotion(
        slew.name, False, programme.span, np.zeros(6), programme.carrier, (False,) * 6, "any",
        Bounds(**vars(slew.bounds), start=Start(slew.phi, slew.phi_dot)),
        Objective(none, none, none, none), None, slew,
    )  # fmt: skip
