"""`[[hold.friction]]` of a stand file."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from mahovik.core.stand.fields import Table, Text, require_bounds
from mahovik.core.stand.hold import find_freedom, freedom_names
from mahovik.core.stand.law import LawSchema, Note, TablesByKey
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.toml import fields
from mahovik.core.stand.units import Dimension, QuantityError, number
from mahovik.laws.friction.data import Friction, Frictions
from mahovik.laws.friction.units import FORCES

SMOOTHING = 1e-2
"""m/s or rad/s: default of `smoothing`."""

_SMALLEST, _LARGEST = 1e-9, 1e6
"""m/s or rad/s: their squares are far from the ends of a float."""


class FrictionTable(Table):
    """One `[[hold.friction]]`; the units of its numbers are those of the freedom."""

    freedom: Text | None = None
    viscous: Any = None
    coulomb: Any = None
    breakaway: Any = None
    stribeck_speed: Any = None
    smoothing: Any = None


def read(header: None, given: TablesByKey) -> Frictions | None:
    """None: without a hold there is none."""
    return None


def read_held(given: TablesByKey, hold: Hold, note: Note) -> Frictions | None:
    """The frictions of the freedoms; tables of zeros do nothing."""
    found: list[Friction] = []
    for k, table in enumerate(given["friction"]):
        friction = _friction(table, hold, lambda *words, k=k: note(f"friction[{k}]", *words))
        if friction is None:
            continue
        if any(other.freedom == friction.freedom for other in found):
            note(
                f"friction[{k}]",
                "freedom",
                f"{friction.name} has friction already: expected one table for each freedom",
            )
        found.append(friction)
    kept = tuple(friction for friction in found if friction.viscous or friction.breakaway)
    return Frictions(kept) if kept else None


def _friction(table: FrictionTable, hold: Hold, note: Note) -> Friction | None:
    try:
        freedom = find_freedom(hold, table.freedom)
    except QuantityError as error:
        note("freedom", str(error))
        return None
    viscous, force, speed = FORCES[hold.freedoms[freedom].kind]
    bounds = {"above": 0.0, "least": _SMALLEST, "most": _LARGEST}
    numbers = {
        "viscous": _number(note, "viscous", table.viscous, viscous, least=0.0),
        "coulomb": _number(note, "coulomb", table.coulomb, force, least=0.0),
        "breakaway": _number(note, "breakaway", table.breakaway, force, least=0.0),
        "stribeck_speed": _number(note, "stribeck_speed", table.stribeck_speed, speed, **bounds),
        "smoothing": _number(note, "smoothing", table.smoothing, speed, **bounds),
    }
    if any(getattr(table, key) is not None and value is None for key, value in numbers.items()):
        return None
    coulomb, breakaway, stribeck = (numbers[key] or 0.0 for key in ("coulomb", "breakaway", "stribeck_speed"))
    smoothing = numbers["smoothing"] or SMOOTHING
    if numbers["breakaway"] is None:
        breakaway = coulomb
    if problem := _problem(table, coulomb, breakaway, stribeck, smoothing, speed.si):
        note(*problem)
        return None
    rise = stribeck if breakaway > coulomb else None
    name = freedom_names(hold)[freedom]
    return Friction(freedom, name, numbers["viscous"] or 0.0, coulomb, breakaway, rise, smoothing)


def _number(note: Note, key: str, raw: Any, dimension: Dimension, **bounds: float) -> float | None:
    """A number of the table in SI; None where it is missing or, which is noted, not in order."""
    if raw is None:
        return None
    try:
        return require_bounds(number(raw, dimension), dimension.si, **bounds, raw=raw)
    except QuantityError as error:
        note(key, str(error))
        return None


def _problem(
    table: FrictionTable, coulomb: float, breakaway: float, stribeck: float, smoothing: float, unit: str
) -> tuple[str, str] | None:
    """Key and words of what several keys tell together."""
    if table.viscous is None and table.coulomb is None and table.breakaway is None:
        return "viscous", "none of viscous, coulomb and breakaway is given: this is no friction, expected one of them"
    if breakaway < coulomb:
        return "breakaway", f"{breakaway:g} is below coulomb, {coulomb:g}: friction rises towards low speed"
    if breakaway > coulomb and table.stribeck_speed is None:
        return "stribeck_speed", "required with breakaway (the speed at which half of the rise is left), but missing"
    if table.stribeck_speed is not None and table.breakaway is None:
        return "breakaway", "required with stribeck_speed, but missing"
    if breakaway > coulomb and stribeck <= smoothing:
        found = f"{stribeck:g} {unit} is not above smoothing, {smoothing:g} {unit}"
        return "stribeck_speed", f"{found}: the smoothed sign would hide the rise"
    return None


def lines(law: Frictions) -> tuple[list[str], list[str]]:
    """One table per freedom."""
    found = []
    for friction in law.frictions:
        keys = ["viscous", "coulomb", "smoothing"]
        keys += ["breakaway", "stribeck_speed"] if friction.stribeck_speed is not None else []
        found += ["", "[[hold.friction]]", f'freedom = "{friction.name}"', *fields(friction, *keys)]
    return [], found


def content(law: Frictions | None) -> dict[str, Any]:
    """All numbers; nothing without friction, so that other stands keep their identities."""
    return {} if law is None else asdict(law)


def structure(law: Frictions | None, stand: Stand) -> dict[str, Any]:
    """How many freedoms have friction."""
    return {} if law is None else {"frictions": len(law.frictions)}


def dimension_of(key: str, table: FrictionTable, hold: Hold) -> Dimension | None:
    """Dimension of a number of the table, by the kind of its freedom."""
    viscous, force, speed = FORCES[hold.freedoms[find_freedom(hold, table.freedom)].kind]
    numbers = {"viscous": viscous, "coulomb": force, "breakaway": force, "stribeck_speed": speed, "smoothing": speed}
    return numbers.get(key)


SCHEMA = LawSchema(
    Frictions, read, lines, content, structure, held={"friction": FrictionTable}, read_held=read_held,
    dimension_of=dimension_of,
)  # fmt: skip
