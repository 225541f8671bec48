"""`simulate`: a stand in time, under a regime or with a programme that sampled servos follow."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from mahovik.errors import CheckError, UsageError
from mahovik.out.arguments import (
    FileGiven,
    FilePath,
    Progressing,
    Seconds,
    StandGiven,
    command,
    file_name,
    motion_of,
    programme_of,
    quantity,
    regime_of,
    servo_of,
    time,
    time_limit,
)
from mahovik.out.notices import Progress, notify, rest_to_start, warn, warn_of_steps
from mahovik.out.result import Column, Result, column, split_unit

if TYPE_CHECKING:
    from mahovik.core.motion.regime import Regime
    from mahovik.core.stand.model import State
    from mahovik.out.api.stands import Stand
    from mahovik.out.api.states import States
    from mahovik.use.control.loop import Case as Following
    from mahovik.use.control.loop import Errors

OF_REGIME = ("until", "regime", "start", "every", "mounts", "backend")
OF_C = ("dt", "order", "real", "carried")
OF_PROGRAMME = ("motion", "servo", "mismatch", "seed", "periods", "begin", "table")
"""Arguments that belong to one way of running."""


@command(needs={"programme": OF_PROGRAMME, "backend=c": OF_C}, excludes={"programme": (*OF_REGIME, *OF_C)})
def simulate(
    stand: StandGiven,
    *,
    until: Seconds | None = None,
    regime: FileGiven | None = None,
    start: FileGiven | States | None = None,
    dt: Seconds = "0.1 ms",
    every: Seconds = "1 ms",
    order: Literal[4, 2] = 4,
    backend: Literal["c", "scipy"] = "c",
    mounts: bool = False,
    real: Literal["double", "float"] = "double",
    carried: bool = False,
    programme: FileGiven | None = None,
    motion: FileGiven | None = None,
    servo: FilePath | None = None,
    mismatch: Annotated[float | str, "PERCENT"] = "0%",
    seed: int = 1,
    periods: int | None = None,
    begin: Literal["settled", "programme", "rest"] | None = None,
    table: int = 128,
    progress: Progressing = None,
) -> Result:
    """Simulate a stand under a regime, or following a programme.

    Columns are the motion of the carrier and flywheels, torques, and readings of every point, a row each time `every`
    passes. Ctrl-C keeps the rows computed so far; so does a motion that leaves the ranges of the C, with exit status 1.

    With a programme, a motion and a servo file the flywheels are driven by sampled servos, on a stand whose numbers are
    wrong by `mismatch`; the result says how well the carrier follows, a row each sample.

    Args:
        stand: the stand file.
        until: simulate for this time, s or "500 ms".
        regime: speeds or torques of the flywheels, and wrenches; default they keep the speeds of the start.
        start: start from this state; default the rest pose.
        dt: make no step longer than this, s or "0.1 ms".
        every: give a row each time this passes, s or "1 ms".
        order: order of the step.
        backend: integrate by c, the generated C, or by scipy, the literal reference, adaptive, slow.
        mounts: give also the wrench of the mount on each flywheel.
        real: element type of the C; float shows what `step` of a board makes of the motion.
        carried: keep what rounding takes, by a carry; without it steps are those of firmware without one.
        programme: follow this programme by servos, instead of a regime.
        motion: the required motion of the programme.
        servo: the servos that follow the programme.
        mismatch: make the numbers of the stand wrong by this, 0.01 or "1%", at most 20%.
        seed: draw the errors of the mismatch from this seed.
        periods: run a periodic programme for this number of periods; default until it has settled.
        begin: begin in the stand's own periodic motion (default), in the required state (of a finite programme always),
            or at rest with the run-up.
        table: nodes per period of the table in firmware; 0 for the exact programme.

    Raises:
        StandError, RegimeError, MotionError, ProgrammeError, ServoError: a problem of a file.
        UsageError: a number out of its range, or an argument of the other way of running.
        CheckError: there is no rest pose to begin in; a loop is unstable.
        StateError: the motion cannot begin.
    """
    from mahovik.out.api.stands import Stand

    model = Stand.of(stand)
    if programme is not None:
        if motion is None or servo is None:
            name, file = ("motion", "required motion") if motion is None else ("servo", "servos")
            raise UsageError(f"{name}: missing, expected the file with the {file} of the programme")
        return _follow(model, programme, motion, servo, mismatch, seed, periods, begin, table, progress)
    from mahovik.use.simulate.case import Case
    from mahovik.use.simulate.held import long_steps
    from mahovik.use.simulate.run import simulate as run

    end = time_limit("until", until)
    if end is None:
        raise UsageError("until: missing, expected a time, s or with a unit")
    chosen, state = _beginning(model, regime, start, end)
    case = Case(model, chosen, state, end, time("every", every), time("dt", dt), order, real, carried)
    warn_of_steps(case)
    for long in long_steps(model, case.dt, chosen.has_speed_law) if backend == "c" else ():
        warn(str(long))
    result = run(case, backend, mounts, lambda t: notify(progress, Progress(f"simulate {model.name}", t, end)))
    weak = {name: {"t": t, "torque": missing} for name, (t, missing) in result.weak_motors.items()}
    messages = [
        f"motor of {name}: cannot give the torque of its law; {short['torque']:.4g} N m short at t = {short['t']:.6g} s"
        for name, short in weak.items()
    ]
    meta = {"motors_short": weak}
    return _result(model, result.columns, f"{model.name} under {chosen.name}", meta, messages, result)


def _result(
    stand: Stand, columns: Mapping[str, Any], title: str, meta: Mapping[str, Any], messages: Sequence[str], run: Any
) -> Result:
    """The result of a run; people see place and speeds."""
    from mahovik.core.stand.structure import identities

    split = [(name, *split_unit(name), values) for name, values in columns.items()]
    shown = ("t", "x", "y", "z", *(f"phi_dot {s.name}" for s in stand.flywheels[:4]))
    if run.stopped is not None:
        messages = [*messages, f"error: {run.stopped}; what was computed is kept"]
    facts = {"stand": stand.name, "physics": identities(stand).physics, "stopped": run.stopped, **meta}
    return Result(
        title,
        [Column(name, unit, values, (), "rpm" if unit == "rad/s" else "") for _, name, unit, values in split],
        index="t",
        meta=facts | ({"interrupted": True} if run.interrupted else {}),
        messages=messages,
        ok=run.stopped is None,
        details=[*(name for _, name, _, _ in split if name not in shown), "stand", "physics", "stopped", *meta],
    )


def _beginning(stand: Stand, regime: Any, start: Any, until: float) -> tuple[Regime, State]:
    """The regime, and the initial state. Raises RegimeError, UsageError, CheckError."""
    from mahovik.core.motion.regime import steady_regime
    from mahovik.out.api.states import state_of
    from mahovik.use.simulate.case import HINT, START_KEYS
    from mahovik.use.simulate.held import allowed_start

    first = None if start is None else state_of("start", start, stand, START_KEYS, HINT)
    chosen = None if regime is None else regime_of(regime, stand, until)
    if first is not None:
        return chosen or steady_regime(stand, first.phi_dot), allowed_start(stand, first)
    chosen = chosen or steady_regime(stand, [0.0] * len(stand.flywheels))
    try:
        return chosen, rest_to_start(stand, [wheel.phase or 0.0 for wheel in chosen.flywheels])
    except CheckError as error:
        raise CheckError(f"{error}; give an initial state by start=STATE.json") from None


# ---- a programme that servos follow


def _follow(
    stand: Stand, programme: Any, motion: Any, servo: Any, mismatch: float | str, seed: int, periods: int | None,
    begin: str | None, table: int, progress: Progressing,
) -> Result:  # fmt: skip
    """The run of a programme, and how well the carrier follows."""
    from mahovik.use.control.loop import close_loop, errors_of

    case = following_case(stand, motion, programme, servo, mismatch, seed, periods, begin, table)
    T, words = case.servo.period, f"follow {file_name(programme, 'the programme')}"
    first, last = case.first * T, case.last * T
    record = close_loop(case, lambda t: notify(progress, Progress(words, t - first, last - first)))
    if len(record.t) < 2:
        raise CheckError(f"the run ends at once: {record.stopped}")
    title = f"{stand.name} follows {case.reference.motion.name} by {case.servo.name}"
    if record.stopped is not None:
        return _result(stand, record.columns(), title, {}, (), record)
    errors = errors_of(record)
    meta = {
        "coordinates": _coordinates(errors), "error": errors.share, "error_rms": errors.share_rms,
        "error_end": errors.share_end, "mismatch": mismatch, "seed": seed, "periods": case.periods,
        "flywheels_apart": errors.apart.tolist(), "peak_torque": np.abs(record.tau).max(axis=0).tolist(),
        "samples_limited": record.limited, "slew_end": errors.slew,
    }  # fmt: skip
    if case.design is not None:
        meta["trim"] = {"rounds": record.rounds} | {
            key: getattr(case.design, key) for key in ("radius", "margin", "rank")
        }
    said = errors.words(case, record, f"mismatch {mismatch}, seed {seed}")
    return _result(stand, record.columns(), title, meta, said, record)


def _coordinates(errors: Errors) -> Result:
    """Errors of each coordinate: about the mean over the last periods, or of a finite programme over the run."""
    share = [math.nan if part is None else part for part in errors.shares()]
    names, units = errors.coordinates.names, errors.coordinates.unit_names
    columns = [column("coordinate", "", names), column("unit", "", [unit or "1" for unit in units])]
    columns += [column(name, "", getattr(errors, name)) for name in ("amplitude", "peak", "rms")]
    columns += [column("share", "", share)]
    last = {"mean": errors.mean, "end": errors.end}
    columns += [column(name, "", values) for name, values in last.items() if values is not None]
    if errors.harmonics is not None:
        orders = [str(k) for k in range(1, len(errors.harmonics) + 1)]
        columns.append(column("harmonics", "", errors.harmonics.T, orders))
    return Result("errors of coordinates", columns, rows="coordinates", index="coordinate", details=("harmonics",))


def following_case(
    stand: Stand, motion: Any, programme: Any, servo: Any, mismatch: float | str, seed: int, periods: int | None,
    begin: str | None, table: int,
) -> Following:  # fmt: skip
    """The run to be made, of files or what they hold; see `simulate`. Raises UsageError and what the files raise."""
    from mahovik.core.stand.units import PLAIN
    from mahovik.proof.verify.programme.verification import motion_check, stand_check
    from mahovik.use.control.loop import make_case
    from mahovik.use.control.mismatch import with_mismatch
    from mahovik.use.control.servo import check_margins, margins

    course = programme_of(programme)
    source = file_name(programme, "the programme")
    if (check := stand_check(stand, course)).failed:
        raise UsageError(f"programme: {source}: {check.words}")
    required = motion_of(motion, stand, course)
    if (check := motion_check(required, course)).failed:
        raise UsageError(f"programme: {source}: {check.words}")
    servos, servo_source = servo_of(servo, stand), file_name(servo, "the servos")
    real = with_mismatch(stand, quantity("mismatch", mismatch, PLAIN), seed)
    case = make_case(stand, real, required, course, servos, periods, begin, table, source, servo_source)
    stable = margins(stand, servos)
    if stable.radius >= 1.0:
        check_margins(stand, servos, servo_source)
    if not stable.are_sufficient:
        gain = min(stable.gain, stable.less)
        warn(f"{servo_source}: margins are small: gain {gain:.2f}, phase {stable.phase:.0f} deg, of each servo's loop")
    return case
