"""V*, phi'' of a held carrier under drive torques: flywheels eliminated along the freedoms."""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.core.lower.flywheels import along, common_terms, couple_flywheel
from mahovik.core.lower.forward import Scene
from mahovik.core.lower.hold import Freedoms, of_flywheel, room_for_projected
from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.expression import Expr, Place, equal, integer, real, select


def solve_held(
    lib: Library,
    body: Body,
    table: Place,
    seen: Scene,
    given: tuple[Place, Place],
    freedoms: Freedoms,
    drift: Place | None,
    results: Sequence[Place],
) -> None:
    """Writes V*, phi'', u*, for given tau and locks, of the equations for phi'' = 0.

    `drift`: omega x C^T u of a stream.
    """
    layout = lib.layout
    (tau, locked), (V_dot, phi_ddot, *others) = given, results
    bias = body.local("bias", (layout.count,), comment="drive torques at V* = 0, phi'' = 0")
    inverse = body.local("inverse", (layout.count,), comment="1 / Theta_ff; 0 where a lock holds")
    columns = body.local("columns", (layout.count, 6), comment="columns of I")
    rate = body.local("rate", (layout.count,), comment="accelerations at V* = 0")
    projected = room_for_projected(lib, body)
    _couple(lib, body, table, seen, columns, bias)
    with body.loop("s", layout.count) as s:
        body.set(inverse[s], select(equal(locked[s], integer(0)), table.flywheel[s].spin_inv, real(0)))
        demand: Expr = tau[s] - bias[s] if seen.own is None else tau[s] - bias[s] + seen.own[s * integer(6) + 3]
        if drift is not None:
            demand = demand - _linear(columns[s], drift)
        body.set(rate[s], demand * inverse[s])
        freedoms.eliminate(list(columns[s]), rate[s], inverse[s], of_flywheel(projected, s))
    freedoms.solve()
    with body.loop("s", layout.count) as s:
        back = freedoms.back(of_flywheel(projected, s))
        body.set(phi_ddot[s], rate[s] - back * inverse[s] if projected is not None else rate[s])
    freedoms.write(V_dot, others)


def _linear(coupling: Place, drift: Place) -> Expr:
    """I_s . (drift, 0)."""
    return along(list(coupling), [*drift, real(0), real(0), real(0)])


def _couple(lib: Library, body: Body, table: Place, seen: Scene, columns: Place, bias: Place) -> None:
    """Columns of I and bias torques of all flywheels."""
    layout = lib.layout
    alike = common_terms.put_into(body, lib, seen.V, seen.g)
    drive = body.local("drive", (), layout.coupling)
    with body.loop("s", layout.count) as s:
        couple_flywheel.put_into(body, lib, table, s, seen, alike, drive)
        body.copy_array(columns[s], drive.I)
        body.set(bias[s], drive.bias)
