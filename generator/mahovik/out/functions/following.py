"""`follow`: sampled servos follow a programme, on a stand that differs a little from its file."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mahovik.errors import CheckError, UsageError
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import Number, StandGiven, motion_of, programme_of, servo_of
from mahovik.out.functions.programmes import MotionGiven, ProgrammeGiven
from mahovik.out.functions.simulation import Simulation
from mahovik.out.functions.table import Column, Table
from mahovik.out.notices import OnProgress, Progress, tell, warn
from mahovik.use.control.causes import Contribution, contributions
from mahovik.use.control.finite import Tracking, errors_of
from mahovik.use.control.loop import Case, close_loop, step_error
from mahovik.use.control.record import Following as Errors
from mahovik.use.control.record import Record

if TYPE_CHECKING:
    from mahovik.core.motion.servo import Servo
    from mahovik.out.report.plots import Panel

MEASURED_PERIODS = 10
"""Periods measured at the end of a run."""

SETTLING = 30
"""Periods before them, by default, without a trim."""

TABLE = 128
"""Nodes per period of the table in firmware, by default."""

LEFT, MOST_ROUNDS = 1e-2, 60
"""A trim runs until this part of the error is left, or for this many rounds."""


class Following(Table):
    """How well the carrier follows: a row per coordinate, errors about the mean over the last periods.

    Of a finite programme, a slew among them, errors over the whole run, and at its end in place of the mean.
    `motion` holds the whole run; `causes` what limits it, if that was asked and the run was complete.
    """

    index = "coordinate"

    def __init__(
        self, case: Case, record: Record, errors: Errors | Tracking | None, causes: Sequence[Contribution]
    ) -> None:
        self.case, self.record, self.errors, self.causes = case, record, errors, tuple(causes)
        self.causes_interrupted = False

    @property
    def columns(self) -> tuple[Column, ...]:
        if self.errors is None:
            return ()
        found = self.errors
        share = np.array([math.nan if each is None else each for each in found.shares()])
        return (
            Column("coordinate", "", np.array(found.coordinates.names, dtype=object)),
            Column("amplitude", "m, rad", found.amplitude),
            Column("peak_error", "m, rad", found.peak),
            Column("rms_error", "m, rad", found.rms),
            Column("mean_error", "m, rad", found.mean)
            if isinstance(found, Errors)
            else Column("end_error", "m, rad", found.end),
            Column("share", "", share),
        )

    @property
    def share(self) -> float:
        """Largest error of all six together, as a share of the largest motion; NaN where the run ended early."""
        return math.nan if self.errors is None else self.errors.share

    @property
    def motion(self) -> Simulation:
        """The run: carrier, flywheels, torques, what is required."""
        return Simulation(self.case.reference.stand, self.record.run())

    @property
    def stopped(self) -> str | None:
        """Why the run ended early, or None."""
        return self.record.stopped

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended it."""
        return self.record.interrupted or self.causes_interrupted

    @property
    def step_error(self) -> float:
        """Change of the carrier (m, rad) by steps half as long."""
        return step_error(self.case, self.record)

    def _panels(self) -> Sequence[Panel]:
        return self.motion._panels()

    def __repr__(self) -> str:
        name = self.case.reference.stand.name
        if self.errors is None:
            return f"<Following of {name}: {self.stopped}>"
        return f"<Following of {name}: error {100 * self.share:.3g} % of the motion's amplitude>"


def follow(
    stand: StandGiven,
    motion: MotionGiven,
    programme: ProgrammeGiven,
    servo: Servo | str | Path,
    *,
    mismatch: Number = 0.0,
    seed: int = 1,
    periods: int | None = None,
    begin: str | None = None,
    table: int | None = TABLE,
    backend: str = "c",
    causes: bool = True,
    progress: OnProgress | None = None,
) -> Following:
    """Follow a programme by sampled servos, on a stand whose numbers are wrong by `mismatch` (0.01 or "1%").

    seed     of the errors; periods to run, None: until it has settled
    begin    "settled", "programme" or "rest", with the run-up; None: "settled", or of a finite programme "programme"
    table    nodes per period of the table in firmware; None: exact. A finite programme is a table of its own
    backend  "c" or "scipy"; causes: find what limits it, by further runs

    Ctrl-C keeps what was computed. Raises StandError, MotionError, ProgrammeError, ServoError, UsageError, CheckError.
    """
    own = Stand.of(stand)
    case = following_case(own, motion, programme, servo, mismatch, seed, periods, begin, table, backend)
    T, words = case.servo.period, f"follow {_name(programme, 'the programme')}"
    first, last = case.first * T, case.last * T
    record = close_loop(case, lambda t: tell(progress, Progress(words, t - first, last - first)))
    if len(record.t) < 2:
        raise CheckError(f"the run ends at once: {record.stopped}")
    if record.stopped is not None:
        return Following(case, record, None, ())
    found = Following(case, record, errors_of(record, MEASURED_PERIODS), ())
    try:
        if causes:
            found.causes = tuple(
                contributions(case, lambda cause: tell(progress, Progress(f"what limits it: {cause}")))
            )
    except KeyboardInterrupt:  # the run itself is complete
        found.causes_interrupted = True
    return found


def _name(given: Any, otherwise: str) -> str:
    """The name of a file in messages; words where no file was given."""
    return Path(given).name if isinstance(given, str | Path) else otherwise


def share_of(mismatch: Number) -> float:
    """A share from `0.01` or `"1%"`. Raises UsageError."""
    is_text = isinstance(mismatch, str)
    try:
        if is_text and not str(mismatch).strip().endswith("%"):
            raise ValueError
        found = float(str(mismatch).strip()[:-1]) / 100.0 if is_text else float(mismatch)
    except (TypeError, ValueError):
        wanted = "per cent with their sign, such as 1%" if is_text else "a share, such as 0.01, or a text, such as '1%'"
        raise UsageError(f"--mismatch {mismatch}: expected {wanted}") from None
    if not (math.isfinite(found) and found >= 0.0):
        raise UsageError(f"--mismatch {mismatch}: expected {'0%' if is_text else '0'} or more")
    return found


def following_case(
    stand: Stand,
    motion: MotionGiven,
    programme: ProgrammeGiven,
    servo: Servo | str | Path,
    mismatch: Number,
    seed: int,
    periods: int | None,
    begin: str | None,
    table: int | None,
    backend: str,
) -> Case:
    """The run to be made. Raises UsageError and what the files raise."""
    from mahovik.proof.verify.programme.verification import motion_check, stand_check
    from mahovik.use.control.mismatch import with_mismatch
    from mahovik.use.control.reference_motion import ReferenceMotion
    from mahovik.use.control.trim import design_trim

    share = share_of(mismatch)
    found = programme_of(programme)
    source = _name(programme, "the programme")
    if (whose := stand_check(stand, found)).failed:
        raise UsageError(f"{source}: {whose.words}")
    required = motion_of(motion, stand, found)
    if (whose := motion_check(required, found)).failed:
        raise UsageError(f"{source}: {whose.words}")
    servos, servo_source = servo_of(servo, stand), _name(servo, "the servos")
    if not found.periodic:
        _check_finite(source, periods, begin, table)
        begin, table, periods = "programme", None, 1
    begin = begin or "settled"
    if begin == "rest" and found.runup is None:
        raise UsageError(f"--begin rest: {source} has no run-up; plan with `runup` in the motion file")
    wanted = ReferenceMotion.of(stand, required, found, table)
    if required.span < 4.0 * servos.period:
        raise UsageError(
            f"{servo_source}: sample_period {servos.period:g} s: fewer than 4 samples in "
            f"{'a period' if found.periodic else 'the duration'} of the programme, {required.span:g} s"
        )
    design = None if servos.trim is None else design_trim(stand, required, found, servos.trim)
    if periods is None:
        periods = SETTLING + MEASURED_PERIODS
        if design is not None:
            rounds = math.ceil(math.log(LEFT) / math.log(design.radius)) if design.radius > 0.0 else 1
            each = design.trim.settling + design.trim.averaging + 1
            periods = min(max(rounds, 1), MOST_ROUNDS) * each + MEASURED_PERIODS
    elif found.periodic and periods < MEASURED_PERIODS + 1:
        raise UsageError(
            f"--periods {periods}: expected at least {MEASURED_PERIODS + 1}: the last {MEASURED_PERIODS} are measured"
        )
    _check_loops(stand, servos, servo_source)
    return Case(wanted, with_mismatch(stand, share, seed), servos, periods, design, begin, backend)


def _check_finite(source: str, periods: int | None, begin: str | None, table: int | None) -> None:
    """Raise UsageError for an option of periodic programmes."""
    finite = f"{source} is finite"
    if periods is not None:
        raise UsageError(f"--periods {periods}: {finite} and is followed once; leave --periods out")
    if begin not in (None, "programme"):
        raise UsageError(f"--begin {begin}: {finite} and begins in the required state; leave --begin out")
    if table not in (None, TABLE):
        raise UsageError(f"--table {table}: {finite}, a table of its own; leave --table out")


def _check_loops(stand: Stand, servo: Servo, source: str) -> None:
    """Raise CheckError if the loop of a flywheel is unstable; warn if its margins are small."""
    from mahovik.use.control.servo import check_margins, margins

    found = margins(stand, servo)
    if found.radius >= 1.0:
        check_margins(stand, servo, source)
    if not found.are_sufficient:
        gain = min(found.gain, found.less)
        warn(f"{source}: margins are small: gain {gain:.2f}, phase {found.phase:.0f} deg, of each servo's loop")
