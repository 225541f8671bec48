"""reaction: the wrench by which the hold of a carrier makes it move as it does, by all six rows of (8)."""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.flywheels import turns_of
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs, external_wrench, relative_rate, scene, sum_up
from mahovik.core.lower.library import Library
from mahovik.core.program.expression import Status
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import OK, Reals, argument, kernel, local, reals, result


def reaction(lib: Library) -> Function:
    """R = K V_r_dot - (F - M V_r - I phi_ddot - J phi_dot) of a motion."""
    purpose = "wrench of the hold on the carrier, in E1 about O1; may overlap any input"

    @kernel(equation="(8)", statuses=STATE_STATUSES, public=True)
    def reaction(
        table: Any = lib.table,
        x: Any = lib.x,
        V_dot: Reals = argument(
            "derivative of the components of V, as forward or coupled gives it", 6, unit="m/s2, rad/s2"
        ),
        phi_ddot: Any = lib.phi_ddot,
        wrench: Any = lib.wrench,
        reaction: Reals = result(purpose, 6, unit="N, N m"),
    ) -> Status:
        """Wrench of the hold on the carrier for a motion: R = K V_dot - (F - M V - sum(I phi_ddot + J phi_dot))."""
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

    return reaction
