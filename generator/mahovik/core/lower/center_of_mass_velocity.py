"""Velocity of the mass centre of all bodies, as public function."""

from __future__ import annotations

from mahovik.core.formula.derived import carrier as derived
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs, scene, sum_up
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def center_of_mass_velocity(lib: Library) -> Function:
    """Momentum of the bodies at V, without added mass, over their mass; turned to E0."""
    table, x = lib.table_argument(), lib.state_argument()
    out = Argument("center_of_mass_velocity", Kind.REAL, (3,), "out", "m/s", "relative to E0, in E0")
    body = Body()
    check_inputs(lib, body, table, x)
    seen = scene(lib, body, table.place, x.place, attitude=True)
    sum_up(lib, body, table.place, x.place, seen, None, mass_alone=True)
    assert seen.C is not None
    own = body.local("own_velocity", (3,), comment="in E1, from the momentum of the bodies, without the fluid's")
    moments = {"m": table.place.mass, "mu": seen.sums.mu, "mu_dot": seen.sums.mu_dot}
    assign(body, list(own), derived.momentum(False)[:3, :], moments | parts_of_twist(x.place.V))
    for element in own:
        body.set(element, element * table.place.mass_inverse)
    assign(body, list(out.place), derived.momentum_in_E0()[:3, :], {"C": seen.C, "p": own})
    return body.checked_function(
        "center_of_mass_velocity",
        "Velocity of the mass centre of all bodies, rotation of the flywheels included.",
        (table, x, out),
        statuses=STATE_STATUSES,
        public=True,
    )
