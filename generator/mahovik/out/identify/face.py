"""`identify`: numbers of a stand from measured data."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import Number, StandGiven, quantity
from mahovik.out.functions.table import Column, Table
from mahovik.out.identify.figures import ChannelFit, Parameter
from mahovik.out.identify.run import LEAST_NOISE, has_signal
from mahovik.out.notices import OnProgress

if TYPE_CHECKING:
    from mahovik.core.stand.numbers import StandNumber
    from mahovik.core.stand.units import Dimension
    from mahovik.out.api.fields import Array
    from mahovik.out.identify.estimate import Fit
    from mahovik.out.identify.free import Free
    from mahovik.out.identify.page import Comparison
    from mahovik.out.identify.run import Run


@dataclass(frozen=True, eq=False)
class Identification(Table):
    """Estimated numbers of a stand: a row per number.

    stand         with the estimated numbers
    parameters    by path
    correlation   of the parameters (k, k); NaN where a number has no standard error
    unobservable  one line each: numbers that the data cannot tell, and what would show them
    channels      what is left of each channel, by run and name
    residual      rms of what is left, as a share of the rms of the data; mean over the channels that have a signal
    check         the same of data that were not used, with the estimated numbers and with those of the file; None
    notes         what was found in the data, and corrected
    """

    stand: Stand
    parameters: Mapping[str, Parameter]
    correlation: Array
    unobservable: tuple[str, ...]
    channels: Mapping[str, Mapping[str, ChannelFit]]
    residual: float
    check: tuple[float, float] | None
    notes: tuple[str, ...]
    _places: tuple[StandNumber, ...] = field(repr=False)
    _comparison: Comparison = field(repr=False)

    index = "path"

    @property
    def columns(self) -> tuple[Column, ...]:
        rows = list(self.parameters.values())
        return (
            Column("path", "", np.array([each.path for each in rows], dtype=object)),
            Column("value", "SI", np.array([each.value for each in rows])),
            Column("standard error", "SI", np.array([each.standard_error for each in rows])),
            Column("before", "SI", np.array([each.before for each in rows])),
        )

    def text(self, file: str | Path) -> str:
        """The text of a stand file with the estimated numbers: comments, order and units stay.

        Raises UsageError; StandError: with these numbers it would be no stand.
        """
        from mahovik.core.stand import loads
        from mahovik.out.identify.document import with_numbers

        try:
            found = with_numbers(Path(file).read_text(encoding="utf-8-sig"), self.stand, self._places)
        except (OSError, UnicodeDecodeError) as error:
            raise UsageError(f"{file}: cannot be read: {error}") from None
        loads(found)
        return found

    @property
    def residual_orders(self) -> dict[str, dict[str, dict[str, list[float]]]]:
        """Amplitudes of what is left at orders 1 to 4 of the flywheels, SI, by run, flywheel and channel."""
        from mahovik.out.identify.page import residual_orders

        return residual_orders(self._comparison)

    def report(self, path: str | Path) -> Path:
        """Write a page: numbers, orders against speed as measured and modelled, residuals, ellipses of confidence.

        Raises UsageError: matplotlib is missing, or the file cannot be written.
        """
        from mahovik.out.identify.page import identification_parts
        from mahovik.out.report.page import write_page

        place, at = Path(path), self._comparison
        files = [("data", each.source) for each in at.recordings]
        title = f"{self.stand.name}: identification"
        write_page(place, title, identification_parts(self, at), stand=at.free.model.stand, files=files)
        return place

    def to_dict(self) -> dict[str, Any]:
        """All figures, as `mahovik identify --json` prints them."""
        found: dict[str, Any] = {
            "stand": self.stand.name,
            "parameters": {
                each.path: {"value": each.value, "unit": each.unit, "standard_error": _finite(each.standard_error)}
                | {"before": each.before}
                for each in self.parameters.values()
            },
            "correlation": [[_finite(x) for x in row] for row in self.correlation.tolist()],
            "unobservable": list(self.unobservable),
            "residual": _finite(self.residual),
            "channels": {
                run: {name: dict(vars(each)) | {"share": _finite(each.share)} for name, each in channels.items()}
                for run, channels in self.channels.items()
            },
            "residual_orders": self.residual_orders,
            "notes": list(self.notes),
        }
        if self.check is not None:
            found["check"] = {"residual": _finite(self.check[0]), "before": _finite(self.check[1])}
        return found

    def __repr__(self) -> str:
        lost = f", {len(self.unobservable)} unobservable" if self.unobservable else ""
        return f"<Identification of {self.stand.name}: {len(self)} numbers{lost}, residual {100 * self.residual:.3g} %>"


def identify(
    stand: StandGiven,
    data: str | Path | Sequence[str | Path],
    free: str | Sequence[str],
    *,
    check: Sequence[str | Path] = (),
    delay: Mapping[str, Number] | None = None,
    loss: str = "linear",
    progress: OnProgress | None = None,
) -> Identification:
    """Estimate numbers of a stand from measured data, by least squares with the exact model.

    stand  with the sensors as points
    data   files of measured data: channels of sensors, and phases of all flywheels
    free   paths of the stand file, such as "w*.unbalance", or a file that names them and ends in .toml
    check  files of data that are only predicted
    delay  known delays of sensors, by point, s or texts with a unit
    loss   "linear"; "soft_l1" or "huber" where samples are outliers

    Raises DataError, StandError, StateError, UsageError.
    """
    from mahovik.core.stand.units import TIME
    from mahovik.out.api.model import build
    from mahovik.out.campaign.signals import sensors
    from mahovik.out.identify.arrangement import bad_fits
    from mahovik.out.identify.estimate import estimate
    from mahovik.out.identify.free import Free
    from mahovik.out.identify.gauss_newton import LOSSES
    from mahovik.out.identify.page import Comparison
    from mahovik.out.identify.run import runs_of
    from mahovik.out.identify.sense import wrong_ways
    from mahovik.out.identify.sight import unobservable
    from mahovik.out.identify.wanted import Wanted, wanted_of
    from mahovik.use.measured import read_recordings

    if loss not in LOSSES:
        raise UsageError(f'loss: unknown "{loss}"{suggestion(loss, LOSSES)}')
    own = Stand.of(stand)
    wanted = wanted_of(free) if isinstance(free, str) else Wanted(tuple(free))
    delays = wanted.delays | {name: quantity(f"delay of {name}", each, TIME) for name, each in (delay or {}).items()}
    for name in delays:
        if name not in sensors(own):
            raise UsageError(f'delay: {own.name} has no point or instrument "{name}"{suggestion(name, sensors(own))}')
    numbers = Free(build(own), wanted.paths)
    recordings = read_recordings(_files(data), own)
    others = read_recordings(_files(check), own) if check else ()
    runs = runs_of(recordings, own, None, delays)
    fit = estimate(numbers, runs, loss, progress=progress)
    new = _stand_of(numbers, fit)
    checked = None
    if others:
        tests = runs_of(others, own, None, delays)
        checked = tuple(
            _share(tests, estimate(numbers, tests, loss, theta=theta, fixed=True))
            for theta in (fit.theta, numbers.nominal)
        )
    lost, advice = unobservable(numbers, runs, fit.theta, fit.noise, fit.held)
    notes = [note for each in (*recordings, *others) for note in each.notes] + [
        note for run in runs for note in run.notes
    ]
    parameters = _parameters(numbers, fit)
    seen = [
        place
        for entry in numbers.entries
        if any(math.isfinite(parameters[path].standard_error) for path in entry.paths)
        for place in entry.numbers
    ]
    return Identification(
        new,
        parameters,
        _correlation(_covariance(numbers, fit)),
        tuple(lost),
        {run.source: _channels(run, fit, r) for r, run in enumerate(runs)},
        _share(runs, fit),
        None if checked is None else (checked[0], checked[1]),
        (*notes, *advice, *_without_signal(runs, fit), *bad_fits(fit, runs), *wrong_ways(numbers, fit, runs)),
        tuple(seen),
        Comparison(tuple(recordings), tuple(runs), numbers, fit),
    )


def _files(given: str | Path | Sequence[str | Path]) -> list[Path]:
    return [Path(given)] if isinstance(given, str | Path) else [Path(each) for each in given]


def _stand_of(free: Free, fit: Fit) -> Stand:
    """The stand with the estimated numbers. Raises StandError."""
    if not free.size:
        return free.stand
    return free.stand.replace({path: values[0] for path, values in free.changes(fit.theta[:, None]).items()})


def _covariance(free: Free, fit: Fit) -> Array:
    """Covariance of the values of the paths (k, k)."""
    slopes = free.slopes(fit.theta)
    found: Array = slopes @ fit.covariance @ slopes.T
    return found


def _correlation(covariance: Array) -> Array:
    size = _errors(covariance)
    found: Array = np.full_like(covariance, np.nan)
    np.divide(covariance, np.outer(size, size), out=found, where=np.outer(size, size) > 0.0)
    return found


def _errors(covariance: Array) -> Array:
    """Standard errors; NaN where there is none."""
    square = np.diag(covariance)
    return np.sqrt(np.where(square >= 0.0, square, np.nan))


def _parameters(free: Free, fit: Fit) -> dict[str, Parameter]:
    values, before = (free.values(theta[:, None])[:, 0].tolist() for theta in (fit.theta, free.nominal))
    errors = _errors(_covariance(free, fit)).tolist()
    rows = zip(free.paths, values, free.dimensions, errors, before, strict=True)
    return {path: Parameter(path, value, _unit(of), error, old) for path, value, of, error, old in rows}


def _unit(dimension: Dimension) -> str:
    return dimension.si or "1"


def _channels(run: Run, fit: Fit, r: int) -> dict[str, ChannelFit]:
    left, spread = _sizes(run, fit, r)
    rows = zip(run.channels, left.tolist(), (left / spread).tolist(), fit.offsets[r].tolist(), strict=True)
    return {channel.name: ChannelFit(channel.unit, size, share, offset) for channel, size, share, offset in rows}


def _sizes(run: Run, fit: Fit, r: int) -> tuple[Array, Array]:
    """Rms of what is left of the channels, and of their data without mean (C), NaN where these are constant."""
    left, spread = np.sqrt(np.nanmean(fit.residuals[r] ** 2, axis=0)), np.nanstd(run.measured, axis=0)
    return left, np.where(spread > LEAST_NOISE, spread, np.nan)


def _share(runs: Sequence[Run], fit: Fit) -> float:
    """Mean over the channels with a signal; over all that are not constant, if none has; NaN if all are constant."""
    sizes = [left / spread for left, spread in (_sizes(run, fit, r) for r, run in enumerate(runs))]
    shares, with_signal = np.concatenate(sizes), _with_signal(runs, fit)
    own = shares[with_signal] if with_signal.any() else shares[np.isfinite(shares)]
    return float(np.sqrt(np.mean(own**2))) if own.size else math.nan


def _with_signal(runs: Sequence[Run], fit: Fit) -> NDArray[np.bool_]:
    return np.concatenate([has_signal(run, fit.residuals[r]) for r, run in enumerate(runs)])


def _without_signal(runs: Sequence[Run], fit: Fit) -> list[str]:
    if _with_signal(runs, fit).any():
        return []
    return ["no channel has a signal above its noise: the residual is that of noise"]


def _finite(x: float) -> float | None:
    return x if math.isfinite(x) else None
