"""Suggestions for an unknown name: the most similar known name, or a list of the known ones."""

from __future__ import annotations

from collections.abc import Iterable

ALIKE = 0.5
"""Minimum similarity (0 to 1) for a suggestion; below it the known names are listed."""

LISTED = 24
"""Most names in that list; dots stand for the rest."""


def nearest(name: str, known: Iterable[str]) -> str:
    """The known name most like `name`, the first of equals. Raises ValueError where none is known."""
    return max(known, key=lambda candidate: _likeness(name, candidate))


def nearest_name(name: object, known: Iterable[str]) -> str | None:
    """The known name that may be meant; None if none is similar."""
    names = list(known)
    if isinstance(name, str) and name and names:
        best = nearest(name, names)
        if _likeness(name, best) >= ALIKE:
            return best
    return None


def suggestion(name: object, known: Iterable[str], none: str = "there is none") -> str:
    """End of a message about an unknown name.

    `, did you mean "mass"?`; `, expected one of mass, inertia` if none is similar; `none` if no name is known.
    """
    names = list(known)
    if not names:
        return f": {none}"
    if (best := nearest_name(name, names)) is not None:
        return f', did you mean "{best}"?'
    return f", expected one of {', '.join(names[:LISTED])}{', ...' if len(names) > LISTED else ''}"


def _likeness(one: str, other: str) -> float:
    from difflib import SequenceMatcher  # only a message needs it

    return SequenceMatcher(None, one.lower(), other.lower()).ratio()
