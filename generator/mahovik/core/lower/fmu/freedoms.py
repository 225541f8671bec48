"""Coordinates and speeds of the freedoms of a held carrier, as an FMU shows them: an angle with all its turns."""

from __future__ import annotations

from mahovik.core import routines
from mahovik.core.lower.freedom_coordinates import own_coordinates, turns_about_point
from mahovik.core.lower.freedoms import columns, speeds
from mahovik.core.lower.held_coordinates import Target, Ways, read_slides, read_turn
from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind
from mahovik.core.routines.wrap import turns_of_angle

REAL = Kind.REAL


def has_angle(ways: tuple[str, ...]) -> bool:
    """Whether one freedom turns about an axis, so that its angle has turns to be counted."""
    return len(Ways(ways).turns) == 1


def add_all(lib: Library) -> None:
    """Adds `coordinates` and, of an angle, `count_turns`."""
    ways = lib.layout.ways
    if Ways(ways).turns:
        lib.add(routines.atan2(lib.layout.precision))
    lib.add(_coordinates(lib))
    if has_angle(ways):
        lib.add(_count_turns(lib))


def _coordinates(lib: Library) -> Function:
    """Numbers q, the quaternion of three turns, and u of V = S u at a state."""
    ways = lib.layout.ways
    found, own = Ways(ways), own_coordinates(ways)
    table, x = lib.table_argument(), lib.state_argument()
    turns = Argument("turns", REAL, purpose="whole turns of the angle, counted from the start")
    q = Argument("q", REAL, (len(own),), "out", "m, rad", "coordinates of the freedoms, zero in the home pose")
    orientation = Argument("orientation", REAL, (4,), "out", "", "quaternion from the home pose, w first")
    u = Argument("u", REAL, (len(ways),), "out", "m/s, rad/s", "speeds of the freedoms, V = S u")
    body = Body()
    target = Target(q.place, orientation.place)
    if found.turns:
        read_turn(lib, body, found, table.place, x.place, target)
    if has_angle(ways):
        angle = q.place[found.number(found.turns[0])]
        body.set(angle, lib["unwound"](angle, -turns.place))
    if found.slides:
        read_slides(lib, body, found, table.place, x.place, target)
    for k, speed in enumerate(speeds(ways, columns(ways, table.place), x.place.V)):
        body.set(u.place[k], speed)
    arguments = (table, x, *((turns,) if has_angle(ways) else ()), *((q,) if own else ()))
    arguments += (*((orientation,) if turns_about_point(ways) else ()), u)
    return body.function(
        "coordinates", "Coordinates of the freedoms of the hold at a state, and their speeds u.", arguments, public=True
    )


def _count_turns(lib: Library) -> Function:
    """Whole turns that an angle within half a turn of zero has lost in a step."""
    before = Argument("before", REAL, unit="rad", purpose="angle before the step, within half a turn")
    after = Argument("after", REAL, unit="rad", purpose="angle behind it, likewise")
    speed_before = Argument("speed_before", REAL, unit="rad/s", purpose="its speed before the step")
    speed_after = Argument("speed_after", REAL, unit="rad/s", purpose="its speed behind it")
    dt = Argument("dt", REAL, unit="s", purpose="the step")
    turns = Argument("turns", REAL, (), "inout", purpose="whole turns of the angle")
    body = Body()
    expected = body.let("expected", before.place + real(0.5) * dt.place * (speed_before.place + speed_after.place))
    body.add(turns.place, turns_of_angle(lib.layout.precision, expected - after.place))
    return body.function(
        "count_turns",
        "Turns of an angle counted through: those that bring it nearest to what its speeds give.",
        (before, after, speed_before, speed_after, dt, turns),
        public=True,
    )
