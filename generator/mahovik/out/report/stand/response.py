"""Steady vibration of a point against the common speed of the flywheels."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.core.stand.hold import freedom_names
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.summary import summarize
from mahovik.errors import CheckError, UsageError
from mahovik.out.report.plot.inline import charts
from mahovik.out.report.plot.panel import Panel
from mahovik.out.report.plot.response import panels
from mahovik.out.report.stand.markup import message, paragraph
from mahovik.out.report.stand.material import Material, Section
from mahovik.out.report.stand.matrices import named_freedoms
from mahovik.use.study.response.held import REACTION
from mahovik.use.study.response.speeds import ALL, SpeedPlan, read_speeds
from mahovik.use.study.response.sweep import Sweep, sweep_outputs

STEPS = 31
"""Speeds of a sweep, rest among them."""

NEAR, FAR = 1.6, 2.0
"""A first diagram ends at NEAR times the highest natural frequency at rest, if the limit is FAR times that."""

STILL = 1e-10
"""m/s2: less than this is rounding."""

ANCHOR, TITLE = "response", "Response: steady vibration against speed"
HELD_TITLE = "Response: reaction of the hold against speed"

MOST_FREEDOMS, MOST_POINTS = 3, 3
"""Freedoms of a held carrier, and points of a stand, whose accelerations are shown."""


def section(material: Material) -> Section | None:
    """The section; None without flywheels."""
    stand = material.stand
    if not stand.flywheels:
        return None
    limit = max(row.speed for row in summarize(stand).unbalance)
    if stand.hold is not None:
        return _held_section(stand, stand.hold, limit)
    try:
        sweeps = _sweeps(stand, limit, [(name, None) for name in measured_points(stand)])
    except (CheckError, UsageError) as error:
        return Section(ANCHOR, TITLE, paragraph(f"{message(error)}. So there is no steady vibration to show."))
    shown, summaries = _panels_and_words(sweeps)
    points = " and ".join(_point(found) for found in sweeps[0])
    if not shown:
        return Section(ANCHOR, TITLE, paragraph(f"Nothing shakes {points}: the flywheels are balanced."))
    words = _words([found[0] for found in sweeps], points)
    return Section(ANCHOR, TITLE, paragraph(words) + charts(shown), summary="; ".join(summaries))


def measured_points(stand: Stand) -> list[str]:
    """The stand's first points, else its instruments, else O1."""
    return [each.name for each in (stand.points or stand.instruments)[:MOST_POINTS]] or [stand.carrier.name]


def _held_section(stand: Stand, hold: Hold, limit: float) -> Section:
    """The reaction, and accelerations of the freedoms and points, of a held carrier."""
    seen: list[tuple[str, str | None]]
    seen = [(REACTION, "force"), (REACTION, "moment")]
    seen += [(f"hold.{name}", None) for name in freedom_names(hold)[:MOST_FREEDOMS]]
    if hold.freedoms:
        seen += [(name, None) for name in measured_points(stand) if name != stand.carrier.name]
    try:
        sweeps = _sweeps(stand, limit, seen)
    except (CheckError, UsageError) as error:
        return Section(ANCHOR, HELD_TITLE, paragraph(f"{message(error)}. So there is no steady reaction to show."))
    shown, summaries = _panels_and_words(sweeps)
    if not shown:
        return Section(ANCHOR, HELD_TITLE, paragraph("Nothing shakes the hold: the flywheels are balanced."))
    words = _held_words(hold, [found[0] for found in sweeps])
    return Section(ANCHOR, HELD_TITLE, paragraph(words) + charts(shown), summary="; ".join(summaries[:2]))


def _sweeps(stand: Stand, limit: float, seen: Sequence[tuple[str, str | None]]) -> list[list[Sweep]]:
    """Outputs up to a common speed (rad/s), before it those about the natural frequencies if these are far below.

    Raises CheckError; KeyboardInterrupt at Ctrl-C, because a part of a sweep makes no section.
    """
    sweeps = [sweep_outputs(stand, _common_speed(stand, limit), STEPS, seen)]
    near = NEAR * 2.0 * math.pi * max((float(f) for f in sweeps[0][0].steps[0].natural), default=0.0)
    if 0.0 < near < limit / FAR:
        sweeps.insert(0, sweep_outputs(stand, _common_speed(stand, near), STEPS, seen))
    if any(found[0].interrupted for found in sweeps):
        raise KeyboardInterrupt
    return sweeps


def _panels_and_words(sweeps: Sequence[Sequence[Sweep]]) -> tuple[list[Panel], list[str]]:
    """Panels of the outputs that anything shakes, and what is largest in each."""
    shown, summaries = [], []
    for views in zip(*sweeps, strict=True):
        largest, speed = max(map(_largest, views))
        if largest >= STILL:
            shown += [panels(each)[0] for each in views]
            what = f"{views[0].quantity} of {_point(views[0])} at most {largest:.3g} {views[0].unit} RMS"
            summaries.append(f"{what} at {RPM * speed:.4g} rpm")
    return shown, summaries


def _held_words(hold: Hold, found: Sequence[Sweep]) -> str:
    missing = sum(step.problem is not None for each in found for step in each.steps)
    what = (
        "a force table under it reads the reverse" if not hold.freedoms else "the freedoms move as the last panels show"
    )
    words = (
        "Amplitudes, 0 to peak, by order of the wrench of the hold on the carrier about `O_1`, on the axes of `E_1`; "
        f"{what}. Exact for the full equations; all flywheels at one common speed, {STEPS} of them in each diagram, "
        "all phases 0 at t = 0. The mean, such as the weight, is left out. "
    )
    words += "The first diagram of each is of speeds about the natural frequencies. " if len(found) > 1 else ""
    words += named_freedoms(hold)
    words += f"At {missing} speeds no steady state was found. " if missing else ""
    return words + "``mahovik response --at hold.reaction`` has spectra and other ratios of speeds. "


def _common_speed(stand: Stand, limit: float) -> SpeedPlan:
    """All flywheels at one speed, from rest up to a limit, rad/s."""
    return read_speeds(stand, [f"{ALL}=0..{limit!r} rad/s"])


def _largest(found: Sweep) -> tuple[float, float]:
    """Largest RMS, and the speed where it is, rad/s."""
    sizes = np.linalg.norm(np.nan_to_num(found.rms()), axis=1)
    return float(sizes.max()), float(found.values[int(sizes.argmax())])


def _point(found: Sweep) -> str:
    return "O1 of the carrier" if found.point == "carrier" else found.point


def _words(found: Sequence[Sweep], points: str) -> str:
    missing = sum(step.problem is not None for each in found for step in each.steps)
    words = (
        f"Amplitudes, 0 to peak, of the acceleration of {points} by order, exact for the full equations; all "
        f"flywheels at one common speed, {STEPS} of them in each diagram, all phases 0 at t = 0. "
    )
    words += "The first diagram of each is of speeds about the natural frequencies. " if len(found) > 1 else ""
    words += f"At {missing} speeds no steady state was found. " if missing else ""
    return words + "``mahovik response`` has other points, quantities and ratios of speeds, and spectra."
