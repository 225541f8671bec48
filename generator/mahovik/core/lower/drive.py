"""torque, reaction: what drives and hold must give for a motion; coupled: the motion that given drive torques make.

V_dot, phi_ddot under given torques: free flywheels are eliminated, from six rows of a free carrier, of a held one from
the rows along its freedoms.
"""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.flywheels import along, common_terms, couple_flywheel, turns_of
from mahovik.core.lower.forward import (
    STATE_STATUSES,
    all_turns,
    check_inputs,
    equations_along,
    external_wrench,
    from_stream,
    relative_rate,
    scene,
    sum_up,
)
from mahovik.core.lower.hold import write_twist
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import start_blocks
from mahovik.core.lower.wrenches import flywheel_wrenches
from mahovik.core.program.expression import Status, real
from mahovik.core.program.kernel import OK, Reals, argument, inline, local, reals, record, result


@inline
def drive_torques(
    lib: Library, table: Any, x: Any, turns: Any, V_dot: Reals, phi_ddot: Reals, wrench: Any, tau: Reals
) -> None:
    """tau of checked arguments."""
    seen = scene(lib, table, x, turns=turns)
    moving = relative_rate(x, V_dot, seen.stream)
    flywheel_wrenches(lib, table, x, seen, wrench)
    common = common_terms(lib, seen.V, seen.g)
    drive = record(lib.layout.coupling)
    for s in range(lib.layout.count):
        couple_flywheel(lib, table, s, seen, common, drive)
        tau[s] = less_moment(along(drive.I, moving) + table.flywheel[s].spin * phi_ddot[s] + drive.bias, seen.own, s)


def less_moment(torque: Any, wrenches: Any, s: Any) -> Any:
    """A torque less what the flywheel's own wrench gives, where it has such."""
    return torque if wrenches is None else torque - wrenches[s * 6 + 3]


def with_moment(torque: Any, wrenches: Any, s: Any) -> Any:
    """A torque and what the flywheel's own wrench gives, where it has such."""
    return torque if wrenches is None else torque + wrenches[s * 6 + 3]


def add_torque(lib: Library) -> None:
    """Adds the drive torques for given V_dot, phi_ddot."""
    layout, N = lib.layout, lib.layout.count
    turns: Any = lib.turn_arguments() or (None, None)
    tau_result: Any = result("drive torques, mount on flywheel, about the spin axis", N, unit="N m")
    wanted: Any = argument("derivative of the components of V", 6, unit="m/s2, rad/s2")

    @lib.kernel()
    def balance(
        table: Any = lib.table,
        x: Any = lib.x,
        sine: Reals = lib.sine,
        cosine: Reals = lib.cosine,
        V_dot: Reals = wanted,
        phi_ddot: Reals = lib.phi_ddot,
        wrench: Any = lib.flywheel_wrench,
        tau: Reals = tau_result,
    ) -> None:
        """Drive torques for a given motion, from checked inputs."""
        drive_torques(lib, table, x, (sine, cosine), V_dot, phi_ddot, wrench, tau)

    @lib.kernel(statuses=STATE_STATUSES, public=True)
    def torque(
        table: Any = lib.table,
        x: Any = lib.x,
        sine: Any = turns[0],
        cosine: Any = turns[1],
        V_dot: Reals = wanted,
        phi_ddot: Reals = lib.phi_ddot,
        wrench: Any = lib.flywheel_wrench,
        tau: Reals = tau_result,
    ) -> Status:
        """Drive torques for a given motion: tau = f^T (Theta V_s_dot + Phi(V_s) Z_s - P_s)."""
        check_inputs(lib, table, x, phi_ddot, wrench, (sine, cosine) if layout.sine_input else ())
        lib["within"](V_dot, 6, lib.limit("MAX_ACCELERATION"))
        if layout.sine_input:
            sines, cosines = all_turns(lib, x, (sine, cosine))
            balance(table, x, sines, cosines, V_dot, phi_ddot, wrench, tau)
        else:
            drive_torques(lib, table, x, (), V_dot, phi_ddot, wrench, tau)
        return OK


def add_coupled(lib: Library) -> None:
    """Adds V_dot and phi_ddot for given tau, from checked inputs, and with checks."""
    layout, N = lib.layout, lib.layout.count
    turns: Any = lib.turn_arguments() or (None, None)
    torques: Any = argument("drive torques, mount on flywheel", N, unit="N m")
    motion: Any = result("derivative of the components of V", 6, unit="m/s2, rad/s2")
    spins: Any = result("flywheel accelerations", N, unit="rad/s2")
    locks: Any = lib.locked_argument()
    statuses = (*STATE_STATUSES, "NOT_POSITIVE_DEFINITE")

    @lib.kernel(statuses=statuses)
    def solve_coupled(
        table: Any = lib.table,
        x: Any = lib.x,
        sine: Reals = lib.sine,
        cosine: Reals = lib.cosine,
        tau: Reals = torques,
        locked: Any = locks,
        wrench: Any = lib.wrench,
        V_dot: Reals = motion,
        phi_ddot: Reals = spins,
        u_dot: Any = lib.u_dot,
    ) -> Status:
        """V_dot, phi_ddot for given drive torques, from checked inputs; written where the status is OK."""
        seen = scene(lib, table, x, turns=(sine, cosine))
        drift = None
        if layout.held:
            F = u_dot
            K, drift = equations_along(lib, table, x, seen, wrench, None, F)
        else:
            sum_up(lib, table, x, seen, None)
            F = reals(6)  # wrench (7); then the right-hand side of K V_dot + I phi_ddot = F
            external_wrench(lib, table, x, seen, wrench, F)
            lib["subtract_rates"](table, seen.sums, seen.V, F)
            K = record(layout.schur)  # mass matrix with free flywheels eliminated
            start_blocks(lib, table, seen.sums, K)
        columns = None
        if layout.held:
            drive = record(layout.coupling)
            if layout.freedoms:
                columns = reals(N, layout.freedoms)  # S^T I, flywheel by flywheel
        else:
            drive = record(layout.coupling, N)
        common = common_terms(lib, seen.V, seen.g)
        rate = reals(N)  # accelerations at V_dot = 0
        for s in range(N):
            one = drive if layout.held else drive[s]
            column = one.I if columns is None else columns[s]
            if locked[s] == 0:
                couple_flywheel(lib, table, s, seen, common, one)
                rate[s] = left_for(tau[s], one, seen.own, s, drift) * table.flywheel[s].spin_inv
                if layout.freedoms:
                    lib["project_wrench"](table, one.I, column)
                if layout.freedoms or not layout.held:
                    lib["eliminate"](column, table.flywheel[s].spin_inv, rate[s], K, F)
            else:
                if layout.freedoms or not layout.held:
                    column[:] = [0] * len(column)
                rate[s] = 0
        if layout.held:
            if layout.freedoms:
                lib["solve_freedoms"](K, u_dot)
            write_twist(lib, table, [u_dot] if layout.freedoms else [], V_dot)
        else:
            factor = record(layout.schur_factor)
            lib["factor_schur"](K, factor)
            lib["solve_schur"](factor, F, V_dot)
        for s in range(N):
            phi_ddot[s] = 0
            if locked[s] == 0:
                phi_ddot[s] = rate[s] - share_of(columns, drive, s, u_dot, V_dot) * table.flywheel[s].spin_inv
        if not layout.held:
            from_stream(x, seen, V_dot)
        return OK

    purpose = "Motion of the whole system under drive torques: V_dot, phi_ddot together, flywheels eliminated first"
    purpose += ", along the freedoms of the hold." if layout.freedoms else "."

    @lib.kernel(statuses=statuses, purpose=purpose, public=True)
    def coupled(
        table: Any = lib.table,
        x: Any = lib.x,
        sine: Any = turns[0],
        cosine: Any = turns[1],
        tau: Reals = torques,
        locked: Any = locks,
        wrench: Any = lib.wrench,
        V_dot: Reals = motion,
        phi_ddot: Reals = spins,
        u_dot: Any = lib.u_dot,
    ) -> Status:
        """Motion of the whole system under given drive torques."""
        check_inputs(lib, table, x, None, wrench, (sine, cosine) if layout.sine_input else (), tau)
        V_result = reals(6)
        phi_result = reals(N)
        sines, cosines = all_turns(lib, x, (sine, cosine) if layout.sine_input else ())
        u_dot_result = None
        if layout.freedoms:
            u_dot_result = reals(layout.freedoms)
        solve_coupled(table, x, sines, cosines, tau, locked, wrench, V_result, phi_result, u_dot_result)
        V_dot[:] = V_result
        if layout.freedoms:
            u_dot[:] = u_dot_result
        for s in range(N):
            phi_ddot[s] = phi_result[s]
        return OK


def share_of(columns: Any, drive: Any, s: Any, u_dot: Any, V_dot: Any) -> Any:
    """I_s . V_dot, of a held carrier along its freedoms; 0 of a clamped one."""
    if columns is not None:
        return along(columns[s], u_dot)
    return along(drive[s].I, V_dot) if drive.shape else real(0)


def left_for(tau: Any, drive: Any, wrenches: Any, s: Any, drift: Any) -> Any:
    """What torques leave for phi_ddot at V_dot = 0: tau - bias, own moment added, less I_s . (drift, 0)."""
    return without(with_moment(tau - drive.bias, wrenches, s), drive.I, drift)


def without(torque: Any, coupling: Any, drift: Any) -> Any:
    """A torque less I_s . (drift, 0)."""
    return torque if drift is None else torque - along(coupling, [*drift, real(0), real(0), real(0)])


def add_reaction(lib: Library) -> None:
    """Adds R = K V_r_dot - (F - M V_r - I phi_ddot - J phi_dot) of a motion, by all six rows of (8)."""
    V, meaning = lib.layout.twist, "wrench of the hold on the carrier, in E1 about O1; may overlap any input"
    purpose = (
        f"Wrench of the hold on the carrier for a motion: R = K {V}_dot - (F - M {V} - sum(I phi_ddot + J phi_dot))."
    )

    @lib.kernel(equation="(8)", purpose=purpose, statuses=STATE_STATUSES, public=True)
    def reaction(
        table: Any = lib.table,
        x: Any = lib.x,
        V_dot: Reals = argument(
            "derivative of the components of V, as forward or coupled gives it", 6, unit="m/s2, rad/s2"
        ),
        phi_ddot: Any = lib.phi_ddot,
        wrench: Any = lib.wrench,
        reaction: Reals = result(meaning, 6, unit="N, N m"),
    ) -> Status:
        """Wrench of the hold on the carrier."""
        check_inputs(lib, table, x, phi_ddot, wrench)
        lib["within"](V_dot, 6, lib.limit("MAX_ACCELERATION"))
        seen = scene(lib, table, x, turns=turns_of(lib, x))
        sum_up(lib, table, x, seen, phi_ddot)
        F = reals(6)  # wrench (7); then the right-hand side of (8)
        external_wrench(lib, table, x, seen, wrench, F)
        lib["subtract_rates"](table, seen.sums, seen.V, F)
        moving = relative_rate(x, V_dot, seen.stream)
        written = local("result", 6)
        lib["react"](table, seen.sums, moving, F, written)
        reaction[:] = written
        return OK
