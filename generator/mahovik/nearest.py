"""Names that a user gives: between commas; of an unknown one the most similar known name, or a list of those."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from mahovik.errors import UsageError

ALIKE = 0.5
"""Minimum similarity (0 to 1) for a suggestion; below it the known names are listed."""

LISTED = 24
"""Most names in that list; dots stand for the rest."""


def names_in(argument: str, listed: str | Iterable[str], alone: Collection[str] = ()) -> tuple[str, ...]:
    """Names, each once: those between the commas of a text. `alone`: words that stand for names, without others.

    Raises UsageError, which begins with the name of the argument.
    """
    names = tuple(dict.fromkeys(name.strip() for name in (listed.split(",") if isinstance(listed, str) else listed)))
    if "" in names:
        raise UsageError(f'{argument} "{",".join(names)}": a name is empty, expected names with commas between them')
    for word in alone:
        if word in names and len(names) > 1:
            raise UsageError(f"{argument} {','.join(names)}: expected {word} alone, or names without it")
    return names


def nearest(name: str, known: Iterable[str]) -> str:
    """The known name most like `name`, the first of equals. Raises ValueError where none is known."""
    return max(known, key=lambda candidate: _likeness(name, candidate))


def nearest_name(name: object, known: Iterable[str], alike: float = ALIKE) -> str | None:
    """The known name that may be meant; None if none is similar."""
    names = list(known)
    if isinstance(name, str) and name and names:
        best = nearest(name, names)
        if _likeness(name, best) >= alike:
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
