"""An attitude loop: quaternion feedback, drive torques by a task of the stand, management of momentum.

Its C lies beside that of the stand, whose public functions `torque_for_TASK` and `momentum` it calls.

Sources: Wie, Weiss, Arapostathis, Quaternion feedback regulator for spacecraft eigenaxis rotations, 1989; Markley,
Crassidis, Fundamentals of spacecraft attitude determination and control, 2014, 7.1 to 7.3.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mahovik.contract.status import STATUS_VALUES
from mahovik.core import routines
from mahovik.core.lower.excess import add_motor_curve, at_most
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.lower.limits import UNIT_SQUARE_MAX, UNIT_SQUARE_MIN
from mahovik.core.program.expression import Status, Variable
from mahovik.core.program.function import Function, Program
from mahovik.core.program.kernel import (
    BAD_ARGUMENT,
    NOT_FINITE,
    OK,
    RANGE,
    IntResult,
    Ints,
    Reals,
    argument,
    changed,
    inline,
    int_of,
    ints,
    reals,
    record,
    result,
    status_of,
    word,
)
from mahovik.core.program.types import Field, Kind, NamedCount, Struct
from mahovik.core.program.validate import validate
from mahovik.core.program.vector import cross, dot

REAL, INT = Kind.REAL, Kind.INT

WORKS, COASTS, HELD = 0, 1, 2
"""What a flywheel's flag says: its motor gives what is commanded; no torque; it keeps its speed."""

LIMITED, UNREACHABLE = STATUS_VALUES["LIMITED"], STATUS_VALUES["UNREACHABLE"]


class LoopStructs:
    """Structs of a loop for `count` flywheels. `dumps`: with what dumps momentum."""

    def __init__(self, count: NamedCount, dumps: bool) -> None:
        n = (count,)
        members = [
            Field("period", REAL, (), "s", "between two calls of attitude_step"),
            Field("bandwidth", REAL, (), "rad/s", "omega of the error's s^2 + 2 zeta omega s + omega^2"),
            Field("damping", REAL, (), "", "its zeta"),
            Field("integral", REAL, (), "1/s", "of the error's integral, less than 2 zeta omega; 0: none"),
            Field("integral_most", REAL, (), "rad s", "largest magnitude of each component of that integral"),
            Field("closing_rate", REAL, (), "rad/s", "fastest turn towards the reference that an error demands"),
            Field("slew_rate", REAL, (), "rad/s", "fastest turn of a reference"),
            Field("slew_acceleration", REAL, (), "rad/s2", "its largest angular acceleration"),
            Field("preferred", REAL, n, "rad/s", "speeds that flywheels approach with what the demand leaves free"),
            Field("preferred_rate", REAL, (), "1/s", "part of what is missing to them, made up a second"),
            Field("avoid", REAL, (), "rad/s", "no preferred speed lies nearer to 0 than this"),
            Field("viscous", REAL, n, "N m s", "friction that the motors bear besides tau: by speed"),
            Field("coulomb", REAL, n, "N m", "dry friction"),
            Field("coulomb_speed", REAL, n, "rad/s", "below it dry friction is proportional to speed"),
        ]
        if dumps:
            members += [
                Field("wanted_momentum", REAL, (3,), "N m s", "about the mass centre, in E0, that is to stay"),
                Field("dump_rate", REAL, (), "1/s", "part of the rest that is dumped a second"),
                Field("dump_torque", REAL, (), "N m", "largest external moment; 0: nothing is dumped"),
                Field("dump_begin", REAL, (), "N m s", "dumping begins above this magnitude of the rest"),
                Field("dump_end", REAL, (), "N m s", "and ends below this one, which is less"),
            ]
        words = "Settings of the loop; attitude_default has those of the export."
        self.config = Struct("attitude_config", words, tuple(members))
        self.course = Struct(
            "attitude_course",
            "A rest-to-rest turn about an axis fixed in the carrier and in E0: angle (10 u^3 - 15 u^4 + 6 u^5).",
            (
                Field("from", REAL, (4,), "", "attitude at its beginning, w first"),
                Field("axis", REAL, (3,), "", "unit vector, in E1"),
                Field("angle", REAL, (), "rad", "0 to pi"),
                Field("duration", REAL, (), "s"),
            ),
        )
        members = [
            Field("course", self.course, (), "", "the reference"),
            Field("tick", INT, (), "", "samples since its beginning; no more than it takes"),
            Field("integral", REAL, (3,), "rad s", "of the error"),
        ]
        members += [Field("dumping", INT, (), "", "1 from dump_begin until dump_end")] if dumps else []
        self.state = Struct("attitude_loop", "State of the loop, begun by attitude_reset.", tuple(members))
        self.reference = Struct(
            "attitude_reference",
            "The reference at one time.",
            (
                Field("attitude", REAL, (4,), "", "unit quaternion, w first: x0 = C x of the reference's axes"),
                Field("rate", REAL, (3,), "rad/s", "angular velocity, in the reference's axes"),
                Field("acceleration", REAL, (3,), "rad/s2", "angular acceleration, in the reference's axes"),
            ),
        )
        self.demand = Struct(
            "attitude_demand",
            "What quaternion feedback demands.",
            (
                Field("error", REAL, (3,), "rad", "twice the vector part of the turn from reference to carrier, in E1"),
                Field("rate_error", REAL, (3,), "rad/s", "angular velocity relative to the reference, in E1"),
                Field("wanted", REAL, (3,), "rad/s2", "angular acceleration, in E1"),
                Field("limited", INT, (), "", "1 where closing_rate limits it"),
            ),
        )
        members = [Field("tau", REAL, n, "N m", "torques for the motors: drive torques and friction")]
        if dumps:
            members += [
                Field(
                    "moment", REAL, (3,), "N m", "external, for thrusters or torquers, in E1; act on it until the next"
                ),
                Field("momentum", REAL, (3,), "N m s", "angular momentum that is to be dumped, in E1"),
            ]
        members += [
            Field("reference", self.reference),
            Field("demand", self.demand),
            Field("residual", REAL, (3,), "rad/s2", "of the wanted acceleration, what torques do not reach, in E1"),
            Field("share", REAL, (), "", "part of it that is met, 0 to 1"),
            Field("limited", INT, n, "", "1 if the torque is at its limit, of flywheels that work"),
        ]
        self.result = Struct("attitude_result", "Result of a sample.", tuple(members))

    @property
    def all(self) -> tuple[Struct, ...]:
        """All of them, each after those that it holds."""
        return self.config, self.course, self.state, self.reference, self.demand, self.result


def lower_attitude(layout: Layout, stand: Program, task: str, places: Sequence[int], dumps: bool) -> Program:
    """The functions of a loop. `stand`: the program that its C stands beside.

    `places`: of the rows of the task among the components of the angular acceleration.
    """
    lib, structs = Library(layout), LoopStructs(layout.count, dumps)
    for routine in (routines.sincos, routines.square_root, routines.atan2):
        lib.add(routine(layout.precision))
    add_rotations(lib)
    add_settings(lib, structs, dumps)
    add_mean_table(lib)
    add_reference(lib, structs, dumps)
    add_demand(lib, structs)
    if dumps:
        add_moment(lib, structs)
    add_friction(lib, structs)
    add_motor_curve(lib)
    options = Variable(f"{stand.name}_default_options", layout.inverse_options)
    add_step(lib, structs, stand, task, places, dumps, options)
    program = Program(
        stand.name, layout.precision, (layout.count,), structs.all, lib.functions, called=stand.functions,
        constants=(options,),
    )  # fmt: skip
    validate(program)
    return program


# -- rotations and checks ----------------------------------------------------------------------------------------------


def add_rotations(lib: Library) -> None:
    """Adds products of quaternions, and what they turn."""

    @lib.kernel()
    def multiply(q: Reals = argument("", 4), p: Reals = argument("", 4), product: Reals = result("", 4)) -> None:
        """q p: the rotation of p about the axes that q has turned."""
        product[0] = q[0] * p[0] - q[1] * p[1] - q[2] * p[2] - q[3] * p[3]
        product[1] = q[0] * p[1] + q[1] * p[0] + q[2] * p[3] - q[3] * p[2]
        product[2] = q[0] * p[2] - q[1] * p[3] + q[2] * p[0] + q[3] * p[1]
        product[3] = q[0] * p[3] + q[1] * p[2] - q[2] * p[1] + q[3] * p[0]

    @lib.kernel()
    def between(q: Reals = argument("", 4), p: Reals = argument("", 4), rotation: Reals = result("", 4)) -> None:
        """conj(q) p: the rotation from q to p."""
        inverse = reals(4)
        inverse[:] = [q[0], -q[1], -q[2], -q[3]]
        multiply(inverse, p, rotation)

    @lib.kernel()
    def turned_back(q: Reals = argument("", 4), v: Reals = argument("", 3), out: Reals = result("", 3)) -> None:
        """C^T v: components of v in the turned axes, v - 2 q0 (u x v) + 2 u x (u x v), u the vector part of q."""
        once: Reals = cross(q[1:4], v)
        twice: Reals = cross(q[1:4], once)
        for i in range(3):
            out[i] = v[i] - 2 * q[0] * once[i] + 2 * twice[i]

    @lib.kernel()
    def unit(q: Reals = argument("", 4), normalized: Reals = result("", 4)) -> Status:
        """A quaternion with unit length; refused where it is off by more than 1e-3."""
        square = dot(q, q)
        if not (square >= 0) or square > lib.largest:
            return NOT_FINITE
        if square < UNIT_SQUARE_MIN or square > UNIT_SQUARE_MAX:
            return RANGE
        length = lib["sqrt"](square)
        normalized[:] = q / length
        return OK


@inline
def usable(lib: Library, value: float) -> Any:
    """Whether a number is one, and neither negative nor beyond any sense."""
    return value >= 0 and value <= lib.limit("MAX_WRENCH")


def add_settings(lib: Library, structs: LoopStructs, dumps: bool) -> None:
    """Adds the check of the settings."""

    @lib.kernel(statuses=("OK", "BAD_ARGUMENT"))
    def check_settings(config: Any = argument(struct=structs.config)) -> Status:
        """Are the settings usable? Others would pass NaN or a division by 0 on."""
        if not (config.period > 0 and config.period <= lib.limit("MAX_STEP")):
            return BAD_ARGUMENT
        for name in ("bandwidth", "damping", "closing_rate", "slew_rate", "slew_acceleration"):
            if not (config.member(name) > 0 and usable(lib, config.member(name))):
                return BAD_ARGUMENT
        for name in ("integral", "integral_most", *(("dump_rate", "dump_torque", "dump_begin") if dumps else ())):
            if not usable(lib, config.member(name)):
                return BAD_ARGUMENT
        if not (config.integral < 2 * config.damping * config.bandwidth):
            return BAD_ARGUMENT
        if dumps:
            if not (config.dump_end >= 0 and config.dump_end <= config.dump_begin):
                return BAD_ARGUMENT
            for i in range(3):
                if not (usable(lib, config.wanted_momentum[i]) or usable(lib, -config.wanted_momentum[i])):
                    return BAD_ARGUMENT
        for s in range(lib.layout.count):
            if not (usable(lib, config.viscous[s]) and usable(lib, config.coulomb[s])):
                return BAD_ARGUMENT
            if not (config.coulomb_speed[s] > 0 and usable(lib, config.coulomb_speed[s])):
                return BAD_ARGUMENT
        return OK


# -- reference and demand ----------------------------------------------------------------------------------------------


def add_mean_table(lib: Library) -> None:
    """Adds the table without harmonics of the flywheels."""
    layout = lib.layout
    harmonics = [(f.name, int(f.shape[0])) for f in layout.row.fields if f.name.endswith(("c", "s"))]

    @lib.kernel(
        statuses=("OK",),
        notes=(
            "With the table itself the torques would stop at each sample what unbalance does at that phase; held until "
            "the next sample they do harm instead, unless a turn of the flywheels takes many samples. The forces of "
            "unbalance stay in the plant.",
        ),
        public=True,
    )
    def attitude_mean_table(
        table: Any = lib.table, mean: Any = result("its harmonics are 0", struct=layout.table)
    ) -> Status:
        """The table of the same stand with flywheels that are balanced: the mean over their phases."""
        mean[:] = table
        for s in range(layout.count):
            for name, size in harmonics:
                for i in range(size):
                    mean.flywheel[s].member(name)[i] = 0
        return OK


@inline
def elapsed(config: Any, loop: Any) -> Any:
    """Time since the beginning of the turn."""
    return float(loop.tick) * config.period


def add_reference(lib: Library, structs: LoopStructs, dumps: bool) -> None:
    """Adds the reference, from rest to rest, and what begins it."""
    settings: Any = argument("settings", struct=structs.config)

    @lib.kernel(statuses=("OK", "RANGE"), public=True)
    def attitude_reference_at(
        course: Any = argument("the turn", struct=structs.course),
        t: float = argument("since its beginning; at rest before 0 and after its duration", unit="s"),
        out: Any = result("the reference", struct=structs.reference),
    ) -> Status:
        """Attitude, angular velocity and acceleration of the reference at a time."""
        if not (course.angle >= 0 and course.angle <= 4) or not usable(lib, course.duration):
            return RANGE
        if not (t >= -lib.limit("MAX_WRENCH") and t <= lib.limit("MAX_WRENCH")):
            return RANGE
        part: float = 0
        slope: float = 0
        curve: float = 0
        if t >= course.duration:
            part = 1
        elif t > 0:
            u = t / course.duration
            rest = 1 - u
            part = u * u * u * (10 + u * (6 * u - 15))
            slope = 30 * u * u * rest * rest / course.duration
            curve = 60 * u * rest * (1 - 2 * u) / (course.duration * course.duration)
        sine = reals()
        cosine = reals()
        lib["sincos"](course.angle * part / 2, sine, cosine)
        turn = reals(4)
        turn[0] = cosine
        turn[1:4] = sine * course.axis
        lib["multiply"](course.member("from"), turn, out.attitude)
        for i in range(3):
            out.rate[i] = course.axis[i] * course.angle * slope
            out.acceleration[i] = course.axis[i] * course.angle * curve
        return OK

    @lib.kernel(statuses=("OK", "NOT_FINITE", "RANGE", "BAD_ARGUMENT"), public=True)
    def attitude_reset(
        config: Any = settings,
        attitude: Reals = argument("unit quaternion, w first, to 1e-3: where it rests", 4),
        loop: Any = result("at rest", struct=structs.state),
    ) -> Status:
        """The loop with a reference that rests."""
        lib["check_settings"](config)
        start = reals(4)
        lib["unit"](attitude, start)
        loop.course.member("from")[:] = start
        loop.course.axis[:] = [1, 0, 0]
        loop.course.angle = 0
        loop.course.duration = 0
        loop.tick = 0
        loop.integral[:] = [0, 0, 0]
        if dumps:
            loop.dumping = 0
        return OK

    @lib.kernel(
        statuses=("OK", "NOT_FINITE", "RANGE", "BAD_ARGUMENT"),
        notes=(
            "The shorter way about the eigenaxis, as fast as slew_rate and slew_acceleration allow: "
            "T = max(15/8 angle / rate, sqrt(10/sqrt(3) angle / acceleration)). BAD_ARGUMENT as well where a turn is "
            "not at its end.",
        ),
        public=True,
    )
    def attitude_slew(
        config: Any = settings,
        goal: Reals = argument("unit quaternion, w first, to 1e-3", 4),
        loop: Any = changed("its reference must be at rest", struct=structs.state),
    ) -> Status:
        """Begins a rest-to-rest turn of the reference to an attitude."""
        lib["check_settings"](config)
        if elapsed(config, loop) < loop.course.duration:
            return BAD_ARGUMENT
        end = reals(4)
        lib["unit"](goal, end)
        now = record(structs.reference)
        attitude_reference_at(loop.course, loop.course.duration, now)
        start = reals(4)
        lib["unit"](now.attitude, start)
        turn = reals(4)
        lib["between"](start, end, turn)
        sign = -1.0 if turn[0] < 0 else 1.0
        length = lib["sqrt"](dot(turn[1:4], turn[1:4]))
        angle = 2 * lib["atan2"](length, sign * turn[0])
        by_rate = 1.875 * angle / config.slew_rate
        by_acceleration = lib["sqrt"](5.773502691896258 * angle / config.slew_acceleration)
        loop.course.member("from")[:] = start
        for i, rest in enumerate((1.0, 0.0, 0.0)):
            loop.course.axis[i] = sign * turn[i + 1] / length if length > 0 else rest
        loop.course.angle = angle
        loop.course.duration = by_rate if by_rate > by_acceleration else by_acceleration
        loop.tick = 0
        return OK


def add_demand(lib: Library, structs: LoopStructs) -> None:
    """Adds quaternion feedback."""

    @lib.kernel(
        statuses=("OK",),
        notes=(
            "C_e^T a_r - w_e x C_e^T w_r - 2 zeta omega (w_e + c) - omega^2 k s, c = omega/(2 zeta) e, at most "
            "closing_rate; q_e = conj(q_r) q, e = 2 sign(q_e0) q_e, w_e = w - C_e^T w_r; k s: `integral` times the "
            "integral of e. Without limits 2 zeta omega c = omega^2 e. Numbers out of range give such a demand: "
            "torque_for refuses it.",
        ),
        public=True,
    )
    def attitude_demand_for(
        config: Any = argument("settings", struct=structs.config),
        reference: Any = argument("where the carrier should be", struct=structs.reference),
        attitude: Reals = argument("unit quaternion, w first; of the carrier", 4),
        rate: Reals = argument("its angular velocity, in E1", 3, unit="rad/s"),
        integral: Reals = argument("of the error", 3, unit="rad s"),
        out: Any = result("the demand", struct=structs.demand),
    ) -> Status:
        """The wanted angular acceleration by quaternion feedback."""
        q = reals(4)
        lib["between"](reference.attitude, attitude, q)
        sign = -2.0 if q[0] < 0 else 2.0  # the shorter way
        rate_ref = reals(3)
        acceleration = reals(3)
        lib["turned_back"](q, reference.rate, rate_ref)
        lib["turned_back"](q, reference.acceleration, acceleration)
        closing = reals(3)
        for i in range(3):
            out.error[i] = sign * q[i + 1]
            out.rate_error[i] = rate[i] - rate_ref[i]
            closing[i] = config.bandwidth / (2 * config.damping) * out.error[i]
        square = dot(closing, closing)
        limited = square > config.closing_rate * config.closing_rate
        out.limited = 1 if limited else 0
        scale = config.closing_rate / lib["sqrt"](square) if limited else 1
        transport: Reals = cross(out.rate_error, rate_ref)
        for i in range(3):
            out.wanted[i] = (
                acceleration[i]
                - transport[i]
                - 2 * config.damping * config.bandwidth * (out.rate_error[i] + scale * closing[i])
                - config.bandwidth * config.bandwidth * config.integral * integral[i]
            )
        return OK


def add_moment(lib: Library, structs: LoopStructs) -> None:
    """Adds the external moment that dumps momentum."""

    @lib.kernel(statuses=("OK",), public=True)
    def attitude_moment(
        config: Any = argument("settings", struct=structs.config),
        momentum: Reals = argument("h, what is to be dumped, in E1", 3, unit="N m s"),
        dumping: IntResult = changed("whether it dumps"),
        moment: Reals = result("in E1", 3, unit="N m"),
    ) -> Status:
        """External moment that dumps momentum, M = -dump_rate h, at most dump_torque, with a hysteresis."""
        size = lib["sqrt"](dot(momentum, momentum))
        wanted = config.dump_rate * size
        rate: float = 0
        if size > config.dump_begin:
            dumping.value = 1
        if size < config.dump_end:
            dumping.value = 0
        if dumping.value != 0:
            rate = config.dump_torque / size if wanted > config.dump_torque else config.dump_rate
        moment[:] = -rate * momentum
        return OK


# -- torques -----------------------------------------------------------------------------------------------------------


def add_friction(lib: Library, structs: LoopStructs) -> None:
    """Adds the friction of a flywheel."""

    @lib.kernel()
    def friction(
        config: Any = argument(struct=structs.config), s: int = argument(), speed: float = argument(unit="rad/s")
    ) -> float:
        """Friction of flywheel s at its speed: what its motor bears besides the drive torque."""
        part = speed / config.coulomb_speed[s]
        return config.viscous[s] * speed + config.coulomb[s] * (1 if part > 1 else -1 if part < -1 else part)


@inline
def bound_torques(lib: Library, config: Any, x: Any, failed: Ints, options: Any) -> None:
    """Bounds of the drive torques such that, with friction, the motors stay within theirs."""
    for s in range(lib.layout.count):
        size = abs(x.phi_dot[s])
        part = 1 - size / options.motor_speed[s]
        borne = lib["friction"](config, s, size)
        left = options.motor_torque[s] - borne / part if part > 0 else 0
        options.motor_torque[s] = 0 if failed[s] != WORKS or left < 0 else left
        if lib.layout.motor_points:
            for k in range(lib.layout.motor_points):
                rest = options.motor_curve_torque[s][k] - borne
                options.motor_curve_torque[s][k] = rest if rest > 0 else 0
        options.target_speed[s] = config.preferred[s]
    options.target_rate = config.preferred_rate
    options.avoid_speed = config.avoid
    options.keep_direction = 1


def struct_of(function: Any) -> Struct:
    """The struct that a function writes, its last argument."""
    struct: Struct = function.arguments[-1].type
    return struct


@inline
def momentum_left(lib: Library, momentum: Function, config: Any, table: Any, x: Any, left: Reals) -> None:
    """Angular momentum about the mass centre, less what is to stay, in E1."""
    whole = record(struct_of(momentum))
    momentum(table, x, whole)
    carried: Reals = cross(whole.center_of_mass, whole.Z[0:3])
    stays = reals(3)
    lib["turned_back"](x.attitude, config.wanted_momentum, stays)
    for i in range(3):
        left[i] = whole.Z[3 + i] - carried[i] - stays[i]


def add_step(
    lib: Library, structs: LoopStructs, stand: Program, task: str, places: Sequence[int], dumps: bool, options: Variable
) -> None:
    """Adds one sample. `options`: the constant of the stand's C."""
    N, wrenches, rated = lib.layout.count, 6 * len(lib.layout.inputs), options.place
    torque_for = stand.function(f"torque_for_{task}")
    momentum = stand.function("momentum") if dumps else None
    demands = "reference, demand, external moment" if dumps else "reference, demand"

    @lib.kernel(
        statuses=tuple(dict.fromkeys((*torque_for.statuses, "BAD_ARGUMENT"))),
        purpose=f"One sample of the loop: {demands}, drive torques within what the motors have.",
        notes=(
            "The demand keeps its direction where torques do not reach it. The integral waits where the demand is "
            "limited. LIMITED tells of flywheels that work. BAD_ARGUMENT: a null pointer, an unknown flag, or settings "
            "that are no settings. With no flywheel left it returns UNREACHABLE, and torques 0. Where the status is "
            "negative, give the motors no torque, or the last.",
        ),
        public=True,
    )
    def attitude_step(
        config: Any = argument("settings", struct=structs.config),
        table: Any = argument("the mean table of the stand, by attitude_mean_table", struct=lib.layout.table),
        loop: Any = changed("begun by attitude_reset", struct=structs.state),
        x: Any = argument(
            "estimate of the state; its position and velocity matter only where forces depend on them",
            struct=lib.layout.state,
        ),
        failed: Ints = argument("flags of failed flywheels; null: all work", N, optional="zeros"),
        out: Any = result("torques and what they are for", struct=structs.result),
    ) -> Status:
        """A sample of the loop."""
        lib["check_settings"](config)
        held = ints(N)
        for s in range(N):
            if failed[s] < WORKS or failed[s] > HELD:
                return BAD_ARGUMENT
            held[s] = 1 if failed[s] == HELD else 0
        made = record(structs.result)
        t = elapsed(config, loop)
        lib["attitude_reference_at"](loop.course, t, made.reference)
        rate: Reals = x.V[3:6]
        lib["attitude_demand_for"](config, made.reference, x.attitude, rate, loop.integral, made.demand)
        if wrenches:
            wrench = reals(wrenches)
            for i in range(wrenches):
                wrench[i] = 0
        else:
            wrench = None
        if dumps:
            dumping: int = loop.dumping
            momentum_left(lib, momentum, config, table, x, made.momentum)
            lib["attitude_moment"](config, made.momentum, dumping, made.moment)
            for i in range(3):
                wrench[3 + i] = made.moment[i]  # the flywheels balance it from the first sample on
        bounds = record(lib.layout.inverse_options)
        bounds[:] = rated
        bound_torques(lib, config, x, failed, bounds)
        demand = reals(3)
        demand[:] = [made.demand.wanted[place] for place in places]
        found = record(struct_of(torque_for))
        known = {"table": table, "x": x, "demand": demand, "options": bounds, "locked": held, "wrench": wrench}
        answer = torque_for(*(known[a.name] for a in torque_for.arguments[:-1]), found)
        if int_of(answer) < 0:
            return answer
        limited: int = 0
        for s in range(N):
            wanted = found.tau[s] + lib["friction"](config, s, x.phi_dot[s])
            # what the motor gives at most at its speed: driving, less with speed
            part = 1 - abs(x.phi_dot[s]) / rated.motor_speed[s]
            drives = (wanted > 0 and x.phi_dot[s] > 0) or (wanted < 0 and x.phi_dot[s] < 0)
            has = rated.motor_torque[s] * part if part > 0 else 0
            most = at_most(lib, rated, s, x.phi_dot[s], has if drives else rated.motor_torque[s])
            works = failed[s] == WORKS
            made.tau[s] = (most if wanted > most else -most if wanted < -most else wanted) if works else 0
            cut = wanted > most or wanted < -most or found.limited[s] != 0
            made.limited[s] = 1 if works and cut else 0
            limited = 1 if works and cut else limited
        for row, place in enumerate(places):
            made.residual[place] = found.residual[row]
        made.share = found.share
        bits = word(int_of(answer))
        if bits & UNREACHABLE == 0 and made.demand.limited == 0:
            for i in range(3):
                total = loop.integral[i] + config.period * made.demand.error[i]
                most = config.integral_most
                loop.integral[i] = most if total > most else -most if total < -most else total
        if dumps:
            loop.dumping = dumping
        if t < loop.course.duration:
            loop.tick = loop.tick + 1
        out[:] = made
        return status_of(int_of(bits - (bits & LIMITED)) + LIMITED * limited)
