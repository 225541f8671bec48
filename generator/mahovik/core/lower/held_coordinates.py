"""Coordinates of the freedoms of a held carrier: of a state (`generalized`), and the state of coordinates.

The pivot slides by w from its home place, in the axes of the home pose: O1 + C pivot = O1_home + C0 (w + pivot). A turn
about an axis has an angle; all three turns have the quaternion from the home pose. V = S u, and u are the rates of the
coordinates, but for what slides while its direction turns: w* = R u, R = C0^T C.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mahovik.core.formula.derived import hold as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower.forward import STATE_STATUSES
from mahovik.core.lower.freedom_coordinates import (
    in_words,
    own_coordinates,
    rates_in_words,
    turns_about_point,
    turns_slides,
)
from mahovik.core.lower.freedoms import TURNS, columns, speeds
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind
from mahovik.core.program.vector import Matrix
from mahovik.core.stand.hold import FREEDOMS

REAL = Kind.REAL


def add_all(lib: Library) -> None:
    """Adds both functions."""
    lib.add(state_from_coordinates(lib))
    lib.add(generalized(lib))


@dataclass(frozen=True)
class Ways:
    """The freedoms: places of those that slide and turn among all of them, their numbers in q, their directions."""

    ways: tuple[str, ...]

    @property
    def slides(self) -> list[int]:
        """Places of what slides."""
        return [k for k, way in enumerate(self.ways) if way == "slide" or way in "xyz"]

    @property
    def turns(self) -> list[int]:
        """Places of what turns."""
        return [k for k, way in enumerate(self.ways) if way == "turn" or way in TURNS]

    def number(self, k: int) -> int:
        """Place in q."""
        return own_coordinates(self.ways).index(self.ways[k])

    def direction(self, k: int, S: Place) -> list[Expr | int]:
        """Three numbers, in E1: 0 and 1 of a named freedom."""
        way = self.ways[k]
        if way in FREEDOMS:
            return [int(x) for x in FREEDOMS[way].direction]
        first = 0 if way == "slide" else 3
        return [S[first + i][k] for i in range(3)]


@dataclass(frozen=True)
class Target:
    """Where coordinates are written: q, and the quaternion of all three turns."""

    q: Place
    orientation: Place


def _along(direction: list[Expr | int], values: Sequence[Expr]) -> Expr:
    """direction . values."""
    terms = [x if one == 1 else one * x for one, x in zip(direction, values, strict=True) if one != 0]
    total: Expr = terms[0]
    for term in terms[1:]:
        total = total + term
    return total


def _spread(body: Body, target: Place, found: Ways, S: Place, values: list[Expr]) -> None:
    """target (3) = sum of what slides times its direction; named directions, each given once."""
    for i in range(3):
        whole: Expr = real(0)
        for k, value in zip(found.slides, values, strict=True):
            if found.direction(k, S)[i] == 1:
                whole = value
        body.set(target[i], whole)


def generalized(lib: Library) -> Function:
    """Coordinates, their rates, and the rates of these for given phi''."""
    layout, found = lib.layout, Ways(lib.layout.ways)
    table, x = lib.table_argument(), lib.state_argument()
    phi_ddot, wrench = lib.phi_ddot_arguments(), lib.wrench_arguments()
    out = Argument("out", layout.generalized, (), "out", purpose="coordinates of the freedoms, q_dot, q_ddot")
    body, m = Body(), layout.freedoms
    V_dot = body.local("V_dot", (6,))
    u_dot = body.local("u_dot", (m,))
    given = (*(a.place for a in phi_ddot), *(a.place for a in wrench))
    lib.check(body, "forward", table.place, x.place, *given, V_dot, u_dot)
    u = body.local("u", (m,), comment="speeds of the freedoms")
    for k, speed in enumerate(speeds(layout.ways, columns(layout.ways, table.place), x.place.V)):
        body.set(u[k], speed)
    if found.turns:
        turn = read_turn(lib, body, found, table.place, x.place, out.place)
    if found.slides:
        read_slides(lib, body, found, table.place, x.place, out.place)
    for name, values in (("q_dot", u), ("q_ddot", u_dot)):
        body.copy_array(out.place.member(name), values)
    if turns_slides(layout.ways):
        body.note("what slides goes along axes that turn: w* = R u, w** = R (u* + omega x u)")
        R = body.local("R", (9,), comment="turn from the home pose")
        a, b = (body.local(name, (3,), comment=text) for name, text in (("a", "u in E1"), ("b", "u* in E1")))
        body.call(lib["rotation"], turn, R)
        _spread(body, a, found, table.place.S, [u[k] for k in found.slides])
        _spread(body, b, found, table.place.S, [u_dot[k] for k in found.slides])
        whole = body.local("whole", (3,), comment="u* + omega x u")
        assign(body, list(whole), derived.turning_rate(), {"a": a, "b": b, "omega": list(x.place.V)[3:]})
        for name, own in (("q_dot", a), ("q_ddot", whole)):
            rate = body.local(f"{name}_home", (3,), comment="in the axes of the home pose")
            assign(body, list(rate), derived_wrench.rotated(), {"C": R, "a": own})
            for k in found.slides:
                body.set(out.place.member(name)[k], _along(found.direction(k, table.place.S), list(rate)))
    return body.checked_function(
        "generalized",
        "Coordinates of the freedoms of the hold at a state, with their rates, for given phi''.",
        (table, x, *phi_ddot, *wrench, out),
        equation="(10), (11)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
        notes=("What position and attitude are off the hold is left out.",),
        public=True,
    )


def read_turn(lib: Library, body: Body, found: Ways, table: Place, x: Place, out: Place | Target) -> Place:
    """Writes the angle or the quaternion; gives the turn from the home pose as a quaternion of any length."""
    turn = body.local("turn", (4,), comment="from the home attitude, quaternion with w >= 0")
    assign(body, list(turn), derived.from_home(), {"home": table.home_attitude, "q": x.attitude})
    with body.when(turn[0] < 0):
        for i in range(4):
            body.set(turn[i], -turn[i])
    if turns_about_point(found.ways):
        body.copy_array(out.orientation, turn)
        return turn
    (k,) = found.turns
    axis = found.direction(k, table.S)
    half = body.let("half", _along(axis, list(turn)[1:]), "about the axis: sine of half the angle, times a factor")
    body.set(out.q[found.number(k)], real(2) * lib["atan2"](half, turn[0]))
    if turns_slides(found.ways):
        with body.when(Not(turn[0] * turn[0] + half * half > 0), comment="half a turn about another axis"):
            body.set(turn[0], real(1))
        for i in range(3):
            body.set(turn[i + 1], half if axis[i] == 1 else real(0))
    return turn


def read_slides(lib: Library, body: Body, found: Ways, table: Place, x: Place, out: Place | Target) -> None:
    """w = C0^T (O1 + C pivot - O1_home) - pivot, along each direction."""
    C0, C = (body.local(name, (9,), comment=text) for name, text in (("C0", "home attitude"), ("C", "attitude")))
    body.call(lib["rotation"], table.home_attitude, C0)
    body.call(lib["rotation"], x.attitude, C)
    arm = body.local("arm", (3,), comment="from O1 to the pivot, in E0")
    gone = body.local("gone", (3,), comment="to the pivot from the home place of O1, in E0")
    own = body.local("own", (3,), comment="in the axes of the home pose")
    assign(body, list(arm), derived_wrench.rotated(), {"C": C, "a": table.pivot})
    for i in range(3):
        body.set(gone[i], x.position[i] - table.home_position[i] + arm[i])
    body.call(lib["rotate_back"], C0, gone, own)
    w: list[Expr] = [own[i] - table.pivot[i] for i in range(3)]
    for k in found.slides:
        body.set(out.q[found.number(k)], _along(found.direction(k, table.S), w))


def _inputs(lib: Library) -> list[Argument]:
    """q, orientation, q_dot, q_ddot: those that the freedoms have."""
    ways, arguments = lib.layout.ways, []
    if own := own_coordinates(ways):
        arguments.append(Argument("q", REAL, (len(own),), unit="m, rad", purpose=in_words(ways)))
    if turns_about_point(ways):
        purpose = "attitude from the home pose: unit quaternion, w first"
        arguments.append(Argument("orientation", REAL, (4,), purpose=purpose))
    rates = Argument("q_dot", REAL, (len(ways),), unit="m/s, rad/s", purpose=rates_in_words(ways))
    return [*arguments, rates, Argument("q_ddot", REAL, (len(ways),), unit="m/s2, rad/s2", purpose="rates of q_dot")]


def state_from_coordinates(lib: Library) -> Function:
    """Position, attitude, V and V* of coordinates and their rates."""
    layout, found, m = lib.layout, Ways(lib.layout.ways), lib.layout.freedoms
    table, arguments = lib.table_argument(), _inputs(lib)
    given = {a.name: a.place for a in arguments}
    purpose = "its position, attitude and V are written; phases and speeds are kept"
    x = Argument("x", layout.state, (), "inout", purpose=purpose)
    V_dot = Argument(
        "V_dot", REAL, (6,), "out", "m/s2, rad/s2", "derivative of the components of V, as inverse takes it"
    )
    body = Body()
    _check_coordinates(lib, body, found, given)
    T = table.place
    attitude = body.local("attitude", (4,))
    turn = body.local("turn", (4,), comment="from the home attitude, as a quaternion")
    _write_turn(lib, body, found, T, given, turn)
    assign(body, list(attitude), derived.turned_home(), {"home": T.home_attitude, "q": turn})
    position = _write_position(lib, body, found, T, given, attitude)
    u, u_dot = (body.local(name, (m,)) for name in ("u", "u_dot"))
    body.copy_array(u, given["q_dot"])
    body.copy_array(u_dot, given["q_ddot"])
    if turns_slides(layout.ways):
        _turn_rates_back(lib, body, found, T, turn, u, u_dot)
    V, rate = (body.local(name, (6,)) for name in ("V", "rate"))
    for target, values in ((V, u), (rate, u_dot)):
        body.set(target, Matrix(columns(layout.ways, T)).T @ values)
    lib.check(body, "within", position, 3, lib.limits["MAX_POSITION"].expression)
    lib.check(body, "within", V, 6, lib.limits["MAX_SPEED"].expression)
    lib.check(body, "within", V, 3, lib.limits["MAX_VELOCITY"].expression)
    for target, values in ((x.place.position, position), (x.place.attitude, attitude), (x.place.V, V)):
        body.copy_array(target, values)
    body.copy_array(V_dot.place, rate)
    return body.checked_function(
        "state_from_coordinates",
        "State and V* of coordinates of the freedoms of the hold and their rates: V = S u, V* = S u*.",
        (table, *arguments, x, V_dot),
        equation="(10)",
        statuses=STATE_STATUSES,
        public=True,
    )


def _check_coordinates(lib: Library, body: Body, found: Ways, given: dict[str, Place]) -> None:
    """Ranges: of coordinates those of positions, in float of an angle that of phases, a quaternion of unit length."""
    limit = {name: each.expression for name, each in lib.limits.items()}
    angle = "MAX_PHASE" if lib.layout.precision.name == "float" else "MAX_POSITION"  # the narrower of both
    for k in range(len(found.ways)):
        if found.ways[k] in own_coordinates(found.ways):
            most = limit["MAX_POSITION" if k in found.slides else angle]
            lib.check_number(body, given["q"][found.number(k)], most)
    if "orientation" in given:
        q = given["orientation"]
        lib.check(body, "within", q, 4, real(2))
        lib.check_unit(body, body.let("norm2", q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]))
    lib.check(body, "within", given["q_dot"], len(found.ways), limit["MAX_SPEED"])
    lib.check(body, "within", given["q_ddot"], len(found.ways), limit["MAX_ACCELERATION"])


def _write_turn(lib: Library, body: Body, found: Ways, table: Place, given: dict[str, Place], turn: Place) -> None:
    """The turn from the home attitude."""
    if "orientation" in given:
        body.copy_array(turn, given["orientation"])
        return
    for i, value in enumerate((1, 0, 0, 0)):
        body.set(turn[i], real(value))
    for k in found.turns:
        s, c = body.local("s", comment="sine of half the angle"), body.local("c")
        body.call(lib["sincos"], real(0.5) * given["q"][found.number(k)], s, c)
        body.set(turn[0], c)
        for i, one in enumerate(found.direction(k, table.S)):
            if one != 0:
                body.set(turn[i + 1], s if one == 1 else s * one)


def _write_position(
    lib: Library, body: Body, found: Ways, table: Place, given: dict[str, Place], attitude: Place
) -> Place:
    """O1 = O1_home + C0 (w + pivot) - C pivot."""
    C0, C = (body.local(name, (9,), comment=text) for name, text in (("C0", "home attitude"), ("C", "attitude")))
    body.call(lib["rotation"], table.home_attitude, C0)
    body.call(lib["rotation"], attitude, C)
    place = body.local("place", (3,), comment="of the pivot from the home place of O1, in the axes of the home pose")
    for i in range(3):
        whole: Expr = table.pivot[i]
        for k in found.slides:
            one = found.direction(k, table.S)[i]
            if one != 0:
                way = given["q"][found.number(k)]
                whole = whole + (way if one == 1 else way * one)
        body.set(place[i], whole)
    gone, arm = (body.local(name, (3,), comment="in E0") for name in ("gone", "arm"))
    assign(body, list(gone), derived_wrench.rotated(), {"C": C0, "a": place})
    assign(body, list(arm), derived_wrench.rotated(), {"C": C, "a": table.pivot})
    position = body.local("position", (3,))
    for i in range(3):
        body.set(position[i], table.home_position[i] + (gone[i] - arm[i]))
    return position


def _turn_rates_back(lib: Library, body: Body, found: Ways, table: Place, turn: Place, u: Place, u_dot: Place) -> None:
    """u = R^T w*, u* = R^T w** - omega x u of what slides, in place."""
    R = body.local("R", (9,), comment="turn from the home pose")
    body.call(lib["rotation"], turn, R)
    omega = body.local("omega", (3,), comment="angular velocity")
    for i in range(3):
        turning = [k for k in found.turns if found.direction(k, table.S)[i] == 1]
        body.set(omega[i], u[turning[0]] if turning else real(0))
    a, b = (body.local(name, (3,), comment="in E1") for name in ("a", "b"))
    home = body.local("home", (3,), comment="in the axes of the home pose")
    for values, target in ((u, a), (u_dot, b)):
        _spread(body, home, found, table.S, [values[k] for k in found.slides])
        body.call(lib["rotate_back"], R, home, target)
    rate = body.local("rate_along", (3,), comment="u* of what slides, in E1")
    assign(body, list(rate), derived.rate_before_turning(), {"a": a, "b": b, "omega": omega})
    for k in found.slides:
        direction = found.direction(k, table.S)
        body.set(u[k], _along(direction, list(a)))
        body.set(u_dot[k], _along(direction, list(rate)))
