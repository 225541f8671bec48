"""The stream by depth: its profile in the table of the C, and its velocity where the carrier is, by the depth of O1."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.limits import unit_square
from mahovik.core.lower.units import Member, Unit
from mahovik.core.program.expression import Status
from mahovik.core.program.kernel import OK, RANGE, Reals, reals, result
from mahovik.core.program.types import Field, Kind, Struct, member
from mahovik.core.program.vector import dot
from mahovik.core.stand.columns import by_sample
from mahovik.core.stand.model import StreamProfile, Structure

REAL = Kind.REAL
NAME = "stream_profile"
"""Its member of the table."""


def table_fields(structure: Structure) -> list[Field]:
    """The profile, where the stand has one."""
    count = structure.stream_stations
    if not count:
        return []
    fields = (
        Field("down", REAL, (3,), "", "direction of increasing depth in E0, of length one"),
        Field("depth", REAL, (count,), "m", "stations, increasing"),
        Field("top", REAL, (3,), "m/s", "velocity of the fluid at the first station, in E0, beside `stream`"),
        Field("shear", REAL, (count - 1, 3), "1/s", "its change with depth from each station to the next"),
    )
    struct = Struct("stream_profile", "Velocity of the fluid by depth, linear between stations.", fields)
    return [Field(NAME, struct, (), "", "added to `stream`; a state above or below it is refused")]


def _direction(vector: tuple[float, ...]) -> tuple[float, ...]:
    largest = max(abs(x) for x in vector)
    scaled = [x / largest for x in vector]
    length = math.sqrt(math.fsum(x * x for x in scaled))
    return tuple(x / length for x in scaled)


def values(profile: StreamProfile) -> dict[str, Any]:
    """The numbers of the struct."""
    shear = [
        [(b - a) / (bottom - top) for a, b in zip(above, below, strict=True)]
        for (top, bottom), (above, below) in zip(pairwise(profile.depth), pairwise(profile.velocity), strict=True)
    ]
    return {
        "down": list(by_sample(_direction, profile.down)),
        "depth": list(profile.depth),
        "top": list(profile.velocity[0]),
        "shear": shear,
    }


def members(value: Any) -> Iterator[Member]:
    """Every real of the struct, for simulators."""

    def three(name: str, unit: Unit, numbers: Any, text: str) -> Iterator[Member]:
        for i, x in enumerate(numbers, 1):
            yield Member(f"{NAME}.{name}{i}]", unit, f"{text}; component {i}", float(x))

    yield from three("down[", units.NONE, member(value, "down"), "direction of increasing depth in E0")
    for k, x in enumerate(member(value, "depth"), 1):
        yield Member(f"{NAME}.depth[{k}]", units.METRE, f"depth of station {k} of the stream", float(x))
    text = "velocity of the fluid at the first station, in E0"
    yield from three("top[", units.VELOCITY, member(value, "top"), text)
    for k, row in enumerate(member(value, "shear"), 1):
        text = f"change of the velocity of the fluid with depth below station {k}, in E0"
        yield from three(f"shear[{k},", units.RATE, row, text)


def add_functions(lib: FunctionSet) -> None:
    """The stream by depth, and the check of the depth, where the stand has a profile.

    Stations increase and `down` has length one, within 1e-3 of its square. The velocity at O1 is in the range of a
    stream, and a shear in that of an angular velocity, so that no product overflows.
    """
    last = lib.layout.structure.stream_stations - 1
    if last < 0:
        return

    @lib.kernel()
    def stream_at(
        table: Any = lib.table, x: Any = lib.x, flow: Reals = result("velocity of the fluid, in E0", 3, unit="m/s")
    ) -> None:
        """Velocity of the fluid at the depth of O1."""
        profile = table.stream_profile
        depth = dot(profile.down, x.position)
        flow[:] = table.stream + profile.top
        for k in range(last):
            thick = profile.depth[k + 1] - profile.depth[k]
            above: float = depth - profile.depth[k]  # part of the layer that is above O1
            above = above if above > 0 else 0.0
            above = above if above < thick else thick
            flow += profile.shear[k] * above

    @lib.kernel()
    def check_depth(table: Any = lib.table, x: Any = lib.x) -> Status:
        """Is the profile of the stream in its ranges, and the depth of O1 within it?"""
        profile, within = table.stream_profile, lib["within"]
        within(profile.down, 3, 2)
        down2 = dot(profile.down, profile.down)
        if not unit_square(down2):
            return RANGE
        within(profile.depth, last + 1, lib.limit("MAX_POSITION"))
        within(profile.top, 3, lib.limit("MAX_VELOCITY"))
        for k in range(last):
            if not (profile.depth[k + 1] > profile.depth[k]):
                return RANGE
            within(profile.shear[k], 3, lib.limit("MAX_SPEED"))
        depth = dot(profile.down, x.position)
        if not (depth >= profile.depth[0] and depth <= profile.depth[last]):
            return RANGE
        flow = reals(3)  # stream in E0, at this depth
        stream_at(table, x, flow)
        within(flow, 3, lib.limit("MAX_VELOCITY"))
        return OK
