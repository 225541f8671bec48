"""What the wrapper of an FMU computes beside the functions of the stand: `core/emit/fmu.py` prints it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mahovik.core import routines
from mahovik.core.formula.derived import attitude as derived
from mahovik.core.formula.derived import formula
from mahovik.core.lower import checks, coordinates
from mahovik.core.lower.coordinates import Target, Ways, pivot_way, read_slides, read_turn
from mahovik.core.lower.freedoms import TURNS, columns, scalar_coordinates, speeds, turns_about_point
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.lower.limits import unit_square
from mahovik.core.lower.step import check_length
from mahovik.core.program.expression import Status
from mahovik.core.program.function import Program
from mahovik.core.program.kernel import OK, RANGE, Reals, Result, argument, changed, inline, let, local, reals, result
from mahovik.core.program.validate import validate
from mahovik.core.program.vector import dot
from mahovik.core.program.walk import reachable
from mahovik.core.routines.wrap import turns_of_angle

ALLOWED = 1e-6
"""m, rad; m/s, rad/s: a start may be off what the hold allows by as much as figures of six digits are."""

SQUARED = 1e100
"""Components up to here have squares, and so a length that a message can give."""


def lower_fmu(layout: Layout) -> Program:
    """Functions `unit_attitude`, `pose_rates` and, with flywheels, `count_phases`; of a held carrier `off_hold`.

    Where the hold has coordinates also `coordinates` and, of an angle, `count_turns`.
    """
    lib, precision = Library(layout), layout.precision
    angle = layout.coordinates and has_angle(layout.ways)
    lib.add(routines.square_root(precision))
    lib.add(checks.within(lib))
    lib.add(coordinates.rotation())
    add_pose(lib)
    if layout.flywheels or angle:
        lib.add(routines.unwind(precision))
    if layout.flywheels:
        lib.add(routines.wrap(precision, lib["unwound"]))
        add_count_phases(lib)
    if layout.held:
        lib.add(coordinates.rotate_back)
        add_off_hold(lib)
    if layout.coordinates:
        if Ways(layout.ways).turns:
            lib.add(routines.atan2(precision))
        add_coordinates(lib)
    counts = (layout.count,) if layout.flywheels else ()
    program = Program(layout.structure.name, precision, counts, (), reachable(lib.functions))
    validate(program)
    return program


def has_angle(ways: tuple[str, ...]) -> bool:
    """Whether one freedom turns about an axis, so that its angle has turns to be counted."""
    return len(Ways(ways).turns) == 1


def add_pose(lib: Library) -> None:
    """Adds the attitude brought to unit length, and the rates of a pose."""

    @lib.kernel(public=True)
    def unit_attitude(
        attitude: Reals = changed("quaternion, w first", 4),
        strict: int = argument("not 0: RANGE where it is not within 1e-3 of unit length"),
        length: Result = result("as it was given"),
    ) -> Status:
        """Quaternion to unit length."""
        length.value = 0
        lib["within"](attitude, 4, SQUARED)
        square = dot(attitude, attitude)
        length.value = lib["sqrt"](square)
        check_length(square)
        if strict != 0:
            if not unit_square(square):
                return RANGE
        inverse = 1 / length.value
        attitude[:] = attitude * inverse
        return OK

    @lib.kernel(public=True)
    def pose_rates(
        attitude: Reals = argument("quaternion, w first, of nearly unit length", 4),
        V: Reals = argument("twist of the carrier relative to E0, in E1", 6, unit="m/s, rad/s"),
        position_dot: Reals = result("of O1, in E0", 3, unit="m/s"),
        attitude_dot: Reals = result("of the quaternion", 4, unit="1/s"),
    ) -> None:
        """Rates of position and quaternion; the quaternion is drawn to unit length, as an integrator loses it."""
        C = reals(9)  # attitude
        lib["rotation"](attitude, C)
        position_dot[:] = C @ V[0:3]
        attitude_dot[:] = formula(derived.quaternion_rate(), q=attitude, omega=V[3:6])
        off = 1 - dot(attitude, attitude)  # zero for the exact solution; it dies away with exp(-2 t)
        attitude_dot += off * attitude


def add_count_phases(lib: Library) -> None:
    """Adds phases counted through over a step that wraps them."""
    n = lib.layout.count

    @lib.kernel(public=True)
    def count_phases(
        before: Reals = argument("phases before the step", n, unit="rad"),
        after: Reals = argument("behind it", n, unit="rad"),
        speed_before: Reals = argument("speeds before the step", n, unit="rad/s"),
        speed_after: Reals = argument("behind it", n, unit="rad/s"),
        dt: float = argument("the step", unit="s"),
        phi: Reals = changed("phases with all their turns", n, unit="rad"),
    ) -> None:
        """Phases counted through: how far flywheels turned in a step, by their phases and, for whole turns, speeds."""
        for s in range(n):
            expected = 0.5 * dt * (speed_before[s] + speed_after[s])
            turned = after[s] - before[s] - expected  # but for whole turns, small
            phi[s] += expected + lib["wrapped"](turned)


# -- what the hold blocks, at the start --------------------------------------------------------------------------------


def add_off_hold(lib: Library) -> None:
    """Adds twist and pose less what the freedoms give. The pose is looked at where the freedoms have coordinates."""

    @lib.kernel(public=True)
    def off_hold(
        table: Any = lib.table,
        x: Any = lib.x,
        off: Reals = result("blocked part of V; then of the pose", 12, unit="m/s, rad/s; m, rad"),
    ) -> Status:
        """Part of the twist and of the pose that the hold blocks; RANGE where one is more than rounding."""
        off[0:6] = x.V
        off[6:12] = [0] * 6
        before = list[Any]()
        for k, column in enumerate(columns(lib.layout.ways, table)):
            before.append(take_freedom(off[0:6], column, k + 1, before))
        if lib.layout.coordinates:
            blocked_pose(lib, table, x, off)
        allowed_twist: float = ALLOWED  # share of what is given
        check_blocked(allowed_twist, x.V, off[0:6])
        allowed_pose: float = ALLOWED  # share of what is given
        check_blocked(allowed_pose, x.position, off[6:12])
        return OK


@inline
def take_freedom(rest: Reals, column: Sequence[Any], number: int, before: Sequence[Any]) -> Any:
    """Takes from six numbers their part along a column of S, made orthogonal to those before it; gives that."""
    direction = local(f"s{number}", 6, comment=f"freedom {number}, orthogonal to those before it")
    direction[:] = column
    for j, other in enumerate(before):
        share = let(f"share{number}{j + 1}", dot(direction, other) / dot(other, other))
        direction -= share * other
    along = let(f"along{number}", dot(direction, rest) / dot(direction, direction))
    rest -= along * direction
    return direction


@inline
def blocked_pose(lib: Library, table: Any, x: Any, off: Reals) -> None:
    """off[6..8]: the way of the pivot less what slides; off[9..11]: the turn about other axes."""
    way = pivot_way(lib, table, x)
    slid: Reals = table.sliding @ way  # its part along what slides
    off[6:9] = way - slid
    if not turns_about_point(lib.layout.ways):
        turn: Reals = formula(derived.from_home(), home=table.home_attitude, q=x.attitude)  # from the home attitude
        axis = turning_axis(lib.layout.ways, table)
        about: float = 0  # part of the turn about the axis
        for one, value in zip(axis, turn[1:4], strict=True):
            if not is_zero(one):
                about += one * value
        for i, one in enumerate(axis):
            off[9 + i] = 2 * (turn[i + 1] - (0 if is_zero(one) else one * about))


@inline
def check_blocked(most: Result, whole: Reals, off: Reals) -> Any:
    """RANGE where a part is larger than a share of what is given."""
    for value in whole:
        if ALLOWED * abs(value) > most.value:
            most.value = ALLOWED * abs(value)
    for value in off:
        if not (abs(value) <= most.value):
            return RANGE
    return None


def is_zero(value: Any) -> bool:
    """Is it 0 for any stand of the structure?"""
    return isinstance(value, int) and value == 0


def turning_axis(ways: Sequence[str], table: Any) -> Sequence[Any]:
    """The axis of the freedom that turns; zeros where none does."""
    axes = (c[3:] for way, c in zip(ways, columns(ways, table), strict=True) if way in (*TURNS, "turn"))
    return next(axes, (0, 0, 0))


# -- coordinates of the freedoms ---------------------------------------------------------------------------------------


def add_coordinates(lib: Library) -> None:
    """Adds numbers q, the quaternion of three turns, and u of V = S u; of an angle `count_turns`."""
    ways = lib.layout.ways
    freedoms, count = Ways(ways), len(scalar_coordinates(ways))
    whole: Any = argument("whole turns of the angle, counted from the start") if has_angle(ways) else None
    numbers: Any = result("coordinates of the freedoms, zero in the home pose", count, unit="m, rad") if count else None
    turned: Any = result("quaternion from the home pose, w first", 4) if turns_about_point(ways) else None

    @lib.kernel(public=True)
    def coordinates(
        table: Any = lib.table,
        x: Any = lib.x,
        turns: Any = whole,
        q: Any = numbers,
        orientation: Any = turned,
        u: Reals = result("speeds of the freedoms, V = S u", len(ways), unit="m/s, rad/s"),
    ) -> None:
        """Coordinates of the freedoms of the hold at a state, and their speeds u."""
        if freedoms.turns:
            read_turn(lib, freedoms, table, x, Target(q, orientation))
        if has_angle(ways):
            k = freedoms.number(freedoms.turns[0])
            q[k] = lib["unwound"](q[k], -turns)
        if freedoms.slides:
            read_slides(lib, freedoms, table, x, Target(q, orientation))
        u[:] = speeds(ways, columns(ways, table), x.V)

    if has_angle(ways):

        @lib.kernel(public=True)
        def count_turns(
            before: float = argument("angle before the step, within half a turn", unit="rad"),
            after: float = argument("angle behind it, likewise", unit="rad"),
            speed_before: float = argument("its speed before the step", unit="rad/s"),
            speed_after: float = argument("its speed behind it", unit="rad/s"),
            dt: float = argument("the step", unit="s"),
            turns: Result = changed("whole turns of the angle"),
        ) -> None:
            """Turns of an angle counted through: those that bring it nearest to what its speeds give."""
            expected = before + 0.5 * dt * (speed_before + speed_after)
            turns.value += turns_of_angle(lib.layout.precision, expected - after)
