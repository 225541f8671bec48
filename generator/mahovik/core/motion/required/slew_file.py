"""A motion file of type "slew" -> Slew; and the slew with the course that a programme keeps -> RequiredMotion."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any, Literal, cast

import numpy as np

from mahovik.core.motion.document import validate_table
from mahovik.core.motion.fields import choice, per_flywheel
from mahovik.core.motion.required.bounds import Bounds
from mahovik.core.motion.required.model import Objective, RequiredMotion
from mahovik.core.motion.required.slew import Array, Kind, Slew, kind_of, rows_of, sight_of
from mahovik.core.stand.echoes import beyond_a_turn
from mahovik.core.stand.fields import Length3, Table, Text, scalar, validator
from mahovik.core.stand.frames import turn
from mahovik.core.stand.mean import Unbalance
from mahovik.core.stand.model import Stand, Task, Vec3
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.shapes import direction, vec3, vector
from mahovik.core.stand.task import TaskTable, check_tasks
from mahovik.core.stand.units import ANGLE, PLAIN, SPEED, TIME, TORQUE, Dimension, QuantityError, show
from mahovik.errors import MotionError
from mahovik.nearest import suggestion

if TYPE_CHECKING:
    from mahovik.core.motion.programme import Programme

_SEQUENCE = {"ship": (2, 1, 0), "aircraft": (1, 2, 0), "euler": (2, 0, 2)}
_UNIT = 1e-3
_SAME = 1e-9
"""rad: a smaller turn is none."""

ANGULAR_ACCELERATION = Dimension("an angular acceleration", "rad/s^2")


def _quaternion(raw: Any) -> tuple[float, ...]:
    found = vector(raw, (4,), PLAIN)
    if abs(math.hypot(*found) - 1.0) > _UNIT:
        raise QuantityError(f"length {math.hypot(*found):.6g}, expected 1 within {_UNIT:g}")
    return found


def _above(value: float, raw: Any) -> None:
    if value <= 0.0:
        raise QuantityError(f"{show(raw)} is not above 0: a bound is a magnitude")


Each = tuple[float, ...] | None
Angles = Annotated[Vec3 | None, validator(lambda raw: vec3(raw, ANGLE), ANGLE)]
Towards = Annotated[Vec3 | None, validator(direction)]
Four = Annotated[tuple[float, ...] | None, validator(_quaternion)]


class StartTable(Table):
    """`start`: at rest."""

    position: Length3 = (0.0, 0.0, 0.0)
    angles: Angles = None
    quaternion: Four = None
    phi: Annotated[Each, per_flywheel(ANGLE)] = None
    phi_dot: Annotated[Each, per_flywheel(SPEED)] = None


class EndTable(Table):
    """`end`: an attitude, or a direction of the line of sight in E0."""

    angles: Angles = None
    quaternion: Four = None
    direction: Towards = None


class SlewBounds(Table):
    """`bounds` of the flywheels."""

    speed: Annotated[Each, per_flywheel(SPEED, _above)] = None
    acceleration: Annotated[Each, per_flywheel(ANGULAR_ACCELERATION, _above)] = None
    torque: Annotated[Each, per_flywheel(TORQUE, _above)] = None


class SlewTable(Table):
    """A motion file of type "slew"."""

    name: Text = ""
    note: Text = ""
    type: Literal["slew"]
    task: Text | None = None
    rows: Any = None
    start: StartTable = StartTable()
    end: EndTable = EndTable()
    goal: Annotated[Literal["fastest", "quietest"] | None, choice("fastest", "quietest")] = None
    duration: Annotated[float | None, scalar(TIME, above=1e-3, most=1e6)] = None
    bounds: SlewBounds = SlewBounds()
    unbalance: Annotated[Unbalance, choice("averaged", "resisted")] = "averaged"


def read_slew(document: dict[str, Any], stand: Stand, name: str, problems: Problems) -> Slew:
    """The slew of a document. Raises MotionError with every problem."""
    table = validate_table(SlewTable, document, problems, flywheels=len(stand.flywheels))
    if table is None:
        raise MotionError(problems.lines)
    task = _task(table, stand, problems)
    goal = table.goal or ("fastest" if table.duration is None else "quietest")
    if goal == "quietest" and table.duration is None:
        problems.add("duration", "required with the goal quietest: the slower, the quieter")
    if goal == "fastest" and table.duration is not None:
        problems.add("duration", "not allowed with the goal fastest, whose duration is found")
    if task is None or problems.lines:
        raise MotionError(problems.lines)
    S = rows_of(stand, task)
    kind = kind_of(task, S)
    if kind not in ("attitude", "sight", "still"):
        raise MotionError([f"{problems.source}: rows: {kind}"])
    kind = cast(Kind, kind)
    start = _attitude(stand, table.start.angles, table.start.quaternion, problems, "start")
    axis, normal, angle = _turn(kind, table, stand, task, start, problems)
    if kind == "still" and table.duration is None:
        problems.add("duration", "required: no row turns, so that nothing else says how long it lasts")
    if problems.lines:
        raise MotionError(problems.lines)
    N = len(stand.flywheels)
    bounds = table.bounds
    ends = ((key, (document.get(key) or {}).get("angles", 0)) for key in ("start", "end"))
    doubts = (line for key, raw in ends for line in beyond_a_turn(f"{key}.angles", raw))
    return Slew(
        name, task, kind, start, table.start.position, axis, normal, angle, goal, table.duration,
        table.start.phi or (0.0,) * N, table.start.phi_dot or (0.0,) * N,
        Bounds(speed=bounds.speed, acceleration=bounds.acceleration, torque=bounds.torque),
        table.unbalance, tuple(doubts),
    )  # fmt: skip


def _task(table: SlewTable, stand: Stand, problems: Problems) -> Task | None:
    if (table.task is None) == (table.rows is None):
        problems.add("expected one of task, rows, found " + ("none" if table.task is None else "task and rows"))
        return None
    if table.task is not None:
        for task in stand.tasks:
            if task.name == table.task:
                return task
        names = [task.name for task in stand.tasks]
        problems.add("task", f"unknown {show(table.task)}{suggestion(table.task, names, 'the stand has none')}")
        return None
    found = validate_table(TaskTable, {"rows": table.rows}, problems)
    if found is None:
        return None
    task = Task("rows", found.rows)
    check_tasks(problems, (task,), stand.instruments, stand.points)
    return task


def _attitude(stand: Stand, angles: Vec3 | None, quaternion: Any, problems: Problems, key: str) -> Array:
    """C of angles in the stand's sequence or of a quaternion w, x, y, z; aligned with E0 where neither is given."""
    if angles is not None and quaternion is not None:
        problems.add(key, "expected angles or quaternion, found both")
    if quaternion is not None:
        from scipy.spatial.transform import Rotation  # no other motion needs SciPy

        return np.asarray(Rotation.from_quat(quaternion, scalar_first=True).as_matrix())
    C = np.eye(3)
    for axis, value in zip(_SEQUENCE[stand.angles], angles or (0.0, 0.0, 0.0), strict=True):
        C = C @ turn(axis, value)
    return C


def _turn(
    kind: str, table: SlewTable, stand: Stand, task: Task, start: Array, problems: Problems
) -> tuple[Array, Array, float]:
    """Axis, normal and angle of the shortest turn from start to end."""
    end = table.end
    none = np.array([1.0, 0.0, 0.0]), start @ np.array([1.0, 0.0, 0.0]), 0.0
    given = [key for key in ("angles", "quaternion", "direction") if getattr(end, key) is not None]
    if kind == "still":
        if given:
            problems.add("end", f"{given[0]}: not allowed without angular rows: nothing turns there")
        return none
    if kind == "attitude":
        if given not in (["angles"], ["quaternion"]):
            problems.add("end", f"expected angles or quaternion, found {', '.join(given) or 'none'}")
            return none
        wanted = _attitude(stand, end.angles, end.quaternion, problems, "end")
        from scipy.spatial.transform import Rotation  # no other motion needs SciPy

        turned = Rotation.from_matrix(start.T @ wanted).as_rotvec()
        angle = float(np.linalg.norm(turned))
        if angle < _SAME:
            problems.add("end", "is the attitude of the start: there is nothing to turn")
            return none
        axis = turned / angle
        return axis, start @ axis, angle
    sight = sight_of(task, stand)
    if given != ["direction"]:
        problems.add("end", f"expected direction of the line of sight in E0, found {', '.join(given) or 'none'}")
        return none
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
    N = len(slew.phi)
    bounds = Bounds(
        speed=slew.bounds.speed, acceleration=slew.bounds.acceleration, torque=slew.bounds.torque,
        start_phi=slew.phi, start_phi_dot=slew.phi_dot,
    )  # fmt: skip
    none = (0.0,) * N
    return RequiredMotion(
        slew.name, False, programme.span, np.zeros(6), programme.carrier, (False,) * 6, "any", bounds,
        Objective(none, none, none, none), None, slew,
    )  # fmt: skip
