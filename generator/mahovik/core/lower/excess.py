"""EXCESSIVE: does an answer of `inverse` need more than the motors have, or too large an acceleration?"""

from __future__ import annotations

from typing import Any

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.lower.library import Library
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Const, integer
from mahovik.core.program.kernel import BAD_ARGUMENT, NOT_FINITE, Reals, argument, inline, reals
from mahovik.core.program.types import Kind

SPIN_UP_NOTE = (
    "EXCESSIVE counts Theta_ff phi_ddot and the friction of the motor. What the carrier's motion adds is left "
    "out: `torque` and `inverse` have it. What the options say of motors is not checked; it decides this bit alone."
)


YES: Any = integer(1)
"""1 of a function that returns an int."""


def bit(status: str) -> Any:
    """The bit of a positive status."""
    return Const(STATUS_VALUES[status], Kind.INT, status)


def add_excessive(lib: Library) -> None:
    """Whether some flywheel needs more than it has for a motion, from checked inputs."""
    N, largest, motor_lacks, points = lib.layout.count, lib.largest, lib["motor_lacks"], lib.layout.motor_points

    @lib.kernel()
    def excessive(
        table: Any = lib.table,
        x: Any = lib.x,
        sine: Any = lib.sine,
        cosine: Any = lib.cosine,
        V_dot: Reals = argument("that results", 6, unit="m/s2, rad/s2"),
        phi_ddot: Any = lib.phi_ddot,
        options: Any = argument("what each flywheel has", struct=lib.layout.inverse_options),
        wrench: Any = lib.wrench,
        flags: Any = Argument("flags", Kind.INT, (), "out", purpose="EXCESSIVE, or 0"),
    ) -> None:
        """Does a motion need more than a motor's torque or speed, or a larger phi_ddot than `most`?"""
        motors: int = 0  # flywheels whose motor has a limit
        excess: int = 0
        for s in range(N):
            if abs(phi_ddot[s]) > options.most[s]:
                excess = bit("EXCESSIVE")
            if options.motor_torque[s] < largest or options.motor_speed[s] < largest:
                motors = motors + 1
            if points:
                if options.motor_curve_torque[s][0] < largest:
                    motors = motors + 1
        if motors > 0:
            tau = reals(N)  # drive torques
            lib["balance"](table, x, sine, cosine, V_dot, phi_ddot, wrench, tau)
            for s in range(N):
                if motor_lacks(options, s, tau[s], x.phi_dot[s]) != 0:
                    excess = bit("EXCESSIVE")
        flags.value = excess


def add_motor_curve(lib: Library) -> None:
    """The limit of a motor by its curve, where a motor of the stand has one."""
    points = lib.layout.motor_points
    if not points:
        return

    @lib.kernel()
    def motor_curve(
        options: Any = argument("what each flywheel has", struct=lib.layout.inverse_options),
        number: int = argument(),
        speed: float = argument(unit="rad/s"),
    ) -> float:
        """The most that a motor gives at a speed, either way: lines between points, beyond the ends it holds."""
        k: int = 1  # the point behind
        for i in range(1, points - 1):
            if options.motor_curve_speed[number][i] < speed:
                k = i + 1
        low = options.motor_curve_speed[number][k - 1]
        high = options.motor_curve_speed[number][k]
        one = options.motor_curve_torque[number][k - 1]
        other = options.motor_curve_torque[number][k]
        if speed <= low:
            return one
        if speed >= high:
            return other
        return one + (other - one) * ((speed - low) / (high - low))


@inline
def at_most(lib: Any, options: Any, s: Any, speed: Any, torque: Any) -> Any:
    """A torque, or what the motor's curve leaves of it at a speed."""
    if lib.layout.motor_points:
        asked = torque
        limit = lib["motor_curve"](options, s, speed)
        return limit if limit < asked else asked
    return torque


@inline
def when_driving(options: Any, s: Any, speed: Any) -> Any:
    """Torque of a motor that drives at a speed; negative beyond the no-load speed."""
    return options.motor_torque[s] * (1 - abs(speed) / options.motor_speed[s])


def add_motor_lacks(lib: Library) -> None:
    """Whether the motor of a flywheel lacks a torque, with its friction, at a speed."""
    points = lib.layout.motor_points

    @lib.kernel()
    def motor_lacks(
        options: Any = argument("what each flywheel has", struct=lib.layout.inverse_options),
        number: int = argument(),
        tau: float = argument(unit="N m"),
        speed: float = argument(unit="rad/s"),
    ) -> int:
        """Does a motor lack the torque tau, with its friction, at this speed? Its no-load speed is above 0."""
        needed: float = tau + options.motor_viscous[number] * speed  # of the motor itself, which bears the friction
        if options.motor_coulomb[number] > 0 and options.motor_coulomb_speed[number] > 0:
            ratio = speed / options.motor_coulomb_speed[number]
            y = 3.0 if ratio > 3 else -3.0 if ratio < -3 else ratio  # tanh y to 0.024
            square = y * y
            needed += options.motor_coulomb[number] * (y * (27.0 + square) / (27.0 + 9.0 * square))
        if points:
            if abs(needed) > lib["motor_curve"](options, number, speed):
                return YES
        # driving, the torque falls linearly to zero at the no-load speed; braking has all of it
        share: float = 1.0
        if needed * speed > 0:
            share = 1 - abs(speed) / options.motor_speed[number]
        return 1 if share <= 0 or abs(needed) > options.motor_torque[number] * share else 0


@inline
def spin_up_excess(lib: Any, table: Any, x: Any, options: Any, phi_ddot: Reals) -> Any:
    """EXCESSIVE, or 0, by Theta_ff phi_ddot alone: what the carrier's motion adds is left out, for fast loops.

    Options of motors that are no numbers or negative are not refused: they decide this bit alone.
    """
    flags: int = 0
    for s in range(lib.layout.count):
        if flags == 0 and options.motor_speed[s] > 0:
            v = x.phi_dot[s]
            spin = table.flywheel[s].spin
            size = abs(phi_ddot[s])
            needed = spin * size + options.motor_viscous[s] * abs(v) + options.motor_coulomb[s]  # at most
            available = at_most(lib, options, s, v, when_driving(options, s, v))  # at least: when driving
            if not (size <= options.most[s] and needed <= available) and (
                size > options.most[s] or lib["motor_lacks"](options, s, spin * phi_ddot[s], v) != 0
            ):
                flags = bit("EXCESSIVE")
    return flags


@inline
def refuse(values: Any, wrong: bool) -> Any:
    """NOT_FINITE where a value is no number, BAD_ARGUMENT where they are wrong."""
    for value in values:
        if not (value > 0 or value <= 0):
            return NOT_FINITE
    if wrong:
        return BAD_ARGUMENT


@inline
def check_motor(lib: Any, options: Any, s: int) -> Any:
    """NOT_FINITE or BAD_ARGUMENT where the options say of the motor of flywheel s what none can have."""
    refuse(
        [options.most[s], options.motor_torque[s], options.motor_speed[s]],
        options.most[s] <= 0 or options.motor_torque[s] < 0 or options.motor_speed[s] <= 0,
    )
    if lib.layout.motor_points:
        lib["within"](options.motor_curve_speed[s], lib.layout.motor_points, lib.limit("MAX_SPEED"))
        for k in range(lib.layout.motor_points):
            refuse([options.motor_curve_torque[s][k]], options.motor_curve_torque[s][k] < 0)
        for k in range(1, lib.layout.motor_points):
            if options.motor_curve_speed[s][k] < options.motor_curve_speed[s][k - 1]:
                return BAD_ARGUMENT


@inline
def check_flywheels(lib: Any, options: Any) -> None:
    """The same of all motors with their friction, and of the limits of phi_ddot."""
    for s in range(lib.layout.count):
        refuse([options.limit[s]], options.limit[s] <= 0)
        check_motor(lib, options, s)
        refuse(
            [options.motor_viscous[s], options.motor_coulomb[s], options.motor_coulomb_speed[s]],
            options.motor_viscous[s] < 0 or options.motor_coulomb[s] < 0 or options.motor_coulomb_speed[s] <= 0,
        )
