"""Held carrier: (8) projected to its m freedoms, V* = S u*, and the reaction of the hold, by an m x m solve.

S^T K S u* = S^T b and R = K V_r* - b; with a stream, K d is taken from b first, and then V* stands in place of V_r*.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from mahovik.core.formula.derived import hold as derived
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower import along
from mahovik.core.lower.freedoms import columns, dot, place_of, twist
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import carrier_binding
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind

HELD_STATUSES = ("OK", "NOT_POSITIVE_DEFINITE")

OF_COORDINATES = frozenset(("generalized", "state_from_coordinates"))
"""Names of functions that the C of a held carrier has where its poses have coordinates of the freedoms."""

OF_FREEDOMS = frozenset(("inverse", "inverse_fast", "inverse_fast_at", "forward_jacobian", "coupled_jacobian"))
"""Names of functions that the C of a clamped carrier does not have: they are along the freedoms."""


def add_all(lib: Library) -> None:
    """Adds the functions of a held carrier; clamped, its V* is zero."""
    if lib.layout.freedoms:
        lib.add(project_mass(lib))
        lib.add(project_wrench(lib))
        lib.add(solve_freedoms(lib))
        lib.add(twist_of_freedoms(lib))
    if lib.layout.along:
        along.add_all(lib)
    if lib.layout.stream:
        lib.add(subtract_drift(lib))
    lib.add(react(lib))
    lib.add(keep_pivot(lib))


def results(lib: Library) -> tuple[Argument, ...]:
    """u_dot, which `forward` and `coupled` of a held carrier with freedoms give besides."""
    if not lib.layout.freedoms:
        return ()
    return (Argument("u_dot", Kind.REAL, (lib.layout.freedoms,), "out", "SI", "rates of the freedoms"),)


def project_mass(lib: Library) -> Function:
    """S^T K S."""
    table, sums = lib.table_argument(), Argument("sum", lib.layout.sums)
    P = Argument("P", Kind.REAL, (place_of(lib.layout.freedoms, 0),), "out", "SI", "lower triangle, row by row")
    body = Body()
    binding = carrier_binding(lib, table.place, sums.place)
    moved = body.local("moved", (6,), comment="K times a column of S")
    found = columns(lib.layout.ways, table.place)
    for j in range(lib.layout.freedoms):
        six = [table.place.S[i][j] for i in range(6)]
        assign(body, list(moved), derived.mass_times(lib.layout.added_mass), binding | {"twist": six})
        for i in range(j, lib.layout.freedoms):
            body.set(P.place[place_of(i, j)], dot(found[i], list(moved)))
    return body.function("project_mass", "S^T K S: the mass matrix along the freedoms.", (table, sums, P))


def project_wrench(lib: Library) -> Function:
    """S^T of a wrench."""
    table, F = lib.table_argument(), Argument("F", Kind.REAL, (6,), unit="N, N m")
    y = Argument("y", Kind.REAL, (lib.layout.freedoms,), "out", "SI")
    body = Body()
    for k, column in enumerate(columns(lib.layout.ways, table.place)):
        body.set(y.place[k], dot(column, list(F.place)))
    return body.function("project_wrench", "S^T F: a wrench along the freedoms.", (table, F, y))


def solve_freedoms(lib: Library) -> Function:
    """P u* = y by L D L^T."""
    m = lib.layout.freedoms
    P = Argument("P", Kind.REAL, (place_of(m, 0),), unit="SI", purpose="lower triangle, row by row")
    y = Argument("y", Kind.REAL, (m,), "inout", "SI")
    least, x = real(lib.layout.precision.smallest), y.place
    body = Body()
    left: dict[tuple[int, int], Expr] = {(i, j): P.place[place_of(i, j)] for i in range(m) for j in range(i + 1)}
    z: list[Expr] = [x[i] for i in range(m)]
    for j in range(m):
        lib.guard(body, Not(left[j, j] >= least), "NOT_POSITIVE_DEFINITE")
        if j + 1 < m:
            body.note(f"column {j + 1} of L, and what is left of the others")
        for i in range(j + 1, m):
            share = body.let(f"l{i + 1}{j + 1}", left[i, j] / left[j, j])
            for k in range(j + 1, i + 1):
                left[i, k] = body.let(f"p{i + 1}{k + 1}_{j + 1}", left[i, k] - share * left[k, j])
            z[i] = body.let(f"z{i + 1}_{j + 1}", z[i] - share * z[j])
    for j in reversed(range(m)):
        rest: Expr = z[j]
        for i in range(j + 1, m):
            rest = rest - left[i, j] * z[i]
        z[j] = body.let(f"x{j + 1}", rest / left[j, j])
    for element, value in zip(x, z, strict=True):
        body.set(element, value)
    return body.checked_function(
        "solve_freedoms",
        "Solves P x = y, P symmetric and positive definite, by L D L^T; x is written to y.",
        (P, y),
        statuses=HELD_STATUSES,
    )


def twist_of_freedoms(lib: Library) -> Function:
    """V = S u."""
    table = lib.table_argument()
    u = Argument("u", Kind.REAL, (lib.layout.freedoms,), unit="SI")
    V = Argument("V", Kind.REAL, (6,), "out")
    body = Body()
    for element, total in zip(V.place, twist(columns(lib.layout.ways, table.place), u.place), strict=True):
        body.set(element, total)
    return replace(body.function("twist_of_freedoms", "V = S u.", (table, u, V)), short=True)


def subtract_drift(lib: Library) -> Function:
    """b - K d."""
    table, sums = lib.table_argument(), Argument("sum", lib.layout.sums)
    drift = Argument("drift", Kind.REAL, (3,), unit="m/s2", purpose="omega x C^T u")
    F = Argument("F", Kind.REAL, (6,), "inout", "N, N m")
    body = Body()
    binding = carrier_binding(lib, table.place, sums.place) | {"drift": drift.place}
    for target, value in zip(F.place, derived.mass_times_drift(lib.layout.added_mass), strict=True):
        body.add(target, -translate(value, binding))
    return body.function("subtract_drift", "F less K (omega x C^T u, 0).", (table, sums, drift, F))


def react(lib: Library) -> Function:
    """R = K V* - F."""
    table, sums = lib.table_argument(), Argument("sum", lib.layout.sums)
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2")
    F = Argument("F", Kind.REAL, (6,), unit="N, N m", purpose="right-hand side of (8), of all that turns as well")
    R = Argument("reaction", Kind.REAL, (6,), "out", "N, N m", "must not overlap F")
    body = Body()
    binding = carrier_binding(lib, table.place, sums.place) | {"twist": list(V_dot.place)}
    moved = body.local("moved", (6,), comment="K V*")
    assign(body, list(moved), derived.mass_times(lib.layout.added_mass), binding)
    for k in range(6):
        body.set(R.place[k], moved[k] - F.place[k])
    return body.function("react", "Wrench of the hold on the carrier: K V* - F.", (table, sums, V_dot, F, R))


def pivot_arms(lib: Library, body: Body, table: Place, x: Place, after: Place) -> tuple[Place, Place, Place]:
    """Attitude C before a step, and the arms from O1 to the pivot before and after it, in E0."""
    rotated = derived_wrench.rotated()
    C = body.local("C", (9,), comment="attitude before the step")
    end = body.local("end", (9,), comment="attitude after the step")
    arm = body.local("arm", (3,), comment="from O1 to the pivot before the step, in E0")
    reached = body.local("reached", (3,), comment="likewise after the step")
    body.call(lib["rotation"], x.attitude, C)
    body.call(lib["rotation"], after.attitude, end)
    assign(body, list(arm), rotated, {"C": C, "a": table.pivot})
    assign(body, list(reached), rotated, {"C": end, "a": table.pivot})
    return C, arm, reached


def allowed_way(lib: Library, body: Body, table: Place, C: Place, way: Place) -> Place:
    """The part along what slides of a way of the pivot, both in E0."""
    rotated = derived_wrench.rotated()
    own = body.local("own", (3,), comment="in E1")
    body.call(lib["rotate_back"], C, way, own)
    allowed = body.local("allowed", (3,), comment="of what slides, in E1")
    slid = body.local("slid", (3,), comment="the part along what slides, in E0")
    assign(body, list(allowed), rotated, {"C": table.sliding, "a": own})
    assign(body, list(slid), rotated, {"C": C, "a": allowed})
    return slid


def keep_pivot(lib: Library) -> Function:
    """Takes from a step what moved the pivot where the hold does not let it go."""
    table, x = lib.table_argument(), lib.state_argument()
    after = Argument("y", lib.layout.state, (), "inout", purpose="state after the step")
    body = Body()
    C, place, reached = pivot_arms(lib, body, table.place, x.place, after.place)
    way = body.local("way", (3,), comment="how the pivot went, in E0")
    for i in range(3):
        body.add(place[i], x.place.position[i])
        body.set(way[i], after.place.position[i] + reached[i] - place[i])
    slid = allowed_way(lib, body, table.place, C, way)
    for i in range(3):
        body.set(after.place.position[i], place[i] + slid[i] - reached[i])
    return body.function("keep_pivot", "Puts the pivot of the hold back to where it can slide.", (table, x, after))


def write_twist(lib: Library, body: Body, table: Place, u_dot: Sequence[Place], V_dot: Place) -> None:
    """V* = S u* of the rates of the freedoms, zero without any."""
    if u_dot:
        named = {"table": table, "u": u_dot[0], "V": V_dot}
        body.call(lib["twist_of_freedoms"], *lib.arguments_of("twist_of_freedoms", **named))
        return
    for element in V_dot:
        body.set(element, real(0))


class Freedoms:
    """The equations along the freedoms while they are set up: P = S^T K S, y = S^T b, less what flywheels take."""

    def __init__(self, lib: Library, body: Body, table: Place, P: Place | None = None, y: Place | None = None) -> None:
        self._lib, self._body, self._table = lib, body, table
        self.count = lib.layout.freedoms
        self._columns = columns(lib.layout.ways, table)
        if self.count:
            shape = (place_of(self.count, 0),)
            self.P = body.local("P", shape, comment="mass matrix along the freedoms") if P is None else P
            self.y = body.local("y", (self.count,), comment="wrench along the freedoms; then u*") if y is None else y

    def eliminate(self, coupling: Sequence[Expr], rate: Expr, inverse: Expr, projected: Place | None) -> None:
        """Takes one free flywheel away by its column of I; `projected` (m) gets S^T I."""
        if projected is None:
            return
        for k in range(self.count):
            self._body.set(projected[k], dot(self._columns[k], coupling))
        for i in range(self.count):
            self._body.add(self.y[i], -(projected[i] * rate))
            scaled = self._body.let(f"scaled{i + 1}", projected[i] * inverse)
            for j in range(i + 1):
                self._body.add(self.P[place_of(i, j)], -(scaled * projected[j]))

    def back(self, projected: Place | None) -> Expr:
        """I_s . V* of a flywheel by S^T I_s."""
        if projected is None:
            return real(0)
        total: Expr = projected[0] * self.y[0]
        for k in range(1, self.count):
            total = total + projected[k] * self.y[k]
        return total

    def solve(self) -> None:
        """u* into y; the caller returns where the mass along the freedoms is not positive."""
        if self.count:
            self._lib.check(self._body, "solve_freedoms", self.P, self.y)

    def write(self, V_dot: Place, rates: Sequence[Place]) -> None:
        """V* and u*."""
        if self.count:
            self._body.copy_array(rates[0], self.y)
        write_twist(self._lib, self._body, self._table, rates, V_dot)


def room_for_projected(lib: Library, body: Body) -> Place | None:
    """S^T I of all flywheels, m numbers each; none of a clamped carrier."""
    if not lib.layout.freedoms:
        return None
    return body.local("projected", (lib.layout.count, lib.layout.freedoms), comment="S^T I, flywheel by flywheel")


def of_flywheel(projected: Place | None, s: Expr) -> Place | None:
    """S^T I of one flywheel."""
    return None if projected is None else projected[s]
