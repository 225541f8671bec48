"""forward_jacobian, coupled_jacobian: exact derivatives by V, phi, phi' and phi'' or tau, at fixed attitude."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mahovik.core.derive.order import WEIGHTS
from mahovik.core.formula.derived import accumulate as derived_rows
from mahovik.core.formula.derived import drive as derived_drive
from mahovik.core.formula.derived import sensitivity as derived
from mahovik.core.lower.drive import check_drive, solve_free, without_drives
from mahovik.core.lower.flywheel_slopes import (
    CoupledMotion,
    Sides,
    by_flywheels,
    change_of_row,
    own_change,
    row_weights,
)
from mahovik.core.lower.flywheels import along, columns_of, let_turn, named_turns, turns_of
from mahovik.core.lower.forward import (
    STATE_STATUSES,
    Scene,
    check_inputs,
    external_wrench,
    scene,
    sum_up,
)
from mahovik.core.lower.library import Library
from mahovik.core.lower.matrices import mass_matrix, mass_matrix_rate
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, equal, integer, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def twist_slopes(
    lib: Library, body: Body, table: Place, x: Place, seen: Scene, wrench: tuple[Argument, ...], Z: Place
) -> tuple[Place, Place]:
    """Derivative of the remainder by V, and of the own axial moments."""
    layout = lib.layout
    m = body.local("m", (), layout.matrices)
    body.set(m.K, mass_matrix(lib, table, seen.sums))
    body.set(m.K_dot, mass_matrix_rate(seen.sums))
    body.call(lib["velocity_matrix"], seen.V, m)
    slope = body.local("slope", (36,), comment="derivative by V, row by row")
    axial = body.local(
        "axial", (6 * max(1, int(layout.count)),), comment="derivatives by V of the flywheels' own axial moments"
    )
    named = {"table": table, "x": x, "V": seen.V, "Z": Z, "m": m, "C": seen.C, "slope": slope, "axial": axial}
    named |= named_turns(seen.turns)
    body.call(lib["twist_slope"], *lib.arguments_of("twist_slope", **named, **{w.name: w.place for w in wrench}))
    return slope, axial


def forward_jacobian(lib: Library) -> Function:
    """Derivatives of V* of forward."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    phi_ddot, wrench = lib.phi_ddot_arguments(), lib.wrench_arguments()
    out = Argument("out", layout.forward_jacobian_result, (), "out", purpose="derivatives of V*")
    o, body = out.place, Body()
    check_inputs(lib, body, table, x, phi_ddot, wrench)
    seen = scene(lib, body, table.place, x.place)
    sum_up(lib, body, table.place, x.place, seen, phi_ddot[0].place if phi_ddot else None)
    F = body.local("F", (6,), comment="right-hand side of (8)")
    Z = body.local("Z", (6,), comment="momentum screw (2)")
    motion = body.local("V_result", (6,), comment="V_r*")
    rhs = body.local("rhs", (6,))
    y = body.local("y", (6,))
    external_wrench(lib, body, table.place, x.place, seen, wrench, F)
    body.call(lib["momentum_screw"], table.place, seen.sums, seen.V, Z)
    body.call(lib["subtract_rates"], table.place, seen.sums, seen.V, F)
    K = body.local("K", (), layout.carrier_factor)
    lib.check(body, "factor_carrier", table.place, seen.sums, K)
    body.call(lib["solve_carrier"], table.place, K, F, motion)
    slope, _ = twist_slopes(lib, body, table.place, x.place, seen, wrench, Z)

    def solve() -> None:
        body.call(lib["solve_carrier"], table.place, K, rhs, y)

    with body.loop("j", 6) as j:
        with body.loop("i", 6) as i:
            body.set(rhs[i], slope[i * integer(6) + j])
        solve()
        with body.loop("i", 6) as i:
            body.set(o.V_dot_V[i][j], y[i])
    _drift(body, o.V_dot_V, seen.stream)
    if layout.flywheels:
        changes = body.local("change", (len(WEIGHTS),), comment="changes of the harmonic weights of a flywheel")
        with body.loop("s", layout.count) as s:
            row = table.place.flywheel[s]
            weights = row_weights(body, x.place, seen.turns, s, phi_ddot[0].place[s])
            for name, target, by in (
                ("phi", o.V_dot_phi, derived.by_phase()),
                ("phi_dot", o.V_dot_phi_dot, derived.by_speed()),
            ):
                with body.block():
                    change_of_row(lib, body, row, by, weights, changes, seen, motion, rhs)
                    own_change(lib, body, table.place, x.place, seen, wrench, s, rhs, name)
                    solve()
                    with body.loop("i", 6) as i:
                        body.set(target[i][s], y[i])
            assign(body, list(rhs), derived_rows.reaction(), weights | columns_of(row))
            solve()
            with body.loop("i", 6) as i:
                body.set(o.V_dot_phi_ddot[i][s], y[i])
    return body.checked_function(
        "forward_jacobian",
        "Derivatives of forward by V, phi, phi' and phi'', at fixed position and attitude.",
        (table, x, *phi_ddot, *wrench, out),
        equation="(8)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
        notes=("At a kink of a damping law with magnitudes, the derivative from one side is returned.",),
        public=True,
    )


def _drift(body: Body, target: Place, stream: Place | None) -> None:
    """- d(omega x C^T u)/d omega = <u>."""
    if stream is None:
        return
    body.note("V* = V_r* - (omega x C^T u, 0)")
    for i, j, k, sign in ((0, 1, 2, -1), (0, 2, 1, 1), (1, 2, 0, -1), (1, 0, 2, 1), (2, 0, 1, -1), (2, 1, 0, 1)):
        value = stream[k] if sign > 0 else -stream[k]
        body.add(target[i][3 + j], value)


def coupled_jacobian(lib: Library) -> Function:
    """Derivatives of V* and phi'' of coupled."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    tau = Argument("tau", Kind.REAL, (layout.count,), unit="N m", purpose="drive torques, mount on flywheel")
    locked = lib.locked_argument()
    wrench = lib.wrench_arguments()
    out = Argument("out", layout.coupled_jacobian_result, (), "out", purpose="derivatives of V* and phi''")
    o, body = out.place, Body()
    check_drive(lib, body, (table, x, tau, *wrench))
    motion = body.local("V_result", (6,), comment="V*, then V_r*")
    spins = body.local("phi_result", (layout.count,), comment="phi''")
    turns = turns_of(lib, body, x.place)
    seen = scene(lib, body, table.place, x.place, turns=turns)
    system = without_drives(lib, body, table.place, x.place, seen, wrench)
    solved = solve_free(lib, body, table.place, seen, (tau.place, locked.place), system, (motion, spins))
    Z = body.local("Z", (6,), comment="momentum screw (2)")
    body.call(lib["momentum_screw"], table.place, seen.sums, seen.V, Z)
    slope, axial = twist_slopes(lib, body, table.place, x.place, seen, wrench, Z)
    work = _Work(lib, body, table.place, locked.place, solved.drives, solved.factor)
    _by_twist(lib, work, o, seen, slope, axial)
    _drift(body, o.V_dot_V, seen.stream)
    drive = CoupledMotion(table.place, x.place, wrench, seen, motion, spins, solved.alike.origin_acceleration)
    by_flywheels(lib, body, drive, o, work)
    return body.checked_function(
        "coupled_jacobian",
        "Derivatives of coupled by V, phi, phi' and tau, at fixed position and attitude.",
        (table, x, tau, locked, *wrench, out),
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
        notes=("At a kink of a damping law with magnitudes, the derivative from one side is returned.",),
        public=True,
    )


class _Work(Sides):
    """The whole carrier: rhs (6)."""

    def __init__(self, lib: Library, body: Body, table: Place, locked: Place, drives: Place, factor: Place) -> None:
        self._lib, self.body, self.table, self._locked, self.count = lib, body, table, locked, lib.layout.count
        self.drives, self._factor = drives, factor
        self.rhs = body.local("rhs", (6,), comment="right-hand side of the carrier")
        self.drive_rhs = body.local("drive_rhs", (lib.layout.count,), comment="right-hand sides of the drives")
        self._y = body.local("y", (6,))
        self.change = self.rhs
        self.clear_carrier()

    def clear_carrier(self) -> None:
        """Set the right-hand side of the carrier to zero."""
        for element in self.rhs:
            self.body.set(element, real(0))

    def take_change(self) -> None:
        """The change of the wrench is the right-hand side as it stands."""

    def reduce(self, t: Place, side: Expr) -> None:
        """Take the share of flywheel t from rhs, unless it is locked."""
        body = self.body
        with body.when(equal(self._locked[t], integer(0))):
            share = body.let("share", side * self.table.flywheel[t].spin_inv)
            with body.loop("i", 6) as i:
                body.add(self.rhs[i], -(self.drives[t].I[i] * share))

    def solve(self, o: Place, name: str, column: Place, side: Callable[[Place], Expr]) -> None:
        """V* and phi''."""
        body = self.body
        body.call(self._lib["solve_schur"], self._factor, self.rhs, self._y)
        with body.loop("i", 6) as i:
            body.set(o.member(f"V_dot_{name}")[i][column], self._y[i])
        with body.loop("t", self.count) as t:
            target = o.member(f"phi_ddot_{name}")[t][column]
            body.set(target, real(0))
            with body.when(equal(self._locked[t], integer(0))):
                left = side(t) - along(list(self.drives[t].I), self._y)
                body.set(target, left * self.table.flywheel[t].spin_inv)


def bias_slopes(lib: Library, body: Body, table: Place, seen: Scene, drives: Place) -> Place:
    """Derivatives of the bias torques of all flywheels by V (N x 6), from their columns of I in `drives`."""
    layout = lib.layout
    slopes_by_V = body.local("drive_slope", (layout.count, 6), comment="derivatives of the bias torques by V")
    slopes = body.local("J_p", (6,), comment="dJ / dphi")
    turned = body.local("turned", (3,), comment="J' omega")
    with body.loop("s", layout.count) as s:
        binding: dict[str, Any] = let_turn(body, seen.turns, s)
        for name in ("two_c2", "two_s2"):
            binding[name] = body.let(name, translate(derived_rows.weights()[name], binding))
        _, J_p = derived_drive.phase_derivatives()
        assign(body, list(slopes), J_p, binding | columns_of(table.flywheel[s]))
        bound = parts_of_twist(seen.V) | {"J_p": slopes, "turned": turned, "mu_p": list(drives[s].I)[:3]}
        assign(body, list(turned), derived_drive.turned_spin(), bound)
        by = derived.bias_torque_by_twist()
        for k in range(6):
            body.set(slopes_by_V[s][k], translate(by[k], bound))
    return slopes_by_V


def _by_twist(lib: Library, work: _Work, o: Place, seen: Scene, slope: Place, axial: Place) -> None:
    """Derivatives by V."""
    layout, body = lib.layout, work.body
    slopes_by_V = bias_slopes(lib, body, work.table, seen, work.drives)
    with body.loop("j", 6) as j:
        with body.loop("i", 6) as i:
            body.set(work.rhs[i], slope[i * integer(6) + j])
        with body.loop("s", layout.count) as s:
            change: Expr = -slopes_by_V[s][j]
            if layout.own_turning:
                change = axial[s * integer(6) + j] - slopes_by_V[s][j]
            body.set(work.drive_rhs[s], change)
        work.write(o, "V", j)
