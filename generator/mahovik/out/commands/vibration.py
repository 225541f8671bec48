"""`vibration`: what flywheels at constant speeds do to a point, and speeds and phases that make it quiet."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.errors import UsageError, whole_number
from mahovik.out.arguments import (
    Band,
    FilePath,
    Number,
    Phases,
    Progressing,
    Range,
    Seconds,
    StandGiven,
    Turning,
    Vector,
    command,
    reading,
    time_limit,
    vector,
)
from mahovik.out.notices import Progress, notify, warn_of_speeds, warn_of_turn
from mahovik.out.plots import ARCSEC, Line, Panel, stems
from mahovik.out.result import Column, Result, column, quantity_text
from mahovik.use.vibration.lines import MAKER, in_band, read_band, read_requirements, size_of
from mahovik.use.vibration.speeds import by_name, read_limits, read_phases, read_speeds

if TYPE_CHECKING:
    from mahovik.out.api.stands import Stand
    from mahovik.use.vibration.speeds import Asked
    from mahovik.use.vibration.study import Vibration as Study
    from mahovik.use.vibration.view import Observable

Tables = Annotated[Mapping[str, str | Path], "NAME=FILE.csv"]

Interval = tuple[float, float]
GoOn = Callable[..., bool]

STEPS = 61
"""Speeds of a sweep before more are added, by default."""

SHOWN = 12
"""Lines of a sweep with columns of their own."""

NO_LINE = 1e-6
"""Part of the largest amplitude below which a line is not listed."""


@command(needs={"improve": ("momentum", "limit", "avoid", "seed")})
def vibration(
    stand: StandGiven,
    *,
    speed: Turning,
    at: Annotated[str, "POINT|carrier|FLYWHEEL|hold.reaction|hold.FREEDOM"] | None = None,
    quantity: Literal["angle", "rate", "displacement", "velocity", "acceleration", "force", "moment"] | None = None,
    band: Band | None = None,
    phase: Phases | None = None,
    steps: int = STEPS,
    harmonics: Tables | None = None,
    noise: Tables | None = None,
    inner_modes: Tables | None = None,
    modes: FilePath | None = None,
    sight: FilePath | None = None,
    require: Annotated[str | Sequence[str], "LIMIT"] = (),
    improve: bool = False,
    momentum: Vector | None = None,
    limit: Annotated[Number | Range, "SPEED|LOW..HIGH"] | None = None,
    avoid: Annotated[str | Sequence[str | Range], "F|LOW..HIGH|modes"] = (),
    seed: int = 0,
    time: Seconds | None = None,
    progress: Progressing = None,
) -> Result:
    """Find the steady vibration at constant speeds.

    Of one set of speeds: a line a wheel and order, of which the amplitude is 0 to peak. Of a sweep: a row a speed, with
    more speeds at resonances, so that the largest amplitude is the true one. On every axis rms is the root mean square
    over time at the given phases, peak what these let happen, worst the sum of all amplitudes, whatever the phases.
    `largest`, the columns of lines and the picture are of the length of the vector: of one frequency half the longest
    axis of its ellipse, not the root of the sum of squares.
    The whole equations are solved, in a sweep where a sum is largest or they differ from the linear ones.

    Args:
        stand: the stand file.
        speed: speed of a flywheel, rad/s or with a unit; one range, LOW..HIGH, is swept; FACTOR*NAME is geared to
            another; `all` is every flywheel. The rest stand still.
        at: point or instrument; carrier for O1; a flywheel for the wrench of its mount on it; of a held carrier
            hold.reaction for that of the hold, or a freedom such as hold.pitch.
        quantity: what is seen there; default angle, of a load force.
        band: count only lines and noise within these frequencies.
        phase: phase of a flywheel at t = 0, rad or with a unit; default 0.
        steps: speeds of a sweep, evenly spaced; more are added.
        harmonics: maker's table of a wheel's harmonics, or of `all`.
        noise: maker's table of broadband noise.
        inner_modes: radial, axial and rocking mode of a wheel on its bearings.
        modes: table of structural modes, which do not act back on the wheels.
        sight: table of sensitivities of a line of sight, in place of a point.
        require: limit to be met on every axis at all speeds, "rms|peak|worst VALUE UNIT [LOW..HIGHHz]".
        improve: search speeds and phases that make it quieter in the band; the momentum of the wheels stays the same.
        momentum: hold this momentum of the wheels, in E1, N m s; default that of the given speeds.
        limit: speed limit of all wheels in this search, or their range; default from half of the given speed to the
            no-load speed of the motor, without motor twice the given speed.
        avoid: frequency that no order 1 or 2 may meet, within 10 %, or a range, or modes of the stand.
        seed: of the random starts of this search.
        time: end a sweep or a search after this time, with what is known then.

    Raises:
        UsageError: an argument that cannot be; TableError: a table that cannot.
        CheckError: no rest pose, no steady motion, no speeds within the limits.
    """
    from mahovik.out.api.stands import Stand
    from mahovik.use.vibration.chain import Makers
    from mahovik.use.vibration.maker import read_harmonics, read_inner_modes, read_noise, read_structure
    from mahovik.use.vibration.study import vibration as find

    machine = Stand.of(stand)
    seen = _observable(machine, at, quantity, sight)
    limits = read_requirements([require] if isinstance(require, str) else require, seen.name, seen.measure.unit)
    within = None if band is None else read_band("band", band)
    structure = None if modes is None else reading("table", Path(modes), read_structure, machine)
    makers = Makers(
        _tables(machine, "harmonics", harmonics, read_harmonics),
        _tables(machine, "noise", noise, read_noise),
        _tables(machine, "inner_modes", inner_modes, read_inner_modes),
        structure,
    )
    plan = read_speeds(machine, speed)
    if improve and (plan.sweep is not None or makers.harmonics):
        raise UsageError("improve: expected one set of speeds, and no makers' harmonics, which have no phases")
    for name, search in {"steps": steps != STEPS, "time": time is not None and not improve}.items():
        if plan.sweep is None and search:
            raise UsageError(f"{name}: needs a range of speeds, speed=NAME=LOW..HIGH")
    _warn_of_speeds(machine, speed, plan)
    go_on = _clock(time, progress)
    phases = read_phases("phase", machine, phase)
    bands = [within, *(requirement.band for requirement in limits)]
    result = find(machine, plan, seen, steps=steps, phases=phases, makers=makers, bands=bands, go_on=go_on)
    warn_of_turn(machine)
    verdicts = list(map(result.judge, limits))
    meta: dict[str, Any] = {"requirements": list(map(result.verdict_entry, verdicts))}
    messages = [*map(result.verdict_words, verdicts), *result.remarks()]
    ok = all(verdict.met for verdict in verdicts)
    if improve:
        better, words = _improve(machine, result, within or (0.0, np.inf), momentum, limit, avoid, seed, go_on)
        meta["improved"] = better
        messages += words
        ok = ok and better["after"] < better["before"]
    return _result(result, within, meta, messages, ok)


def _observable(stand: Stand, at: str | None, quantity: str | None, sight: str | Path | None) -> Observable:
    """What is seen. Raises UsageError: neither a point nor a line of sight, or both."""
    from mahovik.use.vibration.view import find_view, read_sight

    if (at is None) is (sight is None):
        raise UsageError("at, sight: expected a point or a line of sight, one of them")
    if sight is not None:
        return reading("table", Path(sight), read_sight, stand)
    return find_view(stand, str(at), quantity, "angle")


def _tables(
    stand: Stand, name: str, tables: Mapping[str, str | Path] | None, read: Callable[[Path], Any]
) -> dict[str, Any]:
    """Tables by flywheel. Raises UsageError, TableError."""
    paths = by_name(name, stand, tables or {})
    made = {path: reading("table", Path(path), read) for path in dict.fromkeys(paths.values())}
    return {wheel: made[path] for wheel, path in paths.items()}


def _warn_of_speeds(stand: Stand, asked: Asked, plan: Any) -> None:
    """Warn of speeds beyond those of the motors, and of fast ones without a unit."""
    fastest = np.abs(plan.rows(np.array(plan.sweep or (0.0,)))).max(axis=0)
    texts = by_name("speed", stand, asked)
    warn_of_speeds(stand, fastest.tolist(), [str(texts.get(name, "")) for name in plan.names])


def _clock(seconds: float | str | None, progress: Progressing) -> GoOn:
    """What says whether a search goes on, with its first solution always, and shows how far it is."""
    limit = time_limit("time", seconds)
    end = None if limit is None else monotonic() + limit

    def go_on(done: int = 1, planned: int | None = None) -> bool:
        notify(progress, Progress("speeds", done, planned))
        return done == 0 or end is None or monotonic() < end

    return go_on


def _improve(
    stand: Stand, vibration: Study, band: Interval, momentum: Any, limit: Any, avoid: Any, seed: int, go_on: GoOn
) -> tuple[dict[str, Any], list[str]]:
    """`improved`, of which before and after are of the whole equations, and messages. Raises UsageError, CheckError."""
    from mahovik.use.vibration.improve import Freedom, avoided_bands, improve_vibration

    wanted = None if momentum is None else vector("momentum", momentum, 'in N m s, as "0 0 14"')
    whole_number("seed", seed, 0)
    freedom = Freedom.of(stand, vibration.speeds[0], wanted, read_limits(limit), avoided_bands(vibration, avoid))
    better = improve_vibration(vibration, freedom, band, seed=seed, go_on=go_on)
    unit = vibration.seen.measure.unit
    before, after = (quantity_text(size, unit) if size else "0" for size in (better.before, better.after))
    gain = f"{better.gain}: RMS {before} before, {after} after, of the whole equations"
    return better._asdict(), [gain, *better.remarks(vibration, band)]


def _result(vibration: Study, band: Interval | None, meta: dict[str, Any], messages: list[str], ok: bool) -> Result:
    """Lines of one set of speeds, or a row a speed."""
    seen, unit, stand = vibration.seen, vibration.seen.measure.unit, vibration.scene.stand
    axes, swept = seen.axes, vibration.plan.sweep is not None
    sums = {name: values[:, : len(axes)] for name, values in vibration.sums(band)._asdict().items()}
    lengths = vibration.lengths(band)._asdict()
    words = f"{seen.frame} in {band[0]:g}..{band[1]:g} Hz" if band else seen.frame
    about = {"stand": stand.name, "at": seen.name, "quantity": seen.quantity, "flywheels": list(vibration.plan.names)}
    details = [*about, "requirements", "largest", "improved"]
    units = dict.fromkeys(("rms", "peak", "worst", "length"), unit) | ({"speeds": "rad/s"} if swept else {})
    if "improved" in meta:
        units |= {"speeds": "rad/s", "phases": "rad", "before": unit, "after": unit}
    title, columns, index = f"{stand.name}: {seen.quantity} of {seen.name}{words}", _orders(vibration, band), ""
    if not swept:
        of_length = {name: values[0] for name, values in lengths.items()}
        meta = about | {name: values[0] for name, values in sums.items()} | {"length": of_length} | meta
        details.append("phase")
    else:
        largest, listed = vibration.largest(band), _line_columns(vibration, band)
        wheel, speed = vibration.plan.names[vibration.plan.swept or 0], float(vibration.value[largest.step])
        peak = {"value": largest.value, "unit": unit, "speed": speed, "quantity": seen.quantity}
        meta = about | {"swept": wheel, "largest": peak | {"frequency": largest.frequency}} | meta
        size, place = quantity_text(largest.value, unit), vibration.rpm(largest.step)
        messages = [f"largest amplitude {size} at {place}, {largest.frequency:.6g} Hz", *messages]
        title, index = f"{title}, over the {vibration.plan.words}", "speeds"
        columns = (
            column("speeds", "rad/s", vibration.value, shown="rpm"),
            *(column(name, unit, values, axes) for name, values in sums.items()),
            column("length", unit, np.column_stack([*lengths.values()]), list(lengths)),
            *listed,
        )
        details += ["swept", "peak", "length", *(line.name for line in listed)]
    return Result(
        f"{title}; amplitudes 0 to peak", columns, rows="" if swept else "orders", index=index, meta=meta, units=units,
        messages=messages, ok=ok, details=details, drawings=_picture(vibration, lengths, swept),
    )  # fmt: skip


def _orders(vibration: Study, band: Interval | None) -> tuple[Column, ...]:
    """The lines of one set of speeds, largest first; amplitudes along the axes."""
    lines, axes = vibration.lines, vibration.seen.axes
    frequency, a = lines.frequency[0], lines.amplitude[0, :, : len(axes)]
    size = np.where(in_band(frequency, band or (0.0, np.inf)), size_of(a), 0.0)
    listed = [i for i in np.argsort(-size, kind="stable") if size[i] > NO_LINE * size.max(initial=0.0)]
    names = [lines.names[i] for i in listed]
    phase = [np.full(len(axes), np.nan) if lines.names[i].source == MAKER else np.angle(a[i]) for i in listed]
    empty = np.zeros((0, len(axes)))
    return (
        column("wheel", "", [name.wheel for name in names]),
        column("order", "", [name.order for name in names]),
        column("frequency", "Hz", frequency[listed]),
        column("amplitude", vibration.seen.measure.unit, np.abs(a[listed]), axes),
        column("phase", "rad", np.array(phase) if listed else empty, axes, "deg"),
        column("source", "", [f"{name.source} {name.part}".strip() for name in names]),
    )


def _line_columns(vibration: Study, band: Interval | None) -> list[Column]:
    """The largest lines of a sweep: their largest lengths."""
    lines = vibration.lines
    inside = in_band(lines.frequency, band or (0.0, np.inf)) & (lines.frequency > 0.0)
    size = np.where(inside, size_of(lines.amplitude), 0.0)
    largest = np.nanmax(np.nan_to_num(size), axis=0, initial=0.0)
    listed = [i for i in np.argsort(-largest, kind="stable")[:SHOWN] if largest[i] > NO_LINE * largest.max()]
    return [column(lines.names[i].text, vibration.seen.measure.unit, size[:, i]) for i in listed]


def _picture(vibration: Study, lengths: Mapping[str, np.ndarray[Any, Any]], swept: bool) -> list[Panel]:
    """Lengths of lines over their frequency; of a sweep those of worst case and RMS over its speed."""
    seen, unit, scale = vibration.seen, vibration.seen.measure.unit, 1.0
    if unit.startswith("rad"):
        unit, scale = f"arcsec{unit[3:]}", ARCSEC
    title = f"{seen.quantity} of {seen.name}, {unit}"
    if not swept:
        size = scale * size_of(vibration.lines.amplitude[0])
        x, span = vibration.lines.frequency[0], (0.0, 1.1 * float(vibration.lines.frequency.max(initial=1.0)))
        return [Panel(f"{title}, 0 to peak", (stems("", x, size),), abscissa="frequency, Hz", height=1.6, span=span)]
    x, order = RPM * vibration.value, np.argsort(vibration.value)
    names = {"worst": "worst case over phases", "rms": "RMS"}
    size = scale * np.stack([lengths[name] for name in names])[:, order]
    drawn = tuple(Line(words, x[order], y, k) for k, (words, y) in enumerate(zip(names.values(), size, strict=True)))
    steep = bool(np.nanmax(size[0]) > 50.0 * np.nanmedian(size[0]) > 0.0)
    span = float(x.min()), float(x.max())
    return [Panel(title, drawn, log=steep, abscissa=f"{vibration.plan.words}, rpm", height=2.6, span=span)]
