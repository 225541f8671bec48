"""`jitter`: what wheels at any constant speeds do to a point: angle, rate, displacement, acceleration."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mahovik.errors import CheckError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.fields import Array
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import Number, StandGiven, by_flywheel
from mahovik.out.functions.table import Column, Table
from mahovik.out.functions.vibration import planned_speeds
from mahovik.out.notices import OnProgress, Progress, tell, warn_of_turn
from mahovik.use.vibration.chain import Makers
from mahovik.use.vibration.lines import LineName
from mahovik.use.vibration.maker import read_harmonics, read_inner_modes, read_noise
from mahovik.use.vibration.requirement import Requirement, judge, read_requirements
from mahovik.use.vibration.speeds import ALL
from mahovik.use.vibration.structure import read_structure
from mahovik.use.vibration.study import Jitter as Study
from mahovik.use.vibration.study import jitter as find
from mahovik.use.vibration.tables import as_object, csv_text, json_text, order_entries, verdict_object
from mahovik.use.vibration.view import Observable, find_view, read_sight

if TYPE_CHECKING:
    from mahovik.out.report.plot.panel import Panel


class Jitter(Table):
    """Jitter of a point: a row per speed, columns of RMS, RSS, worst case and of the amplitude of each line.

    `study` holds all lines with phases; `stand`, `index` as in other tables.
    """

    def __init__(self, study: Study, requirements: Sequence[Requirement] = ()) -> None:
        self.study, self.stand = study, study.stand
        self.verdicts = tuple(judge(study, each) for each in requirements)
        asked = study.asked
        self.index = "" if asked.sweep is None or asked.swept is None else f"speed {asked.names[asked.swept]}"

    @property
    def columns(self) -> tuple[Column, ...]:
        study, unit = self.study, self.unit
        found = [Column(f"speed {name}", "rad/s", study.speeds[:, s]) for s, name in enumerate(study.asked.names)]
        for name, values in study.sums().items():
            found += [Column(f"{name} {axis}", unit, values[:, i]) for i, axis in enumerate(study.axes)]
        for i, label in enumerate(_labels(study.lines.names)):
            size = study.lines.sizes[:, i]
            if np.nanmax(size, initial=0.0) > 0.0:
                found += [Column(f"{label} {axis}", unit, size[:, j]) for j, axis in enumerate(study.axes)]
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
        """Root mean square (S, 3) at the given phases, along the point's axes; of a freedom (S, 1), as all below."""
        return self._existing_axes("rms")

    @property
    def rss(self) -> Array:
        """Root mean square (S, 3) over all phases of the flywheels."""
        return self._existing_axes("rss")

    @property
    def worst(self) -> Array:
        """Sum of all amplitudes (S, 3): the largest value at the worst phases."""
        return self._existing_axes("worst")

    def _existing_axes(self, name: str) -> Array:
        """A sum along the axes that there are."""
        return self.study.sums()[name][:, : len(self.study.axes)]

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
        """Largest remaining acceleration of the full equations at random phases (S), relative; NaN: not evaluated."""
        return self.study.left_out

    @property
    def remainder(self) -> Array:
        """Part of the quantity that the balance leaves out (S, 3): lines of two more orders, summed; NaN: unknown."""
        return self.study.remainder[:, : len(self.study.axes)]

    @property
    def problems(self) -> tuple[str, ...]:
        """Why speeds have no steady state, or an inaccurate one."""
        return tuple(text for _, text in self.study.problems)

    @property
    def interrupted(self) -> bool:
        """Whether something is missing, by Ctrl-C or `go_on`."""
        return self.study.interrupted

    @property
    def requirements(self) -> list[dict[str, Any]]:
        """Requirements: limit, value, margin, whether met, worst speed and axis."""
        return [verdict_object(self.study, each) for each in self.verdicts]

    @property
    def met(self) -> bool:
        """Whether all requirements are met."""
        return all(each.met for each in self.verdicts)

    def to_dict(self) -> dict[str, Any]:
        """All figures, as `mahovik jitter --json` prints them."""
        return as_object(self.study, self.verdicts)

    def save(self, path: str | Path) -> None:
        """Write .json or .csv. Raises UsageError."""
        from mahovik.writing import format_of, write

        suffix = format_of(Path(path), (".csv", ".json"))
        if suffix is None:
            raise UsageError(f"{path}: expected a name that ends in .csv or .json")
        write(Path(path), json_text(self.study, self.verdicts) if suffix == ".json" else csv_text(self.study))

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
    at: str | None = None,
    *,
    quantity: str | None = None,
    steps: int = 61,
    phases: Mapping[str, Number] | Sequence[Number] | None = None,
    harmonics: Mapping[str, str | Path] | None = None,
    noise: Mapping[str, str | Path] | None = None,
    inner_modes: Mapping[str, str | Path] | None = None,
    modes: str | Path | None = None,
    sight: str | Path | None = None,
    require: Sequence[str | Path] = (),
    order: int | None = None,
    exact: bool = False,
    go_on: Callable[[int], bool] | None = None,
    progress: OnProgress | None = None,
) -> Jitter:
    """Find what wheels at any constant speeds do to a point: lines of every wheel and order, RMS, worst case.

    speeds   by flywheel: `{"all": "3000rpm", "w2": "2987rpm"}`; rad/s, or a text as of `--speed`; one may be swept
    at       a point or instrument, "carrier" for O1; or a load: a flywheel, for the wrench of its mount on it about
             its origin, or "hold.reaction", of a held carrier, for that of the hold on the carrier about O1;
             "hold.pitch", or "hold.1" by its place, is a freedom
    quantity "angle", "rate", "displacement", "velocity" or "acceleration", by default the first; of a load "force", or
             "moment"; a freedom that turns has "angle", "rate", "acceleration", another the last three
    phases   at t = 0, rad or a text, by flywheel
    harmonics, noise, inner_modes   CSV files by flywheel, or by "all": what its maker says
    modes    CSV file of structural modes, one-way
    sight    CSV file of sensitivities of a line of sight, in place of `at` and `quantity`
    require  limits, `["rms 0.1 arcsec"]`, or CSV files of a mask
    order    highest combination of wheels in the harmonic balance; None: as high as the accuracy needs
    exact    in a sweep solve the full equations at every speed, not the linear ones
    go_on    gets the number of speeds done, and ends with False

    Raises StandError, UsageError, JitterFileError, CheckError.
    """
    own = Stand.of(stand)
    view = _view(own, at, quantity, sight)
    if require and view.measure.unit.startswith("1"):
        raise UsageError(f"--require: {view.name} of a basis has no unit; expected another freedom, a point or a load")
    limits = read_requirements([str(each) for each in require], view.measure)
    makers = Makers(
        _by_wheel(own, "harmonics", harmonics, read_harmonics),
        _by_wheel(own, "noise", noise, read_noise),
        _by_wheel(own, "inner_modes", inner_modes, read_inner_modes),
        None if modes is None else read_structure(Path(modes), own),
    )
    asked = planned_speeds(own, speeds)

    def shall_go_on(done: int, planned: int) -> bool:
        tell(progress, Progress(f"jitter of {own.name}, speeds", done, planned))
        return go_on is None or go_on(done)

    phi = by_flywheel("phases", phases, own)
    found = find(
        own, asked, steps, view, phases=phi, makers=makers, order=order, exact=exact, go_on=shall_go_on
    )  # fmt: skip
    if not len(found.value):
        raise CheckError(f"jitter of {own.name}: go_on ended it before the first speed")
    warn_of_turn(own)
    return Jitter(found, limits)


def _view(stand: Stand, at: str | None, quantity: str | None, sight: str | Path | None) -> Observable:
    """What is seen. Raises UsageError: neither a point nor a line of sight, or both."""
    if (at is None) is (sight is None):
        raise UsageError("expected a point or a line of sight: one of --at and --sight")
    return read_sight(Path(sight), stand) if sight is not None else find_view(stand, str(at), quantity, "angle")


def _by_wheel(
    stand: Stand, option: str, given: Mapping[str, str | Path] | None, read: Callable[[Path], Any]
) -> dict[str, Any]:
    """Tables by flywheel; a name replaces the table of `all`. Raises UsageError, JitterFileError."""
    names = [s.name for s in stand.flywheels]
    found: dict[str, Any] = {}
    for name, path in sorted((given or {}).items(), key=lambda each: each[0] != ALL):
        if name != ALL and name not in names:
            raise UsageError(f'{option}: unknown flywheel "{name}"{suggestion(name, [*names, ALL])}')
        found |= dict.fromkeys(names if name == ALL else [name], read(Path(path)))
    return found
