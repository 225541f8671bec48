"""Control allocation: a demand distributed among weighted, limited flywheels, in a bounded number of passes.

The rows of W are orthogonal with sizes sigma (core/routines/jacobi.py); wanted is W y = r in the first `rank` rows.
With the weights Omega, least y^T Omega y is y = Omega^-1 B^T (B Omega^-1 B^T)^-1 g r, where B = g W has scaled rows.

The first pass asks all flywheels, with rows of unit size, so that small singular values lose no digits; who passes its
limit is held there. Then the active set method for bounded least squares (Stark and Parker 1995, "Bounded-variable
least squares"; Harkegard 2002 for control allocation), from that feasible answer: what is left over is shared among the
free flywheels, by a step as long as all limits allow; the flywheel that stopped it is held, and after a whole step the
held flywheel that would lower the residual most is freed. Here all rows are scaled alike, so what cannot be met is left
with the least residual in the norm of K^-1. It is settled after a whole step that lowers the residual no more and frees
nobody. Then, or after half of all passes, the weights are left out, until it is settled again: flywheels that they
nearly silenced may give.
"""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.library import Library
from mahovik.core.lower.limits import Thresholds
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import Ints, Reals, Result, argument, inline, ints, kernel, reals
from mahovik.core.routines import ldl
from mahovik.core.routines.jacobi import name_for_rows


def usual_passes(count: int) -> int:
    """Number of passes that are always made: each of N flywheels may be held once. It stops growing at 64."""
    return 4 + max(2, min(count, 64))


def most_passes(count: int) -> int:
    """Largest number of passes: each flywheel may be held and freed again, as in `bounded_least_squares`."""
    return 4 + 6 * count


def allocate(lib: Library, rows: int = 6) -> Function:
    """phi_ddot of a demand in orthogonal rows, the first `rows` of the work."""
    layout = lib.layout
    N, n = layout.count, int(layout.count)
    eps, regularisation = lib.thresholds, lib.thresholds.regular
    most_real, largest = layout.precision.largest, lib.limits["LARGEST"].expression

    @kernel(name_for_rows("allocate", rows), equation="(12)")
    def allocate(
        work: Any = argument("orthogonal rows W, their sizes sigma, demand r, scale", struct=layout.inverse_work),
        options: Any = argument("weights and limits", struct=layout.inverse_options),
        rank: int = argument("number of rows used"),
        phi_ddot: Reals = argument("flywheel accelerations", N, direction="out", unit="rad/s2"),
        limited: Ints = argument("1 where a flywheel is held at its limit", N, direction="out"),
    ) -> None:
        """Shares a demand among the flywheels: least weighted norm; others make up for one at its limit."""
        share = reals(N)  # 1/weight
        give = reals(N)  # 1/weight of a free flywheel, 0 for one held at its limit
        step = reals(N)  # increment of the free flywheels
        row = reals(rows)  # factor of each row; 0: the row is left out
        gram = reals(rows, rows)
        z = reals(rows)
        settled = ints()  # 1 after a whole step that gains nothing and frees nobody
        going: int = 1
        weighted: int = 1
        square_before: float = most_real  # square of the residual after the last whole step
        # until the end phi_ddot holds y = D phi_ddot
        for s in range(N):
            phi_ddot[s] = 0
            limited[s] = 0
            share[s] = 1 / options.weight[s]
        for pass_ in range(most_passes(n)):  # at most: each flywheel is held and freed again
            if going > 0:
                most: float = 0.0
                for s in range(N):
                    give[s] = 0.0 if limited[s] > 0 else share[s]
                    most = give[s] if give[s] > most else most
                regular = regularisation * most
                least = regular if most > 0 else 1.0  # keeps the diagonal positive
                for i in range(rows):
                    row[i] = 0
                    if i < rank:
                        row[i] = 1 / (work.sigma[i] if pass_ < 1 else work.sigma[0])
                left_over(N, work, phi_ddot, row, z, rows)
                make_gram(N, work, row, give, gram, least, rows)
                ldl.factor(gram, rows, lambda _, least=least: least, z=z)
                ldl.substitute_back(gram, z, rows)
                for i in range(rows):
                    z[i] = row[i] * z[i]
                for s in range(N):
                    total: float = 0.0
                    for i in range(rows):
                        total += work.W[i][s] * z[i]
                    step[s] = give[s] * total
                settled = 0
                if pass_ < 1:
                    clip(N, work, options, phi_ddot, limited, step)
                else:
                    advance(N, work, options, rank, phi_ddot, limited, step, rows, settled, square_before, eps)
                # the weights are left out when each flywheel may have been held, or after half of all passes
                if pass_ >= usual_passes(n) - 2 and (settled > 0 or pass_ == most_passes(n) // 2):
                    going = weighted
                    weighted = 0
                    for s in range(N):
                        share[s] = 1
        # rounding may take an answer that just reaches its limit beyond it; what overflows is refused later
        for s in range(N):
            answer = phi_ddot[s] * work.scale[s]
            phi_ddot[s] = answer
            if limited[s] > 0 or (abs(answer) > options.limit[s] and abs(answer) <= largest):
                phi_ddot[s] = -options.limit[s] if answer < 0 else options.limit[s]

    return allocate


@inline
def clip(N: int, work: Any, options: Any, y: Reals, held: Ints, step: Reals) -> None:
    """The first answer, with flywheels beyond their limit held at it."""
    for s in range(N):
        y[s] = step[s]
        if abs(step[s]) * work.scale[s] > options.limit[s]:
            bound = options.limit[s] / work.scale[s]
            y[s] = -bound if step[s] < 0 else bound
            held[s] = 1


@inline
def advance(
    N: int, work: Any, options: Any, rank: int, y: Reals, held: Ints, step: Reals, rows: int, settled: Result,
    square_before: Result, eps: Thresholds,
) -> None:  # fmt: skip
    """A step of the active set method.

    At its limit a flywheel that does not move may still be beyond it by the rounding of the product.
    """
    # go as far as all limits allow; hold the flywheel that reaches its limit
    length: float = 1.0
    stopped: int = -1
    for s in range(N):
        moved = (y[s] + step[s]) * work.scale[s]
        if held[s] == 0 and abs(moved) > options.limit[s] and abs(step[s]) > 0:
            room = options.limit[s] / work.scale[s] - (-y[s] if moved < 0 else y[s])
            part = room / abs(step[s])
            if part < length:
                length = part if part > 0 else 0.0
                stopped = s
    for s in range(N):
        y[s] += length * step[s]
        if stopped == s:
            bound = options.limit[s] / work.scale[s]
            y[s] = -bound if step[s] < 0 else bound
            held[s] = 1
    # after a full step, release the held flywheel that would lower the residual most
    if stopped < 0:
        left = reals(rows)
        wanted: float = 0
        square: float = 0  # of the residual
        for i in range(rows):
            wanted += work.r[i] * work.r[i]
            left[i] = work.r[i] if i < rank else 0.0
            if i < rank:
                for s in range(N):
                    left[i] -= work.W[i][s] * y[s]
            square += left[i] * left[i]
        best: float = eps.reached_square * wanted  # smaller gains are ignored
        freed: int = -1
        for s in range(N):
            if held[s] > 0:
                slope: float = 0.0
                size: float = 0.0
                for i in range(rows):
                    slope += work.W[i][s] * left[i]
                    size += work.W[i][s] * work.W[i][s]
                inward = -slope if y[s] > 0 else slope
                if inward > 0 and inward * inward > best * size:
                    best = inward * inward / size
                    freed = s
        if freed >= 0:
            held[freed] = 0
        elif not (square > best and square < square_before.value * eps.settled):
            settled.value = 1
        square_before.value = square


@inline
def left_over(N: int, work: Any, y: Reals, row: Reals, z: Reals, rows: int) -> None:
    """Compute the demand that the flywheels do not meet yet."""
    for i in range(rows):
        left: float = work.r[i]
        for s in range(N):
            left -= work.W[i][s] * y[s]
        z[i] = row[i] * left


@inline
def make_gram(N: int, work: Any, row: Reals, give: Reals, gram: Reals, least: float, rows: int) -> None:
    """B Omega^-1 B^T of the free flywheels, lower triangle."""
    weighed = reals(N)  # a row of W Omega^-1
    for i in range(rows):
        for s in range(N):
            weighed[s] = work.W[i][s] * give[s]
        for j in range(i + 1):
            total: float = 0.0
            for s in range(N):
                total += weighed[s] * work.W[j][s]
            gram[i][j] = row[i] * row[j] * total
        gram[i][i] += least
