"""EXCESSIVE: does an answer of `inverse` need more than the motors have, or too large an acceleration?"""

from __future__ import annotations

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import (
    Const,
    Not,
    Place,
    and_,
    equal,
    integer,
    magnitude,
    or_,
    real,
    select,
    unequal,
)
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
        body.call(lib["balance"], *lib.arguments_of("balance", **named))
        with body.loop("s", layout.count) as s:
            lacks = lib["motor_lacks"](p, s, tau[s], x.place.phi_dot[s])
            with body.when(unequal(lacks, integer(0))):
                body.set(found, bit)
    body.set(flags.place, found)
    return body.function(
        "excessive",
        "Does a motion need more than a motor's torque or speed, or a larger phi'' than `most`? Of checked inputs.",
        (table, x, *turns, V_dot, *phi_ddot, options, *wrench, flags),
    )


def motor_lacks(lib: Library) -> Function:
    """Whether the motor of a flywheel lacks a torque, with its friction, at a speed."""
    options = Argument("options", lib.layout.inverse_options, purpose="what each flywheel has")
    number, tau = Argument("number", Kind.INT), Argument("tau", Kind.REAL, unit="N m")
    speed = Argument("speed", Kind.REAL, unit="rad/s")
    p, s, v = options.place, number.place, speed.place
    body = Body()
    own = body.local("own", comment="of the motor itself, which bears the friction")
    body.set(own, tau.place + p.motor_viscous[s] * v)
    with body.when(and_(p.motor_coulomb[s] > 0, p.motor_coulomb_speed[s] > 0)):
        ratio = body.let("ratio", v / p.motor_coulomb_speed[s])
        y = body.let("y", select(ratio > 3, real(3), select(ratio < -3, real(-3), ratio)), "tanh y to 0.024")
        square = body.let("square", y * y)
        body.add(own, p.motor_coulomb[s] * (y * (real(27) + square) / (real(27) + real(9) * square)))
    body.note("driving, the torque falls linearly to zero at the no-load speed; braking has all of it")
    share = body.local("share")
    body.set(share, real(1))
    with body.when(own * v > 0):
        body.set(share, 1 - magnitude(v) / p.motor_speed[s])
    lacking = or_(share <= 0, magnitude(own) > p.motor_torque[s] * share)
    body.ret(select(lacking, integer(1), integer(0)))
    return body.function(
        "motor_lacks",
        "Does a motor lack the torque tau, with its friction, at this speed? Its no-load speed is above 0.",
        (options, number, tau, speed),
        returns=Kind.INT,
    )


def spin_up_excess(lib: Library, body: Body, places: tuple[Place, Place, Place], phi_ddot: Place) -> Place:
    """EXCESSIVE, or 0, by Theta_ff phi'' alone: what the carrier's motion adds is left out, for fast loops.

    `places`: table, state, options. Options of motors that are no numbers or negative are not refused: they decide this
    bit alone.
    """
    table, x, p = places
    bit = Const(STATUS_VALUES["EXCESSIVE"], Kind.INT, "EXCESSIVE")
    flags = body.local("flags", (), Kind.INT)
    body.set(flags, integer(0))
    with body.loop("s", lib.layout.count) as s, body.when(and_(equal(flags, integer(0)), p.motor_speed[s] > 0)):
        v, spin = body.let("v", x.phi_dot[s]), body.let("spin", table.flywheel[s].spin)
        size = body.let("size", magnitude(phi_ddot[s]))
        needed = body.let("needed", spin * size + p.motor_viscous[s] * magnitude(v) + p.motor_coulomb[s], "at most")
        has = body.let("has", p.motor_torque[s] * (1 - magnitude(v) / p.motor_speed[s]), "at least: when driving")
        with body.when(Not(and_(size <= p.most[s], needed <= has))):
            lacks = unequal(lib["motor_lacks"](p, s, spin * phi_ddot[s], v), integer(0))
            with body.when(or_(size > p.most[s], lacks)):
                body.set(flags, bit)
    return flags


SPIN_UP_NOTE = (
    "EXCESSIVE counts Theta_ff phi'' and the friction of the motor. The torque that the carrier's motion adds is left "
    "out: `torque` and `inverse` have it. What the options say of motors is not checked; it decides this bit alone."
)


def check_friction(lib: Library, body: Body, p: Place, s: Place) -> None:
    """NOT_FINITE or BAD_ARGUMENT where the options say of the friction of flywheel s what none can have."""
    viscous, coulomb, speed = p.motor_viscous[s], p.motor_coulomb[s], p.motor_coulomb_speed[s]
    for value in (viscous, coulomb, speed):
        lib.guard(body, Not(or_(value > 0, value <= 0)), "NOT_FINITE")
    lib.guard(body, or_(or_(viscous < 0, coulomb < 0), speed <= 0), "BAD_ARGUMENT")


def check_abilities(lib: Library, body: Body, p: Place, s: Place) -> None:
    """NOT_FINITE or BAD_ARGUMENT where the options say of flywheel s what none can have."""
    most, torque, speed = p.most[s], p.motor_torque[s], p.motor_speed[s]
    for value in (most, torque, speed):
        lib.guard(body, Not(or_(value > 0, value <= 0)), "NOT_FINITE")
    lib.guard(body, or_(or_(most <= 0, torque < 0), speed <= 0), "BAD_ARGUMENT")
