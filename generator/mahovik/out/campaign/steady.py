"""Quantities over constant speeds: the periodic steady state of each sample, as `vibration` finds it."""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Decimal

import numpy as np

from mahovik.core.stand.units import show
from mahovik.errors import MahovikError, UsageError
from mahovik.out.api.stands import Stand
from mahovik.out.api.tables import Tables
from mahovik.out.arguments import by_flywheel
from mahovik.out.campaign.over import OverTable
from mahovik.out.campaign.pose import Array
from mahovik.out.campaign.quantities import OF_POINTS, Quantity
from mahovik.out.campaign.signals import AXES
from mahovik.out.campaign.values import Signal
from mahovik.use.vibration.band import rms
from mahovik.use.vibration.periodic import Periodic, periodic_response
from mahovik.use.vibration.speeds import common_period, read_speeds
from mahovik.use.vibration.view import REACTION, Observable, find_view


class SteadyRunner:
    """Computes quantities at constant speeds, sample by sample; see `compute.Runner`."""

    def __init__(self, stand: Stand, over: OverTable, quantities: Sequence[Quantity]) -> None:
        """Raises UsageError: speeds without a common period, or a sweep."""
        self.stand, self._quantities = stand, quantities
        given = over.speeds or {}
        asked = read_speeds(
            stand, {name: each if isinstance(each, str) else _number(name, each) for name, each in given.items()}
        )
        if asked.sweep is not None:
            raise UsageError("speeds: a range of speeds, expected one speed of each flywheel")
        self._speeds = asked.speeds(0.0)
        common_period(self._speeds)
        self._phases = by_flywheel("phases", over.phases, stand)

    def values(self, tables: Tables) -> tuple[dict[str, Array], list[str]]:
        """See `compute.Runner`."""
        n = len(tables)
        found, reasons = {q.name: np.full(n, np.nan) for q in self._quantities}, [""] * n
        for j in range(n):
            stand = tables.stand(j)
            try:
                motion = periodic_response(stand, self._speeds, self._phases)
            except MahovikError as error:
                reasons[j] = str(error)
                continue
            for q in self._quantities:
                assert q.signal is not None
                found[q.name][j] = _statistic(q, motion.values(_view(stand, q.signal)), motion)
        return found, reasons


def _number(name: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float | Decimal):
        raise UsageError(f"speeds: {name}: expected a speed, found {show(value)}")
    return float(value)


def _view(stand: Stand, signal: Signal) -> Observable:
    """What a signal sees: of a point, or of the reaction."""
    if signal.name in OF_POINTS:
        return find_view(stand, signal.part, "angle" if signal.name == "rotation" else signal.name)
    return find_view(stand, REACTION, signal.name)


def _statistic(q: Quantity, values: Array, motion: Periodic) -> float:
    """The peak over the nodes; or the RMS above 0 Hz, or within a band."""
    assert q.signal is not None
    chosen = [AXES.index(q.signal.axis)] if q.signal.axis else [0, 1, 2]
    values = values[:, chosen]
    if q.statistic == "peak":
        return float(np.linalg.norm(values, axis=1).max())
    amplitudes = np.fft.rfft(values, axis=0) * (2.0 / len(values))
    amplitudes[0] /= 2.0
    return float(np.linalg.norm(rms(amplitudes, motion.frequencies, q.band)))
