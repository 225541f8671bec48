"""The structure of a stand: the facts that decide the text of its C."""

from __future__ import annotations

from collections.abc import Callable

from mahovik.core.stand.hold import kinds
from mahovik.core.stand.laws import body_laws, carrier_laws
from mahovik.core.stand.model import Body, Stand
from mahovik.core.stand.structure_facts import Structure


def structure(stand: Stand) -> Structure:
    """The structure of `stand`."""
    bodies = stand.bodies
    index = {body.name: i for i, body in enumerate(bodies)}
    weight = any(stand.gravity)
    motors = [flywheel.motor for flywheel in stand.flywheels]

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
        motor_points=max((len(m.limit) for m in motors if m is not None and m.torque_speed), default=0),
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
