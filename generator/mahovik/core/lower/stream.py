"""The stream where the carrier is, by the depth of O1."""

from __future__ import annotations

from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, and_, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def add_functions(lib: Library) -> None:
    """The stream by depth, and the check of the depth, where the stand has a profile."""
    if lib.layout.structure.stream_stations:
        lib.add(stream_at(lib))
        lib.add(check_depth(lib))


def check_depth(lib: Library) -> Function:
    """NOT_FINITE or RANGE where a number of the profile is none, or where the profile does not reach to O1.

    Stations increase and `down` has length one, within 1e-3 of its square. The velocity at O1 is in the range of a
    stream, and a shear in that of an angular velocity, so that no product overflows.
    """
    table, x, body = lib.table_argument(), lib.state_argument(), Body()
    profile, limit = table.place.stream_profile, {name: each.expression for name, each in lib.limits.items()}
    last = lib.layout.structure.stream_stations - 1
    lib.check(body, "within", profile.down, 3, real(2))
    down = profile.down
    lib.check_unit(body, body.let("down2", down[0] * down[0] + down[1] * down[1] + down[2] * down[2]))
    lib.check(body, "within", profile.depth, last + 1, limit["MAX_POSITION"])
    lib.check(body, "within", profile.top, 3, limit["MAX_VELOCITY"])
    with body.loop("k", last) as k:
        lib.guard(body, Not(profile.depth[k + 1] > profile.depth[k]), "RANGE")
        lib.check(body, "within", profile.shear[k], 3, limit["MAX_SPEED"])
    depth = body.let("depth", _depth(profile, x.place))
    lib.guard(body, Not(and_(depth >= profile.depth[0], depth <= profile.depth[last])), "RANGE")
    flow = body.local("flow", (3,), comment="stream in E0, at this depth")
    body.call(lib["stream_at"], table.place, x.place, flow)
    lib.check(body, "within", flow, 3, limit["MAX_VELOCITY"])
    return body.checked_function(
        "check_depth", "Is the profile of the stream in its ranges, and the depth of O1 within it?", (table, x)
    )


def stream_at(lib: Library) -> Function:
    """The stream at the depth of O1: the velocity at the top, and the shear of what lies above O1."""
    table, x, body = lib.table_argument(), lib.state_argument(), Body()
    u = Argument("u", Kind.REAL, (3,), "out", "m/s", "velocity of the fluid, in E0")
    profile = table.place.stream_profile
    depth = body.let("depth", _depth(profile, x.place))
    for i in range(3):
        body.set(u.place[i], table.place.stream[i] + profile.top[i])
    with body.loop("k", lib.layout.structure.stream_stations - 1) as k:
        thick = body.let("thick", profile.depth[k + 1] - profile.depth[k])
        above = body.local("above", comment="part of the layer that is above O1")
        body.set(above, depth - profile.depth[k])
        body.set(above, select(above > 0, above, real(0)))
        body.set(above, select(above < thick, above, thick))
        for i in range(3):
            body.add(u.place[i], profile.shear[k][i] * above)
    return body.function("stream_at", "Velocity of the fluid at the depth of O1.", (table, x, u))


def _depth(profile: Place, x: Place) -> Expr:
    """Product of the position and the direction down."""
    down = profile.down
    return down[0] * x.position[0] + down[1] * x.position[1] + down[2] * x.position[2]
