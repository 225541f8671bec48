"""Quantities of interest: a signal of the stand and what is kept of it, or a function of the user."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.fields import name_problem
from mahovik.core.stand.model import Stand
from mahovik.core.stand.units import QuantityError, number
from mahovik.errors import UsageError
from mahovik.out.campaign.over import Kind, OverTable
from mahovik.out.campaign.signals import AXES, HOLD, SIGNALS, find_part, ties
from mahovik.out.campaign.statistics import BandRms, End, Least, Mean, Peak, Rms, Settling, Statistic
from mahovik.out.campaign.user import UserFunction, find_function
from mahovik.out.campaign.values import Signal
from mahovik.out.campaign.wanted import STATISTICS, WantedTable

OF_POINTS = ("acceleration", "velocity", "displacement", "rotation", "rate")

ALLOWED: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "regime": (tuple(name for name in SIGNALS if name != "error"), STATISTICS),
    "speeds": ((*OF_POINTS, "force", "moment"), ("peak", "rms")),
    "programme": (tuple(SIGNALS), STATISTICS),
    "servo": (
        ("velocity", "displacement", "rotation", "rate", "torque", "power", "speed", "error"),
        STATISTICS,
    ),
    "states": (tuple(n for n in SIGNALS if n not in ("displacement", "rotation", "error")), STATISTICS[:-1]),
}
"""Signals and statistics over each kind of run; "servo": over a programme that servos follow."""


@dataclass(frozen=True)
class Quantity:
    """One column of the rows: its name and unit, and how it is computed.

    signal     what it is made of; None: by `function`
    statistic  a key of STATISTICS
    band       Hz; of `rms`
    after      s; earlier times do not count
    within     of `settling`, in the unit of the signal
    needs      results of the C that it is made of
    """

    name: str
    unit: str
    signal: Signal | None
    statistic: str
    band: tuple[float, float] | None = None
    after: float = 0.0
    within: float = 0.0
    function: UserFunction | None = None
    needs: frozenset[str] = frozenset(("V_dot", "phi_ddot", "speeds", "tau", "readings", "loads"))

    def new(self, n: int) -> Statistic:
        """What gathers it for n samples."""
        if self.statistic == "settling":
            return Settling(self.within)
        if self.band is not None:
            return BandRms(self.band)
        return SUMS[self.statistic](n)


SUMS: Mapping[str, Callable[[int], Statistic]] = {"peak": Peak, "rms": Rms, "mean": Mean, "least": Least, "end": End}
"""What gathers a statistic of n samples without further numbers."""


def quantities_of(
    stand: Stand,
    over: OverTable,
    wanted: Mapping[str, WantedTable],
    folder: Path,
    functions: Mapping[str, Callable[[Mapping[str, Any]], float]],
) -> list[Quantity]:
    """The quantities of a campaign file. Raises UsageError, which names the quantity and the key."""
    found = []
    for name, table in wanted.items():
        try:
            found.append(_quantity(stand, over, name, table, folder, functions))
        except (UsageError, QuantityError) as error:
            raise UsageError(f"quantity {name}: {error}") from None
    return found


def _quantity(
    stand: Stand, over: OverTable, name: str, table: WantedTable, folder: Path, functions: Mapping[str, Any]
) -> Quantity:
    if (problem := name_problem(name)) is not None:
        raise UsageError(problem)
    kind: Kind | str = "servo" if over.servo is not None else over.kind
    if table.statistic == "function":
        if kind not in ("regime", "programme"):
            raise UsageError(
                f"function: not over `{kind}`; expected a run over a regime, or over a programme open loop"
            )
        return Quantity(name, table.unit, None, "function", function=find_function(table.signal, folder, functions))
    signals, statistics = ALLOWED[kind]
    if kind == "speeds":
        signals = OF_POINTS if stand.hold is None else (*OF_POINTS, "force", "moment")
    for what, given, known in (("signal", table.signal, signals), ("statistic", table.statistic, statistics)):
        if given not in known:
            raise UsageError(f"{table.statistic}: no {what} `{given}` over {kind}; expected one of {', '.join(known)}")
    if kind == "servo" and table.signal == "error":
        _check_servo_error(stand, table)
    if kind == "states" and table.after:
        raise UsageError("after: not over states, which have no time")
    signal = SIGNALS[table.signal]
    part = find_part(stand, signal, table.at, table.of)
    coordinates = _units_of_coordinates(stand) if table.signal == "error" else {}
    axes = tuple(coordinates) if table.signal == "error" else AXES if signal.vector else ()
    if table.axis is not None and table.axis not in axes:
        raise UsageError(f"axis: {table.axis}: expected {'one of ' + ', '.join(axes) if axes else 'none'}")
    unit = signal.unit
    if table.signal == "error" and table.axis is not None:
        unit = coordinates[table.axis]
    within = 0.0
    if table.statistic == "settling":
        within, unit = number(table.within, signal.dimension), "s"
        if not within > 0.0:
            raise UsageError(f"within: {within:g}: expected above 0")
    if table.band is not None:
        _check_band(over, table.band, table.after)
    if table.after and over.until is not None and table.after >= over.until:
        raise UsageError(f"after: {table.after:g} s: expected less than `until`, {over.until:g} s")
    own = Signal(table.signal, part, table.axis or "")
    needs = signal.needs
    if part in ties(stand):
        needs = frozenset()
    elif signal.place == "part" and part == HOLD and stand.hold is not None:
        needs = frozenset(("V_dot", "phi_ddot", "reaction"))
    elif signal.place == "part" and kind == "speeds":
        raise UsageError(f"{table.signal}: over speeds only that of the hold is known, found {part}")
    return Quantity(name, unit, own, table.statistic, table.band, table.after, within, needs=needs)


def _units_of_coordinates(stand: Stand) -> dict[str, str]:
    """Names of the coordinates in which a programme has an error, with their units. Raises StandError: it has none."""
    own = coordinates_of(stand)
    return dict(zip(own.names, own.unit_names, strict=True))


def _check_servo_error(stand: Stand, table: WantedTable) -> None:
    """Raise UsageError for what `follow` does not say of an error."""
    known = ("peak", "rms", "mean", "end")
    if table.statistic not in known:
        raise UsageError(
            f"{table.statistic}: error: expected one of {', '.join(known)} with servos, as `follow` gives them"
        )
    if table.statistic == "mean" and table.axis is None:
        known_axes = ", ".join(_units_of_coordinates(stand))
        raise UsageError(f"axis: required with the mean of the error; expected one of {known_axes}")
    for key in ("after", "band"):
        if key in table.model_fields_set:
            raise UsageError(f"{key}: not allowed with `error` and servos: the last periods are measured")


def _check_band(over: OverTable, band: tuple[float, float], after: float) -> None:
    """Raise UsageError for a band that the times of output cannot show."""
    if over.kind == "speeds":
        return
    if over.kind == "states":
        raise UsageError("band: not over states, which have no time")
    every = over.every or 1e-3
    if band[1] > 0.5 / every * (1.0 + 1e-9):
        raise UsageError(f"band: {band[1]:g} Hz needs `every` of at most {0.5 / band[1]:g} s, found {every:g} s")
    if over.until is not None and (over.until - after) * (band[1] - band[0]) < 2.0:
        least = 2.0 / (band[1] - band[0]) + after
        raise UsageError(
            f"band: {band[0]:g} to {band[1]:g} Hz cannot be resolved in {over.until:g} s; needs {least:g} s"
        )
