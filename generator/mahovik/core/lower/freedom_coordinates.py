"""Coordinates of the freedoms of a hold, and the struct that has them.

What slides has the way of the pivot along an axis of the home pose, what turns about one axis an angle. All three turns
have no three coordinates without a singular attitude: they have a quaternion, and as rates their angular velocity.
"""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.core.lower.freedoms import TURNS
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.hold import FREEDOMS

REAL = Kind.REAL

_WORDS = {
    "slide": "way along the direction",
    "turn": "angle about the axis",
    **{way: f"way of the pivot along {way} of the home pose" for way in "xyz"},
    **{way: f"angle of {way}" for way in TURNS},
}


def turns_about_point(ways: Sequence[str]) -> bool:
    """Whether all three turns are free."""
    return all(way in ways for way in TURNS)


def own_coordinates(ways: Sequence[str]) -> tuple[str, ...]:
    """Freedoms with a number of their own among the coordinates: all but turns about a point."""
    return tuple(way for way in ways if not (turns_about_point(ways) and way in TURNS))


def turns_slides(ways: Sequence[str]) -> bool:
    """Whether some freedom turns the direction of one that slides, so that rates of coordinates are not u."""
    slides = [way for way in ways if way in "xyz"]
    turns = [way for way in ways if way in TURNS]
    return any(FREEDOMS[slide].direction != FREEDOMS[turn].direction for slide in slides for turn in turns)


def in_words(ways: Sequence[str]) -> str:
    """The numbers q in words."""
    return ", ".join(_WORDS[way] for way in own_coordinates(ways)) + "; zero in the home pose"


def rates_in_words(ways: Sequence[str]) -> str:
    """The numbers q_dot in words."""
    if turns_about_point(ways):
        return "rates in the order of the freedoms; of the turns the angular velocity in E1"
    return "rates of q, in the order of the freedoms"


def coordinates_struct(ways: Sequence[str]) -> Struct:
    """Coordinates of freedoms that are closed, with their rates."""
    fields = []
    if own := own_coordinates(ways):
        fields.append(Field("q", REAL, (len(own),), "m, rad", in_words(ways) + ", an angle within half a turn"))
    if turns_about_point(ways):
        text = "attitude from the home pose, quaternion, w first and not negative"
        fields.append(Field("orientation", REAL, (4,), "", text))
    fields.append(Field("q_dot", REAL, (len(ways),), "m/s, rad/s", rates_in_words(ways)))
    fields.append(Field("q_ddot", REAL, (len(ways),), "m/s2, rad/s2", "rates of q_dot, for the given phi_ddot"))
    return Struct("generalized_result", "Coordinates of the freedoms of the hold.", tuple(fields))
