"""The page (HTML) and the article (LaTeX): content from derive/ and numbers, order from the templates."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from html import escape
from typing import Any

from markupsafe import Markup

from mahovik import __version__
from mahovik.core.derive.attitude import ANGLES
from mahovik.core.derive.document import Part, sections
from mahovik.core.derive.document.flywheel import HEAD
from mahovik.core.derive.order import SEQUENCES
from mahovik.core.derive.wrench import weight as derive_weight
from mahovik.core.emit.templates import template
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure
from mahovik.out.report.derivation.notation import Grid, Node, Number, Operator, Zero, attach_sign, row, tex_text
from mahovik.out.report.derivation.numbers import numbers
from mahovik.out.report.derivation.parse import parse
from mahovik.out.report.derivation.symbolic import notation

DIGITS = 6
"""Significant digits of the stand's numbers."""


def html(stand: Stand) -> str:
    """One page that renders offline in any browser."""
    return template("derive.html.j2").render(**_content(stand, _Html()))


def latex(stand: Stand) -> str:
    """An article that needs amsmath only."""
    return template("derive.tex.j2").render(**_content(stand, _Tex()))


class _Printer(ABC):
    """Functions that the templates call."""

    @abstractmethod
    def plain(self, text: str) -> str:
        """Text without notation."""

    @abstractmethod
    def inline(self, node: Node) -> str:
        """A formula within text or a table."""

    @abstractmethod
    def display(self, node: Node) -> str:
        """A formula on its own."""

    @abstractmethod
    def cell(self, value: float, noise: float = 0.0) -> str:
        """A number in a table; not above `noise` it is rounding."""

    def text(self, text: str) -> str:
        """A paragraph; notation between backticks."""
        pieces = re.split(r"`([^`]*)`", text)
        return self.plain("").join(self.inline(parse(p)) if i % 2 else self.plain(p) for i, p in enumerate(pieces))

    def math(self, part: Part) -> str:
        """A cell: notation or expression; nothing for no text, a faint mark for zero."""
        return "" if part == "" else self.inline(Zero() if part == 0 else _node(part))

    def head(self, name: str) -> str:
        """A heading of a table of symbols: a word, or notation."""
        return self.plain(name) if name.isalpha() else self.math(name)

    def formula(self, parts: tuple[Part, ...]) -> str:
        """A displayed equation."""
        return self.display(row(*map(_node, parts)))

    def matrix(self, name: str, rows: Any, noise: Any) -> str:
        """A displayed matrix of numbers."""
        cells = tuple(tuple(map(_number, *each)) for each in zip(rows, noise, strict=True))
        return self.display(row(parse(f"{name} ="), Grid(cells)))


class _Html(_Printer):
    """MathML in HTML; every text is marked as escaped here."""

    def plain(self, text: str) -> Markup:
        return Markup(escape(text))

    def inline(self, node: Node) -> Markup:
        return Markup('<span class="zero">0</span>' if node == Zero() else node.math())

    def display(self, node: Node) -> Markup:
        return Markup(node.math(display=True))

    def cell(self, value: float, noise: float = 0.0) -> Markup:
        if value == 0:
            return self.inline(Zero())
        if abs(value) <= noise:
            return Markup(f'<span class="zero" title="{value!r}">≈0</span>')
        return Markup(("−" if value < 0 else "") + significant(value).plain())


class _Tex(_Printer):
    """LaTeX; table cells are in math mode."""

    def plain(self, text: str) -> str:
        return tex_text(text)

    def inline(self, node: Node) -> str:
        return f"${node.tex()}$"

    def display(self, node: Node) -> str:
        return node.tex()

    def cell(self, value: float, noise: float = 0.0) -> str:
        return self.inline(_number(value, noise))


def significant(value: float) -> Number:
    """The size of a number to DIGITS significant digits."""
    digits, _, exponent = f"{abs(value):.{DIGITS}g}".partition("e")
    return Number(digits, int(exponent or 0))


def _number(value: float, noise: float) -> Node:
    if value == 0:
        return Zero()
    return row(Operator("≈"), Number("0")) if abs(value) <= noise else attach_sign(significant(value), value < 0)


def _node(part: Part) -> Node:
    """A part of a formula as notation."""
    return parse(part) if isinstance(part, str) else notation(part)


def _content(stand: Stand, printer: _Printer) -> dict[str, Any]:
    """Everything that the templates put in order, and how they print it."""
    form = structure(stand)
    displaces = bool(form.law("buoyancy") or form.law("flywheel_buoyancy"))
    weight = derive_weight(displaces) if form.weight else None
    found, identity = numbers(stand), identities(stand)
    turns = " ".join(f"C_{axis}({angle})" for axis, angle in zip(SEQUENCES[stand.angles], ANGLES, strict=True))
    return {
        "print": printer,
        "name": stand.name,
        "version": __version__,
        "structure": identity.structure,
        "physics": identity.physics,
        "bodies": _bodies(stand),
        "sequence": f"{stand.angles}, `C = {turns}`",
        "numbers": found,
        "sections": sections(stand.angles, added_mass=form.added_mass, weight=weight, displaces=displaces),
        "notes": _NOTES,
        "head": HEAD,
        "hold": _HOLD,
    }


_NOTES = {
    "K": (
        "In axes of `E_1` about `O_1`; upper left block in kg, off the diagonal in kg m, lower right block in "
        '`"kg m"^2`. At `phi = 0` of all flywheels:'
    ),
    "K_constant": (
        "The constant part, `K_c`: carrier, instruments, added mass and the column of 1 of every flywheel. "
        "At other phases the flywheels add `{0, -<mu>; <mu>, J}` of their other columns:"
    ),
    "flywheels": (
        "Each row is a polynomial: the sum of its cells times the heads of the columns, in axes of `E_1` about `O_1`. "
        "`K_s = {m E, -<mu>; <mu>, J}`, and with a prime for the derivative by the phase "
        "`K*_s = dot(phi) {0, -<mu'>; <mu'>, J'}`, where `mu'` is `(I_1, I_2, I_3)`; "
        "`J_s = Phi I_s + dot(phi) I'_s`. A faint zero or a dot is exactly zero; "
        "`≈ 0` is rounding, below `10^{-14}` of the natural size of its kind."
    ),
}


_HOLD = {
    "words": (
        "The carrier is held: it moves as `V = S u`, with `S` constant in `E_1`, and the hold exerts the wrench `R`, "
        "which has no power in any `u`:"
    ),
    "equation": 'K dot(V) + M V + sum_s (I_s ddot(phi)_s + J_s dot(phi)_s) - F = R , "  " S^T R = 0',
    "projected": "S^T K S dot(u) = S^T (F - M S u - sum_s (I_s ddot(phi)_s + J_s dot(phi)_s))",
    "clamped": "The carrier is clamped, `V = 0`, and the hold bears all of it:",
    "borne": "R = sum_s (I_s ddot(phi)_s + J_s dot(phi)_s) - F",
    "numbers": "`S`, in m/s and rad/s for one of `u`, and `S^T K S` at `phi = 0` of all flywheels:",
}
"""Text and equations of a held carrier, (8) without a stream."""


def _bodies(stand: Stand) -> str:
    """Number of bodies of each kind, in words."""
    counts = ((len(stand.instruments), "instrument"), (len(stand.flywheels), "flywheel"))
    return ", ".join(["carrier", *(f"{n} {noun}{'' if n == 1 else 's'}" for n, noun in counts)])
