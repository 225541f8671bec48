"""Channels of flywheels as phases and speeds in rad and rad/s: encoders, pulses, wrapped angles."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mahovik.core.stand.model import Flywheel, Stand
from mahovik.use.measured.counters import modulus_of, unwrap
from mahovik.use.measured.quantities import Name
from mahovik.use.measured.recording import Array, Channel
from mahovik.use.measured.tacho import find_pulses, phase_of
from mahovik.use.measured.times import count
from mahovik.use.measured.track import Track

TURN = 2.0 * np.pi
DIFFERENT = 0.02
"""Relative difference of counts per turn and those seen between pulses, above which it is reported."""


def channels_of(track: Track, stand: Stand, counts: Mapping[str, int]) -> list[Channel]:
    """The channels of a track in SI, with a phase for each count and tacho; a note on each correction.

    `counts`: counts per turn of encoders that neither unit nor stand file states.
    """
    found: list[Channel] = []
    wheels = {flywheel.name: flywheel for flywheel in stand.flywheels}
    for name, raw in track.values.items():
        values: Array | None = raw
        if name.quantity == "count":
            values = _of_counts(track, wheels[name.name], name, raw, counts)
        elif name.quantity == "tacho":
            if any(each.name == name.name and each.quantity in ("phase", "count") for each in track.values):
                _compare(track, name, raw)
                continue
            values = _of_pulses(track, name, raw)
        elif name.quantity == "phase":
            values = _of_angles(track, name, raw)
        if values is None:
            continue
        quantity, source = ("phase", name.quantity) if name.quantity in ("count", "tacho") else (name.quantity, "")
        if any((c.name, c.quantity, c.component) == (name.name, quantity, name.component) for c in found):
            track.notes.append(f"{name.label}: a second {quantity} of {name.name}: left out")
            continue
        found.append(Channel(name.kind, name.name, quantity, name.component, name.unit, values, source))
    return found


def _speed(track: Track, wheel: str) -> Array | None:
    """(T,) Speed channel of a flywheel, rad/s."""
    return next((x for n, x in track.values.items() if n.name == wheel and n.quantity == "speed"), None)


def _expected_steps(track: Track, wheel: str, per_radian: float) -> Array | None:
    """(T - 1,) Steps that the speed channel lets expect."""
    speed = _speed(track, wheel)
    if speed is None:
        return None
    return np.asarray(0.5 * (speed[1:] + speed[:-1]) * np.diff(track.t) * per_radian)


def _note_wraps(track: Track, name: Name, what: str, wraps: int, unsure: int) -> None:
    if wraps:
        track.notes.append(f"{name.label}: wraps at {what}, {count(wraps, 'time')}: unwrapped")
    if unsure:
        track.notes.append(
            f"{name.label}: {count(unsure, 'step')} of nearly half of {what} between samples, direction not sure; "
            f"add {name.name}.speed or sample faster"
        )


def _of_counts(track: Track, wheel: Flywheel, name: Name, values: Array, counts: Mapping[str, int]) -> Array | None:
    """Phase of an encoder; None if its counts per turn are not known."""
    encoder = wheel.encoder
    turn = name.counts or (encoder.counts if encoder is not None else None) or counts.get(name.name)
    zero = 0.0 if encoder is None else encoder.zero
    if name.counts and encoder is not None and abs(encoder.counts) != name.counts:
        track.notes.append(
            f"{name.label}: {name.counts} counts per turn in the header, {encoder.counts} in the stand file: "
            "those of the header are taken"
        )
    elif name.counts and encoder is not None:
        turn = encoder.counts  # with its sign
    if turn is None:
        turn = _seen_counts(track, name, values)
        if turn is None:
            track.notes.append(
                f"{name.label}: counts per turn are not known: left out; write the unit [1/4096 turn], or "
                f"`encoder = {{ counts = 4096 }}` of {name.name} into the stand file"
            )
            return None
        track.notes.append(f"{name.label}: {turn} counts per turn, as seen between pulses of its tacho")
    modulus = modulus_of(values, turn)
    if modulus is not None:
        expected = _expected_steps(track, name.name, turn / TURN)
        values, wraps, unsure = unwrap(values, modulus, expected)
        _note_wraps(track, name, f"{modulus} counts", wraps, unsure)
    return np.asarray((values - zero) * (TURN / turn))


def _seen_counts(track: Track, name: Name, values: Array) -> int | None:
    """Counts between pulses of the tacho of the same flywheel; None without, or where they are no whole number."""
    tacho = next((x for n, x in track.values.items() if n.name == name.name and n.quantity == "tacho"), None)
    if tacho is None:
        return None
    pulses = find_pulses(track.t, tacho)
    if pulses is None:
        return None
    modulus = modulus_of(values, None)
    whole = values if modulus is None else unwrap(values, modulus)[0]
    finite = np.isfinite(whole)
    at = np.interp(pulses.times, track.t[finite], whole[finite])
    ratio = (at[-1] - at[0]) / (pulses.turns[-1] - pulses.turns[0])
    nearest = round(ratio)
    return nearest if nearest and abs(ratio - nearest) < DIFFERENT * min(abs(ratio), 10.0) else None


def _of_pulses(track: Track, name: Name, values: Array) -> Array | None:
    """Phase of pulses once a turn; None if there are fewer than two."""
    pulses = find_pulses(track.t, values)
    if pulses is None:
        track.notes.append(f"{name.label}: fewer than two pulses: left out")
        return None
    speed = _speed(track, name.name)
    direction = 1.0 if speed is None or np.nanmean(speed) >= 0.0 else -1.0
    if pulses.double:
        track.notes.append(f"{name.label}: {count(pulses.double, 'double pulse')}: left out")
    if pulses.lost:
        track.notes.append(f"{name.label}: {count(pulses.lost, 'lost pulse')}: a whole turn each")
    sense = "direction of its speed" if speed is not None else "turning forwards"
    track.notes.append(
        f"{name.label}: {count(len(pulses.times), 'pulse')} as phase, zero at a pulse, {sense}; missing outside them"
    )
    return phase_of(pulses, track.t, direction)


def _compare(track: Track, name: Name, values: Array) -> None:
    """A note on the turns that pulses show, where a phase is there as well."""
    pulses = find_pulses(track.t, values)
    seen = "no two pulses" if pulses is None else count(round(float(pulses.turns[-1])), "turn")
    track.notes.append(f"{name.label}: {seen}; not used, the phase of {name.name} is there")


def _of_angles(track: Track, name: Name, values: Array) -> Array:
    """Phase that goes on over whole turns."""
    finite = values[np.isfinite(values)]
    inside = len(finite) > 1 and np.ptp(finite) <= TURN * (1.0 + 1e-6)
    if not inside or np.abs(np.diff(finite)).max() <= 0.5 * TURN:
        return values
    found, wraps, unsure = unwrap(values, TURN, _expected_steps(track, name.name, 1.0))
    _note_wraps(track, name, "a turn", wraps, unsure)
    return found
