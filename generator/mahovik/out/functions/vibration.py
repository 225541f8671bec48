"""`response`: the steady vibration at constant speeds. `quiet`: speeds and phases that make a point quiet."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mahovik.core.stand.units import SPEED
from mahovik.errors import CheckError, UsageError
from mahovik.out.api.fields import Array
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import Number, StandGiven, by_flywheel, quantity, time_limit
from mahovik.out.functions.table import Column, Table
from mahovik.out.notices import OnProgress, Progress, tell, warn_of_speeds, warn_of_turn
from mahovik.use.vibration.speeds import ALL, SpeedPlan, read_speeds
from mahovik.use.vibration.sweep import Sweep
from mahovik.use.vibration.sweep import sweep as sweep_speeds
from mahovik.use.vibration.view import REACTION, find_view

if TYPE_CHECKING:
    from mahovik.out.report.plot.panel import Panel
    from mahovik.use.vibration.quiet import QuietResult


class Response(Table):
    """Steady vibration of a point: a row per speed, columns of RMS and of the amplitudes of orders.

    `sweep` holds all spectra; `interrupted`: some speeds are missing.
    """

    def __init__(self, sweep: Sweep) -> None:
        self.sweep, self.stand = sweep, sweep.stand
        asked = sweep.plan
        self.index = "" if asked.swept is None else f"speed {asked.names[asked.swept]}"

    @property
    def columns(self) -> tuple[Column, ...]:
        sweep, unit = self.sweep, self.sweep.unit
        speeds = np.array([step.turning.speeds for step in sweep.steps]).reshape(len(sweep.steps), -1)
        found = [Column(f"speed {name}", "rad/s", speeds[:, s]) for s, name in enumerate(sweep.plan.names)]
        found += [Column(name, unit, values) for name, values in sweep.rms_columns()]
        return (*found, *(Column(line.name, unit, line.size) for line in sweep.lines()))

    @property
    def interrupted(self) -> bool:
        """Whether speeds are missing, by Ctrl-C or `go_on`."""
        return self.sweep.interrupted

    @property
    def problems(self) -> tuple[str, ...]:
        """Why speeds have no steady state, one reason per such speed."""
        return tuple(step.problem for step in self.sweep.steps if step.problem is not None)

    def _panels(self) -> Sequence[Panel]:
        from mahovik.out.report.plot.response import panels

        return panels(self.sweep)

    def __repr__(self) -> str:
        sweep, many = self.sweep, len(self.sweep.steps)
        speeds = "one speed" if many == 1 else f"{many} speeds"
        return f"<Response of {sweep.stand.name}: {sweep.quantity} of {sweep.point} at {speeds}>"


def response(
    stand: StandGiven,
    speeds: Mapping[str, Number] | Sequence[str],
    at: str,
    *,
    steps: int = 61,
    quantity: str | None = None,
    band: tuple[float, float] | None = None,
    phases: Mapping[str, Number] | Sequence[Number] | None = None,
    go_on: Callable[[int], bool] | None = None,
    progress: OnProgress | None = None,
) -> Response:
    """Find the steady vibration at constant speeds, exact for the full equations.

    speeds   by flywheel: `{"w1": "0..6000rpm", "w2": "-0.5*w1", "w3": 100.0}`; rad/s, or a text as of `--speed`; one
             may be swept; those not named stand still; "all" is every flywheel
    at       a point or instrument, "carrier" for O1; of a held carrier also a freedom, "hold.pitch", or the wrench of
             the hold on the carrier about O1 in E1, "hold.reaction"
    steps    of a sweep, evenly; more are added at resonances, so that its largest amplitude is the true one
    quantity "acceleration" (default), "velocity", "displacement"; of a freedom that turns "acceleration" (default),
             "rate", "angle"; of the reaction "force" (default), "moment"
    band     Hz, of a second RMS
    phases   at t = 0, rad or a text, by flywheel
    go_on    gets the number of speeds done, and ends the sweep with False

    Ctrl-C keeps the speeds that are done. Raises StandError, UsageError, CheckError.
    """
    own = Stand.of(stand)
    find_view(own, at, quantity)
    asked = planned_speeds(own, speeds)

    def shall_go_on(done: int, planned: int) -> bool:
        tell(progress, Progress(f"response of {own.name}, speeds", done, planned))
        return go_on is None or go_on(done)

    phi = by_flywheel("phases", phases, own)
    found = sweep_speeds(own, asked, steps, at, quantity=quantity, band=band, phases=phi, go_on=shall_go_on)
    if not found.steps:
        raise CheckError(f"response of {own.name}: go_on ended it before the first speed")
    warn_of_turn(own)
    return Response(found)


def speed_text(name: str, speed: Number) -> str:
    """A speed (rad/s, or a text) as of `--speed`."""
    return f"{name}={speed}" if isinstance(speed, str) else f"{name}={float(speed)!r} rad/s"


def planned_speeds(stand: Stand, speeds: Mapping[str, Number] | Sequence[str]) -> SpeedPlan:
    """Speeds by flywheel, or texts as of `--speed`, one text or several; warns of those beyond the motors' speeds.

    Raises UsageError.
    """
    given = [speeds] if isinstance(speeds, str) else list(speeds)
    if isinstance(speeds, Mapping):
        given = [speed_text(*each) for each in speeds.items()]
    if wrong := [each for each in given if not isinstance(each, str)]:
        raise UsageError(f'speeds: {wrong[0]!r} in a list, expected texts, as "w1=300rpm", or speeds by flywheel')
    asked = read_speeds(stand, given)
    _warn_of_planned_speeds(stand, asked, given)
    return asked


def _warn_of_planned_speeds(stand: Stand, asked: SpeedPlan, given: Sequence[str]) -> None:
    """Warn of speeds beyond those of the motors, and of fast ones without a unit."""
    fastest = [max(map(abs, each)) for each in zip(*(asked.speeds(x) for x in asked.sweep or (0.0,)), strict=True)]
    texts = dict.fromkeys(asked.names, "")
    for each in given:
        name, _, text = each.partition("=")
        texts |= dict.fromkeys(asked.names if name == ALL else [name], text)
    warn_of_speeds(stand, fastest, list(texts.values()))


class Quiet(Table):
    """Speeds and phases that make a point quiet: a row per flywheel. `result` holds the lines."""

    index = "flywheel"

    def __init__(self, result: QuietResult) -> None:
        self.result, self.stand = result, result.stand

    @property
    def columns(self) -> tuple[Column, ...]:
        before, after = self.result.before, self.result.after
        return (
            Column("flywheel", "", np.array(self.result.wheels.names, dtype=object)),
            Column("before", "rad/s", before.speeds),
            Column("after", "rad/s", after.speeds),
            Column("phase", "rad", after.phases),
        )

    @property
    def speeds(self) -> Array:
        """The quiet speeds (N), rad/s."""
        return self.result.after.speeds

    @property
    def phases(self) -> Array:
        """The phases (N) at t = 0, rad."""
        return self.result.after.phases

    @property
    def reduction(self) -> float:
        """How many times lower the RMS in the band is."""
        return self.result.reduction

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended the search."""
        return self.result.interrupted

    @property
    def regime(self) -> str:
        """The speeds as the text of a regime file."""
        from mahovik.use.vibration.quiet.result import regime_text

        return regime_text(self.result)

    @property
    def start(self) -> str:
        """The state at t = 0 as JSON, for `simulate`."""
        return json.dumps(self.to_dict()["after"]["start"], indent=1, allow_nan=False)

    def to_dict(self) -> dict[str, Any]:
        """All figures, as `mahovik quiet --json` prints them."""
        from mahovik.use.vibration.quiet.result import as_object

        return as_object(self.result)

    def save(self, path: str | Path) -> None:
        """Write the speeds as a regime file, for `simulate`. Raises UsageError."""
        from mahovik.writing import write

        write(Path(path), self.regime)

    def _panels(self) -> Sequence[Panel]:
        from mahovik.out.report.plot.panel import Panel, stems

        found = []
        for when, jitter in (("before", self.result.before), ("after", self.result.after)):
            places = np.array([line.frequency for line in jitter.lines])
            sizes = np.array([(2.0 * line.mean_square) ** 0.5 for line in jitter.lines])
            low, high = self.result.options.band
            found.append(
                Panel(
                    f"{self.result.options.measure}, {self.result.unit}, {when}", (stems("lines", places, sizes),),
                    abscissa="frequency, Hz", shaded=((low, high),),
                )
            )  # fmt: skip
        return found

    def __repr__(self) -> str:
        of = f"{self.result.options.measure} of {self.result.options.point}"
        return f"<Quiet {self.result.stand.name}: {of} {self.reduction:.4g} times lower>"


def quiet(
    stand: StandGiven,
    point: str,
    band: tuple[float, float],
    *,
    momentum: Sequence[float] | None = None,
    speeds: Mapping[str, Number] | Sequence[Number] | None = None,
    axes: Sequence[Sequence[float]] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    measure: str | None = None,
    limit: Number | None = None,
    least: Number = 0.0,
    change: Number | None = None,
    reduction: float | None = None,
    avoid: Sequence[tuple[float, float]] = (),
    modes: bool = False,
    margin: float = 0.1,
    orders: Sequence[int] = (1, 2),
    guard: float = 0.02,
    seed: int = 0,
    seconds: Number | None = None,
    progress: OnProgress | None = None,
) -> Quiet:
    """Find speeds and phases of redundant flywheels that make a point quiet; their momentum is kept exactly.

    point, band   a point or instrument, of a held carrier also "hold.reaction"; frequencies, Hz
    momentum      to hold, in E1, N m s; None: that of `speeds`, with which the search begins; of a held carrier only
                  what is along the freedoms is held
    axes          directions of the point that count; measure: acceleration (default), velocity, displacement, rate,
                  angle; of the reaction force (default), moment
    limit, least  of every speed; change: of a speed at most; rad/s, or texts with a unit
    reduction     choose the least change that makes it lower by this factor; None: the lowest
    avoid, modes  frequencies (from, to; Hz) that no order may meet; also the natural ones, with a margin
    orders        whose lines avoid them; guard: at the band's ends

    Ctrl-C gives the best so far. Raises StandError, UsageError, CheckError.
    """
    from mahovik.use.vibration.quiet import QuietOptions
    from mahovik.use.vibration.quiet import quiet as find

    own = Stand.of(stand)

    def speed(name: str, value: Number | None) -> float | None:
        return None if value is None else quantity(name, value, SPEED)

    allowed = time_limit("seconds", seconds)
    given = None if speeds is None else tuple(by_flywheel("speeds", speeds, own, SPEED))
    if given is not None:
        warn_of_speeds(own, given, [""] * len(given))
    kind = measure or ("force" if point == REACTION else "acceleration")
    options = QuietOptions(
        point, band, None if momentum is None else tuple(momentum), given, tuple(map(tuple, axes)), kind,
        speed("limit", limit), speed("least", least) or 0.0, speed("change", change), reduction,
        tuple((a, b) for a, b in avoid), tuple(orders), modes, margin, guard, seed,
    )  # fmt: skip
    found = find(own, options, allowed, lambda words: tell(progress, Progress(words)))
    warn_of_turn(own)
    return Quiet(found)
