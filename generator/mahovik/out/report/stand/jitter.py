"""Jitter of a point against the common speed of the flywheels: sums, waterfall, cumulative RMS, budget."""

from __future__ import annotations

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.core.stand.model import Stand
from mahovik.core.stand.summary import summarize
from mahovik.errors import CheckError, UsageError
from mahovik.out.report.plot.inline import charts
from mahovik.out.report.plot.jitter import report_panels
from mahovik.out.report.stand.markup import paragraph
from mahovik.out.report.stand.material import Material, Section
from mahovik.out.report.stand.response import measured_points
from mahovik.use.study.jitter import Jitter, View, jitter
from mahovik.use.study.jitter.quantity import ARCSEC
from mahovik.use.study.linear.model import places
from mahovik.use.study.response.speeds import ALL, read_speeds

STEPS = 121
"""Speeds of the sweep, rest among them."""

STILL = 1e-15
"""rad: less than this is rounding."""

ANCHOR, TITLE = "jitter", "Jitter: angle of a point"


def section(material: Material) -> Section | None:
    """The section; None without flywheels, of a held carrier, or where there is no steady motion.

    The section on the response says why there is none.
    """
    stand = material.stand
    if not stand.flywheels or stand.hold is not None:
        return None
    try:
        found = swept(stand, max(row.speed for row in summarize(stand).unbalance))
    except (CheckError, UsageError):
        return None
    worst = found.worst_step
    size = float(np.linalg.norm(found.lines.rss()[worst]))
    if not STILL < size < np.inf:
        return None
    where = "O1 of the carrier" if found.point == stand.carrier.name else found.point
    summary = (
        f"at most {ARCSEC * size:.3g} arcsec RMS over all phases at {where}, at {RPM * found.value[worst]:.4g} rpm"
    )
    return Section(ANCHOR, TITLE, paragraph(_words(found, where)) + charts(report_panels(found)), summary=summary)


def swept(stand: Stand, limit: float) -> Jitter:
    """Angle of the first measured point, up to a common speed, rad/s. Raises CheckError."""
    (place,) = places(stand, measured_points(stand)[:1])
    found = jitter(stand, read_speeds(stand, [f"{ALL}=0..{limit!r} rad/s"]), STEPS, View.of(place, "angle"))
    if found.interrupted:
        raise KeyboardInterrupt
    return found


def _words(found: Jitter, where: str) -> str:
    off = max((check.off for check in found.checks), default=0.0)
    return (
        f"Angle of {where}, amplitudes 0 to peak, to first order in the unbalance, {STEPS} common speeds of all "
        f"flywheels. The full equations, solved at {len(found.checks)} of them, give the same RMS within {off:.1e}. "
        "The last two diagrams are of the worst speed. ``mahovik jitter`` takes any speeds, makers' tables, modes, "
        "requirements."
    )
