"""`mahovik excite`: the programme of the flywheels by which free numbers of a stand are determined best."""

from __future__ import annotations

from collections.abc import Sequence
from math import isnan
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from mahovik.errors import UsageError
from mahovik.out.cli import quantities
from mahovik.out.cli.options import (
    SEED_OF_STARTS,
    STAND_FILE,
    TIME_LIMIT,
    choice,
    command,
    file_option,
    json_option,
    option,
)
from mahovik.out.cli.output import end_of_search, print_json, print_line, print_table, require_other_file
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.out.identify.excite.face import Excitation


def _number(_name: str, text: str) -> float | str:
    """A number without unit, or a text with one."""
    try:
        return float(text)
    except ValueError:
        return text.strip()


def _read_bound(name: str, text: str) -> Any:
    """One number for all flywheels, numbers between commas, or NAME=NUMBER between commas."""
    parts = text.split(",")
    if "=" in text:
        return dict(_pair(name, part) for part in parts)
    return [_number(name, part) for part in parts] if len(parts) > 1 else _number(name, text)


def _pair(name: str, text: str) -> tuple[str, float | str]:
    """Raises UsageError."""
    key, equals, value = text.partition("=")
    if not (equals and key.strip() and value.strip()):
        raise UsageError(f"{name} {text}: expected NAME=VALUE")
    return key.strip(), _number(name, value)


def _names(text: str | None) -> tuple[str, ...]:
    """Names between commas. Raises UsageError: there is none."""
    names = tuple(each.strip() for each in (text or "").split(",") if each.strip())
    if text is not None and not names:
        raise UsageError(f'--channels "{text}": expected names of channels between commas, such as imu.rate.*')
    return names


@command(short_help="Find a programme that determines free numbers well.")
def excite(
    stand_file: str = STAND_FILE,
    output: str = file_option("-o", "P.json", "Write the programme to this file.", required=True),
    free: str = option(
        "--free",
        "Free these numbers of the stand file, or those of a file.",
        metavar="KEYS|FREE.toml",
        reads="a file that names free numbers",
        default="*.unbalance",
    ),
    duration: float = option(
        "--duration", "Set the duration of the experiment.", metavar="TIME", default="10 s", parse=quantities.time_limit
    ),
    speed: Any = option(
        "--speed",
        "Bound the speed of all flywheels, or of each; default: by motors.",
        metavar="SPEED",
        parse=_read_bound,
    ),
    speed_min: Any = option("--speed-min", "Keep at least this speed; default 0.", metavar="SPEED", parse=_read_bound),
    acceleration: Any = option("--acceleration", "Bound the acceleration, rad/s2.", metavar="A", parse=_read_bound),
    torque: Any = option(
        "--torque", "Bound the torques of motors, besides their own limits.", metavar="N m", parse=_read_bound
    ),
    channels: str | None = option(
        "--channels", "Read these alone, imu.rate.*,hold.reaction.z; default: all.", metavar="CHANNELS"
    ),
    noise: tuple[str, ...] = option(
        "--noise",
        "Set the noise of a sample: rate=0.002, imu.acceleration=0.02, force=0.02.",
        metavar="CHANNEL=VALUE",
        multiple=True,
    ),
    rate: float = option("--rate", "Set the sampling rate, Hz.", metavar="HZ", type=float, default=1000.0),
    criterion: Literal["A", "D"] = choice(
        "--criterion", ["A", "D"], "Make the mean variance least (A) or the confidence ellipsoid (D).", default="A"
    ),
    harmonics: int = option(
        "--harmonics",
        "Set the number of harmonics of the speeds.",
        metavar="H",
        type=click.IntRange(0, 20),
        default=2,
    ),
    seconds: float | None = TIME_LIMIT,
    seed: int = SEED_OF_STARTS,
    as_json: bool = json_option("Print figures and status as JSON."),
) -> None:
    """Find the flywheel programme by which free numbers are determined best.

    Searches speeds and their harmonics inside bounds for the most information in what the sensors of the stand read,
    and of a held carrier a force table: the reaction. Prints the standard errors that it predicts, beside those of
    distinct constant speeds inside the same bounds.
    Ctrl-C gives the best so far.

    Exit status: 0 a programme inside the bounds; 1 a bound is exceeded; 2 bad input; 130 Ctrl-C.
    """
    from mahovik.out.api.stands import load

    stand = load(stand_file)
    from mahovik.out.identify.excite.face import excite as find

    path = Path(output)
    require_other_file(path, (stand_file,), f"-o {output}", "programme")
    with progress("searching") as stage:
        found = find(
            stand, free=free, duration=duration, speed=speed, speed_min=speed_min, acceleration=acceleration,
            torque=torque, channels=_names(channels), noise=dict(_pair("--noise", each) for each in noise), rate=rate,
            criterion=criterion, harmonics=harmonics, seconds=seconds, seed=seed, progress=stage.show,
        )  # fmt: skip
    found.save(path)
    if as_json:
        print_json({"file": output} | found.to_dict())
    else:
        _report(found, output)
    for line in found.words:
        click.echo(line, err=True)
    if found.unseen:
        click.echo(f"warning: the programme hardly shows {_some(found.unseen)}", err=True)
    more = (
        "another run may find more" if found.is_better else "nothing better had been found, more time may change that"
    )
    end_of_search(found, ("OK",), True, more)


def _report(found: Excitation, output: str) -> None:
    """Print what is found."""
    print_line(f"{click.format_filename(output)}   {found.programme.programme.span:g} s, {found.status}")
    names = ("parameter", "unit", "value>", "standard error>", "at constant speeds>")
    columns = [column.values.tolist() for column in found.columns]
    print_table(
        names,
        ((row[0], row[1], *("-" if isnan(x) else f"{x:.4g}" for x in row[2:])) for row in zip(*columns, strict=True)),
    )
    if found.without_angle:
        click.echo(f"{_some(found.without_angle)}: no angle, as the unbalance is zero")
    peaks = found.found.peaks
    print_table(
        ("flywheel", "speed, rad/s>", "acceleration, rad/s2>", "torque of motor, N m>"),
        (
            (name, f"{low:.5g} to {high:.5g}", f"{steep:.4g}", f"{torque:.4g}")
            for name, low, high, steep, torque in zip(
                found.found.programme.flywheels, peaks.speed_min, peaks.speed, peaks.acceleration, peaks.torque,
                strict=True,
            )
        ),
    )  # fmt: skip
    click.echo(f"{found.comparison}; {found.effort['tried']} programmes tried")


def _some(names: Sequence[str]) -> str:
    return ", ".join(names) if len(names) <= 4 else f"{', '.join(names[:3])} and {len(names) - 3} more"
