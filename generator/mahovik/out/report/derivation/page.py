"""The page (HTML) and the article (LaTeX): content from derive/ and numbers, order from the templates."""

from __future__ import annotations

import re
from dataclasses import dataclass
from html import escape
from typing import Any, Protocol

from markupsafe import Markup

from mahovik import __version__
from mahovik.core.derive.attitude import ANGLES
from mahovik.core.derive.document import Block, Formula, Part, Section, Table, Text, sections
from mahovik.core.derive.document.flywheel import HEAD
from mahovik.core.derive.order import SEQUENCES
from mahovik.core.emit.templates import template
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure
from mahovik.out.report.derivation import mathml, tex
from mahovik.out.report.derivation.expression import notation
from mahovik.out.report.derivation.notation import Grid, Node, Number, Operator, row
from mahovik.out.report.derivation.numbers import FlywheelNumbers, numbers
from mahovik.out.report.derivation.parse import parse

DIGITS = 6
"""Significant digits of the stand's numbers."""


def html(stand: Stand) -> str:
    """One page that renders offline in any browser."""
    return template("derive.html.j2").render(**_content(stand, _Html()))


def latex(stand: Stand) -> str:
    """An article that needs amsmath only."""
    return template("derive.tex.j2").render(**_content(stand, _Tex()))


class _Printer(Protocol):
    """What differs between page and article."""

    def plain(self, text: str) -> Any:
        """Text without notation."""

    def inline(self, node: Node) -> Any:
        """A formula within text or a table."""

    def display(self, node: Node) -> Any:
        """A formula on its own."""

    def cell(self, value: float, noise: float) -> Any:
        """A number in a table."""

    def zero(self) -> Any:
        """An empty cell of a table of symbols."""

    def joined(self, parts: list[Any]) -> Any:
        """Parts of a paragraph."""


class _Html:
    """MathML in HTML; every text is marked as escaped here."""

    def plain(self, text: str) -> Markup:
        return Markup(escape(text))

    def inline(self, node: Node) -> Markup:
        return Markup(mathml.mathml(node))

    def display(self, node: Node) -> Markup:
        return Markup(mathml.mathml(node, display=True))

    def cell(self, value: float, noise: float) -> Markup:
        if value == 0:
            return self.zero()
        if abs(value) <= noise:
            return Markup(f'<span class="zero" title="{value!r}">≈0</span>')
        digits, exponent = significant(value)
        return Markup(("−" if value < 0 else "") + mathml.number(digits, exponent))

    def zero(self) -> Markup:
        return Markup('<span class="zero">0</span>')

    def joined(self, parts: list[Any]) -> Markup:
        return Markup("").join(parts)


class _Tex:
    """LaTeX; table cells are in math mode."""

    def plain(self, text: str) -> str:
        return tex.escape(text)

    def inline(self, node: Node) -> str:
        return f"${tex.tex(node)}$"

    def display(self, node: Node) -> str:
        return tex.tex(node)

    def cell(self, value: float, noise: float) -> str:
        if value == 0:
            return self.zero()
        if abs(value) <= noise:
            return r"$\approx 0$"
        digits, exponent = significant(value)
        return f"${'-' if value < 0 else ''}{tex.number(digits, exponent)}$"

    def zero(self) -> str:
        return f"${tex.ZERO}$"

    def joined(self, parts: list[Any]) -> str:
        return "".join(parts)


def significant(value: float) -> tuple[str, int]:
    """The size of a number to DIGITS significant digits, and its power of ten."""
    digits, _, exponent = f"{abs(value):.{DIGITS}g}".partition("e")
    return digits, int(exponent or 0)


@dataclass(frozen=True)
class _Writer:
    """Blocks of a document as data for the templates, in what a printer prints."""

    printer: _Printer

    def node(self, part: Part) -> Node:
        """A part of a formula as notation."""
        return parse(part) if isinstance(part, str) else notation(part)

    def text(self, text: str) -> Any:
        """A paragraph; notation between backticks."""
        pieces = re.split(r"`([^`]*)`", text)
        printed = [self.printer.inline(parse(p)) if i % 2 else self.printer.plain(p) for i, p in enumerate(pieces)]
        return self.printer.joined(printed)

    def math(self, part: Part) -> Any:
        """A cell: notation or expression; nothing for no text, a faint mark for zero."""
        if isinstance(part, str):
            return self.printer.inline(parse(part)) if part else ""
        return self.printer.zero() if part == 0 else self.printer.inline(notation(part))

    def block(self, block: Block) -> dict[str, Any]:
        """One block as data."""
        match block:
            case Text(text):
                return {"kind": "text", "text": self.text(text)}
            case Formula(parts, number):
                whole = row(*(self.node(p) for p in parts))
                return {"kind": "formula", "math": self.printer.display(whole), "number": number}
            case Table(caption, head, rows):
                return {
                    "kind": "table",
                    "caption": caption,
                    "head": [self.math(h) if not h.isalpha() else self.printer.plain(h) for h in head],
                    "rows": [[self.math(c) for c in cells] for cells in rows],
                }

    def section(self, section: Section) -> dict[str, Any]:
        """One section as data."""
        return {
            "title": section.title,
            "equations": section.equations,
            "blocks": [self.block(b) for b in section.blocks],
        }

    def matrix(self, name: str, rows: Any, noise: Any) -> Any:
        """A displayed matrix of numbers."""
        cells = [[_number(x, n) for x, n in zip(r, ns, strict=True)] for r, ns in zip(rows, noise, strict=True)]
        return self.printer.display(row(parse(f"{name} ="), Grid(tuple(tuple(r) for r in cells))))

    def flywheel(self, own: FlywheelNumbers, labels: dict[str, Any]) -> dict[str, Any]:
        """The table of one flywheel as data."""
        quantities = [
            {
                "unit": self.text(q.unit),
                "rows": [
                    {"label": labels[name], "cells": [self.printer.cell(x, q.noise) for x in values]}
                    for name, values in zip(q.labels, q.rows, strict=True)
                ],
            }
            for q in own.quantities
        ]
        return {
            "name": self.printer.plain(own.name),
            "mount": self.printer.plain(own.mount),
            "mass": self.printer.cell(own.mass, 0.0),
            "spin": self.printer.cell(own.spin, 0.0),
            "quantities": quantities,
        }


def _number(value: float, noise: float) -> Node | None:
    if value == 0:
        return None
    if abs(value) <= noise:
        return row(Operator("≈"), Number("0"))
    digits, exponent = significant(value)
    return row(Operator("−"), Number(digits, exponent)) if value < 0 else Number(digits, exponent)


def _content(stand: Stand, printer: _Printer) -> dict[str, Any]:
    """Everything that the templates put in order."""
    writer = _Writer(printer)
    form = structure(stand)
    buoyancy = form.buoyancy or bool(form.flywheel_buoyancy)
    symbolic = sections(stand.angles, added_mass=form.added_mass, weight=form.weight, buoyancy=buoyancy)
    found, identity = numbers(stand), identities(stand)
    names = {label for f in found.flywheels for q in f.quantities for label in q.labels}
    labels = {name: printer.inline(parse(name)) for name in sorted(names)}
    turns = " ".join(f"C_{axis}({angle})" for axis, angle in zip(SEQUENCES[stand.angles], ANGLES, strict=True))
    return {
        "name": printer.plain(stand.name),
        "version": __version__,
        "structure": identity.structure,
        "physics": identity.physics,
        "bodies": _bodies(stand),
        "sequence": writer.text(f"{stand.angles}, `C = {turns}`"),
        "mass": printer.cell(found.mass, 0.0),
        "sections": [writer.section(s) for s in symbolic],
        "K": writer.matrix("K", found.K_at_zero, found.noise),
        "K_constant": writer.matrix("K_c", found.K_constant, found.noise),
        "notes": {key: writer.text(text) for key, text in _NOTES.items()},
        "head": [writer.math(h) for h in HEAD],
        "flywheels": [writer.flywheel(f, labels) for f in found.flywheels],
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


def _bodies(stand: Stand) -> str:
    """How many of which."""
    counts = ((len(stand.instruments), "instrument"), (len(stand.flywheels), "flywheel"))
    return ", ".join(["carrier", *(f"{n} {noun}{'' if n == 1 else 's'}" for n, noun in counts)])
