"""Part of the twist and of the pose that the hold blocks, at the start of an FMU of a held carrier."""

from __future__ import annotations

from mahovik.core.formula.derived import hold as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower.freedom_coordinates import turns_about_point
from mahovik.core.lower.freedoms import TURNS, columns
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, magnitude, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind

ALLOWED = 1e-6
"""m, rad; m/s, rad/s: a start may be off what the hold allows by as much as figures of six digits are."""


def off_hold(lib: Library) -> Function:
    """Twist and pose less what the freedoms give. The pose is looked at where the freedoms have coordinates."""
    table, x = lib.table_argument(), lib.state_argument()
    off = Argument("off", Kind.REAL, (12,), "out", "m/s, rad/s; m, rad", "blocked part of V; then of the pose")
    body = Body()
    for i in range(6):
        body.set(off.place[i], x.place.V[i])
        body.set(off.place[6 + i], real(0))
    _take_freedoms(body, lib, table.place, off.place)
    if lib.layout.coordinates:
        _blocked_pose(body, lib, table.place, x.place, off.place)
    for first, size, count in ((0, x.place.V, 6), (6, x.place.position, 3)):
        most = body.local("allowed_twist" if first == 0 else "allowed_pose", comment="share of what is given")
        body.set(most, real(ALLOWED))
        for i in range(count):
            with body.when(real(ALLOWED) * magnitude(size[i]) > most):
                body.set(most, real(ALLOWED) * magnitude(size[i]))
        for i in range(first, first + 6):
            lib.guard(body, Not(magnitude(off.place[i]) <= most), "RANGE")
    return body.checked_function(
        "off_hold",
        "Part of the twist and of the pose that the hold blocks; RANGE where one is more than rounding.",
        (table, x, off) if lib.layout.freedoms else (x, off),
        public=True,
    )


def _blocked_pose(body: Body, lib: Library, table: Place, x: Place, off: Place) -> None:
    """off[6..8]: w = C0^T (O1 + C pivot - O1_home) - pivot less what slides; off[9..11]: the turn about other axes."""
    C0, C = (body.local(name, (9,), comment=text) for name, text in (("C0", "home attitude"), ("C", "attitude")))
    body.call(lib["rotation"], table.home_attitude, C0)
    body.call(lib["rotation"], x.attitude, C)
    arm, gone = (body.local(name, (3,), comment="in E0") for name in ("arm", "gone"))
    own = body.local("own", (3,), comment="way of the pivot, in the axes of the home pose")
    slid = body.local("slid", (3,), comment="its part along what slides")
    assign(body, list(arm), derived_wrench.rotated(), {"C": C, "a": table.pivot})
    for i in range(3):
        body.set(gone[i], x.position[i] - table.home_position[i] + arm[i])
    body.call(lib["rotate_back"], C0, gone, own)
    for i in range(3):
        body.set(own[i], own[i] - table.pivot[i])
    assign(body, list(slid), derived_wrench.rotated(), {"C": table.sliding, "a": own})
    for i in range(3):
        body.set(off[6 + i], own[i] - slid[i])
    ways = lib.layout.ways
    if turns_about_point(ways):
        return
    turn = body.local("turn", (4,), comment="from the home attitude")
    assign(body, list(turn), derived.from_home(), {"home": table.home_attitude, "q": x.attitude})
    axis = next(
        (c[3:] for way, c in zip(ways, columns(ways, table), strict=True) if way in (*TURNS, "turn")), (0, 0, 0)
    )
    about = body.local("about", comment="part of the turn about the axis")
    body.set(about, real(0))
    for one, value in zip(axis, list(turn)[1:], strict=True):
        if not isinstance(one, int) or one:
            body.add(about, one * value)
    for i, one in enumerate(axis):
        along = real(0) if isinstance(one, int) and not one else one * about
        body.set(off[9 + i], real(2) * (turn[i + 1] - along))


def _take_freedoms(body: Body, lib: Library, table: Place, rest: Place) -> None:
    """rest (6) less its parts along the columns of S, each made orthogonal to those before it."""
    before: list[Place] = []
    for k, column in enumerate(columns(lib.layout.ways, table)):
        own = body.local(f"s{k + 1}", (6,), comment=f"freedom {k + 1}, orthogonal to those before it")
        for i, element in enumerate(column):
            body.set(own[i], real(element) if isinstance(element, int) else element)
        for j, other in enumerate(before):
            share = body.let(f"share{k + 1}{j + 1}", _dot(own, other) / _dot(other, other))
            for i in range(6):
                body.add(own[i], -(share * other[i]))
        along = body.let(f"along{k + 1}", _dot(own, rest) / _dot(own, own))
        for i in range(6):
            body.add(rest[i], -(along * own[i]))
        before.append(own)


def _dot(a: Place, b: Place) -> Expr:
    total: Expr = a[0] * b[0]
    for i in range(1, 6):
        total = total + a[i] * b[i]
    return total
