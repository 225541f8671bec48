"""`[[hold.stop]]` of a stand file."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Annotated, Any

from mahovik.core.stand.fields import Table, Text, require_bounds, text, validator
from mahovik.core.stand.hold import coordinate_problem, find_freedom, freedom_names
from mahovik.core.stand.law import LawSchema, Note, TablesByKey
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.toml import fields, line_of
from mahovik.core.stand.units import Dimension, QuantityError, number, show
from mahovik.laws.stop.data import Stop, Stops, highest_and_lowest
from mahovik.laws.stop.units import FORCES

LARGEST_ANGLE = math.radians(170.0)
"""rad: an angle counts to half a turn, where it begins again; a stop nearer to it could be passed."""


def _side(raw: Any) -> bool:
    if text(raw) not in ("above", "below"):
        raise QuantityError(f'expected "above" or "below" (where the coordinate may not go), found {show(raw)}')
    return bool(raw == "above")


class StopTable(Table):
    """One `[[hold.stop]]`; the units of its numbers are those of the freedom."""

    freedom: Text | None = None
    at: Any
    side: Annotated[bool | None, validator(_side)] = None
    stiffness: Any
    damping: Any = 0


def read(header: None, given: TablesByKey) -> Stops | None:
    """None: without a hold there is none."""
    return None


def read_held(given: TablesByKey, hold: Hold, note: Note) -> Stops | None:
    """The stops of the freedoms."""
    found = []
    for k, table in enumerate(given["stop"]):
        stop = _stop(table, hold, lambda *words, k=k: note(f"stop[{k}]", *words))
        if stop is not None:
            found.append(stop)
    if len(found) == len(given["stop"]):
        for freedom in dict.fromkeys(stop.freedom for stop in found):
            if (problem := _range_problem([stop for stop in found if stop.freedom == freedom], hold)) is not None:
                note("stop", problem)
    return Stops(tuple(found)) if found else None


def _range_problem(stops: list[Stop], hold: Hold) -> str | None:
    """Problem of the range that the stops of one freedom leave to its coordinate; None where it is in order."""
    name, kind = stops[0].name, hold.freedoms[stops[0].freedom].kind
    highest, lowest = highest_and_lowest(stops)
    if kind == "turn" and math.isinf(highest - lowest):
        given, missing = ("above", "below") if math.isinf(lowest) else ("below", "above")
        return (
            f'only side = "{given}" of {name} has a stop: turning the other way it would be met from behind, half a '
            f'turn from home, where the angle begins again; expected one of side = "{missing}" too'
        )
    if lowest > highest:
        unit = FORCES[kind][0].si
        return (
            f"{name} may not go above {highest:.6g} {unit}, nor below {lowest:.6g} {unit}: nothing is left between; "
            "expected the stop below under the one above"
        )
    return None


def _stop(table: StopTable, hold: Hold, note: Note) -> Stop | None:
    try:
        freedom = find_freedom(hold, table.freedom)
    except QuantityError as error:
        note("freedom", str(error))
        return None
    if (problem := coordinate_problem(hold, freedom)) is not None:
        note("freedom", f"{problem}: there is no stop for it")
        return None
    kind = hold.freedoms[freedom].kind
    place, spring, damper = FORCES[kind]
    numbers = {
        "at": _number(note, "at", table.at, place),
        "stiffness": _number(note, "stiffness", table.stiffness, spring, above=0.0),
        "damping": _number(note, "damping", table.damping, damper, least=0.0),
    }
    if None in numbers.values():
        return None
    at, stiffness, damping = (float(x or 0.0) for x in numbers.values())
    if kind == "turn" and abs(at) > LARGEST_ANGLE:
        note("at", f"{at:.6g} rad is more than 170 deg: an angle begins again at half a turn")
        return None
    if table.side is None and at == 0.0:
        note("side", 'required where `at` is zero, expected "above" or "below" (where the coordinate may not go)')
        return None
    above = at > 0.0 if table.side is None else table.side
    return Stop(freedom, freedom_names(hold)[freedom], at, above, stiffness, damping)


def _number(note: Note, key: str, raw: Any, dimension: Dimension, **bounds: float) -> float | None:
    """A number of the table in SI; None where it is, which is noted, not in order."""
    try:
        return require_bounds(number(raw, dimension), dimension.si, **bounds, raw=raw)
    except QuantityError as error:
        note(key, str(error))
        return None


def lines(law: Stops) -> tuple[list[str], list[str]]:
    """One table per stop."""
    found = []
    for stop in law.stops:
        side = line_of("side", "above" if stop.above else "below")
        own = [f'freedom = "{stop.name}"', *fields(stop, "at"), side, *fields(stop, "stiffness", "damping")]
        found += ["", "[[hold.stop]]", *own]
    return [], found


def content(law: Stops | None) -> dict[str, Any]:
    """All numbers; nothing without stops, so that other stands keep their identities."""
    return {} if law is None else asdict(law)


def structure(law: Stops | None, stand: Stand) -> dict[str, Any]:
    """How many stops there are of what slides, and of what turns."""
    if law is None or stand.hold is None:
        return {}
    kinds = [stand.hold.freedoms[stop.freedom].kind for stop in law.stops]
    return {"slide_stops": kinds.count("slide"), "turn_stops": kinds.count("turn")}


def dimension_of(key: str, table: StopTable, hold: Hold) -> Dimension | None:
    """Dimension of a number of the table, by the kind of its freedom."""
    found = FORCES[hold.freedoms[find_freedom(hold, table.freedom)].kind]
    return dict(zip(("at", "stiffness", "damping"), found, strict=True)).get(key)


SCHEMA = LawSchema(
    Stops, read, lines, content, structure, held={"stop": StopTable}, read_held=read_held, dimension_of=dimension_of
)
