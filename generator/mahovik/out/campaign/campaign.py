"""A campaign: samples of a stand, drawn by the design of its file, and what is computed of each."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import mahovik
from mahovik.core.stand.units import show
from mahovik.core.stand.write import dumps
from mahovik.errors import CampaignError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.model import Model, build
from mahovik.out.api.possible import PossibleTables, possible_tables
from mahovik.out.api.stands import Stand
from mahovik.out.campaign.bounds import check_bounds
from mahovik.out.campaign.compute import Computation, prepare
from mahovik.out.campaign.designs import DESIGNS, Design, InBlocks
from mahovik.out.campaign.file import CampaignFile, files_in, load_campaign
from mahovik.out.campaign.holds import is_place_of_hold
from mahovik.out.campaign.rows import Rows
from mahovik.out.campaign.sensitivity import Sensitivity, sensitivity

Array = NDArray[np.float64]

SHARD_TIME = 12.0
"""Time for a shard, s, where the file does not say how many samples it has."""

_DECIDES_NO_ROW = ("name", "stand", "shard", "until", "quantile")
"""Keys of a file that are no part of the identity of its campaign; the stand has one of its own."""

_LONGEST_SHARD = 50_000
_FEWEST_SHARDS = 32  # of many samples, so that all workers have some
_MEASURED = 0.5  # s


class Campaign:
    """Samples of a campaign file; implements `rows.Work`.

    Attributes: `file`, what the file says; `stand`, that all samples differ from; `model`, its compiled C; `design`;
    `goal`, the quantile that is to be known well, or None.
    """

    def __init__(self, file: CampaignFile, computation: Computation, shard: int | None = None) -> None:
        """`shard`: samples of a shard; else as the file says, or as many as take some seconds. Raises CampaignError."""
        table = file.table
        self.file, self.stand, self.goal = file, file.stand, file.goal
        self.model: Model = build(computation.stand)
        self.design: Design = DESIGNS[table.design](file.draw.factors, table.samples, table.seed)
        self._computation, self._shard = computation, shard or table.shard
        if self.goal is not None and self.goal.of not in computation.units:
            known = suggestion(self.goal.of, computation.units)
            raise CampaignError([f"{file.source}: quantile, of: unknown quantity {show(self.goal.of)}{known}"])
        try:
            check_bounds(file, self.design, self.possible)
        except UsageError as error:
            raise CampaignError([f"{file.source}: vary: {error}"]) from None

    @staticmethod
    def load(
        path: str | Path,
        *,
        shard: int | None = None,
        user_functions: Mapping[str, Callable[[Mapping[str, Any]], float]] | None = None,
        computing: bool = True,
    ) -> Campaign:
        """The campaign of a file, compiled.

        shard           samples of a shard, whatever the file says
        user_functions  functions of quantities by the text of `function` in the file; else they are imported
        computing       whether its quantities shall be computed: else no function is imported

        Raises CampaignError with every problem of the file, and what the files raise that it names.
        """
        file = load_campaign(path)
        if file.table.over is None:
            raise CampaignError(
                [f"{file.source}: over: required, but missing; expected over what samples are computed"]
            )
        if not computing:
            wanted = (each for each in file.table.quantity.values() if each.statistic == "function")
            user_functions = {each.signal: _not_computed for each in wanted}
        moved = [each.place.path for each in file.draw.parameters if is_place_of_hold(each.place.path)]
        if moved and file.table.over.kind == "states":
            held = "says where the carrier is held, and the states of a file are of one place"
            raise CampaignError(
                [f"{file.source}: vary: {moved[0]}: {held}; expected another `over`, or not to vary it"]
            )
        try:
            computation = prepare(
                file.stand, file.table.over, file.table.quantity, folder=file.folder, user_functions=user_functions
            )
        except UsageError as error:
            raise CampaignError([f"{file.source}: {error}"]) from None
        return Campaign(file, computation, shard)

    @property
    def name(self) -> str:
        """Name of the campaign."""
        return self.file.name

    @cached_property
    def identity(self) -> Mapping[str, str]:
        """SHA-256 of `stand` and `campaign`, `version` of mahovik, `seed`.

        Names, and when the campaign stops, decide no row, so they are no part of it. Files that the campaign names are.
        """
        deciding = {key: value for key, value in self.file.document.items() if key not in _DECIDES_NO_ROW}
        named = dict.fromkeys((*self.file.files, *files_in(deciding, self.file.folder)))
        content = [hashlib.sha256(path.read_bytes()).hexdigest() for path in named]
        canonical = json.dumps([deciding, content], sort_keys=True, default=str)
        return {
            "stand": hashlib.sha256(dumps(self.stand).encode()).hexdigest(),
            "campaign": hashlib.sha256(canonical.encode()).hexdigest(),
            "version": mahovik.__version__,
            "seed": str(self.file.table.seed),
        }

    @property
    def samples(self) -> int:
        """Number of samples: that of the file, or for `morris` and `saltelli` the next that has no block in part."""
        return self.design.samples

    @cached_property
    def shard_size(self) -> int:
        """Samples a shard."""
        return self._shard or self._measured_shard()

    @cached_property
    def parameters(self) -> Mapping[str, str]:
        """SI units of the numbers that vary, by path."""
        return {each.place.path: each.place.dimension.si for each in self.file.draw.parameters}

    @property
    def quantities(self) -> Mapping[str, str]:
        """Units of the quantities by name."""
        return self._computation.units

    def parameter_values(self, first: int, count: int) -> dict[str, Array]:
        """The numbers that vary, by path, SI, of the samples from `first` on."""
        return self.file.draw.values(self.design.unit(first, count))

    def possible(self, values: Mapping[str, Array], count: int) -> PossibleTables:
        """Tables of those of `count` samples with these values that can be, and reasons for the others."""
        return possible_tables(self.model, values, count)

    def rows(self, first: int, count: int) -> Rows:
        """Rows of the samples from `first` on: the same bits however the samples are parted."""
        if first < 0 or count < 0 or first + count > self.samples:
            raise UsageError(f"rows: samples {first} to {first + count - 1}, but the campaign has {self.samples}")
        values = self.parameter_values(first, count)
        possible = self.possible(values, count)
        quantities = {name: np.full(count, np.nan) for name in self.quantities}
        reasons = [possible.reasons.get(i, "") for i in range(count)]
        if len(possible.numbers):
            found, why = self._computation.values(possible.tables)
            for name, column in quantities.items():
                column[possible.numbers] = found[name]
            for number, reason in zip(possible.numbers.tolist(), why, strict=True):
                reasons[number] = reason
        return Rows(np.arange(first, first + count, dtype=np.int64), values, quantities, reasons)

    def stand_of(self, number: int) -> Stand:
        """The stand of one sample, to look at or to save. Raises StandError if it cannot be."""
        values = self.parameter_values(number, 1)
        return self.stand.replace({path: column[0].tolist() for path, column in values.items()})

    @property
    def has_quantiles(self) -> bool:
        """See Work."""
        return not isinstance(self.design, InBlocks)

    def sensitivity(self, values: Array) -> Sensitivity:
        """Factors that a quantity depends on; `values` of the first samples in order. Raises UsageError."""
        return sensitivity(self.design, values)

    def _measured_shard(self) -> int:
        count, taken = min(4, self.samples), 0.0
        self.rows(0, count)  # what is made once is not to count
        while True:
            start = time.perf_counter()
            self.rows(0, count)
            taken = time.perf_counter() - start
            if taken > _MEASURED or count == min(self.samples, _LONGEST_SHARD):
                break
            count = min(4 * count, self.samples, _LONGEST_SHARD)
        most = min(_LONGEST_SHARD, -(-self.samples // _FEWEST_SHARDS))
        return max(1, min(most, round(float(f"{count * SHARD_TIME / taken:.1g}"))))


def _not_computed(_: Mapping[str, Any]) -> float:
    raise RuntimeError("a campaign that is read has no functions")
