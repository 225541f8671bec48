"""`excite`: the programme of the flywheels that makes free numbers of a stand as well determined as possible."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.programme import Programme as CoreProgramme
from mahovik.core.stand.state import State
from mahovik.errors import CheckError, StandError, StateError, UsageError, whole_number
from mahovik.out.api.model import build
from mahovik.out.api.stands import Stand
from mahovik.out.functions.equilibrium import warn_of_turn
from mahovik.out.functions.given import Number, StandGiven, time, time_limit
from mahovik.out.functions.notices import OnProgress, Progress, tell
from mahovik.out.functions.programmes import Programme
from mahovik.out.functions.table import Column, Table
from mahovik.out.identify.channels import REACTION, Channel, chosen_channels
from mahovik.out.identify.excite.bounds import Bounds, Given, bounds_of
from mahovik.out.identify.excite.course import Courses
from mahovik.out.identify.excite.information import Criterion, Experiment, Quality
from mahovik.out.identify.excite.limits import Peaks, peaks_of
from mahovik.out.identify.excite.noise import noise_of_channels
from mahovik.out.identify.excite.search import EVALUATIONS, search
from mahovik.out.identify.free import Free
from mahovik.out.identify.wanted import wanted_of
from mahovik.use.plan.budget import Budget, defer_interrupt
from mahovik.use.study.rest import rest

Array = NDArray[np.float64]

UNBALANCES = "*.unbalance"
"""Unbalances of all flywheels."""

SHARES = (1.0, 0.8, 0.6, 0.4, 0.2, 0.1, 0.0)
"""Shares of the modulations that are tried until motors can give the torque."""

LEAST_GAIN = 1.005
"""Gain that is printed as more than 1."""

MOST_SAMPLES = 200_000
"""Samples of an experiment at most: derivatives of all are in memory at once."""


@dataclass(frozen=True, eq=False)
class Tried:
    """A programme with its accuracy of the free numbers and its peaks."""

    programme: CoreProgramme
    quality: Quality
    peaks: Peaks


class Excitation(Table):
    """Outcome of `excite`: a row per free number, with its predicted standard errors.

    status is OK or OK_LIMIT: the programme exceeds bounds, which `words` name.
    """

    index = "parameter"

    def __init__(self, stand: Stand, free: Free, found: Tried, even: Tried, effort: Mapping[str, Any]) -> None:
        self.stand, self.free, self.found, self.even, self.effort = stand, free, found, even, effort

    @property
    def columns(self) -> tuple[Column, ...]:
        values = self.free.values(self.free.nominal[:, None])[:, 0]
        return (
            Column("parameter", "", np.array(self.free.paths, dtype=object)),
            Column("unit", "", np.array([each.si for each in self.free.dimensions], dtype=object)),
            Column("value", "", values),
            Column("error", "", self._errors(self.found)),
            Column("error at constant speeds", "", self._errors(self.even)),
        )

    def _errors(self, of: Tried) -> Array:
        """Standard errors of the values; of an amount of zero that of its parts, and of its angle NaN."""
        S, covariance = self.free.slopes(self.free.nominal), of.quality.covariance
        with np.errstate(invalid="ignore"):
            errors = np.sqrt(np.diag(S @ covariance @ S.T))
        row = 0
        for entry in self.free.entries:
            own = slice(row, row + len(entry.numbers))
            if entry.polar:
                block = np.array(entry.slopes(self.free.nominal[own]))
                errors[own] = np.sqrt(np.diag(block @ covariance[own, own] @ block.T))
                if math.isnan(errors[row]):
                    errors[row] = math.sqrt(float(np.trace(covariance[own, own])) / 2.0)
            else:
                errors[own] = np.sqrt(np.diag(covariance[own, own]))
            row = own.stop
        errors[row:] = np.sqrt(np.diag(covariance[row:, row:]))
        return np.asarray(errors)

    @property
    def programme(self) -> Programme:
        """The programme, with its figures in `report`."""
        return Programme(self.stand, None, replace(self.found.programme, report=self.report()))

    @property
    def constant(self) -> Programme:
        """Distinct constant speeds, evenly spread inside the same bounds."""
        return Programme(self.stand, None, self.even.programme)

    @property
    def gain(self) -> float:
        """Mean variance at evenly spread constant speeds over that of the programme; in natural sizes."""
        return self.even.quality.mean_variance / self.found.quality.mean_variance

    @property
    def is_better(self) -> bool:
        """Whether the programme tells more than evenly spread constant speeds, in the figures that are printed."""
        return self.gain >= LEAST_GAIN

    @property
    def comparison(self) -> str:
        """The gain in words."""
        even = "constant speeds spread evenly inside the bounds"
        if self.is_better:
            return f"mean variance {self.gain:.3g} times less than at {even}"
        return f"no programme was found that tells more than {even}"

    @property
    def without_angle(self) -> tuple[str, ...]:
        """Free angles of unbalances that are zero: they have no standard error."""
        rows = zip(self.free.paths, self["error"], strict=True)
        return tuple(path for path, error in rows if path.endswith("_at") and math.isnan(error))

    @property
    def status(self) -> str:
        """OK, OK_LIMIT."""
        return "OK_LIMIT" if self.words else "OK"

    @property
    def words(self) -> tuple[str, ...]:
        """Bounds that the programme exceeds, a line each."""
        return self.found.peaks.exceeded

    @property
    def unseen(self) -> tuple[str, ...]:
        """Free numbers that the programme hardly shows."""
        return tuple(path for path, no in zip(self.free.paths, self.found.quality.unseen, strict=True) if no)

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended the search."""
        return bool(self.effort["interrupted"])

    def report(self) -> dict[str, Any]:
        """Figures that the programme's file keeps."""
        peaks = self.found.peaks
        return {
            "kind": "excite",
            "criterion": self.effort["criterion"],
            "parameters": list(self.free.paths),
            "errors": [_plain(x) for x in self["error"]],
            "mean_variance": self.found.quality.mean_variance,
            "least_speed": peaks.speed_min.tolist(),
            "peak_speed": peaks.speed.tolist(),
            "peak_acceleration": peaks.acceleration.tolist(),
            "peak_motor_torque": peaks.torque.tolist(),
            "exceeded": list(self.words),
        }

    def to_dict(self) -> dict[str, Any]:
        """All figures, as `mahovik excite --json` prints them."""
        rows = zip(*(column.values.tolist() for column in self.columns), strict=True)
        keys = ("path", "unit", "value", "standard_error", "standard_error_constant")
        return {
            "status": self.status,
            "words": list(self.words),
            "parameters": [dict(zip(keys, map(_plain, row), strict=True)) for row in rows],
            "gain": self.gain,
            "unobservable": list(self.unseen),
            "programme": _figures(self.found),
            "constant": _figures(self.even),
            "effort": dict(self.effort),
        }

    def save(self, path: str | Path) -> None:
        """Write the programme. Raises UsageError."""
        self.programme.save(path)

    def _panels(self) -> Any:
        return self.programme._panels()

    def __repr__(self) -> str:
        return f"<Excitation of {self.stand.name}: {len(self)} free numbers, {self.comparison}>"


def _plain(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _figures(of: Tried) -> dict[str, Any]:
    peaks = of.peaks
    return {
        "mean_variance": of.quality.mean_variance,
        "volume": of.quality.volume,
        "least_speed": peaks.speed_min.tolist(),
        "peak_speed": peaks.speed.tolist(),
        "peak_acceleration": peaks.acceleration.tolist(),
        "peak_motor_torque": peaks.torque.tolist(),
        "winding": list(of.programme.winding),
        "exceeded": list(peaks.exceeded),
    }


def excite(
    stand: StandGiven,
    *,
    free: str | Path | Sequence[str] = UNBALANCES,
    duration: Number = 10.0,
    speed: Given | None = None,
    speed_min: Given | None = None,
    acceleration: Given | None = None,
    torque: Given | None = None,
    channels: Sequence[str] = (),
    noise: Mapping[str, Number] | None = None,
    rate: float = 1000.0,
    criterion: Criterion = "A",
    harmonics: int = 2,
    seconds: Number | None = None,
    seed: int = 0,
    progress: OnProgress | None = None,
) -> Excitation:
    """Find the programme of the flywheels by which free numbers of the stand are determined best.

    free          paths between commas or in a list, or a file FREE.toml
    duration      of the experiment, s: the programme's period
    speed, ...    bounds: numbers in SI or texts with a unit, one for all flywheels, one for each, or by their names;
                  None: those of the motors
    channels      those that are read, as ["imu.rate.*", "hold.reaction.z"]; by default all of the sensors of the stand,
                  and the reaction of the hold of a held carrier
    noise         standard deviations of samples by channel, as {"rate": 0.002, "imu.acceleration": "0.01 m/s2"},
                  of a reaction as {"force": "0.02 N", "moment": 0.002}
    rate          samples per second
    criterion     "A": least mean variance; "D": least volume of the ellipsoid of confidence
    harmonics     of the speed, whole multiples of 1/duration
    seconds       limits the search, also as "1 min"; None: a number of programmes alone

    Ctrl-C gives the best so far. Raises StandError, UsageError, CheckError.
    """
    own = Stand.of(stand)
    span, read = time("--duration", duration), chosen_channels(own, channels)
    allowed = time_limit("seconds", seconds)
    _require_experiment(own, read, span, rate, criterion, harmonics, seed)
    bounds = bounds_of(own, speed, speed_min, acceleration, torque, span)
    noises = noise_of_channels(read, noise or {})
    unknown = Free(build(own), wanted_of(str(free)).paths if isinstance(free, str | Path) else tuple(free))
    if (start := _start(own)) is not None:
        warn_of_turn(own, start)
    experiment = Experiment(own, unknown, read, noises, rate, float(bounds.speed.max()), start)
    courses = Courses(own, bounds, span, harmonics)
    tell(progress, Progress("compiling"))
    even = _try_numbers(experiment, courses, bounds, courses.even(), 0.0, start)
    budget = Budget(EVALUATIONS, allowed)

    def value(numbers: Array) -> float:
        tell(progress, Progress("searching", budget.steps_taken, EVALUATIONS))
        try:
            return experiment.quality(courses.programme(numbers)).value(criterion)
        except (StandError, StateError):
            return math.inf

    with defer_interrupt(budget.interrupt, again=True):
        best = search(value, courses, budget, seed)
    tell(progress, Progress("checking the best"))
    effort = {
        "tried": best.tried, "seed": seed, "criterion": criterion, "seconds": budget.elapsed,
        "cut_by_time": budget.cut, "interrupted": budget.interrupted,
    }  # fmt: skip
    for share in SHARES:
        found = _try_numbers(experiment, courses, bounds, best.numbers, share, start)
        if not found.peaks.exceeded:
            break
    worse = found.peaks.exceeded or found.quality.value(criterion) > even.quality.value(criterion)
    if worse and not even.peaks.exceeded:
        found = even
    return Excitation(own, unknown, found, even, effort)


def _try_numbers(
    experiment: Experiment, courses: Courses, bounds: Bounds, numbers: Array, share: float, start: State | None
) -> Tried:
    programme = courses.programme(numbers, share)
    peaks = peaks_of(experiment.stand, programme, bounds, start)
    return Tried(programme, experiment.quality(programme, fine=True), peaks)


def _start(stand: Stand) -> State | None:
    """The static equilibrium; None where there is none: the carrier then starts at zero or its home pose, still."""
    try:
        return rest(stand).state
    except CheckError:
        return None


def _require_experiment(
    stand: Stand, read: Sequence[Channel], span: float, rate: float, criterion: str, harmonics: int, seed: int
) -> None:
    """Raise UsageError where no experiment is possible."""
    if stand.hold is not None and not stand.hold.freedoms and all(each.kind != REACTION for each in read):
        raise UsageError(
            "--channels: the carrier is clamped, so that its sensors read the same all the time; expected channels "
            'of the reaction, such as "hold.reaction.*"'
        )
    if not read:
        raise UsageError(
            f"{stand.name}: has no instrument or point, so nothing is measured; give its file a [[point]] where the "
            "IMU is"
        )
    if not (math.isfinite(span) and span > 0.0):
        raise UsageError(f"--duration {span:g}: expected a time above 0, in s")
    if not (math.isfinite(rate) and rate > 0.0):
        raise UsageError(f"--rate {rate:g}: expected a number above 0, in samples per second")
    if not 10 <= span * rate <= MOST_SAMPLES:
        raise UsageError(f"--duration {span:g}, --rate {rate:g}: {span * rate:.6g} samples, expected 10 to 200000")
    if criterion not in ("A", "D"):
        raise UsageError(f'--criterion "{criterion}": expected A or D')
    whole_number("harmonics", harmonics, 0, 20)
    whole_number("seed", seed, 0)
