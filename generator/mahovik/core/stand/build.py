"""Checked tables -> the model's classes, with what needs several keys of one table to be checked."""

from __future__ import annotations

from typing import Any

from mahovik.core.stand import datasheet
from mahovik.core.stand.directions import parallel
from mahovik.core.stand.laws import body_laws
from mahovik.core.stand.model import (
    About,
    Carrier,
    Encoder,
    Flywheel,
    Instrument,
    LawData,
    Mat3,
    Motor,
    MountingAngles,
    MountingAxes,
    Point,
    Vec3,
)
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.schema import (
    BodyTable,
    CarrierTable,
    FlywheelTable,
    InstrumentTable,
    PointTable,
)


def carrier(table: CarrierTable, problems: Problems) -> Carrier:
    """`[carrier]`."""
    return Carrier(
        name="carrier",
        mass=table.mass,
        inertia=table.inertia,
        added_mass=table.added_mass,
        **_common(table, "carrier", problems),
    )


def instrument(table: InstrumentTable, where: str, problems: Problems) -> Instrument:
    """One `[[instrument]]`."""
    return Instrument(
        name=table.name,
        mass=table.mass,
        inertia=table.inertia,
        added_mass=table.added_mass,
        position=table.position,
        angles=table.angles,
        **_common(table, where, problems),
    )


def flywheel(table: FlywheelTable, where: str, problems: Problems) -> Flywheel | None:
    """One `[[flywheel]]`; None where its mounting or its inertia is unknown."""
    mounting = _mounting(table, where, problems)
    given = _inertia(table, where, problems)
    if mounting is None or given is None:
        return None
    center, inertia, about = given
    motor, encoder = table.motor, table.encoder
    return Flywheel(
        name=table.name,
        mass=table.mass,
        center_of_mass=center,
        inertia=inertia,
        inertia_about=about,
        laws=_laws(table),
        wrench_input=table.wrench_input,
        mount=table.mount,
        position=table.position,
        mounting=mounting,
        motor=Motor(**motor.model_dump()) if motor else None,
        encoder=Encoder(**encoder.model_dump()) if encoder else None,
        inverse_weight=table.inverse_weight,
    )


def point(table: PointTable) -> Point:
    """One `[[point]]`."""
    return Point(table.name, table.mount, table.position, table.angles)


def _common(table: BodyTable, where: str, problems: Problems) -> dict[str, Any]:
    return {
        "center_of_mass": table.center_of_mass,
        "inertia_about": _about(table, where, problems),
        "laws": _laws(table),
        "wrench_input": table.wrench_input,
    }


def _about(table: BodyTable, where: str, problems: Problems) -> About:
    """Point that the inertia is about; if the centre of mass is the origin, the key may be left out."""
    if table.inertia_about is not None:
        return table.inertia_about
    if any(table.center_of_mass):
        problems.add(
            where,
            "inertia_about",
            'required where center_of_mass is not zero, expected "origin" or "center_of_mass"',
        )
    return "origin"


def _laws(table: BodyTable) -> tuple[LawData, ...]:
    """The data of the laws that act on a body."""
    given = ((law, getattr(table, law.key)) for law in body_laws() if not law.mounted)
    found = (law.read(own) for law, own in given if own is not None)
    return tuple(law for law in found if law is not None)


def _mounting(table: FlywheelTable, where: str, problems: Problems) -> MountingAngles | MountingAxes | None:
    if table.axis is None and table.zero is None:
        psi, theta, *zero = table.angles or (0.0, 0.0)
        return MountingAngles(psi, theta, zero[0] if zero else 0.0)
    if table.angles is not None:
        problems.add(where, "angles", "given together with axis, zero: expected one or the other")
        return None
    if table.axis is None:
        problems.add(where, "axis", "required with zero, but missing")
        return None
    if table.zero is None:
        problems.add(where, "zero", "required with axis (direction of the second axis at phi_s = 0), but missing")
        return None
    if parallel(table.axis, table.zero):
        problems.add(where, "zero", "parallel to axis, expected another direction")
        return None
    return MountingAxes(table.axis, table.zero)


def _inertia(table: FlywheelTable, where: str, problems: Problems) -> tuple[Vec3, Mat3, About] | None:
    """Centre of mass, tensor and the point it is about, from either way of giving them."""
    sheet = [key for key in ("spin_inertia", "transverse_inertia", "unbalance") if getattr(table, key) is not None]
    if not sheet:
        if table.inertia is None:
            problems.add(where, "inertia", "required, but missing (or spin_inertia and transverse_inertia)")
            return None
        return table.center_of_mass, table.inertia, _about(table, where, problems)
    mixed = [key for key in ("center_of_mass", "inertia", "inertia_about") if key in table.model_fields_set]
    if mixed:
        problems.add(where, mixed[0], f"given together with {', '.join(sheet)}: expected one way or the other")
        return None
    if table.spin_inertia is None or table.transverse_inertia is None:
        missing = "spin_inertia" if table.spin_inertia is None else "transverse_inertia"
        problems.add(where, missing, f"required with {', '.join(sheet)}, but missing{datasheet.thin_disc(table)}")
        return None
    if table.mass == 0.0 and table.unbalance is not None and table.unbalance.static != 0.0:
        problems.add(where, "unbalance", "static", "a flywheel of mass 0 cannot have a static unbalance")
        return None
    return (
        datasheet.center_of_mass(table.mass, table.unbalance),
        datasheet.inertia(table.spin_inertia, table.transverse_inertia, table.unbalance),
        "origin",
    )
