"""points: readings of an accelerometer and a gyro at each instrument and point."""

from __future__ import annotations

from mahovik.core.formula.derived import point as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def sense(lib: Library) -> Function:
    """One sensor's reading from checked inputs."""
    layout = lib.layout
    sensor = Argument("sensor", layout.sensor)
    position = Argument("r", Kind.REAL, (3,), unit="m", purpose="of O1")
    V = Argument("V", Kind.REAL, (6,))
    V_dot = Argument("V_dot", Kind.REAL, (6,))
    C = Argument("C", Kind.REAL, (9,), purpose="attitude of the carrier")
    g = Argument("g", Kind.REAL, (3,), unit="m/s2", purpose="gravity in E1")
    out = Argument("out", layout.points_result, (), "out")
    body = Body()
    six, rates = parts_of_twist(V.place), list(V_dot.place)
    O, R = sensor.place.origin, sensor.place.axes
    velocity = body.local("velocity", (3,), comment="in E1")
    force = body.local("force", (3,), comment="acceleration minus gravity, in E1")
    bound = six | {"O": O, "velocity": velocity, "v_dot": rates[:3], "omega_dot": rates[3:], "g": g.place}
    assign(body, list(velocity), derived_wrench.twist_at(), bound)
    assign(body, list(force), derived.specific_force(layout.weight), bound)
    assign(body, list(out.place.position), derived.position_in_E0(), {"r": position.place, "C": C.place, "O": O})
    product = derived.attitude_in_E0()
    for i in range(3):
        assign(body, list(out.place.C[i]), product[i, :], {"C": C.place, "R": R})
    back = derived_wrench.rotated_back()
    own = list(out.place.twist)
    assign(body, own[:3], back, {"C": R, "a": velocity})
    assign(body, own[3:], back, {"C": R, "a": six["omega"]})
    assign(body, list(out.place.specific_force), back, {"C": R, "a": force})
    assign(body, list(out.place.angular_acceleration), back, {"C": R, "a": rates[3:]})
    return body.function(
        "sense",
        "Reading of an accelerometer and a gyro at one instrument or point.",
        (sensor, position, V, V_dot, C, g, out),
    )


def points(lib: Library) -> Function:
    """Readings of all instruments and points."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="derivative of the components of V")
    out = Argument(
        "out",
        layout.points_result,
        (layout.sensor_count,),
        "out",
        purpose="one reading for each instrument, then for each point",
    )
    body = Body()
    check_inputs(lib, body, table, x)
    lib.check(body, "within", V_dot.place, 6, lib.limits["MAX_ACCELERATION"].expression)
    C = body.local("C", (9,), comment="attitude")
    body.call(lib["rotation"], x.place.attitude, C)
    named = {"r": x.place.position, "V": x.place.V, "V_dot": V_dot.place, "C": C, "g": None}
    if layout.weight:
        g = body.local("g", (3,), comment="gravity in E1")
        body.call(lib["rotate_back"], C, table.place.gravity, g)
        named["g"] = g
    with body.loop("k", layout.sensor_count) as k:
        here = {"sensor": table.place.sensor[k], "out": out.place[k]}
        body.call(lib["sense"], *lib.arguments_of("sense", **named, **here))
    return body.checked_function(
        "points",
        "Readings of an accelerometer and a gyro at each instrument and point.",
        (table, x, V_dot, out),
        statuses=STATE_STATUSES,
        public=True,
    )
