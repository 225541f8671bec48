"""The freedoms of a hold in the program: columns of S with the zeros and ones that are known by what a freedom is.

A turn about an axis of E1 through the pivot is (pivot x e, e), a slide (e, 0). Numbers of S stay in the table.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.program.vector import Vector, dot
from mahovik.core.stand.hold import FREEDOMS

TURNS = ("roll", "pitch", "yaw")


def columns(ways: Sequence[str], table: Any) -> list[Vector]:
    """The columns of S of freedoms that are `ways`, names of FREEDOMS or turn, slide, twist.

    0 and 1 are numbers of Python where they are so for any stand of the structure.
    """
    return [Vector(_column(way, table.S[:, k])) for k, way in enumerate(ways)]


def rows_of(ways: Sequence[str]) -> tuple[int, ...]:
    """Components of a wrench that S^T takes from it, for any numbers of a stand."""
    return tuple(i for i in range(6) if any(_column(way, [2] * 6)[i] for way in ways))


def _column(way: str, whole: Sequence[Any]) -> Sequence[Any]:
    if way not in FREEDOMS:
        return [*whole[:3], 0, 0, 0] if way == "slide" else whole
    axis = [int(x) for x in FREEDOMS[way].direction]
    if FREEDOMS[way].kind == "slide":
        return [*axis, 0, 0, 0]
    return [*(0 if on else x for on, x in zip(axis, whole[:3], strict=True)), *axis]


def speeds(ways: Sequence[str], S: Sequence[Vector], V: Any) -> list[Any]:
    """u of V = S u, for freedoms that `are_closed`."""
    if len(ways) == 1 and ways[0] not in FREEDOMS:
        half = slice(0, 3) if ways[0] == "slide" else slice(3, 6)
        return [dot(S[0][half], V[half])]
    axes = [FREEDOMS[way].direction.index(1.0) for way in ways]
    turning = {k: V[3 + axes[k]] for k, way in enumerate(ways) if way in TURNS}
    rates: list[Any] = []
    for k, axis in enumerate(axes):  # what slides is what the turning does not give
        arms = [S[j][axis] for j in turning]
        rates.append(turning[k] if k in turning else dot((1, *[-x for x in arms]), (V[axis], *turning.values())))
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
    brackets = (bracket(one, other) for one in ways for other in ways)
    return all(pair is None or pair[0] in ways for pair in brackets)


def turning_force(ways: Sequence[str], u: Any, momentum: Mapping[str, Any]) -> list[Any]:
    """-S_k . Phi(V) Z (m) of freedoms that `are_closed`, by the momenta S^T Z; 0 where there is none.

    S_k . Phi(V) Z = -Z . (V x S_k), and V x S_k is the sum of u_j [S_j, S_k].
    """
    forces = []
    for way in ways:
        brackets = [(u[j], pair) for j, one in enumerate(ways) if (pair := _bracket_of(ways, one, way))]
        forces.append(dot([sign for _, (_, sign) in brackets], [rate * momentum[name] for rate, (name, _) in brackets]))
    return forces


def _bracket_of(ways: Sequence[str], one: str, other: str) -> tuple[str, int] | None:
    """The bracket of two freedoms; that of one alone with itself is zero, named or not."""
    return bracket(one, other) if len(ways) > 1 else None


def momenta_needed(ways: Sequence[str]) -> list[str]:
    """Freedoms whose momenta enter `turning_force`."""
    if len(ways) == 1:
        return []
    needed = {pair[0] for one in ways for other in ways if (pair := bracket(one, other))}
    return [way for way in ways if way in needed]


def slides(way: str) -> bool:
    """Whether a freedom that is `closed` slides; else it turns."""
    return way == "slide" or way in "xyz"


def harmonics(ways: Sequence[str]) -> list[tuple[str, ...]]:
    """Names of the harmonics that elements of S^T K S have, in their order: by J those of two turns, by mu of one."""
    of_turns: tuple[tuple[str, ...], ...] = ((), ("c", "s"), ("2c", "2s", "c", "s"))
    pairs = [(one, other) for i, one in enumerate(ways) for other in ways[: i + 1]]
    return [of_turns[2 - slides(one) - slides(other)] for one, other in pairs]


def place_of(i: int, j: int) -> int:
    """Where element (i, j), j <= i, of a symmetric matrix of the freedoms is stored: row by row."""
    return i * (i + 1) // 2 + j


def element(P: Any, i: int, j: int) -> Any:
    """Element (i, j) of such a matrix."""
    return P[place_of(max(i, j), min(i, j))]


# Coordinates. What slides has the way of the pivot along an axis of the home pose, what turns about one axis an angle.
# All three turns have no three coordinates without a singular attitude: they have a quaternion, and as rates their
# angular velocity.

_WORDS = {
    "slide": "way along the direction",
    "turn": "angle about the axis",
    **{way: f"way of the pivot along {way} of the home pose" for way in "xyz"},
    **{way: f"angle of {way}" for way in TURNS},
}


def turns_about_point(ways: Sequence[str]) -> bool:
    """Whether all three turns are free."""
    return all(way in ways for way in TURNS)


def scalar_coordinates(ways: Sequence[str]) -> tuple[str, ...]:
    """Freedoms with a number of their own among the coordinates: all but turns about a point."""
    return tuple(way for way in ways if not (turns_about_point(ways) and way in TURNS))


def turns_slides(ways: Sequence[str]) -> bool:
    """Whether some freedom turns the direction of one that slides, so that rates of coordinates are not u."""
    slides = [way for way in ways if way in "xyz"]
    turns = [way for way in ways if way in TURNS]
    return any(FREEDOMS[slide].direction != FREEDOMS[turn].direction for slide in slides for turn in turns)


def in_words(ways: Sequence[str]) -> str:
    """The numbers q in words."""
    return ", ".join(_WORDS[way] for way in scalar_coordinates(ways)) + "; zero in the home pose"


def rates_in_words(ways: Sequence[str]) -> str:
    """The numbers q_dot in words."""
    if turns_about_point(ways):
        return "rates in the order of the freedoms; of the turns the angular velocity in E1"
    return "rates of q, in the order of the freedoms"


def coordinates_struct(ways: Sequence[str]) -> Struct:
    """Coordinates of freedoms that are closed, with their rates."""
    fields = []
    if scalars := scalar_coordinates(ways):
        fields.append(
            Field("q", Kind.REAL, (len(scalars),), "m, rad", in_words(ways) + ", an angle within half a turn")
        )
    if turns_about_point(ways):
        text = "attitude from the home pose, quaternion, w first and not negative"
        fields.append(Field("orientation", Kind.REAL, (4,), "", text))
    fields.append(Field("q_dot", Kind.REAL, (len(ways),), "m/s, rad/s", rates_in_words(ways)))
    fields.append(Field("q_ddot", Kind.REAL, (len(ways),), "m/s2, rad/s2", "rates of q_dot, for the given phi_ddot"))
    return Struct("generalized_result", "Coordinates of the freedoms of the hold.", tuple(fields))
