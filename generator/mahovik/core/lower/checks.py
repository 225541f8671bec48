"""Checks of inputs: finite, and inside the ranges of limits.py. Nothing is computed from an input before it passed.

Values are looked at one by one only where a sum of their squares is not below the square of the limit. Where it is,
each value is within: rounding keeps the order of numbers, so a rounded sum of what is not negative is no smaller than
any rounded square in it, and where a rounded square is below another, so are the numbers: v^2 < limit^2. This holds in
any rounding, with and without fused multiply-add. Infinities, NaN and what overflows are below nothing.
"""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.library import Library
from mahovik.core.lower.limits import limits, unit_square
from mahovik.core.program.expression import Const, Status
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import NOT_FINITE, OK, RANGE, Reals, argument, inline, kernel, reals, shortcut
from mahovik.core.program.types import Kind, NamedCount, Precision, Struct
from mahovik.core.program.vector import dot


def within(lib: Library) -> Function:
    """Every element finite and of magnitude at most a limit."""
    largest = lib.largest

    @kernel(apart=True)
    def within(values: Reals = argument("", 0), count: int = argument(), limit: float = argument()) -> Status:
        """Are all values finite, and none larger in magnitude than the limit? A NaN fails every comparison."""
        for i in range(count):
            if not (values[i] >= -limit and values[i] <= limit):
                if values[i] >= -largest and values[i] <= largest:
                    return RANGE
                return NOT_FINITE
        return OK

    return within


@inline
def check_number(lib: Any, value: float, limit: float) -> Any:
    """Returns NOT_FINITE or RANGE where a number is not within a limit; `lib`: the largest number is its `largest`."""
    if not (value >= -limit and value <= limit):
        if value >= -lib.largest and value <= lib.largest:
            return RANGE
        return NOT_FINITE
    return None


@inline
def check_vector(lib: Library, values: Reals, limit: float) -> None:
    """Returns the status of the first bad one of a few values, which are looked at if their squares are not small."""
    if not (dot(values, values) < limit * limit):
        lib["within"](values, len(values), limit)


def state_limits(state: Struct, precision: Precision) -> list[tuple[str, int | NamedCount, Const]]:
    """Members of a state that are checked, in this order: a member, how many of its first numbers, their limit."""
    limit = {name: bound.expression for name, bound in limits(precision).items()}
    size = {f.name: f.shape[0] for f in state.fields}
    rows: list[tuple[str, int | NamedCount, Const]] = [
        ("position", 3, limit["MAX_POSITION"]),
        ("attitude", 4, Const(2, Kind.REAL)),
        ("V", 6, limit["MAX_SPEED"]),
        ("V", 3, limit["MAX_VELOCITY"]),
    ]
    if "phi" in size:
        rows += [("phi", size["phi"], limit["MAX_PHASE"]), ("phi_dot", size["phi_dot"], limit["MAX_SPEED"])]
    return rows


@inline
def look_at_sums(lib: Library, x: Any, values: Any = None, limit: Any = None) -> Any:
    """OK where squares are small and the quaternion is of unit length; `values` of the flywheels have a `limit`.

    Squares are of locals: intervals prove that a square of a variable is not negative, not one of an element.
    """
    turning, held = lib.layout.flywheels, lib.layout.held
    with shortcut():
        if turning:
            phase2 = reals()
            if values is not None:
                value2 = reals()
        position2: float = dot(x.position, x.position) if held else 0
        velocity2: float = dot(x.V[0:3], x.V[0:3]) if held else 0
        speed2: float = dot(x.V[3:6], x.V[3:6]) if held else 0
        if turning:
            phase2 = 0
            if values is not None:
                value2 = 0
        if not held:  # beside few freedoms a loop of three turns counts
            for i in range(3):
                position = x.position[i]
                position2 += position * position
                velocity = x.V[i]
                velocity2 += velocity * velocity
                speed = x.V[i + 3]
                speed2 += speed * speed
        if turning:
            for s in range(lib.layout.count):
                phase = x.phi[s]
                phase2 += phase * phase
                if values is not None:
                    value = values[s]
                    value2 += value * value
                speed = x.phi_dot[s]
                speed2 += speed * speed
        norm2 = dot(x.attitude, x.attitude)
        if (
            unit_square(norm2)
            and position2 < lib.limit("MAX_POSITION") * lib.limit("MAX_POSITION")
            and velocity2 < lib.limit("MAX_VELOCITY") * lib.limit("MAX_VELOCITY")
            and speed2 < lib.limit("MAX_SPEED") * lib.limit("MAX_SPEED")
            and (not turning or phase2 < lib.limit("MAX_PHASE") * lib.limit("MAX_PHASE"))
            and (values is None or value2 < limit * limit)
        ):
            return OK
    return None


def add_checks(lib: Library) -> None:
    """Adds checks of the state, of what each flywheel has besides, and of given sines and cosines."""
    N = lib.layout.count
    lib.add(within(lib))

    @lib.kernel(apart=True)
    def check_numbers(x: Any = lib.x) -> Status:
        """Looks at a state number by number, where sums of squares do not show that it is within its limits."""
        for name, count, limit in state_limits(lib.layout.state, lib.layout.precision):
            lib["within"](x.member(name), count, limit)
        norm2 = dot(x.attitude, x.attitude)
        if not unit_square(norm2):
            return RANGE
        return OK

    @lib.kernel()
    def check_state(x: Any = lib.x) -> Status:
        """Is the state finite, in its ranges, and its quaternion within 1e-3 of unit length?"""
        look_at_sums(lib, x)
        return check_numbers(x)

    if lib.layout.flywheels:

        @lib.kernel()
        def check_motion(x: Any = lib.x, values: Reals = argument("", N), limit: float = argument()) -> Status:
            """Is the state as check_state demands, and are values of the flywheels within a limit?"""
            look_at_sums(lib, x, values, limit)
            check_numbers(x)
            lib["within"](values, N, limit)
            return OK

    if lib.layout.sine_input:
        turns: Any = lib.turn_arguments()

        @lib.kernel()
        def check_turns(sine: Reals = turns[0], cosine: Reals = turns[1]) -> Status:
            """Are sines and cosines finite, and is s^2 + c^2 between 0.999^2 and 1.001^2?"""
            for numbers in (sine, cosine):
                lib["within"](numbers, N, 2)
            for s in range(N):
                norm2 = sine[s] * sine[s] + cosine[s] * cosine[s]
                if not unit_square(norm2):
                    return RANGE
            return OK
