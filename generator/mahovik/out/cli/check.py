"""`mahovik check`: validate a stand and print its figures."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from mahovik.contract.quantities import RPM
from mahovik.errors import UsageError
from mahovik.out.cli.check_fluid import fluid_object, print_fluid
from mahovik.out.cli.fitting import column_that_fits, fitting_unit
from mahovik.out.cli.options import STAND_FILE, command, json_option, load_stand, option
from mahovik.out.cli.output import print_json, print_line, print_table
from mahovik.out.cli.progress import progress
from mahovik.out.functions.motor_limits import warn_of_speeds

if TYPE_CHECKING:
    from mahovik.core.stand.capacity import Capacity
    from mahovik.core.stand.identity import Identities
    from mahovik.core.stand.summary import Summary, UnbalanceRow
    from mahovik.core.stand.written import Written


Column = tuple[str, list[str]]
"""Title and cells."""


@command()
def check(
    stand_file: str = STAND_FILE,
    speed: str | None = option(
        "--speed",
        'Turn all flywheels at this speed, "3000 rpm" or rad/s; default: each motor\'s no-load speed.',
        metavar="SPEED",
    ),
    dt: str | None = option(
        "--dt",
        'Show what float steps of this length, "0.1 ms" or s, lose of the speeds.',
        metavar="TIME",
    ),
    planes: str | None = option(
        "--planes",
        'Grade the residuals at two planes this far apart, "40 mm" or m, the mass centre in the middle.',
        metavar="DISTANCE",
    ),
    fluid: str | None = option(
        "--fluid",
        'Print passivity, added mass and growth of small motions at this velocity ahead, "2 m/s" or m/s.',
        metavar="VELOCITY",
    ),
    as_json: bool = json_option("Print JSON instead of tables."),
) -> None:
    """Validate a stand; print its figures.

    Shows masses, centres of mass, principal inertia, the unbalance of each flywheel, its force and balance grade of
    ISO 21940-11 at a speed, momentum and torque of the motors, and numbers with units as they are written. The grade
    is that of the static part; --planes adds the couple, which has no grade alone. Warns of plausible slips; if float
    would not resolve an unbalance; where (12) is singular in practice and no task names the rows that are demanded;
    and of tasks that the flywheels do not reach.
    """
    stand = load_stand(stand_file)
    asked = None if speed is None else abs(_read("--speed", speed, ("an angular speed", "rad/s"), -1e9, 1e9))
    apart = None if planes is None else _read("--planes", planes, ("a length", "m"), 1e-6, 1e6)
    ahead = None if fluid is None else _read("--fluid", fluid, ("a velocity", "m/s"), 1e-3, 1e4)
    if asked is not None:
        warn_of_speeds(stand, [asked] * len(stand.flywheels), [str(speed)] * len(stand.flywheels))
    from mahovik.core.stand import identities
    from mahovik.core.stand.summary import summarize
    from mahovik.core.stand.written import written_numbers
    from mahovik.use.simulate.friction_steps import long_steps
    from mahovik.use.study.excess import excess
    from mahovik.use.study.increments import USUAL_STEP, lost_increments
    from mahovik.use.study.resolution import shortfalls, shortfalls_line
    from mahovik.use.study.task_reach import task_shortfalls

    step = USUAL_STEP if dt is None else _read("--dt", dt, ("a time", "s"), 1e-9, 1e3)
    with progress(f"check {stand.name}"):
        written, doubts = written_numbers(stand_file)
        unbalances = {each.where: each.text for each in written if each.key == "unbalance.static"}
        summary, names = summarize(stand, asked, apart, unbalances), identities(stand)
        summary = replace(summary, warnings=(*summary.warnings, *doubts))
        speeds = [row.speed for row in summary.unbalance]
        short, lost = shortfalls(stand, speeds), [] if dt is None else lost_increments(stand, speeds, step)
        over, unreached = excess(stand), task_shortfalls(stand)
        steep = long_steps(stand, step)
        in_fluid = None
        if ahead is not None:
            from mahovik.use.study.fluid import fluid as fluid_of

            in_fluid = fluid_of(stand, ahead)
    if as_json:
        from dataclasses import asdict

        found = {
            **summary.as_dict(),
            "structure": names.structure,
            "physics": names.physics,
            "float": [asdict(each) for each in short],
            "increments": [asdict(each) | {"part": each.part} for each in lost],
            "friction_steps": [asdict(each) for each in steep],
            "excess": None if over is None else asdict(over),
            "unreached": [asdict(each) for each in unreached],
            "written": [asdict(each) for each in written],
        }
        if in_fluid is not None:
            found["fluid"] = fluid_object(in_fluid)
        print_json(found)
        return
    more = [*filter(None, [shortfalls_line(short)]), *lost, *steep, *([over] if over else []), *unreached]
    _print(summary, names, list(map(str, more)), written)
    if in_fluid is not None:
        print_fluid(in_fluid)


def _read(option: str, text: str, dimension: tuple[str, str], low: float, high: float) -> float:
    """A number in SI, plain or with a unit; `dimension`: words and SI unit. Raises UsageError."""
    from mahovik.core.stand.units import Dimension, QuantityError, number

    try:
        found = float(text)
    except ValueError:
        try:
            found = number(text, Dimension(*dimension))
        except QuantityError as error:
            raise UsageError(f"{option}: {error}") from None
    if not low <= found <= high:
        raise UsageError(f"{option}: {text} is out of range, expected {low:g} to {high:g} {dimension[1]}")
    return found


def _print(summary: Summary, names: Identities, short: list[str], written: list[Written]) -> None:
    print_line(f"   structure {names.structure}, physics {names.physics}", name=summary.name)
    title, masses = column_that_fits("mass", [*(b.mass for b in summary.bodies), summary.mass], "kg")
    print_table(
        ("body", "kind", "mount", title, "centre of mass in E1, m>"),
        (
            (b.name, b.kind, b.mount, mass, _vector(b.center_of_mass))
            for b, mass in zip(summary.bodies, masses, strict=False)
        ),
        total=("all", "", "", masses[-1], _vector(summary.center_of_mass)),
    )
    title, moments = column_that_fits("principal inertia about the centre of mass", summary.principal_inertia, "kg m2")
    print_table((title, "its axis in E1>"), zip(moments, map(_vector, summary.principal_axes), strict=True))
    if summary.unbalance:
        _print_flywheels(summary)
    if summary.tasks:
        print_table(("task", "rows demanded>"), ((task.name, ", ".join(task.rows)) for task in summary.tasks))
    if summary.hold:
        print_line(f"held, {summary.hold}")
        _print_hold(summary)
    _print_written(written)
    for warning in (*summary.warnings, *short):
        print_line(f"warning: {warning}", "yellow")


def _print_flywheels(summary: Summary) -> None:
    """Unbalance of the flywheels, what it does at their speeds, and what their motors can do."""
    rows, names = summary.unbalance, [row.name for row in summary.unbalance]
    columns = (
        column_that_fits("spin inertia", [row.spin_inertia for row in rows], "kg m2"),
        column_that_fits("static", [row.static for row in rows], "kg m"),
        ("at, deg>", [_degrees(row.static_at) for row in rows]),
        column_that_fits("dynamic", [row.dynamic for row in rows], "dynamic"),
        ("at, deg>", [_degrees(row.dynamic_at) for row in rows]),
        column_that_fits("about its mass centre", [row.dynamic_center for row in rows], "dynamic"),
        column_that_fits("J22 - J33", [row.asymmetry for row in rows], "dynamic"),
        column_that_fits("J23", [row.product for row in rows], "dynamic"),
    )
    _print_columns(names, columns)
    effects = (
        ("at, rpm>", [f"{row.speed * RPM:.5g}" for row in rows]),
        column_that_fits("force", [row.force for row in rows], "N"),
        column_that_fits("moment", [row.moment for row in rows], "N m"),
        column_that_fits("couple", [row.couple for row in rows], "N m"),
        column_that_fits("e omega", [row.eccentric_velocity for row in rows], "m/s"),
        ("ISO 21940-11", [row.grade for row in rows]),
        *_at_planes(rows),
        *_capacities(summary, lambda capacity: capacity.each),
    )
    _print_columns(names, effects)
    unit, size = fitting_unit([summary.force], "N")
    print_line(f"reach of force: {summary.force / size:.5g} {unit}, with all unbalances aligned, at these speeds")
    whole = _capacities(summary, lambda capacity: (*capacity.axes, capacity.direction, capacity.total))
    if whole:
        _print_columns(("along x", "along y", "along z", "in every direction", "sum"), whole, "all motors")
    for what, capacity, unit in _kinds(summary):
        print_line(_weakest(what, capacity, unit))


def _weakest(what: str, capacity: Capacity, unit: str) -> str:
    """The direction in E1 in which the motors together reach least, and how much."""
    first, *others = capacity.envelope.worst
    direction = "(" + ", ".join(f"{x:.5g}" for x in first) + ")"
    if capacity.direction == 0.0:
        return f"weakest direction of {what}: {direction} in E1, where the motors with a limit reach nothing"
    unit, size = fitting_unit([capacity.direction], unit)
    more = f"; {len(others)} more such" if others else ""
    return f"weakest direction of {what}: {direction} in E1, {capacity.direction / size:.5g} {unit}{more}"


def _at_planes(rows: Sequence[UnbalanceRow]) -> tuple[Column, ...]:
    """Columns of the residuals at two planes, where these are given."""
    velocities = [row.plane_velocity for row in rows]
    if all(velocity is None for velocity in velocities):
        return ()
    return column_that_fits("at two planes", velocities, "m/s"), (
        "grade there",
        [row.plane_grade or "-" for row in rows],
    )


def _capacities(summary: Summary, values: Callable[[Capacity], Sequence[float | None]]) -> tuple[Column, ...]:
    """Columns of momentum and torque, each if some motor has a limit of it."""
    return tuple(column_that_fits(name, values(capacity), unit) for name, capacity, unit in _kinds(summary))


def _kinds(summary: Summary) -> list[tuple[str, Capacity, str]]:
    """Momentum and torque with their units, each if some motor has a limit of it."""
    kinds = (("momentum", summary.momentum, "N m s"), ("torque", summary.torque, "N m"))
    return [each for each in kinds if each[1].total > 0.0]


def _print_columns(names: Sequence[str], columns: Sequence[Column], head: str = "flywheel") -> None:
    cells = zip(names, *(figures for _, figures in columns), strict=True)
    print_table((head, *(title for title, _ in columns)), cells)


def _print_hold(summary: Summary) -> None:
    """Where the carrier is held, and friction and stops of its freedoms."""
    rows = []
    for each in summary.hold_numbers:
        values, unit = each.printed
        text = "  ".join(f"{x + 0.0:.6g}" for x in values)  # no -0
        rows.append((each.of, each.name, text, unit or "SI"))
    print_table(("held by", "number", "value>", "unit"), rows)


def _print_written(written: list[Written]) -> None:
    """Numbers of the file with units as they are written; those of several bodies in a row. Angles of bodies, which
    other tables have, are left out.
    """
    bodies: dict[tuple[str, str, str], list[str]] = {}
    for each in written:
        if each.unit != "rad" or each.where.partition(".")[0] == "hold":
            bodies.setdefault((each.key, each.text, each.in_si), []).append(each.where)
    if bodies:
        print_table(("written in the file", "value", "SI", "of"), ((*row, ", ".join(of)) for row, of in bodies.items()))


def _degrees(angle: float | None) -> str:
    return "-" if angle is None else f"{math.degrees(angle):.5g}"


def _vector(numbers: tuple[float, float, float]) -> str:
    return "  ".join(f"{round(x, 6) + 0.0:9.6f}" for x in numbers)
