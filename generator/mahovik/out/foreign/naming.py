"""Names of other programs as names of a stand, which become C identifiers."""

from __future__ import annotations

import re

from mahovik.core.stand.fields import name_problem, stand_name_problem


class Names:
    """Gives each body and point a unique name that a stand file accepts."""

    def __init__(self) -> None:
        self._taken = {"carrier"}

    def name(self, given: str, fallback: str) -> str:
        """The name itself if valid; else its letters, digits and _, with a number if the name is taken."""
        plain = _identifier(given, fallback)
        if name_problem(plain) is not None:
            plain += "_"
        name, number = plain, 2
        while name in self._taken:
            name, number = f"{plain}_{number}", number + 1
        self._taken.add(name)
        return name


def stand_name(given: str) -> str:
    """The name of a model as the name of a stand."""
    plain = _identifier(given, "stand")
    if plain.startswith("_"):
        return f"stand{plain}"
    return f"{plain}_" if stand_name_problem(plain) is not None else plain


def _identifier(given: str, fallback: str) -> str:
    plain = re.sub(r"[^A-Za-z0-9_]+", "_", given).strip("_")[:60]
    if not plain:
        return fallback
    return f"_{plain}" if plain[0].isdigit() else plain
