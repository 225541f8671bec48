"""Notation: text and SymPy objects become trees, trees are printed, and what is printed is the expression."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from functools import cache

import pytest
import sympy as sp

from mahovik.core.derive.document import Block, Formula, Table, Text, sections
from mahovik.laws.weight.derive import weight
from mahovik.out.report.derivation.notation import (
    Fence,
    Fraction,
    FunctionName,
    Grid,
    Node,
    Number,
    Operator,
    Row,
    Script,
)
from mahovik.out.report.derivation.parse import NotationError, parse
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


def test_all_notation_of_the_documents_is_read_and_printed() -> None:
    """Each text between backticks, part and head is notation; MathML is well-formed, LaTeX is ASCII."""
    texts = [p for b in blocks() if isinstance(b, Formula) for p in b.parts if isinstance(p, str)]
    texts += [piece for b in blocks() if isinstance(b, Text) for piece in b.text.split("`")[1::2]]
    assert len(texts) > 100
    for text in set(texts):
        node = parse(text)
        ET.fromstring(node.math(display=True))
        assert node.tex().isascii()
    assert all(b.text.count("`") % 2 == 0 for b in blocks() if isinstance(b, Text))


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("mu[0]", "mu_1"),
        ("mu_c[1]", "mu^c_2"),
        ("J[3]", "J_{12}"),
        ("J_2s[5]", "J^{2s}_{23}"),
        ("J_dot[2]", "dot(J)_{33}"),
        ("R[5]", "R_{23}"),
        ("h_rel[0]", "h^{rel}_1"),
        ("q[0]", "q_0"),
        ("phi_dot", "dot(phi)"),
        ("phi_ddot", "ddot(phi)"),
        ("dc", "dot(c)"),
        ("dds", "ddot(s)"),
        ("ds2", "dot(s)_2"),
        ("c_psi", "c_psi"),
        ("omega_dot[1]", "omega*_2"),
    ],
)
def test_symbols_get_proper_indices(name: str, text: str) -> None:
    """`mu[0]` is a letter with an index, a rate has dots."""
    assert symbol(name) == parse(text)


@pytest.mark.parametrize(
    ("text", "latex"),
    [
        ("K_s = L_s Theta_s L_s^T", r"{K}_{s}={L}_{s}{\Theta }_{s}{L}_{s}^{T}"),
        ("K* V*", "{K}^{*}{V}^{*}"),
        ("dot(phi)_s", r"{\dot{\varphi }}_{s}"),
        ("<omega> A", r"\langle \omega \rangle A"),
        ("{E, 0}", "\\begin{bmatrix}\nE & \\cdot\n\\end{bmatrix}"),
        ("1/2 (a + b)", r"\tfrac{1}{2}(a+b)"),
        ('"kg m"^2', r"{\text{kg m}}^{2}"),
    ],
)
def test_latex(text: str, latex: str) -> None:
    """What amsmath is given."""
    assert parse(text).tex() == latex


def test_numbers_stay_before_sums() -> None:
    """A half of a sum is not multiplied out, a sum of negative terms is turned round."""
    a, b, c = sp.symbols("a b c")
    half = sp.Mul(sp.Rational(1, 2), a + b, evaluate=False)
    assert notation(half) == parse("1/2 (a + b)")
    assert notation((-a - b) * c) == parse("-(a + b) c")
    assert notation(sp.Mul(-1, a + b, evaluate=False)) == parse("-(a + b)")
    assert notation(-a / b) == notation(-(a / b))


def test_mathml() -> None:
    """Presentation elements, zeros marked as such."""
    assert parse("mu_1 = 0").math() == "<math><mrow><msub><mi>μ</mi><mn>1</mn></msub><mo>=</mo><mn>0</mn></mrow></math>"
    assert parse("cos phi").math().startswith("<math><mrow><mi>cos</mi><mspace")
    assert 'class="zero"' in notation(sp.Matrix([[0, 1]])).math()
    assert Grid(((Number("2", -5),),)).math().count("2·10⁻⁵") == 1


@pytest.mark.parametrize("text", ["<a", "{a, b", "a)", "(a", "a ? b", "_a", "dot phi"])
def test_text_that_is_no_notation_is_an_error(text: str) -> None:
    """With the text in the message."""
    with pytest.raises(NotationError, match="in "):
        parse(text)


def test_expressions_without_notation_are_an_error() -> None:
    """Not printed as something else."""
    with pytest.raises(TypeError, match="no notation"):
        notation(sp.Symbol("x") ** sp.Symbol("y") + sp.exp(sp.Symbol("z")))
