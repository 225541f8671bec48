"""The program of an FMU: what its wrapper computes beside the functions of the stand."""

from __future__ import annotations

from mahovik.core import routines
from mahovik.core.formula.derived import motion as derived
from mahovik.core.lower import checks, rotation
from mahovik.core.lower.fmu.freedoms import add_all as add_coordinates
from mahovik.core.lower.fmu.freedoms import has_angle
from mahovik.core.lower.fmu.off_hold import off_hold
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, and_, integer, real, unequal
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Kind
from mahovik.core.program.validate import validate
from mahovik.core.program.walk import reachable


def lower_fmu(layout: Layout) -> Program:
    """Functions `unit_attitude`, `pose_rates` and, with flywheels, `count_phases`; of a held carrier `off_hold`.

    Where the hold has coordinates also `coordinates` and, of an angle, `count_turns`.
    """
    lib = Library(layout)
    precision = layout.precision
    lib.add(routines.square_root(precision))
    lib.add(checks.within(lib))
    lib.add(rotation.rotation())
    lib.add(_unit_attitude(lib))
    lib.add(_pose_rates(lib))
    if layout.flywheels:
        lib.add(routines.unwind(precision))
        lib.add(routines.wrap(precision, lib["unwound"]))
        lib.add(_count_phases(lib))
    if layout.held:
        lib.add(rotation.rotate_back)
        lib.add(off_hold(lib))
    if layout.coordinates:
        if has_angle(layout.ways) and not layout.flywheels:
            lib.add(routines.unwind(precision))
        add_coordinates(lib)
    counts = (layout.count,) if layout.flywheels else ()
    program = Program(layout.structure.name, precision, counts, (), reachable(lib.functions))
    validate(program)
    return program


def _square(q: Place) -> Expr:
    return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]


_SQUARED = 1e100
"""Components up to here have squares, and so a length that a message can give."""


def _unit_attitude(lib: Library) -> Function:
    """Brings a quaternion that is nearly of unit length to unit length."""
    attitude = Argument("attitude", Kind.REAL, (4,), "inout", purpose="quaternion, w first")
    strict = Argument("strict", Kind.INT, purpose="not 0: RANGE where it is not within 1e-3 of unit length")
    length = Argument("length", Kind.REAL, (), "out", purpose="as it was given")
    q = attitude.place
    body = Body()
    body.set(length.place, real(0))
    lib.check(body, "within", q, 4, real(_SQUARED))
    square = body.let("square", _square(q))
    body.set(length.place, lib["sqrt"](square))
    lib.guard(body, Not(and_(square > real(0.5), square < real(2))), "RANGE")
    with body.when(unequal(strict.place, integer(0))):
        lib.check_unit(body, square)
    inverse = body.let("inverse", 1 / length.place)
    for i in range(4):
        body.set(q[i], q[i] * inverse)
    return body.checked_function("unit_attitude", "Quaternion to unit length.", (attitude, strict, length), public=True)


def _pose_rates(lib: Library) -> Function:
    """Rates of position and attitude, for an integrator that knows nothing of unit length."""
    attitude = Argument("attitude", Kind.REAL, (4,), purpose="quaternion, w first, of nearly unit length")
    V = Argument("V", Kind.REAL, (6,), unit="m/s, rad/s", purpose="twist of the carrier relative to E0, in E1")
    position_dot = Argument("position_dot", Kind.REAL, (3,), "out", "m/s", "of O1, in E0")
    attitude_dot = Argument("attitude_dot", Kind.REAL, (4,), "out", "1/s", "of the quaternion")
    q = attitude.place
    body = Body()
    C = body.local("C", (9,), comment="attitude")
    body.call(lib["rotation"], q, C)
    bound = parts_of_twist(V.place) | {"C": C, "q": q}
    assign(body, list(position_dot.place), derived.position_rate(), bound)
    assign(body, list(attitude_dot.place), derived.quaternion_rate(), bound)
    off = body.let("off", 1 - _square(q), "zero for the exact solution; it dies away with exp(-2 t)")
    for i in range(4):
        body.add(attitude_dot.place[i], off * q[i])
    return body.function(
        "pose_rates",
        "Rates of position and quaternion; the quaternion is drawn to unit length, as an integrator loses it.",
        (attitude, V, position_dot, attitude_dot),
        public=True,
    )


def _count_phases(lib: Library) -> Function:
    """Phases counted through over a step that wraps them."""
    count = lib.layout.count

    def array(name: str, direction: str = "in", unit: str = "rad", purpose: str = "") -> Argument:
        return Argument(name, Kind.REAL, (count,), direction, unit, purpose)

    before, after = array("before", purpose="phases before the step"), array("after", purpose="behind it")
    speed_before = array("speed_before", unit="rad/s", purpose="speeds before the step")
    speed_after = array("speed_after", unit="rad/s", purpose="behind it")
    dt = Argument("dt", Kind.REAL, unit="s", purpose="the step")
    phi = array("phi", "inout", purpose="phases with all their turns")
    body = Body()
    with body.loop("s", count) as s:
        expected = body.let("expected", real(0.5) * dt.place * (speed_before.place[s] + speed_after.place[s]))
        turned = body.let("turned", after.place[s] - before.place[s] - expected, "but for whole turns, small")
        body.add(phi.place[s], expected + lib["wrapped"](turned))
    return body.function(
        "count_phases",
        "Phases counted through: how far flywheels turned in a step, by their phases and, for whole turns, speeds.",
        (before, after, speed_before, speed_after, dt, phi),
        public=True,
    )
