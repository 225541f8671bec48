"""Answers of W y = r by normal equations: squared condition, few operations."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.expression import Expr, Not, Place, integer, real, select


@dataclass(frozen=True)
class Scaling:
    """How W and r are scaled: y = phi'' by `back`, the norms by `spin` and `norm`; without it they are unit matrices.

    give     of a flywheel: factor of its column in W Omega^-1 W^T, 1/weight, and with it 1/Theta_ff where not in W
    back     of a flywheel: phi'' = back (W Omega^-1)^T z; None: W Omega^-1 has it already
    norm     of a row: D, where W and r lack D^-1/2; None: they have it
    inverse  1/D
    """

    give: Callable[[Expr], Expr]
    back: Callable[[Expr], Expr] | None = None
    norm: Place | None = None
    inverse: Place | None = None


def wide_answer(
    lib: Library, body: Body, work: Place, p: Place, rows: int, answer: Place, by: Scaling, use: Place | None = None
) -> None:
    """phi'' = D^-1 Omega^-1 W^T z, (W Omega^-1 W^T + lambda^2 E) z = r: not more rows than flywheels.

    A row that is free, by `use`, is zero and its z is 0. I has had its use: W Omega^-1 takes its place.
    """
    count = lib.layout.count
    body.note("normal equations: W Omega^-1 W^T z = r, y = Omega^-1 W^T z; I has had its use, W Omega^-1 is there")
    with body.loop("s", count) as s:
        give = body.let("give", by.give(s))
        with body.loop("i", rows) as i:
            body.set(work.I[i][s], work.W[i][s] * give)
    gram = body.local("gram", (rows, rows))
    z = body.local("z", (rows,))
    trace = body.local("trace")
    body.set(trace, real(0))
    with body.loop("i", rows) as i:
        with body.loop("j", i + 1) as j:
            total = body.local("total")
            body.set(total, real(0))
            with body.loop("s", count) as s:
                body.add(total, work.I[i][s] * work.W[j][s])
            body.set(gram[i][j], total)
        body.add(trace, gram[i][i] if by.inverse is None else gram[i][i] * by.inverse[i])
        body.set(z[i], work.r[i])
    share = body.let("lambda2", p.damping * p.damping * trace, "square of the damping")
    with body.loop("i", rows) as i:
        own = share if by.norm is None else share * by.norm[i][i]
        body.add(gram[i][i], own if use is None else select(use[i] > 0, own, real(1)))
    solve_definite(lib, body, gram, z, rows)
    with body.loop("s", count) as s:
        y = body.local("y")
        body.set(y, real(0))
        with body.loop("i", rows) as i:
            body.add(y, work.I[i][s] * z[i])
        body.set(answer[s], y if by.back is None else y * by.back(s))


def tall_answer(lib: Library, body: Body, work: Place, p: Place, rows: int, answer: Place) -> None:
    """phi'' = D^-1 y, (W^T W + lambda^2 E) y = W^T r: more rows than flywheels."""
    count = lib.layout.count
    body.note("normal equations: W^T W y = W^T r")
    gram = body.local("gram", (count, count))
    z = body.local("z", (count,))
    trace = body.local("trace")
    body.set(trace, real(0))
    with body.loop("s", count) as s:
        with body.loop("t", s + 1) as t:
            total = body.local("total")
            body.set(total, real(0))
            with body.loop("i", rows) as i:
                body.add(total, work.W[i][s] * work.W[i][t])
            body.set(gram[s][t], total)
        body.add(trace, gram[s][s])
        side = body.local("side")
        body.set(side, real(0))
        with body.loop("i", rows) as i:
            body.add(side, work.W[i][s] * work.r[i])
        body.set(z[s], side)
    share = body.let("lambda2", p.damping * p.damping * trace, "square of the damping")
    with body.loop("s", count) as s:
        body.add(gram[s][s], share)
    solve_definite(lib, body, gram, z, int(count))
    with body.loop("s", count) as s:
        body.set(answer[s], z[s] * work.scale[s])


def solve_definite(lib: Library, body: Body, gram: Place, z: Place, size: int) -> None:
    """z = gram^-1 z by gram = L D L^T, in place and without a square root.

    The lower triangle is given; then L D is on and below the diagonal, L^T above it. Pivots divide: where they are
    tiny their inverses overflow, their quotients do not.
    """
    with body.loop("j", size) as j:
        pivot = body.local("pivot")
        body.set(pivot, gram[j][j])
        least = body.let("least", lib.thresholds.gram_pivot * pivot, "a pivot below this is rounding error")
        rest = body.local("rest")
        body.set(rest, z[j])
        with body.loop("k", j) as k:
            body.add(pivot, -(gram[j][k] * gram[k][j]))
            body.add(rest, -(gram[k][j] * z[k]))
        body.set(z[j], rest)
        lib.guard(body, Not(pivot > least), "NOT_POSITIVE_DEFINITE")
        body.set(gram[j][j], pivot)
        with body.loop("i", size, start=j + 1) as i:
            below = body.local("below")
            body.set(below, gram[i][j])
            with body.loop("k", j) as k:
                body.add(below, -(gram[i][k] * gram[k][j]))
            body.set(gram[i][j], below)
            body.set(gram[j][i], below / pivot)
    with body.loop("t", size) as t:
        i_ = body.let("i", integer(size - 1) - t)
        rest = body.local("rest")
        body.set(rest, z[i_] / gram[i_][i_])
        with body.loop("k", size, start=i_ + 1) as k:
            body.add(rest, -(gram[i_][k] * z[k]))
        body.set(z[i_], rest)
