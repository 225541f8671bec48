"""Notation as LaTeX with amsmath."""

from __future__ import annotations

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

_GREEK = {"phi": r"\varphi"} | {
    name: f"\\{name}" for name in ("psi", "theta", "omega", "mu", "rho", "tau", "Phi", "Theta", "Lambda")
}
_FENCES = {"(": ("(", ")"), "[": ("[", "]"), "<": (r"\langle ", r"\rangle ")}
_SIGNS = {"−": "-", "∗": "*", "′": r"\prime ", "≈": r"\approx ", "×": r"\times ", "·": r"\cdot "}
_SPECIAL = {c: f"\\{c}" for c in "_&%$#{}"} | {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\^{}"}
ZERO = r"\cdot"


def tex(node: Node) -> str:
    """The formula, without math delimiters."""
    match node:
        case Letter(name):
            return f"{_GREEK[name]} " if name in _GREEK else name if len(name) == 1 else rf"\mathrm{{{name}}}"
        case FunctionName(name):
            return f"\\{name} "
        case Number(digits, exponent):
            return number(digits, exponent)
        case Operator(sign):
            return _SIGNS.get(sign, sign)
        case Words(text):
            return rf"\text{{{escape(text)}}}" if text.strip() else r"\quad "
        case Row(items):
            return "".join(tex(i) for i in items)
        case Script(base, sub, sup):
            low = "" if sub is None else f"_{{{tex(sub)}}}"
            high = "" if sup is None else f"^{{{tex(sup)}}}"
            return f"{{{tex(base)}}}{low}{high}"
        case Dots(base, count):
            return f"\\{'d' * count}ot{{{tex(base)}}}"
        case Fence(kind, body):
            left, right = _FENCES[kind]
            return f"{left}{tex(body)}{right}"
        case Fraction(above, below):
            return rf"\tfrac{{{tex(above)}}}{{{tex(below)}}}"
        case Grid(rows):
            lines = (" & ".join(ZERO if cell is None else tex(cell) for cell in cells) for cells in rows)
            return "\\begin{bmatrix}\n" + " \\\\\n".join(lines) + "\n\\end{bmatrix}"
        case BigSum(index):
            return rf"\sum_{{{tex(index)}}} "


def number(digits: str, exponent: int) -> str:
    """Digits with a power of ten."""
    return digits if exponent == 0 else rf"{digits}{{\cdot}}10^{{{exponent}}}"


def escape(text: str) -> str:
    """Running text."""
    return "".join(_SPECIAL.get(c, c) for c in text)
