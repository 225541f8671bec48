"""`check`: a stand validated, its figures, its rest pose, warnings; the tools of this machine."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from mahovik.errors import CheckError, UsageError
from mahovik.out.arguments import Phases, Seconds, Speed, StandGiven, command, quantity
from mahovik.out.notices import warn_of_speeds
from mahovik.out.result import Result, column, columns_of

if TYPE_CHECKING:
    from mahovik.core.stand.capacity import Capacity
    from mahovik.core.stand.model import Stand
    from mahovik.core.stand.numbers import Written
    from mahovik.core.stand.summary import Summary

AXES = ("x", "y", "z")


@command(excludes={"tools": ("stand", "speed", "phase", "dt")})
def check(
    stand: StandGiven | None = None,
    *,
    speed: Speed | None = None,
    phase: Phases | None = None,
    dt: Seconds | None = None,
    tools: bool = False,
) -> Result:
    """Validate a stand; print its figures.

    Shows masses, centres of mass, principal inertia, the unbalance of each flywheel, its force and balance grade of
    ISO 21940-11 at a speed, momentum and torque of the motors, the rest pose, and numbers with units as they are
    written. The grade is that of the static part. Warns of
    plausible slips; if float would not resolve an unbalance; where (12) is singular in practice and no task names the
    rows that are demanded; and of tasks that the flywheels do not reach.

    Args:
        stand: the stand file.
        speed: turn all flywheels at this speed, rad/s or "3000 rpm"; default each motor's no-load speed.
        phase: rest with a flywheel at this phase, rad or "w1=90 deg"; default 0.
        dt: show what float steps of this length, s or "0.1 ms", lose of the speeds.
        tools: list compilers, emulators, checkers and extras on this machine, and how to install the others. Only a C
            compiler is needed for daily work; exit status 1 without one.

    Raises:
        StandError: every problem of the stand file.
        UsageError: a number out of its range, an unknown flywheel.
    """
    if tools:
        return _tools()
    if stand is None:
        raise UsageError("stand: missing, expected a stand file, or tools=True")
    from mahovik.core.stand.numbers import written_numbers
    from mahovik.core.stand.summary import summarize
    from mahovik.core.stand.units import SPEED, TIME
    from mahovik.out.api.stands import Stand
    from mahovik.use.simulate.held import USUAL_STEP, long_steps, lost_increments
    from mahovik.use.study.shortfalls import excess, shortfalls, shortfalls_line, task_shortfalls
    from mahovik.use.vibration.speeds import read_phases

    machine = Stand.of(stand)
    turning = None if speed is None else abs(quantity("speed", speed, SPEED, -1e9, 1e9))
    step = USUAL_STEP if dt is None else quantity("dt", dt, TIME, 1e-9, 1e3)
    phases = read_phases("phase", machine, phase)
    if turning is not None:
        count, text = len(machine.flywheels), f"{speed:g}" if isinstance(speed, float) else str(speed)
        warn_of_speeds(machine, [turning] * count, [text] * count)
    written, doubts = written_numbers(vars(machine).get("_document", {}))
    summary = summarize(machine, turning, {w.where: w.text for w in written if w.key == "unbalance.static"})
    speeds = [row.speed for row in summary.unbalance]
    short, over = shortfalls(machine, speeds), excess(machine)
    unreached, steep = task_shortfalls(machine), long_steps(machine, step)
    lost = [] if dt is None else lost_increments(machine, speeds, step)
    line, held = shortfalls_line(short), [f"held, {summary.hold}"] if summary.hold else []
    warnings = [*summary.warnings, *doubts, *([line] if line else []), *map(str, lost), *map(str, steep)]
    warnings += [str(shortfall) for shortfall in (over, *unreached) if shortfall is not None]
    rest, pose = _rest(machine, phases)
    meta, details = _figures(machine, summary, written)
    more: dict[str, Any] = {
        "rest": rest, "float": short, "increments": lost, "friction_steps": steep, "excess": over,
        "unreached": unreached,
    }  # fmt: skip
    return Result(
        f"{machine.name}   structure {meta['structure']}, physics {meta['physics']}",
        columns_of(
            summary.bodies,
            {"name": "", "kind": "", "mount": "", "mass": "kg", "center_of_mass": "m"},
            {"center_of_mass": AXES},
        ),
        rows="bodies",
        meta=meta | more,
        units={"total_mass": "kg", "total_center_of_mass": "m", "inertia": "kg m2", "worst_unbalance_force": "N"},
        messages=[*held, *pose, *(f"warning: {line}" for line in warnings)],
        details=(*details, *more),
    )  # fmt: skip


def _figures(stand: Stand, summary: Summary, written: Sequence[Written]) -> tuple[dict[str, Any], list[str]]:
    """What stands beside the bodies, and the names of what only JSON has."""
    from mahovik.core.stand import identities

    names = identities(stand)
    unbalance = {
        "name": "", "spin_inertia": "kg m2", "static": "kg m", "static_at": "rad", "dynamic": "kg m2",
        "dynamic_at": "rad", "dynamic_center": "kg m2", "asymmetry": "kg m2", "product": "kg m2",
    }  # fmt: skip
    effects = {"name": "", "speed": "rad/s", "force": "N", "moment": "N m", "couple": "N m"}
    effects |= {"eccentric_velocity": "m/s", "grade": ""}
    capacities = [("momentum", summary.momentum, "N m s"), ("torque", summary.torque, "N m")]
    capacities = [entry for entry in capacities if entry[1].total > 0.0]
    numbers = [(number, *number.printed) for number in summary.hold_numbers]
    bodies: dict[tuple[str, str, str], list[str]] = {}
    for one in written:
        if one.unit != "rad" or not one.key.startswith("unbalance."):  # those are in the table of unbalance
            bodies.setdefault((one.key, one.text, one.in_si), []).append(one.where)
    meta: dict[str, Any] = {
        "stand": stand.name, "structure": names.structure, "physics": names.physics, "total_mass": summary.mass,
        "total_center_of_mass": list(summary.center_of_mass), "inertia": summary.inertia,
        "principal": Result("principal inertia about the centre of mass", (
            column("inertia", "kg m2", summary.principal_inertia),
            column("axis", "", summary.principal_axes, AXES),
        )),
        "unbalance": Result("unbalance", columns_of(summary.unbalance, unbalance)),
        "effects": Result("what it does at this speed", columns_of(summary.unbalance, effects, shown={"speed": "rpm"})),
        "worst_unbalance_force": summary.force if summary.unbalance else None,
        "capacity": Result("what all motors reach", (
            column("of", "", [name for name, _, _ in capacities]),
            column("along", "", [capacity.axes for _, capacity, _ in capacities], AXES),
            column("in every direction", "", [capacity.direction for _, capacity, _ in capacities]),
            column("sum", "", [capacity.total for _, capacity, _ in capacities]),
            column("unit", "", [unit for *_, unit in capacities]),
            column("weakest direction", "", [_weakest(capacity) for _, capacity, _ in capacities]),
        )),
        "tasks": Result("tasks", (
            column("name", "", [task.name for task in summary.tasks]),
            column("rows", "", [", ".join(task.rows) for task in summary.tasks]),
        )),
        "hold": Result("held", (
            column("by", "", [number.of for number, *_ in numbers]),
            column("number", "", [number.name for number, *_ in numbers]),
            column("value", "", ["  ".join(f"{x + 0.0:.6g}" for x in values) for _, values, _ in numbers]),
            column("unit", "", [unit or "SI" for *_, unit in numbers]),
        )),
        "written": Result("written in the file", (
            column("key", "", [key for key, _, _ in bodies]),
            column("value", "", [text for _, text, _ in bodies]),
            column("SI", "", [si for *_, si in bodies]),
            column("of", "", [", ".join(where) for where in bodies.values()]),
        )),
        "momentum": summary.momentum, "torque": summary.torque,
    }  # fmt: skip
    return meta, ["stand", "structure", "physics", "inertia", "momentum", "torque"]


def _weakest(capacity: Capacity) -> str:
    """The direction in E1 in which the motors together reach least."""
    first, *equals = capacity.worst
    more = f"; {len(equals)} more such" if equals else ""
    return f"({', '.join(f'{x:.5g}' for x in first)}){more}"


def _rest(stand: Stand, phases: Sequence[float]) -> tuple[dict[str, Any] | None, list[str]]:
    """The rest pose with flywheels at rest, and sentences about it; None and why where there is none."""
    from mahovik.proof.verify.states import state_object
    from mahovik.use.study.rest import TWIST, rest, sag

    try:
        rest_pose = rest(stand, phases)
    except CheckError as error:
        return None, [str(error).removeprefix(f"{stand.name}: ")]
    words, more = rest_pose.words(), dict[str, Any]()
    if (low := sag(stand, rest_pose.state)) is not None:
        more["sag"] = low.tolist()
        shown = ", ".join(f"{name} {round(1e3 * x, 6) + 0.0:.4g}" for name, x in zip(TWIST, low, strict=True))
        words.append(f"static sag of the isolators from where they are unloaded, mm and mrad in E1: {shown}")
    numbers = {name: getattr(rest_pose, name) for name in ("V_dot", "free", "unstable", "frequencies")}
    return {"state": state_object(rest_pose.state), **numbers, **more}, words


def _tools() -> Result:
    from mahovik.core.toolchain.doctor import findings

    result = findings()
    return Result(
        "tools on this machine",
        (
            *columns_of(result, {"what": "", "serves": ""}),
            column("found", "", [finding.installed for finding in result]),
            column("install", "", ["" if finding.installed else finding.install for finding in result]),
        ),
        rows="tools",
        ok=bool(result[0].installed),
    )
