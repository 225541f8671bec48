"""Mathematical notation as a tree. Every part prints itself as LaTeX with amsmath and as MathML Core.

MathML Core is what Chromium, Firefox and Safari render by themselves.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from html import escape

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
_FENCES = {
    "(": ("(", ")", "(", ")"),
    "[": ("[", "]", "[", "]"),
    "<": (r"\langle ", r"\rangle ", "⟨", "⟩"),
}
"""Left and right sign in LaTeX, then in MathML."""

_SIGNS = {"−": "-", "∗": "*", "′": r"\prime ", "≈": r"\approx ", "×": r"\times ", "·": r"\cdot "}
_SPACES = {"∗": ' lspace="0" rspace="0"', "′": ' lspace="0" rspace="0"'}
_SPACES["/"] = ' lspace="0.1em" rspace="0.1em" stretchy="false"'
_SPECIAL = {c: f"\\{c}" for c in "_&%$#{}"} | {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\^{}"}
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def tex_text(text: str) -> str:
    """Running text in LaTeX."""
    return "".join(_SPECIAL.get(c, c) for c in text)


class Node(ABC):
    """A part of a formula."""

    @abstractmethod
    def tex(self) -> str:
        """LaTeX without math delimiters."""

    @abstractmethod
    def mathml(self) -> str:
        """MathML elements, without the `math` element around them."""

    def element(self) -> str:
        """MathML as exactly one element."""
        return self.mathml()

    def math(self, display: bool = False) -> str:
        """A complete `math` element."""
        mode = ' display="block"' if display else ""
        return f"<math{mode}>{self.mathml()}</math>"


@dataclass(frozen=True)
class Letter(Node):
    """A name: a letter, a Greek letter by its English name, or an upright word."""

    name: str

    def tex(self) -> str:
        if self.name in GREEK:
            return "\\varphi " if self.name == "phi" else f"\\{self.name} "
        return self.name if len(self.name) == 1 else rf"\mathrm{{{self.name}}}"

    def mathml(self) -> str:
        return f"<mi>{GREEK.get(self.name, escape(self.name))}</mi>"


@dataclass(frozen=True)
class FunctionName(Node):
    """cos, sin: upright, with room before the argument."""

    name: str

    def tex(self) -> str:
        return f"\\{self.name} "

    def mathml(self) -> str:
        return f'<mi>{self.name}</mi><mspace width="0.17em"/>'

    def element(self) -> str:
        return f"<mrow>{self.mathml()}</mrow>"


@dataclass(frozen=True)
class Number(Node):
    """Digits without sign, and a power of ten where it is not 0."""

    digits: str
    exponent: int = 0

    def tex(self) -> str:
        return self.digits + (rf"{{\cdot}}10^{{{self.exponent}}}" if self.exponent else "")

    def plain(self) -> str:
        """Text outside formulas."""
        return self.digits + (f"·10{str(self.exponent).translate(_SUPERSCRIPT)}" if self.exponent else "")

    def mathml(self) -> str:
        return f"<mn>{self.plain()}</mn>"


@dataclass(frozen=True)
class Operator(Node):
    """One of + − = , · × /, a star or a prime."""

    sign: str

    def tex(self) -> str:
        return _SIGNS.get(self.sign, self.sign)

    def mathml(self) -> str:
        return f"<mo{_SPACES.get(self.sign, '')}>{self.sign}</mo>"


@dataclass(frozen=True)
class Words(Node):
    """Plain text within a formula; spaces only: a gap."""

    text: str

    def tex(self) -> str:
        return rf"\text{{{tex_text(self.text)}}}" if self.text.strip() else r"\quad "

    def mathml(self) -> str:
        if self.text.strip():
            return f"<mtext>{escape(self.text)}</mtext>"
        return f'<mspace width="{len(self.text) * 0.6:.2g}em"/>'


@dataclass(frozen=True)
class Row(Node):
    """Side by side."""

    items: tuple[Node, ...]

    def tex(self) -> str:
        return "".join(item.tex() for item in self.items)

    def mathml(self) -> str:
        return f"<mrow>{''.join(item.mathml() for item in self.items)}</mrow>"


@dataclass(frozen=True)
class Script(Node):
    """Subscript and superscript, at least one of them."""

    base: Node
    sub: Node | None = None
    sup: Node | None = None

    def tex(self) -> str:
        low = "" if self.sub is None else f"_{{{self.sub.tex()}}}"
        high = "" if self.sup is None else f"^{{{self.sup.tex()}}}"
        return f"{{{self.base.tex()}}}{low}{high}"

    def mathml(self) -> str:
        name = "m" + ("sub" if self.sub is not None else "") + ("sup" if self.sup is not None else "")
        scripts = "".join(each.element() for each in (self.sub, self.sup) if each is not None)
        return f"<{name}>{self.base.element()}{scripts}</{name}>"


@dataclass(frozen=True)
class Dots(Node):
    """One or two dots above: a rate."""

    base: Node
    count: int

    def tex(self) -> str:
        return f"\\{'d' * self.count}ot{{{self.base.tex()}}}"

    def mathml(self) -> str:
        # accent="true" would be right, but Chromium then sets the dots into the letter
        dots = f'<mo class="dots" stretchy="false">{"˙" if self.count == 1 else "¨"}</mo>'
        return f"<mover>{self.base.element()}{dots}</mover>"


@dataclass(frozen=True)
class Fence(Node):
    """Something between ( ), [ ] or angle brackets (cross-product matrix)."""

    kind: str
    body: Node

    def tex(self) -> str:
        left, right, _, _ = _FENCES[self.kind]
        return f"{left}{self.body.tex()}{right}"

    def mathml(self) -> str:
        left, right = (f'<mo stretchy="false">{sign}</mo>' for sign in _FENCES[self.kind][2:])
        return f"<mrow>{left}{self.body.mathml()}{right}</mrow>"


@dataclass(frozen=True)
class Fraction(Node):
    """Numerator over denominator."""

    above: Node
    below: Node

    def tex(self) -> str:
        return rf"\tfrac{{{self.above.tex()}}}{{{self.below.tex()}}}"

    def mathml(self) -> str:
        return f"<mfrac>{self.above.element()}{self.below.element()}</mfrac>"


@dataclass(frozen=True)
class Zero(Node):
    """A zero that should not catch the eye: an entry of a matrix."""

    def tex(self) -> str:
        return r"\cdot"

    def mathml(self) -> str:
        return '<mn class="zero">0</mn>'


@dataclass(frozen=True)
class Grid(Node):
    """A matrix in brackets."""

    rows: tuple[tuple[Node, ...], ...]

    def tex(self) -> str:
        lines = (" & ".join(cell.tex() for cell in cells) for cells in self.rows)
        return "\\begin{bmatrix}\n" + " \\\\\n".join(lines) + "\n\\end{bmatrix}"

    def mathml(self) -> str:
        rows = ("".join(f"<mtd>{cell.mathml()}</mtd>" for cell in cells) for cells in self.rows)
        lines = "".join(f"<mtr>{row}</mtr>" for row in rows)
        return f'<mtable class="matrix" displaystyle="true">{lines}</mtable>'


@dataclass(frozen=True)
class BigSum(Node):
    """A sum sign over an index."""

    index: Node

    def tex(self) -> str:
        return rf"\sum_{{{self.index.tex()}}} "

    def mathml(self) -> str:
        return f"<munder><mo>∑</mo>{self.index.element()}</munder>"


def row(*items: Node) -> Node:
    """Side by side; rows within are opened."""
    flat: list[Node] = []
    for item in items:
        flat.extend(item.items if isinstance(item, Row) else (item,))
    return flat[0] if len(flat) == 1 else Row(tuple(flat))


def attach_sign(node: Node, negative: bool) -> Node:
    """The node, after a minus sign if it is negative."""
    return row(Operator("−"), node) if negative else node
