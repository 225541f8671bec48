"""Flywheels side by side: blocks of rows whose innermost loops run over lanes, which compilers turn into vectors.

The number of lanes is fixed at generation, each lane has sums of its own, and they are added in a fixed tree: any
compiler and processor, with vectors or without, gets the same bits.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, integer, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, Struct


def first_argument() -> Argument:
    """Number of the first flywheel of a block."""
    return Argument("first", Kind.INT, purpose="number of the block's first flywheel")


def room_argument(lib: Library, name: str, purpose: str = "", direction: str = "in", unit: str = "") -> Argument:
    """An array with a place for every lane of every block."""
    return Argument(name, Kind.REAL, (lib.layout.room,), direction, unit, purpose)


def lane(place: Place, k: Expr) -> list[Place]:
    """The elements of an array of a block in lane k."""
    return [element[k] for element in place]


def lane_columns(block: Place, k: Expr, names: Sequence[str]) -> dict[str, list[Place]]:
    """Columns of a block's rows in lane k."""
    return {name: lane(block.member(name), k) for name in names}


@contextmanager
def blocks(lib: Library, body: Body) -> Iterator[tuple[Place, Expr]]:
    """A loop over blocks: number of the block, number of its first flywheel."""
    with body.loop("b", lib.layout.blocks) as b:
        yield b, b * integer(lib.layout.lane_count)


def clear(lib: Library, name: str, struct: Struct) -> Function:
    """Set all sums of all lanes to zero."""
    sums = Argument("lane", struct, (), "out")
    body = Body()
    for field in struct.fields:
        with body.loop("i", field.shape[0]) as i, body.loop("k", lib.layout.lane_count) as k:
            body.set(sums.place.member(field.name)[i][k], real(0))
    return body.function(name, "Sets the sums of the lanes to zero.", (sums,))


def tree(parts: Sequence[Expr]) -> Expr:
    """The sum of the lanes: the upper half is added to the lower half until one is left."""
    while len(parts) > 1:
        half = len(parts) // 2
        parts = [low + high for low, high in zip(parts[:half], parts[half:], strict=True)]
    return parts[0]


def add_lanes(lib: Library) -> Function:
    """Sums over all bodies: those of the fixed ones, and those of the lanes."""
    layout = lib.layout
    table, parts = lib.table_argument(), Argument("lane", layout.lane_sums)
    sums = Argument("sum", layout.sums, (), "out")
    starts = {"mu": table.place.first_moment, "J": table.place.inertia}
    body = Body()
    totals = {f.name: halves(body, f"half_{f.name}", parts.place.member(f.name)) for f in layout.sums.fields}
    for name, total in totals.items():
        with body.loop("i", len(total)) as i:
            start = starts[name][i] if name in starts else real(0)
            body.set(sums.place.member(name)[i], start + tree(list(total[i])))
    purpose = "Sums of carrier, instruments and the constant part of the flywheels, and of the lanes, in a fixed tree."
    return body.function("add_lanes", purpose, (table, parts, sums), equation="(2)")


def halves(body: Body, name: str, parts: Place) -> Place:
    """The first step of the tree, for all rows at once: as vectors of half the lanes."""
    half = len(parts[0]) // 2
    if half <= 2:
        return parts
    sums = body.local(name, (len(parts), half))
    with body.loop("i", len(parts)) as i, body.loop("k", half) as k:
        body.set(sums[i][k], parts[i][k] + parts[i][k + half])
    return sums


def spread(lib: Library) -> Function:
    """An array of the flywheels with zeros beyond the last."""
    values = Argument("values", Kind.REAL, (lib.layout.count,))
    out = room_argument(lib, "out", direction="out")
    body = Body()
    with body.loop("s", lib.layout.count) as s:
        body.set(out.place[s], values.place[s])
    with body.loop("s", lib.layout.room, start=lib.layout.count) as s:
        body.set(out.place[s], real(0))
    purpose = "Copies values of the flywheels; fills up whole blocks with zeros."
    return body.function("spread", purpose, (values, out))


def roomy(lib: Library, body: Body, values: Place, name: str) -> Place:
    """`values` themselves where they fill whole blocks, else a copy with zeros behind."""
    if int(lib.layout.room) == int(lib.layout.count):
        return values
    copy = body.local(name, (lib.layout.room,))
    body.call(lib["spread"], values, copy)
    return copy


def take_row(lib: Library) -> Function:
    """Takes the row of one flywheel out of its block."""
    table, s = lib.table_argument(), Argument("s", Kind.INT, purpose="its number")
    row = Argument("row", lib.layout.row, (), "out")
    body = Body()
    for target, source in _members(lib, table.place, s.place, row.place):
        body.set(target, source)
    return body.function("take_row", "Takes the row of one flywheel out of its block.", (table, s, row))


def put_row(lib: Library) -> Function:
    """Puts the row of one flywheel into its block."""
    table, s = Argument("table", lib.layout.table, (), "inout"), Argument("s", Kind.INT, purpose="its number")
    row = Argument("row", lib.layout.row)
    body = Body()
    for source, target in _members(lib, table.place, s.place, row.place):
        body.set(target, source)
    return body.function("put_row", "Puts the row of one flywheel into its block.", (table, s, row))


def _members(lib: Library, table: Place, s: Expr, row: Place) -> Iterator[tuple[Place, Place]]:
    """Elements of a row, and the same of its block."""
    lanes = integer(lib.layout.lane_count)
    block, k = table.block[s / lanes], s % lanes
    for field in lib.layout.row.fields:
        column, wide = row.member(field.name), block.member(field.name)
        if field.shape:
            yield from zip(column, lane(wide, k), strict=True)
        else:
            yield column, wide[k]


def row_of(lib: Library, body: Body, table: Place, s: Expr) -> Place:
    """The row of flywheel s: in the table, or a copy out of its block."""
    if lib.layout.lanes == 1:
        return table.flywheel[s]
    row = body.local("row", (), lib.layout.row)
    body.call(lib["take_row"], table, s, row)
    return row


def entry(lib: Library, table: Place, s: Expr, name: str) -> Place:
    """A single number of flywheel s in the table, such as spin_inv."""
    if lib.layout.lanes == 1:
        return table.flywheel[s].member(name)
    lanes = integer(lib.layout.lane_count)
    return table.block[s / lanes].member(name)[s % lanes]
