"""Rows of a campaign: what was drawn for each sample and what was found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from mahovik.out.api.stands import Stand
    from mahovik.out.campaign.convergence import Goal
    from mahovik.out.campaign.sensitivity import Sensitivity

MOST_SAMPLES = 10**10
"""Most samples of a campaign."""


@dataclass(frozen=True)
class Rows:
    """Samples that follow each other, one row each.

    `reason` is empty for a sample that has all its quantities. Otherwise it says in one line why it has none, and its
    quantities are NaN.
    """

    sample: NDArray[np.int64]  # (n,), numbers of the samples
    parameters: Mapping[str, NDArray[np.float64]]  # (n,) each, what was drawn, SI
    quantities: Mapping[str, NDArray[np.float64]]  # (n,) each, what was found, SI
    reason: Sequence[str]  # (n,)


class Work(Protocol):
    """Samples that can be computed in any order and any number of times, always with the same bits."""

    @property
    def name(self) -> str:
        """Name of the campaign."""

    @property
    def identity(self) -> Mapping[str, str]:
        """Hashes and numbers that fix the rows: SHA-256 of `stand` and `campaign`, `version` of mahovik, `seed`."""

    @property
    def samples(self) -> int:
        """Number of samples."""

    @property
    def shard_size(self) -> int:
        """Samples a shard: shard k has the samples from `k * shard_size`."""

    @property
    def parameters(self) -> Mapping[str, str]:
        """Units of the parameters by their names, in the order of the columns."""

    @property
    def quantities(self) -> Mapping[str, str]:
        """Units of the quantities by their names, in the order of the columns."""

    def rows(self, first: int, count: int) -> Rows:
        """Rows of the samples from `first` on."""

    @property
    def stand(self) -> Stand:
        """Stand that all samples differ from."""

    @property
    def goal(self) -> Goal | None:
        """Quantile that is to be known well; None: there is none."""

    @property
    def has_quantiles(self) -> bool:
        """Whether the samples are drawn from the distributions, and not placed in blocks that have none."""

    def stand_of(self, number: int) -> Stand:
        """Stand of one sample. Raises StandError: it cannot be."""

    def sensitivity(self, values: NDArray[np.float64]) -> Sensitivity:
        """Figures that say on which factors a quantity depends. Raises UsageError: the design has none."""
