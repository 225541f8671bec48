"""Ends of the distributions, tried before a campaign begins: a tolerance that makes a body impossible is named."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.units import show
from mahovik.errors import CampaignError
from mahovik.out.api.possible import PossibleTables
from mahovik.out.campaign.designs import Design
from mahovik.out.campaign.distributions import Discrete, Truncated
from mahovik.out.campaign.draw import Parameter
from mahovik.out.campaign.file import CampaignFile

Array = NDArray[np.float64]
Possible = Callable[[Mapping[str, Array], int], PossibleTables]

_RARE = 0.01
"""Expected number of samples beyond the tried ends of a truncated distribution."""

_MOST_ROWS = 1000
_SEARCHED = (64, 1024, 4096)
"""Samples among which the first impossible one is sought, block by block."""


@dataclass(frozen=True)
class _Trial:
    """One factor at some quantile, the others at their medians."""

    factor: int
    quantile: float
    words: str


def check_bounds(file: CampaignFile, design: Design, possible: Possible) -> None:
    """Try the medians, and both ends of every factor whose distributions have ends.

    Raises CampaignError: which number, at which value, why there is no such stand, and the first sample that is none.
    """
    trials = [_Trial(0, 0.5, ""), *(trial for k in range(len(file.draw.factors)) for trial in _trials(file, k))]
    unit = np.full((len(trials), len(file.draw.factors)), 0.5)
    for row, trial in zip(unit, trials, strict=True):
        if trial.words:
            row[trial.factor] = trial.quantile
    values = file.draw.at(unit)
    reasons = possible(values, len(trials)).reasons
    if not reasons:
        return
    first = _first_impossible(file, design, possible)
    lines = []
    for number, reason in reasons.items():
        trial = trials[number]
        if not trial.words:
            lines = [f"{file.source}: vary: with all numbers at their medians: {reason}{first}"]
            break
        own = _of_factor(file, trial.factor)
        shown = ", ".join(
            f"{each.place.path} = {values[each.place.path][number]:g} {each.place.dimension.si}".rstrip()
            for each in own
        )
        lines.append(f"{file.source}: vary {show(own[0].place.path)}: {trial.words}, {shown}: {reason}{first}")
    raise CampaignError(lines)


def _of_factor(file: CampaignFile, number: int) -> list[Parameter]:
    return [each for each in file.draw.parameters if each.factor == file.draw.factors[number]]


def _trials(file: CampaignFile, number: int) -> list[_Trial]:
    own = [each.distribution for each in _of_factor(file, number)]
    if any(isinstance(each, Discrete) for each in own):
        count = min(_MOST_ROWS, max(len(each.values) for each in own if isinstance(each, Discrete)))
        return [_Trial(number, (k + 0.5) / count, "at one of its values") for k in range(count)]
    if not np.isfinite([each.support for each in own]).all():
        return []
    rare = _RARE / file.table.samples if any(isinstance(each, Truncated) for each in own) else 0.0
    return [_Trial(number, rare, "at its lower end"), _Trial(number, 1.0 - rare, "at its upper end")]


def _first_impossible(file: CampaignFile, design: Design, possible: Possible) -> str:
    """End of a message: the first sample of the campaign that no stand file may have, if it is among the first."""
    start = 0
    for block in _SEARCHED:
        count = min(block, design.samples - start)
        if count <= 0:
            break
        reasons = possible(file.draw.values(design.unit(start, count)), count).reasons
        if reasons:
            return f"; sample {start + min(reasons)} is the first that cannot be"
        start += count
    return ""
