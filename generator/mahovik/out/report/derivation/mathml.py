"""Notation as MathML Core: what Chromium, Firefox and Safari render by themselves."""

from __future__ import annotations

from html import escape

from mahovik.out.report.derivation.notation import (
    BigSum,
    Dots,
    Fence,
    Fraction,
    FunctionName,
    Grid,
    Letter,
    Node,
    Number,
    Operator,
    Row,
    Script,
    Words,
)

GREEK = {
    "psi": "ψ",
    "theta": "θ",
    "phi": "φ",
    "omega": "ω",
    "mu": "μ",
    "rho": "ρ",
    "tau": "τ",
    "Phi": "Φ",
    "Theta": "Θ",
    "Lambda": "Λ",
}
_FENCES = {"(": ("(", ")"), "[": ("[", "]"), "<": ("⟨", "⟩")}
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
ZERO = '<mn class="zero">0</mn>'


def mathml(node: Node, display: bool = False) -> str:
    """A complete math element."""
    mode = ' display="block"' if display else ""
    return f"<math{mode}>{_mathml(node)}</math>"


def number(digits: str, exponent: int) -> str:
    """Digits with a power of ten as plain text."""
    return digits if exponent == 0 else f"{digits}·10{str(exponent).translate(_SUPERSCRIPT)}"


def _mathml(node: Node) -> str:
    match node:
        case Letter(name):
            return f"<mi>{GREEK.get(name, escape(name))}</mi>"
        case FunctionName(name):
            return f'<mi>{name}</mi><mspace width="0.17em"/>'
        case Number(digits, exponent):
            return f"<mn>{number(digits, exponent)}</mn>"
        case Operator(sign):
            return _operator(sign)
        case Words(text):
            return f"<mtext>{escape(text)}</mtext>" if text.strip() else f'<mspace width="{len(text) * 0.6:.2g}em"/>'
        case Row(items):
            return f"<mrow>{''.join(_mathml(i) for i in items)}</mrow>"
        case Script():
            return _script(node)
        case Dots(base, count):
            accent = "˙" if count == 1 else "¨"
            # accent="true" would be right, but Chromium then sets the dots into the letter
            return f'<mover>{_one(base)}<mo class="dots" stretchy="false">{accent}</mo></mover>'
        case Fence(kind, body):
            left, right = (f'<mo stretchy="false">{sign}</mo>' for sign in _FENCES[kind])
            return f"<mrow>{left}{_mathml(body)}{right}</mrow>"
        case Fraction(above, below):
            return f"<mfrac>{_one(above)}{_one(below)}</mfrac>"
        case Grid(rows):
            return _grid(rows)
        case BigSum(index):
            return f"<munder><mo>∑</mo>{_one(index)}</munder>"


def _operator(sign: str) -> str:
    if sign in "∗′":
        return f'<mo lspace="0" rspace="0">{sign}</mo>'
    if sign == "/":
        return '<mo lspace="0.1em" rspace="0.1em" stretchy="false">/</mo>'
    return f"<mo>{sign}</mo>"


def _one(node: Node) -> str:
    """Exactly one element."""
    text = _mathml(node)
    return f"<mrow>{text}</mrow>" if isinstance(node, FunctionName) else text


def _script(node: Script) -> str:
    base = _one(node.base)
    if node.sup is None and node.sub is not None:
        return f"<msub>{base}{_one(node.sub)}</msub>"
    if node.sub is None and node.sup is not None:
        return f"<msup>{base}{_one(node.sup)}</msup>"
    assert node.sub is not None
    assert node.sup is not None
    return f"<msubsup>{base}{_one(node.sub)}{_one(node.sup)}</msubsup>"


def _grid(rows: tuple[tuple[Node | None, ...], ...]) -> str:
    lines = []
    for cells in rows:
        line = "".join(f"<mtd>{ZERO if cell is None else _mathml(cell)}</mtd>" for cell in cells)
        lines.append(f"<mtr>{line}</mtr>")
    return f'<mtable class="matrix" displaystyle="true">{"".join(lines)}</mtable>'
