"""Momentum form of (8) and its solution: a 3x3 solve, for the translational block of K is constant.

With the flywheels eliminated by their drives, K - sum I I^T / Theta_ff, it changes, and is inverted at run time.
"""

from __future__ import annotations

from itertools import product
from typing import Any

from mahovik.core.derive import SYMMETRIC
from mahovik.core.lower.library import Library
from mahovik.core.program.expression import Place, Status
from mahovik.core.program.kernel import NOT_POSITIVE_DEFINITE, OK, Reals, argument, changed, inline, let, reals, result
from mahovik.core.program.vector import Vector, cross, skew, symmetric

POSITIVE = ("OK", "NOT_POSITIVE_DEFINITE")


def mass_times(lib: Library, table: Any, sums: Any, six: Any, p: Any = (0, 0, 0), h: Any = (0, 0, 0)) -> Any:
    """K times a twist or its rate (6), with p added to the force and h to the moment."""
    v, omega, mu = six[0:3], six[3:6], sums.mu
    if lib.layout.added_mass:
        B = lower_left(lib, table, mu)
        force, moment = symmetric(table.A) @ v + B.T @ omega, B @ v + symmetric(sums.J) @ omega + h
    else:
        force, moment = table.mass * v - cross(mu, omega), symmetric(sums.J) @ omega + h + cross(mu, v)
    return Vector([*(force + p), *moment])


def momentum_parts(lib: Library, table: Any, sums: Any, V: Any) -> Any:
    """Z = K V + sum I phi_dot (2)."""
    return mass_times(lib, table, sums, V, sums.mu_dot, sums.h_rel)


def lower_left(lib: Library, table: Place, mu: Any) -> Any:
    """B = <mu> + Lambda_21: lower left block of K."""
    return table.G.square + skew(mu) if lib.layout.added_mass else skew(mu)


def add_momentum(lib: Library) -> None:
    """Adds the momentum screw and the right-hand side of (8)."""

    @lib.kernel(equation="(2)")
    def momentum_screw(
        table: Any = lib.table, sum_: Any = lib.sums, V: Reals = argument("", 6), Z: Reals = result("", 6)
    ) -> None:
        """Momentum screw Z = K V + sum I phi_dot of the sums."""
        Z[:] = momentum_parts(lib, table, sum_, V)

    @lib.kernel(equation="(2), (4), (5)")
    def subtract_rates(
        table: Any = lib.table,
        sum_: Any = lib.sums,
        V: Reals = argument("", 6),
        F: Reals = changed("in: wrench (7); out: right-hand side of (8)", 6, unit="N, N m"),
    ) -> None:
        """Turns F into the right-hand side of (8): F - Phi Z - K_dot V - the flywheels' terms"""
        # momentum screw Z = K V + sum I phi_dot
        Z = momentum_parts(lib, table, sum_, V)
        v, omega, p, h, mu_dot = V[0:3], V[3:6], Z[0:3], Z[3:6], sum_.mu_dot
        F[0:3] = F[0:3] - sum_.a_rel + cross(mu_dot, omega) - cross(omega, p)
        F[3:6] = F[3:6] - symmetric(sum_.J_dot) @ omega - sum_.g_rel + cross(h, omega) - cross(mu_dot, v) + cross(p, v)


@inline
def factored(S: Reals, least: float) -> Any:
    """r1, r2, d3, l21, l31, l32, d2 of a 3x3 S = L D L^T, r = 1 / d; the function returns where it is not positive."""
    if not (S[0] >= least):
        return NOT_POSITIVE_DEFINITE
    r1 = 1 / S[0]
    l21 = S[3] * r1
    l31 = S[4] * r1
    d2 = S[1] - l21 * S[3]
    if not (d2 >= least):
        return NOT_POSITIVE_DEFINITE
    r2 = 1 / d2
    p32 = S[5] - l31 * S[3]
    l32 = p32 * r2
    d3 = S[2] - l31 * S[4] - l32 * p32
    if not (d3 >= least):
        return NOT_POSITIVE_DEFINITE
    return r1, r2, d3, l21, l31, l32, d2


def add_solution(lib: Library) -> None:
    """Adds the solution of K y = F."""
    layout, least = lib.layout, lib.layout.precision.smallest
    added = layout.added_mass

    @inline
    def solved(factors: Any, b: Reals) -> Any:
        """S^-1 b by the factors of S."""
        r1, r2, d3, l21, l31, l32 = factors[:6]
        # L z = b, then L^T y = D^-1 z
        z2 = b[1] - l21 * b[0]
        y3 = (b[2] - l31 * b[0] - l32 * z2) / d3
        y2 = z2 * r2 - l32 * y3
        return b[0] * r1 - l21 * y2 - l31 * y3, y2, y3

    @lib.kernel(statuses=POSITIVE, short=not added)  # with added mass, compilers copy it unasked
    def factor3(S: Reals = argument("11 22 33 12 13 23", 6), L: Any = result(struct=layout.factors3)) -> Status:
        """Factors a symmetric positive definite 3x3 matrix: S = L D L^T."""
        L.r1, L.r2, L.d3, L.l21, L.l31, L.l32 = factored(S, least)[:6]
        return OK

    @lib.kernel(short=True)
    def solve3(
        L: Any = argument(struct=layout.factors3),
        b: Reals = argument("", 3),
        y: Reals = result("must not overlap b", 3),
    ) -> None:
        """Solves S y = b by S = L D L^T."""
        y[:] = solved((L.r1, L.r2, L.d3, L.l21, L.l31, L.l32), b)

    @lib.kernel(equation="(8)", statuses=POSITIVE)
    def factor_carrier(
        table: Any = lib.table, sum_: Any = lib.sums, K: Any = result(struct=layout.carrier_factor)
    ) -> Status:
        """Factors K: its translational block is constant, so that a 3x3 matrix is left."""
        if added:
            B: Reals = lower_left(lib, table, sum_.mu).flat  # <mu> + Lambda_21: lower left block of K
            K.U[:] = (symmetric(table.A_inv) @ B.T).flat
            S: Reals = sum_.J - (B.square @ K.U.square).six  # J - B A^-1 B^T
        else:
            K.rho[:] = table.mass_inverse * sum_.mu
            S: Reals = about_mass_center(sum_, K.rho)  # inertia about the mass centre
        factor3(S, K.L)
        return OK

    @lib.kernel(equation="(8)")
    def solve_carrier(
        table: Any = lib.table,
        K: Any = argument(struct=layout.carrier_factor),
        F: Reals = argument("", 6, unit="N, N m"),
        y: Reals = result("must not overlap F", 6, unit="m/s2, rad/s2"),
    ) -> None:
        """Solves K y = F by the factors of K."""
        if added:
            substitute_back(solve3, table.A_inv, K.U, K.L, F, y)
        else:
            moment = reals(3)  # about the mass centre
            omega_dot = reals(3)
            moment[:] = cross(F[0:3], K.rho) + F[3:6]
            solve3(K.L, moment, omega_dot)
            y[0:3] = F[0:3] * table.mass_inverse - cross(omega_dot, K.rho)
            y[3:6] = omega_dot

    if not added:
        # No factor goes through memory: what is written and read at once takes longer than its arithmetic.
        @lib.kernel(equation="(8)", statuses=POSITIVE)
        def solve_carrier_once(
            table: Any = lib.table,
            sum_: Any = lib.sums,
            F: Reals = argument("", 6, unit="N, N m"),
            y: Reals = result("must not overlap F", 6, unit="m/s2, rad/s2"),
        ) -> Status:
            """Solves K y = F where no other right-hand side follows: factors of K as factor_carrier finds them."""
            rho: Reals = table.mass_inverse * sum_.mu  # mass centre from O1, in E1
            S: Reals = about_mass_center(sum_, rho)  # inertia about the mass centre
            factors = factored(S, least)
            moment: Reals = cross(F[0:3], rho) + F[3:6]  # about the mass centre
            y1, y2, y3 = solved(factors, moment)
            omega_dot = Vector([y1, y2, y3])
            linear = [
                let(f"v{i + 1}_dot", rate) for i, rate in enumerate(F[0:3] * table.mass_inverse - cross(omega_dot, rho))
            ]
            y[:] = [*linear, y1, y2, y3]
            return OK


def about_mass_center(sums: Place, rho: Any) -> Any:
    """J - B A^-1 B^T of a stand without added mass: the inertia about the mass centre rho."""
    mu = sums.mu
    moved = [mu[i] * rho[i] + mu[j] * rho[j] for i, j in ((1, 2), (0, 2), (0, 1))]
    return sums.J - Vector([*moved, *(-(mu[j] * rho[i]) for i, j in ((0, 1), (0, 2), (1, 2)))])


@inline
def invert_symmetric(lib: Library, A: Reals, inverse: Reals) -> Any:
    """The inverse (11 22 33 12 13 23) of a matrix that is guarded to be positive definite and finite."""
    c11 = A[1] * A[2] - A[5] * A[5]
    c22 = A[0] * A[2] - A[4] * A[4]
    c33 = A[0] * A[1] - A[3] * A[3]
    c12 = A[4] * A[5] - A[2] * A[3]
    c13 = A[3] * A[5] - A[1] * A[4]
    c23 = A[3] * A[4] - A[0] * A[5]
    det = A[0] * c11 + A[3] * c12 + A[4] * c13
    if not (A[0] > 0 and c33 > 0 and (det >= lib.layout.precision.smallest and det <= lib.largest)):
        return NOT_POSITIVE_DEFINITE
    r = 1 / det
    inverse[:] = [c11 * r, c22 * r, c33 * r, c12 * r, c13 * r, c23 * r]
    return None


@inline
def start_blocks(lib: Library, table: Any, sums: Any, K: Any) -> None:
    """K of (2) by blocks."""
    K.A[:] = table.A if lib.layout.added_mass else [table.mass, table.mass, table.mass, 0, 0, 0]
    K.B[:] = lower_left(lib, table, sums.mu).flat
    K.D[:] = sums.J


def add_elimination(lib: Library) -> None:
    """Adds the elimination of one free flywheel: from six rows, or from those along the freedoms of a held carrier."""
    m = lib.layout.freedoms
    if lib.layout.held:

        @lib.kernel("eliminate", short=True)
        def eliminate_along(
            column: Reals = argument("of S^T I", m),
            spin_inv: float = argument(unit="1/(kg m2)"),
            rate: float = argument("its acceleration at u_dot = 0", unit="rad/s2"),
            P: Reals = changed("", m * (m + 1) // 2),
            y: Reals = changed("", m),
        ) -> None:
            """Eliminates one free flywheel: S^T K S - (S^T I) (S^T I)^T / Theta_ff, y - S^T I rate."""
            scaled: Reals = column * spin_inv  # S^T I / Theta_ff
            P -= [scaled[i] * column[j] for i in range(m) for j in range(i + 1)]
            y -= column * rate

        return

    @lib.kernel()
    def eliminate(
        column: Reals = argument("of I", 6),
        spin_inv: float = argument(unit="1/(kg m2)"),
        rate: float = argument("its acceleration at V_dot = 0", unit="rad/s2"),
        K: Any = changed(struct=lib.layout.schur),
        F: Reals = changed("", 6),
    ) -> None:
        """Eliminates one free flywheel: K - I I^T / Theta_ff, F - I rate."""
        scaled: Reals = column * spin_inv  # I / Theta_ff
        K.A -= [column[i] * scaled[j] for i, j in SYMMETRIC]
        K.B -= [column[3 + i] * scaled[j] for i, j in product(range(3), repeat=2)]
        K.D -= [column[3 + i] * scaled[3 + j] for i, j in SYMMETRIC]
        F -= column * rate


def add_block_solution(lib: Library) -> None:
    """Adds the solution of the equations with the flywheels eliminated, by blocks of 3x3."""
    layout, factor3, solve3 = lib.layout, lib["factor3"], lib["solve3"]

    @lib.kernel(statuses=POSITIVE)
    def factor_schur(
        K: Any = argument(struct=layout.schur), factor: Any = result(struct=layout.schur_factor)
    ) -> Status:
        """Factors [A B^T; B D], symmetric positive definite, by blocks of 3x3."""
        invert_symmetric(lib, K.A, factor.A_inv)
        S = reals(6)  # D - B A^-1 B^T
        factor.U[:] = (symmetric(factor.A_inv) @ K.B.T).flat
        S[:] = K.D - (K.B.square @ factor.U.square).six
        factor3(S, factor.L)
        return OK

    @lib.kernel()
    def solve_schur(
        factor: Any = argument(struct=layout.schur_factor),
        F: Reals = argument("", 6),
        y: Reals = result("must not overlap F", 6),
    ) -> None:
        """Solves [A B^T; B D] y = F by the factors."""
        substitute_back(solve3, factor.A_inv, factor.U, factor.L, F, y)


@inline
def substitute_back(solve3: Any, A_inv: Reals, U: Reals, L: Any, F: Reals, y: Reals) -> None:
    """y of K y = F with U = A^-1 B^T and the factors L of J - B U."""
    moment = reals(3)  # n - B A^-1 f
    omega_dot = reals(3)
    moment[:] = F[3:6] - U.T @ F[0:3]
    solve3(L, moment, omega_dot)
    y[0:3] = symmetric(A_inv) @ F[0:3] - U.square @ omega_dot
    y[3:6] = omega_dot
