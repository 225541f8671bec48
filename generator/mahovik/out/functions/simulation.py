"""`simulate`: a stand under a regime, in time."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mahovik.contract.quantities import BOUNDS
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.state import State
from mahovik.errors import CheckError, UsageError
from mahovik.out.api.fields import Array
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import Keys, Number, StandGiven, regime_of, state_of, time
from mahovik.out.functions.table import Column, Table, split_unit
from mahovik.out.notices import OnProgress, Progress, tell, warn
from mahovik.use.simulate.case import HINT, START_KEYS, Case
from mahovik.use.simulate.friction_steps import long_steps
from mahovik.use.simulate.held import allowed_start
from mahovik.use.simulate.run import Run
from mahovik.use.simulate.run import simulate as run_case
from mahovik.use.study.increments import lost_increments, lost_increments_line

if TYPE_CHECKING:
    from mahovik.core.motion.regime import Regime


class Simulation(Table):
    """A motion in time: columns of carrier, flywheels and points, a row per time of output.

    `stopped` says why it ended early, or is None; `interrupted`: whether that was Ctrl-C.
    """

    index = "t"

    def __init__(self, stand: CoreStand, run: Run) -> None:
        self.stand, self.run = stand, run

    @property
    def columns(self) -> tuple[Column, ...]:
        return tuple(Column(*split_unit(name), self.run.data[:, i]) for i, name in enumerate(self.run.names))

    @property
    def t(self) -> Array:
        """Times of the rows, s."""
        return np.asarray(self.run.data[:, 0])

    @property
    def stopped(self) -> str | None:
        """Why it ended early, or None."""
        return self.run.stopped

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended it."""
        return self.run.interrupted

    @property
    def weak_motors(self) -> dict[str, tuple[float, float]]:
        """Flywheels with too weak a motor: time of the worst moment (s), missing torque (N m)."""
        return self.run.weak_motors

    def save(self, path: str | Path) -> None:
        """Write the columns to a file .csv or .parquet, or a picture of them, .svg or .png. Raises UsageError."""
        from mahovik.out.report.plots import SUFFIXES, draw
        from mahovik.use.simulate.run import check_output, save_run
        from mahovik.writing import write

        suffix = check_output(Path(path))
        if suffix in SUFFIXES:
            write(Path(path), draw(f"{self.stand.name}: motion", self._panels(), suffix))
        else:
            save_run(self.run, Path(path))

    def __repr__(self) -> str:
        end = self.t[-1] if len(self.run.data) else 0.0
        return f"<Simulation of {self.stand.name}: {len(self.run.data)} rows to {end:g} s, {len(self.names)} columns>"


def simulate(
    stand: StandGiven,
    until: Number,
    *,
    regime: Regime | Keys | str | Path | None = None,
    start: State | Keys | str | Path | None = None,
    dt: Number = 1e-4,
    every: Number = 1e-3,
    order: int = 4,
    backend: str = "c",
    mounts: bool = False,
    real: str = "double",
    carried: bool = False,
    progress: OnProgress | None = None,
) -> Simulation:
    """Simulate a stand until a time. Times are numbers in s, or texts with a unit, "500 ms".

    regime   speeds or torques of the flywheels and wrenches; None: the flywheels keep the speeds of `start`
    start    the state at t = 0; None: the static equilibrium
    dt       the longest step; every: time between rows; order of the step: 4 or 2
    backend  "c", the generated C, or "scipy", the literal reference
    mounts   also the wrench of the mount on each flywheel
    real     element type of the C: "double", or "float" to see what a board's `step` makes of the motion
    carried  whether steps keep what rounding takes, in a carry

    Ctrl-C keeps the rows so far. Raises StandError, RegimeError, UsageError, StateError, ToolchainError, CheckError
    where there is no equilibrium to begin from.
    """
    own, end = Stand.of(stand), time("--until", until)
    chosen, state = _beginning(own, regime, start, end)
    case = Case(own, chosen, state, end, time("--every", every), time("--dt", dt), order, real, carried)
    warn_of_steps(case)
    if backend == "c":
        for each in long_steps(own, case.dt, chosen.has_speed_law):
            warn(str(each))
    words = f"simulate {own.name}"
    return Simulation(own, run_case(case, backend, mounts, lambda t: tell(progress, Progress(words, t, end))))


def _beginning(stand: Stand, regime: Any, start: Any, until: float) -> tuple[Regime, State]:
    """The regime, and the initial state. Raises RegimeError, UsageError, CheckError."""
    from mahovik.core.motion.regime import steady_regime
    from mahovik.out.notices import rest_to_start

    if not (math.isfinite(until) and until > 0.0):
        raise UsageError(f"--until {until:g}: expected a time above 0, in s")
    first = None if start is None else state_of(start, stand, START_KEYS, HINT)
    chosen = None if regime is None else regime_of(regime, stand, until)
    if first is not None:
        return chosen or steady_regime(stand, first.phi_dot), allowed_start(stand, first)
    chosen = chosen or steady_regime(stand, [0.0] * len(stand.flywheels))
    try:
        return chosen, rest_to_start(stand, [each.phase or 0.0 for each in chosen.flywheels])
    except CheckError as error:
        raise CheckError(f"{error}; give an initial state by --start") from None


def warn_of_steps(case: Case) -> None:
    """Warn of steps in which a flywheel turns far, and of steps in float that lose increments without a carry."""
    _, speeds, _ = case.motion(np.linspace(0.0, case.until, 200))
    largest = np.abs(np.vstack([speeds, case.phi_dot0])).max(axis=0)
    fastest = float(largest.max(initial=0.0))
    if fastest * case.dt > min(0.3, BOUNDS[f"MAX_TURN_{case.order}"].value):
        warn(f"a flywheel turns {fastest * case.dt:.2g} rad per step: --dt {case.dt:g} is long")
    if case.real == "float" and not case.carried:
        free = [0.0 if given else float(speed) for given, speed in zip(case.regime.has_speed_law, largest, strict=True)]
        line = lost_increments_line(lost_increments(case.stand, free, case.dt))
        if line:
            warn(f"{line.partition(': use')[0]}: use --carried, or --real double")
