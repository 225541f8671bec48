"""What decides the text of a stand's C: names, order, counts, kinds of wrench, attitude sequence. No number."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from mahovik.core.stand.model import Body, Damping, Factor, PhaseInput, Sequence, Stand
from mahovik.laws import parts

TermKind = tuple[int, tuple[Factor, Factor]]
"""Wrench component 0..5 of a hydrodynamic derivative and its two factors."""


@dataclass(frozen=True)
class Structure:
    """Two stands of equal structure have the same C but for numbers.

    A body's index is its place in `Stand.bodies`: 0 the carrier, then instruments, then flywheels.
    Fixed bodies (carrier, instruments) add up to constants, so for weight, added mass and buoyancy only
    whether there is any counts; what turns with a flywheel, and what depends on a body's own twist, is listed.
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
    buoyancy: bool
    """A fixed body displaces mass, and there is gravity."""
    flywheel_buoyancy: tuple[int, ...]
    """Body indices of flywheels that displace mass, where there is gravity."""
    linear_damping: tuple[int, ...]
    quadratic_damping: tuple[int, ...]
    damping_terms: tuple[tuple[int, tuple[TermKind, ...]], ...]
    """Body index and the kind of each of its terms, for bodies that have terms."""
    wrench_inputs: tuple[int, ...]
    phase_input: PhaseInput
    """"sincos": functions that take sines and cosines of the phases are there as well."""
    laws: tuple[tuple[str, Any], ...] = ()
    """What the laws of `laws/` say, by their keys."""

    def law(self, key: str) -> Any:
        """What a law says under one of its keys; None where no law has that key."""
        return dict(self.laws).get(key)

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names by body index."""
        return ("carrier", *self.instruments, *self.flywheels)

    @property
    def damped(self) -> tuple[int, ...]:
        """Indices of the bodies on which any damping acts, ascending."""
        with_terms = (index for index, _ in self.damping_terms)
        return tuple(sorted({*self.linear_damping, *self.quadratic_damping, *with_terms}))


def structure(stand: Stand) -> Structure:
    """The structure of `stand`."""
    bodies = stand.bodies
    fixed = 1 + len(stand.instruments)
    index = {body.name: i for i, body in enumerate(bodies)}
    weight = any(stand.gravity)

    def where(has: Callable[[Body], bool]) -> tuple[int, ...]:
        return tuple(i for i, body in enumerate(bodies) if has(body))

    def damped_by(has: Callable[[Damping], bool]) -> tuple[int, ...]:
        return where(lambda body: body.damping is not None and has(body.damping))

    floating = where(lambda body: weight and body.buoyancy is not None)
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
        buoyancy=any(i < fixed for i in floating),
        flywheel_buoyancy=tuple(i for i in floating if i >= fixed),
        linear_damping=damped_by(lambda damping: damping.linear is not None),
        quadratic_damping=damped_by(lambda damping: damping.quadratic is not None),
        damping_terms=tuple(
            (i, tuple((term.wrench, term.of) for term in body.damping.terms))
            for i, body in enumerate(bodies)
            if body.damping is not None and body.damping.terms
        ),
        wrench_inputs=where(lambda body: body.wrench_input),
        phase_input=stand.phase_input,
        laws=tuple(
            item for law in parts("schema") for item in law.SCHEMA.structure(stand.law(law.SCHEMA.data), stand).items()
        ),
    )
