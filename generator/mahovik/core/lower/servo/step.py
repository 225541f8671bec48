"""One sample of the servos.

With e, e' the errors of angle and speed (e within half a turn), f the filtered e', z the integral:
f += filter (e' - f), u = tau_ff + friction + angle e + speed f + z; tau is u inside limit and change;
z += integral e + back (tau - u), inside the limit: what a limit cuts off is taken from the integral (back-calculation,
Astrom and Hagglund, PID Controllers, 1995, section 3.5), so that it does not wind up.
"""

from __future__ import annotations

from mahovik.core.lower.library import Library
from mahovik.core.lower.servo.form import ServoForm
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Operand, Status, equal, integer, or_, real, select, unequal
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind

REACHED = 3.0
"""Ratio speed / coulomb_speed from which dry friction is whole."""


def reset(form: ServoForm) -> Function:
    """`servo_reset(state)`."""
    state = Argument("state", form.state, (), "out", "", "nothing kept, no torque")
    body = Body()
    with body.loop("s", form.count) as s:
        for name in ("integral", "speed", "torque"):
            body.set(state.place.member(name)[s], real(0))
    return body.checked_function(
        "servo_reset",
        "Servos at rest: before the first sample, and whenever the drives were off.",
        (state,),
        statuses=("OK",),
        public=True,
    )


def clamp_function(lib: Library) -> Function:
    """`clamped(value, low, high)`."""
    value, low, high = (Argument(name, Kind.REAL) for name in ("value", "low", "high"))
    body = Body()
    v = value.place
    body.ret(select(v < low.place, low.place, select(v > high.place, high.place, v)))
    return lib.add(body.function("clamped", "The value inside low..high.", (value, low, high), returns=Kind.REAL))


def dry(lib: Library) -> Function:
    """`dry(x)`: tanh(x) by Pade's approximant, which is 1 at 3, and 1 beyond; at most 0.024 off."""
    x = Argument("x", Kind.REAL, purpose="speed / coulomb_speed")
    body = Body()
    y = body.let("y", lib["clamped"](x.place, real(-REACHED), real(REACHED)))
    body.ret(y * (real(27) + y * y) / (real(27) + real(9) * y * y))
    return lib.add(
        body.function(
            "dry",
            "Share of the dry friction: tanh(x) to 0.024, by y (27 + y^2) / (27 + 9 y^2) with y = x inside -3..3.",
            (x,),
            returns=Kind.REAL,
        )
    )


def step(lib: Library, form: ServoForm) -> Function:
    """`servo_step(gains, state, phi_ref, phi_dot_ref, tau_ff, phi, phi_dot, invalid, tau)`."""
    n = (form.count,)
    gains = Argument("gains", form.gains, purpose="as the generator made them")
    state = Argument("state", form.state, (), "inout", "", "what servo_reset made")
    phi_ref = Argument("phi_ref", Kind.REAL, n, unit="rad", purpose="wanted angles")
    phi_dot_ref = Argument("phi_dot_ref", Kind.REAL, n, unit="rad/s", purpose="wanted speeds")
    tau_ff = Argument("tau_ff", Kind.REAL, n, unit="N m", purpose="drive torques of the programme, or zero")
    phi = Argument("phi", Kind.REAL, n, unit="rad", purpose="measured angles")
    phi_dot = Argument("phi_dot", Kind.REAL, n, unit="rad/s", purpose="measured speeds")
    purpose = "not 0: no good reading of this flywheel, whose phi and phi_dot are not looked at; null: all are good"
    invalid = Argument("invalid", Kind.INT, n, purpose=purpose, optional="zeros")
    tau = Argument("tau", Kind.REAL, n, "out", "N m", "what the motors are to give")
    g, x = gains.place, state.place
    body = Body()
    limit = {name: found.expression for name, found in lib.limits.items()}
    angle = body.local("angle", n, comment="measured; wanted where nothing good was")
    speed = body.local("speed", n, comment="likewise")
    with body.loop("s", form.count) as s:
        good = body.let("good", equal(invalid.place[s], integer(0)))
        body.set(angle[s], select(good, phi.place[s], phi_ref.place[s]))
        body.set(speed[s], select(good, phi_dot.place[s], phi_dot_ref.place[s]))
    for place, most in (
        (phi_ref.place, "MAX_PHASE"),
        (phi_dot_ref.place, "MAX_SPEED"),
        (tau_ff.place, "MAX_WRENCH"),
        (angle, "MAX_PHASE"),
        (speed, "MAX_SPEED"),
        (x.integral, "MAX_WRENCH"),
        (x.torque, "MAX_WRENCH"),
    ):
        lib.check(body, "within", place, form.count, limit[most])
    lib.check(body, "within", x.speed, form.count, real(2) * limit["MAX_SPEED"])
    cut = body.local("cut", (), Kind.INT, "was any torque limited?")
    body.set(cut, integer(0))
    with body.loop("s", form.count) as s:
        e = body.let("e", lib["wrapped"](phi_ref.place[s] - angle[s]))
        slip = body.let("slip", phi_dot_ref.place[s] - speed[s])
        body.add(x.speed[s], g.filter * (slip - x.speed[s]))
        body.note("Friction that the reference meets: no noise of the sensor comes into it.")
        dry_part = g.coulomb[s] * lib["dry"](g.coulomb_rate[s] * phi_dot_ref.place[s])
        friction = body.let("friction", g.viscous[s] * phi_dot_ref.place[s] + dry_part)
        u = body.let("u", tau_ff.place[s] + friction + g.angle[s] * e + g.speed[s] * x.speed[s] + x.integral[s])
        inside = body.let("inside", _clamp(lib, u, g.limit[s]))
        low, high = x.torque[s] - g.change[s], x.torque[s] + g.change[s]
        given = body.let("given", lib["clamped"](inside, low, high))
        body.set(cut, select(or_(given < u, given > u), integer(1), cut))
        body.note("The integral loses what the limits cut off.")
        z = body.let("z", x.integral[s] + g.integral[s] * e + g.back[s] * (given - u))
        body.set(x.integral[s], _clamp(lib, z, g.limit[s]))
        body.set(x.torque[s], given)
        body.set(tau.place[s], given)
    with body.when(unequal(cut, integer(0))):
        body.ret(Status("LIMITED"))
    return body.checked_function(
        "servo_step",
        "One sample of the servos of all flywheels.",
        (gains, state, phi_ref, phi_dot_ref, tau_ff, phi, phi_dot, invalid, tau),
        statuses=("OK", "LIMITED", "NOT_FINITE", "RANGE"),
        notes=(
            "tau = tau_ff + friction + angle e + speed f + z, inside limit and change; e the error of the angle, "
            "within half a turn, f that of the speed, filtered, z the integral, which loses what the limits cut off. "
            "LIMITED: a torque was cut.",
            "A flywheel without a good reading continues with tau_ff, friction and z, as if its errors were zero; "
            "the others do not change.",
        ),
        public=True,
    )


def _clamp(lib: Library, value: Operand, limit: Expr) -> Expr:
    return lib["clamped"](value, -limit, limit)
