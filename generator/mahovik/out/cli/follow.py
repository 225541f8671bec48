"""`mahovik simulate --programme`: sampled servos follow a programme, on a stand that differs a little from its file."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import CheckError, UsageError
from mahovik.out.cli.arguments import console, load_stand, table
from mahovik.out.cli.group import INTERRUPTED
from mahovik.out.cli.json_output import print_json
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.core.motion.servo import Servo
    from mahovik.core.stand.model import Stand
    from mahovik.use.control.causes import Contribution
    from mahovik.use.control.following import Following
    from mahovik.use.control.loop import Case
    from mahovik.use.control.record import Record

MEASURED = 10
"""Periods measured at the end of a run."""

SETTLING = 30
"""Periods before them, by default, without a trim."""

LEFT, MOST_ROUNDS = 1e-2, 60
"""A trim runs until this part of the error is left, or for this many rounds."""


def follow(
    stand_file: str,
    programme_file: str,
    motion_file: str | None,
    servo_file: str | None,
    mismatch: str,
    seed: int,
    periods: int | None,
    begin: str,
    rows: str,
    backend: str,
    output: str | None,
    as_json: bool,
    causes: bool,
) -> None:
    """The command's work. Raises UsageError, CheckError and what the files raise."""
    from mahovik.use.control.causes import contributions
    from mahovik.use.control.following import following
    from mahovik.use.control.loop import close_loop, step_error
    from mahovik.use.simulate.output import check, save

    if servo_file is None or motion_file is None:
        missing = "--servo S.toml" if servo_file is None else "--motion M.json"
        raise UsageError(f"--programme {programme_file}: needs {missing}, which is missing")
    if output is not None:
        check(Path(output))
    stand = load_stand(stand_file)
    case, source = _case(stand, programme_file, motion_file, servo_file, mismatch, seed, periods, begin, rows, backend)
    _warn(stand, case.servo, source)
    T = case.servo.period
    with progress(f"follow {Path(programme_file).name}", (case.last - case.first) * T, "s") as stage:
        record = close_loop(case, lambda t: stage.at(t - case.first * T))
    if len(record.t) < 2:
        raise CheckError(f"the run ends at once: {record.stopped}")
    if output is not None:
        save(record.run(), Path(output))
    if record.stopped is not None:
        kept = "; what was computed is kept" if output is not None else ""
        click.echo(f"error: {record.stopped}{kept}", err=True)
        if as_json:
            print_json({"error": [record.stopped]})
        raise SystemExit(INTERRUPTED if record.interrupted else 1)
    found = following(record, MEASURED)
    limits: list[Contribution] = []
    ended = False
    try:
        if causes:
            with progress("what limits it") as stage:
                limits = contributions(case, lambda cause: stage.say(f"what limits it: {cause}"))
    except KeyboardInterrupt:  # the run itself is complete
        ended = True
    told = _Told(case, record, found, limits, step_error(case, record), mismatch, seed)
    if as_json:
        print_json(_plain(told))
    else:
        if output is not None:
            click.echo(f"{click.format_filename(output)}   {len(record.t)} rows")
        _print(told)
    if ended:
        click.echo("interrupted: the run is complete, but its limits were not determined", err=True)
        raise SystemExit(INTERRUPTED)


def share_of(text: str) -> float:
    """A share from `1%`. Raises UsageError."""
    number = text.strip()
    try:
        if not number.endswith("%"):
            raise ValueError
        found = float(number[:-1]) / 100.0
    except ValueError:
        raise UsageError(f"--mismatch {text}: expected per cent with their sign, such as 1%") from None
    if not (math.isfinite(found) and found >= 0.0):
        raise UsageError(f"--mismatch {text}: expected 0% or more")
    return found


def _case(
    stand: Stand,
    programme_file: str,
    motion_file: str,
    servo_file: str,
    mismatch: str,
    seed: int,
    periods: int | None,
    begin: str,
    rows: str,
    backend: str,
) -> tuple[Case, str]:
    from mahovik.core.motion.programme import load_programme
    from mahovik.core.motion.required import load_motion
    from mahovik.core.motion.servo import load_servo
    from mahovik.proof.verify.programme.identity import motion_finding, stand_finding
    from mahovik.use.control.loop import Case
    from mahovik.use.control.mismatch import with_mismatch
    from mahovik.use.control.trim import design_trim
    from mahovik.use.control.wanted import Wanted

    share = share_of(mismatch)
    programme = load_programme(programme_file)
    if not (whose := stand_finding(stand, programme)).passed:
        raise UsageError(f"{Path(programme_file).name}: {whose.words}")
    motion = load_motion(motion_file, stand)
    if not (whose := motion_finding(motion, programme)).passed:
        raise UsageError(f"{Path(programme_file).name}: {whose.words}")
    servo = load_servo(servo_file, stand)
    if begin == "rest" and programme.runup is None:
        raise UsageError(
            f"--begin rest: {Path(programme_file).name} has no run-up; plan with `runup` in the motion file"
        )
    wanted = Wanted.of(stand, motion, programme, _rows(rows))
    if motion.span < 4.0 * servo.period:
        raise UsageError(
            f"{Path(servo_file).name}: sample_period {servo.period:g} s: fewer than 4 samples in a period of the "
            f"programme, {motion.span:g} s"
        )
    design = None if servo.trim is None else design_trim(stand, motion, programme, servo.trim)
    if periods is None:
        periods = SETTLING + MEASURED
        if design is not None:
            rounds = math.ceil(math.log(LEFT) / math.log(design.radius)) if design.radius > 0.0 else 1
            each = design.trim.settling + design.trim.averaging + 1
            periods = min(max(rounds, 1), MOST_ROUNDS) * each + MEASURED
    elif periods < MEASURED + 1:
        raise UsageError(f"--periods {periods}: expected at least {MEASURED + 1}: the last {MEASURED} are measured")
    real = with_mismatch(stand, share, seed)
    return Case(wanted, real, servo, periods, design, begin, backend), Path(servo_file).name


def _rows(text: str) -> int | None:
    if text == "exact":
        return None
    if not text.isascii() or not text.isdigit():
        raise UsageError(f"--table {text}: expected a number of nodes a period, or exact")
    return int(text)


def _warn(stand: Stand, servo: Servo, source: str) -> None:
    """Raise CheckError if the loop of a flywheel is unstable; warn if its margins are small."""
    from mahovik.use.control.stability import check, margins

    found = margins(stand, servo)
    if found.radius >= 1.0:
        check(stand, servo, source)
    if not found.accepted:
        gain = min(found.gain, found.less)
        click.echo(
            f"warning: {source}: margins are small: gain {gain:.2f}, phase {found.phase:.0f} deg, of each servo's loop",
            err=True,
        )


def _limiting(limits: list[Contribution]) -> str | None:
    there = [each for each in limits if each.alone is not None]
    return there[0].cause.name if there else None


@dataclass(frozen=True)
class _Told:
    """Figures of a run; `error`: of its steps."""

    case: Case
    record: Record
    found: Following
    limits: list[Contribution]
    error: float
    mismatch: str
    seed: int


def _plain(told: _Told) -> dict[str, Any]:
    import numpy as np

    case, record, limits = told.case, told.record, told.limits
    result: dict[str, Any] = {
        "stand": case.wanted.stand.name,
        "motion": case.wanted.motion.name,
        "servo": case.servo.name,
        "mismatch": told.mismatch,
        "seed": told.seed,
        "periods": case.periods,
        **told.found.as_json(),
        "peak_torque": np.abs(record.tau).max(axis=0).tolist(),
        "samples_limited": record.limited,
        "step_error": told.error,
    }
    if case.design is not None:
        result["trim"] = {
            "rounds": record.rounds,
            "radius": case.design.radius,
            "margin": case.design.margin,
            "rank": case.design.rank,
        }
    if limits:
        result["causes"] = {e.cause.name: {"alone": e.alone, "without": e.without} for e in limits}
        result["limited_by"] = _limiting(limits)
    return result


def _print(told: _Told) -> None:
    import numpy as np

    from mahovik.core.motion.servo import COORDINATES

    case, record, found = told.case, told.record, told.found
    out = console()
    shown = table(
        "coordinate", "amplitude>", "peak error>", "rms>", "share>", "mean>", "harmonics 1, 2, 3 of the error>"
    )
    for i, name in enumerate(COORDINATES):
        share = found.shares()[i]
        shown.add_row(
            f"{name}, {'mm' if i < 3 else 'mrad'}",
            *(f"{1e3 * value[i]:.4g}" for value in (found.amplitude, found.peak, found.rms)),
            "held still" if share is None else f"{100 * share:.3g} %",
            f"{1e3 * found.mean[i]:.4g}",
            ", ".join(f"{1e3 * h:.2g}" for h in found.harmonics[:3, i]),
        )
    out.print(shown)
    flywheels = [s.name for s in case.wanted.stand.flywheels]
    furthest, strongest = int(np.argmax(found.apart)), int(np.argmax(np.abs(record.tau).max(axis=0)))
    click.echo(
        f"error of the carrier {100 * found.share:.3g} % of its amplitude (rms {100 * found.share_rms:.3g} %), about "
        f"its mean, over the last {found.periods} of {case.periods} periods; mismatch {told.mismatch}, seed {told.seed}"
    )
    click.echo(
        f"flywheels: at most {1e3 * found.apart[furthest]:.3g} mrad from the programme ({flywheels[furthest]}); "
        f"torque at most {np.abs(record.tau[:, strongest]).max():.4g} N m ({flywheels[strongest]}), "
        f"cut in {record.limited} of {len(record.t)} samples"
    )
    if case.design is not None:
        click.echo(
            f"trim: {record.rounds} rounds; an error falls to {case.design.radius:.3g} a round; the settled trim "
            f"converges while its model is less than {100 * case.design.margin:.2g} % wrong"
        )
    if told.limits:
        causes = table("what limits it", "alone>", "without it>", "", title=None)
        for each in told.limits:
            alone, without = (_percent(x) for x in (each.alone, each.without))
            causes.add_row(each.cause.name, alone, without, each.cause.words)
        out.print(causes)
        off = ", with the trim off" if case.design is not None else ""
        click.echo(f"limited by {_limiting(told.limits)}{off}")
    if case.backend == "c":
        click.echo(f"steps half as long change the carrier by {told.error:.1g} m, rad")


def _percent(value: float | None) -> str:
    return "lost" if value is None else f"{100 * value:.3g} %"
