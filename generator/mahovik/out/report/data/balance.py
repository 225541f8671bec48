"""Parts of the page on balancing by measured data: corrections, then each flywheel."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.errors import InputError
from mahovik.out.report.data.panels import confidence_ellipse, order_panels
from mahovik.out.report.page import Cell, Part, figure
from mahovik.out.report.plots import Array, Panel
from mahovik.use.balance.by_model import WheelBalance
from mahovik.use.balance.polar import Complex
from mahovik.use.measured import Channel, Recording
from mahovik.use.measured.orders import OrderMap, merge_maps, order_map

G_MM = 1e6
"""1 kg m in g mm."""

SIGNALS = ("measured", "modelled", "residual", "corrected")
COMPARED = (("measured", "modelled"), ("measured", "corrected"))

WORDS = (
    "Amplitudes of {channel}, the channel in which the first order is largest, over orders of {wheel}. Modelled: first "
    "orders of all flywheels by the unbalances found. Residual: measured less modelled. Corrected: measured, changed "
    "by the corrections as the model says. An ellipse has the unbalance of a plane with 95 % confidence; axes are "
    "those of the flywheel at phase zero."
)

HEAD = ("Flywheel", "plane, mm>", "correction, g mm>", "at, deg>")
MADE = ("made, g mm>", "at, deg>")


def balance_parts(recordings: Sequence[Recording], wheels: Sequence[WheelBalance], notes: Sequence[str]) -> list[Part]:
    """The corrections, the vibration, one part for each flywheel, and what was found in the data."""
    parts = [_corrections(wheels), _vibration(wheels), *(_wheel(recordings, wheels, each) for each in wheels)]
    if notes:
        parts.append(Part("Data", "What was found in the data, and corrected:", notes=tuple(notes)))
    return parts


def _corrections(wheels: Sequence[WheelBalance]) -> Part:
    rows, pieces = [], any(wheel.made is not None for wheel in wheels)
    for wheel in wheels:
        for k, x in enumerate(wheel.positions):
            made = _polar(complex(wheel.applied[k])) if pieces else []
            residual = figure(G_MM * float(wheel.residual[k]), 3)
            rows.append((wheel.name, figure(1e3 * x), *_polar(complex(wheel.w[k])), *made, residual))
    words = (
        "Masses to add times radii, in planes at these places on the axis of each flywheel; angles are counted from "
        "the flywheel's second axis at phase zero. Residual: the unbalance of the plane after correction, not exceeded "
        "with 95 % confidence."
    ) + (" Made: by the pieces chosen." if pieces else "")
    head = (*HEAD, *(MADE if pieces else ()), "residual, g mm>")
    return Part("Corrections", words, head, tuple(rows), summary=f"{len(rows)} planes of {len(wheels)} flywheels")


def _vibration(wheels: Sequence[WheelBalance]) -> Part:
    rows: list[tuple[Cell, ...]] = []
    for wheel in wheels:
        simulated = {name: values for name, *values in wheel.simulated}
        for name, before, after in wheel.vibration:
            unit = "m/s2" if name == "acceleration" else "rad/s"
            full = [figure(x, 4) for x in simulated[name]] if name in simulated else ["", ""]
            rows.append(
                (wheel.name, f"{name}, {unit}", figure(RPM * wheel.speed), figure(before, 4), figure(after, 4), *full)
            )
    head = (
        "Flywheel", "of all channels", "speed, rpm>", "measured>", "corrected>", "simulated before>", "simulated after>"
    )  # fmt: skip
    words = (
        "First order at the fastest of the recordings, root of the sum of squares over the channels. Corrected: as "
        "measured, with the change that the model expects. Simulated: by the full equations, with the unbalance found, "
        "without and with the corrections; noise is not in it."
    )
    return Part("Vibration before and after", words, head, tuple(rows))


def _polar(w: complex) -> list[Cell]:
    return [figure(G_MM * abs(w), 5), figure(math.degrees(math.atan2(w.imag, w.real)) % 360.0, 4)]


def _wheel(recordings: Sequence[Recording], wheels: Sequence[WheelBalance], wheel: WheelBalance) -> Part:
    label = _strongest(wheel)
    maps: dict[str, list[OrderMap]] = {name: [] for name in SIGNALS}
    failure = ""
    for first in wheel.firsts:
        recording = recordings[first.recording]
        channel = next((c for c in recording.channels if c.label == label), None)
        if channel is None:
            continue
        try:
            for name, values in _signals(recording, channel, wheels, first.recording).items():
                maps[name].append(order_map(recording, wheel.name, channel, values))
        except InputError as error:
            failure = f"{error}"
    panels = order_panels({name: merge_maps(each) for name, each in maps.items() if each}, COMPARED)
    panels += [_ellipse(wheel, k) for k in range(len(wheel.positions))]
    lowered = ", ".join(f"{name} {before:.4g} → {after:.3g}" for name, before, after in wheel.vibration)
    return Part(
        f"Flywheel {wheel.name}",
        WORDS.format(channel=label, wheel=wheel.name),
        panels=tuple(panels),
        notes=(failure,) if failure else (),
        summary=f"first order of {lowered}",
    )


def _strongest(wheel: WheelBalance) -> str:
    """Channel in which the first order is largest; an acceleration, if there is any."""
    sizes = [
        (".acceleration." in label, float(abs(x)), label)
        for first in wheel.firsts
        for label, x in zip(first.channels, first.measured, strict=True)
    ]
    return max(sizes)[2]


def _signals(recording: Recording, channel: Channel, wheels: Sequence[WheelBalance], number: int) -> dict[str, Array]:
    """Values (T,) of a channel by name of the signal."""
    model, change = np.zeros(len(recording.t)), np.zeros(len(recording.t))
    for wheel in wheels:
        phase = recording.find(wheel.name, "phase")
        first = next((each for each in wheel.firsts if each.recording == number), None)
        if phase is None or first is None or channel.label not in first.channels:
            continue
        influence: Complex = first.influence[first.channels.index(channel.label)]
        turn = np.exp(1j * phase.values)
        model -= (complex(influence @ wheel.w) * turn).real
        change += (complex(influence @ wheel.applied) * turn).real
    x = channel.values
    return dict(zip(SIGNALS, (x, model, x - model, x + change), strict=True))


def _ellipse(wheel: WheelBalance, k: int) -> Panel:
    """Unbalance of a plane, which its correction undoes; both components have the same variance."""
    u = -complex(wheel.w[k])
    variance = float(wheel.error[k]) ** 2
    axes = ("along the second axis, g mm", "along the third axis, g mm")
    title = f"Unbalance in the plane at {1e3 * wheel.positions[k]:g} mm"
    return confidence_ellipse(title, axes, G_MM * np.array([u.real, u.imag]), G_MM**2 * variance * np.eye(2))
