"""`balance`: correction weights from vibration, by influence coefficients of any rotor or by the model of a stand."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from mahovik.core.stand.units import PLAIN
from mahovik.errors import UsageError
from mahovik.out.arguments import FileGiven, Number, StandGiven, command, quantity, reading
from mahovik.out.commands.identify import DataGiven, files_of
from mahovik.out.result import Column, Result, column

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand

NOTHING = 1e-12
"""Part of the largest vibration before that is written as zero."""


@command(needs={"stand": ("data", "plane"), "influence": ("method",)}, excludes={"influence": ("data", "plane")})
def balance(
    stand: StandGiven | None = None,
    *,
    data: DataGiven = (),
    plane: Annotated[Mapping[str, Sequence[Number] | Number], "NAME=X,.."] | None = None,
    influence: FileGiven | None = None,
    method: Literal["least-squares", "min-max"] = "least-squares",
    places: Annotated[float | str | Sequence[float], "COUNT|DEGREES,.."] = "",
) -> Result:
    """Find correction weights of flywheels or of any rotor.

    Of a stand with --data: all its flywheels at once, from data at constant speeds, without trial weights, by the
    linear model of the stand; least squares weighted by the noise of the channels. Its own unbalances do not count, and
    residuals hold with 95 % confidence. Of any rotor with --influence: from the vibration at any number of sensors and
    speeds before balancing and with trial weights in any number of planes, or without phase from the amplitudes of one
    sensor alone. Angles of corrections are those of the trial weights.

    Args:
        stand: the stand file, with the sensors as points.
        data: a file of measured data, with channels of sensors and phases of flywheels, as often as needed.
        plane: planes of a flywheel, or of "all" others, at these places on its axis, as w1=-10mm,10mm. Default one
            plane, at the flywheel's origin.
        influence: a JSON file with "A", and "B" and "U" of trial runs, or "ALPHA"; numbers are "amplitude@degrees".
        method: of --influence, least squares, or the smallest largest vibration.
        places: split each correction between the two of these places beside it: so many equal divisions from 0 on, or
            angles in degrees.

    Raises:
        BalanceError: data that cannot be used.
        DataError: a file of measured data that cannot be read.
        UsageError: an unknown flywheel, a number out of range.
        CheckError: the stand has no rest pose, or a search does not settle.
    """
    if (influence is None) == (stand is None):
        raise UsageError("influence, stand: expected one of them: FILE.json, or STAND.toml with data")
    files = files_of(data)
    if influence is not None:
        return _by_influence(influence, method, places)
    if not files:
        raise UsageError("data: missing, expected files of measured data of the stand")
    assert stand is not None
    return _by_model(stand, files, plane, places)


def _by_influence(influence: Any, method: Literal["least-squares", "min-max"], places: Any) -> Result:
    from mahovik.use.balance.influence import read_influence, solve, write_polar

    problems, misfit = reading("influence", influence, read_influence)
    problem, solutions = problems[0], [solve(candidate, method) for candidate in problems]
    w, left = solutions[0].w, solutions[0].left
    largest = float(np.abs(problem.A).max())

    def polar(values: Any) -> list[str]:
        return [write_polar(value) for value in values.tolist()]

    columns = [column("plane", "", np.arange(len(w))), column("w", "", polar(w))]
    if len(problems) > 1:
        columns.append(column("also", "", polar(solutions[1].w)))
    if problem.trial is not None:
        columns.append(column("add", "", polar(w - problem.trial)))
    if solutions[0].standard_error is not None:
        columns.append(column("standard_error", "", solutions[0].standard_error))
    meta: dict[str, Any] = {"before": largest, "after": float(np.abs(left).max()), "corrections": w}
    messages = []
    if solutions[0].bound is not None:
        meta["bound"] = solutions[0].bound
    if len(problems) > 1:
        messages.append("two answers fit the amplitudes: try one, or add a trial run with a weight at another place")
    if misfit is None:
        meta["left"] = [write_polar(value, NOTHING * largest) for value in left.tolist()]
    elif misfit.share > NOTHING:
        meta |= {"after": misfit.left if misfit.fair else misfit.off, "misfit": misfit.off}
        messages.append(misfit.words)
        if misfit.error is not None:
            columns.append(column("standard_error", "", [misfit.error]))
    columns += _split(places, w.tolist())
    ok, details = misfit is None or misfit.fair, ("corrections", "misfit")
    return Result("correction weights", columns, meta=meta, messages=messages, ok=ok, details=details)


def _by_model(source: Any, files: Sequence[Any], plane: Any, places: Any) -> Result:
    from mahovik.out.api.stands import Stand
    from mahovik.use.balance.by_model import HALF_WIDTH, balance_wheels
    from mahovik.use.measured.read import read_recordings
    from mahovik.use.vibration.view import LOADS, QUANTITIES

    stand = Stand.of(source)
    planes = _planes(stand, plane or {})
    recordings = reading("data", list(files), read_recordings, stand)
    wheels = balance_wheels(stand, recordings, planes)
    w, error, residual = (
        np.concatenate([getattr(wheel, key) for wheel in wheels]) for key in ("w", "error", "residual")
    )
    columns = [
        column("flywheel", "", [wheel.name for wheel in wheels for _ in wheel.positions]),
        column("plane", "m", [x for wheel in wheels for x in wheel.positions]),
        column("correction", "kg m", np.abs(w)),
        column("at", "rad", np.angle(w) % (2.0 * math.pi)),
        column("interval", "kg m", HALF_WIDTH * error),
        column("interval_at", "rad", np.arctan2(HALF_WIDTH * error, np.abs(w))),
    ]
    columns += _split(places, w.tolist())
    units, heads = QUANTITIES | LOADS, ("flywheel", "quantity", "unit", "before", "after")
    kinds = ((wheel.name, kind, sizes) for wheel in wheels for kind, sizes in wheel.vibration.items())
    change = zip(*((name, kind, units[kind].unit, *sizes[:2]) for name, kind, sizes in kinds), strict=True)
    orders = Result("First order", [column(head, "", values) for head, values in zip(heads, change, strict=True)])
    warnings = [wheel.warning for wheel in wheels if wheel.warning]
    return Result(
        f"{stand.name}: corrections",
        (*columns, column("residual", "kg m", residual)),
        rows="planes",
        meta={"stand": stand.name, "flywheels": _static(wheels), "vibration": orders},
        messages=[*(note for recording in recordings for note in recording.notes), *warnings],
        ok=not warnings,
        details=("stand",),
    )


def _static(wheels: Sequence[Any]) -> Result:
    """Static unbalances as they are and as the corrections leave them, with grades, and how well the model fits."""
    before, after = [abs(wheel.static) for wheel in wheels], [wheel.static_residual for wheel in wheels]
    grades = ([wheel.grade(x) for wheel, x in zip(wheels, sizes, strict=True)] for sizes in (before, after))
    columns = [column("flywheel", "", [wheel.name for wheel in wheels])]
    columns += [column("speed", "rad/s", [wheel.speed for wheel in wheels])]
    columns += [column("static", "kg m", before), column("residual", "kg m", after)]
    columns += [column(name, "", values) for name, values in zip(("grade", "residual_grade"), grades, strict=True)]
    return Result("Static unbalance", [*columns, column("fit", "", [wheel.fit for wheel in wheels])])


def _planes(stand: Stand, plane: Any) -> dict[str, tuple[float, ...]]:
    """Positions of planes (m) by flywheel. Raises UsageError: a name or a number."""
    from mahovik.core.stand.units import LENGTH
    from mahovik.use.vibration.speeds import by_name

    result = {}
    for wheel, value in by_name("plane", stand, plane).items():
        texts = value.split(",") if isinstance(value, str) else value if isinstance(value, list | tuple) else [value]
        result[wheel] = tuple(quantity(f"plane of {wheel}", text, LENGTH) for text in texts)
        if len(set(result[wheel])) < max(len(texts), 1):
            raise UsageError(f"plane of {wheel}: expected different positions, found {value}")
    return result


def _split(places: int | str | Sequence[float], w: Sequence[complex]) -> list[Column]:
    """A column of what corrections are at these places; none without places. Raises UsageError."""
    from mahovik.use.balance.influence import split_weight, write_polar

    if places in ("", ()):
        return []
    texts = places.split(",") if isinstance(places, str) else places if isinstance(places, Sequence) else [places]
    angles = [quantity("places", text, PLAIN) for text in texts]
    if len(angles) == 1 and angles[0] >= 3 and angles[0] % 1 == 0:
        angles = [360.0 * k / angles[0] for k in range(int(angles[0]))]
    return [column("split", "", [" + ".join(map(write_polar, split_weight(correction, angles))) for correction in w])]
