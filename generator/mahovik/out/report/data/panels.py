"""Charts of measured data from plain arrays: waterfall and spectra over orders, ellipses of confidence."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.out.report.plots import HEIGHT, WIDTH, Array, Line, Mark, Panel
from mahovik.use.measured.orders import OrderMap

DECADES = 3.0
"""Powers of ten below the largest amplitude that are shown."""

RADIUS = math.sqrt(-2.0 * math.log(0.05))
"""Standard deviations from centre to edge of an ellipse that has 95 % of a plane's normal distribution."""

POINTS = 121


def waterfall(maps: Mapping[str, OrderMap]) -> Panel:
    """Spectra over orders at their speeds, a colour for each named map, as measured and as modelled.

    Heights are powers of ten above a floor, all decades as high as two spectra apart.
    """
    first = next(iter(maps.values()))
    largest = max(float(np.nanmax(each.amplitude, initial=0.0)) for each in maps.values()) or 1.0
    floor = largest * 10.0**-DECADES
    lines = []
    for colour, (name, each) in enumerate(maps.items()):
        speed = RPM * each.speed
        apart = float(np.ptp(speed)) / max(len(speed) - 1, 1) or 0.02 * float(speed.max())
        for k, row in enumerate(each.amplitude):
            height = 2.0 * apart * np.log10(np.maximum(row, floor) / floor) / DECADES
            lines.append(Line(name if k == 0 else "", each.orders, speed[k] + height, colour))
    return Panel(
        f"{first.channel} over orders of {first.flywheel}, speed in rpm",
        tuple(lines),
        note=f"heights: {DECADES:g} decades below {largest:.3g} {first.unit} are two spectra apart",
        abscissa=f"order of {first.flywheel}",
        height=2.0,
        span=(0.0, float(first.orders[-1])),
    )


def order_spectra(title: str, unit: str, orders: Array, spectra: Mapping[str, Array], flywheel: str) -> Panel:
    """Spectra (R,) over orders (R,) by name: before and after, measured and modelled, or a residual and its noise."""
    largest = max((float(np.nanmax(each, initial=0.0)) for each in spectra.values()), default=0.0) or 1.0
    floor = largest * 10.0 ** -(DECADES + 1.0)
    lines = tuple(Line(name, orders, np.maximum(y, floor), k) for k, (name, y) in enumerate(spectra.items()))
    return Panel(f"{title}, {unit}", lines, log=True, abscissa=f"order of {flywheel}", height=1.4)


def order_panels(maps: Mapping[str, OrderMap], compared: Sequence[tuple[str, str]]) -> list[Panel]:
    """Spectra of all maps, and, where there are several speeds, a waterfall for each pair of names."""
    if not maps:
        return []
    first = next(iter(maps.values()))
    spectra = {name: each.spectrum for name, each in maps.items()}
    panels = [
        order_spectra(f"RMS over all speeds of {first.channel}", first.unit, first.orders, spectra, first.flywheel)
    ]
    if len(first.speed) > 1:
        panels += [waterfall({name: maps[name] for name in names}) for names in compared]
    return panels


def confidence_ellipse(title: str, axes: tuple[str, str], centre: Array, covariance: Array) -> Panel:
    """Edge of the 95 % region of two parameters (centre (2,), covariance (2, 2)), with scales alike in both axes.

    axes   names of the parameters with units
    """
    sx, sy = (math.sqrt(max(float(covariance[k, k]), 0.0)) for k in (0, 1))
    rho = float(covariance[0, 1]) / (sx * sy) if sx and sy else 0.0
    edges = []
    for side in (1.0, -1.0):
        angle = np.linspace(np.pi, 0.0, POINTS)
        x = centre[0] + RADIUS * sx * np.cos(angle)
        across = side * math.sqrt(max(1.0 - rho**2, 0.0)) * np.sin(angle)
        edges.append(Line("", x, centre[1] + RADIUS * sy * (rho * np.cos(angle) + across), 0))
    height = 2.0
    wide = (WIDTH - 2.0) / (HEIGHT * height)  # without the legend
    half = max(1.1 * RADIUS * max(sy * wide, sx), 1e-9 * abs(float(centre[0])), 1e-300)
    return Panel(
        f"{title}: {axes[1]}",
        tuple(edges),
        note="95 % of the distribution",
        abscissa=axes[0],
        height=height,
        marks=(Mark(float(centre[0]), float(centre[1]), "estimate"),),
        span=(float(centre[0]) - half, float(centre[0]) + half),
    )
