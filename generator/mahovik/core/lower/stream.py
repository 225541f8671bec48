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
        lib.add(check_depth(lib))
        lib.add(stream_at(lib))


def check_depth(lib: Library) -> Function:
    """RANGE where the profile does not reach to the depth of O1."""
    table, x, body = lib.table_argument(), lib.state_argument(), Body()
    profile = table.place.stream_profile
    depth = body.let("depth", _depth(profile, x.place))
    last = lib.layout.structure.stream_stations - 1
    lib.guard(body, Not(and_(depth >= profile.depth[0], depth <= profile.depth[last])), "RANGE")
    return body.checked_function("check_depth", "Is the depth of O1 within the profile of the stream?", (table, x))


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
