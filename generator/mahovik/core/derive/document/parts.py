"""Parts of a document."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import sympy as sp

Part: TypeAlias = str | sp.Expr | sp.MatrixBase
"""Notation as text, or a SymPy object."""


@dataclass(frozen=True)
class Text:
    """A paragraph; notation between backticks."""

    text: str


@dataclass(frozen=True)
class Formula:
    """A displayed equation, its parts in a row; `number` of the paper, without parentheses."""

    parts: tuple[Part, ...]
    number: str = ""


@dataclass(frozen=True)
class Table:
    """Cells of notation or SymPy expressions under a head of notation; the first column names the row."""

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[Part, ...], ...]


Block: TypeAlias = Text | Formula | Table


@dataclass(frozen=True)
class Section:
    """A title, the paper's equations it is about, and blocks."""

    title: str
    equations: str
    blocks: tuple[Block, ...]
