"""The program of a stand: all functions in order, unused ones left out."""

from __future__ import annotations

from dataclasses import replace

from mahovik.core import routines
from mahovik.core.lower import (
    allocate,
    checks,
    coordinates,
    demand,
    drive,
    excess,
    flywheels,
    forward,
    hold,
    identify_step,
    inverse,
    jacobian,
    matrices,
    mounts,
    prepare,
    regressor,
    solve,
    step,
    stream,
    task,
    task_torque,
    wrenches,
)
from mahovik.core.lower.freedoms import rows_of
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.program.function import Function, Program
from mahovik.core.program.simplify import (
    loops_of_no_turn,
    prune,
    without_idle_calls,
    without_short_loops,
)
from mahovik.core.program.types import Precision
from mahovik.core.program.validate import validate
from mahovik.core.program.walk import reachable, used_structs
from mahovik.core.routines.jacobi import name_for_rows
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure


def lower(stand: Stand, precision: Precision) -> Program:
    """The program for a stand at a precision. Its text depends on the stand's structure only, not on its numbers."""
    return lower_layout(Layout(structure(stand), precision))


def lower_layout(layout: Layout, chosen: tuple[str, ...] = (), slopes: bool = True) -> Program:
    """The program for a layout. `chosen`: functions of CHOSEN that it has besides; by default none.

    Without `slopes` it has no Jacobians, which take a quarter of the time.
    """
    lib = Library(layout)
    precision = layout.precision
    lib.add(routines.sincos(precision))
    lib.add(routines.square_root(precision))
    lib.add(routines.atan2(precision))
    lib.add(routines.unwind(precision))
    lib.add(routines.wrap(precision, lib["unwound"]))
    checks.add_checks(lib)
    lib.add(coordinates.rotation())
    lib.add(coordinates.rotate_back)
    if layout.held:
        lib.add(coordinates.turn_back)
    lib.add(flywheels.start_sums(lib))
    if layout.flywheels:
        # beside few freedoms a call of it counts
        lib.add(replace(routines.sincos_each(precision, layout.count), short=layout.held))
        lib.add(flywheels.sum_mass(lib))
        lib.add(flywheels.sum_spin(lib, steady=True))
        lib.add(flywheels.sum_spin(lib))
    _add_wrenches(lib)
    solve.add_momentum(lib)
    solve.add_solution(lib)
    if layout.held:
        hold.add_hold(lib)
    forward.add_forward(lib)
    matrices.add_matrices(lib)
    matrices.add_momentum(lib)
    if layout.flywheels:
        lib.add(flywheels.couple(lib))
        solve.add_elimination(lib)
        drive.add_torque(lib)
        solve.add_block_solution(lib)
        drive.add_coupled(lib)
    step.add_all(lib)
    if slopes and (layout.freedoms or not layout.held):
        jacobian.add_all(lib)
    if not layout.held or (layout.freedoms and layout.flywheels):
        _add_inverse(lib)
    if layout.sensors:
        matrices.add_points(lib)
    coordinates.add_all(lib)
    _add_prepare(lib)
    if layout.flywheels:
        mounts.add_mounts(lib)
        lib.add(mounts.prepare_mounts(lib))
    if layout.held:
        drive.add_reaction(lib)
    if "regressor" in chosen:
        regressor.add_all(lib)
    if "identify_step" in chosen and layout.unbalances:
        identify_step.add_all(lib)
    return _program(lib)


def _add_inverse(lib: Library) -> None:
    """(12), of the carrier and of each task."""
    layout, tasks = lib.layout, [task.Rows(lib.layout, one) for one in lib.layout.structure.tasks]
    if not layout.flywheels:
        demand.add_factor(lib)
        demand.add_demand(lib)
        inverse.add_inverse_alone(lib)
        return
    for rows in (None, *tasks):
        m = len(rows) if rows else layout.inverse_rows
        new = name_for_rows("allocate", m) not in lib
        if new:
            lib.add(routines.orthogonalise(layout.inverse_work, layout.count, lib["sqrt"], layout.precision.name, m))
        if not rows:
            demand.add_factor(lib, m)
            demand.add_demand(lib)
        if new:
            lib.add(allocate.allocate(lib, m))
        if rows:
            task.add_demand(lib, rows)
        else:
            excess.add_motor_curve(lib)
            excess.add_motor_lacks(lib)
            excess.add_excessive(lib)
        inverse.add_inverse(lib, rows)
        inverse.add_inverse_fast(lib, rows)
        if rows:
            task_torque.add_torque(lib, rows)


def lower_numbers(layout: Layout) -> Program:
    """The part of `lower_layout` that makes a stand's table of its parameters: all that lower/values runs."""
    lib = Library(layout)
    lib.add(routines.sincos(layout.precision))
    lib.add(routines.square_root(layout.precision))
    lib.add(checks.within(lib))
    lib.add(coordinates.quaternion(lib))
    _add_prepare(lib)
    if layout.flywheels:
        lib.add(mounts.prepare_mounts(lib))
    program = _program(lib)
    if layout.held:  # stops ask for the axes of the home pose
        program = replace(program, functions=(coordinates.rotation(), *program.functions))
    return program


def _program(lib: Library) -> Program:
    layout = lib.layout
    counts = tuple(c for c in (layout.count, layout.input_count, layout.sensor_count) if c.value)
    spare: tuple[Function, ...] = ()
    if layout.flywheels:
        turning = (flywheels.sum_spin(lib, steady, apart=True) for steady in (True, False))
        spare = tuple(map(prune, (flywheels.sum_mass(lib, apart=True), *turning)))
    functions = tuple(  # matrices of one freedom have one row
        without_short_loops(f) if layout.held or any(loops_of_no_turn(f.body)) else f for f in reachable(lib.functions)
    )
    if layout.held:  # clamped carriers have no equations
        functions = reachable(without_idle_calls(functions))
    filled = (held for struct in (layout.state, layout.parameters, layout.table) for held in struct.inner_structs())
    structs = tuple(dict.fromkeys((*filled, *used_structs(functions))))
    program = Program(layout.structure.name, layout.precision, counts, structs, functions, spare)
    validate(program)
    return program


def _add_prepare(lib: Library) -> None:
    """`prepare`, and what it needs."""
    layout = lib.layout
    prepare.add_frame_of_axes(lib)
    prepare.add_carry(lib)
    if layout.along:
        if "project_mass" not in lib:
            lib.add(hold.project_mass(lib))
        lib.add(hold.project_harmonic(lib))
    prepare.add_check_inertia(lib)
    lib.add(prepare.check_body(lib, layout.body))
    if layout.flywheels and layout.flywheel_body is not layout.body:
        lib.add(prepare.check_body(lib, layout.flywheel_body))
    if layout.flywheels:
        purpose = "Origin and axes (at phi = 0) of a flywheel in E1."
        prepare.add_placement(lib, "place_flywheel", layout.flywheel_parameters, purpose)
    if layout.structure.points:
        prepare.add_placement(lib, "place_point", layout.point_parameters, "Origin and axes of a point in E1.")
    if layout.added_mass:
        prepare.add_added_mass(lib)
    prepare.add_check_parameters(lib)
    prepare.add_prepare(lib)


def _add_wrenches(lib: Library) -> None:
    """The stream and the laws of (7) that the stand has."""
    stream.add_functions(lib)
    if not lib.layout.wrenches:
        return
    wrenches.add_laws(lib)
    wrenches.add_check_actuators(lib)
    wrenches.add_external(lib)
    rows = rows_of(lib.layout.ways)
    if lib.layout.along and len(rows) < 6 and (lib.layout.weight or "suspend" in lib):
        wrenches.add_external(lib, rows)
