"""`mahovik identify`: numbers of a stand from measured data."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

from mahovik.errors import UsageError
from mahovik.out.cli.options import JSON, STAND_FILE, choice, command, file_option, option
from mahovik.out.cli.output import print_json, print_line, print_table, require_other_file, require_page

if TYPE_CHECKING:
    from mahovik.out.identify.face import Identification


@command()
def identify(
    stand_file: str = STAND_FILE,
    data: tuple[str, ...] = file_option(
        "--data", "FILE", "Read measured data of the stand.", multiple=True, reads="measured data"
    ),
    free: str = option(
        "--free",
        "Free these numbers, such as w*.unbalance.",
        metavar="KEYS|FREE.toml",
        required=True,
        reads="a file that names free numbers",
    ),
    output: str = file_option("-o", "NEW.toml", "Write the stand file with the estimated numbers.", required=True),
    check: tuple[str, ...] = file_option(
        "--check",
        "FILE",
        "Read data that are only predicted, to check the result.",
        multiple=True,
        reads="measured data",
    ),
    loss: str = choice(
        "--loss", ["linear", "soft_l1", "huber"], "Choose the loss; the last two bear outliers.", default="linear"
    ),
    delay: tuple[str, ...] = option(
        "--delay", 'Set the known delay of a sensor, "imu=2 ms".', metavar="NAME=TIME", multiple=True
    ),
    report: str | None = file_option("--report", "FILE.html", "Write a page with charts."),
    as_json: bool = JSON,
) -> None:
    """Estimate numbers of a stand file from measured data.

    Data are accelerations and rates of the stand's points, with counts or phases of all its flywheels. KEYS are paths
    of the stand file, separated by commas; FREE.toml names them under `free`.

    Writes the stand file with comments, order and units as they are, and only the numbers changed. Prints standard
    errors, what the data cannot tell, and the motion that would show it.
    """
    if not data:
        raise UsageError("--data is missing: expected files of measured data of the stand")
    read = [stand_file, *data, *check, *([free] if free.endswith(".toml") else [])]
    require_other_file(Path(output), read, f"-o {output}", "stand file")
    from mahovik.out.api.stands import load
    from mahovik.out.identify.face import identify as estimate
    from mahovik.out.progress import progress
    from mahovik.writing import probe, write

    probe(Path(output))
    if report is not None:
        require_page(report, read)
    with progress("estimating") as stage:
        found = estimate(
            load(stand_file), data, free, check=check, delay=_delays(delay), loss=loss, progress=stage.show
        )
    write(Path(output), found.text(stand_file))
    if report is not None:
        found.report(report)
    if as_json:
        print_json(found.to_dict())
    else:
        _print(found)


def _delays(given: tuple[str, ...]) -> dict[str, float | str]:
    """Delays by point. Raises UsageError."""
    found: dict[str, float | str] = {}
    for text in given:
        name, equal, value = text.partition("=")
        if not equal or name in found:
            what = "given twice" if equal else 'expected NAME=TIME, such as "imu=2 ms"'
            raise UsageError(f"--delay {text}: {what}")
        try:
            found[name] = float(value)
        except ValueError:
            found[name] = value
    return found


def _print(found: Identification) -> None:
    """Table of numbers, then what is left of the data, what they cannot tell, and notes."""
    rows = []
    for each in found.parameters.values():
        error = f"{each.standard_error:.2g}" if math.isfinite(each.standard_error) else "-"
        rows.append((each.path, f"{each.value:.6g}", error, f"{each.before:.6g}", each.unit))
    print_table(("number", "value>", "standard error>", "in the file>", "unit"), rows)
    left = [
        (
            run,
            name,
            f"{each.residual:.3g} {each.unit}",
            f"{100.0 * each.share:.3g} %" if math.isfinite(each.share) else "-",
        )
        for run, channels in found.channels.items()
        for name, each in channels.items()
    ]
    print_table(("run", "channel", "left>", "of the data>"), left)
    if found.check is not None:
        after, before = (100.0 * x for x in found.check)
        print_line(f"data that were not used: {after:.3g} % left, {before:.3g} % with the numbers of the file")
    for line in found.unobservable:
        print_line(f"unobservable: {line}")
    for note in found.notes:
        print_line(note)
