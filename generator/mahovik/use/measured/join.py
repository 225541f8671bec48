"""Recordings of one run that several loggers made, as one: sensors get the flywheels of another file or rate.

Sensors are never resampled. Phase, speed and torque of a flywheel are smooth and are interpolated at their times.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.interpolate import make_interp_spline

from mahovik.use.measured.clock import clock_offset
from mahovik.use.measured.recording import GAP, Array, Channel, Recording

SHARE = 0.5
"""Part of the time of the sensors that flywheels of another file have to cover."""

LONGEST = 0.5
"""Largest gap in s over which a flywheel is interpolated, unless its own step is longer."""


def join(recordings: list[tuple[str, Recording]]) -> tuple[Recording, ...]:
    """Recordings of (file, recording): those of flywheels alone are taken into those of sensors, where they fit."""
    sensors = [(file, r) for file, r in recordings if not _flywheels_only(r)]
    donors = [(file, r) for file, r in recordings if _flywheels_only(r)]
    used: set[int] = set()
    found = []
    for place, (file, recording) in enumerate(sensors):
        joined = recording
        for k in _partners(place, sensors, donors):
            other_file, donor = donors[k]
            taken = _take(joined, donor, same_clock=file == other_file)
            if taken is not joined:
                used.add(k)
                joined = taken
        found.append(joined)
    left = [donor for k, (_, donor) in enumerate(donors) if k not in used]
    return (*found, *left)


def _flywheels_only(recording: Recording) -> bool:
    return all(channel.kind == "flywheel" for channel in recording.channels)


def _partners(place: int, sensors: list[tuple[str, Recording]], donors: list[tuple[str, Recording]]) -> list[int]:
    """Donors of a recording of sensors: of its own file all; of other files those that overlap, by order if many."""
    file, recording = sensors[place]
    own = [k for k, (other, _) in enumerate(donors) if other == file]
    other = [k for k, (name, donor) in enumerate(donors) if name != file and _covers(donor, recording)]
    by_content: dict[tuple[str, ...], list[int]] = {}
    for k in other:
        by_content.setdefault(tuple(sorted(c.label for c in donors[k][1].channels)), []).append(k)
    rank = place
    chosen = []
    for alike in by_content.values():
        if len(alike) == 1:
            chosen += alike
        elif len(alike) == len(sensors):
            chosen.append(alike[rank])
    return own + sorted(chosen)


def _covers(donor: Recording, recording: Recording) -> bool:
    if len(donor.t) < 2 or len(recording.t) < 2:
        return False
    common = min(donor.t[-1], recording.t[-1]) - max(donor.t[0], recording.t[0])
    return bool(common > SHARE * np.ptp(recording.t))


def _take(recording: Recording, donor: Recording, same_clock: bool) -> Recording:
    """The recording with the channels of a donor that it lacks; itself if there is none."""
    have = {channel.label for channel in recording.channels}
    missing = [channel for channel in donor.channels if channel.label not in have]
    if not missing:
        return recording
    shift, notes = 0.0, []
    if not same_clock:
        shift, note = _shift(recording, donor)
        notes.append(note)
    t = donor.t + shift
    taken = tuple(replace(channel, values=at_times(t, channel, recording.t)) for channel in missing)
    names = ", ".join(sorted({channel.name for channel in missing}))
    notes.append(f"{recording.source}: {names} from {donor.source}, interpolated at the times of the sensors")
    return replace(
        recording,
        channels=(*recording.channels, *taken),
        source=recording.source if same_clock else f"{recording.source} + {donor.source}",
        notes=(*recording.notes, *donor.notes, *notes),
    )


def _shift(recording: Recording, donor: Recording) -> tuple[float, str]:
    """Seconds to add to the times of the donor, and a note."""
    where = f"{recording.source}: clock of {donor.source}"
    for channel in recording.channels:
        other = donor.find(channel.name, channel.quantity, channel.component)
        if other is None:
            continue
        found = clock_offset(recording.t, _signal(recording.t, channel), donor.t, _signal(donor.t, other))
        if found is None:
            continue
        if not found.safe:
            return 0.0, (
                f"{where}: {channel.label} of both does not fit at one offset alone (correlation "
                f"{found.correlation:.2f} at {found.seconds:.4g} s): taken as equal"
            )
        words = "ahead" if found.seconds < 0 else "behind"
        return found.seconds, f"{where}: {abs(found.seconds):.4g} s {words} by {channel.label}: corrected"
    return 0.0, f"{where}: no channel is in both that shows an offset: taken as equal"


def _signal(t: Array, channel: Channel) -> Array:
    """What is compared: of a phase its rate."""
    if channel.quantity != "phase" or len(t) < 3:
        return channel.values
    return np.asarray(np.gradient(channel.values, t))


def at_times(t: Array, channel: Channel, times: Array) -> Array:
    """A channel of a flywheel at other times; NaN outside its own and in long gaps. Cubic for a phase, else linear."""
    kept = np.isfinite(channel.values)
    own, values = t[kept], channel.values[kept]
    if len(own) < 4:
        return np.full(len(times), np.nan)
    cubic = channel.quantity == "phase"
    found = make_interp_spline(own, values, k=3)(times) if cubic else np.interp(times, own, values)
    after = np.clip(np.searchsorted(own, times), 1, len(own) - 1)
    far = own[after] - own[after - 1] > max(LONGEST, GAP * float(np.median(np.diff(own))))
    outside = (times < own[0]) | (times > own[-1])
    return np.asarray(np.where(far | outside, np.nan, found))
