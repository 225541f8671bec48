"""Held carrier: (8) projected to its m freedoms, V_dot = S u_dot, and the reaction of the hold, by an m x m solve.

S^T K S u_dot = S^T b and R = K V_r_dot - b; with a stream, K d is taken from b first, then V_dot stands for V_r_dot.

Freedoms whose brackets are freedoms need no six rows. S is constant in E1, so S^T K S and S^T I_s have the harmonics of
K and I_s, projected once by `prepare`:
  P(phi) u_dot = S^T F - P* u - d/dt (S^T I_s phi_dot) - S^T Phi(V) Z,  V = S u,
the last term by the m momenta S^T Z = P u + S^T sum I_s phi_dot. It is zero for one freedom.
"""

from __future__ import annotations

from collections.abc import Sequence
from operator import mul
from typing import Any

from mahovik.core.lower.freedoms import (
    columns,
    element,
    harmonics,
    momenta_needed,
    place_of,
    rows_of,
    slides,
    speeds,
    turning_force,
)
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import mass_times
from mahovik.core.program.expression import Expr, Not, Status
from mahovik.core.program.kernel import (
    NOT_POSITIVE_DEFINITE,
    OK,
    Reals,
    argument,
    body,
    changed,
    inline,
    kernel,
    let,
    reals,
    record,
    refuse,
    result,
)
from mahovik.core.program.vector import Matrix, Vector, cross, dot, symmetric

OF_COORDINATES = frozenset(("generalized", "state_from_coordinates"))
"""Names of functions that the C of a held carrier has where its poses have coordinates of the freedoms."""

OF_FREEDOMS = frozenset(("inverse", "inverse_fast", "forward_jacobian", "coupled_jacobian"))
"""Names of functions that the C of a clamped carrier does not have: they are along the freedoms."""


def add_hold(lib: Library) -> None:
    """Adds the functions of a held carrier; clamped, its V_dot is zero."""
    layout, m, ways = lib.layout, lib.layout.freedoms, lib.layout.ways
    size = place_of(m, 0)  # numbers of a symmetric matrix of the freedoms
    least = layout.precision.smallest

    if m:
        lib.add(project_mass(lib))

        @lib.kernel()
        def project_wrench(
            table: Any = lib.table, F: Reals = argument("", 6, unit="N, N m"), y: Reals = result("", m, unit="SI")
        ) -> None:
            """S^T F: a wrench along the freedoms."""
            y[:] = [dot(column, F) for column in columns(ways, table)]

        @lib.kernel(statuses=("OK", "NOT_POSITIVE_DEFINITE"))
        def solve_freedoms(
            P: Reals = argument("lower triangle, row by row", size, unit="SI"), y: Reals = changed("", m, unit="SI")
        ) -> Status:
            """Solves P x = y, P symmetric and positive definite, by L D L^T; x is written to y."""
            y[:] = solved_by_ldl(P, y, least)
            return OK

        @lib.kernel(short=True)
        def twist_of_freedoms(
            table: Any = lib.table, u: Reals = argument("", m, unit="SI"), V: Reals = result("", 6)
        ) -> None:
            """V = S u."""
            V[:] = Matrix(columns(ways, table)).T @ u

    if layout.along:
        lib.add(sum_along(lib, steady=False))
        lib.add(sum_along(lib, steady=True))
        add_right_side(lib)

    if layout.drifts:

        @lib.kernel()
        def subtract_drift(
            table: Any = lib.table,
            sum_: Any = lib.sums,
            drift: Reals = argument("omega x C^T stream", 3, unit="m/s2"),
            F: Reals = changed("", 6, unit="N, N m"),
        ) -> None:
            """F less K (omega x C^T stream, 0)."""
            F -= mass_times(lib, table, sum_, Vector([*drift, 0, 0, 0]))

    @lib.kernel()
    def react(
        table: Any = lib.table,
        sum_: Any = lib.sums,
        V_dot: Reals = argument("", 6, unit="m/s2, rad/s2"),
        F: Reals = argument("right-hand side of (8), of all that turns as well", 6, unit="N, N m"),
        reaction: Reals = result("must not overlap F", 6, unit="N, N m"),
    ) -> None:
        """Wrench of the hold on the carrier: K V_dot - F."""
        moved: Reals = mass_times(lib, table, sum_, V_dot)  # K V_dot
        reaction[:] = moved - F

    @lib.kernel()
    def keep_pivot(
        table: Any = lib.table, x: Any = lib.x, y: Any = changed("state after the step", struct=layout.state)
    ) -> None:
        """Puts the pivot of the hold back to where it can slide."""
        C, place, reached = pivot_arms(lib, table, x, y)
        way = reals(3)  # how the pivot went, in E0
        place += x.position
        way[:] = y.position + reached - place
        slid = allowed_way(lib, table, C, way)
        y.position[:] = place + slid - reached


def project_mass(lib: Library) -> Any:
    """S^T K S."""
    m, ways = lib.layout.freedoms, lib.layout.ways
    size = place_of(m, 0)

    @kernel()
    def project_mass(
        table: Any = lib.table,
        sum_: Any = lib.sums,
        P: Reals = result("lower triangle, row by row", size, unit="SI"),
    ) -> None:
        """S^T K S: the mass matrix along the freedoms."""
        moved = reals(6)  # K times a column of S
        for j in list(range(m)):
            moved[:] = mass_times(lib, table, sum_, table.S[:, j])
            project(P, moved, columns(ways, table), j)

    return project_mass


def project(P: Any, moved: Any, S: Sequence[Vector], j: int) -> None:
    """Column j of S^T K S, by K times column j of S."""
    for i in range(j, len(S)):
        body().set(P[place_of(i, j)], dot(S[i], moved))


def solved_by_ldl(P: Any, y: Any, least: float) -> list[Expr]:
    """x of P x = y by L D L^T; the function returns where P is not positive definite."""
    m = len(y)
    left: dict[tuple[int, int], Any] = {(i, j): P[place_of(i, j)] for i in range(m) for j in range(i + 1)}
    z: list[Any] = list(y)
    for j in range(m):
        refuse(Not(left[j, j] >= least), NOT_POSITIVE_DEFINITE)
        if j + 1 < m:
            body().note(f"column {j + 1} of L, and what is left of the others")
        for i in range(j + 1, m):
            share: Any = let(f"l{i + 1}{j + 1}", left[i, j] / left[j, j])
            for k in range(j + 1, i + 1):
                left[i, k] = let(f"p{i + 1}{k + 1}_{j + 1}", left[i, k] - share * left[k, j])
            z[i] = let(f"z{i + 1}_{j + 1}", z[i] - share * z[j])
    for j in reversed(range(m)):
        for i in range(j + 1, m):
            z[j] = z[j] - left[i, j] * z[i]
        z[j] = let(f"x{j + 1}", z[j] / left[j, j])
    return z


@inline
def pivot_arms(lib: Library, table: Any, x: Any, after: Any) -> Any:
    """Attitude C before a step, and the arms from O1 to the pivot before and after it, in E0."""
    C = reals(9)  # attitude before the step
    end = reals(9)  # attitude after the step
    arm = reals(3)  # from O1 to the pivot before the step, in E0
    reached = reals(3)  # likewise after the step
    lib["rotation"](x.attitude, C)
    lib["rotation"](after.attitude, end)
    arm[:] = C @ table.pivot
    reached[:] = end @ table.pivot
    return C, arm, reached


@inline
def allowed_way(lib: Library, table: Any, C: Reals, way: Reals) -> Any:
    """The part along what slides of a way of the pivot, both in E0."""
    way_E1 = reals(3)  # in E1
    lib["rotate_back"](C, way, way_E1)
    allowed = reals(3)  # of what slides, in E1
    slid = reals(3)  # the part along what slides, in E0
    allowed[:] = table.sliding @ way_E1
    slid[:] = C @ allowed
    return slid


@inline
def write_twist(lib: Library, table: Any, u_dot: Sequence[Any], V_dot: Reals) -> None:
    """V_dot = S u_dot of the rates of the freedoms, zero without any."""
    if u_dot:
        lib["twist_of_freedoms"](table, u_dot[0], V_dot)
    else:
        V_dot[:] = [0] * 6


# -- along the freedoms ----------------------------------------------------------------------------------------------


def sum_along(lib: Library, steady: bool) -> Any:
    """Sums over all bodies, projected to the freedoms; `steady`: at constant speeds."""
    layout, N = lib.layout, lib.layout.count
    momenta = momenta_needed(layout.ways)
    moment = layout.weight and max(rows_of(layout.ways)) >= 3  # of the weight
    # of three freedoms compilers do not keep all sums in registers over one loop
    parts = ("P", "g") if layout.freedoms > 2 else ("Pg",)
    purpose = "Mass matrix of all bodies along the freedoms, and the flywheels' terms; w = phi_dot"
    purpose += " is constant." if steady else ", a = phi_ddot."

    @kernel("sum_steady_along" if steady else "sum_along", equation="(2), (5), (6)", purpose=purpose)
    def sum_along(
        table: Any = lib.table,
        sine: Reals = lib.sine,
        cosine: Reals = lib.cosine,
        phi_dot: Reals = argument("", N, unit="rad/s"),
        phi_ddot: Any = None if steady else argument("", N, unit="rad/s2"),
        whole: Any = changed("its first moment mu is set", struct=layout.sums),
        sum_: Any = result(struct=layout.along_sums),
    ) -> None:
        """Mass matrix of all bodies along the freedoms, and the flywheels' terms."""
        if moment:
            whole.mu[:] = table.first_moment
        sum_.P[:] = table.P_0
        for name in ("P_dot", "g", *(("h",) if momenta else ())):
            sum_.member(name)[:] = [0] * len(sum_.member(name))
        for part in parts:
            for k in range(N):
                row = table.flywheel[k]
                s = sine[k]
                c = cosine[k]
                w = phi_dot[k]
                a = None if steady else phi_ddot[k]
                if "P" in part:
                    twice_s = 2 * s
                    c2 = 1 - twice_s * s  # cos 2 phi, then sin 2 phi
                    s2 = twice_s * c
                    twice_w = 2 * w
                    c2_dot, s2_dot, c_dot, s_dot = -twice_w * s2, twice_w * c2, -w * s, w * c
                    # mass matrix along the freedoms and its rate
                    factors = {"2c": (c2, c2_dot), "2s": (s2, s2_dot), "c": (c, c_dot), "s": (s, s_dot)}
                    for i, names in enumerate(harmonics(layout.ways)):
                        if names:
                            of_row = [row.member(f"P_{name}")[i] for name in names]
                            sum_.P[i] += dot(of_row, [factors[name][0] for name in names])
                            sum_.P_dot[i] += dot(of_row, [factors[name][1] for name in names])
                if "g" in part:
                    if moment:
                        # first moment
                        whole.mu += row.mu_c * c + row.mu_s * s
                    I_0 = Vector([0 if slides(way) else row.I_0[i] for i, way in enumerate(layout.ways)])
                    turning: Reals = row.I_c * c + row.I_s * s + I_0  # I along the freedoms
                    body().note(("I phi_dot and its rate" if momenta else "rate of I phi_dot") + " along the freedoms")
                    if momenta:
                        sum_.h += w * turning
                    ww = w * w
                    sum_.g += (0 if a is None else a) * turning + ww * (row.I_s * c - row.I_c * s)

    return sum_along


def add_right_side(lib: Library) -> None:
    """Adds the right-hand side along the freedoms, of the wrench (7)."""
    layout, m, ways = lib.layout, lib.layout.freedoms, lib.layout.ways

    @lib.kernel(equation="(2), (4), (5)")
    def right_side(
        table: Any = lib.table,
        sum_: Any = argument(struct=layout.along_sums),
        V: Reals = argument("twist of the carrier, S u", 6),
        F: Reals = argument("wrench (7)", 6, unit="N, N m"),
        y: Reals = result("", m, unit="SI"),
    ) -> None:
        """Right-hand side of (8) along the freedoms: S^T (F - Phi Z - K_dot V) - the flywheels' terms"""
        S = columns(ways, table)
        u = reals(m)  # speeds of the freedoms
        u[:] = speeds(ways, S, V)
        rows = [[element(matrix, k, j) for j in range(m)] for matrix in (sum_.P, sum_.P_dot) for k in range(m)]
        momenta = {
            way: let(f"momentum_{way}", dot((1, *rows[ways.index(way)]), (sum_.h[ways.index(way)], *u)))
            for way in momenta_needed(ways)
        }
        forces = turning_force(ways, u, momenta)
        for k in list(range(m)):
            y[k] = plus(dot((*S[k], -1, *[-1] * m), (*F, sum_.g[k], *map(mul, rows[m + k], u))), forces[k])


def plus(rest: Any, force: Any) -> Any:
    """The sum of two sums; the second may be 0."""
    return rest + force if isinstance(force, Expr) else rest


def project_harmonic(lib: Library) -> Any:
    """S^T K S of one harmonic."""
    size = place_of(lib.layout.freedoms, 0)

    @kernel()
    def project_harmonic(
        table: Any = lib.table,
        mu: Reals = argument("", 3, unit="kg m"),
        J: Reals = argument("", 6, unit="kg m2"),
        P: Reals = result("lower triangle, row by row", size, unit="SI"),
    ) -> None:
        """S^T K S of one harmonic of a flywheel."""
        moved = reals(6)  # the harmonic times a column of S
        S = columns(lib.layout.ways, table)
        for j in list(range(len(S))):
            v, omega = table.S[0:3, j], table.S[3:6, j]
            moved[:] = [*-cross(mu, omega), *(symmetric(J) @ omega + cross(mu, v))]
            project(P, moved, S, j)

    return project_harmonic


@inline
def prepare_row(lib: Library, table: Any, row: Any) -> None:
    """The columns of a row along the freedoms, of its others: the force part of I_s is mu' = mu_s c - mu_c s."""
    # along the freedoms: S^T K S and S^T I
    none = reals(3)  # no first moment has harmonics of the double phase
    none[:] = [0, 0, 0]
    for name, mu in (("c", row.mu_c), ("s", row.mu_s), ("2c", none), ("2s", none)):
        lib["project_harmonic"](table, mu, row.member(f"J_{name}"), row.member(f"P_{name}"))
    for name, force in (("0", none), ("c", row.mu_s), ("s", -row.mu_c)):
        wrench = [*force, *row.member(f"t_{name}")]
        row.member(f"I_{name}")[:] = [dot(column, wrench) for column in columns(lib.layout.ways, table)]


@inline
def prepare_constant(lib: Library, table: Any) -> None:
    """S^T K S of what no phase changes, into P_0 of the table."""
    # mass matrix along the freedoms, constant part
    constant = record(lib.layout.sums)  # first moment and inertia alone
    constant.mu[:] = table.first_moment
    constant.J[:] = table.inertia
    lib["project_mass"](table, constant, table.P_0)
