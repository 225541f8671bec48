"""Quantities over a programme that is run open loop: the flywheels turn as it says, whatever the carrier does."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.regime import programme_regime
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.state import State
from mahovik.errors import UsageError
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import motion_of, programme_of
from mahovik.out.campaign.in_time import TimeRunner, course_of
from mahovik.out.campaign.over import DT, EVERY, ORDER, OverTable
from mahovik.out.campaign.quantities import Quantity
from mahovik.out.campaign.required import Required
from mahovik.out.campaign.start import Start
from mahovik.proof.verify.programme.verification import motion_check, stand_check
from mahovik.use.control.plant import plant_state
from mahovik.use.numeric import Chart, Mechanics
from mahovik.use.plan.unbalance import twist_at_rest
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.held import allowed_start

PERIODS = 1
"""Periods of a periodic programme, where the file does not say."""


def programme_runner(stand: Stand, over: OverTable, quantities: Sequence[Quantity], folder: Path) -> TimeRunner:
    """Over a programme, from the required state at its t = 0. Raises UsageError and what the files raise."""
    for key, value in (("begin", over.begin), ("table", over.table)):
        if value not in (None, "programme"):
            raise UsageError(f"{key}: only allowed with `servo`; open loop begins in the required state")
    programme, motion = read_programme(stand, over, folder)
    if not programme.periodic and over.periods not in (None, 1):
        raise UsageError(f"periods: {over.periods}: the programme is finite and is run once")
    until = motion.span * (over.periods or PERIODS)
    start = required_state(stand, motion, programme)
    case = Case(
        stand, programme_regime(programme), start, until,
        over.every or EVERY, over.dt or DT, over.order or ORDER,
    )  # fmt: skip
    required = Required.of(stand, motion, programme)
    return TimeRunner(stand, len(case.times), quantities, Start(start), course_of(stand, case), required)


def read_programme(stand: Stand, over: OverTable, folder: Path) -> tuple[Programme, RequiredMotion]:
    """Programme and motion of a run, which belong to the stand. Raises UsageError and what the files raise."""
    assert over.programme is not None and over.motion is not None
    programme = programme_of(folder / over.programme)
    if (whose := stand_check(stand, programme)).failed:
        raise UsageError(f"programme: {over.programme}: {whose.words}")
    motion = motion_of(folder / over.motion, stand, programme)
    if (whose := motion_check(motion, programme)).failed:
        raise UsageError(f"programme: {over.programme}: {whose.words}")
    return programme, motion


def required_state(stand: Stand, motion: RequiredMotion, programme: Programme) -> State:
    """The state that the programme requires at t = 0."""
    course, angles = motion.at(np.zeros(1), programme.bias), programme.at(np.zeros(1))
    chart = Chart.at(Mechanics.of(stand), course.q[0])
    y = chart.of(course)[0]
    if programme.unbalance == "averaged":
        y[6:] = twist_at_rest(stand, y[6:], angles.phi[0], angles.phi_dot[0])
    found = plant_state(stand, chart, y, angles.phi[0], angles.phi_dot[0])
    found = replace(found, phi=tuple(angles.phi[0].tolist()), phi_dot=tuple(angles.phi_dot[0].tolist()))
    return allowed_start(stand, found)
