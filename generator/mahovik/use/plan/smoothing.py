"""Dry friction whose smoothing is small beside the speeds of a motion: its step needs many harmonics of a programme."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from mahovik.core.lower.law_arrays import LawArrays, law_arrays
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.hold import twists as freedom_twists
from mahovik.core.stand.hold import wrenches
from mahovik.core.stand.law import CarrierLaw
from mahovik.core.stand.model import Stand
from mahovik.use.numeric import Array, Frame

STEEP = 10.0
"""Largest speed of a freedom over the smoothing of its friction, above which the search may be long."""

_TIMES, _HIGH, _ROUNDING = 512, 1e6, 1e-9


def smoothing_warnings(stand: Stand, motion: RequiredMotion) -> list[str]:
    """A line for each freedom of a held carrier that reverses its speed within a small part of it under dry friction.

    Without it, or on a free carrier: none.
    """
    if stand.hold is None or not stand.hold.freedoms:
        return []
    own = [law for law in stand.laws if isinstance(law, CarrierLaw)]
    dry = tuple(law for law in own if law.longest_steps([1.0] * len(stand.hold.freedoms)))
    laws = law_arrays(replace(stand, laws=dry))
    coordinates, found = coordinates_of(stand), []
    at = Frame.of(stand).twists(motion.at(np.linspace(0.0, motion.span, _TIMES)))
    speeds = at.V @ wrenches(stand.hold)
    for k, S in enumerate(freedom_twists(stand.hold).T):
        peak = float(np.abs(speeds[:, k]).max())
        reverses = speeds[:, k].min() < 0.0 < speeds[:, k].max()
        if reverses and laws.ties and _is_steep(laws, S, peak / STEEP):
            unit = f" {coordinates.unit_names[k]}/s" if coordinates.unit_names[k] else " 1/s"
            found.append(
                f"friction of {coordinates.in_words[k]}: its `smoothing` is small beside the motion's speeds, up to "
                f"{peak:.2g}{unit}, and its steps need many harmonics, so that the search may take very long; use "
                f"--time, or a `smoothing` of {_rounded_up(2.0 * peak / STEEP):g}{unit} or more"
            )
    return found


def _is_steep(laws: LawArrays, S: Array, u: float) -> bool:
    """Whether u (above 0) is beyond the smoothing s of the dry friction along S (6), by its forces and slopes.

    F = c u + F_c u / sqrt(u^2 + s^2) has F - c u = (F'(0) - c) u / sqrt(2) at u = s; c is F' at high speeds. With a
    rise of breakaway that is so at 0.5 s or more.
    """
    V = np.outer([0.0, u, _HIGH * u], S)
    at = np.zeros((3, 3)), np.tile(np.eye(3), (3, 1, 1)), V
    force = -laws.tied(*at) @ S
    first, _, last = (-(S @ slope[:, 6:] @ S) for slope in laws.tied_slopes(*at))
    return bool(first > last * (1.0 + _ROUNDING) and force[1] - last * u < (first - last) * u / np.sqrt(2.0))


def _rounded_up(x: float) -> float:
    """The next number above x > 0 of one digit."""
    unit = 10.0 ** math.floor(math.log10(x))
    return math.ceil(x / unit) * unit
