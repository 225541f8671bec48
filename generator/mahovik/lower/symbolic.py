"""SymPy expressions as program expressions, with an order of operations of our own.

SymPy sorts sums and products by rules that may change with its version; here terms are ordered by the names in
them, positive ones first, so that the same derivation always gives the same operations, hence the same bits.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp

from mahovik.program.build import Body
from mahovik.program.expression import Expr, Negate, Place, real

Binding = Mapping[str, Any]
"""What a symbol's base name stands for: a scalar expression, or something that is indexed (a place, a list)."""

_INDEXED = re.compile(r"(\w+)\[(\d+)\]")


def translate(expression: sp.Expr, binding: Binding) -> Expr:
    """`expression` as a program expression. Raises KeyError for a symbol that `binding` lacks."""
    e = sp.sympify(expression)
    if e.is_Symbol:
        return _place(e.name, binding)
    if e.is_Number:
        return real(float(e))
    if e.is_Add:
        return _sum(e, binding)
    if e.is_Mul:
        return _product(e, binding)
    if e.is_Pow and e.exp.is_Integer and e.exp > 1:
        return _chain([translate(e.base, binding)] * int(e.exp))
    raise TypeError(f"{e} has no form in a program")


def _place(name: str, binding: Binding) -> Expr:
    indexed = _INDEXED.fullmatch(name)
    found = binding[name] if indexed is None else binding[indexed[1]][int(indexed[2])]
    assert isinstance(found, Expr)
    return found


def _sum(e: sp.Add, binding: Binding) -> Expr:
    terms = sorted(e.args, key=lambda t: (_negative(t), _key(t)))
    total = translate(terms[0], binding)
    for term in terms[1:]:
        total = total - translate(-term, binding) if _negative(term) else total + translate(term, binding)
    return total


def _product(e: sp.Mul, binding: Binding) -> Expr:
    coefficient, rest = e.as_coeff_Mul()
    factors = [translate(a, binding) for a in sorted(sp.Mul.make_args(rest), key=_key)]
    if coefficient == -1:
        return _chain([Negate(factors[0]), *factors[1:]])
    if coefficient == 1:
        return _chain(factors)
    return _chain([real(float(coefficient)), *factors])


def _chain(factors: Sequence[Expr]) -> Expr:
    product = factors[0]
    for factor in factors[1:]:
        product = product * factor
    return product


def _negative(term: sp.Expr) -> bool:
    return bool(term.as_coeff_Mul()[0] < 0)


_LAST = frozenset(("c", "s", "c2", "s2", "dc", "ds", "dc2", "ds2", "ddc", "dds", "two_c2", "two_s2"))
"""Weights of a row's columns: a column is named before its weight."""


def _key(e: sp.Expr) -> tuple[object, ...]:
    """Names in natural order ([2] before [10]), then the text: the same in every run and version."""
    if str(e) in _LAST:
        return (["~"], str(e))
    text = re.sub(r"\d+", lambda m: m[0].zfill(4), str(e).replace("-", ""))
    return (sorted(re.findall(r"[a-zA-Z_]\w*(?:\[\d+\])?", text)), text)


def assign(body: Body, targets: Sequence[Place], values: sp.Matrix, binding: Binding, add: bool = False) -> None:
    """targets[i] = (or +=) values[i], one statement each; zeros are not added."""
    for target, value in zip(targets, list(values), strict=True):
        if add and value == 0:
            continue
        translated = translate(value, binding)
        if add:
            body.add(target, translated)
        else:
            body.set(target, translated)


def add_each(body: Body, sums: Mapping[Place, sp.Matrix], binding: Binding) -> None:
    """sum[i] += values[i] for all i of vectors of one length, in a loop.

    Raises ValueError where an element is not the first with another index.
    """
    for values in sums.values():
        for k, value in enumerate(values):
            first = value.subs({x: sp.Symbol(str(x).replace(f"[{k}]", "[0]")) for x in value.free_symbols})
            if first != values[0]:
                raise ValueError(f"{value} is not {values[0]} with another index")
    with body.loop("i", len(next(iter(sums.values())))) as i:
        each = {name: [x[i]] if isinstance(x, Place) and x.shape else x for name, x in binding.items()}
        for target, values in sums.items():
            body.add(target[i], translate(values[0], each))
