"""Stand -> stand file in SI, every float with all its digits: reading it back gives the same Stand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

from mahovik.core.stand.model import (
    TWIST_LETTERS,
    WRENCH_LETTERS,
    Body,
    Carrier,
    Damping,
    Factor,
    Flywheel,
    Instrument,
    MountingAngles,
    Stand,
)

_NONE: Mapping[str, Sequence[str]] = MappingProxyType({})


def dumps(stand: Stand, comments: Mapping[str, Sequence[str]] = _NONE) -> str:
    """The stand as TOML text. `loads(dumps(stand)) == stand`, but for what stand.md lets vanish (all-zero parts).

    `comments`: lines over the table of a body or point, by its name.
    """

    def head(title: str, name: str) -> list[str]:
        return ["", *(f"# {line}" for line in comments.get(name, ())), title]

    lines = ["schema = 1", f'name = "{stand.name}"', f'angles = "{stand.angles}"', _line("gravity", stand.gravity)]
    if stand.stream is not None:
        lines.append(_line("stream", stand.stream))
    if stand.phase_input != "angle":
        lines.append(_line("phase_input", stand.phase_input))
    lines += [*head("[carrier]", "carrier"), *_body(stand.carrier)]
    if stand.suspension is not None:
        lines += ["", "[suspension]", *_fields(stand.suspension, "stiffness", "damping", "position", "angles")]
    for leg in stand.legs:
        lines += ["", "[[leg]]", *_fields(leg, "ground", "carrier", "length", "stiffness", "damping")]
    for instrument in stand.instruments:
        lines += [
            *head("[[instrument]]", instrument.name),
            f'name = "{instrument.name}"',
            *_fields(instrument, "position", "angles"),
        ]
        lines += _body(instrument)
    for flywheel in stand.flywheels:
        lines += [*head("[[flywheel]]", flywheel.name), f'name = "{flywheel.name}"', *_flywheel(flywheel)]
    for point in stand.points:
        lines += [*head("[[point]]", point.name), f'name = "{point.name}"', f'mount = "{point.mount}"']
        lines += _fields(point, "position", "angles")
    return "\n".join(lines) + "\n"


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, Sequence) and not isinstance(value, str):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    return f'"{value}"' if isinstance(value, str) else str(value)


def _line(key: str, value: Any) -> str:
    return f"{key} = {_value(value)}"


def _fields(table: Any, *keys: str) -> list[str]:
    return [_line(key, getattr(table, key)) for key in keys]


def _body(body: Body) -> list[str]:
    lines = _fields(body, "mass", "center_of_mass", "inertia", "inertia_about")
    if isinstance(body, Carrier | Instrument) and body.added_mass is not None:
        lines.append(_line("added_mass", body.added_mass))
    if body.wrench_input:
        lines.append("wrench_input = true")
    if body.buoyancy is not None:
        floating = body.buoyancy
        lines.append(f"buoyancy = {{ {', '.join(_fields(floating, 'displaced_mass', 'center'))} }}")
    if body.damping is not None:
        lines.append(f"damping = {{ {', '.join(_damping(body.damping))} }}")
    return lines


def _damping(damping: Damping) -> list[str]:
    parts = [_line(key, getattr(damping, key)) for key in ("linear", "quadratic") if getattr(damping, key) is not None]
    if damping.terms:
        terms = (
            f'{{ wrench = "{WRENCH_LETTERS[term.wrench]}", of = {_value([_factor(f) for f in term.of])}, '
            f"value = {term.value!r} }}"
            for term in damping.terms
        )
        parts.append(f"terms = [{', '.join(terms)}]")
    return parts


def _factor(factor: Factor) -> str:
    letter = TWIST_LETTERS[factor.component]
    return f"|{letter}|" if factor.absolute else letter


def _flywheel(flywheel: Flywheel) -> list[str]:
    lines = [f'mount = "{flywheel.mount}"', _line("position", flywheel.position)]
    mounting = flywheel.mounting
    if isinstance(mounting, MountingAngles):
        lines.append(_line("angles", (mounting.psi, mounting.theta, mounting.zero)))
    else:
        lines += _fields(mounting, "axis", "zero")
    lines += _body(flywheel)
    if flywheel.inverse_weight != 1.0:
        lines += _fields(flywheel, "inverse_weight")
    motor, encoder = flywheel.motor, flywheel.encoder
    if motor is not None:
        keys = ("torque", "speed", "constant", "resistance", "supply", "viscous", "coulomb", "coulomb_speed")
        given = [key for key in keys if getattr(motor, key) is not None]
        lines.append(f"motor = {{ {', '.join(_fields(motor, *given))} }}")
    if encoder is not None:
        lines.append(f"encoder = {{ {', '.join(_fields(encoder, 'counts', 'zero', 'latency'))} }}")
    return lines
