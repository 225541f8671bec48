"""The partition (-, +) of (13): six dependent flywheels, held one a freedom, and where det I+ != 0 holds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from itertools import combinations, islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.use.plan.array import Array
from mahovik.use.plan.certificate import scaled_columns
from mahovik.use.plan.outcome import PlanOptions
from mahovik.use.plan.residual import Mechanics
from mahovik.use.plan.residual.body_laws import twist_laws

NEARLY = 1e-3
"""Least singular value of K^-1/2 I+ Theta_ff^-1/2 below which a time is reported: (13) loses three digits there."""
_SCREENED, _KEPT, _AT_ONCE = 48, 12, 512
"""Times of the screening, partitions examined closely after it, partitions per batch."""
_ROWS = 32
"""Times of the table in the report."""

Plus = tuple[int, ...]


COUNTS = ("one", "two", "three", "four", "five", "six")


def dependent_count(stand: Stand) -> int:
    """Dependent flywheels of (13), as many as (12) has rows: six, of a held carrier one a freedom."""
    return 6 if stand.hold is None else len(stand.hold.freedoms)


def dependent_words(m: int) -> str:
    """That number in words."""
    return f"{COUNTS[m - 1]} dependent flywheel{'s' if m > 1 else ''}"


def partition_of(names: Sequence[str], stand: Stand) -> Plus:
    """Numbers of the dependent flywheels of --partition, in the stand's order.

    UsageError: not as many as (12) has rows, unknown, or twice.
    """
    given, known = [name.strip() for name in names], [s.name for s in stand.flywheels]
    shown = f"--partition {','.join(given)}"
    for name in given:
        if name not in known:
            raise UsageError(f"{shown}: the stand has no flywheel {name!r}{suggestion(name, known)}")
    m = dependent_count(stand)
    if len(given) != m:
        raise UsageError(f"{shown}: {len(given)} names; expected the {dependent_words(m)} of (13)")
    if len(set(given)) != m:
        raise UsageError(f"{shown}: a flywheel is named twice; expected {COUNTS[m - 1]} different ones")
    return tuple(k for k, name in enumerate(known) if name in given)


@dataclass(frozen=True, eq=False)
class PartitionCourse:
    """I+ along a motion: K^-1/2 I+ Theta_ff^-1/2, dimensionless, the same for any units, origin and axes.

    t            (M, s)
    determinant  (M,) with the sign of det I+
    values       (M, 6; held M, m) singular values, largest first
    """

    plus: Plus
    t: Array
    determinant: Array
    values: Array

    @staticmethod
    def of(own: Mechanics, t: Array, phi: Array, plus: Plus) -> PartitionCourse:
        """I+ at angles phi (M, N) at times t."""
        columns: Array = scaled_columns(own, phi)[:, :, list(plus)]
        return PartitionCourse(
            plus, t, np.asarray(np.linalg.det(columns)), np.asarray(np.linalg.svd(columns, compute_uv=False))
        )

    @property
    def least(self) -> float:
        """Least singular value along the motion; 0 if det I+ changes its sign."""
        return 0.0 if self.crossings.size else float(self.values[:, -1].min())

    @property
    def crossings(self) -> Array:
        """Times (s) at which det I+ passes through zero."""
        d = self.determinant
        k = np.flatnonzero(d[:-1] * d[1:] <= 0.0)
        share = d[k] / np.where(d[k] == d[k + 1], 1.0, d[k] - d[k + 1])
        return np.asarray(self.t[k] + share * (self.t[k + 1] - self.t[k]))

    @property
    def weak_intervals(self) -> list[list[float]]:
        """Intervals of time (s) where the least singular value is below NEARLY."""
        below = np.concatenate([[False], self.values[:, -1] < NEARLY, [False]])
        edges = np.flatnonzero(np.diff(below.astype(int)))
        return [[float(self.t[a]), float(self.t[b - 1])] for a, b in zip(edges[::2], edges[1::2], strict=True)]

    def report(self, names: Sequence[str]) -> dict[str, Any]:
        """Figures for the programme's report."""
        rows = np.unique(np.linspace(0, len(self.t) - 1, _ROWS).round().astype(int))
        worst = int(np.argmin(self.values[:, -1]))
        return {
            "plus": [names[k] for k in self.plus],
            "minus": [name for k, name in enumerate(names) if k not in self.plus],
            "regular": not self.crossings.size,
            "least_singular_value": float(self.values[worst, -1]),
            "least_at": float(self.t[worst]),
            "det_zero_at": self.crossings,
            "threshold": NEARLY,
            "below_threshold": self.weak_intervals,
            "along": {"t": self.t[rows], "det": self.determinant[rows], "singular_values": self.values[rows]},
        }

    def words(self, names: Sequence[str]) -> str:
        """Message: where the partition does not hold."""
        at = ", ".join(f"{t:.4g}" for t in islice(self.crossings, 8)) + (" ..." if len(self.crossings) > 8 else "")
        return f"partition {','.join(names[k] for k in self.plus)}: det I+ = 0 at t = {at} s"


def best_partition(own: Mechanics, t: Array, phi: Array) -> PartitionCourse:
    """Partition with the largest least singular value along phi (M, N); one without change of sign comes first.

    All are screened at a few times, and the most promising evaluated at all times.
    """
    rows = np.unique(np.linspace(0, len(t) - 1, _SCREENED).round().astype(int))
    columns = scaled_columns(own, phi[rows])
    scores: list[tuple[float, Plus]] = []
    every = combinations(range(own.N), own.freedoms.shape[1])
    while batch := list(islice(every, _AT_ONCE)):
        I = np.moveaxis(columns[:, :, np.array(batch)], 2, 0)  # (partitions, times, 6, 6), held m, m
        determinants, least = np.linalg.det(I), np.linalg.svd(I, compute_uv=False)[..., -1].min(axis=1)
        turned = np.any(determinants[:, 1:] * determinants[:, :-1] < 0.0, axis=1)
        scores = sorted([*scores, *zip((turned - least).tolist(), batch, strict=True)])[:_KEPT]
    close = [PartitionCourse.of(own, t, phi, plus) for _, plus in scores]
    return max(close, key=lambda each: (each.least, -len(each.crossings), float(each.values[:, -1].min())))


def order_of(plus: Plus, N: int) -> NDArray[np.intp]:
    """Numbers of all flywheels in the order (-, +) of (13)."""
    return np.array([k for k in range(N) if k not in plus] + list(plus), dtype=np.intp)


def requested_partition(stand: Stand, options: PlanOptions) -> Plus | None:
    """The dependent flywheels named by `--partition`; None: the best ones are chosen.

    Raises UsageError: the stand or the method has none such.
    """
    if options.method == "fourier":
        if options.partition is not None:
            raise UsageError("--partition needs --method ocp-partition or ocp; the method is fourier")
        return None
    N, shown = len(stand.flywheels), f"--method {options.method}"
    m = dependent_count(stand)
    if m > N:
        needs = f"(13) needs {COUNTS[m - 1]} dependent ones"
        raise UsageError(f"{shown}: the stand has {N} flywheels; {needs}; use --method fourier")
    for wheel in stand.flywheels:
        if twist_laws(wheel) is not None:
            raise UsageError(f'{shown}: flywheel "{wheel.name}" has damping; use --method fourier')
    plus = None if options.partition is None else partition_of(options.partition, stand)
    if find_spec("casadi") is None:
        raise UsageError(f"{shown}: CasADi is not installed: pip install casadi, or use --method fourier")
    return plus
