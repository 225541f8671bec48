"""Features of a stand's structure: flywheels, sensors, kinds of wrench. No number of a stand is used."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.lower.freedoms import are_closed
from mahovik.core.lower.law import BodyProgram, CarrierProgram
from mahovik.core.program.types import NamedCount, Precision
from mahovik.core.stand.structure_facts import Structure


@dataclass(frozen=True)
class LocalWrenchBody:
    """An instrument or flywheel with a wrench in its own frame.

    `index` in the stand's bodies; `instrument`, `flywheel` its number among those, `input` its row of the run-time
    wrenches; -1 where it is or has none.
    """

    index: int
    instrument: int
    flywheel: int
    input: int


@dataclass(frozen=True)
class Features:
    """What stands of one structure have, at one precision."""

    structure: Structure
    precision: Precision

    @cached_property
    def count(self) -> NamedCount:
        return NamedCount("N", len(self.structure.flywheels), "flywheels, in the order of the stand file")

    @property
    def flywheels(self) -> bool:
        return bool(self.structure.flywheels)

    @property
    def held(self) -> bool:
        """The carrier is held."""
        return self.structure.hold is not None

    @property
    def freedoms(self) -> int:
        """Freedoms of a held carrier; 0 of a clamped one, and of a free one."""
        return len(self.ways)

    @property
    def ways(self) -> tuple[str, ...]:
        """Freedoms of a held carrier, by their names in FREEDOMS or as turn, slide, twist."""
        return self.structure.hold or ()

    @property
    def along(self) -> bool:
        """The flywheels' terms are added up along the freedoms: few, closed, and V is S u, which a stream would change.

        Of more than three freedoms the projected sums are more numbers than those of six rows.
        """
        few = 0 < self.freedoms <= 3 and bool(self.flywheels)
        return few and not self.stream and are_closed(self.ways)

    @property
    def coordinates(self) -> bool:
        """Poses of the held carrier have coordinates of its freedoms."""
        return bool(self.freedoms) and are_closed(self.ways)

    @property
    def instruments(self) -> int:
        return len(self.structure.instruments)

    @property
    def added_mass(self) -> bool:
        return self.structure.added_mass

    @property
    def weight(self) -> bool:
        return self.structure.weight

    @property
    def stream(self) -> bool:
        return self.structure.stream

    @cached_property
    def law_tables(self) -> tuple[CarrierProgram, ...]:
        """The laws of `laws/` that the stand has."""
        return tuple(law for law in parts("program", CarrierProgram) if law.present(self.structure))

    @property
    def body_laws(self) -> tuple[str, ...]:
        """The laws of bodies that the stand has, in words."""
        first = [("weight", self.weight), ("buoyancy", self.displaces)]
        rest = [(law.words, bool(law.bodies(self.structure))) for law in parts("program", BodyProgram, BODY_LAWS)]
        return tuple(words for words, acts in (*first, *rest) if acts)

    @cached_property
    def displaces(self) -> bool:
        """Any displaced mass under gravity."""
        return self.structure.law("buoyancy") or self.flywheel_displaces

    @cached_property
    def flywheel_displaces(self) -> bool:
        """A flywheel does."""
        return bool(self.structure.law("flywheel_buoyancy"))

    @property
    def inputs(self) -> tuple[str, ...]:
        """Bodies with a run-time wrench, in the order of the stand."""
        return tuple(self.structure.bodies[i] for i in self.structure.wrench_inputs)

    @property
    def flywheel_input(self) -> bool:
        return any(o.flywheel >= 0 and o.input >= 0 for o in self.own)

    @property
    def sine_input(self) -> bool:
        """Some functions take sines and cosines of the phases."""
        return self.flywheels and self.structure.phase_input == "sincos"

    @property
    def carrier_input(self) -> bool:
        return 0 in self.structure.wrench_inputs

    @property
    def input_count(self) -> NamedCount:
        return NamedCount("WRENCHES", len(self.inputs), "bodies with a run-time wrench")

    @cached_property
    def own(self) -> tuple[LocalWrenchBody, ...]:
        """Instruments and flywheels that need their own frame at run time: damping or a run-time wrench."""
        inputs = self.structure.wrench_inputs
        indices = sorted({*self._damped_bodies, *inputs} - {0})
        fixed = 1 + self.instruments
        return tuple(
            LocalWrenchBody(i, i - 1 if i < fixed else -1, i - fixed if i >= fixed else -1, _position(i, inputs))
            for i in indices
        )

    @cached_property
    def _damped_bodies(self) -> frozenset[int]:
        """Indices of the bodies on which any damping acts."""
        return frozenset(i for law in parts("program", BodyProgram, BODY_LAWS) for i in law.bodies(self.structure))

    @property
    def damped(self) -> bool:
        return bool(self._damped_bodies)

    @property
    def carrier_damped(self) -> bool:
        return 0 in self._damped_bodies

    @property
    def own_damped(self) -> bool:
        return any(i > 0 for i in self._damped_bodies)

    @property
    def own_inputs(self) -> bool:
        return any(o.input >= 0 for o in self.own)

    @property
    def own_turning(self) -> bool:
        return any(o.flywheel >= 0 for o in self.own)

    @property
    def own_fixed(self) -> bool:
        return any(o.instrument >= 0 for o in self.own)

    @property
    def attitude_needed(self) -> bool:
        """The equations depend on the attitude."""
        return self.weight or self.stream or bool(self.law_tables)

    @property
    def wrenches(self) -> bool:
        """Any external wrench at all."""
        return self.weight or self.damped or bool(self.inputs) or bool(self.law_tables)

    @property
    def sensors(self) -> tuple[str, ...]:
        """Instruments and points, which `points` reads."""
        return (*self.structure.instruments, *self.structure.points)

    @property
    def sensor_count(self) -> NamedCount:
        return NamedCount("SENSORS", len(self.sensors), "instruments and points: those of the function points")


def _position(index: int, indices: tuple[int, ...]) -> int:
    return indices.index(index) if index in indices else -1
