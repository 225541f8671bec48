"""`mahovik verify`: the generated C against the literal reference and the second derivation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import UsageError
from mahovik.out.cli.options import (
    JUNIT,
    REAL,
    SEED_OF_STATES,
    STAND_FILE,
    STATES,
    WORST,
    command,
    file_option,
    flag,
    is_given,
    json_option,
    load_stand,
    option,
)
from mahovik.out.cli.output import print_json_text
from mahovik.out.cli.verdicts import print_report
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.proof.verify.check import Report


@command()
def verify(
    stand_file: str = STAND_FILE,
    states: int = STATES,
    seed: int = SEED_OF_STATES,
    as_json: bool = json_option("Print the table as JSON."),
    junit: str | None = JUNIT,
    worst: str | None = WORST,
    against: str | None = file_option("--against", "DIR", "Judge the C in this folder, not a fresh copy."),
    servo: str | None = file_option(
        "--servo", "S.toml", "Judge the C of these servos in the folder of --against.", reads="a servo file"
    ),
    motion: str | None = file_option(
        "--motion", "M.json", "Judge also the duration and the target of a trim, with --servo."
    ),
    programme: str | None = file_option("--programme", "P.json", "Judge along the slew of --motion, with --servo."),
    name: str = option("--name", "Judge the servos of the programme of this name in C.", default="programme"),
    judges: bool = flag("--judges", "Judge by Pinocchio and MuJoCo, without the laws that they do not know."),
    rigorous: bool = flag("--rigorous", "Bound the true error of the C by enclosures of the exact answer."),
    targets: str | None = option(
        "--targets",
        "Check for the same bits on processors: all, quick, m7,rv64gc,...; both element types.",
        metavar="NAME,...",
    ),
    real: str = REAL,
    everything: bool = flag("--all", "Print every check, not a line for each function."),
) -> None:
    """Judge the C of a stand by the reference.

    Generates the C of a stand, compiles it with warnings as errors, evaluates random and extreme states, and compares
    every quantity with the literal reference (worst), and that with the second derivation (second), relative to its
    measured scale. Exit status 0 only if all agree.
    --against takes folders of `generate --prefix` and `--real` as they are, and judges the functions that `generate
    --only` wrote.

    With --servo and --against, judges the C that `generate --servo` wrote there instead: every public function of its
    header by the law in plain NumPy, and its gains by the servo file.
    """
    if servo is not None:
        _verify_servo(stand_file, servo, against, motion, programme, name, seed, states, as_json, junit)
        return
    for given in ("motion", "programme", "name"):
        if is_given(given):
            raise UsageError(f"--{given}: no servos are judged; give them, as --servo S.toml --against DIR")
    if real == "float" and judges:
        raise UsageError("--real float: only for the generated C, not with --judges")
    if judges and against is not None:
        raise UsageError("--judges judges a fresh copy: not with --against")
    if rigorous and (judges or targets is not None):
        raise UsageError("--rigorous measures the C: not with --judges, --targets")
    from mahovik.out.functions import evidence

    folder = None if against is None else Path(against)
    if rigorous or targets is not None:
        from mahovik.proof.verify.delivery import delivered_options, stand_in

        stand, only = load_stand(stand_file), None
        if folder is not None:
            stand = stand_in(folder, stand)
            if (delivered := delivered_options(folder)) is not None:
                real, only = real if is_given("real") else delivered.real, delivered.only
        if targets is not None:
            if judges or worst is not None:
                raise UsageError("--targets runs the self-test of a fresh copy: not with --judges, -o")
            reals = (real,) if is_given("real") or folder is not None else None
            sweep = states if is_given("states") else None
            _verify_on_targets(stand, targets, reals, sweep, only, as_json, junit)
            return
        finish(_verify_rigorously(stand, seed, states, folder, real), as_json, junit, worst)
        return
    with progress(f"verify {Path(stand_file).stem}") as stage:
        found = evidence.verify(
            stand_file, states=states, seed=seed, against=folder, real=real if is_given("real") else None,
            judges=judges, progress=stage.show,
        )  # fmt: skip
    finish(found.result, as_json, junit, worst, everything=everything or judges)


WITHOUT_SERVO = (
    "worst",
    "judges",
    "rigorous",
    "targets",
    "real",
    "everything",
)
"""Options of `verify` that say nothing about servos."""


def _verify_servo(
    stand_file: str,
    servo_file: str,
    against: str | None,
    motion_file: str | None,
    programme_file: str | None,
    name: str,
    seed: int,
    states: int,
    as_json: bool,
    junit: str | None,
) -> None:
    """Judge the C of servos in a folder, print the table, and exit with the verdict as status."""
    from mahovik.core.motion.motion_file import load_motion
    from mahovik.core.motion.programme import load_programme
    from mahovik.core.motion.servo import load_servo
    from mahovik.proof.verify.exported import verify_servo
    from mahovik.proof.verify.programme.verification import motion_check

    if against is None:
        raise UsageError("--servo: no C is given; give its folder, as --against DIR")
    if programme_file is not None and motion_file is None:
        raise UsageError(f"--programme {programme_file}: needs --motion M.json, which is missing")
    for given in WITHOUT_SERVO:
        if is_given(given):
            option_name = "-o" if given == "worst" else f"--{given}"
            raise UsageError(
                f"{option_name}: not with --servo, which judges the C of servos in the folder of --against"
            )
    stand = load_stand(stand_file)
    servo = load_servo(servo_file, stand)
    programme = None if programme_file is None else load_programme(programme_file)
    motion = None if motion_file is None else load_motion(Path(motion_file), stand, programme)
    if motion is not None and programme is not None and (whose := motion_check(motion, programme)).failed:
        raise UsageError(f"{programme_file}: {whose.words}")
    with progress(f"judge servos of {stand.name}"):
        found = verify_servo(
            stand, servo, Path(against), motion=motion, programme=programme, name=name, seed=seed, count=states
        )
    finish(found, as_json, junit, None, by="part")


def _verify_on_targets(
    stand: Stand,
    names: str,
    reals: tuple[str, ...] | None,
    states: int | None,
    only: tuple[str, ...] | None,
    as_json: bool,
    junit: str | None,
) -> None:
    """Run the self-test on targets, print the table, and exit with the verdict as status.

    1: bits differ. 2: a compiler or an emulator is missing, or the processor lacks a feature of the only target; then
    nothing is known.
    """
    from mahovik.proof.verify.selftest import SWEEP, parse_targets, verify_targets

    pairs = parse_targets(names, reals)
    with progress(f"verify {stand.name} on targets", len(pairs)) as stage:
        found = verify_targets(stand, pairs, states or SWEEP, stage.at, only)
    try:
        finish(found, as_json, junit, None, by="target")
    except SystemExit:
        raise SystemExit(1 if any(row.verdict == "FAILED" for row in found.rows) else 2) from None


def _verify_rigorously(stand: Stand, seed: int, states: int, against: Path | None, real: str) -> Report:
    """Measure the rounding of the C. Raises UsageError without python-flint."""
    try:
        from mahovik.proof.verify.rounding import measure_rounding
    except ImportError as error:
        if (error.name or "").partition(".")[0] != "flint":
            raise
        raise UsageError("--rigorous: python-flint is not installed: pip install 'mahovik[rigorous]'") from None
    with progress(f"enclose {stand.name}", states) as stage:
        return measure_rounding(stand, seed=seed, count=states, real=real, against=against, progress=stage.at)


def finish(
    found: Report,
    as_json: bool,
    junit: str | None,
    worst: str | None,
    more: Mapping[str, Any] | None = None,
    words: Sequence[str] = (),
    by: str = "",
    everything: bool = True,
) -> None:
    """Print the report, and exit with its verdict.

    `more` is added to the JSON, `words` are printed as lines below the table, `by` heads the column of wants.
    """
    from mahovik.proof.verify.check import as_json as json_text

    if as_json:
        print_json_text(json_text(found, more))
    else:
        print_report(found, by, everything)
        for line in words:
            click.echo(line)
    _conclude(found, as_json, junit, worst)


def _conclude(found: Report, as_json: bool, junit: str | None, worst: str | None) -> None:
    """Write the requested files, and exit with the verdict as status."""
    if found.error:
        click.echo(f"error: {found.error}", err=True)
    try:
        _write(found, as_json, junit, worst)
    except UsageError as error:
        if found.passed:
            raise
        click.echo(f"error: {error}", err=True)  # the verdict is more important
    if not found.passed:
        raise SystemExit(1)


def _write(found: Report, as_json: bool, junit: str | None, worst: str | None) -> None:
    from mahovik.proof.verify.check import as_junit, worst_lines
    from mahovik.writing import write

    if junit is not None:
        write(Path(junit), as_junit(found))
    lines = worst_lines(found)
    if lines and (worst is not None or not found.passed):
        target = Path(worst) if worst is not None else Path(f"{found.stand}-worst.jsonl")
        write(target, lines)
        click.echo(f"worst states: {click.format_filename(target)}", err=as_json)
