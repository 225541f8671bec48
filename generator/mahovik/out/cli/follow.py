"""`mahovik simulate --programme`: sampled servos follow a programme, on a stand that differs a little from its file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import UsageError
from mahovik.out.cli.options import load_stand
from mahovik.out.cli.output import INTERRUPTED, print_json, print_table
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.use.control.causes import Contribution
    from mahovik.use.control.finite import Tracking
    from mahovik.use.control.loop import Case
    from mahovik.use.control.record import Following, Record


@dataclass(frozen=True)
class FollowOptions:
    """Options of `mahovik simulate` about following a programme; `table`: nodes per period, or "exact"."""

    programme: str
    motion: str | None
    servo: str | None
    mismatch: str
    seed: int
    periods: int | None
    begin: str | None
    table: str
    backend: str


def follow(stand_file: str, options: FollowOptions, output: str | None, as_json: bool, causes: bool) -> None:
    """Follow a programme, and print how well. Raises UsageError, CheckError and what the files raise."""
    from mahovik.out.functions.following import follow as run
    from mahovik.use.simulate.run import check_output

    if output is not None:
        check_output(Path(output))
    stand = load_stand(stand_file)
    if options.servo is None or options.motion is None:
        missing = "--servo S.toml" if options.servo is None else "--motion M.json"
        raise UsageError(f"--programme {options.programme}: needs {missing}, which is missing")
    table = _rows(options.table)
    with progress(f"follow {Path(options.programme).name}", unit="s") as stage:
        found = run(
            stand, options.motion, options.programme, options.servo, mismatch=options.mismatch, seed=options.seed,
            periods=options.periods, begin=options.begin, table=table, backend=options.backend, causes=causes,
            progress=stage.show,
        )  # fmt: skip
    if output is not None:
        found.motion.save(output)
    record = found.record
    if found.errors is None:
        kept = "; what was computed is kept" if output is not None else ""
        click.echo(f"error: {record.stopped}{kept}", err=True)
        if as_json:
            print_json({"error": [record.stopped]})
        raise SystemExit(INTERRUPTED if record.interrupted else 1)
    summary = _Summary(options, found.case, record, found.errors, list(found.causes), found.step_error)
    if as_json:
        print_json(_plain(summary))
    else:
        if output is not None:
            click.echo(f"{click.format_filename(output)}   {len(record.t)} rows")
        _print(summary)
    if found.causes_interrupted:
        click.echo("interrupted: the run is complete, but its limits were not determined", err=True)
        raise SystemExit(INTERRUPTED)


def _rows(text: str) -> int | None:
    if text == "exact":
        return None
    if not text.isascii() or not text.isdigit():
        raise UsageError(f"--table {text}: expected a number of nodes per period, or exact")
    return int(text)


def _limiting(limits: list[Contribution]) -> str | None:
    there = [each for each in limits if each.alone is not None]
    return there[0].cause.name if there else None


@dataclass(frozen=True)
class _Summary:
    """Figures of a run; `error`: of its steps."""

    options: FollowOptions
    case: Case
    record: Record
    found: Following | Tracking
    limits: list[Contribution]
    error: float


def _plain(summary: _Summary) -> dict[str, Any]:
    import numpy as np

    case, record, limits = summary.case, summary.record, summary.limits
    result: dict[str, Any] = {
        "stand": case.reference.stand.name,
        "motion": case.reference.motion.name,
        "servo": case.servo.name,
        "mismatch": summary.options.mismatch,
        "seed": summary.options.seed,
        **({"periods": case.periods} if case.reference.programme.periodic else {}),
        **summary.found.as_json(),
        "peak_torque": np.abs(record.tau).max(axis=0).tolist(),
        "samples_limited": record.limited,
        "step_error": summary.error,
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


def _print(summary: _Summary) -> None:
    import numpy as np

    case, record, found, options = summary.case, summary.record, summary.found, summary.options
    _print_coordinates(found)
    flywheels = [s.name for s in case.reference.stand.flywheels]
    furthest, strongest = int(np.argmax(found.apart)), int(np.argmax(np.abs(record.tau).max(axis=0)))
    click.echo(
        f"error of the carrier {100 * found.share:.3g} % of its amplitude (rms {100 * found.share_rms:.3g} %), "
        f"{_where(found, case)}; mismatch {options.mismatch}, seed {options.seed}"
    )
    if (end := getattr(found, "slew", None)) is not None:
        click.echo(
            f"the slew ends {_arcsec(end.angle)} arcsec from its end, with rates up to {_arcsec(end.rate)} arcsec/s"
        )
    click.echo(
        f"flywheels: at most {1e3 * found.apart[furthest]:.3g} mrad from the programme ({flywheels[furthest]}); "
        f"torque at most {np.abs(record.tau[:, strongest]).max():.4g} N m ({flywheels[strongest]}), "
        f"cut in {record.limited} of {len(record.t)} samples"
    )
    if case.design is not None:
        click.echo(
            f"trim: {record.rounds} rounds; an error falls to {case.design.radius:.3g} per round; the settled trim "
            f"converges while its model is less than {_percent(case.design.margin)} wrong"
        )
    if summary.limits:
        limits = ((e.cause.name, _percent(e.alone), _percent(e.without), e.cause.words) for e in summary.limits)
        print_table(("what limits it", "alone>", "without it>", ""), limits)
        off = ", with the trim off" if case.design is not None else ""
        click.echo(f"limited by {_limiting(summary.limits)}{off}")
    if case.backend == "c":
        click.echo(f"steps half as long change the carrier by {summary.error:.1g} m, rad")


def _print_coordinates(found: Following | Tracking) -> None:
    from mahovik.use.control.finite import Tracking

    last = ("at the end>",) if isinstance(found, Tracking) else ("mean>", "harmonics 1, 2, 3 of the error>")
    rows = []
    units, shares = found.coordinates.unit_names, found.shares()
    for i, (name, unit, share) in enumerate(zip(found.coordinates.names, units, shares, strict=True)):
        numbers = [f"{1e3 * value[i]:.4g}" for value in (found.amplitude, found.peak, found.rms)]
        part = "held still" if share is None else f"{100 * share:.3g} %"
        if isinstance(found, Tracking):
            rest = [f"{1e3 * found.end[i]:.4g}"]
        else:
            rest = [f"{1e3 * found.mean[i]:.4g}", ", ".join(f"{1e3 * h:.2g}" for h in found.harmonics[:3, i])]
        rows.append((f"{name}, {f'm{unit}' if unit else '1e-3'}", *numbers, part, *rest))
    print_table(("coordinate", "amplitude>", "peak error>", "rms>", "share>", *last), rows)


def _where(found: Following | Tracking, case: Case) -> str:
    """Words on the part of the run that the errors are of."""
    from mahovik.use.control.finite import Tracking

    if isinstance(found, Tracking):
        return f"{100 * found.share_end:.3g} % at the end"
    return f"about its mean, over the last {found.periods} of {case.periods} periods"


def _arcsec(angle: float) -> str:
    from mahovik.proof.verify.programme.verification import ARCSEC

    return f"{angle / ARCSEC:.3g}"


def _percent(value: float | None) -> str:
    return "lost" if value is None else f"{100 * value:.3g} %"
