"""The derivation for a person to read: one generic flywheel in symbols, then the numbers of the stand."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import sympy as sp
from markupsafe import Markup

from mahovik.core.derive import SYMMETRIC, carrier
from mahovik.core.derive.carrying import weight as derive_weight
from mahovik.core.derive.document import HEAD, Formula, Section, Table, held, number, numbers, sections, turns
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.program import lower_layout
from mahovik.core.lower.values import Values
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.hold import twists, words
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure
from mahovik.errors import library
from mahovik.out.report.page import Part, table_of

ROUNDING = 1e-14
"""Part of the natural size of its kind below which a number is rounding."""


def derivation_parts(stand: Stand) -> list[Part]:
    """Parts of the page. Raises UsageError: the library that makes MathML of LaTeX is missing."""
    convert = library("latex2mathml.converter", "report").convert

    def inline(tex: str, display: str = "inline") -> Markup:
        # in a group of its own a bracket is as high as its own matrix
        grouped = tex.replace(r"\begin{bmatrix}", r"{\begin{bmatrix}").replace(r"\end{bmatrix}", r"\end{bmatrix}}")
        return Markup(convert(grouped, display=display)) if tex else Markup("")

    def words_of(text: str) -> Markup:
        pieces = enumerate(text.split("$"))
        return Markup("").join(inline(piece) if i % 2 else Markup("{}").format(piece) for i, piece in pieces)

    def block(item: str | Formula | Table) -> Markup:
        if isinstance(item, str):
            return Markup("<p>{}</p>\n").format(words_of(item))
        if isinstance(item, Formula):
            return Markup('<div class="scroll formula"><div>{}</div><span>{}</span></div>\n').format(
                inline(item.tex, "block"), f"({item.number})" if item.number else ""
            )
        rows = [[inline(cell) for cell in row] for row in item.rows]
        heads = [cell if cell.isalpha() else inline(cell) for cell in item.head]
        return table_of(heads, rows, [False] * len(heads), item.caption)

    return [
        Part(f"{section.title} {section.equations}".strip(), html=Markup("").join(map(block, section.blocks)))
        for section in document(stand)
    ]


def document(stand: Stand) -> list[Section]:
    """All sections: those of any stand of this structure, then its numbers. Raises StandError."""
    form = structure(stand)
    displaces = bool(form.law("buoyancy") or form.law("flywheel_buoyancy"))
    weight = derive_weight(displaces) if form.weight else None
    general = sections(stand.angles, added_mass=form.added_mass, weight=weight, displaces=displaces)
    layout = Layout(form, DOUBLE)
    made = Values(stand, layout, lower_layout(layout)).table
    rows = made.get("flywheel", [])
    constant: dict[str, Any] = {
        name: np.asarray(made[name]) for name in ("mass", "first_moment", "inertia", "A", "G") if name in made
    }
    at_zero = dict(constant)
    for row in rows:
        at_zero["first_moment"] = at_zero["first_moment"] + row["mu_c"]
        at_zero["inertia"] = at_zero["inertia"] + row["J_c"] + row["J_2c"]
    K, K_constant = _mass_matrix(at_zero), _mass_matrix(constant)
    size = np.repeat([np.sqrt(np.abs(K[:3, :3]).max()), np.sqrt(np.abs(K[3:, 3:]).max())], 3)
    noise = ROUNDING * np.outer(size, size)
    matrices = Section(
        "Numbers: mass matrix",
        "(2)",
        (
            r"In axes of $E_1$ about $O_1$, in kg, off the diagonal blocks in kg m, lower right in kg m$^2$. At "
            r"$\varphi = 0$ of all flywheels:",
            Formula(f"K = {numbers(K, noise)}"),
            "The constant part: carrier, instruments, added mass and the column of 1 of every flywheel.",
            Formula(f"K_c = {numbers(K_constant, noise)}"),
        ),
    )
    tables: list[str | Formula | Table] = [
        r"Each row is a polynomial, the sum of its cells times the heads of the columns, in axes of $E_1$ about $O_1$: "
        r"first moment $\mu$ in kg m, inertia $J$ and moment part $t$ of $I_s$ in kg m$^2$. The column of 1 of $\mu$ "
        "and $J$ is in $K_c$."
    ]
    for wheel, row in zip(stand.flywheels, rows, strict=True):
        caption = f"{wheel.name} on {wheel.mount}: mass {wheel.mass:.6g} kg, about its axis {row['spin']:.6g} kg m2"
        tables.append(Table(caption, ("", *HEAD), tuple(_harmonics(row, size[0] * size[5], size[5] ** 2))))
    result = [*general, matrices, *([Section("Numbers: flywheels", "(2), (9)", tuple(tables))] if rows else [])]
    if stand.hold is not None:
        S = twists(stand.hold)
        projected = Formula(f"S^T K S = {numbers(S.T @ K @ S, np.abs(S).T @ noise @ np.abs(S))}")
        shown = (*held(), Formula(f"S = {numbers(S, 0.0 * S)}"), projected) if S.shape[1] else ()
        result.append(Section("Hold", "(8)", (f"{words(stand.hold)}.", *shown)))
    sequence = (
        f"Attitude sequence {stand.angles}: $C = {turns(stand.angles)}$. Mass of the whole {made['mass']:.6g} kg."
    )
    return [Section(result[0].title, result[0].equations, (sequence, *result[0].blocks)), *result[1:]]


def _mass_matrix(sums: Mapping[str, Any]) -> Any:
    """K of (2) filled with numbers."""
    known: dict[sp.Symbol, float] = {sp.Symbol("m"): float(sums["mass"])}
    for name, key in {"mu": "first_moment", "J": "inertia", "A": "A", "G": "G"}.items():
        known |= {sp.Symbol(f"{name}[{i}]"): float(x) for i, x in enumerate(sums.get(key, ()))}
    return np.array(carrier.mass_matrix("A" in sums).xreplace(known).tolist(), dtype=float)


def _harmonics(row: Mapping[str, Any], moment: float, inertia: float) -> Iterable[tuple[str, ...]]:
    """Cells of a flywheel's row of constants: mu, J and t by harmonics; natural sizes of a first moment, of inertia."""
    moments = ["".join(str(k + 1) for k in pair) for pair in SYMMETRIC]
    for name, indices, harmonics in (
        ("mu", "123", ("", "c", "s", "", "")),
        ("J", moments, ("", "c", "s", "2c", "2s")),
        ("t", "123", ("0", "c", "s", "", "")),
    ):
        columns = [np.asarray(row[f"{name}_{k}"]) if k else None for k in harmonics]
        noise = ROUNDING * (moment if name == "mu" else inertia)
        letter = r"\mu" if name == "mu" else name
        for i, index in enumerate(indices):
            yield f"{letter}_{{{index}}}", *("" if c is None else number(float(c[i]), noise) for c in columns)
