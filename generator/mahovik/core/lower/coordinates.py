"""Generalized coordinates and the state that they are: `quaternion`, `generalized`, `state_from_coordinates`.

Of a free carrier place and angles: A, D of (10), I0, J0 and q_ddot of (11). Of a held one those of its freedoms, where
it has such. state_from_coordinates gives a wanted motion in them as the twist and its rate that inverse takes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mahovik.core.derive import SEQUENCES
from mahovik.core.formula.derived import attitude as derived
from mahovik.core.formula.derived import formula
from mahovik.core.lower.checks import check_number, check_vector
from mahovik.core.lower.forward import STATE_STATUSES
from mahovik.core.lower.freedoms import (
    columns,
    in_words,
    rates_in_words,
    scalar_coordinates,
    slides,
    speeds,
    turns_about_point,
    turns_slides,
)
from mahovik.core.lower.library import Library
from mahovik.core.lower.limits import SINGULAR, unit_square
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Status
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import (
    OK,
    RANGE,
    Reals,
    argument,
    body,
    changed,
    inline,
    kernel,
    let,
    local,
    reals,
    record,
    result,
)
from mahovik.core.program.types import Kind
from mahovik.core.program.vector import Matrix, Vector, cross, dot
from mahovik.core.stand.hold import FREEDOMS

ANGLES = ("psi", "theta", "phi")
SINGULAR_ATTITUDE = Status("SINGULAR_ATTITUDE")


def add_all(lib: Library) -> None:
    """Adds the functions of a free carrier, or those of a held one whose poses have coordinates of its freedoms."""
    lib.add(quaternion(lib))
    if not lib.layout.held:
        add_state_from_coordinates(lib)
        add_generalized(lib)
    elif lib.layout.coordinates:
        add_held_coordinates(lib)


def rotation() -> Function:
    """Rotation matrix of a quaternion of any length."""

    @kernel()
    def rotation(q: Reals = argument("quaternion, w first", 4), C: Reals = result("x0 = C x1, row by row", 9)) -> None:
        """Rotation matrix of a quaternion of any length: no square root is needed."""
        k = 2 / dot(q, q)
        C[:] = formula(derived.rotation_of_quaternion(), q=q, k=k)

    return rotation


@kernel(short=True)
def turn_back(
    q: Reals = argument("quaternion, w first", 4),
    a: Reals = argument("", 3),
    out: Reals = result("must not overlap a", 3),
) -> None:
    """C^T a of a quaternion of any length: no matrix is needed."""
    k = 2 / dot(q, q)
    t = -cross(a, q[1:4])
    out[:] = a + k * (-q[0] * t + cross(q[1:4], t))


@kernel()
def rotate_back(
    C: Reals = argument("", 9), a: Reals = argument("", 3), out: Reals = result("must not overlap a", 3)
) -> None:
    """C^T a: components from the outer axes to the rotated axes."""
    out[:] = C.T @ a


@kernel()
def rotate(
    C: Reals = argument("", 9), a: Reals = argument("", 3), out: Reals = result("must not overlap a", 3)
) -> None:
    """C a: from the turned axes to the outer ones."""
    out[:] = C @ a


def angles_argument(lib: Library) -> Argument:
    """psi, theta, phi in the sequence of the stand."""
    sequence = lib.layout.structure.angles
    axes = " ".join(f"C{axis}({name})" for axis, name in zip(SEQUENCES[sequence], ANGLES, strict=True))
    return Argument("angles", Kind.REAL, (3,), unit="rad", purpose=f"psi, theta, phi of C = {axes} ({sequence})")


def sines_and_cosines(lib: Library, angles: list[Any]) -> dict[str, Expr]:
    """Locals s_psi, c_psi, ... of three angles."""
    numbers: dict[str, Expr] = {}
    for name, angle in zip(ANGLES, angles, strict=True):
        s, c = numbers[f"s_{name}"], numbers[f"c_{name}"] = body().local(f"s_{name}"), body().local(f"c_{name}")
        body().do(lib["sincos"](angle, s, c))
    return numbers


def quaternion(lib: Library) -> Function:
    """Unit quaternion of three angles."""
    psi_theta_phi: Any = angles_argument(lib)

    @kernel(statuses=STATE_STATUSES, public=True)
    def quaternion(angles: Reals = psi_theta_phi, attitude: Reals = result("unit quaternion, w first", 4)) -> Status:
        """Attitude quaternion of three angles."""
        check_vector(lib, angles, lib.limit("MAX_PHASE"))
        numbers = sines_and_cosines(lib, [0.5 * angle for angle in angles])
        attitude[:] = formula(derived.quaternion_of(lib.layout.structure.angles), **numbers)
        return OK

    return quaternion


def add_state_from_coordinates(lib: Library) -> None:
    """Adds V = A q_dot, V_dot = A q_ddot + D q_dot (10)."""
    layout, sequence = lib.layout, lib.layout.structure.angles
    psi_theta_phi: Any = angles_argument(lib)

    @lib.kernel(equation="(10)", statuses=(*STATE_STATUSES, "SINGULAR_ATTITUDE"), public=True)
    def state_from_coordinates(
        position: Reals = argument("position of O1, in E0", 3, unit="m"),
        angles: Reals = psi_theta_phi,
        q_dot: Reals = argument("rates of position and of the angles", 6, unit="m/s, rad/s"),
        q_ddot: Reals = argument("rates of q_dot", 6, unit="m/s2, rad/s2"),
        x: Any = changed("its position, attitude and V are written; phases and speeds are kept", struct=layout.state),
        V_dot: Reals = result("derivative of the components of V", 6, unit="m/s2, rad/s2"),
    ) -> Status:
        """State and V_dot of a wanted motion in generalized coordinates: V = A q_dot, V_dot = A q_ddot + D q_dot."""
        check_vector(lib, position, lib.limit("MAX_POSITION"))
        lib["within"](q_dot, 6, lib.limit("MAX_SPEED"))
        lib["within"](q_ddot, 6, lib.limit("MAX_ACCELERATION"))
        attitude = reals(4)
        C = reals(9)
        v = reals(3)  # C^T r_dot
        a = reals(3)  # C^T r_ddot
        omega = reals(3)  # B (psi_dot, theta_dot, phi_dot)
        lib["quaternion"](angles, attitude)
        numbers = sines_and_cosines(lib, list(angles))
        singular = let("singular", formula(derived.singular(sequence), **numbers))
        if abs(singular) < SINGULAR:
            return SINGULAR_ATTITUDE
        lib["rotation"](attitude, C)
        v[:] = C.T @ q_dot[0:3]
        a[:] = C.T @ q_ddot[0:3]
        rates = dict(zip(("psi_dot", "theta_dot", "phi_dot"), q_dot[3:6], strict=True))
        omega[:] = formula(derived.angular_velocity(sequence), **numbers, a=q_dot[3:6])
        # V_dot = A q_ddot + D q_dot: v_dot = C^T r_ddot - omega x v
        V_dot[0:3] = cross(v, omega) + a
        turning = derived.angular_acceleration(sequence)
        V_dot[3:6] = formula(turning, **numbers, **rates, a=q_ddot[3:6], b=q_dot[3:6])
        x.position[:] = position
        x.attitude[:] = attitude
        x.V[0:3] = v
        x.V[3:6] = omega
        return OK


def add_generalized(lib: Library) -> None:
    """Adds the generalized-coordinate form at a state given by angles."""
    layout, sequence = lib.layout, lib.layout.structure.angles
    psi_theta_phi: Any = angles_argument(lib)

    @lib.kernel(equation="(11)")
    def products(m: Any = argument(struct=layout.matrices), out: Any = changed(struct=layout.generalized)) -> None:
        """I0 = K A, J0 = K D + M A."""
        for i in range(6):
            for j in range(6):
                I0: float = 0
                J0: float = 0
                for k in range(6):
                    I0 += m.K[i][k] * out.A[k][j]
                    J0 += m.K[i][k] * out.D[k][j] + m.M[i][k] * out.A[k][j]
                out.I0[i][j] = I0
                out.J0[i][j] = J0

    statuses = (*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "SINGULAR_ATTITUDE")

    @lib.kernel(equation="(10), (11)", statuses=statuses, public=True)
    def generalized(
        table: Any = lib.table,
        x: Any = argument("state; its attitude is ignored, `angles` replaces it", struct=layout.state),
        angles: Reals = psi_theta_phi,
        phi_ddot: Any = lib.phi_ddot,
        wrench: Any = lib.wrench,
        out: Any = result("A, D, I0, J0, q_dot, q_ddot", struct=layout.generalized),
    ) -> Status:
        """The equations in generalized coordinates: A, D, I0, J0, q_dot, and q_ddot for given phi_ddot."""
        y = record(layout.state)  # the state with the attitude of the angles
        V_dot = reals(6)
        m = record(layout.matrices)
        y = x
        lib["quaternion"](angles, y.attitude)
        numbers = sines_and_cosines(lib, list(angles))
        singular = let("singular", formula(derived.singular(sequence), **numbers), "A has no inverse where this is 0")
        lib["forward"](table, y, None, None, phi_ddot, wrench, V_dot, None)
        lib["matrices"](table, y, wrench, m)
        if abs(singular) < SINGULAR:
            return SINGULAR_ATTITUDE
        if layout.stream:
            # J0 of (11) holds M at V itself, not relative to the stream
            lib["velocity_matrix"](x.V, m)
        C = reals(9)
        lib["rotation"](y.attitude, C)
        singular_inv = 1 / singular
        inverse = derived.angle_rates(sequence)
        # q_dot = A^-1 V
        out.q_dot[0:3] = C @ x.V[0:3]
        out.q_dot[3:6] = formula(inverse, **numbers, singular_inv=singular_inv, a=x.V[3:6])
        rates = dict(zip(("psi_dot", "theta_dot", "phi_dot"), out.q_dot[3:6], strict=True))
        A, D = derived.kinematics(sequence)
        out.A[:] = formula(A, **numbers, **rates, C=C, omega=x.V[3:6]).square
        out.D[:] = formula(D, **numbers, **rates, C=C, omega=x.V[3:6]).square
        rest = reals(6)  # V_dot - D q_dot
        for i in range(6):
            rest[i] = dot((1, *-out.D[i]), (V_dot[i], *out.q_dot))
        # q_ddot = A^-1 (V_dot - D q_dot)
        out.q_ddot[0:3] = C @ rest[0:3]
        out.q_ddot[3:6] = formula(inverse, **numbers, singular_inv=singular_inv, a=rest[3:6])
        products(m, out)
        return OK


# Coordinates of the freedoms of a held carrier. The pivot slides by w from its home place, in the axes of the home
# pose: O1 + C pivot = O1_home + C0 (w + pivot). A turn about an axis has an angle; all three turns have the quaternion
# from the home pose. V = S u, and u are the rates of the coordinates, but for what slides while its direction turns:
# w_dot = R u, R = C0^T C.


@dataclass(frozen=True)
class Ways:
    """The freedoms: places of those that slide and turn among all of them, their numbers in q, their directions."""

    ways: tuple[str, ...]

    @property
    def slides(self) -> list[int]:
        """Places of what slides."""
        return [k for k, way in enumerate(self.ways) if slides(way)]

    @property
    def turns(self) -> list[int]:
        """Places of what turns."""
        return [k for k, way in enumerate(self.ways) if not slides(way)]

    def number(self, k: int) -> int:
        """Place in q."""
        return scalar_coordinates(self.ways).index(self.ways[k])

    def direction(self, k: int, S: Any) -> Vector:
        """Three numbers, in E1: 0 and 1 of a named freedom."""
        way = self.ways[k]
        if way in FREEDOMS:
            return Vector(int(x) for x in FREEDOMS[way].direction)
        return S[0:3, k] if way == "slide" else S[3:6, k]

    def spread(self, S: Any, values: Any) -> list[Any]:
        """The sum of what slides times its direction; named directions, each given once."""
        along = [(self.direction(k, S), values[k]) for k in self.slides]
        return [next((value for one, value in along if one[i] == 1), 0) for i in range(3)]


@dataclass(frozen=True)
class Target:
    """Where coordinates are written: q, and the quaternion of all three turns."""

    q: Any
    orientation: Any


def add_held_coordinates(lib: Library) -> None:
    """Adds both functions."""
    layout, freedoms, m, ways = lib.layout, Ways(lib.layout.ways), lib.layout.freedoms, lib.layout.ways
    count = len(scalar_coordinates(ways))
    rates: Any = argument(rates_in_words(ways), m, unit="m/s, rad/s")

    @lib.kernel(equation="(10)", statuses=STATE_STATUSES, public=True)
    def state_from_coordinates(
        table: Any = lib.table,
        q: Any = argument(in_words(ways), count, unit="m, rad") if count else None,
        orientation: Any = argument("attitude from the home pose: unit quaternion, w first", 4)
        if turns_about_point(ways)
        else None,
        q_dot: Reals = rates,
        q_ddot: Reals = argument("rates of q_dot", m, unit="m/s2, rad/s2"),
        x: Any = changed("its position, attitude and V are written; phases and speeds are kept", struct=layout.state),
        V_dot: Reals = result("derivative of the components of V, as inverse takes it", 6, unit="m/s2, rad/s2"),
    ) -> Status:
        """State and V_dot of coordinates of the freedoms of the hold and their rates: V = S u, V_dot = S u_dot."""
        check_coordinates(lib, freedoms, q, orientation)
        lib["within"](q_dot, m, lib.limit("MAX_SPEED"))
        lib["within"](q_ddot, m, lib.limit("MAX_ACCELERATION"))
        attitude = reals(4)
        turn = reals(4)  # from the home attitude, as a quaternion
        write_turn(lib, freedoms, table, q, orientation, turn)
        attitude[:] = formula(derived.turned_home(), home=table.home_attitude, q=turn)
        position = write_position(lib, freedoms, table, q, attitude)
        u = reals(m)
        u_dot = reals(m)
        u[:] = q_dot
        u_dot[:] = q_ddot
        if turns_slides(ways):
            turn_rates_back(lib, freedoms, table, turn, u, u_dot)
        V = reals(6)
        rate = reals(6)
        S = Matrix(columns(ways, table)).T
        V[:] = S @ u
        rate[:] = S @ u_dot
        lib["within"](position, 3, lib.limit("MAX_POSITION"))
        lib["within"](V, 6, lib.limit("MAX_SPEED"))
        lib["within"](V, 3, lib.limit("MAX_VELOCITY"))
        x.position[:] = position
        x.attitude[:] = attitude
        x.V[:] = V
        V_dot[:] = rate
        return OK

    @lib.kernel(
        equation="(10), (11)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
        notes=("What position and attitude are off the hold is left out.",),
        public=True,
    )
    def generalized(
        table: Any = lib.table,
        x: Any = lib.x,
        phi_ddot: Any = lib.phi_ddot,
        wrench: Any = lib.wrench,
        out: Any = result("coordinates of the freedoms, q_dot, q_ddot", struct=layout.generalized),
    ) -> Status:
        """Coordinates of the freedoms of the hold at a state, with their rates, for given phi_ddot."""
        V_dot = reals(6)
        u_dot = reals(m)
        lib["forward"](table, x, None, None, phi_ddot, wrench, V_dot, u_dot)
        u = reals(m)  # speeds of the freedoms
        u[:] = speeds(ways, columns(ways, table), x.V)
        turn = read_turn(lib, freedoms, table, x, out) if freedoms.turns else None
        if freedoms.slides:
            read_slides(lib, freedoms, table, x, out)
        out.q_dot[:] = u
        out.q_ddot[:] = u_dot
        if turns_slides(ways):
            # what slides goes along axes that turn: w_dot = R u, w_ddot = R (u_dot + omega x u)
            R = reals(9)  # turn from the home pose
            a = reals(3)  # u in E1
            b = reals(3)  # u_dot in E1
            lib["rotation"](turn, R)
            a[:] = freedoms.spread(table.S, u)
            b[:] = freedoms.spread(table.S, u_dot)
            whole: Reals = -cross(a, x.V[3:6]) + b  # u_dot + omega x u
            for name, in_E1 in (("q_dot", a), ("q_ddot", whole)):
                turn_rates(freedoms, table, R, in_E1, name, out)
        return OK


@inline
def turn_rates(freedoms: Ways, table: Any, R: Any, in_E1: Any, name: str, out: Any) -> None:
    """Rates of what slides from the axes of E1 to those of the home pose."""
    rate = local(f"{name}_home", 3, comment="in the axes of the home pose")
    rate[:] = R @ in_E1
    for k in freedoms.slides:
        out.member(name)[k] = dot(freedoms.direction(k, table.S), rate)


@inline
def read_turn(lib: Library, freedoms: Ways, table: Any, x: Any, out: Any) -> Any:
    """Writes the angle or the quaternion; gives the turn from the home pose as a quaternion of any length."""
    turn = reals(4)  # from the home attitude, quaternion with w >= 0
    turn[:] = formula(derived.from_home(), home=table.home_attitude, q=x.attitude)
    if turn[0] < 0:
        turn[:] = -turn
    if turns_about_point(freedoms.ways):
        out.orientation[:] = turn
        return turn
    k = freedoms.turns[0]
    axis = freedoms.direction(k, table.S)
    half = let("half", dot(axis, turn[1:4]), "about the axis: sine of half the angle, times a factor")
    out.q[freedoms.number(k)] = 2 * lib["atan2"](half, turn[0])
    if turns_slides(freedoms.ways):
        if not (turn[0] * turn[0] + half * half > 0):  # half a turn about another axis
            turn[0] = 1
        turn[1:4] = axis * half
    return turn


@inline
def read_slides(lib: Library, freedoms: Ways, table: Any, x: Any, out: Any) -> None:
    """The way of the pivot along each direction."""
    way = pivot_way(lib, table, x)
    for k in freedoms.slides:
        out.q[freedoms.number(k)] = dot(freedoms.direction(k, table.S), way)


@inline
def pivot_way(lib: Library, table: Any, x: Any) -> Any:
    """w = C0^T (O1 + C pivot - O1_home) - pivot."""
    C0 = reals(9)  # home attitude
    C = reals(9)  # attitude
    lib["rotation"](table.home_attitude, C0)
    lib["rotation"](x.attitude, C)
    arm = reals(3)  # from O1 to the pivot, in E0
    gone = reals(3)  # to the pivot from the home place of O1, in E0
    way = reals(3)  # of the pivot from the home pose, in its axes
    arm[:] = C @ table.pivot
    for i in list(range(3)):  # in this order: near numbers first
        gone[i] = x.position[i] - table.home_position[i] + arm[i]
    lib["rotate_back"](C0, gone, way)
    way -= table.pivot
    return way


@inline
def check_coordinates(lib: Library, freedoms: Ways, q: Any, orientation: Any) -> Any:
    """Ranges: of coordinates those of positions, in float of an angle that of phases, a quaternion of unit length."""
    angle = "MAX_PHASE" if lib.layout.precision.name == "float" else "MAX_POSITION"  # the narrower of both
    for way in scalar_coordinates(freedoms.ways):
        k = freedoms.ways.index(way)
        check_number(lib, q[freedoms.number(k)], lib.limit("MAX_POSITION" if k in freedoms.slides else angle))
    if orientation is not None:
        lib["within"](orientation, 4, 2)
        norm2 = dot(orientation, orientation)
        if not unit_square(norm2):
            return RANGE
    return None


@inline
def write_turn(lib: Library, freedoms: Ways, table: Any, q: Any, orientation: Any, turn: Any) -> None:
    """The turn from the home attitude."""
    if orientation is not None:
        turn[:] = orientation
    else:
        turn[:] = [1, 0, 0, 0]
        for k in freedoms.turns:
            s = reals()  # sine of half the angle
            c = reals()
            lib["sincos"](0.5 * q[freedoms.number(k)], s, c)
            turn[0] = c
            for i, one in enumerate(freedoms.direction(k, table.S)):
                if isinstance(one, int) and one:
                    turn[i + 1] = s
                elif not isinstance(one, int):
                    turn[i + 1] = s * one


@inline
def write_position(lib: Library, freedoms: Ways, table: Any, q: Any, attitude: Any) -> Any:
    """O1 = O1_home + C0 (w + pivot) - C pivot."""
    C0 = reals(9)  # home attitude
    C = reals(9)  # attitude
    lib["rotation"](table.home_attitude, C0)
    lib["rotation"](attitude, C)
    place = reals(3)  # of the pivot from the home place of O1, in the axes of the home pose
    slid = (q[freedoms.number(k)] * freedoms.direction(k, table.S) for k in freedoms.slides)
    place[:] = sum(slid, Vector(table.pivot))
    gone = reals(3)  # in E0
    arm = reals(3)  # in E0
    gone[:] = C0 @ place
    arm[:] = C @ table.pivot
    position = reals(3)
    for i in list(range(3)):  # in this order: near numbers first
        position[i] = table.home_position[i] + (gone[i] - arm[i])
    return position


@inline
def turn_rates_back(lib: Library, freedoms: Ways, table: Any, turn: Any, u: Any, u_dot: Any) -> None:
    """u = R^T w_dot, u_dot = R^T w_ddot - omega x u of what slides, in place."""
    R = reals(9)  # turn from the home pose
    lib["rotation"](turn, R)
    omega = reals(3)  # angular velocity
    turning = [(freedoms.direction(k, table.S), u[k]) for k in freedoms.turns]
    omega[:] = [next((value for one, value in turning if one[i] == 1), 0) for i in range(3)]
    a = reals(3)  # in E1
    b = reals(3)  # in E1
    home = reals(3)  # in the axes of the home pose
    for values, turned in ((u, a), (u_dot, b)):
        home[:] = freedoms.spread(table.S, values)
        lib["rotate_back"](R, home, turned)
    rate_along: Reals = cross(a, omega) + b  # u_dot of what slides, in E1
    for k in freedoms.slides:
        u[k] = dot(freedoms.direction(k, table.S), a)
        u_dot[k] = dot(freedoms.direction(k, table.S), rate_along)
