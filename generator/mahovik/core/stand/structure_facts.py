"""Facts that decide the text of a stand's C: names, order, counts, kinds of wrench, attitude sequence. No number."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mahovik.core.stand.model import PhaseInput, Sequence, Task


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
    motor_points: int = 0
    """Most points of a motor's curve of torque by speed, mirrored; 0 where no motor has one."""
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
