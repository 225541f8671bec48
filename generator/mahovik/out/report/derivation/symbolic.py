"""SymPy expressions and matrices as notation."""

from __future__ import annotations

import re
from functools import lru_cache

import sympy as sp

from mahovik.core.derive.order import SYMMETRIC
from mahovik.out.report.derivation.notation import (
    Fence,
    Fraction,
    FunctionName,
    Grid,
    Node,
    Number,
    Operator,
    Script,
    Zero,
    attach_sign,
    row,
)
from mahovik.out.report.derivation.parse import parse

_INDEXED = re.compile(r"(\w+)\[(\d+)\]")
_SIX = re.compile(r"J|A|S|A_inv|J_\w+")
_NINE = re.compile(r"R|C|G|U|B|RJ")
_RATE = re.compile(r"(d+)([cs])(2?)")
_RANKS = (
    dict.fromkeys(("m", "weight_mass"), -1)
    | dict.fromkeys(("c", "s", "c2", "s2"), 1)
    | dict.fromkeys(("psi_dot", "theta_dot", "phi_dot", "phi_ddot"), 2)
)
"""Masses stand first, weights behind their coefficients, rates last."""

_NAMES = {
    "c2": "c_2",
    "s2": "s_2",
    "omega_dot": "omega*",
    "weight_mass": "m^w",
    "displaced_moment": "mu^d",
    "m_inverse": "m^{-1}",
    "A_inv": "(A^{-1})",
}
"""Names that do not follow the rules of `symbol`."""


def notation(value: sp.Expr | sp.MatrixBase) -> Node:
    """The tree of an expression or matrix."""
    if isinstance(value, sp.MatrixBase):
        cells = [[Zero() if x == 0 else expression(x) for x in value[i, :]] for i in range(value.rows)]
        return Grid(tuple(tuple(r) for r in cells))
    return expression(sp.sympify(value))


def expression(e: sp.Expr) -> Node:
    """The tree of an expression."""
    if e.is_Symbol:
        return symbol(e.name)
    if e.is_Integer:
        return attach_sign(Number(str(abs(e))), e < 0)
    if e.is_Rational:
        return attach_sign(Fraction(Number(str(abs(e.p))), Number(str(e.q))), e < 0)
    if e.is_Add:
        return _sum(e)
    if e.is_Mul:
        return _product(e)
    if e.is_Pow:
        return _power(e)
    if isinstance(e, sp.cos | sp.sin):
        return row(FunctionName(e.func.__name__), expression(e.args[0]))
    raise TypeError(f"{e} has no notation")


@lru_cache(maxsize=4096)
def symbol(name: str) -> Node:
    """mu[0], J_2c[3], phi_dot, c_psi, dds as letters with indices, harmonics above, dots for rates."""
    indexed = _INDEXED.fullmatch(name)
    base, index = (indexed[1], int(indexed[2])) if indexed else (name, -1)
    text = _base(base)
    if index >= 0:
        text += f"_{{{_index(base, index)}}}"
    return parse(text)


def _index(base: str, index: int) -> str:
    if _SIX.fullmatch(base):
        i, j = SYMMETRIC[index]
        return f"{i + 1}{j + 1}"
    if _NINE.fullmatch(base):
        return f"{index // 3 + 1}{index % 3 + 1}"
    if base == "q":
        return str(index)  # a quaternion: w is 0
    return str(index + 1)


def _base(name: str) -> str:
    if name in _NAMES:
        return _NAMES[name]
    rate = _RATE.fullmatch(name)
    if rate:
        return f"{'d' * (len(rate[1]) - 1)}dot({rate[2]})" + (f"_{rate[3]}" if rate[3] else "")
    letter, _, tail = name.partition("_")
    if not tail:
        return letter
    if tail in ("dot", "ddot"):
        return f"{tail}({letter})"
    if tail in ("psi", "theta", "phi"):
        return f"{letter}_{tail}"
    return f"{letter}^{{{tail}}}"


def _sum(e: sp.Add) -> Node:
    terms = sorted((_split_sign(t) for t in e.args), key=lambda t: (t[0], _key(t[1])))
    items: list[Node] = []
    for negative, term in terms:
        if negative or items:
            items.append(Operator("−" if negative else "+"))
        items.append(Fence("(", expression(term)) if term.is_Add else expression(term))
    return row(*items)


def _negative(term: sp.Expr) -> bool:
    return bool(term.as_coeff_Mul()[0] < 0)


def _split_sign(term: sp.Expr) -> tuple[bool, sp.Expr]:
    """Whether a minus stands before the term, and what follows it; a sum of negative terms only is turned round."""
    factors, negative = [], False
    for factor in sp.Mul.make_args(term):
        turn = _negative(factor) or (factor.is_Add and all(_negative(a) for a in factor.args))
        negative ^= turn
        factors.append(-factor if turn else factor)
    # not evaluated: SymPy would multiply a number into a sum
    return negative, sp.Mul(*factors, evaluate=False) if len(factors) > 1 else factors[0]


def _product(e: sp.Mul) -> Node:
    negative, rest = _split_sign(e)
    shown = Fence("(", expression(rest)) if rest.is_Add and negative else None
    items = [shown] if shown else _factors(rest)
    return attach_sign(row(*items), negative)


def _factors(e: sp.Expr) -> list[Node]:
    above, below = sp.fraction(e, exact=True)
    if below != 1:
        if below.is_Integer:
            return [Fraction(Number("1"), Number(str(below))), *_factors(above)] if above != 1 else [expression(e)]
        return [Fraction(expression(above), expression(below))]
    coefficient, rest = e.as_coeff_Mul()
    items: list[Node] = [] if coefficient == 1 else [expression(coefficient)]
    for factor in sorted(sp.Mul.make_args(rest), key=_key):
        if factor != 1:
            items.append(Fence("(", expression(factor)) if factor.is_Add else expression(factor))
    return items


def _power(e: sp.Pow) -> Node:
    if e.exp == -1:
        return Fraction(Number("1"), expression(e.base))
    base = expression(e.base)
    if not e.base.is_Symbol:
        base = Fence("(", base)
    if isinstance(base, Script) and base.sup is None:
        return Script(base.base, base.sub, expression(e.exp))
    if isinstance(base, Script):
        base = Fence("(", base)
    return Script(base, None, expression(e.exp))


def _key(e: sp.Expr) -> tuple[object, ...]:
    """Sort key: the names in a term, in natural order; weights and rates last."""
    text = str(e)
    names = sorted(re.sub(r"\d+", lambda m: m[0].zfill(4), n) for n in re.findall(r"[A-Za-z_]\w*(?:\[\d+\])?", text))
    rank = min((_RANKS.get(s.name, 0) for s in e.free_symbols), default=0)
    return (rank, names, text)
