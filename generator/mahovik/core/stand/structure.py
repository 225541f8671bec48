"""The structure of a stand, facts that decide the text of its C: names, order, counts, kinds of wrench. No number."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from mahovik.core.stand.hold import kinds
from mahovik.core.stand.laws import body_laws, carrier_laws
from mahovik.core.stand.model import Body, PhaseInput, Sequence, Stand, Task


@dataclass(frozen=True)
class Structure:
    """Two stands of equal structure have the same C but for numbers.

    A body's index is its place in `Stand.bodies`: 0 the carrier, then instruments, then flywheels.
    Fixed bodies (carrier, instruments) add up to constants, so for weight and added mass only whether
    there is any counts.
    """

    name: str
    angles: Sequence
    instruments: tuple[str, ...]
    flywheels: tuple[str, ...]
    flywheel_mounts: tuple[int, ...]
    """Body index of each flywheel's mount."""
    points: tuple[str, ...]
    point_mounts: tuple[int, ...]
    weight: bool
    """Gravity is not zero."""
    stream: bool
    """The file has the key `stream` (its value may be zero: it is an input of the C)."""
    added_mass: bool
    wrench_inputs: tuple[int, ...]
    phase_input: PhaseInput
    """"sincos": functions that take sines and cosines of the phases are there as well."""
    tasks: tuple[Task, ...] = ()
    hold: tuple[str, ...] | None = None
    """Freedoms of a held carrier, by their names in FREEDOMS or as turn, slide, twist; None where it is free."""
    stream_stations: int = 0
    """Depths of the profile of the stream; 0 where it is uniform."""
    laws: tuple[tuple[str, Any], ...] = ()
    """Facts of the laws of `laws/`, by key."""

    def law(self, key: str) -> Any:
        """Fact of a law under one of its keys; None if no law has the key."""
        return dict(self.laws).get(key)

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names by body index."""
        return ("carrier", *self.instruments, *self.flywheels)


def structure(stand: Stand) -> Structure:
    """The structure of `stand`."""
    bodies = stand.bodies
    index = {body.name: i for i, body in enumerate(bodies)}
    weight = any(stand.gravity)

    def where(has: Callable[[Body], bool]) -> tuple[int, ...]:
        return tuple(i for i, body in enumerate(bodies) if has(body))

    return Structure(
        name=stand.name,
        angles=stand.angles,
        instruments=tuple(instrument.name for instrument in stand.instruments),
        flywheels=tuple(flywheel.name for flywheel in stand.flywheels),
        flywheel_mounts=tuple(index[flywheel.mount] for flywheel in stand.flywheels),
        points=tuple(point.name for point in stand.points),
        point_mounts=tuple(index[point.mount] for point in stand.points),
        weight=weight,
        stream=stand.stream is not None,
        added_mass=stand.carrier.added_mass is not None
        or any(instrument.added_mass is not None for instrument in stand.instruments),
        wrench_inputs=where(lambda body: body.wrench_input),
        phase_input=stand.phase_input,
        tasks=stand.tasks,
        hold=None if stand.hold is None else kinds(stand.hold),
        stream_stations=0 if stand.profile is None else len(stand.profile.depth),
        laws=tuple(
            item
            for said in (
                *(law.structure(stand) for law in body_laws()),
                *(law.structure(stand.law(law), stand) for law in carrier_laws()),
            )
            for item in said.items()
        ),
    )
