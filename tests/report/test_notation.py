"""Notation: text and SymPy objects become trees, trees are printed, and what is printed is the expression."""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

from mahovik.core.derive.document import Block, Formula, Table, sections
from mahovik.core.derive.wrench import weight
from mahovik.out.report.derivation.notation import (
    Fence,
    Fraction,
    FunctionName,
    Node,
    Number,
    Operator,
    Row,
    Script,
)
from mahovik.out.report.derivation.symbolic import notation, symbol


@cache
def blocks() -> list[Block]:
    """Blocks of the documents of every sequence, without and with added mass."""
    return [
        block
        for sequence in ("ship", "aircraft", "euler")
        for added in (False, True)
        for section in sections(sequence, added_mass=added, weight=weight(added), displaces=added)
        for block in section.blocks
    ]


def expressions() -> list[sp.Expr]:
    """Every SymPy expression of the documents, matrices element by element."""
    parts = [p for b in blocks() if isinstance(b, Formula) for p in b.parts]
    parts += [p for b in blocks() if isinstance(b, Table) for cells in b.rows for p in cells]
    found: list[sp.Expr] = []
    for part in parts:
        if not isinstance(part, str):
            found.extend(part if isinstance(part, sp.MatrixBase) else [part])
    return list(dict.fromkeys(sp.sympify(x) for x in found))


class Reader:
    """Reads a printed tree back as an expression, by the rules that a person reads it by."""

    def __init__(self, symbols: set[sp.Symbol]) -> None:
        self.known = {symbol(s.name): s for s in symbols}
        assert len(self.known) == len(symbols), "two symbols look the same"

    def value(self, node: Node) -> sp.Expr:
        """Sum of products, side by side."""
        items = list(node.items) if isinstance(node, Row) else [node]
        total, product, sign, started = sp.S.Zero, sp.S.One, 1, False
        while items:
            item = items.pop(0)
            if isinstance(item, Operator):
                total += sign * product if started else 0
                product, started = sp.S.One, False
                sign = {"+": 1, "−": -1}[item.sign]
            elif isinstance(item, FunctionName):
                product, started = product * getattr(sp, item.name)(self.factor(items.pop(0))), True
            else:
                product, started = product * self.factor(item), True
        return total + sign * product

    def factor(self, node: Node) -> sp.Expr:
        """One factor."""
        if node in self.known:
            return self.known[node]
        match node:
            case Number(digits, 0):
                return sp.Integer(digits)
            case Fence("(", body) | (Row() as body):
                return self.value(body)
            case Fraction(above, below):
                return self.value(above) / self.value(below)
            case Script(base, sub, Number(digits, 0)):
                return self.factor(base if sub is None else Script(base, sub)) ** int(digits)
        raise AssertionError(f"{node} cannot be read")


@pytest.mark.slow
def test_what_is_printed_is_the_expression() -> None:
    """Signs, brackets, fractions and powers of every expression of the documents, read back."""
    shown = expressions()
    assert len(shown) > 300
    reader = Reader(set().union(*(x.free_symbols for x in shown)))
    for x in shown:
        assert sp.expand(reader.value(notation(x)) - x) == 0, x
