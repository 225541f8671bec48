"""`identify`: numbers of a stand from measured data, and what the data cannot tell."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from mahovik.errors import UsageError
from mahovik.out.arguments import FilePath, StandGiven, command, output_format, reading, text_of_keys
from mahovik.out.result import Result, column
from mahovik.writing import write

if TYPE_CHECKING:
    from pandas import DataFrame

DataGiven = Annotated["str | Path | DataFrame | Sequence[str | Path | DataFrame]", "DATA"]


@command()
def identify(
    stand: StandGiven,
    *,
    data: DataGiven,
    free: Annotated[str | Sequence[str] | Mapping[str, Any], "KEYS|FREE.toml"],
    output: FilePath | None = None,
    loss: Literal["linear", "soft_l1", "huber", "cauchy", "arctan"] = "linear",
) -> Result:
    """Estimate numbers of a stand file from measured data.

    Least squares with the exact model. Data are accelerations and rates of the stand's points, or the reaction of its
    hold, with counts, pulses or phases of all its flywheels; what else is unknown, the initial state of each run and a
    constant offset of each channel, is estimated beside. Combinations that the data cannot tell stay as in the file and
    are named, with the motion that would show them. Exit status 1 where a channel's data are left unexplained, beyond
    its noise. Figures are in SI.

    Args:
        stand: the stand file, with the sensors as points.
        data: a file of measured data, .csv or .parquet, as often as needed; in Python also a DataFrame.
        free: paths of the stand file separated by commas, such as w*.unbalance, or a file that names them, with known
            delays of sensors. `imu.delay` is the delay of a sensor.
        output: write the stand file with the estimated numbers, .toml: comments, order and units stay; or a table,
            .csv, .json or .parquet.
        loss: how residuals count; all but linear bear outliers.

    Raises:
        DataError: data that cannot be used, each fault in a line.
        UsageError: an unknown path, too few data.
        StandError: a stand that cannot be.
    """
    from mahovik.out.api.stands import Stand
    from mahovik.out.identify.estimate import HEARD, coloured_lines, estimate, shares_left, unobservable_lines
    from mahovik.out.identify.free import Free, read_free, with_numbers
    from mahovik.use.measured.read import read_recordings

    machine, files = Stand.of(stand), files_of(data)
    form = ""
    if output is not None:
        read = [file for file in (stand, *files) if isinstance(file, str | Path)]
        form = output_format("output", output, read, (".toml", ".csv", ".json", ".parquet"))
        if form == ".toml" and not isinstance(stand, str | Path):
            raise UsageError("output: needs the stand as a file, whose comments stay")
    paths, delays = reading("free", free, read_free)
    numbers = Free(machine, paths, delays)
    recordings = reading("data", files, read_recordings, machine)
    fit, runs = estimate(numbers, recordings, loss)
    values, before = numbers.values(fit.theta), numbers.values(numbers.nominal)
    new = numbers.stand
    if numbers.size:
        new = new.replace(dict(zip(numbers.paths, values[: numbers.size].tolist(), strict=False)))
    if output is not None and form == ".toml":
        write(Path(output), with_numbers(Path(str(stand)).read_text(encoding="utf-8-sig"), new, numbers.numbers))
    shares = [shares_left(run, left) for run, left in zip(runs, fit.residuals, strict=True)]
    heard, left = (np.concatenate([share[i] for share in shares]) for i in (1, 0))
    seen = left[heard] if heard.any() else left[np.isfinite(left)]
    channels = [(run.source, label) for run in runs for label in run.channels]
    notes = [note for recording in recordings for note in recording.notes]
    notes += [note for run in runs for note in run.notes]
    if not heard.any():
        notes.append(f"no channel spreads over {HEARD:g} times its noise: the residual is that of all channels")
    badly = np.concatenate([share[2] for share in shares])
    for (source, label), share, bad in zip(channels, left, badly, strict=True):
        if bad:
            words = "a sign, an axis, a phase, a unit, or a number that is not free?"
            notes.append(f"warning: {source}: {label}: the stand leaves {100.0 * share:.3g} % of the data: {words}")
    notes += coloured_lines(runs, fit)
    lines = unobservable_lines(numbers, runs, fit)
    result = Result(
        f"{machine.name}: numbers from {', '.join(run.source for run in runs)}",
        (
            column("path", "", numbers.paths),
            column("value", "", values),
            column("unit", "", numbers.units),
            column("standard_error", "", fit.standard_errors(numbers.slopes(fit.theta))),
            column("before", "", before),
        ),
        rows="parameters",
        index="path",
        meta={
            "stand": machine.name,
            "residual": float(np.sqrt(np.mean(seen**2))) if seen.size else math.nan,
            "unobservable": lines,
            "channels": Result(
                "What is left of the channels",
                (
                    column("run", "", [source for source, _ in channels]),
                    column("channel", "", [label for _, label in channels]),
                    column("share", "", left),
                    column("offset", "SI", np.concatenate(fit.offsets)),
                    column("noise", "SI", np.concatenate(fit.noise)),
                ),
            ),
            "stand_keys": json.loads(text_of_keys(new.to_dict(), schema=False)),
        },
        messages=[*(f"unobservable: {line}" for line in lines), *notes],
        details=("stand", "unobservable", "stand_keys"),
        ok=not badly.any(),
    )
    if output is not None and form != ".toml":
        result.save(output)
    return result


def files_of(data: Any) -> list[Any]:
    """The files and frames of measured data of an argument."""
    return list(data) if isinstance(data, Sequence) and not isinstance(data, str) else [data]
