"""Mathematical notation as a tree: what both printers, MathML and LaTeX, print."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True)
class Letter:
    """A name: a letter, a Greek letter by its English name, or an upright word."""

    name: str


@dataclass(frozen=True)
class FunctionName:
    """cos, sin: upright, with room before the argument."""

    name: str


@dataclass(frozen=True)
class Number:
    """Digits without sign, and a power of ten where it is not 0."""

    digits: str
    exponent: int = 0


@dataclass(frozen=True)
class Operator:
    """One of + − = , · × / and parentheses."""

    sign: str


@dataclass(frozen=True)
class Words:
    """Plain text within a formula; spaces only: a gap."""

    text: str


@dataclass(frozen=True)
class Row:
    """Side by side."""

    items: tuple[Node, ...]


@dataclass(frozen=True)
class Script:
    """Subscript and superscript."""

    base: Node
    sub: Node | None = None
    sup: Node | None = None


@dataclass(frozen=True)
class Dots:
    """One or two dots above: a rate."""

    base: Node
    count: int


@dataclass(frozen=True)
class Fence:
    """Something between ( ), [ ] or angle brackets (cross-product matrix)."""

    kind: str
    body: Node


@dataclass(frozen=True)
class Fraction:
    """Numerator over denominator."""

    above: Node
    below: Node


@dataclass(frozen=True)
class Grid:
    """A matrix in brackets; a zero entry is None."""

    rows: tuple[tuple[Node | None, ...], ...]


@dataclass(frozen=True)
class BigSum:
    """A sum sign over an index."""

    index: Node


Node: TypeAlias = (
    Letter | FunctionName | Number | Operator | Words | Row | Script | Dots | Fence | Fraction | Grid | BigSum
)


def row(*items: Node) -> Node:
    """Side by side; rows within are opened."""
    flat: list[Node] = []
    for item in items:
        flat.extend(item.items if isinstance(item, Row) else (item,))
    return flat[0] if len(flat) == 1 else Row(tuple(flat))
