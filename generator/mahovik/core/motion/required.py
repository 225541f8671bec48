"""A required motion of the carrier: its course, bounds and objective; and a slew, whose course is to be found."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Annotated, Any, Literal

import numpy as np

from mahovik.contract.quantities import BOUNDS
from mahovik.core.motion.functions import (
    Array,
    Course,
    Harmonics,
    PlannedCourse,
    SampledCourse,
    bound_per_flywheel,
    per_flywheel,
)
from mahovik.core.stand.coordinates import Coordinates, coordinates_of, places_of, row_vector
from mahovik.core.stand.fields import scalar
from mahovik.core.stand.model import COMPONENTS, Stand, Task, Vec3
from mahovik.core.stand.tables import Context, Data, Problems, QuantityValidator
from mahovik.core.stand.units import (
    ANGLE,
    ANGULAR_ACCELERATION,
    LENGTH,
    PLAIN,
    SPEED,
    TORQUE,
    QuantityError,
    number,
    show,
)

Winding = Literal["any", "spin", "rock"] | tuple[int, ...]
Kind = Literal["attitude", "sight", "still"]
Goal = Literal["fastest", "quietest"]
Each = tuple[float, ...] | None
"""A number for every flywheel; None: no bound."""

SINGULAR = 1e-3
"""|cos theta| (Euler: |sin theta|) that a motion may come down to; `generalized` stops at 1e-6."""

MOST = (
    ((BOUNDS["MAX_POSITION"].value, "m"), (BOUNDS["MAX_PHASE"].at("float"), "rad")),
    ((BOUNDS["MAX_VELOCITY"].value, "m/s"), (BOUNDS["MAX_SPEED"].value, "rad/s")),
    ((BOUNDS["MAX_ACCELERATION"].value, "m/s2"), (BOUNDS["MAX_ACCELERATION"].value, "rad/s2")),
)
"""Largest magnitudes of q, q', q'': of the linear and of the angular components; angles that float takes as well."""


@dataclass(frozen=True)
class FlywheelBounds(Data):
    """Magnitudes that the flywheels keep to: of phi' (rad/s), of phi'' (rad/s2), of tau (N m), N numbers each."""

    speed: Annotated[Each, bound_per_flywheel(SPEED)] = None
    acceleration: Annotated[Each, bound_per_flywheel(ANGULAR_ACCELERATION)] = None
    torque: Annotated[Each, bound_per_flywheel(TORQUE)] = None


def numbers_of_pose(raw: Any, context: Context, more: str = "") -> tuple[float, ...]:
    """A row, a number for each coordinate of the pose, in SI. Raises QuantityError."""
    coordinates, units = context["coordinates"], context["units"]
    if not isinstance(raw, list) or len(raw) != coordinates.count:
        expected = coordinates.words if coordinates.held else f"6 numbers{more}"
        raise QuantityError(f"expected {expected}, found {len(raw) if isinstance(raw, list) else show(raw)}")
    values = []
    for i, (item, dimension) in enumerate(zip(raw, coordinates.dimensions, strict=True)):
        try:
            values.append(number(item, dimension, units.get(dimension)))
        except QuantityError as error:
            raise QuantityError(f"[{i}]: {error}") from None
    return tuple(values)


def _magnitudes(raw: Any, context: Context) -> tuple[float, ...]:
    """A row of bounds, each with a unit of its own or in SI. Raises QuantityError."""
    values = numbers_of_pose(raw, {**context, "units": {}}, " (m, rad)")
    for i, value in enumerate(values):
        if value < 0.0:
            raise QuantityError(f"[{i}]: {value:g} is negative: a bound is a magnitude")
    return values


@dataclass(frozen=True)
class Start(Data):
    """x(t0) of (13) of a finite motion, with sign: rad, rad/s."""

    phi: Annotated[Each, per_flywheel(ANGLE)] = None
    phi_dot: Annotated[Each, per_flywheel(SPEED)] = None


@dataclass(frozen=True)
class Deviation(Data):
    """How far run-up and run-down may take the carrier from its mean pose: O1 (m), angle (rad); inf: any."""

    linear: Annotated[float, scalar(LENGTH, above=0.0)] = math.inf
    angular: Annotated[float, scalar(ANGLE, above=0.0)] = math.inf

    @property
    def limits(self) -> tuple[float, float]:
        """Both."""
        return self.linear, self.angular


@dataclass(frozen=True)
class Bounds(FlywheelBounds):
    """Magnitudes that a programme keeps to; None is no bound. E_x, E_u of (13).

    speed_min  of phi', rad/s: no flywheel slower
    angle      of phi less its winding and its mean, rad
    bias       of each of the six of `bias`: m, rad
    """

    speed_min: Annotated[Each, bound_per_flywheel(SPEED, zero=True)] = None
    angle: Annotated[Each, bound_per_flywheel(ANGLE)] = None
    bias: Annotated[Each, QuantityValidator(_magnitudes)] = None
    deviation: Deviation | None = None
    start: Start = Start()

    def contradictions(self, problems: Problems, winding: Winding, period: float | None) -> None:
        """Note bounds that exclude each other, or the winding; `period` (s) of a periodic motion. A key, a line."""
        said: set[str] = set()

        def refuse(key: str, words: str) -> None:
            if key not in said:
                problems.add("bounds", key, words)
            said.add(key)

        N = len(self.speed or self.speed_min or self.start.phi_dot or ())
        turns: tuple[int | None, ...] = (None,) * N
        if period is not None and winding != "any":
            turns = winding if isinstance(winding, tuple) else ((1,) if winding == "spin" else (0,)) * N
        for s in range(N):
            most = self.speed[s] if self.speed else math.inf
            least = self.speed_min[s] if self.speed_min else 0.0
            if most <= 0.0:  # noted already
                continue
            if least > most:
                refuse("speed_min", f"[{s}]: {least:g} rad/s is above speed, {most:g} rad/s")
                continue
            if self.start.phi_dot and not least <= abs(speed := self.start.phi_dot[s]) <= most:
                outside = f"{speed:g} rad/s is outside speed_min, speed: {least:g} to {most:g}"
                problems.add("bounds", "start", f"phi_dot[{s}]: {outside}")
            n = turns[s]
            if n is None or period is None:
                continue
            mean = 2 * math.pi * abs(n) / period
            if mean > most:
                refuse("speed", f"[{s}]: {most:g} rad/s is below the mean speed of winding {n}, {mean:.6g} rad/s")
            if n == 0 and least > 0.0:
                refuse("speed_min", f"[{s}]: {least:g} rad/s, but with winding 0 a flywheel turns back")
            elif mean < least and winding != "spin":  # which may be more than a turn a period
                words = f"{least:g} rad/s is above the mean speed of winding {n}, {mean:.6g} rad/s"
                refuse("speed_min", f"[{s}]: {words}")


def _weight(value: float, raw: object) -> None:
    if value < 0.0:
        raise QuantityError(f"{value:g} is negative, expected a weight")


Weights = Annotated[tuple[float, ...], per_flywheel(PLAIN, _weight)]


@dataclass(frozen=True)
class Objective(Data):
    """Weights of J(x, u) of (13), not negative, N numbers each."""

    acceleration: Weights = ()
    torque: Weights = ()
    speed_variation: Weights = ()
    power: Weights = ()

    def complete(self, N: int) -> Objective:
        """The weights of N flywheels as a file means them: one left out is 0; without any, acceleration has 1."""
        weights = {key: value or (0.0,) * N for key, value in vars(self).items()}
        return Objective(**weights if any(vars(self).values()) else weights | {"acceleration": (1.0,) * N})


@dataclass(frozen=True, eq=False)
class Slew:
    """A turn of the carrier from rest to rest, demanded by the rows of a task; what no row names is free.

    task      its rows; angular rows are turned along the path, linear ones have no acceleration
    kind      attitude: three angular rows; sight: two of one frame, whose third axis is the line of sight; still: none
    start     C (3, 3) of E1 in E0 at t = 0, at rest, O1 at `position` (m, in E0)
    axis      (3): about which E1 turns, constant in E1 (attitude), or the line of sight, in E1 (sight)
    normal    (3): of the plane in which the line of sight turns, in E0; of a slew of the attitude `start axis`
    angle     of the turn, rad, at most pi; 0 of kind still
    goal      fastest: free duration; quietest: of the given `duration` (s)
    phi, phi_dot   N: angles and speeds of the flywheels at t = 0, rad, rad/s
    bounds    speed, acceleration, torque of the flywheels; the motors' limits hold besides
    doubts    warnings on numbers of the file, a line each
    """

    name: str
    task: Task
    kind: Kind
    start: Array
    position: Vec3
    axis: Array
    normal: Array
    angle: float
    goal: Goal
    duration: float | None
    phi: tuple[float, ...]
    phi_dot: tuple[float, ...]
    bounds: FlywheelBounds
    doubts: tuple[str, ...] = ()
    periodic: Literal[False] = False

    def path(self, sigma: Array) -> Array:
        """Rotations (M, 3, 3) in E0 that turn what is demanded by sigma (M, rad) from the start."""
        from scipy.spatial.transform import Rotation

        return np.asarray(Rotation.from_rotvec(sigma[:, None] * self.normal).as_matrix())


def rows_of(stand: Stand, task: Task) -> Array:
    """S (m, 6) of a task: what its rows take of V*."""
    places = places_of(stand.instruments, stand.points)
    return np.array([row_vector(row, places) for row in task.rows])


def sight_of(task: Task, stand: Stand) -> Array:
    """The line of sight in E1 (3): the axis that no angular row of the frame names."""
    angular = [row for row in task.rows if row.component.startswith("w")]
    (left,) = {0, 1, 2} - {COMPONENTS.index(row.component) - 3 for row in angular}
    axes = places_of(stand.instruments, stand.points)[angular[0].of][1] if angular[0].of else np.eye(3)
    return np.asarray(axes[:, left])


@dataclass(frozen=True, eq=False)
class RequiredMotion:
    """q(t) = mean + bias + course(t), q = (O1 in E0, psi, theta, phi), m and rad, in the stand's sequence.

    periodic, span   period (or of a finite motion the duration), s
    free_mean        which of the six a planner may shift by `bias`
    winding          turns per period: one number per flywheel, or which numbers a planner may choose
    runup            duration of a run-up that is wanted, s; None: none
    free, same       bounds [low, high] by path, and lists of equal paths, of numbers of the stand that `plan` may move
    slew             what is demanded, where the course is one that `plan` found for a slew; else None
    """

    name: str
    periodic: bool
    span: float
    mean: Array
    course: Harmonics | SampledCourse | PlannedCourse
    free_mean: tuple[bool, ...]
    winding: Winding
    bounds: Bounds
    objective: Objective
    runup: float | None
    slew: Slew | None = None
    free: Mapping[str, Sequence[Any]] = field(default_factory=dict)
    same: Sequence[Sequence[str]] = ()

    def at(self, t: Array, bias: Array | float = 0.0) -> Course:
        """q, q', q'' (M, 6 each) at the times t (M, s), any of a periodic motion; `bias` (6) shifts the mean."""
        q, q_dot, q_ddot = self.course.at(np.asarray(t, dtype=np.float64))
        return Course(q + self.mean + bias, q_dot, q_ddot)

    @property
    def harmonics(self) -> tuple[int, ...]:
        """Numbers k of the harmonics, rising; none for a finite motion."""
        return self.course.harmonics

    def check(self, stand: Stand, problems: Problems) -> None:
        """Note a singular attitude on the way, and what leaves the ranges in which coordinates and numbers count."""
        highest = max(self.harmonics, default=1)
        t = self.span * np.arange(M := 32 * min(highest, 1000) + 256) / M
        course, coordinates = self.at(t), coordinates_of(stand)
        angular = np.array([dimension == ANGLE for dimension in coordinates.dimensions])
        for values, most, words in zip(course, MOST, ("q", "q'", "q''"), strict=True):
            for which, (limit, unit) in zip((np.logical_not(angular), angular), most, strict=True):
                peak = float(np.abs(values[:, which]).max(initial=0.0))
                if not peak <= limit:
                    reach = f"{words} reaches {peak:.3g} {unit}"
                    problems.add(f"{reach}, out of range, at most {limit:g} {unit} in magnitude")
        slides = not coordinates.held or not angular.any()  # elsewhere turning moves O1 as well
        if self.bounds.deviation is not None and slides:
            least, bound = (
                float(np.linalg.norm((course.q - self.mean)[:, :3], axis=1).max()),
                self.bounds.deviation.linear,
            )
            if bound < least:
                excess = f"{bound:g} m is below the deviation of the motion itself, {least:g} m"
                problems.add("bounds", "deviation", f"linear: {excess}")
        if coordinates.held:
            _check_turns(course.q, t, coordinates, problems)
            return
        theta = course.q[:, 4]
        name, value = ("sin", np.sin(theta)) if stand.angles == "euler" else ("cos", np.cos(theta))
        i = int(np.argmin(np.abs(value)))
        crossed = np.flatnonzero(np.diff(np.sign(value)))
        if abs(value[i]) < SINGULAR or len(crossed):
            i = int(crossed[0]) if len(crossed) else i
            problems.add(
                f"singular attitude of the {stand.angles} sequence at t = {t[i]:.4g} s, theta = {theta[i]:.6g} rad: "
                f"{name} theta reaches 0; choose another sequence (`angles` of the stand) or mean"
            )


def _check_turns(q: Array, t: Array, coordinates: Coordinates, problems: Problems) -> None:
    """Note where the second of three turns of a held carrier brings the axes of the first and the third together."""
    turns = [k for k in coordinates.order if coordinates.dimensions[k] == ANGLE]
    if len(turns) < 3:
        return
    value = np.cos(q[:, turns[1]])
    i = int(np.argmin(value))
    if value[i] < SINGULAR:
        problems.add(
            f"singular attitude of the freedoms at t = {t[i]:.4g} s: cos of {coordinates.names[turns[1]]} reaches 0; "
            "expected a motion that stays nearer to the home pose"
        )
