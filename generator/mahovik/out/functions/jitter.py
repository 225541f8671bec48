"""`jitter`: what wheels at any constant speeds do to a point: angle, rate, displacement, acceleration."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mahovik.out.api.fields import Array
from mahovik.out.api.stands import Stand
from mahovik.out.functions.given import Number, StandGiven, by_flywheel
from mahovik.out.functions.notices import OnProgress, Progress, tell
from mahovik.out.functions.table import Column, Table
from mahovik.out.functions.vibration import speed_text, warn_of_planned_speeds
from mahovik.use.study.jitter import Jitter as Study
from mahovik.use.study.jitter import jitter as find
from mahovik.use.study.jitter.lines import LineName
from mahovik.use.study.jitter.quantity import Seen
from mahovik.use.study.jitter.tables import AXES, as_object, csv_text, json_text, order_entries
from mahovik.use.study.response.speeds import read_speeds

if TYPE_CHECKING:
    from mahovik.out.report.plot.panel import Panel


class Jitter(Table):
    """Jitter of a point: a row per speed, columns of RMS, RSS, worst case and of the amplitude of each line.

    `study` holds all lines with phases; `stand`, `index` as in other tables.
    """

    def __init__(self, study: Study) -> None:
        self.study, self.stand = study, study.stand
        asked = study.asked
        self.index = "" if asked.sweep is None or asked.swept is None else f"speed {asked.names[asked.swept]}"

    @property
    def columns(self) -> tuple[Column, ...]:
        study, unit = self.study, self.unit
        found = [Column(f"speed {name}", "rad/s", study.speeds[:, s]) for s, name in enumerate(study.asked.names)]
        for name, values in study.sums().items():
            found += [Column(f"{name} {axis}", unit, values[:, i]) for i, axis in enumerate(AXES)]
        for i, label in enumerate(_labels(study.lines.names)):
            size = study.lines.sizes[:, i]
            if np.nanmax(size, initial=0.0) > 0.0:
                found += [Column(f"{label} {axis}", unit, size[:, j]) for j, axis in enumerate(AXES)]
        return tuple(found)

    @property
    def unit(self) -> str:
        """SI unit of the quantity."""
        return self.study.measure.unit

    @property
    def speeds(self) -> Array:
        """Speeds (S, N), rad/s."""
        return self.study.speeds

    @property
    def rms(self) -> Array:
        """Root mean square (S, 3) at the given phases, along the point's axes."""
        return self.study.sums()["rms"]

    @property
    def rss(self) -> Array:
        """Root mean square (S, 3) over all phases of the flywheels."""
        return self.study.sums()["rss"]

    @property
    def worst(self) -> Array:
        """Sum of all amplitudes (S, 3): the largest value at the worst phases."""
        return self.study.sums()["worst"]

    @property
    def orders(self) -> list[dict[str, Any]]:
        """Lines of single wheels, largest first: wheel, order, frequency (Hz), amplitude and phase along the axes."""
        return order_entries(self.study)

    @property
    def combinations(self) -> list[dict[str, Any]]:
        """Lines at sums and differences of the wheels' frequencies, largest first."""
        return order_entries(self.study, combinations=True)

    @property
    def left_out(self) -> Array:
        """Largest remaining acceleration of the full equations (S), relative; NaN where it was not evaluated."""
        return self.study.left_out

    @property
    def problems(self) -> tuple[str, ...]:
        """Why speeds have no steady state, one reason per such speed."""
        return tuple(text for _, text in self.study.problems)

    @property
    def interrupted(self) -> bool:
        """Whether something is missing, by Ctrl-C or `go_on`."""
        return self.study.interrupted

    def to_dict(self) -> dict[str, Any]:
        """All figures, as `mahovik jitter --json` prints them."""
        return as_object(self.study)

    def save(self, path: str | Path) -> None:
        """Write .json or .csv. Raises UsageError."""
        from mahovik.errors import UsageError
        from mahovik.writing import format_of, write

        suffix = format_of(Path(path), (".csv", ".json"))
        if suffix is None:
            raise UsageError(f"{path}: expected a name that ends in .csv or .json")
        write(Path(path), json_text(self.study) if suffix == ".json" else csv_text(self.study))

    def _panels(self) -> Sequence[Panel]:
        from mahovik.out.report.plot.jitter import panels

        return panels(self.study)

    def __repr__(self) -> str:
        study, many = self.study, len(self.study.value)
        speeds = "one speed" if many == 1 else f"{many} speeds"
        return f"<Jitter of {study.stand.name}: {study.quantity} of {study.point} at {speeds}>"


def _labels(names: Sequence[LineName]) -> list[str]:
    return [f"{name.text} {name.part}".strip() for name in names]


def jitter(
    stand: StandGiven,
    speeds: Mapping[str, Number] | Sequence[str],
    at: str,
    *,
    quantity: str = "angle",
    steps: int = 61,
    phases: Mapping[str, Number] | Sequence[Number] | None = None,
    order: int | None = None,
    exact: bool = False,
    go_on: Callable[[int], bool] | None = None,
    progress: OnProgress | None = None,
) -> Jitter:
    """Find what wheels at any constant speeds do to a point: lines of every wheel and order, RMS, worst case.

    speeds   by flywheel: `{"all": "3000rpm", "w2": "2987rpm"}`; rad/s, or a text as of `--speed`; one may be swept
    at       a point or instrument, "carrier" for O1
    quantity "angle", "rate", "displacement", "velocity" or "acceleration"
    phases   at t = 0, rad or a text, by flywheel
    order    highest combination of wheels in the harmonic balance; None: as high as the accuracy needs
    exact    in a sweep solve the full equations at every speed, not the linear ones
    go_on    gets the number of speeds done, and ends with False

    Raises StandError, UsageError, CheckError.
    """
    from mahovik.use.study.linear.model import places

    own = Stand.of(stand)
    place = places(own, [at])[0]
    texts = [speed_text(*each) for each in speeds.items()] if isinstance(speeds, Mapping) else list(speeds)
    asked = read_speeds(own, texts)
    warn_of_planned_speeds(own, asked, texts)
    count, words = 1 if asked.sweep is None else steps, f"jitter of {own.name}, speeds"

    def shall_go_on(done: int) -> bool:
        tell(progress, Progress(words, done, count))
        return go_on is None or go_on(done)

    phi = by_flywheel("phases", phases, own)
    seen = Seen.of(place, quantity)
    found = find(
        own, asked, steps, seen, phases=phi, order=order, exact=exact, go_on=shall_go_on
    )  # fmt: skip
    if not len(found.value):
        raise KeyboardInterrupt
    return Jitter(found)
