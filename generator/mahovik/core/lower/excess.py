"""EXCESSIVE: does an answer of `inverse` need more than the motors have, or too large an acceleration?"""

from __future__ import annotations

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Const, Not, Place, integer, magnitude, or_, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def excessive(lib: Library) -> Function:
    """Whether some flywheel needs more than it has for a motion, from checked inputs."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    turns, phi_ddot, wrench = lib.turn_arguments(), lib.phi_ddot_arguments(), lib.wrench_arguments()
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="that results")
    options = Argument("options", layout.inverse_options, purpose="what each flywheel has")
    flags = Argument("flags", Kind.INT, (), "out", purpose="EXCESSIVE, or 0")
    p, largest = options.place, lib.limits["LARGEST"].expression
    bit = Const(STATUS_VALUES["EXCESSIVE"], Kind.INT, "EXCESSIVE")
    body = Body()
    motors = body.local("motors", (), Kind.INT, comment="flywheels whose motor has a limit")
    found = body.local("found", (), Kind.INT)
    body.set(motors, integer(0))
    body.set(found, integer(0))
    with body.loop("s", layout.count) as s:
        with body.when(magnitude(phi_ddot[0].place[s]) > p.most[s]):
            body.set(found, bit)
        with body.when(or_(p.motor_torque[s] < largest, p.motor_speed[s] < largest)):
            body.set(motors, motors + 1)
    with body.when(motors > 0):
        tau = body.local("tau", (layout.count,), comment="drive torques")
        named = {"table": table.place, "x": x.place, "V_dot": V_dot.place, "tau": tau}
        named |= {a.name: a.place for a in (*turns, *phi_ddot, *wrench)}
        body.call(lib["balance"], *lib.passed("balance", **named))
        with body.loop("s", layout.count) as s:
            body.note("driving, the torque falls linearly to zero at the no-load speed; braking has all of it")
            speed = body.let("speed", x.place.phi_dot[s])
            share = body.local("share")
            body.set(share, real(1))
            with body.when(tau[s] * speed > 0):
                body.set(share, 1 - magnitude(speed) / p.motor_speed[s])
            with body.when(or_(share <= 0, magnitude(tau[s]) > p.motor_torque[s] * share)):
                body.set(found, bit)
    body.set(flags.place, found)
    return body.function(
        "excessive",
        "Does a motion need more than a motor's torque or speed, or a larger phi'' than `most`? Of checked inputs.",
        (table, x, *turns, V_dot, *phi_ddot, options, *wrench, flags),
    )


def check_abilities(lib: Library, body: Body, p: Place, s: Place) -> None:
    """NOT_FINITE or BAD_ARGUMENT where the options say of flywheel s what none can have."""
    most, torque, speed = p.most[s], p.motor_torque[s], p.motor_speed[s]
    for value in (most, torque, speed):
        lib.guard(body, Not(or_(value > 0, value <= 0)), "NOT_FINITE")
    lib.guard(body, or_(or_(most <= 0, torque < 0), speed <= 0), "BAD_ARGUMENT")
