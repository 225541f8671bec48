"""The profile of the stream in the table of the C."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

from mahovik.core.lower import units
from mahovik.core.lower.units import Member, member
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import StreamProfile
from mahovik.core.stand.structure_facts import Structure

REAL = Kind.REAL
NAME = "stream_profile"


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


def values(profile: StreamProfile) -> dict[str, Any]:
    """The numbers of the struct."""
    largest = max(abs(x) for x in profile.down)
    down = [x / largest for x in profile.down]
    length = math.sqrt(math.fsum(x * x for x in down))
    shear = [
        [(b - a) / (bottom - top) for a, b in zip(above, below, strict=True)]
        for (top, bottom), (above, below) in zip(pairwise(profile.depth), pairwise(profile.velocity), strict=True)
    ]
    return {
        "down": [x / length for x in down],
        "depth": list(profile.depth),
        "top": list(profile.velocity[0]),
        "shear": shear,
    }


def members(value: Any) -> list[Member]:
    """Every real of the struct, for simulators."""
    listed = []
    for i, x in enumerate(member(value, "down")):
        text = f"direction of increasing depth in E0; component {i + 1}"
        listed.append(Member(f"{NAME}.down[{i + 1}]", units.NONE, text, float(x)))
    for k, x in enumerate(member(value, "depth")):
        text = f"depth of station {k + 1} of the stream"
        listed.append(Member(f"{NAME}.depth[{k + 1}]", units.METRE, text, float(x)))
    for i, x in enumerate(member(value, "top")):
        text = f"velocity of the fluid at the first station, in E0; component {i + 1}"
        listed.append(Member(f"{NAME}.top[{i + 1}]", units.VELOCITY, text, float(x)))
    for k, row in enumerate(member(value, "shear")):
        for i, x in enumerate(row):
            text = f"change of the velocity of the fluid with depth below station {k + 1}, in E0; component {i + 1}"
            listed.append(Member(f"{NAME}.shear[{k + 1},{i + 1}]", units.RATE, text, float(x)))
    return listed
