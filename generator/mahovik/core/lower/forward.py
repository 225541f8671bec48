"""forward (8), as a public function; what others share with it: checks, attitude, stream, sums."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mahovik.core.lower import flywheels
from mahovik.core.lower.flywheels import turns_of
from mahovik.core.lower.freedoms import place_of
from mahovik.core.lower.hold import write_twist
from mahovik.core.lower.library import Library
from mahovik.core.program.expression import Present, Status
from mahovik.core.program.kernel import BAD_ARGUMENT, OK, Reals, inline, local, reals, record, result
from mahovik.core.program.vector import cross

STATE_STATUSES = ("OK", "NOT_FINITE", "RANGE")


@dataclass(frozen=True)
class Scene:
    """Inputs of the equations; None for those that the stand does not need.

    C attitude; V the twist of (8), V_r that relative to the stream; stream, where V is V_r, and g (gravity) in E1; sums
    over all bodies; own: wrenches of the flywheels of their own, six numbers each; turns: sines and cosines of the
    phases.
    """

    C: Any
    V: Any
    V_r: Any
    stream: Any
    g: Any
    sums: Any
    own: Any
    turns: Any


@inline
def check_inputs(
    lib: Library, table: Any, x: Any, phi_ddot: Any = None, wrench: Any = None, turns: Any = (), tau: Any = None
) -> Any:
    """Checks of state, sines, stream, accelerations, run-time wrenches, torques: before anything is computed.

    Accelerations or torques are looked at together with the state, where nothing has its turn between them.
    """
    N = lib.layout.count
    rows = ((phi_ddot, N, "MAX_ACCELERATION"), (wrench, 0, "MAX_WRENCH"), (tau, N, "MAX_WRENCH"))
    rest = [(v, count, lib.limit(bound)) for v, count, bound in rows if v is not None]
    together = rest and rest[0][1] is N and "check_motion" in lib and not lib.layout.stream
    if together:
        lib["check_motion"](x, rest[0][0], rest[0][2])
    else:
        lib["check_state"](x)
    if turns:
        sine, cosine = turns
        if Present(sine):
            if not Present(cosine):
                return BAD_ARGUMENT
            lib["check_turns"](sine, cosine)
        elif Present(cosine):
            return BAD_ARGUMENT
    if lib.layout.stream:
        lib["within"](table.stream, 3, lib.limit("MAX_VELOCITY"))
    if lib.layout.structure.stream_stations:
        lib["check_depth"](table, x)
    for values, count, most in rest[1:] if together else rest:
        lib["within"](values, count or len(values), most)
    return None


@inline
def scene(lib: Library, table: Any, x: Any, attitude: bool = False, turns: Any = ()) -> Any:
    """Attitude, twist relative to the stream, gravity, and places for sums.

    `attitude`: C even where (8) needs none. `turns`: sines and cosines that are known already.
    """
    layout = lib.layout
    C, stream, g, own = None, None, None, None
    by_quaternion = layout.held and layout.weight and not (attitude or layout.stream or "C" in lib.taken("external"))
    if (layout.attitude_needed or attitude) and not by_quaternion:
        C = reals(9)  # attitude
        lib["rotation"](x.attitude, C)
    if layout.stream:
        stream = reals(3)  # in E1
        if layout.structure.stream_stations:
            flow = reals(3)  # stream in E0, at this depth
            lib["stream_at"](table, x, flow)
        else:
            flow = table.stream
        lib["rotate_back"](C, flow, stream)
        V = reals(6)  # V relative to the stream: the fluid's frame is inertial as well
        V[0:3] = x.V[0:3] - stream
        V[3:6] = x.V[3:6]
    else:
        V = x.V
    if layout.weight:
        g = reals(3)  # gravity in E1
        if C is None:
            lib["turn_back"](x.attitude, table.gravity, g)
        else:
            lib["rotate_back"](C, table.gravity, g)
    if layout.local_turning:
        own = reals(6 * int(layout.count))  # own wrenches of the flywheels, six numbers each
    sum_ = record(layout.sums)
    of_drift = (V, V, stream) if layout.drifts else (x.V, V, None)
    return Scene(C, *of_drift, g, sum_, own, turns or turns_of(lib, x))


@inline
def sum_up(lib: Library, table: Any, x: Any, seen: Any, phi_ddot: Any, mass_alone: bool = False) -> None:
    """Sums over all bodies into seen.sums; without phi_ddot those of constant speeds. `mass_alone`: for K and K_dot."""
    flywheels.sum_up(lib, table, x, seen.turns, seen.sums, phi_ddot, mass_alone)


@inline
def external_wrench(lib: Library, table: Any, x: Any, seen: Any, wrench: Any, F: Any, name: str = "external") -> None:
    """F of (7), or zero where the stand has none."""
    if lib.layout.wrenches:
        turns = seen.turns or (None, None)
        lib[name](table, x, *turns, seen.sums, seen.C, seen.V_r, seen.g, wrench, F, seen.own)
    else:
        F[:] = [0] * 6


@inline
def drift_of(x: Any, stream: Any) -> Any:
    """omega x C^T stream: V_r_dot = V_dot + (omega x C^T stream, 0)."""
    drift: Reals = -cross(stream, x.V[3:6])  # omega x C^T stream
    return drift


@inline
def relative_rate(x: Any, V_dot: Any, stream: Any) -> Any:
    """V_r_dot = V_dot + (omega x C^T stream, 0) where (8) is of V_r, else V_dot itself."""
    if stream is None:
        return V_dot
    drift = drift_of(x, stream)
    V_r_dot = reals(6)  # V_r_dot = V_dot + (omega x C^T stream, 0)
    V_r_dot[0:3] = V_dot[0:3] + drift
    V_r_dot[3:6] = V_dot[3:6]
    return V_r_dot


@inline
def all_turns(lib: Library, x: Any, turns: Any) -> Any:
    """Sines and cosines as internal functions take them: those of arguments that a caller gives, or of the phases."""
    if not turns:
        return turns_of(lib, x)
    sine, cosine = turns
    sines = reals(lib.layout.count)
    cosines = reals(lib.layout.count)
    if Present(sine):  # the phases of x are checked, but not used
        for s in range(lib.layout.count):
            sines[s] = sine[s]
            cosines[s] = cosine[s]
    else:
        lib["sincos_each"](x.phi, sines, cosines)
    return sines, cosines


@inline
def equations_along(lib: Library, table: Any, x: Any, seen: Any, wrench: Any, phi_ddot: Any, y: Any) -> Any:
    """P u_dot = y, (8) along the freedoms, without phi_ddot for phi_ddot = 0: P, and omega x C^T stream."""
    if lib.layout.along:
        F = reals(6)  # wrench (7)
        along = record(lib.layout.along_sums)  # sums along the freedoms
        if phi_ddot is None:
            lib["sum_steady_along"](table, *seen.turns, x.phi_dot, None, seen.sums, along)
        else:
            lib["sum_along"](table, *seen.turns, x.phi_dot, phi_ddot, seen.sums, along)
        name = "external_along" if "external_along" in lib else "external"
        external_wrench(lib, table, x, seen, wrench, F, name)
        lib["right_side"](table, along, x.V, F, y)
        return along.P, None
    F = reals(6)  # wrench (7); then what is to be projected
    sum_up(lib, table, x, seen, phi_ddot)
    external_wrench(lib, table, x, seen, wrench, F)
    if not lib.layout.freedoms:
        return None, None if seen.stream is None else drift_of(x, seen.stream)
    lib["subtract_rates"](table, seen.sums, seen.V, F)
    drift = without_drift(lib, table, x, seen, F)
    P = reals(place_of(lib.layout.freedoms, 0))  # mass matrix along the freedoms
    lib["project_mass"](table, seen.sums, P)
    lib["project_wrench"](table, F, y)
    return P, drift


@inline
def from_stream(x: Any, seen: Any, V_dot: Any) -> None:
    """V_dot = V_r_dot - (omega x C^T stream, 0), where (8) is of V_r."""
    if seen.stream is not None:
        # V_dot = V_r_dot - (omega x C^T stream, 0)
        drift = drift_of(x, seen.stream)
        V_dot[0:3] = V_dot[0:3] - drift


@inline
def without_drift(lib: Library, table: Any, x: Any, seen: Any, F: Any) -> Any:
    """Takes K (drift, 0) from F, so that F belongs to V_dot; returns drift = omega x C^T stream, None without one."""
    if seen.stream is None:
        return None
    drift = drift_of(x, seen.stream)
    lib["subtract_drift"](table, seen.sums, drift, F)
    return drift


def add_forward(lib: Library) -> None:
    """Adds V_dot for given phi_ddot by (8), from checked inputs, and with checks."""
    layout = lib.layout
    statuses = (*STATE_STATUSES, "NOT_POSITIVE_DEFINITE")
    turns: Any = lib.turn_arguments() or (None, None)
    V = layout.twist
    equation = f"K {V}_dot = F - M {V} - sum(I phi_ddot + J phi_dot)"
    purpose = (
        f"u_dot of S^T ({equation}), inputs checked; valid if OK."
        if layout.held
        else f"{equation} of checked inputs; written where the status is OK."
    )

    @lib.kernel(equation="(8)", statuses=statuses, purpose=purpose, short=layout.held)  # few freedoms leave little
    def accelerate(
        table: Any = lib.table,
        x: Any = lib.x,
        sine: Any = lib.sine,
        cosine: Any = lib.cosine,
        phi_ddot: Any = lib.phi_ddot,
        wrench: Any = lib.wrench,
        V_dot: Any = None if layout.held else result("derivative of the components of V", 6, unit="m/s2, rad/s2"),
        u_dot: Any = lib.u_dot,
    ) -> Status:
        """V_dot for given phi_ddot."""
        seen = scene(lib, table, x, turns=(sine, cosine) if layout.flywheels else ())
        if u_dot is not None:
            P, _ = equations_along(lib, table, x, seen, wrench, phi_ddot, u_dot)
            lib["solve_freedoms"](P, u_dot)
        elif not layout.held:
            sum_up(lib, table, x, seen, phi_ddot)
            F = reals(6)  # wrench (7); then the right-hand side of (8)
            if layout.added_mass:
                K = record(layout.carrier_factor)
            external_wrench(lib, table, x, seen, wrench, F)
            lib["subtract_rates"](table, seen.sums, seen.V, F)
            if layout.added_mass:
                lib["factor_carrier"](table, seen.sums, K)
                lib["solve_carrier"](table, K, F, V_dot)
            else:
                lib["solve_carrier_once"](table, seen.sums, F, V_dot)  # few factors: they stay in registers
            from_stream(x, seen, V_dot)
        return OK

    purpose = "Acceleration of the carrier for given accelerations of the flywheels: " + (
        f"along the freedoms of the hold, S^T ({equation})." if layout.held else f"{equation}."
    )
    overlaps = "derivative of the components of V; may overlap any input"

    @lib.kernel(equation="(8)", statuses=statuses, purpose=purpose, public=True)
    def forward(
        table: Any = lib.table,
        x: Any = lib.x,
        sine: Any = turns[0],
        cosine: Any = turns[1],
        phi_ddot: Any = lib.phi_ddot,
        wrench: Any = lib.wrench,
        V_dot: Reals = result(overlaps, 6, unit="m/s2, rad/s2", overlaps=True),
        u_dot: Any = lib.u_dot,
    ) -> Status:
        """Acceleration of the carrier."""
        sine_and_cosine = () if sine is None else (sine, cosine)
        check_inputs(lib, table, x, phi_ddot, wrench, sine_and_cosine)
        at_once = layout.held or not layout.added_mass  # V_dot is written last, after all is read
        written = V_dot if at_once else local("result", 6)
        u_dot_result = None
        if layout.freedoms:
            u_dot_result = reals(layout.freedoms)
        turned = all_turns(lib, x, sine_and_cosine) or (None, None)
        lib["accelerate"](table, x, *turned, phi_ddot, wrench, written, u_dot_result)
        if layout.held:  # all inputs have been read
            write_twist(lib, table, [u_dot_result] if layout.freedoms else [], written)
        if not at_once:
            V_dot[:] = written
        if layout.freedoms:
            u_dot[:] = u_dot_result
        return OK
