"""What (12) asks of the flywheels at a state, scaled: shared by inverse and inverse_fast.

K = G G^T, W = G^-1 I D^-1, r = G^-1 b, b = F - K V_dot - M V - J phi_dot, D^2 = Theta_ff. The singular values of W are
those of K^-1/2 I Theta_ff^-1/2: dimensionless, the same for any units, origin and axes. Of a held carrier these are its
rows along the freedoms: S^T K S, S^T I and S^T b.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from mahovik.core.lower.flywheels import column_of
from mahovik.core.lower.forward import (
    STATE_STATUSES,
    check_inputs,
    external_wrench,
    relative_rate,
    scene,
    sum_up,
)
from mahovik.core.lower.freedoms import columns, place_of
from mahovik.core.lower.library import Library
from mahovik.core.lower.matrices import mass_matrix
from mahovik.core.program.expression import Status
from mahovik.core.program.kernel import (
    BAD_ARGUMENT,
    NOT_POSITIVE_DEFINITE,
    OK,
    RANGE,
    Reals,
    argument,
    body,
    check_as,
    inline,
    reals,
)
from mahovik.core.program.vector import dot

ANSWER_NOTE = "RANGE also where the answer is no finite number."


def add_factor(lib: Library, rows: int = 6) -> None:
    """Cholesky factor of K, or of S^T K S."""
    sqrt = lib["sqrt"]

    @lib.kernel(statuses=("OK", "NOT_POSITIVE_DEFINITE"))
    def factor(
        work: Any = argument(
            "in: G holds K; out: lower triangle G, K = G G^T", struct=lib.layout.inverse_work, direction="inout"
        ),
    ) -> Status:
        """Cholesky factor of the mass matrix, in place: K = G G^T."""
        G = work.G
        for j in range(rows):
            pivot: float = G[j][j]
            for k in range(j):
                pivot -= G[j][k] * G[j][k]
            if not pivot > 0:
                return NOT_POSITIVE_DEFINITE
            root = sqrt(pivot)
            G[j][j] = root
            for i in range(j + 1, rows):
                rest: float = G[i][j]
                for k in range(j):
                    rest -= G[i][k] * G[j][k]
                G[i][j] = rest / root
        return OK


@inline
def right_side(lib: Any, table: Any, x: Any, turns: Any, wrench: Any, name: str, V_dot: Any = None) -> Any:
    """What is seen at a state; F of K V_r_dot + I phi_ddot = F, by `name` in its comment; V_r_dot of a wanted V_dot."""
    seen = scene(lib, table, x, turns=turns)
    moving = None if V_dot is None else relative_rate(x, V_dot, seen.stream)
    sum_up(lib, table, x, seen, None)
    F = body().local("F", (6,), comment=f"wrench (7); then {name}")
    external_wrench(lib, table, x, seen, wrench, F)
    lib["subtract_rates"](table, seen.sums, seen.V, F)
    return seen, F, moving


def less(first: Any, *products: Iterable[Any]) -> Any:
    """first - a[0] b[0] - a[1] b[1] - ..."""
    for a, b in zip(*products, strict=False):
        first = first - a * b
    return first


@inline
def substitute(lib: Any, work: Any, rows: int) -> None:
    """W = G^-1 W, r = G^-1 r by forward substitution."""
    G, r = work.G, work.r
    body().note("W = G^-1 I D^-1, r = G^-1 b: forward substitution" if lib.layout.flywheels else "r = G^-1 b")
    for i in range(rows):
        inverse = 1 / G[i][i]
        rest = reals()
        if lib.layout.flywheels:
            for s in range(lib.layout.count):
                rest = work.W[i][s]
                for k in range(i):
                    rest -= G[i][k] * work.W[k][s]
                work.W[i][s] = rest * inverse
        rest = r[i]
        for k in range(i):
            rest -= G[i][k] * r[k]
        r[i] = rest * inverse


def add_demand(lib: Library) -> None:
    """Everything of (12) at a state: K factored, I, b, W, r."""
    layout, held, rows = lib.layout, lib.layout.held, lib.layout.inverse_rows
    purpose = "Matrix and right-hand side of (12) at a state: I, b, and both scaled to W, r."
    if held:
        purpose = "Matrix and right-hand side of (12) along the freedoms: S^T I, S^T b, and both scaled to W, r."

    @lib.kernel(equation="(12)", purpose=purpose, statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"))
    def demand(
        table: Any = lib.table,
        x: Any = lib.x,
        sine: Any = lib.sine,
        cosine: Any = lib.cosine,
        V_dot: Reals = argument("wanted", 6, unit="m/s2, rad/s2"),
        wrench: Any = lib.wrench,
        work: Any = argument(struct=layout.inverse_work, direction="out"),
    ) -> Status:
        """Matrix and right-hand side of (12)."""
        name = "the right-hand side of K V_dot + I phi_ddot = F"
        seen, F, moving = right_side(lib, table, x, (sine, cosine) if layout.flywheels else (), wrench, name, V_dot)
        S = columns(layout.ways, table) if held else ()
        if held:
            missing = reals(6)  # K V_dot - F: what flywheels and hold must give
            lib["react"](table, seen.sums, moving, F, missing)
            P = reals(place_of(rows, 0))  # S^T K S
            lib["project_mass"](table, seen.sums, P)
            for k, along in enumerate(S):
                work.b[k] = -dot(along, missing)
                work.r[k] = work.b[k]
                work.G[k][0 : k + 1] = [P[place_of(k, j)] for j in range(k + 1)]
        else:
            work.G[:] = mass_matrix(lib, table, seen.sums)
            # b = F - K V_dot: the wrench demanded of the flywheels
            for i in range(6):
                demanded = less(F[i], work.G[i], moving)
                work.b[i] = demanded
                work.r[i] = demanded
        lib["factor"](work)
        if layout.flywheels:
            for s in range(layout.count):
                s_phi = sine[s]
                c_phi = cosine[s]
                scale = table.flywheel[s].spin_root_inv
                work.scale[s] = scale
                if held:
                    coupling: Reals = column_of(table.flywheel[s], s_phi, c_phi)  # column of I
                    for k, along in enumerate(S):
                        work.I[k][s] = dot(along, coupling)
                else:
                    work.I[:, s] = column_of(table.flywheel[s], s_phi, c_phi)
                for i in range(rows):
                    work.W[i][s] = work.I[i][s] * scale
        substitute(lib, work, rows)
        return OK


@inline
def check_answer(lib: Any, values: Reals, count: Any) -> None:
    """RANGE where a result is not finite: near singular states extreme demands need more than the largest number."""
    check_as(RANGE, lib["within"](values, count, lib.largest))


@inline
def check_demand(
    lib: Any, table: Any, x: Any, demanded: Reals, options: Any, wrench: Any, turns: Any, names: Any
) -> Any:
    """Inputs of both variants, and of the options the weights and those of `names`, numbers of 0 to 1."""
    check_inputs(lib, table, x, None, wrench, turns)
    within = lib["within"]
    within(demanded, len(demanded), lib.limit("MAX_ACCELERATION"))
    within(options.weight, lib.layout.count, lib.limit("MAX_WEIGHT"))
    shares = reals(len(names))
    for k, name in enumerate(names):
        shares[k] = options.member(name)
    within(shares, len(names), lib.largest)
    for share in [*shares]:
        if not (share >= 0 and share <= 1):
            return BAD_ARGUMENT
    for s in range(lib.layout.count):
        if not options.weight[s] >= lib.thresholds.weight:
            return RANGE
