"""Measured numbers of a stand, one by one, in the order of the structs that hold it: parameters and laws."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.lower import stream_profile, units
from mahovik.core.lower.law import BodyProgram
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.member import Member, matrix, member, members, vector
from mahovik.core.lower.table import OF_HOLD
from mahovik.core.lower.values import Values
from mahovik.core.program.types import Field, Struct
from mahovik.core.stand.model import Stand


def parameters(stand: Stand, layout: Layout, values: Values) -> Iterator[Member]:
    """All reals of `parameters`, depth first."""
    named = {
        "instrument": [p.name for p in stand.instruments],
        "flywheel": [s.name for s in stand.flywheels],
        "point": [p.name for p in stand.points],
    }
    given = values.parameters
    for f in layout.parameters.fields:
        if f.name == "added_mass":
            yield from matrix("added_mass", f, given[f.name], units.added_mass, "added mass Lambda, about O1 in E1")
        elif f.name == "carrier":
            assert isinstance(f.type, Struct)
            yield from members("carrier", f.type, given[f.name])
        else:
            assert isinstance(f.type, Struct)
            for name, value in zip(named[f.name], given[f.name], strict=True):
                yield from members(name, f.type, value)


def measured_laws(layout: Layout) -> list[Field]:
    """Members of the table that are laws with numbers of their own: not those of a hold."""
    return [f for f in layout.laws if f.name not in OF_HOLD]


def laws(stand: Stand, layout: Layout, values: Values) -> Iterator[Member]:
    """All reals of the table that `prepare` does not touch, depth first."""
    table = values.table
    of_arrays = {law.array: law for law in parts("program", BodyProgram, BODY_LAWS)}
    for k, own in enumerate(layout.own if layout.own_damped else ()):
        assert layout.frame.field("damper") is not None
        name = stand.bodies[own.index].name
        yield from _damper_members(name, layout, member(member(table, "frame")[k], "damper"))
    for f in measured_laws(layout):
        given = member(table, f.name)
        if f.name in ("gravity", "stream"):
            what = {"gravity": "gravity in E0", "stream": "velocity of the fluid in E0"}[f.name]
            yield from vector(f.name, f, given, what)
        elif f.name == stream_profile.NAME:
            yield from stream_profile.members(given)
        elif f.name == "damper":
            yield from _damper_members("carrier", layout, given)
        elif f.name in of_arrays:
            yield from of_arrays[f.name].array_members(stand, given)
        else:
            law = next(law for law in layout.law_tables if f in law.fields(layout.structure))
            yield from law.members(stand, f, given)


def _damper_members(body: str, layout: Layout, value: Any) -> Iterator[Member]:
    """All reals of one damper."""
    for law in parts("program", BodyProgram, BODY_LAWS):
        yield from law.damper_members(body, layout.damper, value)
