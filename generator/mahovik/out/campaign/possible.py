"""Tables of samples drawn at random, of which some may be no stand: tables of the others, and reasons."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.errors import StandError, UsageError
from mahovik.out.api.model import Model
from mahovik.out.api.stands import Stand
from mahovik.out.api.tables import Samples, Tables, change_values, check_sample, first_reason, variants


@dataclass(frozen=True)
class PossibleTables:
    """Tables of the samples that can be. `numbers`: which these are; `reasons`: by number, why another cannot."""

    tables: Tables
    numbers: NDArray[np.int64]
    reasons: Mapping[int, str]


def possible_tables(model: Model, changes: Mapping[str, Any], n: int | None = None) -> PossibleTables:
    """Tables as of `Model.tables`, without the samples that no stand file may have; each of these with its reason.

    Raises InputError for arrays that do not fit, UsageError for a path that leads nowhere.
    """
    samples = Samples.of(changes, n)
    try:
        return PossibleTables(model.tables(samples.changes, samples.n), np.arange(samples.n), {})
    except (StandError, UsageError):
        reasons = _reasons(model, samples)
    while True:
        kept = np.array([i for i in range(samples.n) if i not in reasons], dtype=np.int64)
        part = samples.part(kept)
        try:
            return PossibleTables(model.tables(part.changes, part.n), kept, dict(sorted(reasons.items())))
        except StandError as error:  # what only the C refuses
            refusals = {int(i): _refusal(model, samples.part(kept[k : k + 1])) for k, i in enumerate(kept)}
            refusals = {number: reason for number, reason in refusals.items() if reason}
            if not refusals:
                raise error from None
            reasons |= refusals


def _reasons(model: Model, samples: Samples) -> dict[int, str]:
    """Reasons of the samples that cannot be, by number. Raises UsageError."""
    stand, reasons = Stand.of(model.stand), dict[int, str]()
    with suppress(StandError):  # a path that leads nowhere is no matter of one sample
        change_values(stand, samples.values(0) if samples.n else {})
    tables_of = variants(stand, model.tables({}, 0).real, samples, reasons)
    for number in np.flatnonzero(tables_of.doubtful).tolist():
        try:
            check_sample(stand, samples, number)
        except (StandError, UsageError) as error:
            reasons[number] = first_reason(error, f"{stand.name}, sample {number}")
    return reasons


def _refusal(model: Model, samples: Samples) -> str:
    """Why one sample cannot be; "" if it can."""
    try:
        model.tables(samples.changes, samples.n)
    except StandError as error:
        return first_reason(error, f"{model.stand.name}, sample 0")
    return ""
