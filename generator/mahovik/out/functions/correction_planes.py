"""Correction planes of flywheels, and the pieces that can be made in them: from texts and tables, or a TOML file.

    [all]                                          # flywheels without a table of their own
    positions = ["-10 mm", "10 mm"]
    pieces = { holes = 12, amounts = ["1 g", "2 g"], radii = ["30 mm"], remove = true }

`pieces` is one table for all planes of the flywheel, or a list with one for each, empty for any correction. Its keys
are those of `use.balance.choices`; amounts are masses, radii lengths. A flywheel may be a list of positions alone.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mahovik.core.stand.content import TABLE, content
from mahovik.core.stand.units import LENGTH, MASS, Dimension, show
from mahovik.errors import BalanceError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import Number, quantity
from mahovik.use.balance.by_model import Planes
from mahovik.use.balance.choices import Choice, read_choices

KEYS = ("positions", "pieces")
UNITS: Mapping[str, Dimension] = {"amounts": MASS, "radii": LENGTH}
"""Keys of pieces that have units."""

PlanesGiven = Mapping[str, Sequence[Number] | Mapping[str, Any]]


def load_planes(path: Path) -> dict[str, Any]:
    """Tables of a TOML file. Raises BalanceError."""
    try:
        return tomllib.loads(content(path, TABLE).decode("utf-8"))
    except OSError as error:
        raise BalanceError([f"{path}: {error.strerror or error}"]) from None
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise BalanceError([f"{path}: not TOML: {error}"]) from None


def read_planes(stand: Stand, given: PlanesGiven) -> dict[str, Planes]:
    """Planes by flywheel. Raises UsageError: a name or a number; BalanceError: pieces."""
    names = [each.name for each in stand.flywheels]
    found: dict[str, Planes] = {}
    for name, value in given.items():
        if name not in (*names, "all"):
            raise UsageError(f'planes: unknown flywheel "{name}"{suggestion(name, names, "the stand has none")}')
        planes = _planes(name, value)
        for each in names if name == "all" else [name]:
            if name != "all" or each not in given:
                found[each] = planes
    return found


def _planes(name: str, given: object) -> Planes:
    where = f"planes of {name}"
    table = given if isinstance(given, Mapping) else {"positions": given}
    for key in table:
        if key not in KEYS:
            raise UsageError(f"{where}: unknown key {show(key)}{suggestion(str(key), KEYS)}")
    values = table.get("positions", [0.0])
    if not isinstance(values, list | tuple):
        raise UsageError(f"{where}: expected a list of positions, found {values!r}")
    places = tuple(quantity(where, each, LENGTH) for each in values)
    if not places or len(set(places)) < len(places):
        raise UsageError(f"{where}: expected different positions, found {list(values)}")
    return Planes(places, _choices(where, table.get("pieces"), len(places)))


def _choices(where: str, given: object, count: int) -> tuple[Choice | None, ...]:
    """Choices of planes, amounts in kg and radii in m."""
    if given is None:
        return ()
    several = isinstance(given, list | tuple)
    tables = [_in_si(f"{where}: pieces", each) for each in (given if isinstance(given, list | tuple) else [given])]
    found, problems = read_choices(tables if several else tables[0], count)
    if problems:
        raise BalanceError([f"{where}: {key}: {words}" for key, words in problems])
    return found


def _in_si(where: str, given: object) -> object:
    """A table of pieces with its masses in kg and its lengths in m; None: any correction."""
    if not isinstance(given, Mapping):
        return given
    if not given:
        return None
    table = dict(given)
    if "radii" not in table:
        raise BalanceError([f'{where}: radii: missing; expected a list of lengths, such as ["30 mm"]'])
    for key, dimension in UNITS.items():
        if isinstance(table.get(key), list | tuple):
            table[key] = [quantity(f"{where}: {key}", each, dimension) for each in table[key]]
    return table
