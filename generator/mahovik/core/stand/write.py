"""Stand -> stand file in SI, every float with all its digits: reading it back gives the same Stand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from mahovik.core.stand.hold import lines as hold_lines
from mahovik.core.stand.law import HeldLaw
from mahovik.core.stand.laws import body_laws, carrier_laws, mounted_laws
from mahovik.core.stand.model import (
    INVERSE_MOST,
    Body,
    Carrier,
    Flywheel,
    Instrument,
    MountingAngles,
    Stand,
    TaskRow,
)
from mahovik.core.stand.toml import fields, line_of, value_of

_NONE: Mapping[str, Sequence[str]] = MappingProxyType({})


def dumps(stand: Stand, comments: Mapping[str, Sequence[str]] = _NONE) -> str:
    """The stand as TOML text. `loads(dumps(stand)) == stand`, except all-zero parts, which are absent.

    `comments`: lines over the table of a body or point, by its name.
    """

    def head(title: str, name: str) -> list[str]:
        return ["", *(f"# {line}" for line in comments.get(name, ())), title]

    lines = ["schema = 1", f'name = "{stand.name}"', f'angles = "{stand.angles}"', line_of("gravity", stand.gravity)]
    if stand.stream is not None:
        lines.append(line_of("stream", stand.stream))
    if stand.phase_input != "angle":
        lines.append(line_of("phase_input", stand.phase_input))
    if stand.inverse_most != INVERSE_MOST:
        lines.append(line_of("inverse_most", stand.inverse_most))
    laws = [law for kind in carrier_laws() if (law := stand.law(kind)) is not None]
    given = [law.text() for law in laws if not isinstance(law, HeldLaw)]
    lines += [line for header, _ in given for line in header]
    if stand.profile is not None:
        lines += ["", "[stream_profile]", *fields(stand.profile, "down", "depth", "velocity")]
    lines += [*head("[carrier]", "carrier"), *_body(stand.carrier)]
    lines += [line for _, tables in given for line in tables]
    if stand.hold is not None:
        lines += hold_lines(stand.hold)
        lines += [line for law in laws if isinstance(law, HeldLaw) for line in law.text()[1]]
    for instrument in stand.instruments:
        lines += [
            *head("[[instrument]]", instrument.name),
            f'name = "{instrument.name}"',
            *fields(instrument, "position", "angles"),
        ]
        lines += _body(instrument)
    for flywheel in stand.flywheels:
        lines += [*head("[[flywheel]]", flywheel.name), f'name = "{flywheel.name}"', *_flywheel(flywheel)]
    for point in stand.points:
        lines += [*head("[[point]]", point.name), f'name = "{point.name}"', f'mount = "{point.mount}"']
        lines += fields(point, "position", "angles")
    for kind in mounted_laws():
        for _, body, own in kind.of(stand):
            for item in own.items:
                lines += ["", f"[[{kind.key}]]", line_of("mount", body.name), *item.lines()]
    for task in stand.tasks:
        lines += ["", f"[task.{task.name}]", f"rows = [{', '.join(_row(row) for row in task.rows)}]"]
    return "\n".join(lines) + "\n"


def _row(row: TaskRow) -> str:
    own = value_of(row.component)
    return f"{{ point = {value_of(row.of)}, rows = [{own}] }}" if row.of else own


def _body(body: Body) -> list[str]:
    lines = fields(body, "mass", "center_of_mass", "inertia", "inertia_about")
    if isinstance(body, Carrier | Instrument) and body.added_mass is not None:
        lines.append(line_of("added_mass", body.added_mass))
    if body.wrench_input:
        lines.append("wrench_input = true")
    for kind in body_laws():
        if not kind.mounted and (law := body.law(kind)) is not None:
            lines.append(f"{law.key} = {{ {', '.join(law.lines())} }}")
    return lines


def _flywheel(flywheel: Flywheel) -> list[str]:
    lines = [f'mount = "{flywheel.mount}"', line_of("position", flywheel.position)]
    mounting = flywheel.mounting
    if isinstance(mounting, MountingAngles):
        lines.append(line_of("angles", (mounting.psi, mounting.theta, mounting.zero)))
    else:
        lines += fields(mounting, "axis", "zero")
    lines += _body(flywheel)
    if flywheel.inverse_weight != 1.0:
        lines += fields(flywheel, "inverse_weight")
    motor, encoder = flywheel.motor, flywheel.encoder
    if motor is not None:
        keys = ("torque", "speed", "constant", "resistance", "supply", "viscous", "coulomb", "coulomb_speed")
        given = [key for key in keys if getattr(motor, key) is not None]
        lines.append(f"motor = {{ {', '.join(fields(motor, *given))} }}")
    if encoder is not None:
        lines.append(f"encoder = {{ {', '.join(fields(encoder, 'counts', 'zero', 'latency'))} }}")
    return lines
