"""The freedoms of a hold in the program: columns of S with the zeros and ones that are known by what a freedom is.

A turn about an axis of E1 through the pivot is (pivot x e, e), a slide (e, 0). Numbers of S stay in the table.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mahovik.core.program.expression import Expr, Place, real
from mahovik.core.stand.hold import FREEDOMS

Column = Sequence[Expr | int]
"""Six numbers of a column of S: an expression, or 0 or 1 where this is so for any stand of the structure."""

TURNS = ("roll", "pitch", "yaw")


def columns(ways: Sequence[str], table: Place) -> list[Column]:
    """The columns of S of freedoms that are `ways`, names of FREEDOMS or turn, slide, twist."""
    return [_column(way, [table.S[i][k] for i in range(6)]) for k, way in enumerate(ways)]


def _column(way: str, whole: list[Place]) -> Column:
    if way not in FREEDOMS:
        return [*whole[:3], 0, 0, 0] if way == "slide" else whole
    axis = [int(x) for x in FREEDOMS[way].direction]
    if FREEDOMS[way].kind == "slide":
        return [*axis, 0, 0, 0]
    return [*(0 if on else x for on, x in zip(axis, whole[:3], strict=True)), *axis]


def dot(column: Column, wrench: Sequence[Expr]) -> Expr:
    """A column of S times a wrench or a column of I: its power at u = 1."""
    terms = [w if one == 1 else one * w for one, w in zip(column, wrench, strict=True) if one != 0]
    total: Expr = terms[0]
    for term in terms[1:]:
        total = total + term
    return total


def twist(found: Sequence[Column], u: Place) -> list[Expr]:
    """S u (6)."""
    rows: list[Expr] = []
    for i in range(6):
        terms = [u[k] if each[i] == 1 else each[i] * u[k] for k, each in enumerate(found) if each[i] != 0]
        total: Expr = terms[0] if terms else real(0)
        for term in terms[1:]:
            total = total + term
        rows.append(total)
    return rows


def speeds(ways: Sequence[str], found: Sequence[Column], V: Place) -> list[Expr]:
    """u of V = S u, for freedoms that `are_closed`."""
    if len(ways) == 1 and ways[0] not in FREEDOMS:
        half = range(3) if ways[0] == "slide" else range(3, 6)
        return [found[0][half[0]] * V[half[0]] + found[0][half[1]] * V[half[1]] + found[0][half[2]] * V[half[2]]]
    axes = [FREEDOMS[way].direction.index(1.0) for way in ways]
    turning = {k: V[3 + axes[k]] for k, way in enumerate(ways) if way in TURNS}
    rates: list[Expr] = []
    for k, way in enumerate(ways):
        rate: Expr = V[axes[k]] if k not in turning else turning[k]
        if way not in TURNS:  # what slides is what the turning does not give
            for j, turn in turning.items():
                if found[j][axes[k]] != 0:
                    rate = rate - found[j][axes[k]] * turn
        rates.append(rate)
    return rates


def bracket(one: str, other: str) -> tuple[str, int] | None:
    """The freedom and sign that the bracket of two named freedoms is; None: zero."""
    slides = sum(FREEDOMS[way].kind == "slide" for way in (one, other))
    a, b = (FREEDOMS[way].direction.index(1.0) for way in (one, other))
    if a == b or slides == 2:
        return None
    names = TURNS if slides == 0 else ("x", "y", "z")
    return names[3 - a - b], 1 if (a + 1) % 3 == b else -1


def are_closed(ways: Sequence[str]) -> bool:
    """Whether the bracket of any two freedoms is one of them, to the last digit for any numbers of a stand."""
    if len(ways) == 1:
        return ways[0] != "twist"
    if not all(way in FREEDOMS for way in ways):
        return False
    found = (bracket(one, other) for one in ways for other in ways)
    return all(each is None or each[0] in ways for each in found)


def turning_force(ways: Sequence[str], u: Place, momentum: Mapping[str, Expr]) -> list[Expr | None]:
    """-S_k . Phi(V) Z (m) of freedoms that `are_closed`, by the momenta S^T Z; None where there is none.

    S_k . Phi(V) Z = -Z . (V x S_k), and V x S_k is the sum of u_j [S_j, S_k].
    """
    forces: list[Expr | None] = []
    for way in ways:
        found = [(j, each) for j, other in enumerate(ways) if (each := _bracket_of(ways, other, way))]
        total: Expr | None = None
        for j, (name, sign) in sorted(found, key=lambda one: -one[1][1]):
            term = u[j] * momentum[name]
            if total is None:
                total = term if sign > 0 else -term
            elif sign > 0:
                total = total + term
            else:
                total = total - term
        forces.append(total)
    return forces


def _bracket_of(ways: Sequence[str], one: str, other: str) -> tuple[str, int] | None:
    """The bracket of two freedoms; that of one alone with itself is zero, named or not."""
    return bracket(one, other) if len(ways) > 1 else None


def momenta_needed(ways: Sequence[str]) -> list[str]:
    """Freedoms whose momenta enter `turning_force`."""
    if len(ways) == 1:
        return []
    found = {each[0] for one in ways for other in ways if (each := bracket(one, other))}
    return [way for way in ways if way in found]


def place_of(i: int, j: int) -> int:
    """Where element (i, j), j <= i, of a symmetric matrix of the freedoms is stored: row by row."""
    return i * (i + 1) // 2 + j


def element(P: Place, i: int, j: int) -> Place:
    """Element (i, j) of such a matrix."""
    return P[place_of(max(i, j), min(i, j))]
