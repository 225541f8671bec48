"""Quantities of many samples: what a campaign file wants, checked against the stand, and computed block by block."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.structure import structure
from mahovik.errors import UsageError
from mahovik.out.api.stands import Stand
from mahovik.out.api.tables import Tables
from mahovik.out.campaign.over import OverTable
from mahovik.out.campaign.pose import Array
from mahovik.out.campaign.quantities import Quantity, quantities_of
from mahovik.out.campaign.wanted import WantedTable

Values = tuple[dict[str, Array], list[str]]
"""Quantities by name, (n) each, and the reason of each sample that has none, or ""."""


class Runner(Protocol):
    """Computes quantities over one kind of run.

    stand  the stand of which tables are made: that of the file, with the run-time wrenches that a regime needs
    """

    stand: Stand

    def values(self, tables: Tables) -> Values:
        """Quantities of all samples of tables."""


class Computation:
    """Quantities of samples, ready to be computed.

    stand  of which tables are made
    units  of the quantities, by their names in the order of the file
    """

    def __init__(self, runner: Runner, quantities: Sequence[Quantity]) -> None:
        self._runner, self._quantities = runner, tuple(quantities)
        self.stand = runner.stand
        self.units: Mapping[str, str] = {each.name: each.unit for each in quantities}

    def values(self, tables: Tables) -> Values:
        """Quantities (n) by name, and for each sample a reason, "" where it has all quantities; else they are NaN.

        A sample that the C refuses, or whose numbers are not finite, never ends the others.
        """
        if structure(tables.made_of) != structure(self.stand):
            from mahovik.out.api.model import build

            tables = build(self.stand).tables(tables.samples.given, tables.samples.n)
        found, reasons = self._runner.values(tables)
        for name in self.units:
            for j in np.flatnonzero(~np.isfinite(found[name])):
                reasons[j] = reasons[j] or f"{name} is {found[name][j]}"
        bad = np.array([bool(reason) for reason in reasons], dtype=bool)
        return {name: np.where(bad, np.nan, found[name]) for name in self.units}, reasons


def prepare(
    stand: CoreStand,
    over: OverTable,
    wanted: Mapping[str, WantedTable],
    *,
    folder: Path = Path(),
    user_functions: Mapping[str, Callable[[Mapping[str, Any]], float]] | None = None,
) -> Computation:
    """Check what a campaign file wants of each sample, and make ready what computes it.

    over, wanted    `[over]` and `[[quantity]]` of a campaign file, whose files are in `folder`
    user_functions  by the text of `function` in the file; of those not given the function is imported

    Raises UsageError, which begins with the key, and what the files raise.
    """
    if not wanted:
        raise UsageError("quantity: none, expected at least one")
    own = Stand.of(stand)
    quantities = quantities_of(own, over, wanted, folder, user_functions or {})
    try:
        return Computation(_runner(own, over, quantities, folder), quantities)
    except UsageError as error:
        raise UsageError(f"over: {str(error).replace('--', '')}") from None  # keys of the file, not options


def _runner(stand: Stand, over: OverTable, quantities: Sequence[Quantity], folder: Path) -> Runner:
    if over.kind == "regime":
        from mahovik.out.campaign.in_time import regime_runner

        return regime_runner(stand, over, quantities, folder)
    if over.kind == "speeds":
        from mahovik.out.campaign.steady import SteadyRunner

        return SteadyRunner(stand, over, quantities)
    if over.kind == "states":
        from mahovik.out.campaign.at_states import states_runner

        return states_runner(stand, over, quantities, folder)
    if over.servo is not None:
        from mahovik.out.campaign.servo import ServoRunner

        return ServoRunner(stand, over, quantities, folder)
    from mahovik.out.campaign.open_loop import programme_runner

    return programme_runner(stand, over, quantities, folder)
