"""Steady vibration of a point against the common speed of the flywheels."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.core.stand.model import Stand
from mahovik.core.stand.summary import summarize
from mahovik.errors import CheckError, UsageError
from mahovik.out.report.plot.inline import charts
from mahovik.out.report.plot.response import panels
from mahovik.out.report.stand.markup import paragraph
from mahovik.out.report.stand.material import Material, Section
from mahovik.use.study.response.speeds import ALL, read_speeds
from mahovik.use.study.response.sweep import Sweep, sweep

STEPS = 31
"""Speeds of a sweep, rest among them."""

NEAR, FAR = 1.6, 2.0
"""A first diagram ends at NEAR times the highest natural frequency at rest, if the limit is FAR times that."""

STILL = 1e-10
"""m/s2: less than this is rounding."""

ANCHOR, TITLE = "response", "Response: steady vibration against speed"


def section(material: Material) -> Section | None:
    """The section; None without flywheels."""
    stand = material.stand
    if not stand.flywheels:
        return None
    limit = max(row.speed for row in summarize(stand).unbalance)
    try:
        found = [sweep_speeds(stand, limit)]
        near = NEAR * 2.0 * math.pi * max((float(f) for f in found[0].steps[0].natural), default=0.0)
        if 0.0 < near < limit / FAR:
            found.insert(0, sweep_speeds(stand, near))
    except (CheckError, UsageError) as error:
        return Section(ANCHOR, TITLE, paragraph(f"{error}. So there is no steady vibration to show."))
    largest, speed = max(map(_largest, found))
    if largest < STILL:
        return Section(ANCHOR, TITLE, paragraph(f"Nothing shakes {_point(found[0])}: the flywheels are balanced."))
    summary = f"at most {largest:.3g} {found[0].unit} RMS at {_point(found[0])}, at {RPM * speed:.4g} rpm"
    shown = [panels(each)[0] for each in found]
    return Section(ANCHOR, TITLE, paragraph(_words(found)) + charts(shown), summary=summary)


def sweep_speeds(stand: Stand, limit: float) -> Sweep:
    """Accelerations of the first instrument, else of O1, up to a common speed, rad/s.

    Raises CheckError; KeyboardInterrupt at Ctrl-C, because a part of the sweep makes no section.
    """
    point = stand.instruments[0].name if stand.instruments else "carrier"
    found = sweep(stand, read_speeds(stand, [f"{ALL}=0..{limit!r} rad/s"]), STEPS, point)
    if found.interrupted:
        raise KeyboardInterrupt
    return found


def _largest(found: Sweep) -> tuple[float, float]:
    """Largest RMS, and the speed where it is, rad/s."""
    sizes = np.linalg.norm(np.nan_to_num(found.rms()), axis=1)
    return float(sizes.max()), float(found.values[int(sizes.argmax())])


def _point(found: Sweep) -> str:
    return "O1 of the carrier" if found.point == "carrier" else found.point


def _words(found: Sequence[Sweep]) -> str:
    missing = sum(step.problem is not None for each in found for step in each.steps)
    words = (
        f"Amplitudes of the acceleration of {_point(found[0])} by order, exact for the full equations; all flywheels "
        f"at one common speed, {STEPS} of them in each diagram, all phases 0 at t = 0. "
    )
    words += "The first diagram is of speeds about the natural frequencies. " if len(found) > 1 else ""
    words += f"At {missing} speeds no steady state was found. " if missing else ""
    return words + "``mahovik response`` has other points, quantities and ratios of speeds, and spectra."
