"""matrices: K, K_dot, M, I, J of (8) and F of (7), as public function."""

from __future__ import annotations

from typing import Any

from mahovik.core.formula.derived import accumulate as derived_rows
from mahovik.core.formula.derived import carrier as derived
from mahovik.core.lower.flywheels import Turns, columns_of, let_turn
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs, external_wrench, scene, sum_up
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import carrier_binding, parts_of_twist
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Place, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def fill(body: Body, target: Place, values: Any, binding: dict[str, Any]) -> None:
    """A 6x6 of expressions into a 6x6 place, row by row."""
    for i in range(6):
        assign(body, list(target[i]), values[i, :], binding)


def velocity_matrix(lib: Library) -> Function:
    """M = Phi K + K_dot."""
    out = Argument("out", lib.layout.matrices, (), "inout", purpose="in: K, K_dot; out: M")
    V = Argument("V", Kind.REAL, (6,))
    body = Body()
    K, K_dot, M = out.place.K, out.place.K_dot, out.place.M
    with body.loop("j", 6, comment="Phi acts on each column") as j:
        column = derived.velocity_column()
        binding = parts_of_twist(V.place) | {"column": [K[i][j] for i in range(6)]}
        for i in range(6):
            body.set(M[i][j], translate(column[i], binding) + K_dot[i][j])
    return body.function("velocity_matrix", "M = Phi K + K*.", (V, out), equation="(9)")


def matrices(lib: Library) -> Function:
    """All matrices of (8) at a state."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    wrench = lib.wrench_arguments()
    out = Argument("out", layout.matrices, (), "out", purpose="K, K_dot, M, I, J, F")
    body = Body()
    check_inputs(lib, body, table, x, (), wrench)
    seen = scene(lib, body, table.place, x.place)
    sum_up(lib, body, table.place, x.place, seen, None, mass_alone=True)
    F = body.local("F", (6,))
    external_wrench(lib, body, table.place, x.place, seen, wrench, F)
    body.copy_array(out.place.F, F)
    binding = carrier_binding(lib, table.place, seen.sums)
    body.note("K (2) and its rate (6)")
    fill(body, out.place.K, derived.mass_matrix(layout.added_mass), binding)
    fill(body, out.place.K_dot, derived.mass_matrix_rate(), binding)
    body.call(lib["velocity_matrix"], seen.V, out.place)
    if layout.flywheels:
        _columns(lib, body, table.place, x.place, seen.turns, seen.V, out.place)
    return body.checked_function(
        "matrices",
        "The matrices of K V* + M V + I phi'' + J phi' = F at a state.",
        (table, x, *wrench, out),
        equation="(2), (6)-(9)",
        statuses=STATE_STATUSES,
        public=True,
    )


def _columns(lib: Library, body: Body, table: Place, x: Place, turns: Turns, V: Place, out: Place) -> None:
    """I_s = (mu', t) and J_s = Phi I_s + (mu'', t') phi'."""
    column = body.local("column", (6,), comment="I_s")
    rate = body.local("rate", (6,), comment="dI_s / dphi")
    with body.loop("s", lib.layout.count) as s:
        turn = let_turn(body, turns, s)
        binding = turn | columns_of(table.flywheel[s])
        derived_columns = derived_rows.columns()
        assign(body, list(column), derived_columns.I, binding)
        assign(body, list(rate), derived_columns.I_prime, binding)
        moved = derived.velocity_column()
        parts = parts_of_twist(V) | {"column": column}
        for i in range(6):
            body.set(out.I[i][s], column[i])
            body.set(out.J[i][s], translate(moved[i], parts) + rate[i] * x.phi_dot[s])


def momentum(lib: Library) -> Function:
    """Z, Z0, kinetic energy, mass centre and its velocity."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    out = Argument("out", layout.momentum, (), "out", purpose="Z, Z0, energy, mass centre and its velocity")
    body = Body()
    check_inputs(lib, body, table, x)
    seen = scene(lib, body, table.place, x.place, attitude=True)
    sum_up(lib, body, table.place, x.place, seen, None)
    C, V, sums = seen.C, seen.V, seen.sums
    assert C is not None
    Z = body.local("Z", (6,), comment="momentum screw (2)")
    body.call(lib["momentum_screw"], table.place, sums, V, Z)
    spin = body.local("spin", comment="sum phi' (I^T V + Theta_ff phi')")
    body.set(spin, real(0))
    if layout.flywheels:
        _spin(lib, body, table.place, x.place, seen.turns, V, spin)
    z = list(Z)
    energy = body.local("energy")
    parts = parts_of_twist(V) | {"p": z[:3], "h": z[3:], "spin": spin}
    body.set(energy, translate(derived.kinetic_energy(), parts))
    if seen.stream is not None:
        _add_stream(body, table.place, x.place, V, seen.stream, sums, Z, energy)
    six = list(out.place.Z0)
    body.copy_array(out.place.Z, Z)
    body.note("Z0 = L1 Z of (1)")
    p0 = six[:3]
    bound = {"C": C, "r": x.place.position, "p": z[:3], "h": z[3:], "p0": p0}
    assign(body, six, derived.momentum_in_E0(), bound)
    body.set(out.place.energy, energy)
    for i in range(3):
        body.set(out.place.center_of_mass[i], sums.mu[i] * table.place.mass_inverse)
    v = body.local("v", (3,), comment="of the mass centre in E1, from the momentum of the bodies, without the fluid's")
    if layout.added_mass or layout.stream:
        binding = {"m": table.place.mass, "mu": sums.mu, "mu_dot": sums.mu_dot} | parts_of_twist(x.place.V)
        assign(body, list(v), derived.momentum(False)[:3, :], binding)
    for i in range(3):
        body.set(v[i], (v[i] if layout.added_mass or layout.stream else z[i]) * table.place.mass_inverse)
    assign(body, list(out.place.center_of_mass_velocity), derived.momentum_in_E0()[:3, :], {"C": C, "p": v})
    return body.checked_function(
        "momentum",
        "Momentum screw, kinetic energy, mass centre of the whole system and its velocity.",
        (table, x, out),
        equation="(1), (2)",
        statuses=STATE_STATUSES,
        public=True,
    )


def _spin(lib: Library, body: Body, table: Place, x: Place, turns: Turns, V: Place, spin: Place) -> None:
    """Kinetic energy that goes with phi': V . I_s phi' + Theta_ff phi'^2, twice the energy's second half."""
    with body.loop("s", lib.layout.count) as s:
        row = table.flywheel[s]
        turn = let_turn(body, turns, s)
        column = derived_rows.columns().I
        binding = turn | columns_of(row)
        along = translate(column[0], binding) * V[0]
        for i in range(1, 6):
            along = along + translate(column[i], binding) * V[i]
        product = body.let("along", along, "I_s . V")
        body.add(spin, x.phi_dot[s] * (product + row.spin * x.phi_dot[s]))


def _add_stream(body: Body, table: Place, x: Place, V: Place, u: Place, sums: Place, Z: Place, energy: Place) -> None:
    """From V_r to V for the bodies; the fluid's share (Lambda) stays at V_r: Galilean change of frame."""
    body.note("bodies at V, added mass at V relative to the stream")
    p = body.local("p", (3,), comment="momentum of the bodies relative to the stream")
    plain = derived.momentum(False)
    six = list(V)
    binding = {"m": table.mass, "mu": sums.mu, "mu_dot": sums.mu_dot, "v": six[:3], "omega": six[3:]}
    assign(body, list(p), plain[:3, :], binding)
    work = p[0] * u[0] + p[1] * u[1] + p[2] * u[2]
    square = u[0] * u[0] + u[1] * u[1] + u[2] * u[2]
    body.add(energy, work + real(0.5) * table.mass * square)
    for i in range(3):
        body.add(Z[i], table.mass * u[i])
    assign(body, list(Z)[3:], derived.stream_moment(), {"mu": sums.mu, "u": u}, add=True)
