"""The structure of a stand, the facts that decide the text of its C; hashes of it and of the canonical model.

The hashes are blind to comments, units, key order and line ends.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

from mahovik.core.stand.fields import stand_name_problem
from mahovik.core.stand.hold import kinds
from mahovik.core.stand.law import BodyLaw
from mahovik.core.stand.laws import body_laws, carrier_laws
from mahovik.core.stand.model import INVERSE_MOST, Body, Stand, Structure


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


@dataclass(frozen=True)
class Identities:
    """First eight hexadecimal digits of SHA-256, each.

    structure   of what decides the C text
    physics     of that and all numbers in SI
    """

    structure: str
    physics: str


def identities(stand: Stand) -> Identities:
    """Both identities of `stand`."""
    form, numbers = asdict(structure(stand)), asdict(stand)
    form |= dict(form.pop("laws"))
    del numbers["laws"], numbers["tasks"]
    if stand.inverse_most == INVERSE_MOST:
        del numbers["inverse_most"]  # as in a file without the key
    if not stand.tasks:
        del form["tasks"]
    if stand.hold is None:
        del form["hold"], numbers["hold"]
    if not form["motor_points"]:
        del form["motor_points"]
    for wheel in numbers["flywheels"]:
        if wheel["motor"] and not wheel["motor"]["torque_speed"]:
            del wheel["motor"]["torque_speed"]
    if stand.profile is None:
        del form["stream_stations"], numbers["profile"]
    for law in carrier_laws():
        numbers |= law.content(stand.law(law))
    body_of = {body.name: body for body in stand.bodies}
    for body in (numbers["carrier"], *numbers["instruments"], *numbers["flywheels"]):
        laws = {type(law): _without_defaults(law) for law in body_of[body["name"]].laws if isinstance(law, BodyLaw)}
        del body["laws"]
        body |= {law.key: laws.get(law) for law in body_laws() if law in laws or not law.optional}
        if not any(body["center_of_mass"]):
            body["inertia_about"] = "origin"  # the two are one point
    return Identities(_digest(form), _digest({"structure": form, "numbers": numbers}))


def under_name(stand: Stand, name: str, physics: str | None) -> Stand | None:
    """The stand by the name that its C has, its own or that of `generate --prefix`; None for C of another stand.

    `physics`: identity of the C, which the name is a part of.
    """
    if stand_name_problem(name) is not None:
        return None
    named = stand if name == stand.name else replace(stand, name=name)
    return named if identities(named).physics == physics else None


def _without_defaults(law: BodyLaw) -> dict[str, Any]:
    """The data of a law of a body without newer members at their default, as in a file without their keys."""
    defaults = {f.name: f.default for f in fields(law) if f.name in law.newer}
    result = asdict(law)
    return {name: value for name, value in result.items() if name not in defaults or value != defaults[name]}


def _digest(value: Any) -> str:
    text = json.dumps(_canonical(value), sort_keys=True, separators=(",", ":"), ensure_ascii=True)
    return hashlib.sha256(text.encode("ascii")).hexdigest()[:8]


def _canonical(value: Any) -> Any:
    if isinstance(value, float):
        return (value + 0.0).hex()  # every bit, and one zero
    if isinstance(value, Mapping):
        return {key: _canonical(item) for key, item in value.items()}
    if isinstance(value, tuple | list):
        return [_canonical(item) for item in value]
    return value
