"""A name that is not known: the known one that was meant, or all that there are."""

from __future__ import annotations

from collections.abc import Iterable

ALIKE = 0.4
"""Of 1: below this no name is meant, and all are told."""

LISTED = 24
"""Names that are told; after them dots."""


def nearest(name: str, known: Iterable[str]) -> str:
    """The known name most like `name`, the first of equals. Raises ValueError where none is known."""
    return max(known, key=lambda candidate: _likeness(name, candidate))


def alike(name: object, known: Iterable[str]) -> str | None:
    """The known name that may be meant; None where nothing is alike."""
    names = list(known)
    if isinstance(name, str) and name and names:
        best = nearest(name, names)
        if _likeness(name, best) >= ALIKE:
            return best
    return None


def meant(name: object, known: Iterable[str], none: str = "there is none") -> str:
    """How a message about an unknown name ends.

    `, did you mean "mass"?`; where nothing is alike `, expected one of mass, inertia`; where nothing is known `none`.
    """
    names = list(known)
    if not names:
        return f": {none}"
    if (best := alike(name, names)) is not None:
        return f', did you mean "{best}"?'
    return f", expected one of {', '.join(names[:LISTED])}{', ...' if len(names) > LISTED else ''}"


def _likeness(one: str, other: str) -> float:
    from difflib import SequenceMatcher  # only a message needs it

    return SequenceMatcher(None, one.lower(), other.lower()).ratio()
