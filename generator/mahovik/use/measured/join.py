"""Recordings of one run that several loggers made, as one: sensors get the flywheels of another file or rate.

Sensors are never resampled. Phase, speed and torque of a flywheel are smooth and are interpolated at their times.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.interpolate import make_interp_spline

from mahovik.use.measured.clock import clock_drift, clock_offset
from mahovik.use.measured.recording import GAP, Array, Channel, Recording
from mahovik.use.measured.times import count

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
        own, notes = _own_partners(place, sensors, donors)
        joined = replace(recording, notes=(*recording.notes, *notes))
        for k in own + _other_partners(place, sensors, donors):
            other_file, donor = donors[k]
            joined, taken = _take(joined, donor, same_clock=file == other_file)
            if taken:
                used.add(k)
        found.append(joined)
    left = [donor for k, (_, donor) in enumerate(donors) if k not in used]
    return (*found, *left)


def _flywheels_only(recording: Recording) -> bool:
    return all(channel.kind == "flywheel" for channel in recording.channels)


def _labels(recording: Recording) -> tuple[str, ...]:
    return tuple(sorted(channel.label for channel in recording.channels))


def _own_partners(
    place: int, sensors: list[tuple[str, Recording]], donors: list[tuple[str, Recording]]
) -> tuple[list[int], list[str]]:
    """Donors of the same file, and notes. Recordings of the same channels are runs: the k-th gets the k-th donor."""
    file, recording = sensors[place]
    runs = [i for i, (other, r) in enumerate(sensors) if other == file and _labels(r) == _labels(recording)]
    by_content: dict[tuple[str, ...], list[int]] = {}
    for k, (other, donor) in enumerate(donors):
        if other == file:
            by_content.setdefault(_labels(donor), []).append(k)
    chosen, notes = list[int](), list[str]()
    for labels, alike in by_content.items():
        if len(alike) == len(runs):
            chosen.append(alike[runs.index(place)])
        else:
            many = f"{count(len(alike), 'run')} in the file, but {len(runs)} of these sensors"
            notes.append(f"{recording.source}: {', '.join(labels)}: {many}: not taken")
    return sorted(chosen), notes


def _other_partners(place: int, sensors: list[tuple[str, Recording]], donors: list[tuple[str, Recording]]) -> list[int]:
    """Donors of other files that overlap, by order if many."""
    file, recording = sensors[place]
    by_content: dict[tuple[str, ...], list[int]] = {}
    for k, (name, donor) in enumerate(donors):
        if name != file and _covers(donor, recording):
            by_content.setdefault(_labels(donor), []).append(k)
    chosen = []
    for alike in by_content.values():
        if len(alike) == 1:
            chosen += alike
        elif len(alike) == len(sensors):
            chosen.append(alike[place])
    return sorted(chosen)


def _covers(donor: Recording, recording: Recording) -> bool:
    if len(donor.t) < 2 or len(recording.t) < 2:
        return False
    common = min(donor.t[-1], recording.t[-1]) - max(donor.t[0], recording.t[0])
    return bool(common > SHARE * np.ptp(recording.t))


def _take(recording: Recording, donor: Recording, same_clock: bool) -> tuple[Recording, bool]:
    """The recording with the channels of a donor that it lacks, and whether there are any."""
    have = {channel.label for channel in recording.channels}
    missing = [channel for channel in donor.channels if channel.label not in have]
    if not missing:
        return recording, False
    t, notes = donor.t, list[str]()
    if not same_clock:
        t, notes = _shift(recording, donor)
    found = [replace(channel, values=at_times(t, channel, recording.t)) for channel in missing]
    taken = [channel for channel in found if np.isfinite(channel.values).any()]
    absent = ", ".join(channel.label for channel in found if channel not in taken)
    if absent:
        words = f"{absent} of {donor.source}: no sample at the times of the sensors: not taken"
        notes.append(f"{recording.source}: {words}")
    if not taken:
        return replace(recording, notes=(*recording.notes, *notes)), False
    names = ", ".join(sorted({channel.name for channel in taken}))
    notes.append(f"{recording.source}: {names} from {donor.source}, interpolated at the times of the sensors")
    joined = replace(
        recording,
        channels=(*recording.channels, *taken),
        source=recording.source if same_clock else f"{recording.source} + {donor.source}",
        notes=(*recording.notes, *donor.notes, *notes),
    )
    return joined, True


def _shift(recording: Recording, donor: Recording) -> tuple[Array, list[str]]:
    """Times of the donor by the clock of the recording, and notes."""
    where = f"{recording.source}: clock of {donor.source}"
    for channel in recording.channels:
        other = donor.find(channel.name, channel.quantity, channel.component)
        if other is None:
            continue
        x, other_x = _signal(recording.t, channel), _signal(donor.t, other)
        found = clock_offset(recording.t, x, donor.t, other_x)
        if found is None:
            continue
        if not found.safe:
            return donor.t, [
                f"{where}: {channel.label} of both does not fit at one offset alone (correlation "
                f"{found.correlation:.2f} at {found.seconds:.4g} s): taken as equal"
            ]
        words = "ahead" if found.seconds < 0 else "behind"
        t = donor.t + found.seconds
        notes = [f"{where}: {abs(found.seconds):.4g} s {words} by {channel.label}: corrected"]
        drift = clock_drift(recording.t, x, t, other_x)
        if drift is not None:
            slope, intercept = drift
            t = slope * t + intercept
            words = "fast" if slope < 1.0 else "slow"
            notes.append(f"{where}: runs {1e6 * abs(slope - 1.0):.0f} ppm {words} by {channel.label}: corrected")
        return t, notes
    return donor.t, [f"{where}: no channel is in both that shows an offset: taken as equal"]


def _signal(t: Array, channel: Channel) -> Array:
    """Signal to compare: the rate of a phase, other values as they are."""
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
