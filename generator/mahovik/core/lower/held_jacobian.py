"""Jacobians of a held carrier: derivatives of u*, phi'' by u, phi, phi' and phi'' or tau, at fixed attitude.

S is constant in E1, so P du* = S^T (change of what is left of (8) at the motion V* = S u*), P = S^T K S, and V changes
by S du. With a stream V_r* = V* + (omega x C^T u_0, 0) changes with omega: K (d omega x C^T u_0, 0) is taken from it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from mahovik.core.derive.order import WEIGHTS
from mahovik.core.formula.derived import accumulate as derived_rows
from mahovik.core.formula.derived import sensitivity as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower import hold
from mahovik.core.lower.drive import check_drive
from mahovik.core.lower.flywheel_slopes import (
    CoupledMotion,
    Sides,
    by_flywheels,
    change_of_row,
    own_change,
    row_weights,
)
from mahovik.core.lower.flywheels import columns_of, common_terms, couple_flywheel, named_turns, turns_of
from mahovik.core.lower.forward import STATE_STATUSES, Scene, check_inputs, drift_of, scene, sum_up
from mahovik.core.lower.freedoms import columns, place_of
from mahovik.core.lower.jacobian import bias_slopes, twist_slopes
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, equal, integer, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind
from mahovik.core.program.vector import dot

NOTES = ("At a kink of a damping law with magnitudes, the derivative from one side is returned.",)


class _Freedoms:
    """P du* = y along the freedoms: P and its inverse, a right-hand side of six rows, and y.

    `projected` (N x m): S^T I, flywheel by flywheel, where flywheels are eliminated.
    """

    def __init__(self, lib: Library, body: Body, table: Place, seen: Scene) -> None:
        self._lib, self._body, self._table, self._seen = lib, body, table, seen
        m = self.count = lib.layout.freedoms
        self.P = body.local("P", (place_of(m, 0),), comment="mass matrix along the freedoms")
        self._inverse = body.local("inverse", (m, m), comment="its inverse")
        self.rhs = body.local("rhs", (6,), comment="change of what is left of (8)")
        self.y = body.local("y", (m,), comment="its part along the freedoms")
        self.change = body.local("change_of_u", (m,), comment="change of u*")
        body.call(lib["project_mass"], *lib.arguments_of("project_mass", table=table, sum=seen.sums, P=self.P))

    def invert(self) -> None:
        """P^-1, column by column; the caller returns where P is not positive definite."""
        body = self._body
        with body.loop("k", self.count) as k:
            with body.loop("i", self.count) as i:
                body.set(self.y[i], real(0))
            body.set(self.y[k], real(1))
            self._lib.check(body, "solve_freedoms", self.P, self.y)
            with body.loop("i", self.count) as i:
                body.set(self._inverse[i][k], self.y[i])

    def project(self) -> None:
        """Set y = S^T rhs."""
        named = {"table": self._table, "F": self.rhs, "y": self.y}
        self._body.call(self._lib["project_wrench"], *self._lib.arguments_of("project_wrench", **named))

    def solve(self) -> None:
        """du* = P^-1 y."""
        body = self._body
        with body.loop("i", self.count) as i:
            body.set(self.change[i], real(0))
            with body.loop("k", self.count) as k:
                body.add(self.change[i], self._inverse[i][k] * self.y[k])

    def column(self, j: Place) -> list[Place]:
        """Column j of S (6)."""
        return [self._table.S[i][j] for i in range(6)]

    def by_speed(self, slope: Place, j: Place) -> Place | None:
        """Set rhs to its derivative by u_j; returns the change of omega x C^T u_0 (3) of a stream."""
        body, column = self._body, self.column(j)
        with body.loop("i", 6) as i:
            body.set(self.rhs[i], _sum_of(slope[i * integer(6) + k] * column[k] for k in range(6)))
        if self._seen.stream is None:
            return None
        drift = body.local("drift_change", (3,), comment="change of omega x C^T u")
        turning = {"omega": column[3:], "O": self._seen.stream}
        assign(body, list(drift), derived_wrench.turning_velocity(), turning)
        named = {"table": self._table, "sum": self._seen.sums, "drift": drift, "F": self.rhs}
        body.call(self._lib["subtract_drift"], *self._lib.arguments_of("subtract_drift", **named))
        return drift


def _sum_of(terms: Iterable[Expr]) -> Expr:
    """Sum of the terms in their order."""
    first, *rest = terms
    total: Expr = first
    for term in rest:
        total = total + term
    return total


def _moving(body: Body, x: Place, seen: Scene, motion: Place) -> None:
    """V_r* in place of V*, where there is a stream."""
    if seen.stream is not None:
        drift = drift_of(body, x, seen.stream)
        for i in range(3):
            body.add(motion[i], drift[i])


def forward_jacobian(lib: Library) -> Function:
    """Derivatives of u* of forward."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    phi_ddot, wrench = lib.phi_ddot_arguments(), lib.wrench_arguments()
    out = Argument("out", layout.forward_jacobian_result, (), "out", purpose="derivatives of u*")
    o, body, given = out.place, Body(), [a.place for a in phi_ddot]
    check_inputs(lib, body, table, x, phi_ddot, wrench)
    motion = body.local("V_result", (6,), comment="V*, then V_r*")
    rates = [body.local(a.name, a.shape) for a in hold.results(lib)]
    turns = turns_of(lib, body, x.place)
    named = {"table": table.place, "x": x.place} | named_turns(turns) | {"u_dot": rates[0]}
    named |= {a.name: a.place for a in (*phi_ddot, *wrench)}
    lib.check(body, "accelerate", *lib.arguments_of("accelerate", **named))
    hold.write_twist.put_into(body, lib, table.place, rates, motion)
    seen = scene(lib, body, table.place, x.place, turns=turns)
    sum_up(lib, body, table.place, x.place, seen, given[0] if given else None)
    _moving(body, x.place, seen, motion)
    Z = body.local("Z", (6,), comment="momentum screw (2)")
    body.call(lib["momentum_screw"], table.place, seen.sums, seen.V, Z)
    slope, _ = twist_slopes(lib, body, table.place, x.place, seen, wrench, Z)
    freedoms = _Freedoms(lib, body, table.place, seen)
    freedoms.invert()

    def write(target: Place, column: Place) -> None:
        freedoms.project()
        freedoms.solve()
        with body.loop("i", freedoms.count) as i:
            body.set(target[i][column], freedoms.change[i])

    with body.loop("j", freedoms.count) as j:
        freedoms.by_speed(slope, j)
        write(o.u_dot_u, j)
    if layout.flywheels:
        changes = body.local("change", (len(WEIGHTS),), comment="changes of the harmonic weights of a flywheel")
        with body.loop("s", layout.count) as s:
            row = table.place.flywheel[s]
            weights = row_weights(body, x.place, seen.turns, s, given[0][s])
            for name, target, by in (
                ("phi", o.u_dot_phi, derived.by_phase()),
                ("phi_dot", o.u_dot_phi_dot, derived.by_speed()),
            ):
                with body.block():
                    change_of_row(lib, body, row, by, weights, changes, seen, motion, freedoms.rhs)
                    own_change(lib, body, table.place, x.place, seen, wrench, s, freedoms.rhs, name)
                    write(target, s)
            assign(body, list(freedoms.rhs), derived_rows.reaction(), weights | columns_of(row))
            write(o.u_dot_phi_ddot, s)
    return body.checked_function(
        "forward_jacobian",
        "Derivatives of forward by u, phi, phi' and phi'', at fixed position and attitude.",
        (table, x, *phi_ddot, *wrench, out),
        equation="(8)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
        notes=NOTES,
        public=True,
    )


class _Drives(Sides):
    """The carrier along its freedoms: y (m)."""

    def __init__(self, lib: Library, body: Body, table: Place, freedoms: _Freedoms, locked: Place) -> None:
        count = self.count = lib.layout.count
        self.body, self._freedoms, self.change = body, freedoms, freedoms.rhs
        self.columns = body.local("drive", (count,), lib.layout.coupling)
        self.drive_rhs = body.local("drive_rhs", (count,), comment="right-hand sides of the drives")
        self._projected = body.local("projected", (count, freedoms.count), comment="S^T I, flywheel by flywheel")
        self._inverse = body.local("spin_inverse", (count,), comment="1 / Theta_ff; 0 where a lock holds")
        with body.loop("s", count) as s:
            spin = table.flywheel[s].spin_inv
            body.set(self._inverse[s], select(equal(locked[s], integer(0)), spin, real(0)))

    def eliminate(self, s: Place, S: list[list[Expr | int]]) -> None:
        """Take flywheel s from P, by its column of I."""
        body, freedoms, projected = self.body, self._freedoms, self._projected[s]
        for k in range(freedoms.count):
            body.set(projected[k], dot(S[k], list(self.columns[s].I)))
        for i in range(freedoms.count):
            scaled = body.let(f"scaled{i + 1}", projected[i] * self._inverse[s])
            for j in range(i + 1):
                body.add(freedoms.P[place_of(i, j)], -(scaled * projected[j]))

    def take_change(self) -> None:
        """Make the change of the wrench the right-hand side along the freedoms."""
        self._freedoms.project()

    def clear_carrier(self) -> None:
        """Set the right-hand side along the freedoms to zero."""
        with self.body.loop("k", self._freedoms.count) as k:
            self.body.set(self._freedoms.y[k], real(0))

    def reduce(self, t: Place, side: Expr) -> None:
        """Take the share of flywheel t from y."""
        share = self.body.let("share", side * self._inverse[t])
        with self.body.loop("k", self._freedoms.count) as k:
            self.body.add(self._freedoms.y[k], -(self._projected[t][k] * share))

    def solve(self, o: Place, name: str, column: Place, side: Callable[[Place], Expr]) -> None:
        """du* and the change of phi''."""
        body, freedoms, m = self.body, self._freedoms, self._freedoms.count
        freedoms.solve()
        with body.loop("i", m) as i:
            body.set(o.member(f"u_dot_{name}")[i][column], freedoms.change[i])
        with body.loop("t", self.count) as t:
            back = _sum_of(self._projected[t][k] * freedoms.change[k] for k in range(m))
            body.set(o.member(f"phi_ddot_{name}")[t][column], (side(t) - back) * self._inverse[t])


def coupled_jacobian(lib: Library) -> Function:
    """Derivatives of u* and phi'' of coupled."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    tau = Argument("tau", Kind.REAL, (layout.count,), unit="N m", purpose="drive torques, mount on flywheel")
    locked, wrench = lib.locked_argument(), lib.wrench_arguments()
    out = Argument("out", layout.coupled_jacobian_result, (), "out", purpose="derivatives of u* and phi''")
    o, body = out.place, Body()
    check_drive(lib, body, (table, x, tau, *wrench))
    motion = body.local("V_result", (6,), comment="V*, then V_r*")
    spins = body.local("phi_result", (layout.count,), comment="phi''")
    rates = [body.local(a.name, a.shape) for a in hold.results(lib)]
    turns = turns_of(lib, body, x.place)
    named = {"table": table.place, "x": x.place, "V_dot": motion, "phi_ddot": spins, "u_dot": rates[0]}
    named |= named_turns(turns) | {a.name: a.place for a in (tau, locked, *wrench)}
    lib.check(body, "solve_coupled", *lib.arguments_of("solve_coupled", **named))
    seen = scene(lib, body, table.place, x.place, turns=turns)
    sum_up(lib, body, table.place, x.place, seen, None)
    _moving(body, x.place, seen, motion)
    Z = body.local("Z", (6,), comment="momentum screw (2)")
    body.call(lib["momentum_screw"], table.place, seen.sums, seen.V, Z)
    slope, axial = twist_slopes(lib, body, table.place, x.place, seen, wrench, Z)
    freedoms = _Freedoms(lib, body, table.place, seen)
    drives = _Drives(lib, body, table.place, freedoms, locked.place)
    alike = common_terms.put_into(body, lib, seen.V, seen.g)
    S = [list(column) for column in columns(layout.ways, table.place)]
    with body.loop("s", layout.count) as s:
        couple_flywheel.put_into(body, lib, table.place, s, seen, alike, drives.columns[s])
        drives.eliminate(s, S)
    freedoms.invert()
    by_twist = bias_slopes(lib, body, table.place, seen, drives.columns)
    with body.loop("j", freedoms.count) as j:
        drift = freedoms.by_speed(slope, j)
        freedoms.project()
        column = freedoms.column(j)
        with body.loop("s", layout.count) as s:
            change: Expr = -_sum_of(by_twist[s][k] * column[k] for k in range(6))
            if layout.own_turning:
                change = _sum_of((axial[s * integer(6) + k] - by_twist[s][k]) * column[k] for k in range(6))
            if drift is not None:
                change = change - _sum_of(drives.columns[s].I[k] * drift[k] for k in range(3))
            body.set(drives.drive_rhs[s], change)
        drives.write(o, "u", j)
    at = CoupledMotion(table.place, x.place, wrench, seen, motion, spins, alike.origin_acceleration)
    by_flywheels(lib, body, at, o, drives)
    return body.checked_function(
        "coupled_jacobian",
        "Derivatives of coupled by u, phi, phi' and tau, at fixed position and attitude.",
        (table, x, tau, locked, *wrench, out),
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
        notes=NOTES,
        public=True,
    )
