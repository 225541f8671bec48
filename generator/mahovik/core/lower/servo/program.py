"""The program of a servo: functions on gains and states, the same for every stand with this number of flywheels."""

from __future__ import annotations

from mahovik.core import routines
from mahovik.core.lower import checks, rotation
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.lower.servo import pose, step, trim
from mahovik.core.lower.servo.form import ServoForm
from mahovik.core.program.function import Program
from mahovik.core.program.types import NamedCount, Struct
from mahovik.core.program.validate import validate


def lower_servo(layout: Layout, form: ServoForm) -> Program:
    """Functions `servo_reset`, `servo_step`, and with a trim `trim_reset`, `trim_step`, `trim_coordinates`.

    A held carrier has its coordinates from `generalized` of the stand's C instead of `trim_coordinates`.
    """
    lib = Library(layout)
    precision = layout.precision
    if form.trim is not None:
        lib.add(routines.sincos(precision))
    if form.trim is not None and form.trim.angles and pose.THETA in form.trim.coordinates:
        lib.add(routines.square_root(precision))
    if form.trim is not None and form.trim.angles:
        lib.add(routines.atan2(precision))
        lib.add(rotation.rotation())
    lib.add(routines.unwind(precision))
    lib.add(routines.wrap(precision, lib["unwound"]))
    lib.add(checks.within(lib))
    step.clamp_function(lib)
    step.dry(lib)
    lib.add(step.reset(form))
    lib.add(step.step(lib, form))
    structs: list[Struct] = [form.gains, form.state]
    counts: list[NamedCount] = [layout.count]
    if form.trim is not None:
        trim.basis(lib, form)
        trim.measure(lib, form)
        trim.correct(lib, form)
        lib.add(trim.reset(form))
        lib.add(trim.step(lib, form))
        if not form.trim.held:
            lib.add(pose.coordinates(lib, form))
        structs += [form.design, form.trim_state]
        counts += [form.trim.measured, form.trim.terms, form.unknowns, form.known]
    program = Program(layout.structure.name, precision, tuple(counts), tuple(structs), lib.functions)
    validate(program)
    return program
