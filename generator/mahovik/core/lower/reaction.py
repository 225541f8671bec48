"""reaction: the wrench by which the hold of a carrier makes it move as it does, by all six rows of (8)."""

from __future__ import annotations

from mahovik.core.lower.flywheels import turns_of
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs, external_wrench, relative_rate, scene, sum_up
from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def reaction(lib: Library) -> Function:
    """R = K V_r* - (F - M V_r - I phi'' - J phi') of a motion."""
    table, x = lib.table_argument(), lib.state_argument()
    phi_ddot, wrench = lib.phi_ddot_arguments(), lib.wrench_arguments()
    purpose = "derivative of the components of V, as forward or coupled gives it"
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose=purpose)
    purpose = "wrench of the hold on the carrier, in E1 about O1; may overlap any input"
    found = Argument("reaction", Kind.REAL, (6,), "out", "N, N m", purpose)
    body = Body()
    check_inputs(lib, body, table, x, phi_ddot, wrench)
    lib.check(body, "within", V_dot.place, 6, lib.limits["MAX_ACCELERATION"].expression)
    seen = scene(lib, body, table.place, x.place, turns=turns_of(lib, body, x.place))
    sum_up(lib, body, table.place, x.place, seen, phi_ddot[0].place if phi_ddot else None)
    F = body.local("F", (6,), comment="wrench (7); then the right-hand side of (8)")
    external_wrench(lib, body, table.place, x.place, seen, wrench, F)
    body.call(lib["subtract_rates"], table.place, seen.sums, seen.V, F)
    moving = relative_rate(body, x.place, V_dot.place, seen.stream)
    result = body.local("result", (6,))
    body.call(lib["react"], table.place, seen.sums, moving, F, result)
    body.copy_array(found.place, result)
    return body.checked_function(
        "reaction",
        "Wrench of the hold on the carrier for a motion: R = K V* - (F - M V - sum(I phi'' + J phi')).",
        (table, x, V_dot, *phi_ddot, *wrench, found),
        equation="(8)",
        statuses=STATE_STATUSES,
        public=True,
    )
