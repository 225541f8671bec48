"""Parts of the page on an identification: numbers, then each flywheel by the orders of its speed."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from mahovik.errors import InputError
from mahovik.out.identify.estimate import Fit
from mahovik.out.identify.figures import ChannelFit, Parameter
from mahovik.out.identify.free import Free
from mahovik.out.identify.run import Run
from mahovik.out.report.data.panels import confidence_ellipse, order_panels
from mahovik.out.report.page import Cell, Part, figure
from mahovik.out.report.plots import Panel
from mahovik.use.measured import Recording
from mahovik.use.measured.orders import OrderMap, merge_maps, order_map

Array = NDArray[np.float64]

G_MM = 1e6
"""1 kg m in g mm."""

ORDERS = (1, 2, 3, 4)
"""Orders of a flywheel whose residuals have figures."""

SIGNALS = ("measured", "modelled", "residual")
COMPARED = (("measured", "modelled"), ("measured", "residual"))

WORDS = (
    "Amplitudes of {channel}, the channel that tells most of {wheel}, over orders of {wheel}. Modelled: the stand with "
    "the estimated numbers. Residual: measured less modelled; an order that stands out of it is one that the stand "
    "does not have. An ellipse has the static unbalance with 95 % confidence; axes are those of the flywheel."
)


class Figures(Protocol):
    """Results of an identification, as far as the page shows them."""

    @property
    def parameters(self) -> Mapping[str, Parameter]: ...

    @property
    def channels(self) -> Mapping[str, Mapping[str, ChannelFit]]: ...

    @property
    def unobservable(self) -> tuple[str, ...]: ...

    @property
    def residual(self) -> float: ...

    @property
    def check(self) -> tuple[float, float] | None: ...

    @property
    def notes(self) -> tuple[str, ...]: ...


@dataclass(frozen=True, eq=False)
class Comparison:
    """Data beside the fit: recordings, their runs in the same sequence, free numbers and estimate."""

    recordings: tuple[Recording, ...]
    runs: tuple[Run, ...]
    free: Free
    fit: Fit


def residual_orders(at: Comparison) -> dict[str, dict[str, dict[str, list[float]]]]:
    """Amplitudes of the residuals at ORDERS (SI) by run, flywheel and channel."""
    found: dict[str, dict[str, dict[str, list[float]]]] = {}
    for r, (recording, run) in enumerate(zip(at.recordings, at.runs, strict=True)):
        own = found.setdefault(run.source, {})
        for wheel, phase in _phases(recording, at.free).items():
            own[wheel] = {
                channel.name: [_amplitude(at.fit.residuals[r][:, c], phase, order) for order in ORDERS]
                for c, channel in enumerate(run.channels)
            }
    return found


def identification_parts(found: Figures, at: Comparison) -> list[Part]:
    """The numbers, what is left of the channels, a part for each flywheel, and what was found in the data."""
    parts = [_numbers(found), _channels(found)]
    parts += [_wheel(at, wheel.name) for wheel in at.free.stand.flywheels]
    if found.notes:
        parts.append(Part("Data", "What was found in the data, and corrected:", notes=found.notes))
    return parts


def _numbers(found: Figures) -> Part:
    rows = tuple(
        (each.path, figure(each.value, 6), figure(each.standard_error, 2), figure(each.before, 6), each.unit)
        for each in found.parameters.values()
    )
    head = ("Number", "value>", "standard error>", "in the file>", "unit")
    words = "Estimated numbers in SI, from the data alone; what the data cannot tell keeps its value in the file."
    return Part("Numbers", words, head, rows, notes=found.unobservable, summary=f"{len(rows)} numbers")


def _channels(found: Figures) -> Part:
    rows: list[tuple[Cell, ...]] = [
        (run, name, figure(each.residual, 3), each.unit, _percent(each.share))
        for run, channels in found.channels.items()
        for name, each in channels.items()
    ]
    words = "Root mean square of measured less modelled, and its share of that of the data."
    notes: tuple[str, ...] = ()
    if found.check is not None:
        after, before = (100.0 * x for x in found.check)
        notes = (f"Data that were not used: {after:.3g} % left, {before:.3g} % with the numbers of the file.",)
    head = ("Run", "channel", "left>", "unit", "of the data, %>")
    return Part("What is left", words, head, tuple(rows), notes=notes, summary=f"{_percent(found.residual)} % left")


def _percent(share: float) -> str:
    return "-" if math.isnan(share) else f"{100.0 * share:.3g}"


def _wheel(at: Comparison, wheel: str) -> Part:
    maps: dict[str, list[OrderMap]] = {name: [] for name in SIGNALS}
    notes: list[str] = []
    strongest = _strongest(at, wheel)
    for r, (recording, run) in enumerate(zip(at.recordings, at.runs, strict=True)):
        c = next((c for c, channel in enumerate(run.channels) if channel.name == strongest), None)
        if c is None:
            continue
        channel = run.channels[c]
        measured = recording.find(channel.point, channel.kind, channel.letter)
        assert measured is not None
        left = at.fit.residuals[r][:, c]
        signals = (run.measured[:, c], run.measured[:, c] - left, left)
        try:
            for name, values in zip(SIGNALS, signals, strict=True):
                maps[name].append(order_map(recording, wheel, measured, values))
        except InputError as error:
            notes.append(f"{error}")
    panels = order_panels({name: merge_maps(each) for name, each in maps.items() if each}, COMPARED)
    return Part(
        f"Flywheel {wheel}",
        WORDS.format(channel=strongest, wheel=wheel),
        panels=(*panels, *_ellipse(at, wheel)),
        notes=tuple(notes),
    )


def _ellipse(at: Comparison, wheel: str) -> list[Panel]:
    """Static unbalance along the second and third axis, where amount and angle are free."""
    row = 0
    for entry in at.free.entries:
        if entry.polar and entry.paths[0] == f"{wheel}.unbalance.static":
            own = slice(row, row + 2)
            axes = ("along the second axis, g mm", "along the third axis, g mm")
            covariance = G_MM**2 * at.fit.covariance[own, own]
            return [confidence_ellipse("Static unbalance", axes, G_MM * at.fit.theta[own], covariance)]
        row += len(entry.numbers)
    return []


def _phases(recording: Recording, free: Free) -> dict[str, Array]:
    """Measured phases (T) by flywheel."""
    found = {wheel.name: recording.find(wheel.name, "phase") for wheel in free.stand.flywheels}
    return {name: channel.values for name, channel in found.items() if channel is not None}


def _strongest(at: Comparison, wheel: str) -> str:
    """The channel whose first order is the largest multiple of its noise."""
    sizes: list[tuple[float, str]] = []
    for r, (recording, run) in enumerate(zip(at.recordings, at.runs, strict=True)):
        phase = _phases(recording, at.free).get(wheel)
        for c, channel in enumerate(run.channels if phase is not None else ()):
            sizes.append((_amplitude(run.measured[:, c], phase, 1) / float(at.fit.noise[r][c]), channel.name))
    return max(sizes)[1] if sizes else ""


def _amplitude(values: Array, phase: Array | None, order: int) -> float:
    """Amplitude of an order of a signal (T), of the samples that exist."""
    assert phase is not None
    kept = np.isfinite(values) & np.isfinite(phase)
    if not kept.any():
        return 0.0
    own = values[kept] - values[kept].mean()
    return float(2.0 * abs(np.mean(own * np.exp(-1j * order * phase[kept]))))
