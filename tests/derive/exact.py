"""Exact comparison of SymPy expressions: polynomials over the rationals, modulo the relations among their symbols.

Everything is multiplied out in a polynomial ring and divided by a Groebner basis of the relations. A remainder of 0
proves equality wherever the relations hold: nothing is sampled and nothing is rounded.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache

import sympy as sp
from sympy.polys.orderings import grevlex
from sympy.polys.rings import PolyElement, PolyRing


def circle(cos: sp.Expr, sin: sp.Expr) -> tuple[sp.Expr, ...]:
    """c^2 + s^2 = 1."""
    return (cos**2 + sin**2 - 1,)


def rotation(R: sp.Matrix) -> tuple[sp.Expr, ...]:
    """R R^T = R^T R = E and cofactors of R = R: orthogonal, and right-handed."""
    return (*orthogonal(R), *(R.adjugate().T - R))


def orthogonal(R: sp.Matrix) -> tuple[sp.Expr, ...]:
    """R R^T = R^T R = E: a rotation or a reflection."""
    return (*(R * R.T - sp.eye(3)), *(R.T * R - sp.eye(3)))


def trigonometric(expression: sp.Matrix, phi: sp.Symbol) -> sp.Matrix:
    """cos phi and sin phi by the symbols c, s."""
    return expression.subs({sp.cos(phi): sp.Symbol("c"), sp.sin(phi): sp.Symbol("s")})


def remainders(difference: Iterable[sp.Expr], relations: Sequence[sp.Expr] = ()) -> list[sp.Expr]:
    """Remainders of each element modulo the relations, without zeros: [] proves that the difference is 0."""
    elements = [sp.sympify(e) for e in difference]
    basis = _basis(tuple(sp.expand(r) for r in relations))
    symbols = sorted(set().union(*(e.free_symbols for e in (*elements, *basis))), key=str)
    ring = PolyRing(symbols or [sp.Symbol("none")], sp.QQ, grevlex)
    divisors = [ring.from_expr(g) for g in basis]
    rests = [_element(e, ring, {}) for e in elements]
    return [r.as_expr() for r in (e.rem(divisors) if divisors else e for e in rests) if r]


@lru_cache(maxsize=32)
def _basis(relations: tuple[sp.Expr, ...]) -> tuple[sp.Expr, ...]:
    wanted = [r for r in relations if r != 0]
    if not wanted:
        return ()
    symbols = sorted(set().union(*(r.free_symbols for r in wanted)), key=str)
    return tuple(sp.groebner(wanted, *symbols, order="grevlex").exprs)


def _element(e: sp.Expr, ring: PolyRing, known: dict[sp.Expr, PolyElement]) -> PolyElement:
    """The expression as an element of the ring; raises TypeError for what is no polynomial."""
    if e in known:
        return known[e]
    if e.is_Symbol:
        polynomial = ring(e)
    elif e.is_Rational:
        polynomial = ring.ground_new(sp.QQ(e.p, e.q))
    elif e.is_Add:
        polynomial = sum((_element(a, ring, known) for a in e.args), ring.zero)
    elif e.is_Mul:
        polynomial = ring.one
        for a in e.args:
            polynomial = polynomial * _element(a, ring, known)
    elif e.is_Pow and e.exp.is_Integer and e.exp > 0:
        polynomial = _element(e.base, ring, known) ** int(e.exp)
    else:
        raise TypeError(f"{e} is no polynomial")
    known[e] = polynomial
    return polynomial
