"""step: the whole state one time step later, by Runge-Kutta of fourth order or by the midpoint rule.

The sum of a state and a small increment loses up to half a unit in the last place of the state: in float all of an
increment below 3e-8 of it. What a sum of two numbers loses is a number itself, which six additions give exactly, the
TwoSum of Knuth. It goes into the carry, if a caller has one, and from there into the increment of the next step.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from mahovik.core.formula.derived import attitude as derived
from mahovik.core.formula.derived import formula
from mahovik.core.lower import hold
from mahovik.core.lower.checks import check_number
from mahovik.core.lower.flywheels import turns_of
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs
from mahovik.core.lower.library import Library
from mahovik.core.program.expression import Present, Status
from mahovik.core.program.kernel import (
    BAD_ARGUMENT,
    OK,
    RANGE,
    Reals,
    Result,
    argument,
    block,
    changed,
    check_as,
    inline,
    let,
    reals,
    record,
    result,
)
from mahovik.core.program.vector import dot
from mahovik.core.routines.real_constants import PI, nearest
from mahovik.core.routines.wrap import turn_parts, turns_of_angle

COARSE = Status("COARSE")

NOTES = (
    "RANGE also if a stage of the step or the new state is out of range.",
    "COARSE: dt times the fastest of |phi_dot| and |omega| is above MAX_TURN_4 rad (order 2: MAX_TURN_2). At this "
    "bound the vibration of an unbalance is wrong by 3e-4 of its size after a turn, one of twice the speed "
    "(asymmetry) by 4e-3 (order 2: 1e-3). Errors grow with dt^4 (dt^2), beyond twice the bound faster.",
    "A carry belongs to its state: where another state is set, set the carry to zero.",
)

NOTE_OF_FLOAT = (
    "Of an increment all is lost that is below 6e-8 of the number it goes to: for short steps, slow motions and "
    "places far from the origin pass a carry."
)


def add_all(lib: Library) -> None:
    """Adds the step functions: by torques, and by given accelerations of the flywheels; and `wrap`."""
    add_sums(lib)
    for torques in (True, False) if lib.layout.flywheels else (False,):
        add_step(lib, torques)
    if lib.layout.flywheels:
        add_wrap(lib)


def numbers(lib: Library) -> Iterator[tuple[str, Any, int]]:
    """Members of a state with their lengths, and where each begins among all numbers of a state."""
    first = 0
    for f in lib.layout.state.fields:
        yield f.name, f.shape[0], first
        first += int(f.shape[0])


def start_of(lib: Library, x: Any, name: str, i: Any) -> Any:
    """A number of a state to which a sum is added: phases within half a turn, so that they keep their digits."""
    return lib["wrapped"](x.phi[i]) if name == "phi" else x.member(name)[i]


class RoundedSum(NamedTuple):
    """A sum of two numbers, and what rounding took from it."""

    total: Any
    lost: Any


def rounded_sum(name: str, a: Any, b: Any) -> RoundedSum:
    """a + b as a temporary of that name."""
    total = let(name, a + b)
    part = let(f"{name}_b", total - a)
    return RoundedSum(total, (a - (total - part)) + (b - part))


@inline
def check_length(square: float) -> Any:
    """RANGE where a quaternion, by its square, is far from unit length."""
    if not (square > 0.5 and square < 2):
        return RANGE
    return None


@inline
def check_again(lib: Library, x: Any) -> None:
    """Check of a state in a step, by a function that the step needs anyway: speeds are looked at twice."""
    if "check_motion" in lib and not lib.layout.stream and not lib.layout.inputs:
        lib["check_motion"](x, x.phi_dot, lib.limit("MAX_SPEED"))
    else:
        lib["check_state"](x)


@inline
def carry_pivot(lib: Library, table: Any, x: Any, y: Any, before: Reals, after: Reals) -> None:
    """Takes from a step, and from its carry, what moved the pivot where the hold does not let it go.

    How far the pivot went is a difference of near numbers, which rounding hardly changes, and it goes into a sum that
    is compensated: what the steps add up to stays at the pivot, however many they are. The first three numbers of a
    carry, `before` and `after`, are those of the position.
    """
    C, arm, reached = hold.pivot_arms(lib, table, x, y)
    way = reals(3)  # how the pivot went, in E0
    for i in list(range(3)):  # vectors would be added in another order
        way[i] = (y.position[i] - x.position[i]) + (reached[i] - arm[i]) + (after[i] - before[i])
    slid = hold.allowed_way(lib, table, C, way)
    for i in list(range(3)):
        with block():
            part = after[i] - (way[i] - slid[i])
            moved = rounded_sum("sum", y.position[i], part)
            after[i] = moved.lost
            y.position[i] = moved.total


def add_sums(lib: Library) -> None:
    """Adds the sums of a state and an increment: `advance` with `finish`, and `carry_over`."""
    layout = lib.layout
    state: Any = argument(struct=layout.state)
    one, two, three = turn_parts(layout.precision)

    @lib.kernel()
    def advance(
        x: Any = lib.x, rate: Any = state, h: float = argument(unit="s"), to: Any = result(struct=layout.state)
    ) -> None:
        """Sets to = x + h rate, after wrapping the phases to within half a turn."""
        for name, count, _ in numbers(lib):
            for i in range(count):
                to.member(name)[i] = start_of(lib, x, name, i) + h * rate.member(name)[i]

    @lib.kernel(statuses=STATE_STATUSES)
    def finish(x: Any = changed(struct=layout.state)) -> Status:
        """Normalizes the quaternion and wraps the phases to [-pi, pi]; RANGE if the state is out of range."""
        square = dot(x.attitude, x.attitude)
        check_length(square)
        inverse = 1 / lib["sqrt"](square)
        x.attitude[:] = x.attitude * inverse
        check_again(lib, x)
        if layout.flywheels:
            for s in range(layout.count):
                x.phi[s] = lib["wrapped"](x.phi[s])
        return OK

    purpose = (
        "Sets to = x + h rate with phases in [-pi, pi] and a quaternion of unit length, and keeps in the carry what "
        "rounding takes from the sums; RANGE if the state is out of range."
    )

    @lib.kernel(statuses=STATE_STATUSES, purpose=purpose)
    def carry_over(
        table: Any = lib.table,
        x: Any = lib.x,
        rate: Any = state,
        h: float = argument(unit="s"),
        carry: Any = changed(struct=layout.carry),
        to: Any = result("must not be x or rate", struct=layout.state),
    ) -> Status:
        """`advance`, `finish`, and of a held carrier `keep_pivot`, by sums whose rounding the carry keeps."""
        kept = record(layout.carry)  # the new carry
        kept[:] = carry
        lost = kept.rounding
        for name, count, first in numbers(lib):
            for i in range(count):
                start = start_of(lib, x, name, i)
                step = h * rate.member(name)[i] + lost[i + first]
                moved = rounded_sum("sum", start, step)
                if name == "phi":  # less its whole turns; the product with the first part of 2 pi is exact
                    k = turns_of_angle(layout.precision, moved.total)  # turns
                    left = moved.total - k * one
                    within = rounded_sum("within", left, -(k * two))
                    lost[i + first] = moved.lost + (within.lost - k * three)
                    to.phi[i] = within.total
                else:
                    lost[i + first] = moved.lost
                    to.member(name)[i] = moved.total
        q = to.attitude
        square = dot(q, q)
        check_length(square)
        # 1/|q| - 1, without the digits that the difference would lose
        excess = (1 - square) / (lib["sqrt"](square) + square)
        for i in range(4):
            step = q[i] * excess + lost[i + 3]
            moved = rounded_sum("sum", q[i], step)
            lost[i + 3] = moved.lost
            q[i] = moved.total
        check_again(lib, to)
        if layout.held:
            carry_pivot(lib, table, x, to, carry.rounding, lost)
        carry[:] = kept
        return OK


def add_step(lib: Library, torques: bool) -> None:
    """Adds the step of a motion by drive torques, or by given accelerations of the flywheels, with its stages."""
    layout, N = lib.layout, lib.layout.count
    tau: Any = argument("drive torques, mount on flywheel", N, unit="N m") if torques else None
    locked: Any = lib.locked_argument() if torques else None
    phi_ddot: Any = None if torques else lib.phi_ddot
    ending = "" if torques or not layout.flywheels else "_driven"
    under = "drive torques" if torques else "given flywheel accelerations"
    statuses = (*STATE_STATUSES, "NOT_POSITIVE_DEFINITE")

    @lib.kernel(f"rate{ending}", statuses=statuses, purpose=f"Time derivatives of the state under {under}.")
    def rate_of(
        table: Any = lib.table,
        x: Any = lib.x,
        phi_ddot: Any = phi_ddot,
        tau: Any = tau,
        locked: Any = locked,
        wrench: Any = lib.wrench,
        rate: Any = result("time derivatives of the members of the state", struct=layout.state),
    ) -> Status:
        """Rates of all members of a state."""
        C = reals(9)  # attitude
        sine, cosine = turns_of(lib, x) or (None, None)
        u_dot = None
        if layout.freedoms:
            u_dot = reals(layout.freedoms)
        if torques:
            lib["solve_coupled"](table, x, sine, cosine, tau, locked, wrench, rate.V, rate.phi_dot, u_dot)
        else:
            lib["accelerate"](table, x, sine, cosine, phi_ddot, wrench, rate.V, u_dot)
            if layout.held:
                hold.write_twist(lib, table, [u_dot] if layout.freedoms else [], rate.V)
        lib["rotation"](x.attitude, C)
        rate.position[:] = C @ x.V[0:3]
        rate.attitude[:] = formula(derived.quaternion_rate(), omega=x.V[3:6], q=x.attitude)
        if layout.flywheels:
            for s in range(N):
                rate.phi[s] = x.phi_dot[s]
                if not torques:
                    rate.phi_dot[s] = phi_ddot[s]
        return OK

    purpose = "Evaluations of one step: the sum of the rates at its stages. A stage without an answer is RANGE."

    @lib.kernel(f"stages{ending}", statuses=statuses, purpose=purpose)
    def stages(
        table: Any = lib.table,
        x: Any = lib.x,
        phi_ddot: Any = phi_ddot,
        tau: Any = tau,
        locked: Any = locked,
        wrench: Any = lib.wrench,
        h: float = argument(unit="s"),
        order: int = argument("2 or 4"),
        y: Any = result("scratch: states of the stages", struct=layout.state),
        total: Any = result("order 4: k1 + 2 k2 + 2 k3 + k4; order 2: k2", struct=layout.state),
    ) -> Status:
        """The weighted sum of the rates, which times h or h/6 is the increment."""
        k = record(layout.state)  # time derivatives at a stage
        rate_of(table, x, phi_ddot, tau, locked, wrench, k)
        half = 0.5 * h
        if order == 2:
            lib["advance"](x, k, half, y)
            check_as(RANGE, rate_of(table, y, phi_ddot, tau, locked, wrench, total))
        else:
            total[:] = k
            for weight, length in ((2, half), (2, half), (1, h)):
                lib["advance"](x, k, length, y)
                check_as(RANGE, rate_of(table, y, phi_ddot, tau, locked, wrench, k))
                for name, count, _ in numbers(lib):
                    for i in range(count):
                        total.member(name)[i] += weight * k.member(name)[i] if weight != 1 else k.member(name)[i]
        return OK

    carried = "of the step before; at first all zero; null: what rounding takes is lost"

    @lib.kernel(
        f"step{ending}",
        statuses=(*statuses, "BAD_ARGUMENT", "COARSE"),
        purpose=f"State after one time step; {under} and wrenches are held constant.",
        notes=NOTES if layout.precision.name == "double" else (*NOTES, NOTE_OF_FLOAT),
        public=True,
    )
    def step(
        table: Any = lib.table,
        x: Any = lib.x,
        phi_ddot: Any = phi_ddot,
        tau: Any = tau,
        locked: Any = locked,
        wrench: Any = lib.wrench,
        dt: float = argument("time step, greater than 0", unit="s"),
        order: int = argument("4: Runge-Kutta, four evaluations; 2: midpoint rule, two"),
        carry: Any = changed(carried, struct=layout.carry, optional="missing"),
        next_: Any = result("state after the step; may be x itself", struct=layout.state),
    ) -> Status:
        """One step of RK4 or of the midpoint rule."""
        check_inputs(lib, table, x, phi_ddot, wrench, (), tau)
        check_number(lib, dt, lib.limit("MAX_STEP"))
        if not (dt > 0):
            return BAD_ARGUMENT
        if not (order == 4 or order == 2):
            return BAD_ARGUMENT
        if Present(carry):
            lib["within"](carry.rounding, len(carry.rounding), lib.limit("MAX_ROUNDING"))
        y = record(layout.state)  # state of a stage; then the new state
        total = record(layout.state)  # sum of the rates at the stages
        stages(table, x, phi_ddot, tau, locked, wrench, dt, order, y, total)
        over = dt if order == 2 else dt / 6  # times the sum: the increment
        fastest: float = dot(x.V[3:6], x.V[3:6])  # square of the fastest turning, (rad/s)^2
        if layout.flywheels:
            for s in range(N):
                square = x.phi_dot[s] * x.phi_dot[s]
                fastest = square if square > fastest else fastest
        if Present(carry):
            check_as(RANGE, lib["carry_over"](table, x, total, over, carry, y))
        else:
            lib["advance"](x, total, over, y)
            check_as(RANGE, lib["finish"](y))
            if layout.held:
                lib["keep_pivot"](table, x, y)
        next_[:] = y
        most = lib.limit("MAX_TURN_2") if order == 2 else lib.limit("MAX_TURN_4")  # rad
        if dt * dt * fastest > most * most:
            return COARSE
        return OK


def add_wrap(lib: Library) -> None:
    """Adds the wrapping of one angle, with a status."""
    precision = lib.layout.precision
    pi = nearest(PI, precision)
    error = {"double": "5e-16", "float": "3e-7"}[precision.name]

    @lib.kernel(notes=(f"Error below {error} rad, modulo one turn.",), public=True)
    def wrap(
        phi: float = argument("any angle within MAX_PHASE", unit="rad"),
        wrapped: Result = result("the same angle in [-pi, pi]", unit="rad"),
    ) -> Status:
        """The angle wrapped to [-pi, pi] (pi rounded to the nearest real)."""
        check_number(lib, phi, lib.limit("MAX_PHASE"))
        k = reals()  # nearest number of turns; may be off by one next to an odd multiple of pi
        k = turns_of_angle(precision, phi)
        angle: float = lib["unwound"](phi, k)
        if angle > pi or angle < -pi:
            angle = lib["unwound"](phi, k + 1 if angle > pi else k - 1)
        wrapped.value = pi if angle > pi else -pi if angle < -pi else angle
        return OK
